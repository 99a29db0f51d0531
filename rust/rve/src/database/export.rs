//! Export as CSV, with a column dictionary and the provenance in files next to it.

use super::csv_file::{self, beside, is_gzip_name, prepared};
use super::provenance::{self, DIGITS, SHA256, hash_of};
use super::read::read_rows;
use super::table::Row;
use super::{DatabaseError, Grains, Record, SphereRecord, grains};
use msdd_files::{check_target, write};
use std::path::Path;

/// Writes the database as CSV (first line: column names; floats in the shortest form that reads back exactly), with
/// FILE.columns.csv (name, unit, meaning) and FILE.provenance.json next to it. A name that ends in .gz is compressed.
/// With `digits`, floats are rounded to that many significant digits, which makes the file smaller. Returns the number
/// of rows.
///
/// # Errors
/// Those of `read`; [`DatabaseError::File`] when a file cannot be written.
pub fn export_csv(database: &Path, csv: &Path, digits: Option<usize>) -> Result<usize, DatabaseError> {
    check_target(csv)?;
    match grains(database)? {
        Grains::Discs => export_rows::<Record>(database, csv, digits),
        Grains::Spheres => export_rows::<SphereRecord>(database, csv, digits),
    }
}

fn export_rows<R: Row>(database: &Path, csv: &Path, digits: Option<usize>) -> Result<usize, DatabaseError> {
    let mut dataset = read_rows::<R>(database)?;
    if let Some(digits) = digits {
        dataset.records.iter_mut().for_each(|record| *record = prepared(record, Some(digits)));
        // A database that was rounded before cannot regain digits.
        let before = dataset.provenance.get(DIGITS).and_then(|digits| digits.parse().ok());
        let digits = before.map_or(digits, |before: usize| before.min(digits));
        dataset.provenance.insert(DIGITS.to_string(), digits.to_string());
    }
    let mut dictionary = csv::Writer::from_writer(Vec::new());
    let names = R::COLUMNS.iter().map(|column| [column.0, column.2, column.3]);
    [["name", "unit", "meaning"]]
        .into_iter()
        .chain(names)
        .try_for_each(|row| dictionary.write_record(row))
        .map_err(|source| DatabaseError::Csv { path: csv.to_path_buf(), source })?;
    let mut text = csv_file::text(csv, &dataset.records)?;
    let hash = hash_of(&dataset.provenance, &text);
    dataset.provenance.insert(SHA256.to_string(), hash);
    if is_gzip_name(csv) {
        text = csv_file::compressed(csv, &text)?;
    }
    write(&beside(csv, "columns.csv"), &csv_file::finished(csv, dictionary)?)?;
    provenance::put(&beside(csv, "provenance.json"), &dataset.provenance)?;
    write(csv, &text)?;
    Ok(dataset.records.len())
}
