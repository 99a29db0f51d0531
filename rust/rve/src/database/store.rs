//! The database file: SQLite with the tables `states`, `provenance` (key, value) and `columns` (name, unit, meaning).

use super::plan::Plan;
use super::record::{COLUMNS, Column, Record};
use super::{DatabaseError, ENGINE_VERSION};
use rusqlite::types::Value;
use rusqlite::{Connection, params_from_iter};
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

/// Number of the schema; raised when a table changes.
pub const SCHEMA: i64 = 1;

/// An open database.
pub struct Store {
    connection: Connection,
    path: PathBuf,
}

impl Store {
    /// Opens an existing database for reading.
    pub fn open(path: &Path) -> Result<Self, DatabaseError> {
        let flags = rusqlite::OpenFlags::SQLITE_OPEN_READ_ONLY;
        let connection = Connection::open_with_flags(path, flags).map_err(|s| sqlite(path, s))?;
        let store = Self { connection, path: path.to_path_buf() };
        store.expect("schema", &SCHEMA.to_string())?;
        Ok(store)
    }

    /// Opens the database of a plan, or makes an empty one.
    pub(crate) fn open_for(path: &Path, plan: &Plan) -> Result<Self, DatabaseError> {
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
            store.create(plan).map_err(|s| sqlite(path, s))?;
        }
        store.expect("schema", &SCHEMA.to_string())?;
        store.expect("engine_version", &ENGINE_VERSION.to_string())?;
        store.expect("plan_hash", &plan.hash())?;
        Ok(store)
    }

    /// Tables and provenance in one transaction, so that a killed start leaves nothing half made.
    fn create(&mut self, plan: &Plan) -> rusqlite::Result<()> {
        let columns: Vec<String> = COLUMNS.iter().map(|c| format!("{} {}", c.0, c.1)).collect();
        let transaction = self.connection.transaction()?;
        transaction.execute_batch(&format!(
            "CREATE TABLE states ({}, PRIMARY KEY (packing, ramp, stop));
             CREATE TABLE provenance (key TEXT PRIMARY KEY, value TEXT NOT NULL);
             CREATE TABLE columns (name TEXT PRIMARY KEY, unit TEXT NOT NULL, meaning TEXT NOT NULL);",
            columns.join(", ")
        ))?;
        for (key, value) in provenance(plan) {
            transaction.execute("INSERT INTO provenance VALUES (?1, ?2)", [key, &value])?;
        }
        for Column(name, _, unit, meaning) in COLUMNS {
            transaction.execute("INSERT INTO columns VALUES (?1, ?2, ?3)", [name, unit, meaning])?;
        }
        transaction.commit()
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

    /// Number of packings stored; they are the first ones of the plan.
    pub fn packings(&self) -> Result<usize, DatabaseError> {
        let count = "SELECT count(DISTINCT packing) FROM states";
        let count: i64 =
            self.connection.query_row(count, [], |row| row.get(0)).map_err(|s| sqlite(&self.path, s))?;
        Ok(count as usize)
    }

    /// Stores the rows of one packing in one transaction.
    pub(crate) fn insert(&mut self, records: &[Record]) -> Result<(), DatabaseError> {
        let marks = vec!["?"; COLUMNS.len()].join(", ");
        let mut write = || -> rusqlite::Result<()> {
            let transaction = self.connection.transaction()?;
            {
                let mut statement = transaction.prepare(&format!("INSERT INTO states VALUES ({marks})"))?;
                for record in records {
                    statement.execute(params_from_iter(values(record)))?;
                }
            }
            transaction.commit()
        };
        write().map_err(|s| sqlite(&self.path, s))
    }

    /// All rows, in plan order.
    pub fn records(&self) -> Result<Vec<Record>, DatabaseError> {
        let names: Vec<&str> = COLUMNS.iter().map(|c| c.0).collect();
        let query = format!("SELECT {} FROM states ORDER BY rowid", names.join(", "));
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

fn provenance(plan: &Plan) -> Vec<(&'static str, String)> {
    vec![
        ("schema", SCHEMA.to_string()),
        ("engine_version", ENGINE_VERSION.to_string()),
        ("plan", plan.text.clone()),
        ("plan_hash", plan.hash()),
        ("material", serde_json::json!(plan.material).to_string()),
        ("discs", plan.discs.to_string()),
        ("radius_min", plan.radius_min.to_string()),
        ("radius_max", plan.radius_max.to_string()),
    ]
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
