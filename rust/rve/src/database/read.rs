//! Reading a database or its CSV with its provenance, one file or several together.

use super::plan::{Plan, RampName};
use super::provenance::{SHA256, sha256};
use super::recipe::Recipe;
use super::record::Record;
use super::spheres::SphereRecord;
use super::table::Row;
use super::{DatabaseError, Dataset, Grains, Violation, csv_file, grains, store};
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

/// Number of violations that an error message lists.
const NAMED: usize = 3;

/// Reads a database of discs, or the CSV that was exported from one (plain or gzip) with its provenance next to it.
///
/// # Errors
/// [`DatabaseError::Incomplete`] when packings of the plan are missing; [`DatabaseError`] for what cannot be read.
pub fn read(path: &Path) -> Result<Dataset, DatabaseError> {
    if grains(path)? == Grains::Spheres {
        return Err(DatabaseError::Spheres { path: path.to_path_buf() });
    }
    read_rows(path)
}

/// As [`read`], of spheres.
///
/// # Errors
/// Those of [`read`].
pub fn read_spheres(path: &Path) -> Result<Dataset<SphereRecord>, DatabaseError> {
    read_rows(path)
}

/// As [`read`], of rows of the given type.
pub(super) fn read_rows<R: Row>(path: &Path) -> Result<Dataset<R>, DatabaseError> {
    let dataset = inspect(path)?;
    if path.is_dir() {
        store::complete(path, &dataset.provenance)?;
    }
    Ok(dataset)
}

/// As [`read`], also of a database of which packings are missing.
///
/// # Errors
/// [`DatabaseError`] for what cannot be read.
pub fn inspect<R: Row>(path: &Path) -> Result<Dataset<R>, DatabaseError> {
    let mut dataset: Dataset<R> = match store::is_folder(path)? {
        true => store::read(path)?,
        false => csv_file::read(path)?,
    };
    dataset.records.sort_by(|a, b| (a.packing(), a.order()).cmp(&(b.packing(), b.order())));
    Ok(dataset)
}

/// Returns an error when a law is violated; `path` is the file named in it.
///
/// # Errors
/// [`DatabaseError::Unsound`] with the first violations.
pub(super) fn sound<P: Recipe>(path: &Path, dataset: &Dataset<P::Row>) -> Result<(), DatabaseError> {
    let violations = P::violations(dataset);
    if violations.is_empty() {
        return Ok(());
    }
    let first: Vec<String> = violations.iter().take(NAMED).map(Violation::to_string).collect();
    Err(DatabaseError::Unsound { path: path.to_path_buf(), count: violations.len(), first: first.join("; ") })
}

/// Provenance entries that must be equal in databases that are read as one: rows of other grains or of another engine
/// cannot be mixed.
const SHARED: [&str; 5] = ["engine_version", "material", "radius_distribution", "radius_min", "radius_max"];

/// Reads several databases as one dataset; all must obey the laws. The packings of each file are numbered after those
/// of the files before it; `plan_hash` becomes a hash over the hashes of all plans.
///
/// # Errors
/// Those of [`read`]; [`DatabaseError::Unsound`] for what `check::violations` finds; [`DatabaseError::Mismatch`] for
/// databases of different grains or engines; [`DatabaseError::Twice`] for a packing that stands in two of them.
pub fn read_all(paths: &[PathBuf]) -> Result<Dataset, DatabaseError> {
    let mut all = Dataset { records: Vec::new(), provenance: BTreeMap::new() };
    let mut plans = Vec::new();
    let mut known = ReadPackings::default();
    for path in paths {
        let dataset = read(path)?;
        sound::<Plan>(path, &dataset)?;
        known.add(path, &dataset.records)?;
        let Dataset { mut records, provenance } = dataset;
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
        let hash = sha256(plans.concat().as_bytes());
        all.provenance.insert("plan_hash".to_string(), hash);
        // This hash is that of the first file alone.
        all.provenance.remove(SHA256);
    }
    Ok(all)
}

/// Together with the grains, these decide a packing: seed, discs, compression, region (which implies the boundary).
type Key = (u64, u64, String, String);

/// The packings of the files read so far.
#[derive(Default)]
struct ReadPackings(BTreeMap<Key, Vec<Packing>>);

struct Packing {
    /// Target porosity and friction angle while packing; exports may have rounded them.
    made: [f64; 2],
    file: PathBuf,
    packing: i64,
}

/// Largest relative change of a value by rounding to three digits.
const ROUNDING: f64 = 0.006;

impl ReadPackings {
    /// Adds the packings of a file. A packing that is known already is an error: it would be in both the packings for
    /// training and those held out for testing.
    fn add(&mut self, path: &Path, records: &[Record]) -> Result<(), DatabaseError> {
        for record in records.iter().filter(|record| record.ramp == RampName::Packed) {
            let key = (record.seed, record.discs, format!("{:?}", record.compression), record.region.clone());
            let made = [record.target_porosity, record.packing_friction_angle];
            let like = |other: &&Packing| {
                made.iter().zip(other.made).all(|(a, b)| (a - b).abs() <= ROUNDING * a.abs().max(b.abs()))
            };
            let others = self.0.entry(key).or_default();
            if let Some(other) = others.iter().find(like) {
                return Err(DatabaseError::Twice {
                    path: path.to_path_buf(),
                    packing: record.packing,
                    other: other.file.clone(),
                    other_packing: other.packing,
                });
            }
            others.push(Packing { made, file: path.to_path_buf(), packing: record.packing });
        }
        Ok(())
    }
}
