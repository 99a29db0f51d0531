//! Isotropic packings have no direction: what tells one axis from another vanishes on average.

use crate::database::check::Mean;
use crate::database::spheres::kind::{PathName, SphereCompression};
use crate::database::spheres::record::SphereRecord;
use crate::spheres::{Averages, Tensor};
use std::collections::BTreeMap;

/// A part of a tensor, with its name.
type Part = (&'static str, fn(Tensor) -> f64);

/// Differences of the diagonal, and what is off it.
const PARTS: [Part; 5] = [
    ("xx - yy", |t| t[0] - t[1]),
    ("xx - zz", |t| t[0] - t[2]),
    ("xy", |t| t[3]),
    ("xz", |t| t[4]),
    ("yz", |t| t[5]),
];

type Quantity = (&'static str, fn(&Averages) -> Tensor);

/// Tensors without unit.
const QUANTITIES: [Quantity; 3] = [
    ("F", |a| a.fabric),
    ("sigma/p", |a| a.stress.map(|part| part / a.pressure())),
    ("K/mean K", |a| {
        let [x, y, z, ..] = a.contact_conductivity;
        a.contact_conductivity.map(|part| 3.0 * part / (x + y + z))
    }),
];

/// Means over the isotropic packed states of one size.
pub(super) fn symmetry(records: &[SphereRecord]) -> Vec<Mean> {
    let mut sizes: BTreeMap<u64, Vec<Averages>> = BTreeMap::new();
    let isotropic = |r: &&SphereRecord| {
        r.path == PathName::Packed && r.compression == SphereCompression::Isotropic && r.carries_load()
    };
    for record in records.iter().filter(isotropic) {
        sizes.entry(record.spheres).or_default().extend(record.averages());
    }
    let mut means = Vec::new();
    for (count, states) in sizes.into_iter().filter(|(_, states)| states.len() > 2) {
        for (name, tensor) in QUANTITIES {
            for (part, of) in PARTS {
                let values: Vec<f64> = states.iter().map(|state| of(tensor(state))).collect();
                means.push(Mean::of(count, "spheres", format!("{name}: {part}"), &values));
            }
        }
    }
    means
}
