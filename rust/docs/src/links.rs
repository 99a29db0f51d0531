//! Links, anchors, paths of the repository, and the book's table of contents. No network: addresses are left alone.

use crate::error::{DocsError, Finding, none_found};
use crate::headings::anchors;
use crate::pages::{BOOK, Page, SUMMARY};
use crate::paths;
use crate::print;
use pulldown_cmark::{Event, Tag};
use std::collections::{BTreeMap, BTreeSet};
use std::path::{Component, Path, PathBuf};

/// What scripts/docs adds to the built book, relative to its root: pages may lead there though docs/src has no such file.
pub const BUILT: [&str; 3] = ["rustdoc", "msdd.h", "msdd.h.html"];

/// Checks links, anchors and paths of the files; and the table of contents, if it is among them.
///
/// # Errors
/// Everything that is wrong in any of them.
pub fn check(root: &Path, files: &[PathBuf]) -> Result<(), DocsError> {
    let mut known: BTreeMap<PathBuf, BTreeSet<String>> = BTreeMap::new();
    let mut findings = Vec::new();
    let listed = contents(root)?;
    for file in files {
        let page = print::page(root, file)?;
        let made = paths::made_by_the_reader(&page);
        for (event, range) in page.events() {
            let problem = match &event {
                Event::Start(Tag::Link { dest_url, .. } | Tag::Image { dest_url, .. }) => {
                    link(root, &page, dest_url, &listed, &mut known)?
                }
                Event::Code(text) => paths::problem(root, file, text, &made),
                _ => None,
            };
            if let Some(text) = problem {
                findings.push(Finding { file: file.clone(), line: page.line(range.start), text });
            }
        }
        if file == Path::new(SUMMARY) {
            findings.extend(unlisted(root, &listed)?);
        }
    }
    none_found(findings)
}

/// What is wrong with a link, if anything. `listed`: pages of the table of contents; one that is missing is reported there, not
/// again at every link to it.
fn link(
    root: &Path,
    page: &Page,
    address: &str,
    listed: &BTreeSet<PathBuf>,
    known: &mut BTreeMap<PathBuf, BTreeSet<String>>,
) -> Result<Option<String>, DocsError> {
    if address.contains("://") || address.starts_with("mailto:") {
        return Ok(None);
    }
    let (path, anchor) = address.split_once('#').unwrap_or((address, ""));
    let folder = page.file.parent().unwrap_or(Path::new(""));
    let Some(target) = (if path.is_empty() { Some(page.file.clone()) } else { tidy(&folder.join(path)) })
    else {
        return Ok(Some(format!("the link '{address}' leads out of the checkout")));
    };
    if page.in_book() {
        if let Ok(inside) = target.strip_prefix(BOOK) {
            if BUILT.iter().any(|built| inside.starts_with(built)) {
                return Ok(paths::rustdoc(root, inside).map(|text| format!("the link '{address}': {text}")));
            }
        } else {
            let text =
                "leads out of docs/src, which the built book does not hold: name the path in backticks";
            return Ok(Some(format!("the link '{address}' {text}")));
        }
    }
    if !root.join(&target).exists() {
        let told = listed.contains(&target) && page.file != Path::new(SUMMARY);
        return Ok(
            (!told).then(|| format!("the link '{address}' leads to {}, which is missing", target.display()))
        );
    }
    if anchor.is_empty() || target.extension().is_none_or(|e| e != "md") {
        return Ok(None);
    }
    if !known.contains_key(&target) {
        known.insert(target.clone(), anchors(&print::page(root, &target)?));
    }
    let has = known[&target].contains(anchor);
    Ok((!has).then(|| format!("the link '{address}': {} has no heading '#{anchor}'", target.display())))
}

/// The path without . and ..; none if it leads out.
fn tidy(path: &Path) -> Option<PathBuf> {
    let mut tidied = PathBuf::new();
    for part in path.components() {
        match part {
            Component::Normal(name) => tidied.push(name),
            Component::CurDir => {}
            Component::ParentDir if tidied.pop() => {}
            _ => return None,
        }
    }
    Some(tidied)
}

/// Pages that the table of contents lists, relative to the checkout; none if there is no table.
fn contents(root: &Path) -> Result<BTreeSet<PathBuf>, DocsError> {
    if !root.join(SUMMARY).is_file() {
        return Ok(BTreeSet::new());
    }
    let page = Page::read(root, Path::new(SUMMARY))?;
    let links = page.events().filter_map(|(event, _)| match event {
        Event::Start(Tag::Link { dest_url, .. }) => tidy(&Path::new(BOOK).join(&*dest_url)),
        _ => None,
    });
    Ok(links.collect())
}

/// Pages of the book that the table of contents leaves out.
fn unlisted(root: &Path, listed: &BTreeSet<PathBuf>) -> Result<Vec<Finding>, DocsError> {
    let pages = crate::pages::all(root)?.into_iter().filter(|file| file.starts_with(BOOK));
    let missing = pages.filter(|file| file != Path::new(SUMMARY) && !listed.contains(file));
    let text = "SUMMARY.md does not list this page, so the book leaves it out".to_string();
    Ok(missing.map(|file| Finding { file, line: 1, text: text.clone() }).collect())
}
