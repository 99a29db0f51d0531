//! Pairs of `equivalence`: radii that grow by 1 + ε in a fixed box, and its twin, a box that shrinks by the same factor
//! around fixed radii. Both give the same packing up to its scale.
//!
//! The sum of the areas over that of the box is equal exactly. The other quantities are equal to about 1e-5 without
//! friction; with friction they differ by what the contacts carry over from the packed state: tangential forces keep
//! their size in newtons while stiffness grows with the radii, which gives differences in proportion to ε (a test in
//! `tests/periodic.rs` scales these forces, and the difference goes away). Sliding grains may also fall into another
//! arrangement in one of the two, which changes a single pair by more. So single pairs have a wide bound, which finds
//! damage, and the median over all pairs a narrow one.

use super::planned::{tolerance, within};
use super::statistics::median;
use crate::Outcome;
use crate::database::kind::RampName;
use crate::database::table::Row;
use crate::database::{Dataset, Record, Violation};
use std::collections::BTreeMap;

/// The median is judged from so many pairs on: those of two packings.
const PAIRS: usize = 12;

/// A quantity in which twins are compared.
struct Quantity {
    law: &'static str,
    values: &'static [fn(&Record) -> Option<f64>],
    /// Allowed difference of a single pair; of stresses relative to the pressure, or that of the packed state if this is
    /// larger.
    single: f64,
    /// Allowed median of the differences over |ε|.
    median: f64,
}

/// The bounds are five times the largest difference of 737 pairs of 500 discs (porosities 0.06 to 0.185, all
/// compressions), and about twice the median over those pairs, which is the same with 40 and with 2000 discs. Measured,
/// largest and median over |ε|: porosity 8.8e-4 and 0.0025 (0.0066 in the densest packings), stress 0.094 and 0.10, fabric
/// 0.022 and 0.017 (0.043 in loose ones), K 0.020 and 0.011 (0.022 in the densest).
const QUANTITIES: [Quantity; 4] = [
    Quantity { law: "twins have one porosity", values: &[|r| r.porosity], single: 5e-3, median: 0.013 },
    Quantity {
        law: "twins have one reduced stress",
        values: &[|r| r.stress_xx_reduced, |r| r.stress_yy_reduced],
        single: 0.5,
        median: 0.25,
    },
    Quantity {
        law: "twins have one fabric",
        values: &[|r| r.fabric_index, |r| r.fabric_xy],
        single: 0.1,
        median: 0.1,
    },
    Quantity {
        law: "twins have one K",
        values: &[
            |r| r.conductivity_xx,
            |r| r.conductivity_yy,
            |r| r.conductivity_xy,
            |r| r.conductivity_network_xx,
            |r| r.conductivity_network_yy,
            |r| r.conductivity_network_xy,
        ],
        single: 0.1,
        median: 0.045,
    },
];

/// A thermal increment, its twin, and the packed state of both.
struct Pair<'a> {
    /// Thermal strain [-].
    strain: f64,
    thermal: &'a Record,
    twin: &'a Record,
    packed: &'a Record,
}

/// Violations by single pairs, and by the median over the pairs.
pub(super) fn violations(dataset: &Dataset) -> Vec<Violation> {
    let tolerance = tolerance(dataset);
    let pairs = pairs(&dataset.records);
    let mut violations: Vec<Violation> =
        pairs.iter().filter_map(|pair| pair.solid_fraction(4.0 * tolerance)).collect();
    let settled: Vec<&Pair> = pairs.iter().filter(|pair| pair.is_settled()).collect();
    for quantity in &QUANTITIES {
        let mut shares = Vec::new();
        for pair in &settled {
            let difference = pair.difference(quantity);
            if !within(difference, quantity.single) {
                violations.push(pair.violation(quantity.law, difference, quantity.single));
            }
            // What rounding may have added is left out.
            shares.push((difference - 4.0 * tolerance).max(0.0) / pair.strain.abs());
        }
        let typical = median(&shares);
        if settled.len() >= PAIRS && !within(typical, quantity.median) {
            let row = format!("{} pairs of equivalence", settled.len());
            let found =
                format!("median of the differences over strain {typical:.3e}, at most {}", quantity.median);
            violations.push(Violation { row, law: quantity.law, found });
        }
    }
    violations
}

fn pairs(records: &[Record]) -> Vec<Pair<'_>> {
    let rows: BTreeMap<(i64, RampName, i64), &Record> =
        records.iter().map(|r| ((r.packing, r.ramp, r.stop), r)).collect();
    let mut pairs = Vec::new();
    for thermal in records.iter().filter(|r| r.ramp == RampName::Equivalence) {
        let strain = thermal.step_thermal.unwrap_or(0.0);
        let twin = rows.get(&(thermal.packing, thermal.ramp, thermal.stop + 1));
        let packed = rows.get(&(thermal.packing, RampName::Packed, 0));
        if let (Some(twin), Some(packed), true) = (twin, packed, strain != 0.0) {
            pairs.push(Pair { strain, thermal, twin, packed });
        }
    }
    pairs
}

impl Pair<'_> {
    fn is_settled(&self) -> bool {
        [self.thermal, self.twin].iter().all(|r| r.outcome == Outcome::Settled.to_string())
    }

    fn solid_fraction(&self, tolerance: f64) -> Option<Violation> {
        let off = self.twin.porosity_sum_of_areas? - self.thermal.porosity_sum_of_areas?;
        (!within(off, tolerance)).then(|| self.violation("twins have one solid fraction", off, tolerance))
    }

    /// Largest difference of the values of a quantity; NaN when one is absent.
    fn difference(&self, quantity: &Quantity) -> f64 {
        let reduced = |r: &Record| Some(0.5 * (r.stress_xx_reduced? + r.stress_yy_reduced?));
        let is_stress = quantity.law.ends_with("stress");
        let pressures = [self.thermal, self.packed].map(|r| reduced(r).unwrap_or(f64::NAN));
        let scale = if is_stress { pressures[0].max(pressures[1]) } else { 1.0 };
        let off = |value: &fn(&Record) -> Option<f64>| match (value(self.twin), value(self.thermal)) {
            (Some(a), Some(b)) => (a - b).abs() / scale,
            _ => f64::NAN,
        };
        let larger = |most: f64, off: f64| if most >= off || most.is_nan() { most } else { off };
        quantity.values.iter().map(off).fold(0.0, larger)
    }

    fn violation(&self, law: &'static str, off: f64, allowed: f64) -> Violation {
        Violation { row: self.thermal.name(), law, found: format!("off by {off:.3e}, at most {allowed:.3e}") }
    }
}
