//! Paths of the repository that are named in backticks.

use crate::pages::Page;
use pulldown_cmark::{Event, Tag, TagEnd};
use std::path::Path;

/// Folders of the checkout whose paths are checked.
const FOLDERS: [&str; 7] = ["cases", "rust", "scripts", "tests", "docs", "openfoam", ".ci"];
/// What runs leave behind below them: not in the repository.
const MADE: [&str; 7] =
    ["postProcessing", "show.html", "VTK", "polyMesh", "dynamicCode", "platforms", "lnInclude"];

/// The blocks of code of a page: what its commands make is no path of the repository, but may be named.
pub fn made_by_the_reader(page: &Page) -> String {
    let (mut blocks, mut inside) = (String::new(), false);
    for (event, _) in page.events() {
        match event {
            Event::Start(Tag::CodeBlock(_)) => inside = true,
            Event::End(TagEnd::CodeBlock) => inside = false,
            Event::Text(text) if inside => blocks.push_str(&text),
            _ => {}
        }
    }
    blocks
}

/// What is wrong with a piece of code in a line of the file `file`, if it begins with a path of this repository. Paths are
/// those of the checkout or, as in READMEs of crates, of the file's own folder. `*` stands for any part of a name. Folders of
/// cases that are named in `blocks`, the page's blocks of code, too, are the reader's own.
pub fn problem(root: &Path, file: &Path, code: &str, blocks: &str) -> Option<String> {
    let path = code.split_whitespace().next()?.trim_end_matches(['/', ',', ';', ':', '.']);
    // A place in a file: path:line.
    let path = path.split(':').next()?;
    let (first, rest) = path.split_once('/')?;
    if !FOLDERS.contains(&first) || rest.is_empty() || !path.chars().all(plain) {
        return None;
    }
    let parts: Vec<&str> = path.split('/').collect();
    let own = first == "cases"
        && blocks.contains(&format!("cases/{}", parts[1]))
        && !root.join("cases").join(parts[1]).exists();
    if own || parts.iter().any(|part| made(part)) {
        return None;
    }
    let here = file.parent().unwrap_or(Path::new(""));
    let found = exists(root, &parts) || exists(&root.join(here), &parts);
    (!found).then(|| format!("`{path}` is named, but the checkout has no such path"))
}

/// Characters of paths that are meant as they stand: no <placeholders>, {choices} or ….
fn plain(c: char) -> bool {
    c.is_ascii_alphanumeric() || "._-/*=+".contains(c)
}

/// Names of what runs write: those above, logs, processors, times.
fn made(part: &str) -> bool {
    let time = part != "0" && part.parse::<f64>().is_ok();
    MADE.contains(&part) || part.starts_with("log.") || part.starts_with("processor") || time
}

fn exists(folder: &Path, parts: &[&str]) -> bool {
    let Some((part, rest)) = parts.split_first() else { return folder.exists() };
    if !part.contains('*') {
        return exists(&folder.join(part), rest);
    }
    let Ok(entries) = std::fs::read_dir(folder) else { return false };
    let names = entries.flatten().map(|entry| entry.file_name().to_string_lossy().into_owned());
    names.filter(|name| fits(part, name)).any(|name| exists(&folder.join(name), rest))
}

/// Whether a name fits a pattern in which * stands for any characters.
fn fits(pattern: &str, name: &str) -> bool {
    match pattern.split_once('*') {
        None => pattern == name,
        Some((before, after)) => name.strip_prefix(before).is_some_and(|rest| {
            rest.char_indices().map(|(k, _)| k).chain([rest.len()]).any(|k| fits(after, &rest[k..]))
        }),
    }
}

/// What is wrong with a path in the built book below rustdoc: a page of a crate that there is none of.
pub fn rustdoc(root: &Path, inside: &Path) -> Option<String> {
    let mut parts = inside.iter().map(|part| part.to_string_lossy().into_owned());
    if parts.next()? != "rustdoc" {
        return None;
    }
    let name = parts.next().filter(|name| name != "index.html")?;
    let folder = name.strip_prefix("msdd_").unwrap_or_default();
    let of_library = name == "msdd" && root.join("rust/capi").is_dir();
    let there = of_library || (!folder.is_empty() && root.join("rust").join(folder).is_dir());
    (!there).then(|| format!("rustdoc has no crate {name}"))
}
