//! Where the rows of a database come from: keys and values, in `provenance.json` of a database and in the file next to a CSV.

use super::DatabaseError;
use msdd_files::{Column, FileError, write};
use sha2::{Digest, Sha256};
use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;

pub(super) type Provenance = BTreeMap<String, String>;

/// Provenance key of a rounded export: number of significant digits of its floats.
pub(super) const DIGITS: &str = "digits";
/// Provenance key for files from before some columns existed: the names of these columns.
pub(super) const ABSENT: &str = "absent_columns";
/// Provenance key of a CSV: SHA-256 of the other entries, as JSON, and of its text.
pub(super) const SHA256: &str = "sha256";

/// Keys of the provenance.
pub const PROVENANCE: [Column; 14] = [
    (
        "schema",
        "-",
        "version of the columns: 3; files of version 2, without `fabric_xy` and the columns of paths, are read as well, but not continued; of spheres `spheres 2`; files of `spheres 1`, without `shaking`, are read as well, but not continued",
    ),
    (
        "engine_version",
        "-",
        "version of the engine: another one gives other numbers, and rows of two versions do not mix",
    ),
    ("commit", "-", "commits of the programs that made the rows, where available"),
    ("plan", "-", "text of the plan"),
    ("plan_hash", "-", "SHA-256 of it"),
    ("grains", "-", "`spheres`; absent in databases of discs"),
    ("material", "-", "the grains, as JSON"),
    ("radius_distribution", "-", "`uniform`; this and the next three are absent of spheres"),
    ("radius_min", "m", "least radius"),
    ("radius_max", "m", "largest radius"),
    ("mean_radius", "m", "mean radius"),
    (DIGITS, "-", "significant digits of a CSV that was exported with `--digits`; absent if all are there"),
    (ABSENT, "-", "columns that rows of an older engine do not have; absent if there are none"),
    (SHA256, "-", "of a CSV since version 0.3: SHA-256 of the other entries, as JSON, and of its text"),
];

/// Reads a file of a provenance; `None` if it is missing.
pub(super) fn read(file: &Path) -> Result<Option<Provenance>, DatabaseError> {
    let text = match msdd_files::read_text(file) {
        Err(FileError::Read { source, .. }) if source.kind() == std::io::ErrorKind::NotFound => {
            return Ok(None);
        }
        text => text?,
    };
    serde_json::from_str(&text).map(Some).map_err(|error| {
        let problem = format!(
            "it is not the provenance of a database: {}",
            crate::message::shortened(&error.to_string())
        );
        DatabaseError::Format { path: file.to_path_buf(), problem }
    })
}

pub(super) fn put(file: &Path, provenance: &Provenance) -> Result<(), DatabaseError> {
    Ok(write(file, serde_json::json!(provenance).to_string().as_bytes())?)
}

/// Checks an entry that has to be equal.
pub(super) fn expect(
    file: &Path,
    provenance: &Provenance,
    key: &'static str,
    expected: &str,
) -> Result<(), DatabaseError> {
    let path = file.to_path_buf();
    match provenance.get(key) {
        Some(found) if found == expected => Ok(()),
        Some(found) => {
            Err(DatabaseError::Mismatch { path, key, found: found.clone(), expected: expected.to_string() })
        }
        None => Err(DatabaseError::Format { path, problem: format!("no {key} in its provenance") }),
    }
}

/// All different commits of several lists, sorted.
pub(super) fn join_commits<'a>(lists: impl IntoIterator<Item = &'a str>) -> String {
    let all: BTreeSet<&str> = lists.into_iter().flat_map(|list| list.split(", ")).collect();
    all.into_iter().filter(|commit| !commit.is_empty()).collect::<Vec<_>>().join(", ")
}

/// SHA-256, hexadecimal.
pub(crate) fn sha256(bytes: &[u8]) -> String {
    Sha256::digest(bytes).iter().map(|byte| format!("{byte:02x}")).collect()
}

/// The entry [`SHA256`] of a CSV with this text.
pub(super) fn hash_of(provenance: &Provenance, text: &[u8]) -> String {
    let mut others = provenance.clone();
    others.remove(SHA256);
    sha256(&[serde_json::json!(others).to_string().as_bytes(), text].concat())
}
