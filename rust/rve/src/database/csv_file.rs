//! Reading CSV: all columns, each row once, with limits on the size.

use super::table::{Column, Row};
use super::{DatabaseError, Dataset, checksum};
use crate::message::shortened;
use msdd_files::{FileError, MAX_BYTES};
use rusqlite::types::ValueRef;
use std::collections::{BTreeMap, BTreeSet};
use std::io::{self, Read};
use std::path::{Path, PathBuf};

/// Longest line [bytes]. A row has about 700.
const LONGEST_LINE: u64 = 1 << 20;

/// Provenance key for files from before some columns existed: the names of these columns.
pub(super) const ABSENT: &str = "absent_columns";

/// Files that belong to a CSV, compressed or not: the column dictionary and the provenance.
pub(super) fn beside(csv: &Path, what: &str) -> PathBuf {
    let plain = if is_gzip_name(csv) { csv.with_extension("") } else { csv.to_path_buf() };
    plain.with_extension(what)
}

pub(super) fn is_gzip_name(path: &Path) -> bool {
    path.extension().is_some_and(|extension| extension == "gz")
}

/// Rows and provenance, and a description of each part that differs from its checksum.
pub(super) fn inspected<R: Row>(path: &Path) -> Result<(Dataset<R>, Vec<String>), DatabaseError> {
    with_provenance(path, provenance(path)?)
}

/// As [`inspected`], with a given provenance.
pub(super) fn with_provenance<R: Row>(
    path: &Path,
    provenance: BTreeMap<String, String>,
) -> Result<(Dataset<R>, Vec<String>), DatabaseError> {
    let file =
        std::fs::File::open(path).map_err(|source| FileError::Read { file: path.to_path_buf(), source })?;
    let absent: Vec<&str> = provenance.get(ABSENT).map_or("", String::as_str).split_whitespace().collect();
    let records = records(path, file, &absent)?;
    let dataset = Dataset { records, provenance };
    let damage = checksum::damage(&dataset);
    Ok((dataset, damage))
}

pub(super) fn provenance(csv: &Path) -> Result<BTreeMap<String, String>, DatabaseError> {
    let origin = beside(csv, "provenance.json");
    let text = match msdd_files::read_text(&origin) {
        Err(FileError::Read { source, .. }) if source.kind() == io::ErrorKind::NotFound => {
            let problem = format!(
                "there is no {} beside it, the file that says where the rows come from",
                origin.display()
            );
            return Err(DatabaseError::Format { path: csv.to_path_buf(), problem });
        }
        text => text?,
    };
    serde_json::from_str(&text).map_err(|error| {
        let problem = format!("it is not the provenance file of a CSV: {}", shortened(&error.to_string()));
        DatabaseError::Format { path: origin, problem }
    })
}

/// The names of the columns of a plain or compressed CSV; none of what is no text of columns.
pub(super) fn head(path: &Path) -> Result<Option<csv::ByteRecord>, DatabaseError> {
    let file =
        std::fs::File::open(path).map_err(|source| FileError::Read { file: path.to_path_buf(), source })?;
    Ok(reader(path, file).ok().and_then(|mut reader| reader.byte_headers().ok().cloned()))
}

/// Names of columns that the file does not have, and that are not among those that any older file may lack.
pub(super) fn missing<R: Row>(path: &Path) -> Result<Vec<&'static str>, DatabaseError> {
    let file =
        std::fs::File::open(path).map_err(|source| FileError::Read { file: path.to_path_buf(), source })?;
    let mut reader = reader(path, file)?;
    let head = reader.byte_headers().map_err(csv_error(path))?;
    let absent = |name: &&str| !head.iter().any(|known| known == name.as_bytes());
    let needed = R::COLUMNS.iter().map(|column| column.0).filter(|name| !R::later().contains(name));
    Ok(needed.filter(absent).collect())
}

/// Reads rows from a plain or compressed text. `path` names the file in errors; the columns `absent` and those that files
/// of an older schema do not have may be missing.
///
/// # Errors
/// [`DatabaseError::Format`] for columns that are missing or unknown; [`DatabaseError::Value`] for a value of the wrong
/// kind or a row that occurs twice; [`DatabaseError::Csv`] for other faults of the text.
pub fn records<R: Row>(path: &Path, text: impl Read, absent: &[&str]) -> Result<Vec<R>, DatabaseError> {
    let failed = csv_error(path);
    let mut reader = reader(path, text)?;
    let columns = columns::<R>(path, reader.byte_headers().map_err(&failed)?, absent)?;
    let (mut rows, mut places) = (Vec::new(), BTreeSet::new());
    let mut fields = csv::ByteRecord::new();
    while reader.read_byte_record(&mut fields).map_err(&failed)? {
        let value = |(column, problem)| DatabaseError::Value {
            path: path.to_path_buf(),
            table: "the CSV",
            row: rows.len() as u64 + 1,
            column,
            problem,
        };
        let field = |k: usize| columns[k].and_then(|k| fields.get(k)).unwrap_or_default();
        let row = R::from_cells(|k| cell(R::COLUMNS[k].1, field(k))).map_err(value)?;
        // A small compressed file can unpack to the same row a million times, so duplicates end the reading at once.
        if !places.insert((row.packing(), row.place())) {
            return Err(value(("stop", format!("{} stands twice", row.name()))));
        }
        rows.push(row);
    }
    Ok(rows)
}

fn csv_error(path: &Path) -> impl Fn(csv::Error) -> DatabaseError + use<> {
    let path = path.to_path_buf();
    move |source| DatabaseError::Csv { path: path.clone(), source }
}

/// The lines of a plain or compressed text.
fn reader<'a>(
    path: &Path,
    mut text: impl Read + 'a,
) -> Result<csv::Reader<Bounded<Box<dyn Read + 'a>>>, DatabaseError> {
    let mut start = Vec::new();
    let failed = csv_error(path);
    text.by_ref().take(2).read_to_end(&mut start).map_err(|error| failed(error.into()))?;
    let packed = start == [0x1f, 0x8b];
    let whole = io::Cursor::new(start).chain(text);
    let plain: Box<dyn Read + 'a> =
        if packed { Box::new(flate2::read::GzDecoder::new(whole)) } else { Box::new(whole) };
    Ok(csv::Reader::from_reader(Bounded { text: plain, left: MAX_BYTES, line: 0 }))
}

/// The position of each column in the file.
fn columns<R: Row>(
    path: &Path,
    head: &csv::ByteRecord,
    absent: &[&str],
) -> Result<Vec<Option<usize>>, DatabaseError> {
    let problem = |problem| DatabaseError::Format { path: path.to_path_buf(), problem };
    let known = |name: &[u8]| R::COLUMNS.iter().any(|column| column.0.as_bytes() == name);
    let mut seen = BTreeSet::new();
    if let Some(name) = head.iter().find(|name| !known(name) || !seen.insert(name.to_vec())) {
        let name = shortened(&String::from_utf8_lossy(name));
        return Err(problem(format!("column '{name}' is unknown or stands twice")));
    }
    let place = |column: &Column| {
        let found = head.iter().position(|name| name == column.0.as_bytes());
        match found.is_some() || absent.contains(&column.0) || R::later().contains(&column.0) {
            true => Ok(found),
            false => Err(problem(format!(
                "column {} is missing; every column is needed, unless an older program wrote the rows and the file was sealed without it",
                column.0
            ))),
        }
    };
    R::COLUMNS.iter().map(place).collect()
}

/// Converts a field to a value of its column's type; an empty field is an absent value.
fn cell<'a>(kind: &str, field: &'a [u8]) -> Result<ValueRef<'a>, String> {
    let number = |allowed: &str| {
        let found = shortened(&String::from_utf8_lossy(field));
        format!("'{found}', allowed: {allowed}")
    };
    let text = || std::str::from_utf8(field).unwrap_or_default();
    match (field, kind) {
        ([], _) => Ok(ValueRef::Null),
        (_, "INTEGER") => text().parse().map(ValueRef::Integer).map_err(|_| number("a whole number")),
        (_, "REAL") => text().parse().map(ValueRef::Real).map_err(|_| number("a finite number")),
        _ => Ok(ValueRef::Text(field)),
    }
}

/// A reader that returns an error when the text, or one line of it, is longer than any valid table.
struct Bounded<R> {
    text: R,
    /// Bytes that may still be read.
    left: u64,
    /// Bytes since the end of the last line.
    line: u64,
}

impl<R: Read> Read for Bounded<R> {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        let count = self.text.read(buffer)?;
        let last = buffer[..count].iter().rposition(|byte| *byte == b'\n');
        self.line = last.map_or(self.line + count as u64, |end| (count - 1 - end) as u64);
        if self.line > LONGEST_LINE {
            return Err(io::Error::other(format!("a line has more than {LONGEST_LINE} bytes")));
        }
        let Some(left) = self.left.checked_sub(count as u64) else {
            let problem = format!("unpacked, it has more than {MAX_BYTES} bytes, the most that is read");
            return Err(io::Error::other(problem));
        };
        self.left = left;
        Ok(count)
    }
}
