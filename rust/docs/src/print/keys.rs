//! Keys of the solver's dictionaries and columns of its tables, from the `keyTable`s in the C++ sources, which are read as
//! text: `keyTable NAME ( "name in the book", { { "key", "meaning", … }, … } )`.

use super::source::{all, regex};
use crate::error::DocsError;
use crate::pages::collect;
use std::path::Path;

/// Strings of an entry: name, meaning, unit; of a key also allowed values and default, and the types that it is for.
pub type Entry = Vec<String>;

/// The table of this name as Markdown, with a header for keys or for columns.
///
/// # Errors
/// A name that no table has, and sources that cannot be read.
pub fn text(root: &Path, argument: &str) -> Result<String, DocsError> {
    let tables = tables(root)?;
    let Some((_, entries)) = tables.iter().find(|(name, _)| name == argument) else {
        let names: Vec<&str> = tables.iter().map(|(name, _)| name.as_str()).collect();
        return Err(DocsError::Print(format!(
            "no keyTable below openfoam is called '{argument}', allowed: {}",
            names.join(", ")
        )));
    };
    let keys = entries.iter().any(|entry| entry.len() > 3);
    let mut lines = vec![match keys {
        true => "| key | meaning | unit | allowed | default |\n|---|---|---|---|---|".to_string(),
        false => "| column | meaning | unit |\n|---|---|---|".to_string(),
    }];
    lines.extend(entries.iter().map(|entry| row(entry, keys)));
    Ok(lines.join("\n") + "\n")
}

/// Name and entries of every table below openfoam, in the order of the files.
///
/// # Errors
/// A file or folder that cannot be read.
pub fn tables(root: &Path) -> Result<Vec<(String, Vec<Entry>)>, DocsError> {
    let mut files = Vec::new();
    let wanted = |file: &Path| file.extension().is_some_and(|extension| extension == "C");
    collect(root, Path::new("openfoam"), &wanted, &mut files)?;
    files.sort();
    let mut found = Vec::new();
    for file in files {
        found.extend(tables_of(&msdd_files::read_text(&root.join(file))?));
    }
    Ok(found)
}

/// The tables of a source: of its code only string literals are kept as they are, adjacent ones as one.
fn tables_of(source: &str) -> Vec<(String, Vec<Entry>)> {
    let [no_code, adjacent] =
        [r#"//.*|(?s:/\*.*?\*/)|'(?:\\.|[^'\\])'|("(?s:\\.|[^"\\])*")"#, r#""\s+""#].map(regex);
    let code = adjacent.replace_all(&no_code.replace_all(source, "$1"), "").into_owned();
    let tables = all(r#"(?s)\bkeyTable [\w:]+\s*\(\s*"([^"]*)",\s*\{(.*?)\}\s*\)\s*;"#, &code);
    let texts = |entry: &Vec<String>| {
        let texts = all(r#""((?:\\.|[^"\\])*)""#, &entry[0]);
        texts.into_iter().map(|text| text[1].replace('\\', "")).collect()
    };
    let entries =
        |table: &str| all(r#"\{(?:[^{}"]|"(?:\\.|[^"\\])*")*\}"#, table).iter().map(texts).collect();
    tables.into_iter().map(|table| (table[1].clone(), entries(&table[2]))).collect()
}

fn row(entry: &Entry, keys: bool) -> String {
    let at = |k: usize| entry.get(k).map_or("", String::as_str);
    let of = match at(5) {
        "" => String::new(),
        types => format!("of `{}`: ", types.replace(" or ", "`, `")),
    };
    let mut cells = vec![format!("`{}`", at(0)), of + at(1), at(2).replace('-', "–")];
    if keys {
        let words: Vec<&str> = at(3).split(", ").collect();
        let word = |text: &&str| text.chars().all(|c| c.is_alphanumeric() || c == ':') && !text.is_empty();
        let listed =
            words.iter().all(|text| word(text) && !text.starts_with(char::is_numeric)) && at(3) != "any";
        let quoted = |text: &&str| format!("`{text}`");
        cells.push(if listed {
            words.iter().map(quoted).collect::<Vec<_>>().join(", ")
        } else {
            at(3).to_string()
        });
        cells.push(if listed && words.contains(&at(4)) { quoted(&at(4)) } else { at(4).to_string() });
    }
    format!("| {} |", cells.iter().map(|cell| escaped(cell)).collect::<Vec<_>>().join(" | "))
}

/// Outside of code `<` and `*` are no marks of Markdown; `|` ends no cell.
fn escaped(cell: &str) -> String {
    let plain = |(k, part): (usize, &str)| match k % 2 {
        0 => part.replace('<', "&lt;").replace('*', "\\*"),
        _ => part.to_string(),
    };
    cell.replace('|', "\\|").split('`').enumerate().map(plain).collect::<Vec<_>>().join("`")
}
