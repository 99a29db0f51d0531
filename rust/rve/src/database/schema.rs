//! Checks of an SQLite file before anything is read from it: it must have exactly our tables, and pass SQLite's own
//! integrity check.

use super::table::{Row, Schema};
use msdd_files::Column;
use rusqlite::limits::Limit;
use rusqlite::types::ValueRef;
use rusqlite::{Connection, OpenFlags};
use std::path::Path;

/// Longest value that is read [bytes]: far longer than any plan.
const LONGEST: i32 = 1 << 24;

/// Keys of the provenance, which a database has in a table and a CSV in a file beside it.
pub const PROVENANCE: [Column; 18] = [
    (
        "schema",
        "-",
        "version of the tables: 3; files of version 2, without `fabric_xy` and the columns of paths, are read as well, but not continued; of spheres `spheres 2`; files of `spheres 1`, without `shaking`, are read as well, but not continued",
    ),
    (
        "engine_version",
        "-",
        "version of the engine: another one gives other numbers, and rows of two versions do not mix",
    ),
    ("commit", "-", "commits of the programs that made the rows, as far as they know it"),
    ("shard", "-", "part of the plan that is in the file, as `1/4`; `1/1` is all"),
    ("plan", "-", "text of the plan"),
    ("plan_hash", "-", "SHA-256 of it"),
    ("grains", "-", "`spheres`; absent in databases of discs"),
    ("material", "-", "the grains, as JSON"),
    ("radius_distribution", "-", "`uniform`; this and the next three are absent of spheres"),
    ("radius_min", "m", "least radius"),
    ("radius_max", "m", "largest radius"),
    ("mean_radius", "m", "mean radius"),
    ("complete", "-", "`yes` once all packings are there; absent before"),
    ("digits", "-", "significant digits of a CSV that was exported with `--digits`; absent if all are there"),
    ("absent_columns", "-", "columns that rows of an older engine do not have; absent if there are none"),
    ("rows_sha256", "-", "checksum of the rows"),
    ("columns_sha256", "-", "checksum of the table of columns"),
    ("provenance_sha256", "-", "checksum of the provenance itself"),
];

/// The statements that make the tables.
pub(super) fn tables<R: Row>(schema: Schema) -> String {
    let columns: Vec<String> =
        R::COLUMNS.iter().filter(|column| schema.has(column)).map(|c| format!("{} {}", c.0, c.1)).collect();
    format!(
        "CREATE TABLE states ({}, PRIMARY KEY ({}));
             CREATE TABLE provenance (key TEXT PRIMARY KEY, value TEXT NOT NULL);
             CREATE TABLE columns (name TEXT PRIMARY KEY, unit TEXT NOT NULL, meaning TEXT NOT NULL);",
        columns.join(", "),
        R::KEY
    )
}

/// Opens a file. `path` is always taken as the name of a file: `:memory:` and `file:x?mode=memory` have no special
/// meaning.
pub(super) fn open(path: &Path, create: bool) -> rusqlite::Result<Connection> {
    let mut flags = OpenFlags::SQLITE_OPEN_READ_WRITE | OpenFlags::SQLITE_OPEN_NO_MUTEX;
    if create {
        flags |= OpenFlags::SQLITE_OPEN_CREATE;
    }
    // An absolute path cannot begin with `:` or `file:`, which SQLite would interpret.
    let path = std::path::absolute(path).map_err(|_| rusqlite::Error::InvalidPath(path.to_path_buf()))?;
    let connection = Connection::open_with_flags(path, flags)?;
    connection.set_limit(Limit::SQLITE_LIMIT_LENGTH, LONGEST)?;
    // Code in the schema of an untrusted file (such as functions in views and triggers) must not be run.
    connection.execute_batch("PRAGMA trusted_schema = OFF; PRAGMA cell_size_check = ON;")?;
    Ok(connection)
}

/// An object that a file declares, such as a table or an index: its type, name, table and SQL statement.
type Entry = [String; 4];

fn entries(connection: &Connection) -> rusqlite::Result<Vec<Entry>> {
    let mut statement =
        connection.prepare("SELECT type, name, tbl_name, sql FROM sqlite_master ORDER BY type, name")?;
    let text = |value: ValueRef| match value {
        ValueRef::Text(text) => String::from_utf8_lossy(text).into_owned(),
        _ => String::new(),
    };
    let entry = |row: &rusqlite::Row| -> rusqlite::Result<Entry> {
        let mut entry = Entry::default();
        for (k, field) in entry.iter_mut().enumerate() {
            *field = text(row.get_ref(k)?);
        }
        Ok(entry)
    };
    statement.query_map([], entry)?.collect()
}

fn expected<R: Row>(schema: Schema) -> rusqlite::Result<Vec<Entry>> {
    let connection = Connection::open_in_memory()?;
    connection.execute_batch(&tables::<R>(schema))?;
    entries(&connection)
}

/// Whether the file has no tables, so that nothing was ever stored in it.
pub(super) fn is_empty(connection: &Connection) -> rusqlite::Result<bool> {
    Ok(entries(connection)?.is_empty())
}

/// Whether the file has the tables of such rows, in any version.
pub(super) fn holds<R: Row>(connection: &Connection) -> rusqlite::Result<bool> {
    let found = entries(connection)?;
    for &schema in R::SCHEMAS {
        if found == expected::<R>(schema)? {
            return Ok(true);
        }
    }
    Ok(false)
}

/// The schema of the file, or what is wrong with it. All objects are compared by name and statement before anything is
/// read, so that a malicious view, which could run for ever, is never evaluated.
pub(super) fn of<R: Row>(connection: &Connection) -> rusqlite::Result<Result<Schema, String>> {
    let found = entries(connection)?;
    let mut schema = (R::schema(), expected::<R>(R::schema())?);
    for &older in R::SCHEMAS.iter().rev().skip(1) {
        let expected = expected::<R>(older)?;
        if found == expected {
            schema = (older, expected);
        }
    }
    let (schema, expected) = schema;
    if let Some([kind, name, ..]) = found.iter().find(|entry| !expected.contains(entry)) {
        let name = crate::message::shortened(name);
        return Ok(Err(format!("{kind} {name} does not belong to a database or was changed")));
    }
    if let Some([kind, name, ..]) = expected.iter().find(|entry| !found.contains(entry)) {
        return Ok(Err(format!("{kind} {name} is missing")));
    }
    let report = connection.query_row("PRAGMA integrity_check(1)", [], |row| {
        Ok(String::from_utf8_lossy(row.get_ref(0)?.as_bytes().unwrap_or_default()).into_owned())
    })?;
    Ok(if report == "ok" { Ok(schema) } else { Err(crate::message::shortened(&report)) })
}
