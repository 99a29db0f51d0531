//! What the sources have, to be compared with a table.

use crate::book::{Book, Table, quoted};
use std::collections::BTreeMap;

/// Names of one table, and what is known about the other cells of their rows.
#[derive(Clone)]
pub struct Set {
    /// Name of the table.
    pub table: String,
    /// Page on which it stands, for messages.
    pub page: &'static str,
    /// Where the names come from, for messages.
    pub source: String,
    pub names: BTreeMap<String, Vec<(&'static str, Cell)>>,
}

/// What a cell has to say.
#[derive(Clone, Debug)]
pub enum Cell {
    /// This text, backticks aside.
    Text(String),
    /// This word first.
    Begins(&'static str),
    /// This number first.
    Number(f64),
    /// Both numbers, among others.
    Range(f64, f64),
    /// These words in backticks, and no others.
    Words(Vec<String>),
}

impl std::fmt::Display for Cell {
    fn fmt(&self, f: &mut std::fmt::Formatter) -> std::fmt::Result {
        match self {
            Self::Text(text) => write!(f, "'{text}'"),
            Self::Begins(word) => write!(f, "'{word}'"),
            Self::Number(number) => write!(f, "{number}"),
            Self::Range(low, high) => write!(f, "{low} to {high}"),
            Self::Words(words) => write!(f, "`{}`", words.join("`, `")),
        }
    }
}

impl Set {
    pub fn new(
        page: &'static str,
        table: &str,
        source: &str,
        names: impl IntoIterator<Item = impl Into<String>>,
    ) -> Self {
        let names: BTreeMap<_, _> = names.into_iter().map(|name| (name.into(), Vec::new())).collect();
        assert!(!names.is_empty(), "{source}: nothing found for '{table}': has the code another form now?");
        Self { table: table.to_string(), page, source: source.to_string(), names }
    }

    /// Adds names that no pattern finds, each with its reason.
    pub fn and(mut self, unseen: &[(&str, &str)]) -> Self {
        for (name, reason) in unseen {
            let seen = self.names.insert((*name).to_string(), Vec::new()).is_some();
            assert!(
                !seen,
                "{}: '{name}' is found in the sources, its exception ({reason}) can go",
                self.table
            );
        }
        self
    }

    /// Takes names out that stand elsewhere, each with its reason.
    pub fn but(mut self, others: &[(&str, &str)]) -> Self {
        for (name, reason) in others {
            let seen = self.names.remove(*name).is_some();
            assert!(seen, "{}: '{name}' is not in the sources, its exception ({reason}) can go", self.table);
        }
        self
    }

    /// Says what the cell of a name in a column has to hold; nothing if the set has no such name.
    pub fn with(mut self, name: &str, column: &'static str, cell: Cell) -> Self {
        if let Some(cells) = self.names.get_mut(name) {
            cells.push((column, cell));
        }
        self
    }

    /// Takes back what a cell of a name has to hold: the page says more than the literal in the source.
    pub fn without(mut self, name: &str, column: &str, reason: &str) -> Self {
        let cells = self.names.get_mut(name).unwrap_or_else(|| panic!("{}: no {name}", self.table));
        let before = cells.len();
        cells.retain(|(known, _)| *known != column);
        assert!(
            cells.len() < before,
            "{}: nothing is known of {name}: this exception ({reason}) can go",
            self.table
        );
        self
    }

    /// The least and the largest number of a text as "0.01 to 0.3" in a message; nothing if it has not two.
    pub fn with_range(self, name: &str, text: &str) -> Self {
        match numbers(text).as_slice() {
            [low, .., high] => self.with(name, "allowed", Cell::Range(*low, *high)),
            _ => self,
        }
    }

    pub fn with_words(self, name: &str, column: &'static str, words: &[String]) -> Self {
        assert!(!words.is_empty(), "{}: no values of {name} in {}", self.table, self.source);
        self.with(name, column, Cell::Words(words.to_vec()))
    }
}

/// In what table and set differ, in both directions.
pub fn problems(book: &Book, set: &Set) -> Vec<String> {
    let Some(table) = book.table(&set.table) else {
        let names: Vec<String> = set.names.keys().map(|name| format!("`{name}`")).collect();
        let line = format!("docs/src/{}: no table '{}' (comment", set.page, set.table);
        let comment = format!("<!-- checked: {} -->", set.table);
        return vec![format!("{line} {comment} before it), for {} of {}", names.join(", "), set.source)];
    };
    let place = format!("{} ({})", table.place, set.table);
    let mut found = Vec::new();
    let page = table.place.split(':').next().unwrap_or_default();
    if page != format!("docs/src/{}", set.page) {
        found.push(format!("{place}: belongs to docs/src/{}", set.page));
    }
    let written = table.names();
    for name in set.names.keys().filter(|name| !written.contains(name)) {
        found.push(format!("{place}: `{name}` of {} is missing", set.source));
    }
    for (k, name) in written.iter().enumerate() {
        if !set.names.contains_key(name) {
            found.push(format!("{place}: `{name}` is not in {}", set.source));
        }
        if written[..k].contains(name) {
            found.push(format!("{place}: `{name}` stands twice"));
        }
    }
    for (name, cells) in &set.names {
        let wrong = cells.iter().filter_map(|(column, cell)| difference(table, name, column, cell));
        found.extend(wrong.map(|problem| format!("{place}: {problem} in {}", set.source)));
    }
    found
}

fn difference(table: &Table, name: &str, column: &str, expected: &Cell) -> Option<String> {
    let row = table.row(name)?;
    let Some(k) = table.column(column) else {
        return Some(format!("no column '{column}', which `{name}` needs; it is {expected}"));
    };
    let cell = &row[k];
    let numbers = numbers(cell);
    let same = match expected {
        Cell::Text(text) => plain(cell) == plain(text),
        Cell::Begins(word) => plain(cell).split(' ').next() == Some(word),
        Cell::Number(number) => numbers.first() == Some(number),
        Cell::Range(low, high) => numbers.contains(low) && numbers.contains(high),
        Cell::Words(words) => {
            let (mut written, mut expected) = (quoted(cell), words.clone());
            written.sort();
            expected.sort();
            written == expected
        }
    };
    (!same).then(|| format!("`{name}` has the {column} '{cell}', but it is {expected}"))
}

/// Without backticks, and one kind of dash.
fn plain(text: &str) -> String {
    let text = text.replace('`', "").replace(['\u{2212}', '\u{2013}'], "-");
    text.split_whitespace().collect::<Vec<_>>().join(" ")
}

fn numbers(cell: &str) -> Vec<f64> {
    let words = plain(cell);
    words.split([' ', ',', ';', '(', ')']).filter_map(|word| word.parse().ok()).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn found(row: &str, set: &Set) -> String {
        let text = format!("<!-- checked: t -->\n\n| key | allowed | default |\n|---|---|---|\n{row}\n");
        problems(&Book::of("docs/src/p.md", &text), set).join("\n")
    }

    #[test]
    fn each_difference_is_named_with_its_place() {
        let set = Set::new("p.md", "t", "code.C", ["a"]).with("a", "default", Cell::Number(0.5)).with(
            "a",
            "allowed",
            Cell::Range(0.0, 1.0),
        );
        assert_eq!(found("| `a` | 0 to 1 | 0.5 |", &set), "");
        assert!(
            found("| `b` | 0 to 1 | 0.5 |", &set).contains("docs/src/p.md:1 (t): `a` of code.C is missing")
        );
        assert!(found("| `a`, `b` | 0 to 1 | 0.5 |", &set).contains("`b` is not in code.C"));
        assert!(found("| `a`, `a` | 0 to 1 | 0.5 |", &set).contains("`a` stands twice"));
        assert!(
            found("| `a` | 0 to 1 | 0.51 |", &set).contains("the default '0.51', but it is 0.5 in code.C")
        );
        assert!(found("| `a` | 0 to 2 | 0.5 |", &set).contains("the allowed '0 to 2'"));
        let words =
            Set::new("p.md", "t", "code.C", ["a"]).with_words("a", "allowed", &["x".into(), "y".into()]);
        assert_eq!(found("| `a` | `y`, `x` | `x` |", &words), "");
        assert!(found("| `a` | `x` | `x` |", &words).contains("allowed '`x`'"));
        assert!(found("| `a` | `x`, `y`, `z` | `x` |", &words).contains("`z`"));
        let other = Set { page: "q.md", ..words.clone() };
        assert!(found("| `a` | `y`, `x` | `x` |", &other).contains("belongs to docs/src/q.md"));
        assert!(
            found("| `a` | `y`, `x` | `x` |", &Set { table: "u".into(), ..words }).contains("no table 'u'")
        );
    }
}
