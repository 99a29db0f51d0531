//! What `msdd-docs` finds in small checkouts made for the purpose, and in this one.

mod commands;
mod fill;
mod gather;
mod keys;
mod layers;
mod links;
mod math;
mod print;
mod repository;
mod tables;
mod verification;

use msdd_docs::DocsError;
use msdd_docs::error::Finding;
use std::fs;
use std::path::{Path, PathBuf};

/// A checkout of these files (path, text), in a folder of its own.
fn checkout(name: &str, files: &[(&str, &str)]) -> PathBuf {
    let root = Path::new(env!("CARGO_TARGET_TMPDIR")).join("docs").join(name);
    let _ = fs::remove_dir_all(&root);
    for (file, text) in files {
        let file = root.join(file);
        fs::create_dir_all(file.parent().unwrap()).unwrap();
        fs::write(file, text).unwrap();
    }
    root
}

/// What was found, as lines; empty if nothing was.
fn found<T>(result: Result<T, DocsError>) -> Vec<String> {
    match result {
        Ok(_) => Vec::new(),
        Err(DocsError::Found(findings)) => findings.iter().map(Finding::to_string).collect(),
        Err(error) => panic!("{error}"),
    }
}
