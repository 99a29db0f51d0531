//! Which Markdown files there are, and reading them.

use crate::error::DocsError;
use pulldown_cmark::{Event, Options, Parser};
use std::ops::Range;
use std::path::{Path, PathBuf};

/// The folder of the book's pages.
pub const BOOK: &str = "docs/src";
/// The book's table of contents.
pub const SUMMARY: &str = "docs/src/SUMMARY.md";

/// One Markdown file.
#[derive(Clone, Debug)]
pub struct Page {
    /// Relative to the checkout.
    pub file: PathBuf,
    pub text: String,
    /// What was printed into the text: bytes, in rising order.
    printed: Vec<Range<usize>>,
}

impl Page {
    /// Reads a file of the checkout `root`; `file` is relative to it.
    ///
    /// # Errors
    /// A file that cannot be read or is no UTF-8.
    pub fn read(root: &Path, file: &Path) -> Result<Self, DocsError> {
        Ok(Self::new(file, msdd_files::read_text(&root.join(file))?))
    }

    /// A page of this text.
    pub fn new(file: impl Into<PathBuf>, text: impl Into<String>) -> Self {
        Self { file: file.into(), text: text.into(), printed: Vec::new() }
    }

    /// Puts printed text instead of these bytes, which lie before all that was put earlier.
    pub(crate) fn put(&mut self, bytes: Range<usize>, text: &str) {
        self.text.replace_range(bytes.clone(), text);
        for later in &mut self.printed {
            let moved = |byte: usize| byte + text.len() - bytes.len();
            *later = moved(later.start)..moved(later.end);
        }
        self.printed.insert(0, bytes.start..bytes.start + text.len());
    }

    /// What the text is made of, with the bytes where it stands: as mdBook reads it.
    pub fn events(&self) -> impl Iterator<Item = (Event<'_>, Range<usize>)> {
        let options = Options::ENABLE_TABLES
            | Options::ENABLE_FOOTNOTES
            | Options::ENABLE_STRIKETHROUGH
            | Options::ENABLE_TASKLISTS
            | Options::ENABLE_HEADING_ATTRIBUTES;
        Parser::new_ext(&self.text, options).into_offset_iter()
    }

    /// The line of the file that holds a byte, from 1; of printed text the line of its marker.
    pub fn line(&self, byte: usize) -> usize {
        let byte = byte.min(self.text.len());
        let lines = |bytes: Range<usize>| self.text[bytes].matches('\n').count();
        let printed = self.printed.iter().filter(|printed| printed.start < byte);
        // A marker is one line.
        let surplus = printed.map(|printed| match byte < printed.end {
            true => lines(printed.start..byte),
            false => lines(printed.clone()) - 1,
        });
        1 + lines(0..byte) - surplus.sum::<usize>()
    }

    /// Whether the page is one of the book.
    pub fn in_book(&self) -> bool {
        self.file.starts_with(BOOK)
    }
}

/// The nearest folder from `start` upwards that holds docs/book.toml.
///
/// # Errors
/// There is none.
pub fn checkout(start: &Path) -> Result<PathBuf, DocsError> {
    let found = start.ancestors().find(|folder| folder.join("docs/book.toml").is_file());
    found.map(Path::to_path_buf).ok_or(DocsError::NoCheckout)
}

/// The pages at the top, the book, every README.md below cases, and all pages below rust: relative to `root`, in
/// alphabetical order.
///
/// # Errors
/// A folder that cannot be read.
pub fn all(root: &Path) -> Result<Vec<PathBuf>, DocsError> {
    let mut files = Vec::new();
    let top = ["README.md", "CONTRIBUTING.md", "CHANGELOG.md"].map(PathBuf::from);
    files.extend(top.into_iter().filter(|file| root.join(file).is_file()));
    for folder in [BOOK, "rust"] {
        collect(root, Path::new(folder), &|file| file.extension().is_some_and(|e| e == "md"), &mut files)?;
    }
    collect(root, Path::new("cases"), &|file| file.ends_with("README.md"), &mut files)?;
    files.sort();
    Ok(files)
}

/// The files below `folder` that are `wanted`, without hidden folders.
pub(crate) fn collect(
    root: &Path,
    folder: &Path,
    wanted: &dyn Fn(&Path) -> bool,
    files: &mut Vec<PathBuf>,
) -> Result<(), DocsError> {
    let whole = root.join(folder);
    if !whole.is_dir() {
        return Ok(());
    }
    let failed = |source| DocsError::Folder { folder: whole.clone(), source };
    for entry in std::fs::read_dir(&whole).map_err(failed)? {
        let entry = entry.map_err(failed)?;
        let file = folder.join(entry.file_name());
        let kind = entry.file_type().map_err(failed)?;
        if kind.is_dir() && !entry.file_name().to_string_lossy().starts_with('.') {
            collect(root, &file, wanted, files)?;
        } else if kind.is_file() && wanted(&file) {
            files.push(file);
        }
    }
    Ok(())
}
