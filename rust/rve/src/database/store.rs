//! The database file: SQLite with the tables `states`, `provenance` (key, value) and `columns` (name, unit, meaning).

use super::cell::Cell;
use super::dataset::undamaged;
use super::recipe::Recipe;
use super::table::{Column, Row, Schema};
use super::{DatabaseError, Dataset, Shard, checksum, schema};
use msdd_files::Part;
use rusqlite::types::ValueRef;
use rusqlite::{Connection, params_from_iter};
use std::collections::{BTreeMap, BTreeSet};
use std::marker::PhantomData;
use std::path::{Path, PathBuf};

/// Provenance key that only finished files have; their rows stand in plan order.
pub(super) const COMPLETE: &str = "complete";

/// An open database of rows of one type.
pub struct Store<R> {
    connection: Connection,
    path: PathBuf,
    schema: Schema,
    rows: PhantomData<R>,
}

impl<R: Row> Store<R> {
    /// Opens an existing database and checks that it has exactly our tables. A transaction that a killed run has left
    /// unfinished is rolled back.
    ///
    /// # Errors
    /// [`DatabaseError::Format`] for a file that is no database, [`DatabaseError::Damaged`] when SQLite's integrity
    /// check fails, [`DatabaseError::Mismatch`] for another schema version, [`DatabaseError::Sqlite`].
    pub fn open(path: &Path) -> Result<Self, DatabaseError> {
        let connection = schema::open(path, false).map_err(|s| sqlite(path, s))?;
        let mut store = Self { connection, path: path.to_path_buf(), schema: R::schema(), rows: PhantomData };
        store.check()?;
        Ok(store)
    }

    /// Finds the schema of the file, which its provenance has to name.
    fn check(&mut self) -> Result<(), DatabaseError> {
        let found = schema::of::<R>(&self.connection).map_err(|s| sqlite(&self.path, s))?;
        self.schema = found.map_err(|problem| DatabaseError::Format { path: self.path.clone(), problem })?;
        self.expect("schema", self.schema.number)
    }

    /// Opens the database of a plan's shard, or makes an empty one. Existing content must agree with its checksums.
    /// `commit` is that of the program.
    pub(crate) fn open_for<P: Recipe<Row = R>>(
        path: &Path,
        plan: &P,
        shard: Shard,
        commit: &str,
    ) -> Result<Self, DatabaseError> {
        let connection = schema::open(path, true).map_err(|s| sqlite(path, s))?;
        let mut store = Self { connection, path: path.to_path_buf(), schema: R::schema(), rows: PhantomData };
        if schema::is_empty(&store.connection).map_err(|s| sqlite(path, s))? {
            store.create(provenance(plan, shard, commit), &[]).map_err(|s| sqlite(path, s))?;
        }
        store.check()?;
        store.expect("schema", R::schema().number)?;
        store.expect("engine_version", &P::ENGINE_VERSION.to_string())?;
        store.expect("plan_hash", &plan.hash())?;
        store.expect("shard", &shard.to_string())?;
        store.dataset()?;
        store.add_commit(commit)?;
        Ok(store)
    }

    /// Writes a whole file beside `path`, then renames it. The same rows and provenance give the same bytes, in
    /// whatever order they were made and by however many runs and shards.
    pub(crate) fn write_whole(
        path: &Path,
        mut provenance: BTreeMap<String, String>,
        records: &[R],
    ) -> Result<(), DatabaseError> {
        provenance.insert(COMPLETE.to_string(), "yes".to_string());
        // Rows of an older schema are written with the columns of this one.
        provenance.insert("schema".to_string(), R::schema().number.to_string());
        let part = Part::beside(path)?;
        let failed = |source| sqlite(path, source);
        let connection = schema::open(part.path(), false).map_err(failed)?;
        // The temporary file is written to disk before it is renamed, so SQLite's journal for restoring older contents
        // is not needed.
        connection.execute_batch("PRAGMA journal_mode = OFF; PRAGMA synchronous = OFF;").map_err(failed)?;
        let mut store =
            Self { connection, path: part.path().to_path_buf(), schema: R::schema(), rows: PhantomData };
        store.create(provenance, records).map_err(failed)?;
        store.connection.close().map_err(|(_, source)| failed(source))?;
        Ok(part.put()?)
    }

    /// Sorts the rows into plan order and writes the file in its final form, once.
    pub(crate) fn finish(self) -> Result<(), DatabaseError> {
        let Dataset { records, provenance } = self.dataset()?;
        if provenance.contains_key(COMPLETE) {
            return Ok(());
        }
        self.connection.close().map_err(|(_, s)| sqlite(&self.path, s))?;
        Self::write_whole(&self.path, provenance, &records)
    }

    /// Writes tables, checksums, provenance and rows in one transaction, so that a run that is killed at its start
    /// leaves no incomplete file.
    fn create(&mut self, mut provenance: BTreeMap<String, String>, records: &[R]) -> rusqlite::Result<()> {
        checksum::seal(&mut provenance, records);
        let transaction = self.connection.transaction()?;
        transaction.execute_batch(&schema::tables::<R>(R::schema()))?;
        write_provenance(&transaction, &provenance)?;
        for Column(name, _, unit, meaning) in R::COLUMNS {
            transaction.execute("INSERT INTO columns VALUES (?1, ?2, ?3)", [name, unit, meaning])?;
        }
        write_rows(&transaction, records)?;
        transaction.commit()
    }

    /// Records the commit of the program. It is not compared with earlier ones; if there are several, all are listed.
    fn add_commit(&mut self, commit: &str) -> Result<(), DatabaseError> {
        let mut provenance = self.provenance()?;
        let recorded = provenance.remove("commit").unwrap_or_default();
        let joined = join_commits([recorded.as_str(), commit]);
        if joined == recorded {
            return Ok(());
        }
        provenance.insert("commit".to_string(), joined);
        checksum::seal_provenance(&mut provenance);
        self.write(&provenance, &[])
    }

    fn expect(&self, key: &'static str, expected: &str) -> Result<(), DatabaseError> {
        let path = self.path.clone();
        match self.provenance()?.remove(key) {
            Some(found) if found == expected => Ok(()),
            Some(found) => Err(DatabaseError::Mismatch { path, key, found, expected: expected.to_string() }),
            None => Err(DatabaseError::Format { path, problem: format!("no {key} in its provenance") }),
        }
    }

    /// The provenance: keys and values that say where the rows come from.
    ///
    /// # Errors
    /// [`DatabaseError::Value`] for a value that is not text, [`DatabaseError::Sqlite`].
    pub fn provenance(&self) -> Result<BTreeMap<String, String>, DatabaseError> {
        let names = ["key", "value"];
        let pairs = self.rows("SELECT key, value FROM provenance", |row, number| {
            let text = |column: usize| self.text(("provenance", number, names[column]), row.get_ref(column));
            Ok((text(0)?, text(1)?))
        })?;
        Ok(pairs.into_iter().collect())
    }

    /// Indices of the stored packings.
    ///
    /// # Errors
    /// [`DatabaseError::Sqlite`].
    pub fn packings(&self) -> Result<BTreeSet<i64>, DatabaseError> {
        let read = || -> rusqlite::Result<_> {
            let mut statement = self.connection.prepare("SELECT DISTINCT packing FROM states")?;
            statement.query_map([], |row| row.get(0))?.collect()
        };
        read().map_err(|s| sqlite(&self.path, s))
    }

    /// Stores the rows of one packing in one transaction.
    pub(crate) fn insert(&mut self, records: &[R]) -> Result<(), DatabaseError> {
        let mut provenance = self.provenance()?;
        checksum::add(&mut provenance, records);
        self.write(&provenance, records)
    }

    fn write(&mut self, provenance: &BTreeMap<String, String>, records: &[R]) -> Result<(), DatabaseError> {
        let mut write = || -> rusqlite::Result<()> {
            let transaction = self.connection.transaction()?;
            write_rows(&transaction, records)?;
            write_provenance(&transaction, provenance)?;
            transaction.commit()
        };
        write().map_err(|s| sqlite(&self.path, s))
    }

    /// All rows, in plan order.
    ///
    /// # Errors
    /// [`DatabaseError::Value`] for a value of the wrong kind for its column, [`DatabaseError::Sqlite`].
    pub fn records(&self) -> Result<Vec<R>, DatabaseError> {
        let names: Vec<&str> =
            R::COLUMNS.iter().map(|c| if self.schema.has(c) { c.0 } else { "NULL" }).collect();
        let query = format!("SELECT {} FROM states ORDER BY packing, rowid", names.join(", "));
        self.rows(&query, |row, number| {
            let cell = |column| row.get_ref(column).map_err(|error| error.to_string());
            R::from_cells(cell).map_err(|(column, problem)| self.value(("states", number, column), problem))
        })
    }

    /// Rows in plan order and provenance, and a description of each part that differs from its checksum.
    ///
    /// # Errors
    /// Those of [`Store::records`].
    pub(super) fn inspected(&self) -> Result<(Dataset<R>, Vec<String>), DatabaseError> {
        // Everything is read in one transaction, because a generator may be writing to the file.
        let transaction = self.connection.unchecked_transaction().map_err(|s| sqlite(&self.path, s))?;
        let dataset = Dataset { records: self.records()?, provenance: self.provenance()? };
        let mut damage = checksum::damage(&dataset);
        let names = ["name", "unit", "meaning"];
        let dictionary =
            self.rows("SELECT name, unit, meaning FROM columns ORDER BY rowid", |row, number| {
                let text = |column: usize| self.text(("columns", number, names[column]), row.get_ref(column));
                Ok([text(0)?, text(1)?, text(2)?])
            })?;
        damage.extend(checksum::dictionary_damage(&dataset.provenance, &dictionary));
        transaction.finish().map_err(|s| sqlite(&self.path, s))?;
        Ok((dataset, damage))
    }

    /// Rows in plan order and provenance; an error when they differ from their checksums.
    ///
    /// # Errors
    /// [`DatabaseError::Damaged`]; those of [`Store::records`].
    pub(super) fn dataset(&self) -> Result<Dataset<R>, DatabaseError> {
        let (dataset, damage) = self.inspected()?;
        undamaged(&self.path, dataset, &damage)
    }

    /// The rows of a query, each converted by `read`, which also gets the row's number, counted from 1.
    fn rows<T>(
        &self,
        query: &str,
        mut read: impl FnMut(&rusqlite::Row, u64) -> Result<T, DatabaseError>,
    ) -> Result<Vec<T>, DatabaseError> {
        let failed = |source| sqlite(&self.path, source);
        let mut statement = self.connection.prepare(query).map_err(failed)?;
        let mut rows = statement.query([]).map_err(failed)?;
        let mut found = Vec::new();
        while let Some(row) = rows.next().map_err(failed)? {
            found.push(read(row, found.len() as u64 + 1)?);
        }
        Ok(found)
    }

    fn text(&self, place: Place, value: rusqlite::Result<ValueRef>) -> Result<String, DatabaseError> {
        let read = value.map_err(|error| error.to_string()).and_then(String::read);
        read.map_err(|problem| self.value(place, problem))
    }

    fn value(&self, (table, row, column): Place, problem: String) -> DatabaseError {
        DatabaseError::Value { path: self.path.clone(), table, row, column, problem }
    }
}

/// Table, row (counted from 1), column.
type Place = (&'static str, u64, &'static str);

pub(super) fn sqlite(path: &Path, source: rusqlite::Error) -> DatabaseError {
    DatabaseError::Sqlite { path: path.to_path_buf(), source }
}

fn provenance<P: Recipe>(plan: &P, shard: Shard, commit: &str) -> BTreeMap<String, String> {
    let pairs = [
        ("schema", P::Row::schema().number.to_string()),
        ("engine_version", P::ENGINE_VERSION.to_string()),
        ("commit", commit.to_string()),
        ("shard", shard.to_string()),
        ("plan", plan.text().to_string()),
        ("plan_hash", plan.hash()),
    ];
    pairs.into_iter().chain(plan.grains()).map(|(key, value)| (key.to_string(), value)).collect()
}

/// All different commits of several lists, sorted.
pub(super) fn join_commits<'a>(lists: impl IntoIterator<Item = &'a str>) -> String {
    let all: BTreeSet<&str> = lists.into_iter().flat_map(|list| list.split(", ")).collect();
    all.into_iter().filter(|commit| !commit.is_empty()).collect::<Vec<_>>().join(", ")
}

fn write_rows<R: Row>(transaction: &rusqlite::Transaction, records: &[R]) -> rusqlite::Result<()> {
    let marks = vec!["?"; R::COLUMNS.len()].join(", ");
    let mut statement = transaction.prepare(&format!("INSERT INTO states VALUES ({marks})"))?;
    for record in records {
        statement.execute(params_from_iter(record.values()))?;
    }
    Ok(())
}

fn write_provenance(
    transaction: &rusqlite::Transaction,
    provenance: &BTreeMap<String, String>,
) -> rusqlite::Result<()> {
    let mut statement = transaction.prepare(
        "INSERT INTO provenance VALUES (?1, ?2) ON CONFLICT (key) DO UPDATE SET value = excluded.value WHERE value <> \
         excluded.value",
    )?;
    provenance.iter().try_for_each(|(key, value)| statement.execute([key, value]).map(|_| ()))
}
