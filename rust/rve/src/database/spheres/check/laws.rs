//! Exact laws (definitions, bounds) that every row must obey.

use crate::database::Violation;
use crate::database::check::planned::{Found, failed, found, named};
use crate::database::spheres::record::SphereRecord;
use crate::spheres::{Averages, Tensor};

pub(super) fn violations(records: &[SphereRecord], tolerance: f64) -> Vec<Violation> {
    records.iter().flat_map(|record| named(record, row_laws(record, tolerance))).collect()
}

fn row_laws(record: &SphereRecord, tolerance: f64) -> Found {
    let averages = record.averages();
    if let Some(found) = failed(record, averages.is_some()) {
        return found;
    }
    match (averages, record.pressure) {
        (Some(averages), Some(pressure)) => state_laws(record, &averages, pressure, tolerance),
        _ => vec![("a state has all averages", "some are absent".to_string())],
    }
}

fn state_laws(record: &SphereRecord, a: &Averages, pressure: f64, tolerance: f64) -> Found {
    let [low, middle, high] = a.gas_conductivity;
    let stress: f64 = a.stress[..3].iter().map(|part| part.abs()).sum();
    let trace: f64 = a.fabric[..3].iter().sum();
    let conductivity = a.contact_conductivity;
    let size: f64 = conductivity[..3].iter().map(|part| part.abs()).sum();
    // Without contacts the fabric tensor is zero.
    let off_trace = if trace == 0.0 { 0.0 } else { trace - 1.0 };
    let zeros = [
        ("p = (sigma_xx + sigma_yy + sigma_zz)/3", a.pressure() - pressure, stress),
        ("trace of F is 1", off_trace, 1.0),
    ];
    let more = a.neighbours - a.coordination;
    let holds = [
        ("solid fraction is 0 to 1", a.solid_fraction > 0.0 && a.solid_fraction < 1.0, a.solid_fraction),
        ("rattlers are 0 to 1", (0.0..=1.0).contains(&a.rattlers), a.rattlers),
        ("contacts are among the neighbours", more >= -20.0 * tolerance, more),
        ("F is positive", least_minor(a.fabric) >= -4.0 * tolerance, least_minor(a.fabric)),
        (
            "conductivity by contacts is positive",
            !record.carries_load() || least_minor(conductivity) >= -4.0 * tolerance * size * size,
            least_minor(conductivity),
        ),
        ("more gas number, more conductivity", 0.0 < low && low < middle && middle < high, middle),
    ];
    found(&zeros, &holds, tolerance)
}

/// The least of the diagonal, times its largest part, and of the 2 × 2 minors about the diagonal: none is negative in a positive
/// tensor.
fn least_minor([xx, yy, zz, xy, xz, yz]: Tensor) -> f64 {
    let largest = xx.max(yy).max(zz);
    let minors = [xx * yy - xy * xy, xx * zz - xz * xz, yy * zz - yz * yz];
    let diagonal = [xx, yy, zz].map(|part| part * largest);
    minors.into_iter().chain(diagonal).fold(f64::INFINITY, f64::min)
}
