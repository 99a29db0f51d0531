//! Twins: pairs of increments from the packed state that give the same packing.
//!
//! * Radii that grow by 1 + ε in a fixed box, and a box that shrinks by the same factor around fixed radii: the same up to the scale. The
//!   solid fraction is equal exactly. Friction forces keep their size in newtons while the stiffness grows with the radii, and boxes
//!   come to rest at slightly different residual forces, so the others are nearly equal.
//! * The box closes along x, and the same in a box whose axes have other names: the engine's laws have no preferred direction. Sums are
//!   taken in another order there, so what is left is round-off, until a grain slides in one of them only.
//!
//! So single pairs have a wide bound, which finds damage, and the median over all pairs a narrow one.

use crate::Outcome;
use crate::database::Violation;
use crate::database::check::planned::within;
use crate::database::check::statistics::median;
use crate::database::spheres::kind::PathName;
use crate::database::spheres::record::SphereRecord;
use crate::database::table::Row;
use crate::spheres::Averages;
use std::collections::BTreeMap;

/// The median is judged from so many pairs on: those of three packings.
const PAIRS: usize = 12;

/// Largest difference of two tensors, or of two numbers, over `scale`.
fn off<const N: usize>(a: [f64; N], b: [f64; N], scale: f64) -> f64 {
    a.iter().zip(b).fold(0.0, |most: f64, (a, b)| most.max((a - b).abs() / scale))
}

/// A quantity, how far twins of it are apart (`packed` for the scale), and bounds of [single pairs, the median], of growing radii
/// and of turned boxes.
struct Quantity {
    name: &'static str,
    off: fn([&Averages; 2], packed: &Averages) -> f64,
    thermal: [f64; 2],
    turned: [f64; 2],
}

/// The bounds of single pairs are ten times the largest difference in 70 packings of 200 to 1000 spheres and more; those of medians are a
/// few times the residual force at which boxes count as at rest (of the fabric, in which a single contact shows, a few contacts of a thousand),
/// and of turned boxes a hundred times what was found. Found, largest and median: stress 2.2e-3 and 1.1e-4, fabric 2.0e-3 and 1.8e-4,
/// conductivity by contacts 2.5e-3 and 4.6e-5, by gas 4.8e-4 and 2.0e-5; of turned boxes at most 1.7e-8 and 9.4e-13.
const QUANTITIES: [Quantity; 4] = [
    Quantity {
        name: "stress",
        off: |[a, b], packed| off(a.stress, b.stress, a.pressure().max(packed.pressure())),
        thermal: [0.02, 3e-4],
        turned: [1e-3, 1e-10],
    },
    Quantity {
        name: "fabric",
        off: |[a, b], _| off(a.fabric, b.fabric, 1.0),
        thermal: [0.02, 1e-3],
        turned: [1e-3, 1e-10],
    },
    Quantity {
        name: "conductivity by contacts",
        off: |[a, b], _| {
            let [x, y, z, ..] = a.contact_conductivity;
            off(a.contact_conductivity, b.contact_conductivity, (x + y + z) / 3.0)
        },
        thermal: [0.03, 3e-4],
        turned: [1e-3, 1e-10],
    },
    Quantity {
        name: "conductivity by gas",
        off: |[a, b], _| off(a.gas_conductivity, b.gas_conductivity, a.gas_conductivity[0]),
        thermal: [5e-3, 1e-4],
        turned: [1e-3, 1e-10],
    },
];

/// How far the twins of a database are apart in one quantity.
#[derive(Clone, Debug, PartialEq)]
pub struct TwinDifference {
    pub quantity: &'static str,
    /// Whether of turned boxes; else of growing radii.
    pub turned: bool,
    pub pairs: usize,
    pub largest: f64,
    pub median: f64,
}

struct Pair<'a> {
    first: &'a SphereRecord,
    averages: [Averages; 2],
    packed: Averages,
    turned: bool,
}

/// The differences, and what is violated.
pub(super) fn twins(records: &[SphereRecord], tolerance: f64) -> (Vec<TwinDifference>, Vec<Violation>) {
    let pairs = pairs(records);
    let mut violations: Vec<Violation> =
        pairs.iter().filter_map(|pair| pair.solid_fraction(4.0 * tolerance)).collect();
    let mut differences = Vec::new();
    for quantity in &QUANTITIES {
        for turned in [false, true] {
            let [single, median_bound] = if turned { quantity.turned } else { quantity.thermal };
            // Rounding of both rows, relative to numbers of about that size.
            let (single, median_bound) = (single + 20.0 * tolerance, median_bound + 20.0 * tolerance);
            let mut all = Vec::new();
            for pair in pairs.iter().filter(|pair| pair.turned == turned) {
                let [a, b] = &pair.averages;
                let off = (quantity.off)([a, b], &pair.packed);
                if !within(off, single) {
                    let found = format!("{} off by {off:.3e}, at most {single:.1e}", quantity.name);
                    violations.push(Violation { row: pair.first.name(), law: law(turned), found });
                }
                all.push(off);
            }
            let (count, typical) = (all.len(), median(&all));
            if count >= PAIRS && !within(typical, median_bound) {
                let row = format!("{count} pairs of equivalence");
                let name = quantity.name;
                let found = format!("median difference of {name} {typical:.3e}, at most {median_bound:.1e}");
                violations.push(Violation { row, law: law(turned), found });
            }
            let largest = all.into_iter().fold(0.0, f64::max);
            let (pairs, quantity) = (count, quantity.name);
            differences.push(TwinDifference { quantity, turned, pairs, largest, median: typical });
        }
    }
    (differences, violations)
}

fn law(turned: bool) -> &'static str {
    if turned { "all directions are equal" } else { "radii that grow are a box that shrinks" }
}

/// Pairs in which both came to rest under load.
fn pairs(records: &[SphereRecord]) -> Vec<Pair<'_>> {
    let rows: BTreeMap<(i64, PathName, i64), &SphereRecord> =
        records.iter().map(|r| ((r.packing, r.path, r.stop), r)).collect();
    let settled = |r: &&SphereRecord| r.outcome == Outcome::Settled.to_string();
    let of = |first: &'_ SphereRecord| {
        let second = rows.get(&(first.packing, first.path, first.stop + 1)).copied().filter(settled)?;
        let packed = rows.get(&(first.packing, PathName::Packed, 0))?.averages()?;
        let averages = [first.averages()?, second.averages()?];
        Some((averages, packed, second.turned == Some(1)))
    };
    // Twins stand one after the other.
    let firsts =
        records.iter().filter(|r| r.path == PathName::Equivalence && r.stop % 2 == 1).filter(settled);
    let pair = |first| of(first).map(|(averages, packed, turned)| Pair { first, averages, packed, turned });
    firsts.filter_map(pair).collect()
}

impl Pair<'_> {
    fn solid_fraction(&self, tolerance: f64) -> Option<Violation> {
        let [a, b] = &self.averages;
        let off = a.solid_fraction - b.solid_fraction;
        let found = format!("off by {off:.3e}, at most {tolerance:.3e}");
        let law = "twins have one solid fraction";
        (!within(off, tolerance)).then(|| Violation { row: self.first.name(), law, found })
    }
}
