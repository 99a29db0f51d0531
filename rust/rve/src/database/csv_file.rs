//! CSV: all columns, each row once, with limits on the size.

use super::provenance::{self, ABSENT, Provenance, SHA256, hash_of};
use super::table::{Column, Row};
use super::{DatabaseError, Dataset};
use crate::message::{number, shortened};
use msdd_files::{FileError, MAX_BYTES};
use std::collections::BTreeSet;
use std::io::{self, Read, Write};
use std::path::{Path, PathBuf};

/// Longest line [bytes]. A row has about 700.
const LONGEST_LINE: u64 = 1 << 20;

/// Files that belong to a CSV, compressed or not: the column dictionary and the provenance.
pub(super) fn beside(csv: &Path, what: &str) -> PathBuf {
    let plain = if is_gzip_name(csv) { csv.with_extension("") } else { csv.to_path_buf() };
    plain.with_extension(what)
}

pub(super) fn is_gzip_name(path: &Path) -> bool {
    path.extension().is_some_and(|extension| extension == "gz")
}

/// Rows and provenance.
pub(super) fn read<R: Row>(path: &Path) -> Result<Dataset<R>, DatabaseError> {
    let origin = beside(path, "provenance.json");
    let provenance = provenance::read(&origin)?.ok_or_else(|| {
        let problem = format!(
            "there is no {} next to it, the file that says where the rows come from",
            origin.display()
        );
        DatabaseError::Format { path: path.to_path_buf(), problem }
    })?;
    let records = rows(path, &provenance)?;
    Ok(Dataset { records, provenance })
}

/// The rows of a file, whose text must have the hash of the provenance, if that names one.
pub(super) fn rows<R: Row>(path: &Path, provenance: &Provenance) -> Result<Vec<R>, DatabaseError> {
    let absent: Vec<&str> = provenance.get(ABSENT).map_or("", String::as_str).split_whitespace().collect();
    let file = open(path)?;
    let Some(expected) = provenance.get(SHA256) else { return records(path, file, &absent) };
    let mut text = Vec::new();
    plain(path, file)?.read_to_end(&mut text).map_err(|error| csv_error(path)(error.into()))?;
    if hash_of(provenance, &text) != *expected {
        let problem = format!("it or its provenance is not what was written: {SHA256} does not agree");
        return Err(DatabaseError::Damaged { path: path.to_path_buf(), problem });
    }
    records(path, text.as_slice(), &absent)
}

fn open(path: &Path) -> Result<std::fs::File, DatabaseError> {
    let failed = |source| FileError::Read { file: path.to_path_buf(), source };
    // Only regular files: a pipe can be read only once, and a device has no end.
    if !std::fs::metadata(path).map_err(failed)?.is_file() {
        let problem = "it is no regular file".to_string();
        return Err(DatabaseError::Format { path: path.to_path_buf(), problem });
    }
    Ok(std::fs::File::open(path).map_err(failed)?)
}

/// Rows as text: first the names of the columns; floats in the shortest form that reads back exactly.
pub(super) fn text<R: Row>(path: &Path, records: &[R]) -> Result<Vec<u8>, DatabaseError> {
    let mut rows = csv::Writer::from_writer(Vec::new());
    records.iter().try_for_each(|record| rows.serialize(prepared(record, None))).map_err(csv_error(path))?;
    finished(path, rows)
}

/// The bytes of a table.
pub(super) fn finished(path: &Path, table: csv::Writer<Vec<u8>>) -> Result<Vec<u8>, DatabaseError> {
    table.into_inner().map_err(|error| csv_error(path)(io::Error::other(error.to_string()).into()))
}

/// gzip without name or date in its header, so that the same text gives the same bytes.
pub(super) fn compressed(path: &Path, text: &[u8]) -> Result<Vec<u8>, DatabaseError> {
    let mut encoder = flate2::write::GzEncoder::new(Vec::new(), flate2::Compression::best());
    encoder.write_all(text).and_then(|()| encoder.finish()).map_err(|error| csv_error(path)(error.into()))
}

/// The record as it is written: floats that are not finite are absent, -0 is 0, and floats have `digits` significant digits.
pub(super) fn prepared<R: Row>(record: &R, digits: Option<usize>) -> R {
    let mut fields = serde_json::json!(record);
    for value in fields.as_object_mut().into_iter().flat_map(|map| map.values_mut()) {
        if let Some(number) = value.as_f64().filter(|_| value.is_f64()) {
            let rounded = digits.map(|digits| format!("{number:.*e}", digits.max(1) - 1).parse::<f64>());
            *value = rounded
                .map_or(Ok(number), |rounded| rounded)
                .map_or(serde_json::Value::Null, |x| (x + 0.0).into());
        }
    }
    serde_json::from_value(fields).unwrap_or_else(|_| record.clone())
}

/// The names of the columns of a plain or compressed CSV; none of what is no text of columns.
pub(super) fn head(path: &Path) -> Result<Option<csv::ByteRecord>, DatabaseError> {
    Ok(reader(path, open(path)?).ok().and_then(|mut reader| reader.byte_headers().ok().cloned()))
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
    let head = reader.byte_headers().map_err(&failed)?.clone();
    let columns = columns::<R>(path, &head, absent)?;
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
        let check = |(column, field)| checked(column, field).map_err(|problem| value((column.0, problem)));
        columns.iter().copied().zip(&fields).try_for_each(check)?;
        let row: R = fields.deserialize(Some(&head)).map_err(|error| {
            let csv::ErrorKind::Deserialize { err, .. } = error.kind() else { return failed(error) };
            let unsound =
                |(column, field): &(&&Column, &[u8])| !(column.5)(&csv::ByteRecord::from(vec![*field]));
            let column = columns.iter().zip(&fields).find(unsound).map_or("", |(column, _)| column.0);
            value((column, shortened(&err.kind().to_string())))
        })?;
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
    text: impl Read + 'a,
) -> Result<csv::Reader<Bounded<Box<dyn Read + 'a>>>, DatabaseError> {
    Ok(csv::Reader::from_reader(plain(path, text)?))
}

/// A plain or compressed text, unpacked.
fn plain<'a>(path: &Path, mut text: impl Read + 'a) -> Result<Bounded<Box<dyn Read + 'a>>, DatabaseError> {
    let mut start = Vec::new();
    let failed = csv_error(path);
    text.by_ref().take(2).read_to_end(&mut start).map_err(|error| failed(error.into()))?;
    let packed = start == [0x1f, 0x8b];
    let whole = io::Cursor::new(start).chain(text);
    let plain: Box<dyn Read + 'a> =
        if packed { Box::new(flate2::read::GzDecoder::new(whole)) } else { Box::new(whole) };
    Ok(Bounded { text: plain, left: MAX_BYTES, line: 0 })
}

/// The columns of a file, in its order.
fn columns<R: Row>(
    path: &Path,
    head: &csv::ByteRecord,
    absent: &[&str],
) -> Result<Vec<&'static Column>, DatabaseError> {
    let problem = |problem| DatabaseError::Format { path: path.to_path_buf(), problem };
    let (mut columns, mut seen) = (Vec::new(), BTreeSet::new());
    for name in head {
        let known = R::COLUMNS.iter().find(|column| column.0.as_bytes() == name);
        let Some(column) = known.filter(|column| seen.insert(column.0)) else {
            let name = shortened(&String::from_utf8_lossy(name));
            return Err(problem(format!("column '{name}' is unknown or stands twice")));
        };
        columns.push(column);
    }
    let may_lack = |name: &str| seen.contains(name) || absent.contains(&name) || R::LATER.contains(&name);
    match R::COLUMNS.iter().find(|column| !may_lack(column.0)) {
        Some(column) => Err(problem(format!("column {} is missing; every column is needed", column.0))),
        None => Ok(columns),
    }
}

/// Refuses a field that has no value of its column's kind; an empty field is an absent value.
fn checked(Column(_, kind, _, _, needed, _): &Column, field: &[u8]) -> Result<(), String> {
    let text = std::str::from_utf8(field);
    let real = || text.ok().and_then(|text| text.parse::<f64>().ok());
    let (allowed, sound) = match *kind {
        "INTEGER" => ("a whole number", text.is_ok_and(|text| text.parse::<i64>().is_ok())),
        "REAL" => ("a finite number", real().is_some_and(f64::is_finite)),
        _ => ("a text", text.is_ok()),
    };
    let found = match (field, *kind, text, real()) {
        ([], ..) if *needed => "empty".to_string(),
        ([], ..) => return Ok(()),
        _ if sound => return Ok(()),
        (_, "REAL", _, Some(real)) => number(real),
        (_, "TEXT", Err(error), _) => format!("byte {} is not UTF-8", error.valid_up_to()),
        _ => format!("'{}'", shortened(&String::from_utf8_lossy(field))),
    };
    Err(format!("{found}, allowed: {allowed}"))
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
