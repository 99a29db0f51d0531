//! CSV with a column dictionary beside it, and reading a database in either form.

use super::DatabaseError;
use super::record::{COLUMNS, Record};
use super::store::Store;
use std::collections::BTreeMap;
use std::io::Read;
use std::path::{Path, PathBuf};

/// Rows and where they come from.
#[derive(Clone, Debug, PartialEq)]
pub struct Dataset {
    pub records: Vec<Record>,
    pub provenance: BTreeMap<String, String>,
}

/// Files that belong to a CSV: the column dictionary and the provenance.
fn beside(csv: &Path, what: &str) -> PathBuf {
    csv.with_extension(what)
}

fn io(path: &Path) -> impl FnOnce(std::io::Error) -> DatabaseError + '_ {
    |source| DatabaseError::Io { path: path.to_path_buf(), source }
}

/// Writes the database as CSV (first line: column names; floats in the shortest form that reads back exactly), with
/// FILE.columns.csv (name, unit, meaning) and FILE.provenance.json beside it. Returns the number of rows.
pub fn export_csv(database: &Path, csv: &Path) -> Result<usize, DatabaseError> {
    let store = Store::open(database)?;
    let records = store.records()?;
    let failed = |path: &Path| {
        let path = path.to_path_buf();
        move |source| DatabaseError::Csv { path, source }
    };
    let mut rows = csv::Writer::from_writer(Vec::new());
    for record in &records {
        rows.serialize(record).map_err(failed(csv))?;
    }
    let mut dictionary = csv::Writer::from_writer(Vec::new());
    dictionary.write_record(["name", "unit", "meaning"]).map_err(failed(csv))?;
    for column in COLUMNS {
        dictionary.write_record([column.0, column.2, column.3]).map_err(failed(csv))?;
    }
    let provenance = serde_json::json!(store.provenance()?).to_string();
    let bytes = |writer: csv::Writer<Vec<u8>>| {
        writer.into_inner().map_err(|error| io(csv)(std::io::Error::other(error.to_string())))
    };
    if let Some(folder) = csv.parent() {
        std::fs::create_dir_all(folder).map_err(io(folder))?;
    }
    write_atomically(&beside(csv, "columns.csv"), &bytes(dictionary)?)?;
    write_atomically(&beside(csv, "provenance.json"), provenance.as_bytes())?;
    write_atomically(csv, &bytes(rows)?)?;
    Ok(records.len())
}

/// Writes beside, then renames: a killed write leaves the old file.
fn write_atomically(path: &Path, bytes: &[u8]) -> Result<(), DatabaseError> {
    let mut name = path.file_name().unwrap_or_default().to_os_string();
    name.push(".part");
    let part = path.with_file_name(name);
    std::fs::write(&part, bytes).map_err(io(&part))?;
    std::fs::rename(&part, path).map_err(io(path))
}

fn is_sqlite(path: &Path) -> std::io::Result<bool> {
    let mut start = Vec::new();
    std::fs::File::open(path)?.take(16).read_to_end(&mut start)?;
    Ok(start == b"SQLite format 3\0")
}

/// Reads a database, or the CSV that was exported from one with its provenance beside it.
pub fn read(path: &Path) -> Result<Dataset, DatabaseError> {
    if is_sqlite(path).map_err(io(path))? {
        let store = Store::open(path)?;
        return Ok(Dataset { records: store.records()?, provenance: store.provenance()? });
    }
    let failed = |source| DatabaseError::Csv { path: path.to_path_buf(), source };
    let records = csv::Reader::from_path(path)
        .map_err(failed)?
        .deserialize()
        .collect::<Result<Vec<Record>, _>>()
        .map_err(failed)?;
    let origin = beside(path, "provenance.json");
    let text = std::fs::read_to_string(&origin).map_err(io(&origin))?;
    let provenance = serde_json::from_str(&text)
        .map_err(|error| DatabaseError::Format { path: origin, problem: error.to_string() })?;
    Ok(Dataset { records, provenance })
}
