//! The rows of a database with their provenance (where they come from).

use super::record::Record;
use std::collections::BTreeMap;

/// The rows of a database with their provenance.
#[derive(Clone, Debug, PartialEq)]
pub struct Dataset<R = Record> {
    /// In the order of packing, ramp and stop, whatever the order in the file, so that a model trained on them does not
    /// depend on that.
    pub records: Vec<R>,
    pub provenance: BTreeMap<String, String>,
}
