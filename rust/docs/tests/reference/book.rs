//! The tables of the book that have a name.

use crate::sources::{all, checkout};
use std::collections::BTreeMap;

/// Markdown's tables by the name in the comment before them.
pub struct Book {
    pub tables: BTreeMap<String, Table>,
}

#[derive(Clone)]
pub struct Table {
    /// File and line, for messages.
    pub place: String,
    pub columns: Vec<String>,
    pub rows: Vec<Vec<String>>,
}

impl Book {
    /// Reads the pages of the reference and the symbols.
    pub fn read() -> Self {
        let folder = checkout().join("docs/src");
        let mut pages: Vec<_> = std::fs::read_dir(folder.join("reference"))
            .expect("docs/src/reference is there")
            .map(|entry| entry.expect("a readable folder").path())
            .filter(|path| path.extension().is_some_and(|extension| extension == "md"))
            .collect();
        pages.push(folder.join("theory/symbols.md"));
        let mut tables = BTreeMap::new();
        for path in pages {
            let text =
                std::fs::read_to_string(&path).unwrap_or_else(|error| panic!("{}: {error}", path.display()));
            let page = path.strip_prefix(checkout()).expect("a page of the checkout").display().to_string();
            for (name, table) in tables_of(&page, &text) {
                let place = table.place.clone();
                assert!(
                    tables.insert(name.clone(), table).is_none(),
                    "{place}: a second table is called '{name}'"
                );
            }
        }
        Self { tables }
    }

    /// The tables of one text.
    #[cfg(test)]
    pub fn of(page: &str, text: &str) -> Self {
        Self { tables: tables_of(page, text).into_iter().collect() }
    }

    pub fn table(&self, name: &str) -> Option<&Table> {
        self.tables.get(name)
    }
}

impl Table {
    /// What the first column names: a cell may name several.
    pub fn names(&self) -> Vec<String> {
        self.rows.iter().flat_map(|row| names_of(&row[0])).collect()
    }

    /// The row that names it.
    pub fn row(&self, name: &str) -> Option<&Vec<String>> {
        self.rows.iter().find(|row| names_of(&row[0]).iter().any(|known| known == name))
    }

    pub fn column(&self, title: &str) -> Option<usize> {
        self.columns.iter().position(|column| column == title)
    }
}

/// Texts in backticks.
pub fn quoted(cell: &str) -> Vec<String> {
    all(r"`([^`]+)`", cell).into_iter().map(|found| found[1].clone()).collect()
}

/// The same; of an option without its value: `--out FILE` names `--out`.
fn names_of(cell: &str) -> Vec<String> {
    let name = |text: String| match text.split_once(' ') {
        Some((option, _)) if option.starts_with('-') => option.to_string(),
        _ => text,
    };
    quoted(cell).into_iter().map(name).collect()
}

/// Tables after `<!-- checked: NAME -->`, blank lines between.
fn tables_of(page: &str, text: &str) -> Vec<(String, Table)> {
    let lines: Vec<&str> = text.lines().collect();
    let mut found = Vec::new();
    for (k, line) in lines.iter().enumerate() {
        let Some(name) = line.strip_prefix("<!-- checked: ").and_then(|rest| rest.strip_suffix(" -->"))
        else {
            continue;
        };
        let table: Vec<Vec<String>> = lines[k + 1..]
            .iter()
            .skip_while(|line| line.is_empty())
            .take_while(|line| line.starts_with('|'))
            .map(|line| cells(line))
            .collect();
        let place = format!("{page}:{}", k + 1);
        assert!(table.len() > 2, "{place}: no table follows");
        let (columns, rows) = (table[0].clone(), table[2..].to_vec());
        let uneven = rows.iter().find(|row| row.len() != columns.len());
        assert!(uneven.is_none(), "{place}: {uneven:?} has not {} cells", columns.len());
        let empty = rows.iter().find(|row| row.iter().any(String::is_empty));
        assert!(empty.is_none(), "{place}: {empty:?} has an empty cell");
        found.push((name.to_string(), Table { place, columns, rows }));
    }
    found
}

fn cells(line: &str) -> Vec<String> {
    let inner = line.trim().trim_start_matches('|').trim_end_matches('|');
    inner.replace(r"\|", "\u{1}").split('|').map(|cell| cell.trim().replace('\u{1}', "|")).collect()
}
