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

use super::Dataset;
pub use laws::Violation;
pub use noise::Noise;
pub use statistics::{Mean, SizeEffect};

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

/// Checks a database.
pub fn check(dataset: &Dataset) -> Report {
    let mut violations = laws::violations(dataset);
    let symmetry = statistics::symmetry(&dataset.records);
    violations.extend(symmetry.iter().filter_map(Mean::violation));
    Report {
        rows: dataset.records.len(),
        violations,
        symmetry,
        sizes: statistics::sizes(&dataset.records),
        noise: noise::noise(&dataset.records),
    }
}

#[cfg(test)]
mod tests;
