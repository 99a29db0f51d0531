//! The Python package, from signatures and docstrings of its public names: `NAME...`, each under a heading; `table NAME...` as
//! one table, for exceptions. Sections of docstrings are those of NumPy.

use super::source::{all, first};
use super::table::{escaped, table};
use crate::error::DocsError;
use crate::pages::collect;
use std::path::Path;

const PACKAGE: &str = "rust/python/msdd";

/// # Errors
/// A module that cannot be read, or a name that none has.
pub fn text(root: &Path, argument: &str) -> Result<String, DocsError> {
    let modules = modules(root)?;
    let mut names = argument.split_whitespace().peekable();
    if names.next_if_eq(&"table").is_some() {
        let rows: Result<Vec<Vec<String>>, DocsError> = names.map(|name| row(&modules, name)).collect();
        return Ok(table(&["name", "also a", "meaning"], &rows?));
    }
    names.map(|name| object(&modules, name)).collect()
}

/// Texts of all modules, one after the other.
fn modules(root: &Path) -> Result<String, DocsError> {
    let mut files = Vec::new();
    collect(root, Path::new(PACKAGE), &|file| file.extension().is_some_and(|e| e == "py"), &mut files)?;
    files.iter().map(|file| Ok(msdd_files::read_text(&root.join(file))?)).collect()
}

/// The source of a function or class.
fn source(modules: &str, name: &str) -> Result<String, DocsError> {
    let found = first(&format!(r"(?ms)^((?:def|class) {name}\b.*?\n)(?:[^\s)]|\z)"), modules);
    found.ok_or_else(|| DocsError::Print(format!("{PACKAGE} has no {name}")))
}

/// A class in one row: its name, what else it is, and its docstring.
fn row(modules: &str, name: &str) -> Result<Vec<String>, DocsError> {
    let text = source(modules, name)?;
    let bases = first(r"^class \w+\(([^)]*)\)", &text).unwrap_or_default();
    let others: Vec<String> = bases.split(", ").skip(1).map(|base| format!("`{base}`")).collect();
    let meaning = on_one_line(&docstring(&text, "    "));
    Ok(vec![format!("`{name}`"), others.join(", "), meaning])
}

/// A function or class under a heading.
fn object(modules: &str, name: &str) -> Result<String, DocsError> {
    let text = source(modules, name)?;
    if text.starts_with("def") {
        return Ok(format!("### {name}\n\n{}", function(&text, "", "    ")));
    }
    let mut page = format!("### {name}\n\n{}", documented(&docstring(&text, "    "), &[]));
    let fields: Vec<[String; 4]> =
        all(r#"(?ms)^    (\w+): ([^=\n]*?)(?: = ([^\n]*))?\n    """(.*?)"""$"#, &text)
            .into_iter()
            .map(|field| [1, 2, 3, 4].map(|k| field[k].clone()))
            .collect();
    let decorators = first(&format!(r"(?m)^((?:@[^\n]*\n)+)class {name}\b"), modules).unwrap_or_default();
    if decorators.contains("@dataclass(frozen=True)") {
        page = page.replacen("\n\n", &format!("\n\n{}\n\n", constructor(name, &fields)), 1);
    }
    let properties =
        all(r#"(?ms)^    @property\n    def (\w+)\(self\) -> ([^\n]*):\n        """(.*?)""""#, &text)
            .into_iter()
            .map(|found| [found[1].clone(), found[2].clone(), String::new(), found[3].clone()]);
    let rows: Vec<Vec<String>> = fields.iter().cloned().chain(properties).map(attribute).collect();
    if !rows.is_empty() {
        page += &(table(&["attribute", "type", "default", "meaning"], &rows) + "\n");
    }
    for method in members(&text).iter().filter(|member| member.starts_with("def ")) {
        page += &function(method, &format!("{name}."), "        ");
    }
    Ok(page)
}

/// Public methods of a class, without those that are properties.
fn members(class: &str) -> Vec<String> {
    let mut parts: Vec<String> = Vec::new();
    for part in class.split("\n\n    ") {
        match parts.last_mut() {
            Some(last) if part.starts_with(' ') => *last += &format!("\n\n    {part}"),
            _ => parts.push(part.strip_prefix("@staticmethod\n    ").unwrap_or(part).to_string()),
        }
    }
    parts.retain(|part| !part.starts_with("def _"));
    parts
}

fn attribute([name, kind, default, text]: [String; 4]) -> Vec<String> {
    let quoted = |text: String| if text.is_empty() { text } else { format!("`{text}`") };
    let text = text.replace("\\\"", "\"");
    vec![quoted(name), quoted(plain(&kind)), quoted(default), on_one_line(&text)]
}

/// How an object is made whose fields are arguments.
fn constructor(name: &str, fields: &[[String; 4]]) -> String {
    let arguments: Vec<String> = fields
        .iter()
        .map(
            |[name, _, default, _]| {
                if default.is_empty() { name.clone() } else { format!("{name}={default}") }
            },
        )
        .collect();
    format!("`{name}({})`", arguments.join(", "))
}

/// Signature, docstring and arguments of a function.
fn function(text: &str, prefix: &str, indent: &str) -> String {
    let head = first(r"(?s)^def (.*?\)(?: -> [^\n]*)?):\n", text).unwrap_or_default();
    let (name, rest) = head.split_once('(').unwrap_or((&head, ""));
    let (inside, answer) = rest.rsplit_once(')').unwrap_or((rest, ""));
    let arguments: Vec<[String; 3]> = separated(inside)
        .into_iter()
        .filter(|argument| argument != "self")
        .map(|argument| {
            let (left, default) = argument.split_once(" = ").unwrap_or((&argument, ""));
            let (name, kind) = left.split_once(": ").unwrap_or((left, ""));
            [name, kind, default].map(|part| part.trim().to_string())
        })
        .collect();
    let short: Vec<String> = arguments
        .iter()
        .map(|[name, _, default]| if default.is_empty() { name.clone() } else { format!("{name}={default}") })
        .collect();
    let answer = plain(answer.trim().trim_start_matches("-> "));
    let answer = if answer == "None" { String::new() } else { format!(" → `{answer}`") };
    let signature = format!("`{prefix}{name}({})`{answer}", short.join(", "));
    format!("{signature}\n\n{}", documented(&docstring(text, indent), &arguments))
}

/// Parts between the commas that stand in no brackets.
fn separated(text: &str) -> Vec<String> {
    let (mut parts, mut depth) = (vec![String::new()], 0);
    for c in text.chars() {
        depth += i32::from("([".contains(c)) - i32::from(")]".contains(c));
        match c {
            ',' if depth == 0 => parts.push(String::new()),
            '\n' => parts.last_mut().expect("one part at least").push(' '),
            _ => parts.last_mut().expect("one part at least").push(c),
        }
    }
    parts.into_iter().map(|part| part.trim().to_string()).filter(|part| !part.is_empty()).collect()
}

/// A type without what the default says already.
fn plain(kind: &str) -> String {
    let inner = first(r"^Optional\[(.*)\]$", kind).or_else(|| first(r"^Union\[(.*), None\]$", kind));
    match inner.unwrap_or_else(|| kind.to_string()).as_str() {
        "Union[str, os.PathLike[str]]" | "PathLike" => "str or path".to_string(),
        "Union[str, float]" => "str or float".to_string(),
        "State" => "dict[str, Array]".to_string(),
        other => other.to_string(),
    }
}

/// The docstring with which a text begins after its head.
fn docstring(text: &str, indent: &str) -> String {
    let found = first(&format!(r#"(?s):\n{indent}"""(.*?)""""#), text);
    lines(&found.unwrap_or_default(), indent)
}

/// Lines without their indentation.
fn lines(text: &str, indent: &str) -> String {
    let lines: Vec<&str> =
        text.trim().lines().map(|line| line.strip_prefix(indent).unwrap_or(line)).collect();
    lines.join("\n")
}

/// A docstring as Markdown: its first paragraphs, a table of the parameters, the exceptions.
fn documented(text: &str, arguments: &[[String; 3]]) -> String {
    let (text, raises) = text.split_once("Raises\n------\n").unwrap_or((text, ""));
    let (text, parameters) = text.split_once("Parameters\n----------\n").unwrap_or((text, ""));
    let mut page = format!("{}\n\n", escaped(text.trim()));
    let parameters = entries(parameters);
    if !parameters.is_empty() {
        let rows: Vec<Vec<String>> =
            parameters.iter().map(|(names, meaning)| parameter(names, meaning, arguments)).collect();
        page += &(table(&["argument", "type", "default", "meaning"], &rows) + "\n");
    }
    let raises: Vec<String> = entries(raises)
        .into_iter()
        .map(|(names, text)| {
            format!("`{}` {text}", names.join("`, `")).trim_end_matches([' ', ',', ';', '.']).to_string()
        })
        .collect();
    if !raises.is_empty() {
        page += &format!("Raises {}.\n\n", escaped(&raises.join("; ")));
    }
    page
}

/// Entries of a section: names on a line of their own, and an indented text.
fn entries(section: &str) -> Vec<(Vec<String>, String)> {
    let section = format!("{}\n", section.trim_end());
    all(r"(?m)^(\w+(?:, \w+)*)\n((?: {4}[^\n]*\n)*)", &section)
        .into_iter()
        .map(|entry| (entry[1].split(", ").map(str::to_string).collect(), on_one_line(&entry[2])))
        .collect()
}

/// The row of arguments that have one text.
fn parameter(names: &[String], meaning: &str, arguments: &[[String; 3]]) -> Vec<String> {
    let of = |name: &String| arguments.iter().find(|argument| argument[0] == *name);
    let found: Vec<&[String; 3]> = names.iter().filter_map(of).collect();
    let mut defaults: Vec<String> = found
        .iter()
        .filter(|argument| !argument[2].is_empty())
        .map(|argument| format!("`{}`", argument[2]))
        .collect();
    defaults.dedup();
    let kind = found.first().map_or_else(String::new, |argument| format!("`{}`", plain(&argument[1])));
    vec![format!("`{}`", names.join("`, `")), kind, defaults.join(", "), meaning.to_string()]
}

fn on_one_line(text: &str) -> String {
    text.split_whitespace().collect::<Vec<_>>().join(" ")
}
