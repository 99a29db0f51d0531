//! Columns of tables, from the lists of name, unit and meaning that write them: `FILE`, whose `row!` it is, or `FILE CONSTANT`.

use super::source::{all, first};
use super::table::table;
use crate::error::DocsError;
use std::path::Path;

/// # Errors
/// A file that cannot be read, or that has no such list.
pub fn text(root: &Path, argument: &str) -> Result<String, DocsError> {
    let (file, name) = argument.split_once(' ').unwrap_or((argument, ""));
    let text = msdd_files::read_text(&root.join(file))?;
    let rows = match name {
        "" => all(r#"(?m)^    (\w+): [\w<>]+, "(?:INTEGER|REAL|TEXT)", "([^"]*)", "([^"]*)";"#, &text),
        _ => {
            let list = first(&format!(r"(?s)\bconst {name}: \[[^=]*= \[(.*?)\n?\];"), &text);
            all(r#"\(\s*"([^"]*)",\s*"([^"]*)",\s*"((?:[^"\\]|\\.)*)",?\s*\)"#, &list.unwrap_or_default())
        }
    };
    if rows.is_empty() {
        return Err(DocsError::Print(format!("{file}: no columns {name}")));
    }
    let rows: Vec<Vec<String>> = rows
        .into_iter()
        .map(|row| vec![format!("`{}`", row[1].replace(", ", "`, `")), row[2].clone(), row[3].clone()])
        .collect();
    Ok(table(&["name", "unit", "meaning"], &rows))
}
