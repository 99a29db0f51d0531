//! Renews what stands between the marks from the results, or says where it differs.

use crate::error::{DocsError, Finding, none_found};
use crate::marks::{Mark, marks};
use crate::pages::Page;
use crate::results::{FILE, Results};
use std::path::{Path, PathBuf};

/// The text of a page with what stands between its marks renewed, and the differences. Errors of marks come first: with
/// any of them nothing is renewed.
///
/// # Errors
/// Marks that are not closed, keys that the results do not have.
pub fn renewed(page: &Page, results: &Results) -> Result<(String, Vec<Finding>), DocsError> {
    let (marks, mut wrong) = marks(page);
    let mut text = page.text.clone();
    let mut differences = Vec::new();
    // From the end, so that bytes before stay where they are.
    for mark in marks.iter().rev() {
        let finding = |text: String| Finding { file: page.file.clone(), line: mark.line, text };
        let old = &page.text[mark.inside.clone()];
        match content(mark, results) {
            Err(problem) => wrong.push(finding(problem)),
            Ok(new) if new != old => {
                differences.push(finding(format!(
                    "'{}' is '{}' in the text, '{}' in {FILE}: run msdd-docs fill",
                    mark.key,
                    old.trim(),
                    new.trim()
                )));
                text.replace_range(mark.inside.clone(), &new);
            }
            Ok(_) => {}
        }
    }
    none_found(wrong)?;
    Ok((text, differences))
}

/// What has to stand between a pair of marks.
fn content(mark: &Mark, results: &Results) -> Result<String, String> {
    if let Some(range) = mark.key.strip_prefix("range:") {
        let (name, rest) = range.split_once('@').unwrap_or((range, ""));
        let (column, row) = rest.split_once('@').unwrap_or((rest, ""));
        let found = results.table(name).and_then(|table| table.range(column, row));
        return found
            .ok_or_else(|| format!("{FILE} has no numbers '{range}', table@column or table@column@row"));
    }
    let Some(name) = mark.table() else {
        let unknown = || format!("{FILE} has no number '{}'", mark.key);
        return results.value(&mark.key).map(|value| value.value.clone()).ok_or_else(unknown);
    };
    let table = results.table(name).ok_or_else(|| format!("{FILE} has no table '{name}'"))?;
    if !mark.own_line {
        return Err(format!("both marks of 'table:{name}' have to stand on lines of their own"));
    }
    // Empty lines around it, or the marks would be taken for part of the table.
    Ok(format!("\n\n{}\n", table.markdown()))
}

/// Renews the files, or with `check` only compares them; returns those that were written.
///
/// # Errors
/// Everything that is wrong in any of the files; then no file is written.
pub fn fill(root: &Path, files: &[PathBuf], check: bool) -> Result<Vec<PathBuf>, DocsError> {
    let mut results = None;
    let (mut findings, mut changed) = (Vec::new(), Vec::new());
    for file in files {
        let page = Page::read(root, file)?;
        if !page.text.contains("<!--=") && !page.text.contains("<!--/-->") {
            continue;
        }
        let known = match &results {
            Some(known) => known,
            None => results.insert(Results::read(root)?),
        };
        match renewed(&page, known) {
            Ok((_, differences)) if check => findings.extend(differences),
            Ok((text, differences)) if !differences.is_empty() => changed.push((file.clone(), text)),
            Ok(_) => {}
            Err(DocsError::Found(found)) => findings.extend(found),
            Err(error) => return Err(error),
        }
    }
    none_found(findings)?;
    for (file, text) in &changed {
        msdd_files::write(&root.join(file), text.as_bytes())?;
    }
    Ok(changed.into_iter().map(|(file, _)| file).collect())
}
