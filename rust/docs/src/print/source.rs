//! Rust sources as text: bodies of items, constants, and where they are.

use crate::error::DocsError;
use regex_lite::Regex;
use std::cell::OnceCell;
use std::path::{Path, PathBuf};

pub fn regex(pattern: &str) -> Regex {
    Regex::new(pattern).expect("a pattern of this program")
}

/// Groups of every match of a pattern; those that took no part are empty.
pub fn all(pattern: &str, text: &str) -> Vec<Vec<String>> {
    let groups = |found: regex_lite::Captures| {
        found.iter().map(|group| group.map_or_else(String::new, |m| m.as_str().to_string())).collect()
    };
    regex(pattern).captures_iter(text).map(groups).collect()
}

/// The first group of the first match.
pub fn first(pattern: &str, text: &str) -> Option<String> {
    all(pattern, text).into_iter().next().map(|mut groups| groups.swap_remove(1))
}

/// A source, and those in which its names are looked for: the file itself, its crate, the others.
pub struct Source {
    pub file: PathBuf,
    root: PathBuf,
    text: String,
    others: OnceCell<[Vec<String>; 2]>,
}

impl Source {
    /// # Errors
    /// A file that cannot be read.
    pub fn read(root: &Path, file: &str) -> Result<Self, DocsError> {
        let text = msdd_files::read_text(&root.join(file))?;
        Ok(Self { file: file.into(), root: root.to_path_buf(), text, others: OnceCell::new() })
    }

    /// Text of the file itself.
    pub fn text(&self) -> &str {
        &self.text
    }

    /// Texts of the other files of the crate, and of all other crates; without what cannot be read.
    fn others(&self) -> &[Vec<String>; 2] {
        self.others.get_or_init(|| {
            let own = self.root.join(self.file.iter().take(2).collect::<PathBuf>());
            let (mut files, mut texts) = (Vec::new(), [Vec::new(), Vec::new()]);
            walk(&self.root.join("rust"), &mut files);
            for path in files.iter().filter(|path| **path != self.root.join(&self.file)) {
                texts[usize::from(!path.starts_with(&own))].extend(msdd_files::read_text(path));
            }
            texts
        })
    }

    /// The first group of a pattern in the nearest of the sources that has it; none where they differ. `words`: what a match
    /// holds, so that few files are searched.
    pub fn find(&self, words: &str, pattern: &str) -> Option<String> {
        let near = Some(all(pattern, &self.text)).filter(|found| !found.is_empty());
        let in_files = |files: &Vec<String>| -> Vec<Vec<String>> {
            files.iter().filter(|text| text.contains(words)).flat_map(|text| all(pattern, text)).collect()
        };
        let far = || self.others().iter().map(in_files).find(|found| !found.is_empty());
        let mut found = near.or_else(far)?;
        found.dedup_by(|a, b| a[1] == b[1]);
        (found.len() == 1).then(|| found.swap_remove(0).swap_remove(1))
    }

    /// What stands in the braces of an item of the file itself.
    ///
    /// # Errors
    /// An item that the file does not have.
    pub fn body(&self, head: &str) -> Result<String, DocsError> {
        let found = first(&body(head), self.text());
        found.ok_or_else(|| DocsError::Print(format!("{}: no {head}", self.file.display())))
    }

    /// A constant as text: two numbers as a range.
    ///
    /// # Errors
    /// A constant that no source has.
    pub fn constant(&self, name: &str) -> Result<String, DocsError> {
        let found = self.find(name, &format!(r#"(?s)\bconst {name}: [^=]*= ("[^"]*"|[^;]*);"#));
        let value = found
            .ok_or_else(|| DocsError::Print(format!("{}: not one constant {name}", self.file.display())))?;
        let range = all(r"^\[([^,\]]*), ([^,\]]*)\]$", &value);
        Ok(match range.first() {
            Some(ends) => format!("{} to {}", number(&ends[1]), number(&ends[2])),
            None => number(value.trim_matches('"')),
        })
    }
}

/// A pattern of what stands in the braces of an item.
pub fn body(head: &str) -> String {
    format!(r"(?ms)^(?:pub(?:\([^)]*\))? )?{head}(?:<[^>]*>)? \{{\n(.*?)^\}}")
}

/// A literal as people write it.
pub fn number(literal: &str) -> String {
    let plain = literal.trim().replace('_', "");
    match plain.parse::<f64>() {
        Ok(_) => plain.replace(".0e", "e").trim_end_matches(".0").replace('-', "−").replace("e−", "e-"),
        Err(_) => literal.trim().to_string(),
    }
}

fn walk(folder: &Path, found: &mut Vec<PathBuf>) {
    let entries = std::fs::read_dir(folder).into_iter().flatten().flatten();
    let mut paths: Vec<PathBuf> = entries.map(|entry| entry.path()).collect();
    paths.sort();
    for path in paths {
        let name = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
        if path.is_dir() && !["tests", "benches", "docs", "python"].contains(&name.as_str()) {
            walk(&path, found);
        } else if name.ends_with(".rs") && !name.ends_with("tests.rs") {
            found.push(path);
        }
    }
}
