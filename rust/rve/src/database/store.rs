//! The database: a folder with the rows of each packing as a compressed CSV, `packing-<number>.csv.gz`, and with
//! `provenance.json`. Each file is written whole or not at all, so that several processes may work on one database, and a
//! killed one loses only the packings that it was working on.

use super::provenance::{self, Provenance};
use super::recipe::{Recipe, planned};
use super::table::Row;
use super::{DatabaseError, Dataset, csv_file};
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

const PROVENANCE_FILE: &str = "provenance.json";
/// Most packings that an error names.
const NAMED: usize = 20;

/// Whether the path is a database, and not a CSV.
///
/// # Errors
/// [`DatabaseError::Format`] for a database of version 0.2, which was one SQLite file.
pub(super) fn is_folder(path: &Path) -> Result<bool, DatabaseError> {
    if path.is_dir() {
        return Ok(true);
    }
    let mut start = [0; 16];
    let read =
        std::fs::File::open(path).and_then(|mut file| std::io::Read::read_exact(&mut file, &mut start));
    if read.is_ok() && &start == b"SQLite format 3\0" {
        let problem = "it is an SQLite file of version 0.2; export it as CSV by that version".to_string();
        return Err(DatabaseError::Format { path: path.to_path_buf(), problem });
    }
    Ok(false)
}

/// The provenance of a database of a plan.
fn of_plan<P: Recipe>(plan: &P, commit: &str) -> Provenance {
    let pairs = [
        ("schema", P::Row::SCHEMA.to_string()),
        ("engine_version", P::ENGINE_VERSION.to_string()),
        ("commit", commit.to_string()),
        ("plan", plan.text().to_string()),
        ("plan_hash", plan.hash()),
    ];
    pairs.into_iter().chain(plan.grains()).map(|(key, value)| (key.to_string(), value)).collect()
}

/// Makes the folder of a plan, or checks that an existing one belongs to it. `commit` is that of the program: it is listed,
/// but not compared.
///
/// # Errors
/// [`DatabaseError::Mismatch`] for another plan or engine; [`DatabaseError::Format`] for a folder with other files.
pub(super) fn open<P: Recipe>(folder: &Path, plan: &P, commit: &str) -> Result<(), DatabaseError> {
    let failed = |source| msdd_files::FileError::Write { file: folder.to_path_buf(), source };
    std::fs::create_dir_all(folder).map_err(failed)?;
    let file = folder.join(PROVENANCE_FILE);
    // Before the provenance is read: another process that works on the plan writes packings after it.
    let others = msdd_files::list(folder)?.iter().any(|file| !is_temporary(file));
    let mut expected = of_plan(plan, commit);
    if let Some(found) = provenance::read(&file)? {
        for key in ["schema", "engine_version", "plan_hash"] {
            provenance::expect(folder, &found, key, &expected[key])?;
        }
        let joined = provenance::join_commits([found.get("commit").map_or("", String::as_str), commit]);
        expected.insert("commit".to_string(), joined);
        if found == expected {
            return Ok(());
        }
    } else if others {
        let problem = format!("it has files, but no {PROVENANCE_FILE}");
        return Err(DatabaseError::Format { path: folder.to_path_buf(), problem });
    }
    provenance::put(&file, &expected)
}

/// Whether a file is a lock, or is being written.
fn is_temporary(file: &Path) -> bool {
    file.extension().is_some_and(|extension| extension == "lock" || extension == "part")
}

/// The files of the packings that are there.
pub(super) fn packings(folder: &Path) -> Result<BTreeMap<i64, PathBuf>, DatabaseError> {
    let number = |file: &PathBuf| -> Option<i64> {
        file.file_name()?.to_str()?.strip_prefix("packing-")?.strip_suffix(".csv.gz")?.parse().ok()
    };
    Ok(msdd_files::list(folder)?.into_iter().filter_map(|file| Some((number(&file)?, file))).collect())
}

/// Writes the rows of a packing.
pub(super) fn insert<R: Row>(folder: &Path, records: &[R]) -> Result<(), DatabaseError> {
    let Some(first) = records.first() else { return Ok(()) };
    let file = folder.join(format!("packing-{:06}.csv.gz", first.packing()));
    let text = csv_file::text(&file, records)?;
    Ok(msdd_files::write(&file, &csv_file::compressed(&file, &text)?)?)
}

pub(super) fn provenance_of(folder: &Path) -> Result<Provenance, DatabaseError> {
    provenance::read(&folder.join(PROVENANCE_FILE))?.ok_or_else(|| DatabaseError::Format {
        path: folder.to_path_buf(),
        problem: format!("there is no {PROVENANCE_FILE} in it"),
    })
}

/// All rows that are there.
pub(super) fn read<R: Row>(folder: &Path) -> Result<Dataset<R>, DatabaseError> {
    let provenance = provenance_of(folder)?;
    let mut records = Vec::new();
    for (number, file) in packings(folder)? {
        let rows: Vec<R> = csv_file::rows(&file, &provenance)?;
        if let Some(row) = rows.iter().find(|row| row.packing() != number) {
            let problem = format!("it has a row of {}", row.name());
            return Err(DatabaseError::Format { path: file, problem });
        }
        records.extend(rows);
    }
    Ok(Dataset { records, provenance })
}

/// Checks that all packings of the plan are there, and that the provenance agrees with the plan.
///
/// # Errors
/// [`DatabaseError::Incomplete`], [`DatabaseError::Mismatch`].
pub(super) fn complete(folder: &Path, provenance: &Provenance) -> Result<(), DatabaseError> {
    let plan = provenance.get("plan").map_or("", String::as_str);
    let (all, entries) = planned(plan, &format!("the plan in {}", folder.join(PROVENANCE_FILE).display()))?;
    for (key, expected) in entries {
        provenance::expect(folder, provenance, key, &expected)?;
    }
    let present = packings(folder)?;
    let missing: Vec<String> =
        all.iter().filter(|packing| !present.contains_key(packing)).map(i64::to_string).collect();
    if missing.is_empty() {
        return Ok(());
    }
    let more = if missing.len() > NAMED { ", …" } else { "" };
    let list = missing[..missing.len().min(NAMED)].join(", ") + more;
    Err(DatabaseError::Incomplete { path: folder.to_path_buf(), missing: missing.len(), of: all.len(), list })
}
