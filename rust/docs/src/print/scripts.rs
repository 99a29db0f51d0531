//! Scripts, from the comments at their heads.

use super::markdown::prose;
use crate::error::DocsError;
use std::fmt::Write;
use std::path::Path;

/// A section for each script: paths from the root with blanks between; a path that ends in `/*` stands for all files of a folder.
///
/// # Errors
/// A script that is missing or has no comment at its head.
pub fn text(root: &Path, argument: &str) -> Result<String, DocsError> {
    let mut paths = Vec::new();
    for path in argument.split_whitespace() {
        match path.strip_suffix("/*") {
            Some(folder) => {
                let failed = |source| DocsError::Folder { folder: folder.into(), source };
                let entries = std::fs::read_dir(root.join(folder)).map_err(failed)?.flatten();
                let mut names: Vec<String> = entries
                    .map(|entry| format!("{folder}/{}", entry.file_name().to_string_lossy()))
                    .collect();
                names.sort();
                paths.append(&mut names);
            }
            None => paths.push(path.to_string()),
        }
    }
    paths.iter().map(|path| section(path, &msdd_files::read_text(&root.join(path))?)).collect()
}

fn section(path: &str, script: &str) -> Result<String, DocsError> {
    let head = script.lines().skip_while(|line| line.starts_with("#!"));
    let head: Vec<&str> = head.map_while(|line| line.strip_prefix('#')).collect();
    if head.iter().all(|line| line.trim().is_empty()) {
        return Err(DocsError::Print(format!("{path} has no comment at its head that says what it does")));
    }
    let mut out = format!("### {path}\n");
    let mut in_code = false;
    for line in head {
        // Indented lines are calls and lists.
        let code = line.starts_with("  ") || (in_code && line.trim().is_empty());
        if code != in_code {
            out += if code { "\n```text\n" } else { "```\n\n" };
            in_code = code;
        }
        let line = if code {
            line.get(3..).unwrap_or_default().to_string()
        } else {
            prose(line.trim(), is_code, |_| None)
        };
        let _ = writeln!(out, "{line}");
    }
    Ok(out.replace("\n\n```\n", "\n```\n") + if in_code { "```\n\n" } else { "\n" })
}

fn is_code(word: &str) -> bool {
    const BEGINNINGS: [&str; 9] =
        ["scripts/", "cases/", "results/", "report/", "openfoam/", "docs/", "rust/", ".cache", "--"];
    BEGINNINGS.iter().any(|begin| word.starts_with(begin)) && word.len() > 2 || word.starts_with("MSDD_")
}
