//! Checks of a database of spheres.
//!
//! | module | what |
//! |---|---|
//! | `laws` | exact laws that every row must obey |
//! | `increments` | laws of the rows of paths, each against the row that it starts from |
//! | `twins` | equal packings that were reached by strain of the grains and of the box, or in turned boxes |
//! | `symmetry` | isotropic packings have no direction |

mod increments;
mod laws;
mod symmetry;
mod twins;

use super::plan::SpherePlan;
use super::record::SphereRecord;
use crate::database::check::Mean;
use crate::database::check::planned::{plan_laws, tolerance};
use crate::database::{Dataset, Violation};

/// Results of a check.
#[derive(Clone, Debug)]
pub struct Report {
    pub violations: Vec<Violation>,
    /// Means over the isotropic packings that vanish by symmetry.
    pub symmetry: Vec<Mean>,
    /// Differences of twins.
    pub twins: Vec<TwinDifference>,
}

pub use twins::TwinDifference;

/// Checks a database.
pub fn check(dataset: &Dataset<SphereRecord>) -> Report {
    let tolerance = tolerance(dataset);
    let mut violations = plan_laws::<SpherePlan>(dataset);
    violations.extend(laws::violations(&dataset.records, tolerance));
    violations.extend(increments::violations(dataset, tolerance));
    let symmetry = symmetry::symmetry(&dataset.records);
    violations.extend(symmetry.iter().filter_map(Mean::violation));
    let (twins, found) = twins::twins(&dataset.records, tolerance);
    violations.extend(found);
    Report { violations, symmetry, twins }
}

#[cfg(test)]
mod tests;
