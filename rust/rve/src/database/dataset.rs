//! Rows and where they come from.

use super::DatabaseError;
use super::record::Record;
use std::collections::BTreeMap;
use std::path::Path;

/// Provenance key of a rounded export: significant digits of its floats.
pub(super) const DIGITS: &str = "digits";

/// Rows and where they come from.
#[derive(Clone, Debug, PartialEq)]
pub struct Dataset {
    /// In order of packing, ramp and stop, whatever their order in the file: what is trained on them does not depend on it.
    pub records: Vec<Record>,
    pub provenance: BTreeMap<String, String>,
}

/// The dataset, unless it is not what was written.
pub(super) fn undamaged(path: &Path, dataset: Dataset, damage: &[String]) -> Result<Dataset, DatabaseError> {
    match damage {
        [] => Ok(dataset),
        damage => Err(DatabaseError::Damaged { path: path.to_path_buf(), problem: damage.join("; ") }),
    }
}
