//! Export as CSV, with a column dictionary and the provenance in files beside it.

use super::csv_file::{beside, is_gzip_name};
use super::dataset::DIGITS;
use super::grains::is_sqlite;
use super::plan::Plan;
use super::read::{read_rows, sound};
use super::recipe::Recipe;
use super::spheres::SpherePlan;
use super::store::{COMPLETE, Store};
use super::table::Row;
use super::{DatabaseError, Dataset, Grains, checksum, csv_file, grains};
use msdd_files::{check_target, write};
use std::io::Write;
use std::path::Path;

/// A float with at least this many significant digits counts as not rounded.
const ALL_DIGITS: usize = 15;

/// Writes the database as CSV (first line: column names; floats in the shortest form that reads back exactly), with
/// FILE.columns.csv (name, unit, meaning) and FILE.provenance.json beside it. A name that ends in .gz is compressed.
/// With `digits`, floats are rounded to that many significant digits, which makes the file smaller. Returns the number
/// of rows.
///
/// # Errors
/// Those of `read`; [`DatabaseError::File`] when a file cannot be written.
pub fn export_csv(database: &Path, csv: &Path, digits: Option<usize>) -> Result<usize, DatabaseError> {
    check_target(csv)?;
    match grains(database)? {
        Grains::Discs => export_rows::<Plan>(database, csv, digits),
        Grains::Spheres => export_rows::<SpherePlan>(database, csv, digits),
    }
}

fn export_rows<P: Recipe>(
    database: &Path,
    csv: &Path,
    digits: Option<usize>,
) -> Result<usize, DatabaseError> {
    let mut dataset = read_rows::<P::Row>(database)?;
    if let Some(digits) = digits {
        dataset.records.iter_mut().for_each(|record| *record = rounded(record, digits));
        // A database that was rounded before cannot regain digits.
        let before = dataset.provenance.get(DIGITS).and_then(|digits| digits.parse().ok());
        let digits = before.map_or(digits, |before: usize| before.min(digits));
        dataset.provenance.insert(DIGITS.to_string(), digits.to_string());
    }
    checksum::seal(&mut dataset.provenance, &dataset.records);
    let failed = |source| DatabaseError::Csv { path: csv.to_path_buf(), source };
    let mut rows = csv::Writer::from_writer(Vec::new());
    dataset.records.iter().try_for_each(|record| rows.serialize(record)).map_err(failed)?;
    let mut dictionary = csv::Writer::from_writer(Vec::new());
    dictionary.write_record(["name", "unit", "meaning"]).map_err(failed)?;
    for column in P::Row::COLUMNS {
        dictionary.write_record([column.0, column.2, column.3]).map_err(failed)?;
    }
    let bytes = |writer: csv::Writer<Vec<u8>>| {
        writer.into_inner().map_err(|error| failed(std::io::Error::other(error.to_string()).into()))
    };
    let mut text = bytes(rows)?;
    if is_gzip_name(csv) {
        text = compressed(&text).map_err(|error| failed(error.into()))?;
    }
    write(&beside(csv, "columns.csv"), &bytes(dictionary)?)?;
    write_provenance(csv, &dataset)?;
    write(csv, &text)?;
    Ok(dataset.records.len())
}

fn write_provenance<R>(csv: &Path, dataset: &Dataset<R>) -> Result<(), DatabaseError> {
    let text = serde_json::json!(dataset.provenance).to_string();
    Ok(write(&beside(csv, "provenance.json"), text.as_bytes())?)
}

/// Adds checksums to a database or CSV that an older program wrote without them, if all laws hold on its rows. For a
/// CSV only the provenance file beside it is written. Returns the number of rows.
///
/// # Errors
/// Those of `read`; [`DatabaseError::Unsound`]; [`DatabaseError::Format`] for a database that is not finished.
pub fn seal(path: &Path) -> Result<usize, DatabaseError> {
    match grains(path)? {
        Grains::Discs => seal_rows::<Plan>(path),
        Grains::Spheres => seal_rows::<SpherePlan>(path),
    }
}

fn seal_rows<P: Recipe>(path: &Path) -> Result<usize, DatabaseError> {
    let mut dataset = unsealed::<P>(path)?;
    let digits = digits_of(&dataset.records);
    if digits < ALL_DIGITS {
        dataset.provenance.insert(DIGITS.to_string(), digits.to_string());
    }
    sound::<P>(path, &dataset)?;
    checksum::seal(&mut dataset.provenance, &dataset.records);
    if !is_sqlite(path)? {
        write_provenance(path, &dataset)?;
    } else if dataset.provenance.contains_key(COMPLETE) {
        let records = Store::<P::Row>::open(path)?.records()?;
        Store::write_whole(path, dataset.provenance, &records)?;
    } else {
        let problem = "it is not finished; database generate finishes and seals it".to_string();
        return Err(DatabaseError::Format { path: path.to_path_buf(), problem });
    }
    Ok(dataset.records.len())
}

/// As [`read`], but columns that the rows of an older engine do not have may be missing.
fn unsealed<P: Recipe>(path: &Path) -> Result<Dataset<P::Row>, DatabaseError> {
    if is_sqlite(path)? {
        return read_rows(path);
    }
    let mut provenance = csv_file::provenance(path)?;
    let missing = csv_file::missing::<P::Row>(path)?;
    let is_older =
        provenance.get("engine_version").is_some_and(|version| *version != P::ENGINE_VERSION.to_string());
    if missing.is_empty() || !is_older || checksum::is_sealed(&provenance) {
        return read_rows(path);
    }
    provenance.insert(csv_file::ABSENT.to_string(), missing.join(" "));
    csv_file::with_provenance(path, provenance).map(|(dataset, _)| dataset)
}

/// The largest number of significant digits among all floats.
fn digits_of<R: Row>(records: &[R]) -> usize {
    let digits = |value: rusqlite::types::Value| match value {
        rusqlite::types::Value::Real(real) => {
            let text = format!("{real:e}");
            text.split('e').next().unwrap_or_default().bytes().filter(u8::is_ascii_digit).count()
        }
        _ => 0,
    };
    records.iter().flat_map(Row::values).map(digits).max().unwrap_or(0)
}

/// The record with its floats rounded to `digits` significant digits.
fn rounded<R: Row>(record: &R, digits: usize) -> R {
    let mut fields = serde_json::json!(record);
    for value in fields.as_object_mut().into_iter().flat_map(|map| map.values_mut()) {
        if let Some(number) = value.as_f64().filter(|_| value.is_f64()) {
            let text = format!("{number:.*e}", digits.max(1) - 1);
            *value = text.parse::<f64>().map_or(serde_json::Value::Null, Into::into);
        }
    }
    serde_json::from_value(fields).unwrap_or_else(|_| record.clone())
}

/// gzip without name or date in its header, so that the same text gives the same bytes.
fn compressed(text: &[u8]) -> std::io::Result<Vec<u8>> {
    let mut encoder = flate2::write::GzEncoder::new(Vec::new(), flate2::Compression::best());
    encoder.write_all(text)?;
    encoder.finish()
}
