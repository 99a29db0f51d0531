//! The database file: SQLite with the tables `states`, `provenance` (key, value) and `columns` (name, unit, meaning).

use super::generate::Run;
use super::plan::Plan;
use super::record::{COLUMNS, Column, Record};
use super::{DatabaseError, ENGINE_VERSION};
use rusqlite::types::Value;
use rusqlite::{Connection, params_from_iter};
use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};

/// Number of the schema; raised when a table changes.
pub const SCHEMA: i64 = 2;
/// Provenance key that only whole files have, whose rows stand in plan order.
const COMPLETE: &str = "complete";

/// An open database.
pub struct Store {
    connection: Connection,
    path: PathBuf,
}

impl Store {
    /// Opens an existing database. Work that a killed run has left half done is rolled back.
    pub fn open(path: &Path) -> Result<Self, DatabaseError> {
        let flags = rusqlite::OpenFlags::SQLITE_OPEN_READ_WRITE;
        let connection = Connection::open_with_flags(path, flags).map_err(|s| sqlite(path, s))?;
        let store = Self { connection, path: path.to_path_buf() };
        store.expect("schema", &SCHEMA.to_string())?;
        Ok(store)
    }

    /// Opens the database of a plan's shard, or makes an empty one.
    pub(crate) fn open_for(path: &Path, plan: &Plan, run: &Run) -> Result<Self, DatabaseError> {
        if let Some(folder) = path.parent() {
            std::fs::create_dir_all(folder)
                .map_err(|source| DatabaseError::Io { path: folder.to_path_buf(), source })?;
        }
        let connection = Connection::open(path).map_err(|s| sqlite(path, s))?;
        let mut store = Self { connection, path: path.to_path_buf() };
        let exists = "SELECT count(*) FROM sqlite_master WHERE name = 'provenance'";
        let tables: i64 =
            store.connection.query_row(exists, [], |row| row.get(0)).map_err(|s| sqlite(path, s))?;
        if tables == 0 {
            store.create(&provenance(plan, run), &[]).map_err(|s| sqlite(path, s))?;
        }
        store.expect("schema", &SCHEMA.to_string())?;
        store.expect("engine_version", &ENGINE_VERSION.to_string())?;
        store.expect("plan_hash", &plan.hash())?;
        store.expect("shard", &run.shard.to_string())?;
        store.add_commit(&run.commit)?;
        Ok(store)
    }

    /// Writes a whole file beside `path`, then renames it: the same rows and provenance give the same bytes, in whatever
    /// order, by however many runs and shards they were made.
    pub(crate) fn write_whole(
        path: &Path,
        mut provenance: BTreeMap<String, String>,
        records: &[Record],
    ) -> Result<(), DatabaseError> {
        provenance.insert(COMPLETE.to_string(), "yes".to_string());
        let mut name = path.file_name().unwrap_or_default().to_os_string();
        name.push(".part");
        let part = path.with_file_name(name);
        let io = |source| DatabaseError::Io { path: part.clone(), source };
        if part.exists() {
            std::fs::remove_file(&part).map_err(io)?;
        }
        let connection = Connection::open(&part).map_err(|s| sqlite(&part, s))?;
        let mut store = Self { connection, path: part.clone() };
        store.create(&provenance, records).map_err(|s| sqlite(&part, s))?;
        store.connection.close().map_err(|(_, s)| sqlite(&part, s))?;
        std::fs::rename(&part, path).map_err(io)
    }

    /// Puts the rows into plan order and the file into its last form, once.
    pub(crate) fn finish(self) -> Result<(), DatabaseError> {
        let (provenance, records) = (self.provenance()?, self.records()?);
        if provenance.contains_key(COMPLETE) {
            return Ok(());
        }
        self.connection.close().map_err(|(_, s)| sqlite(&self.path, s))?;
        Self::write_whole(&self.path, provenance, &records)
    }

    /// Tables, provenance and rows in one transaction, so that a killed start leaves nothing half made.
    fn create(&mut self, provenance: &BTreeMap<String, String>, records: &[Record]) -> rusqlite::Result<()> {
        let columns: Vec<String> = COLUMNS.iter().map(|c| format!("{} {}", c.0, c.1)).collect();
        let transaction = self.connection.transaction()?;
        transaction.execute_batch(&format!(
            "CREATE TABLE states ({}, PRIMARY KEY (packing, ramp, stop));
             CREATE TABLE provenance (key TEXT PRIMARY KEY, value TEXT NOT NULL);
             CREATE TABLE columns (name TEXT PRIMARY KEY, unit TEXT NOT NULL, meaning TEXT NOT NULL);",
            columns.join(", ")
        ))?;
        for (key, value) in provenance {
            transaction.execute("INSERT INTO provenance VALUES (?1, ?2)", [key, value])?;
        }
        for Column(name, _, unit, meaning) in COLUMNS {
            transaction.execute("INSERT INTO columns VALUES (?1, ?2, ?3)", [name, unit, meaning])?;
        }
        write_rows(&transaction, records)?;
        transaction.commit()
    }

    /// The commit of the program is recorded, not compared: of several, all are listed.
    fn add_commit(&self, commit: &str) -> Result<(), DatabaseError> {
        let recorded = self.provenance()?.remove("commit").unwrap_or_default();
        let joined = join_commits([recorded.as_str(), commit]);
        if joined == recorded {
            return Ok(());
        }
        let update = "UPDATE provenance SET value = ?1 WHERE key = 'commit'";
        self.connection.execute(update, [joined]).map_err(|s| sqlite(&self.path, s))?;
        Ok(())
    }

    fn expect(&self, key: &'static str, expected: &str) -> Result<(), DatabaseError> {
        let path = self.path.clone();
        match self.provenance()?.remove(key) {
            Some(found) if found == expected => Ok(()),
            Some(found) => Err(DatabaseError::Mismatch { path, key, found, expected: expected.to_string() }),
            None => Err(DatabaseError::Format { path, problem: format!("no {key} in its provenance") }),
        }
    }

    /// Keys and values that say where the rows come from.
    pub fn provenance(&self) -> Result<BTreeMap<String, String>, DatabaseError> {
        let read = || -> rusqlite::Result<_> {
            let mut statement = self.connection.prepare("SELECT key, value FROM provenance")?;
            statement.query_map([], |row| Ok((row.get(0)?, row.get(1)?)))?.collect()
        };
        read().map_err(|s| sqlite(&self.path, s))
    }

    /// The packings stored.
    pub fn packings(&self) -> Result<BTreeSet<i64>, DatabaseError> {
        let read = || -> rusqlite::Result<_> {
            let mut statement = self.connection.prepare("SELECT DISTINCT packing FROM states")?;
            statement.query_map([], |row| row.get(0))?.collect()
        };
        read().map_err(|s| sqlite(&self.path, s))
    }

    /// Stores the rows of one packing in one transaction.
    pub(crate) fn insert(&mut self, records: &[Record]) -> Result<(), DatabaseError> {
        let mut write = || -> rusqlite::Result<()> {
            let transaction = self.connection.transaction()?;
            write_rows(&transaction, records)?;
            transaction.commit()
        };
        write().map_err(|s| sqlite(&self.path, s))
    }

    /// All rows, in plan order.
    pub fn records(&self) -> Result<Vec<Record>, DatabaseError> {
        let names: Vec<&str> = COLUMNS.iter().map(|c| c.0).collect();
        let query = format!("SELECT {} FROM states ORDER BY packing, rowid", names.join(", "));
        let read = || -> rusqlite::Result<Vec<serde_json::Value>> {
            let mut statement = self.connection.prepare(&query)?;
            statement.query_map([], |row| row_as_json(row, &names))?.collect()
        };
        let rows = read().map_err(|s| sqlite(&self.path, s))?;
        let parse = |row| {
            serde_json::from_value(row).map_err(|error| DatabaseError::Format {
                path: self.path.clone(),
                problem: error.to_string(),
            })
        };
        rows.into_iter().map(parse).collect()
    }
}

pub(super) fn sqlite(path: &Path, source: rusqlite::Error) -> DatabaseError {
    DatabaseError::Sqlite { path: path.to_path_buf(), source }
}

fn provenance(plan: &Plan, run: &Run) -> BTreeMap<String, String> {
    let pairs = [
        ("schema", SCHEMA.to_string()),
        ("engine_version", ENGINE_VERSION.to_string()),
        ("commit", run.commit.clone()),
        ("shard", run.shard.to_string()),
        ("plan", plan.text.clone()),
        ("plan_hash", plan.hash()),
        ("material", serde_json::json!(plan.material).to_string()),
        ("radius_distribution", "uniform".to_string()),
        ("radius_min", plan.radius_min.to_string()),
        ("radius_max", plan.radius_max.to_string()),
        ("mean_radius", plan.mean_radius().to_string()),
    ];
    pairs.into_iter().map(|(key, value)| (key.to_string(), value)).collect()
}

/// The different ones of several lists of commits, sorted.
pub(super) fn join_commits<'a>(lists: impl IntoIterator<Item = &'a str>) -> String {
    let all: BTreeSet<&str> = lists.into_iter().flat_map(|list| list.split(", ")).collect();
    all.into_iter().filter(|commit| !commit.is_empty()).collect::<Vec<_>>().join(", ")
}

fn write_rows(transaction: &rusqlite::Transaction, records: &[Record]) -> rusqlite::Result<()> {
    let marks = vec!["?"; COLUMNS.len()].join(", ");
    let mut statement = transaction.prepare(&format!("INSERT INTO states VALUES ({marks})"))?;
    for record in records {
        statement.execute(params_from_iter(values(record)))?;
    }
    Ok(())
}

/// The fields of a record in column order. Goes through serde, so that field names stand in one place.
fn values(record: &Record) -> Vec<Value> {
    let fields = serde_json::json!(record);
    let value = |column: &Column| match &fields[column.0] {
        serde_json::Value::String(text) => Value::Text(text.clone()),
        serde_json::Value::Number(n) if column.1 == "INTEGER" => {
            n.as_i64().map_or(Value::Null, Value::Integer)
        }
        serde_json::Value::Number(n) => n.as_f64().map_or(Value::Null, Value::Real),
        _ => Value::Null,
    };
    COLUMNS.iter().map(value).collect()
}

fn row_as_json(row: &rusqlite::Row, names: &[&str]) -> rusqlite::Result<serde_json::Value> {
    let mut fields = serde_json::Map::new();
    for (k, name) in names.iter().enumerate() {
        let value = match row.get::<_, Value>(k)? {
            Value::Integer(integer) => integer.into(),
            Value::Real(real) => real.into(),
            Value::Text(text) => text.into(),
            _ => serde_json::Value::Null,
        };
        fields.insert((*name).to_string(), value);
    }
    Ok(fields.into())
}
