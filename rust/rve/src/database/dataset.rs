//! The rows of a database with their provenance (where they come from).

use super::DatabaseError;
use super::record::Record;
use super::table::Row;
use std::collections::BTreeMap;
use std::path::Path;

/// Provenance key of a rounded export: number of significant digits of its floats.
pub(super) const DIGITS: &str = "digits";

/// The rows of a database with their provenance.
#[derive(Clone, Debug, PartialEq)]
pub struct Dataset<R = Record> {
    /// In the order of packing, ramp and stop, whatever the order in the file, so that a model trained on them does not
    /// depend on that.
    pub records: Vec<R>,
    pub provenance: BTreeMap<String, String>,
}

/// Returns the dataset, or an error when `damage` says that it differs from its checksums.
pub(super) fn undamaged<R: Row>(
    path: &Path,
    dataset: Dataset<R>,
    damage: &[String],
) -> Result<Dataset<R>, DatabaseError> {
    match damage {
        [] => Ok(dataset),
        damage => Err(DatabaseError::Damaged { path: path.to_path_buf(), problem: damage.join("; ") }),
    }
}
