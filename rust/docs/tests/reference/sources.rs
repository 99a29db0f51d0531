//! Files of the checkout, and patterns in them.

use regex::Regex;
use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

/// Folders that hold no sources: results, what tools make, and this test, which names what it looks for.
const NO_SOURCES: [&str; 9] = [
    "target",
    ".git",
    ".cache",
    "lnInclude",
    "platforms",
    "results",
    "postProcessing",
    "rust/docs",
    "corpus",
];

pub fn checkout() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..").canonicalize().expect("the checkout")
}

/// Text of a file, by its path in the checkout.
pub fn text(path: &str) -> String {
    let file = checkout().join(path);
    std::fs::read_to_string(&file)
        .unwrap_or_else(|error| panic!("{path}: {error}; if it has moved, change rust/docs/tests/reference"))
}

/// Paths and texts of the files below a folder whose names end in one of these; those without an ending by "".
pub fn files(folder: &str, endings: &[&str]) -> Vec<(String, String)> {
    let mut found = Vec::new();
    walk(&checkout(), &checkout().join(folder), endings, &mut found);
    found.sort();
    assert!(!found.is_empty(), "{folder}: no files that end in {endings:?}");
    found
}

fn walk(checkout: &Path, folder: &Path, endings: &[&str], found: &mut Vec<(String, String)>) {
    for entry in std::fs::read_dir(folder).unwrap_or_else(|error| panic!("{}: {error}", folder.display())) {
        let path = entry.expect("a readable folder").path();
        let name = path.strip_prefix(checkout).expect("below the checkout").display().to_string();
        let left_out = |folder: &&str| name == **folder || name.ends_with(&format!("/{folder}"));
        if NO_SOURCES.iter().any(left_out) {
            continue;
        }
        if path.is_dir() {
            walk(checkout, &path, endings, found);
            continue;
        }
        let ending = path.extension().unwrap_or_default().to_string_lossy().into_owned();
        let Ok(text) = std::fs::read_to_string(&path) else { continue };
        if endings.contains(&ending.as_str()) {
            found.push((name, text));
        }
    }
}

/// Every match of a pattern with its groups; groups that took no part are empty.
pub fn all(pattern: &str, text: &str) -> Vec<Vec<String>> {
    let pattern = Regex::new(pattern).expect("a pattern of this test");
    let groups = |found: regex::Captures| {
        found.iter().map(|group| group.map_or_else(String::new, |m| m.as_str().to_string())).collect()
    };
    pattern.captures_iter(text).map(groups).collect()
}

/// The first group of every match.
pub fn firsts(pattern: &str, text: &str) -> Vec<String> {
    all(pattern, text).into_iter().map(|groups| groups[1].clone()).collect()
}

/// Texts in quotation marks.
pub fn strings(text: &str) -> Vec<String> {
    firsts(r#""([^"]*)""#, text)
}

/// The text from the first match of a pattern to the next match of another.
pub fn between(text: &str, begin: &str, end: &str, source: &str) -> String {
    let pattern = format!("(?ms){begin}(.*?){end}");
    firsts(&pattern, text).into_iter().next().unwrap_or_else(|| panic!("{source}: no {begin}"))
}

/// Words of all sources, names of files among them.
pub fn words() -> BTreeSet<String> {
    let mut words = BTreeSet::new();
    for folder in ["rust", "openfoam", "cases/common"] {
        for (_, text) in files(folder, &["rs", "C", "H", "h", "hpp", ""]) {
            words.extend(text.split(|c: char| !(c.is_alphanumeric() || c == '_')).map(str::to_string));
        }
    }
    words
}
