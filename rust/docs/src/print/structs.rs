//! Keys of files, from the structs that serde reads and writes: `FILE STRUCT...`; `FILE STRUCT... entries` without what is
//! allowed; `FILE ENUM` for its names; `FILE` for the comment at its head.
//!
//! The comment of a field is its meaning, with the unit in brackets; sentences `Allowed: ...` and `Default: ...` at its end
//! become cells. There, the name of a constant in backticks stands for its value.

use super::source::{Source, all, body, first, number};
use super::table::table;
use crate::error::DocsError;
use std::path::Path;

/// A field as the source has it.
struct Field {
    name: String,
    kind: String,
    attributes: String,
    comment: String,
}

/// # Errors
/// A file that cannot be read, or that has no such struct or enum.
pub fn text(root: &Path, argument: &str) -> Result<String, DocsError> {
    let mut names: Vec<&str> = argument.split_whitespace().collect();
    let entries = names.last() == Some(&"entries");
    names.truncate(names.len() - usize::from(entries));
    let Some((file, names)) = names.split_first() else {
        return Err(DocsError::Print("a file and the names of structs are needed".to_string()));
    };
    let source = Source::read(root, file)?;
    if names.is_empty() {
        let lines: Vec<&str> = source.text().lines().map_while(|line| line.strip_prefix("//!")).collect();
        return Ok(lines.iter().map(|line| line.trim()).collect::<Vec<_>>().join("\n"));
    }
    let mut rows = Vec::new();
    for name in names {
        if let Some(body) = first(&body(&format!("enum {name}")), source.text()) {
            let rows: Vec<Vec<String>> = variants(&body)
                .into_iter()
                .map(|(name, comment)| vec![format!("`{name}`"), comment])
                .collect();
            return Ok(table(&["name", "meaning"], &rows));
        }
        for field in fields(&source.body(&format!("struct {name}"))?) {
            rows.push(row(&source, name, &field, entries)?);
        }
    }
    Ok(table(&["key", "meaning", "unit", "allowed", "default"], &rows))
}

fn fields(body: &str) -> Vec<Field> {
    let mut found = Vec::new();
    let (mut attributes, mut comment) = (String::new(), String::new());
    for line in body.lines().map(str::trim) {
        if let Some(text) = line.strip_prefix("///") {
            comment = format!("{comment} {}", text.trim());
        } else if line.starts_with("#[") {
            attributes += line;
        } else if let Some(groups) = all(r"^(?:pub(?:\([^)]*\))? )?(\w+): (.*),$", line).first() {
            let renamed = first(r#"rename = "(\w+)""#, &attributes);
            let field = Field {
                name: renamed.unwrap_or_else(|| groups[1].clone()),
                kind: groups[2].clone(),
                attributes: std::mem::take(&mut attributes),
                comment: std::mem::take(&mut comment),
            };
            if !field.attributes.contains("serde(skip)") {
                found.push(field);
            }
        }
    }
    found
}

fn row(source: &Source, name: &str, field: &Field, entries: bool) -> Result<Vec<String>, DocsError> {
    let comment = field.comment.replace("\\[", "[").replace("\\]", "]");
    let clause = |key: &str| first(&format!(r"{key}: (.*?)\.?(?: (?:Allowed|Default): |$)"), &comment);
    let meaning = first(r"^(.*?)(?: ?(?:Allowed|Default): |$)", &comment).unwrap_or_default();
    let unit = first(r" \[([^\]]+)\](?:[^(]|$)", &format!("{meaning} ")).unwrap_or_default();
    let meaning = meaning.replace(&format!(" [{unit}]"), "");
    let meaning = meaning.trim();
    let meaning = meaning.strip_suffix('.').unwrap_or(meaning).to_string();
    if meaning.is_empty() {
        let problem = format!("{}: {name}.{} has no comment", source.file.display(), field.name);
        return Err(DocsError::Print(problem));
    }
    let mut row = vec![format!("`{}`", field.name), meaning, unit];
    if entries {
        row.extend([String::new(), String::new()]);
        return Ok(row);
    }
    let allowed = clause("Allowed").map(|text| with_constants(source, &text)).transpose()?;
    let default = clause("Default").map(|text| with_constants(source, &text)).transpose()?;
    row.push(allowed.or_else(|| names_of(source, &field.kind)).unwrap_or_default());
    row.push(match default {
        Some(text) => text,
        None => default_of(source, name, field)?,
    });
    Ok(row)
}

/// The text with the values of constants instead of their names.
fn with_constants(source: &Source, text: &str) -> Result<String, DocsError> {
    let mut made = text.to_string();
    for found in all(r"`([A-Z][A-Z0-9_]+)`", text) {
        made = made.replace(&found[0], &source.constant(&found[1])?);
    }
    Ok(made)
}

/// What a field may be if its type is an enumeration or a bool.
fn names_of(source: &Source, kind: &str) -> Option<String> {
    let inner = inner(kind);
    if inner == "bool" {
        return Some("`true`, `false`".to_string());
    }
    if !inner.starts_with(|c: char| c.is_ascii_uppercase()) || ["String", "PathBuf"].contains(&inner.as_str())
    {
        return None;
    }
    // A struct that is nearer has the name.
    source.find(&inner, &format!(r"(?m)^(?:pub )?(enum|struct) {inner}\b")).filter(|kind| kind == "enum")?;
    let names: Vec<String> = variants(&source.find(&inner, &body(&format!("enum {inner}")))?)
        .into_iter()
        .map(|(name, _)| format!("`{name}`"))
        .collect();
    (!names.is_empty()).then(|| names.join(", "))
}

/// The type within lists and options.
fn inner(kind: &str) -> String {
    let inner = first(r"^(?:Vec|Option)<(.*)>$", kind);
    inner.map_or_else(|| kind.rsplit("::").next().unwrap_or(kind).to_string(), |kind| self::inner(&kind))
}

/// Names that serde gives to the variants without fields, with their comments.
fn variants(body: &str) -> Vec<(String, String)> {
    all(r"(?m)((?:^ +(?:///|#\[)[^\n]*\n)*)^ +([A-Z]\w*),$", body)
        .into_iter()
        .map(|groups| {
            let comment: Vec<String> =
                all(r"/// ?([^\n]*)", &groups[1]).into_iter().map(|g| g[1].clone()).collect();
            let comment = comment.join(" ").replace("\\[", "[").replace("\\]", "]");
            (snake(&groups[2]), comment.trim_end_matches('.').to_string())
        })
        .collect()
}

fn snake(variant: &str) -> String {
    let parts = all("[A-Z][a-z0-9]*", variant);
    parts.iter().map(|part| part[0].to_lowercase()).collect::<Vec<_>>().join("_")
}

/// What holds where a file does not have the field.
fn default_of(source: &Source, name: &str, field: &Field) -> Result<String, DocsError> {
    if let Some(function) = first(r#"default = "(\w+)""#, &field.attributes) {
        let found = source.find(&function, &format!(r"fn {function}\(\) -> [^\{{]*\{{\s+(\S+)\s+\}}"));
        let value = found
            .ok_or_else(|| DocsError::Print(format!("{}: no value in {function}", source.file.display())))?;
        return value_of(source, &value);
    }
    if let Some(value) =
        first(&format!(r"(?ms)^impl Default for {name} \{{.*?^ +{}: ([^\n]*),$", field.name), source.text())
    {
        return value_of(source, &value);
    }
    Ok(match field.kind.as_str() {
        kind if kind.starts_with("Option<") => "none".to_string(),
        _ if !field.attributes.contains("default") => "required".to_string(),
        "bool" => "`false`".to_string(),
        kind if kind.starts_with("Vec<") => "none".to_string(),
        "f64" | "u64" | "u32" | "usize" => "0".to_string(),
        kind => {
            let kind = inner(kind);
            let body = source.find(&kind, &body(&format!("enum {kind}"))).unwrap_or_default();
            let variant = first(r"#\[default\]\s+(\w+),", &body);
            variant.map_or_else(String::new, |variant| format!("`{}`", snake(&variant)))
        }
    })
}

/// A literal, a constant, or a variant.
fn value_of(source: &Source, value: &str) -> Result<String, DocsError> {
    match value.rsplit_once("::") {
        Some((_, variant)) => Ok(format!("`{}`", snake(variant))),
        None if value.starts_with(|c: char| c.is_ascii_uppercase()) => source.constant(value),
        None => Ok(number(value)),
    }
}
