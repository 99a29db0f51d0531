//! What can be wrong.

use std::fmt;
use std::path::PathBuf;

/// A place in a Markdown file and what is wrong there.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Finding {
    /// Relative to the checkout.
    pub file: PathBuf,
    /// From 1.
    pub line: usize,
    pub text: String,
}

impl fmt::Display for Finding {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}:{}: {}", self.file.display(), self.line, self.text)
    }
}

/// Errors of this crate.
#[derive(Debug, thiserror::Error)]
pub enum DocsError {
    #[error(transparent)]
    File(#[from] msdd_files::FileError),
    #[error("cannot read the folder {folder}: {source}", folder = folder.display())]
    Folder { folder: PathBuf, source: std::io::Error },
    #[error(
        "no folder from here upwards holds docs/book.toml: run msdd-docs in the checkout or name it with --root"
    )]
    NoCheckout,
    #[error("{file}: {text}", file = file.display())]
    Json { file: PathBuf, text: String },
    #[error("there is no section '{name}', allowed: {names}")]
    Section { name: String, names: String },
    /// What cannot be printed into a page; the caller adds the page.
    #[error("{0}")]
    Print(String),
    #[error("{}", .0.iter().map(ToString::to_string).collect::<Vec<_>>().join("\n"))]
    Found(Vec<Finding>),
}

/// `Ok` without findings, else all of them in the order of files and lines.
///
/// # Errors
/// [`DocsError::Found`] if there is any.
pub fn none_found(mut findings: Vec<Finding>) -> Result<(), DocsError> {
    findings.sort();
    if findings.is_empty() { Ok(()) } else { Err(DocsError::Found(findings)) }
}
