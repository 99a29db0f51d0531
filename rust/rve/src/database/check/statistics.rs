//! Mirror symmetry of the means over packings; mean, variance, median.

use crate::Compression;
use crate::database::plan::{Kind, RampName};
use crate::database::{Record, Violation};
use std::collections::BTreeMap;

/// A mean over many packings that is more than this many standard errors off 0 counts as a violation: chance gives that once
/// in 16 000.
const LARGEST_DEVIATION: f64 = 4.0;
/// With fewer packings the standard error itself is not known well enough to judge by it.
const MIN_PACKINGS: usize = 10;

/// A mean over packings with its standard error.
#[derive(Clone, Debug, PartialEq)]
pub struct Mean {
    /// Number of grains in a packing, and what they are.
    pub count: u64,
    pub grains: &'static str,
    pub quantity: String,
    pub packings: usize,
    pub mean: f64,
    pub standard_error: f64,
}

impl Mean {
    pub(crate) fn of(count: u64, grains: &'static str, quantity: String, values: &[f64]) -> Self {
        let packings = values.len();
        let standard_error = (variance(values) / packings.max(1) as f64).sqrt();
        Self { count, grains, quantity, packings, mean: mean(values), standard_error }
    }

    /// A violation when the mean is farther off zero than chance explains.
    pub(crate) fn violation(&self) -> Option<Violation> {
        let off = self.mean / self.standard_error;
        // Student's t: with few packings the same chance allows more standard errors, 6.6 with ten.
        let largest = LARGEST_DEVIATION * (1.0 + 6.0 / (self.packings.max(2) - 1) as f64);
        (self.packings >= MIN_PACKINGS && off.abs() > largest).then(|| Violation {
            row: format!("isotropic packings of {} {}", self.count, self.grains),
            law: "axes are equal",
            found: format!("mean {} {:.3e}, {off:.1} standard errors off 0", self.quantity, self.mean),
        })
    }
}

type Quantity = (&'static str, fn(&Record) -> Option<f64>);

/// Packed states of square boxes that carry load, by size.
fn packed(records: &[Record]) -> BTreeMap<u64, Vec<&Record>> {
    let mut sizes: BTreeMap<u64, Vec<&Record>> = BTreeMap::new();
    for record in records {
        if record.ramp == RampName::Packed && record.kind != Kind::WallShear && record.carries_load() {
            sizes.entry(record.discs).or_default().push(record);
        }
    }
    sizes
}

/// Means of f, f_K and stress deviator over isotropic packings, which vanish by symmetry.
pub(super) fn symmetry(records: &[Record]) -> Vec<Mean> {
    let quantities: [Quantity; 3] = [
        ("fabric_index", |r| r.fabric_index),
        ("fabric_conductivity", |r| r.fabric_conductivity),
        ("(stress_xx - stress_yy)/2p", |r| Some(0.5 * (r.stress_xx? - r.stress_yy?) / r.pressure?)),
    ];
    let mut means = Vec::new();
    for (discs, rows) in packed(records) {
        for (quantity, value) in quantities {
            let isotropic = rows.iter().filter(|r| r.compression == Compression::Isotropic);
            let values: Vec<f64> = isotropic.filter_map(|r| value(r)).collect();
            if values.len() > 2 {
                means.push(Mean::of(discs, "discs", quantity.to_string(), &values));
            }
        }
    }
    means
}

/// Mean; 0 for an empty list.
pub fn mean(values: &[f64]) -> f64 {
    values.iter().sum::<f64>() / values.len().max(1) as f64
}

/// Variance of the values, n − 1 in the denominator.
pub fn variance(values: &[f64]) -> f64 {
    let mean = mean(values);
    values.iter().map(|v| (v - mean).powi(2)).sum::<f64>() / values.len().saturating_sub(1).max(1) as f64
}

/// Median, the upper one of an even number; 0 for an empty list.
pub fn median(values: &[f64]) -> f64 {
    let mut sorted = values.to_vec();
    sorted.sort_by(f64::total_cmp);
    sorted.get(sorted.len() / 2).copied().unwrap_or(0.0)
}
