//! CSV with a column dictionary beside it, and reading a database in either form.

use super::DatabaseError;
use super::record::{COLUMNS, Record};
use super::store::Store;
use sha2::{Digest, Sha256};
use std::collections::BTreeMap;
use std::io::{Read, Write};
use std::path::{Path, PathBuf};

/// Rows and where they come from.
#[derive(Clone, Debug, PartialEq)]
pub struct Dataset {
    pub records: Vec<Record>,
    pub provenance: BTreeMap<String, String>,
}

/// Files that belong to a CSV, compressed or not: the column dictionary and the provenance.
fn beside(csv: &Path, what: &str) -> PathBuf {
    let plain = if is_gzip_name(csv) { csv.with_extension("") } else { csv.to_path_buf() };
    plain.with_extension(what)
}

fn is_gzip_name(path: &Path) -> bool {
    path.extension().is_some_and(|extension| extension == "gz")
}

fn io(path: &Path) -> impl FnOnce(std::io::Error) -> DatabaseError + '_ {
    |source| DatabaseError::Io { path: path.to_path_buf(), source }
}

/// Writes the database as CSV (first line: column names; floats in the shortest form that reads back exactly), with
/// FILE.columns.csv (name, unit, meaning) and FILE.provenance.json beside it. A name that ends in .gz is compressed.
/// With `digits`, floats are rounded to as many significant ones: a file to ship needs no noise. Returns the number of rows.
pub fn export_csv(database: &Path, csv: &Path, digits: Option<usize>) -> Result<usize, DatabaseError> {
    let dataset = read(database)?;
    let failed = |path: &Path| {
        let path = path.to_path_buf();
        move |source| DatabaseError::Csv { path, source }
    };
    let mut rows = csv::Writer::from_writer(Vec::new());
    for record in &dataset.records {
        let record = digits.map_or_else(|| record.clone(), |digits| rounded(record, digits));
        rows.serialize(record).map_err(failed(csv))?;
    }
    let mut dictionary = csv::Writer::from_writer(Vec::new());
    dictionary.write_record(["name", "unit", "meaning"]).map_err(failed(csv))?;
    for column in COLUMNS {
        dictionary.write_record([column.0, column.2, column.3]).map_err(failed(csv))?;
    }
    let provenance = serde_json::json!(dataset.provenance).to_string();
    let bytes = |writer: csv::Writer<Vec<u8>>| {
        writer.into_inner().map_err(|error| io(csv)(std::io::Error::other(error.to_string())))
    };
    if let Some(folder) = csv.parent() {
        std::fs::create_dir_all(folder).map_err(io(folder))?;
    }
    let mut text = bytes(rows)?;
    if is_gzip_name(csv) {
        text = compressed(&text).map_err(io(csv))?;
    }
    write_atomically(&beside(csv, "columns.csv"), &bytes(dictionary)?)?;
    write_atomically(&beside(csv, "provenance.json"), provenance.as_bytes())?;
    write_atomically(csv, &text)?;
    Ok(dataset.records.len())
}

/// The record with its floats rounded to `digits` significant digits.
fn rounded(record: &Record, digits: usize) -> Record {
    let mut fields = serde_json::json!(record);
    for value in fields.as_object_mut().into_iter().flat_map(|map| map.values_mut()) {
        if let Some(number) = value.as_f64().filter(|_| value.is_f64()) {
            let text = format!("{number:.*e}", digits.max(1) - 1);
            *value = text.parse::<f64>().map_or(serde_json::Value::Null, Into::into);
        }
    }
    serde_json::from_value(fields).unwrap_or_else(|_| record.clone())
}

/// gzip without name or date: the same text gives the same bytes.
fn compressed(text: &[u8]) -> std::io::Result<Vec<u8>> {
    let mut encoder = flate2::write::GzEncoder::new(Vec::new(), flate2::Compression::best());
    encoder.write_all(text)?;
    encoder.finish()
}

/// Writes beside, then renames: a killed write leaves the old file.
fn write_atomically(path: &Path, bytes: &[u8]) -> Result<(), DatabaseError> {
    let mut name = path.file_name().unwrap_or_default().to_os_string();
    name.push(".part");
    let part = path.with_file_name(name);
    std::fs::write(&part, bytes).map_err(io(&part))?;
    std::fs::rename(&part, path).map_err(io(path))
}

/// The first bytes of a file.
fn start(path: &Path) -> std::io::Result<Vec<u8>> {
    let mut start = Vec::new();
    std::fs::File::open(path)?.take(16).read_to_end(&mut start)?;
    Ok(start)
}

/// Reads a database, or the CSV that was exported from one (plain or gzip) with its provenance beside it.
pub fn read(path: &Path) -> Result<Dataset, DatabaseError> {
    let start = start(path).map_err(io(path))?;
    if start == b"SQLite format 3\0" {
        let store = Store::open(path)?;
        return Ok(Dataset { records: store.records()?, provenance: store.provenance()? });
    }
    let file = std::fs::File::open(path).map_err(io(path))?;
    let text: Box<dyn Read> = if start.starts_with(&[0x1f, 0x8b]) {
        Box::new(flate2::read::GzDecoder::new(file))
    } else {
        Box::new(file)
    };
    let failed = |source| DatabaseError::Csv { path: path.to_path_buf(), source };
    let records =
        csv::Reader::from_reader(text).deserialize().collect::<Result<Vec<Record>, _>>().map_err(failed)?;
    let origin = beside(path, "provenance.json");
    let text = std::fs::read_to_string(&origin).map_err(io(&origin))?;
    let provenance = serde_json::from_str(&text)
        .map_err(|error| DatabaseError::Format { path: origin, problem: error.to_string() })?;
    Ok(Dataset { records, provenance })
}

/// What must be equal in databases that are read as one: rows of other grains or another engine do not mix.
const SHARED: [&str; 5] = ["engine_version", "material", "radius_distribution", "radius_min", "radius_max"];

/// Reads several databases as one. Packings are numbered on from file to file; the plan's hash is then of all plans.
///
/// # Errors
/// Those of [`read`]; [`DatabaseError::Mismatch`] for databases of different grains or engines.
pub fn read_all(paths: &[PathBuf]) -> Result<Dataset, DatabaseError> {
    let mut all = Dataset { records: Vec::new(), provenance: BTreeMap::new() };
    let mut plans = Vec::new();
    for path in paths {
        let Dataset { mut records, provenance } = read(path)?;
        let first = plans.is_empty();
        plans.push(provenance.get("plan_hash").cloned().unwrap_or_default());
        if first {
            all = Dataset { records, provenance };
            continue;
        }
        for key in SHARED {
            let [found, expected] =
                [&provenance, &all.provenance].map(|p| p.get(key).cloned().unwrap_or_default());
            if found != expected {
                return Err(DatabaseError::Mismatch { path: path.clone(), key, found, expected });
            }
        }
        let next = all.records.iter().map(|record| record.packing + 1).max().unwrap_or(0);
        records.iter_mut().for_each(|record| record.packing += next);
        all.records.append(&mut records);
    }
    if plans.len() > 1 {
        let hash = Sha256::digest(plans.concat()).iter().map(|byte| format!("{byte:02x}")).collect();
        all.provenance.insert("plan_hash".to_string(), hash);
    }
    Ok(all)
}
