//! Reference pages are printed from the code: a line `<!-- print: SOURCE ARGUMENT -->` of a page becomes what the module of
//! this name makes of the argument. Nothing of it is committed: the book, and what checks links, expand the lines.

mod columns;
pub mod commands;
pub mod header;
pub mod keys;
mod markdown;
mod python;
pub mod scripts;
mod source;
mod structs;
mod table;

use crate::error::{DocsError, Finding, none_found};
use crate::pages::Page;
use pulldown_cmark::Event;
use std::path::Path;

/// Markdown for an argument, from the sources below the root of the checkout.
type Source = fn(&Path, &str) -> Result<String, DocsError>;

/// Every source by its name, in alphabetical order.
const SOURCES: &[(&str, Source)] = &[
    ("columns", columns::text),
    ("commands", commands::text),
    ("header", header::text),
    ("keys", keys::text),
    ("python", python::text),
    ("scripts", scripts::text),
    ("structs", structs::text),
];

const OPEN: &str = "<!-- print:";
const CLOSE: &str = "-->";

/// What a source prints for an argument, as Markdown.
///
/// # Errors
/// A source or an argument that there is not, and code that the source cannot read.
pub fn text(root: &Path, source: &str, argument: &str) -> Result<String, DocsError> {
    let found = SOURCES.iter().find(|(name, _)| *name == source);
    let (_, printer) = found.ok_or_else(|| {
        let names: Vec<&str> = SOURCES.iter().map(|(name, _)| *name).collect();
        DocsError::Print(format!("nothing is printed from '{source}', allowed: {}", names.join(", ")))
    })?;
    printer(root, argument)
}

/// Reads a page as the book has it; `file` is relative to the root.
///
/// # Errors
/// A file that cannot be read, and markers that cannot be printed.
pub fn page(root: &Path, file: &Path) -> Result<Page, DocsError> {
    expanded(root, &Page::read(root, file)?)
}

/// The page with what is printed instead of its markers. Lines of the result count as those of the page.
///
/// # Errors
/// Every marker that cannot be printed, with its place.
pub fn expanded(root: &Path, page: &Page) -> Result<Page, DocsError> {
    let (mut made, mut findings) = (page.clone(), Vec::new());
    // From the end, so that bytes before stay where they are.
    let events: Vec<_> = page.events().collect();
    for (event, range) in events.into_iter().rev() {
        let (html, own_line) = match &event {
            Event::Html(html) => (html, true),
            Event::InlineHtml(html) => (html, false),
            _ => continue,
        };
        let Some(inside) = html.trim().strip_prefix(OPEN) else { continue };
        let printed = match inside.strip_suffix(CLOSE).map(str::trim) {
            Some(inside) if own_line => {
                let (source, argument) = inside.split_once(char::is_whitespace).unwrap_or((inside, ""));
                text(root, source, argument.trim())
            }
            _ => Err(DocsError::Print(format!("a line {OPEN} SOURCE ARGUMENT {CLOSE} holds nothing else"))),
        };
        match printed {
            Ok(text) => made.put(range, &format!("{}\n", text.trim_end())),
            Err(error) => findings.push(Finding {
                file: page.file.clone(),
                line: page.line(range.start),
                text: error.to_string(),
            }),
        }
    }
    none_found(findings)?;
    Ok(made)
}
