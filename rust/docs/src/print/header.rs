//! The C interface, from `msdd.h` and its comments. The header has sections, which begin with `/* ---- title */`; what stands
//! before the first is the section 'library'.

use super::markdown::{prose, table};
use crate::error::DocsError;
use std::fmt::Write;
use std::path::Path;

pub const FILE: &str = "rust/capi/include/msdd.h";
const FIRST: &str = "library";

/// One declaration with its comment.
struct Item<'a> {
    comment: &'a str,
    code: &'a str,
}

/// All declarations of a section of the header.
///
/// # Errors
/// A section that the header does not have.
pub fn text(root: &Path, argument: &str) -> Result<String, DocsError> {
    let header = msdd_files::read_text(&root.join(FILE))?;
    let sections = sections(&header);
    let Some((_, section)) = sections.iter().find(|(title, _)| *title == argument) else {
        let titles: Vec<&str> = sections.iter().map(|(title, _)| *title).collect();
        let text = format!("{FILE} has no section '{argument}', allowed: {}", titles.join(", "));
        return Err(DocsError::Print(text));
    };
    let names: Vec<&str> =
        sections.iter().flat_map(|(_, body)| items(body)).filter_map(|item| name(&item)).collect();
    let plain = |text: &str| prose(text, is_code, |code| names.contains(&code).then(|| code.to_lowercase()));
    Ok(items(section).iter().map(|item| shown(item, &plain)).collect())
}

/// Titles and texts of the sections.
fn sections(header: &str) -> Vec<(&str, &str)> {
    let begin = header.find("extern \"C\" {\n#endif").map_or(0, |at| at + 19);
    let end = header.rfind("#ifdef __cplusplus").unwrap_or(header.len());
    let mut parts = header[begin..end].split("/* -----");
    let first = parts.next().map(|text| (FIRST, text));
    let others = parts.filter_map(|part| {
        let (title, text) = part.split_once("*/")?;
        Some((title.trim_matches(['-', ' ']), text))
    });
    first.into_iter().chain(others).collect()
}

/// The declarations, and comments between them that stand for themselves.
fn items(section: &str) -> Vec<Item<'_>> {
    let mut items = Vec::new();
    let mut comment = "";
    let mut rest = section.trim_start();
    while !rest.is_empty() {
        let taken = if rest.starts_with("/*") {
            let (text, after) = rest.split_at(rest.find("*/").map_or(rest.len(), |at| at + 2));
            match text.starts_with("/**") {
                true => comment = text,
                false => items.push(Item { comment: text, code: "" }),
            }
            after
        } else if rest.starts_with("#") && !rest.starts_with("#define") {
            // Conditions, and what stands between them, are for the preprocessor alone.
            rest.split_once("#endif").map_or("", |(_, after)| after)
        } else {
            let (code, after) = rest.split_at(length(rest));
            items.push(Item { comment: std::mem::take(&mut comment), code: code.trim() });
            after
        };
        rest = taken.trim_start();
    }
    items
}

/// Bytes of the declaration that the text begins with: a line of the preprocessor, or all to the `;` behind its braces.
fn length(text: &str) -> usize {
    if text.starts_with('#') {
        return text.find('\n').unwrap_or(text.len());
    }
    let braces = text.find('{').filter(|open| text.find(';').is_some_and(|end| *open < end));
    let from = braces.and_then(|_| text.find("\n}")).unwrap_or(0);
    text[from..].find(';').map_or(text.len(), |end| from + end + 1)
}

/// What an item declares: a constant, a type or a function.
fn name<'a>(item: &Item<'a>) -> Option<&'a str> {
    if let Some(constant) = item.code.strip_prefix("#define") {
        return constant.split_whitespace().next();
    }
    let head = item.code.split(['{', ';']).next()?;
    let before = match head.split_once("(*") {
        Some((_, pointer)) => pointer.split(')').next()?,
        None => head.split('(').next()?,
    };
    before.split([' ', '*', '\n']).rfind(|word| !word.is_empty())
}

fn is_code(word: &str) -> bool {
    ["msdd_", "MSDD_", "libmsdd"].iter().any(|begin| word.starts_with(begin))
        || ["NULL", "struct_size", "state_size", "int32_t", "sizeof"].contains(&word)
        || (word.starts_with('*') && word[1..].starts_with(char::is_alphabetic))
}

fn shown(item: &Item, plain: &dyn Fn(&str) -> String) -> String {
    let comment = plain(&cleaned(item.comment));
    let Some(name) = name(item) else { return format!("{comment}\n\n") };
    let body = item.code.split_once('{').and_then(|(_, rest)| rest.rsplit_once('}'));
    let mut out = format!("### {name}\n\n");
    match body {
        // Of a structure or an enumeration the table says all.
        Some((body, _)) => {
            let titles = if item.code.starts_with("enum") { ["name", "value"] } else { ["field", "type"] };
            let _ = writeln!(
                out,
                "{comment}\n\n{}",
                table(&[titles[0], titles[1], "meaning"], &rows(body, plain))
            );
        }
        None => {
            let _ = writeln!(out, "```c\n{}\n```\n\n{comment}\n", item.code);
        }
    }
    out
}

/// Members of a structure or values of an enumeration. A member without a comment shares that of the one before it.
fn rows(body: &str, plain: &dyn Fn(&str) -> String) -> Vec<Vec<String>> {
    let mut rows: Vec<Vec<String>> = Vec::new();
    let mut before = String::new();
    for part in format!("*/{body}").split("/*") {
        let (comment, code) = part.split_once("*/").unwrap_or((part, ""));
        let text = plain(&cleaned(comment));
        if comment.starts_with("*<") {
            rows.last_mut().into_iter().for_each(|row| row[2].clone_from(&text));
        } else if comment.starts_with('*') {
            before = text;
        } else if !comment.is_empty() {
            rows.push(vec![" ".into(), " ".into(), format!("*{text}*")]);
        }
        for member in code.split([';', '\n']).map(str::trim).filter(|member| !member.is_empty()) {
            let [name, kind] = member_of(member.trim_end_matches(','));
            rows.push(vec![name, kind, std::mem::take(&mut before)]);
        }
    }
    let mut merged: Vec<Vec<String>> = Vec::new();
    for row in rows {
        match merged.last_mut().filter(|last| row[2].is_empty() && last[1] == row[1]) {
            Some(last) => last[0] += &format!(", {}", row[0]),
            None => merged.push(row),
        }
    }
    merged
}

/// Name and type of a member, or name and value.
fn member_of(member: &str) -> [String; 2] {
    if let Some((name, value)) = member.split_once(" = ") {
        return [format!("`{name}`"), value.to_string()];
    }
    let name = match member.split_once("(*") {
        Some((_, rest)) => rest.split(')').next().unwrap_or_default(),
        None => member.rsplit([' ', '*']).next().unwrap_or_default(),
    };
    let kind = match member.contains("(*") {
        true => member.to_string(),
        false => member[..member.len() - name.len()].trim().to_string(),
    };
    [format!("`{name}`"), format!("`{kind}`")]
}

/// The text of a comment without its marks: a paragraph or an item of a list is one line.
fn cleaned(comment: &str) -> String {
    let inside = comment
        .trim_start_matches("/*")
        .trim_start_matches('*')
        .trim_start_matches('<')
        .trim_end_matches("*/");
    let mut out = String::new();
    let mut in_list = false;
    for line in inside.trim().lines() {
        let line = line.trim_start().strip_prefix('*').unwrap_or(line);
        let (indent, text) = (line.len() - line.trim_start().len(), line.trim());
        let starts = text.starts_with("- ");
        let join = if text.is_empty() || (in_list && !starts && indent < 4) {
            "\n\n"
        } else if starts {
            "\n"
        } else if out.is_empty() || out.ends_with('\n') {
            ""
        } else {
            " "
        };
        in_list = starts || (in_list && join == " ");
        let _ = write!(out, "{join}{text}");
    }
    out
}
