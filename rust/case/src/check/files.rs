//! The files of a case that are read for a check.

use super::finding::Findings;
use super::header;
use crate::dictionary::Dictionary;
use rayon::prelude::*;
use std::path::Path;

/// Files of a bed by their names in a case of `msddFoam`, and what stands in them.
pub type Files = Vec<(&'static str, Dictionary)>;

/// The dictionary of a file, if the file could be read.
pub fn file<'a>(files: &'a Files, name: &str) -> Option<&'a Dictionary> {
    files.iter().find(|(path, _)| *path == name).map(|(_, dictionary)| dictionary)
}

/// Reads files, and adds a finding for each that is missing although it is needed, or cannot be read. `place` is the path below
/// the case folder at which a file stands.
pub fn read(
    folder: &Path,
    names: &[(&'static str, bool)],
    place: impl Fn(&str) -> String + Sync,
    found: &mut Findings,
) -> Files {
    let there = |name: &str| folder.join(name).exists() || folder.join(format!("{name}.gz")).exists();
    let results: Vec<_> = names
        .par_iter()
        .map(|&(name, required)| {
            let path = place(name);
            (name, required, there(&path).then(|| Dictionary::expanded(&folder.join(&path))))
        })
        .collect();
    let mut files = Vec::new();
    for (name, required, result) in results {
        match result {
            Some(Ok(dictionary)) => {
                header::check(name, &dictionary, found);
                files.push((name, dictionary));
            }
            Some(Err(error)) => found.refused(name, error, ""),
            None if required => {
                let advice = "The solver needs this file; 'msdd case new' writes a case with all of them";
                found.error([name, ""], "missing", "", advice);
            }
            None => {}
        }
    }
    files
}
