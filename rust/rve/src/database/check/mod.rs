//! Whether a database is sound: exact laws on every row, symmetry of the protocol, and how much its outputs scatter.
//!
//! | module | what |
//! |---|---|
//! | `laws` | what must hold on every row |
//! | `statistics` | mirror symmetry of isotropic packings; small packings against large ones |
//! | `noise` | scatter of the outputs at equal inputs |
//! | `local` | local linear regression |

mod laws;
mod local;
mod noise;
mod statistics;

use super::{DatabaseError, Dataset};
pub use laws::Violation;
pub use noise::Noise;
pub use statistics::{Mean, SizeEffect};
use std::path::Path;

/// What a check has found.
#[derive(Clone, Debug)]
pub struct Report {
    pub rows: usize,
    /// Laws that do not hold, with the row. A mirror symmetry off by more than four standard errors is one, too.
    pub violations: Vec<Violation>,
    /// Means that vanish by symmetry, over the isotropic packings of one size.
    pub symmetry: Vec<Mean>,
    /// Packed states of other sizes against those of the most frequent one.
    pub sizes: Vec<SizeEffect>,
    /// Scatter at equal inputs, by size.
    pub noise: Vec<Noise>,
}

/// Violations that a message names.
const NAMED: usize = 3;

/// Every law that does not hold.
pub fn violations(dataset: &Dataset) -> Vec<Violation> {
    let mut violations = laws::violations(dataset);
    violations.extend(statistics::symmetry(&dataset.records).iter().filter_map(Mean::violation));
    violations
}

/// Refuses a dataset on which a law does not hold; `path` names it.
///
/// # Errors
/// [`DatabaseError::Unsound`] with the first violations.
pub fn sound(path: &Path, dataset: &Dataset) -> Result<(), DatabaseError> {
    let violations = violations(dataset);
    if violations.is_empty() {
        return Ok(());
    }
    let first: Vec<String> = violations.iter().take(NAMED).map(ToString::to_string).collect();
    Err(DatabaseError::Unsound { path: path.to_path_buf(), count: violations.len(), first: first.join("; ") })
}

/// Checks a database.
pub fn check(dataset: &Dataset) -> Report {
    Report {
        rows: dataset.records.len(),
        violations: violations(dataset),
        symmetry: statistics::symmetry(&dataset.records),
        sizes: statistics::sizes(&dataset.records),
        noise: noise::noise(&dataset.records),
    }
}

#[cfg(test)]
mod tests;
