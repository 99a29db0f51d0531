//! Checks of a database: exact laws on every row, and mirror symmetry of the means.
//!
//! | module | what |
//! |---|---|
//! | `laws` | exact laws that every row must obey |
//! | `increments` | laws of the rows of paths, each against the row that it starts from |
//! | `twins` | equal packings that were reached by strain of the grains and of the box |
//! | `statistics` | mirror symmetry of isotropic packings |
//! | `planned` | rows against the plan; the tolerance |

mod increments;
mod laws;
pub(super) mod planned;
pub(super) mod statistics;
mod twins;

use super::{Dataset, Violation};
pub use statistics::Mean;

/// Results of a check.
#[derive(Clone, Debug)]
pub struct Report {
    /// Violated laws, each with its row. A mean that should vanish by symmetry but is off by more than four standard
    /// errors counts as one.
    pub violations: Vec<Violation>,
    /// Means over the isotropic packings of one size that vanish by symmetry.
    pub symmetry: Vec<Mean>,
}

/// All violated laws of a dataset, those of symmetry included.
pub fn violations(dataset: &Dataset) -> Vec<Violation> {
    let mut violations = laws::violations(dataset);
    violations.extend(increments::violations(dataset));
    violations.extend(twins::violations(dataset));
    violations.extend(statistics::symmetry(&dataset.records).iter().filter_map(Mean::violation));
    violations
}

/// Checks a database.
pub fn check(dataset: &Dataset) -> Report {
    Report { violations: violations(dataset), symmetry: statistics::symmetry(&dataset.records) }
}

#[cfg(test)]
mod tests;
