//! Checksums over the rows, the provenance and the table of columns of a database, kept in its provenance: any changed
//! bit of a number, a name or the plan is detected.

use super::Dataset;
use super::table::Row;
use rusqlite::types::Value;
use sha2::{Digest, Sha256};
use std::collections::BTreeMap;

/// Keys of the checksums in the provenance. A file either has all of them, or none when an older program wrote it.
const ROWS: &str = "rows_sha256";
const DICTIONARY: &str = "columns_sha256";
const PROVENANCE: &str = "provenance_sha256";
const KEYS: [&str; 3] = [ROWS, DICTIONARY, PROVENANCE];

type Provenance = BTreeMap<String, String>;

/// Whether there are checksums.
pub(super) fn is_sealed(provenance: &Provenance) -> bool {
    KEYS.iter().any(|key| provenance.contains_key(*key))
}

/// Removes the checksums.
pub(super) fn unseal(provenance: &mut Provenance) {
    KEYS.iter().for_each(|key| drop(provenance.remove(*key)));
}

/// Sets the checksums of these rows and of the rest of the provenance, replacing older ones.
pub(super) fn seal<R: Row>(provenance: &mut Provenance, records: &[R]) {
    provenance.insert(ROWS.to_string(), hex(&of_rows(records)));
    provenance.insert(DICTIONARY.to_string(), of_dictionary(R::COLUMNS.iter().map(|c| [c.0, c.2, c.3])));
    seal_provenance(provenance);
}

/// Extends the checksums to the additional rows `records`; does nothing when there are no checksums.
pub(super) fn add<R: Row>(provenance: &mut Provenance, records: &[R]) {
    let Some(sum) = provenance.get(ROWS).and_then(|text| from_hex(text)) else { return };
    let added = of_rows(records);
    let sum: [u8; 32] = std::array::from_fn(|k| sum[k] ^ added[k]);
    provenance.insert(ROWS.to_string(), hex(&sum));
    seal_provenance(provenance);
}

/// Renews the checksum of the provenance after it has changed; does nothing when there are no checksums.
pub(super) fn seal_provenance(provenance: &mut Provenance) {
    if is_sealed(provenance) {
        provenance.insert(PROVENANCE.to_string(), of_provenance(provenance));
    }
}

/// Describes each part that differs from its checksum; empty when there are no checksums.
pub(super) fn damage<R: Row>(dataset: &Dataset<R>) -> Vec<String> {
    let provenance = &dataset.provenance;
    if !is_sealed(provenance) {
        return Vec::new();
    }
    let expected = [
        (ROWS, hex(&of_rows(&dataset.records)), "rows"),
        (PROVENANCE, of_provenance(provenance), "provenance"),
    ];
    let differs = |(key, found, what): &(&str, String, &str)| {
        (provenance.get(*key) != Some(found))
            .then(|| format!("its {what} are not what was written: {key} does not agree"))
    };
    expected.iter().filter_map(differs).collect()
}

/// Describes the damage when the table of columns differs from its checksum; none when there is no checksum.
pub(super) fn dictionary_damage(provenance: &Provenance, rows: &[[String; 3]]) -> Option<String> {
    let found = of_dictionary(rows.iter().map(|row| [row[0].as_str(), &row[1], &row[2]]));
    (is_sealed(provenance) && provenance.get(DICTIONARY) != Some(&found))
        .then(|| format!("its table of columns is not what was written: {DICTIONARY} does not agree"))
}

/// Exclusive or of the hashes of all rows. It does not depend on the order of rows, so it can be extended packing by
/// packing, and shards combine to the checksum of the whole. No two rows are alike, because each has its own packing,
/// ramp and stop. A column that older files do not have counts, with its name, where it has a value only, so that their
/// checksums stay what they were.
fn of_rows<R: Row>(records: &[R]) -> [u8; 32] {
    let mut sum = [0; 32];
    let mut text = Vec::new();
    for record in records {
        text.clear();
        for (column, value) in R::COLUMNS.iter().zip(record.values()) {
            if R::later().contains(&column.0) {
                if value == Value::Null {
                    continue;
                }
                text.push(LATER_COLUMN);
                append_text(&mut text, column.0);
            }
            append(&mut text, &value);
        }
        sum.iter_mut().zip(Sha256::digest(&text)).for_each(|(sum, byte)| *sum ^= byte);
    }
    sum
}

/// Stands before the name of a column of [`Row::later`]; the kinds of values have the bytes 0 to 4.
const LATER_COLUMN: u8 = 5;

fn append(text: &mut Vec<u8>, value: &Value) {
    match value {
        Value::Null => text.push(0),
        Value::Integer(integer) => {
            text.push(1);
            text.extend(integer.to_le_bytes());
        }
        // SQLite stores -0 as 0.
        Value::Real(real) => {
            text.push(2);
            text.extend((real + 0.0).to_bits().to_le_bytes());
        }
        Value::Text(string) => append_text(text, string),
        Value::Blob(_) => text.push(4),
    }
}

fn append_text(text: &mut Vec<u8>, string: &str) {
    text.push(3);
    text.extend((string.len() as u64).to_le_bytes());
    text.extend(string.as_bytes());
}

/// Hash of all entries but its own.
fn of_provenance(provenance: &Provenance) -> String {
    let mut text = Vec::new();
    for (key, value) in provenance.iter().filter(|(key, _)| *key != PROVENANCE) {
        append_text(&mut text, key);
        append_text(&mut text, value);
    }
    hex(&Sha256::digest(&text))
}

/// Hash of name, unit and meaning of the columns.
fn of_dictionary<'a>(rows: impl Iterator<Item = [&'a str; 3]>) -> String {
    let mut text = Vec::new();
    rows.flatten().for_each(|string| append_text(&mut text, string));
    hex(&Sha256::digest(&text))
}

fn hex(bytes: &[u8]) -> String {
    bytes.iter().map(|byte| format!("{byte:02x}")).collect()
}

fn from_hex(text: &str) -> Option<[u8; 32]> {
    let mut bytes = [0; 32];
    let digits = text.as_bytes();
    if digits.len() != 64 {
        return None;
    }
    for (byte, pair) in bytes.iter_mut().zip(digits.chunks_exact(2)) {
        *byte = u8::from_str_radix(std::str::from_utf8(pair).ok()?, 16).ok()?;
    }
    Some(bytes)
}
