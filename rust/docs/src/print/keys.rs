//! Keys of the solver's dictionaries and columns of its tables, from the `keyTable`s in the C++ sources, which are read as
//! text: `keyTable NAME ( "name in the book", { { "key", "meaning", … }, … } )`.

use crate::error::DocsError;
use std::path::{Path, PathBuf};

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
    walk(&root.join("openfoam"), &mut files)?;
    files.sort();
    let mut found = Vec::new();
    for file in files {
        found.extend(tables_of(&msdd_files::read_text(&file)?));
    }
    Ok(found)
}

fn walk(folder: &Path, files: &mut Vec<PathBuf>) -> Result<(), DocsError> {
    let failed = |source| DocsError::Folder { folder: folder.to_path_buf(), source };
    for entry in std::fs::read_dir(folder).map_err(failed)? {
        let path = entry.map_err(failed)?.path();
        if path.is_dir() && !path.ends_with("lnInclude") {
            walk(&path, files)?;
        } else if path.extension().is_some_and(|extension| extension == "C") {
            files.push(path);
        }
    }
    Ok(())
}

/// A piece of C++, as far as tables need it.
#[derive(PartialEq)]
enum Piece {
    Word(String),
    Text(String),
    Mark(char),
}

/// Words, string literals (adjacent ones as one) and marks; no comments.
fn pieces(source: &str) -> Vec<Piece> {
    let mut found = Vec::new();
    let mut rest = source;
    while let Some(first) = rest.chars().next() {
        let length = if rest.starts_with("//") {
            rest.find('\n').unwrap_or(rest.len())
        } else if rest.starts_with("/*") {
            rest.find("*/").map_or(rest.len(), |end| end + 2)
        } else if first == '"' {
            let (literal, length) = literal(&rest[1..]);
            match found.last_mut() {
                Some(Piece::Text(text)) => text.push_str(&literal),
                _ => found.push(Piece::Text(literal)),
            }
            length + 1
        } else if first == '\'' {
            rest[1..].replace("\\'", "__").find('\'').map_or(1, |end| end + 2)
        } else if first.is_alphanumeric() || first == '_' {
            let end = rest.find(|c: char| !c.is_alphanumeric() && c != '_').unwrap_or(rest.len());
            found.push(Piece::Word(rest[..end].to_string()));
            end
        } else {
            if !first.is_whitespace() {
                found.push(Piece::Mark(first));
            }
            first.len_utf8()
        };
        rest = &rest[length..];
    }
    found
}

/// A string literal after its opening quotation mark, and its length there.
fn literal(rest: &str) -> (String, usize) {
    let mut text = String::new();
    let mut escaped = false;
    for (k, c) in rest.char_indices() {
        match c {
            '\\' if !escaped => escaped = true,
            '"' if !escaped => return (text, k + 1),
            _ => {
                text.push(c);
                escaped = false;
            }
        }
    }
    (text, rest.len())
}

/// The tables of a source.
fn tables_of(source: &str) -> Vec<(String, Vec<Entry>)> {
    let pieces = pieces(source);
    let starts = (0..pieces.len()).filter(|&k| pieces[k] == Piece::Word("keyTable".to_string()));
    starts.filter_map(|start| table_at(&pieces[start + 1..])).collect()
}

/// The table of a definition, after the word `keyTable`; none if it is something else.
fn table_at(pieces: &[Piece]) -> Option<(String, Vec<Entry>)> {
    let name = |piece: &&Piece| matches!(piece, Piece::Word(_) | Piece::Mark(':'));
    let begin = pieces.iter().take_while(name).count();
    let [Piece::Mark('('), Piece::Text(name), Piece::Mark(','), Piece::Mark('{'), inside @ ..] =
        &pieces[begin..]
    else {
        return None;
    };
    let mut entries = Vec::new();
    let mut depth = 1;
    for piece in inside {
        match piece {
            Piece::Mark('{') => {
                depth += 1;
                entries.push(Entry::new());
            }
            Piece::Mark('}') => depth -= 1,
            Piece::Text(text) => entries.last_mut()?.push(text.clone()),
            _ => (),
        }
        if depth == 0 {
            break;
        }
    }
    Some((name.clone(), entries))
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tables_are_read_from_definitions_alone() {
        let source = r#"
            class keyTable; // keyTable no ("no", {})
            static const keyTable a::keys
            (
                "walls",    // in the book
                {
                    {"slip", "way \"s\" of"
                     " grains", "m", "2e-7 r to 2 r", "13 r", "rigid or shell"},
                    {"kind", "", "-", "one, two", "two"}
                }
            );
            keys.number(dict, "slip", '"', 1);
        "#;
        let tables = tables_of(source);
        assert_eq!(tables.len(), 1);
        assert_eq!(tables[0].0, "walls");
        assert_eq!(tables[0].1[0][1], "way \"s\" of grains");
        let rows: Vec<String> = tables[0].1.iter().map(|entry| row(entry, true)).collect();
        assert_eq!(
            rows[0],
            "| `slip` | of `rigid`, `shell`: way \"s\" of grains | m | 2e-7 r to 2 r | 13 r |"
        );
        assert_eq!(rows[1], "| `kind` |  | – | `one`, `two` | `two` |");
    }
}
