//! `docs/results.json`: every measured number and table of README and book.

use crate::error::DocsError;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use std::path::Path;

/// Where the results are, relative to the checkout.
pub const FILE: &str = "docs/results.json";
/// The only form that is read.
pub const SCHEMA: &str = "msdd-results-1";

/// The whole file: sections, each renewed on its own.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Results {
    pub schema: String,
    pub sections: BTreeMap<String, Section>,
}

/// What one command measured.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Section {
    /// The command that makes it.
    pub command: String,
    /// Commit of the sources that it was made with.
    pub commit: String,
    /// Day it was made on, UTC, year-month-day.
    pub date: String,
    /// Processor and cores, where times are in the section; else empty.
    #[serde(default, skip_serializing_if = "String::is_empty")]
    pub machine: String,
    /// By key; the whole key is `section.key`.
    pub values: BTreeMap<String, Value>,
    /// By name; names are unique over all sections.
    pub tables: BTreeMap<String, Table>,
}

/// One number, as it is printed.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Value {
    /// Rounded for print.
    pub value: String,
    /// Unit of the number: "%", "K", "1" …
    pub unit: String,
    pub meaning: String,
    /// File and entry that it was read from.
    pub source: String,
}

/// A table, as it is printed.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Table {
    pub meaning: String,
    pub source: String,
    pub columns: Vec<String>,
    /// As many cells as columns each.
    pub rows: Vec<Vec<String>>,
}

impl Table {
    /// As Markdown, each line ended.
    pub fn markdown(&self) -> String {
        let line = |cells: &[String]| format!("| {} |\n", cells.join(" | "));
        let rule = format!("|{}\n", "---|".repeat(self.columns.len()));
        let rows: String = self.rows.iter().map(|row| line(row)).collect();
        line(&self.columns) + &rule + &rows
    }
}

impl Default for Results {
    fn default() -> Self {
        Self { schema: SCHEMA.to_string(), sections: BTreeMap::new() }
    }
}

impl Results {
    /// Reads the results of the checkout `root`.
    ///
    /// # Errors
    /// A file that is missing or of another form; a table's name used twice; rows of another length than the columns; cells that
    /// would break a table.
    pub fn read(root: &Path) -> Result<Self, DocsError> {
        let file = root.join(FILE);
        let text = msdd_files::read_text(&file)?;
        let failed = |text: String| DocsError::Json { file: file.clone(), text };
        let results: Self = serde_json::from_str(&text).map_err(|error| failed(error.to_string()))?;
        results.check().map_err(failed)?;
        Ok(results)
    }

    /// Writes them, whole or not at all.
    ///
    /// # Errors
    /// What [`Results::read`] would refuse, and a file that cannot be written.
    pub fn write(&self, root: &Path) -> Result<(), DocsError> {
        let file = root.join(FILE);
        let failed = |text: String| DocsError::Json { file: file.clone(), text };
        self.check().map_err(failed)?;
        let text = serde_json::to_string_pretty(self).map_err(|error| failed(error.to_string()))?;
        Ok(msdd_files::write(&file, (text + "\n").as_bytes())?)
    }

    fn check(&self) -> Result<(), String> {
        if self.schema != SCHEMA {
            return Err(format!("schema is '{}', allowed: {SCHEMA}", self.schema));
        }
        let mut names = BTreeMap::new();
        for (section, content) in &self.sections {
            for (key, value) in &content.values {
                if value.value.is_empty() || !plain(&value.value) {
                    return Err(format!(
                        "{section}.{key} is '{}', allowed: text without line ends, | or <!--",
                        value.value
                    ));
                }
            }
            for (name, table) in &content.tables {
                if let Some(other) = names.insert(name, section) {
                    return Err(format!("table {name} stands in the sections {other} and {section}"));
                }
                table.check().map_err(|text| format!("table {name}: {text}"))?;
            }
        }
        Ok(())
    }

    /// The number of a whole key, `section.key`.
    pub fn value(&self, key: &str) -> Option<&Value> {
        let (section, key) = key.split_once('.')?;
        self.sections.get(section)?.values.get(key)
    }

    pub fn table(&self, name: &str) -> Option<&Table> {
        self.sections.values().find_map(|section| section.tables.get(name))
    }
}

impl Table {
    /// Least and largest number at the starts of a column's cells, as printed; of the rows whose first cell has `row` in it.
    /// One number where they are equal. Of a column name followed by " ()" the numbers in the brackets of the cells.
    pub fn range(&self, column: &str, row: &str) -> Option<String> {
        let (column, inside) = column.strip_suffix(" ()").map_or((column, false), |column| (column, true));
        let column = self.columns.iter().position(|name| name == column)?;
        let cells =
            self.rows.iter().filter(|cells| cells[0].contains(row)).map(|cells| cells[column].as_str());
        let numbers = cells.filter_map(|cell| {
            let start = if inside { cell.split_once('(')?.1 } else { cell };
            let printed = start.split([' ', ')']).next()?;
            Some((printed.replace('\u{a0}', "").parse::<f64>().ok()?, printed))
        });
        let numbers: Vec<(f64, &str)> = numbers.collect();
        let least = numbers.iter().min_by(|a, b| a.0.total_cmp(&b.0))?.1;
        let most = numbers.iter().max_by(|a, b| a.0.total_cmp(&b.0))?.1;
        Some(if least == most { most.to_string() } else { format!("{least} to {most}") })
    }

    fn check(&self) -> Result<(), String> {
        if self.columns.is_empty() {
            return Err("has no columns".to_string());
        }
        for row in &self.rows {
            if row.len() != self.columns.len() {
                return Err(format!(
                    "row '{}' has {} cells, allowed: {}",
                    row.join(" | "),
                    row.len(),
                    self.columns.len()
                ));
            }
        }
        match self.columns.iter().chain(self.rows.iter().flatten()).find(|cell| !plain(cell)) {
            Some(cell) => Err(format!("cell '{cell}' has a line end, | or <!--")),
            None => Ok(()),
        }
    }
}

/// Whether a text can stand between marks and in a cell.
fn plain(text: &str) -> bool {
    !text.contains(['\n', '\r', '|']) && !text.contains("<!--")
}

impl Section {
    /// Adds a number, as it is printed.
    pub(crate) fn number(&mut self, key: &str, value: String, unit: &str, meaning: &str, source: &str) {
        let [unit, meaning, source] = [unit, meaning, source].map(str::to_string);
        self.values.insert(key.to_string(), Value { value, unit, meaning, source });
    }

    /// Adds a table.
    pub(crate) fn add_table(
        &mut self,
        name: &str,
        meaning: &str,
        source: &str,
        columns: &[&str],
        rows: Vec<Vec<String>>,
    ) {
        let columns = columns.iter().map(|column| (*column).to_string()).collect();
        let (meaning, source) = (meaning.to_string(), source.to_string());
        self.tables.insert(name.to_string(), Table { meaning, source, columns, rows });
    }
}
