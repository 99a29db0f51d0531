//! Exact laws (definitions, bounds and conservation of mass) that every row of a database must obey.

use super::planned::{Found, failed, found, named, plan_laws, tolerance, within};
use crate::database::kind::RampName;
use crate::database::{Dataset, Plan, Record, Violation};
use std::collections::BTreeMap;

/// All violated laws of all rows; rows of the plan that are missing; rows that the plan does not have.
pub(super) fn violations(dataset: &Dataset) -> Vec<Violation> {
    let packed: BTreeMap<i64, &Record> =
        dataset.records.iter().filter(|r| r.ramp == RampName::Packed).map(|r| (r.packing, r)).collect();
    let tolerance = tolerance(dataset);
    let of_row =
        |record: &Record| named(record, row_laws(record, packed.get(&record.packing).copied(), tolerance));
    let mut violations = plan_laws::<Plan>(dataset);
    violations.extend(dataset.records.iter().flat_map(of_row));
    violations
}

fn row_laws(record: &Record, packed: Option<&Record>, tolerance: f64) -> Found {
    if let Some(found) = failed(record, record.porosity.is_some()) {
        return found;
    }
    let Some(mut found) = state_laws(record, tolerance) else {
        return vec![("a state has all averages", "some are absent".to_string())];
    };
    match packed.and_then(|packed| mass_error(record, packed)) {
        Some(off) if within(off, tolerance) => {}
        Some(off) => found.push(("mass", format!("off by {off:.3e}"))),
        None => found.push(("a state has its packed state", "it is absent".to_string())),
    }
    let initial = packed.map(|p| (p.porosity, p.fabric_index, p.stress_xx, p.rattlers));
    let own = (
        record.initial_porosity,
        record.initial_fabric_index,
        record.initial_stress_xx,
        record.initial_rattlers,
    );
    if initial != Some(own) {
        found.push(("initial values are those of the packed state", format!("{own:?}, packed {initial:?}")));
    }
    found
}

/// Conservation of the grains' mass: (1 − η_sum)(1 + ε_xx)(1 + ε_yy) = (1 − η_sum⁰)(1 + ε)², with η_sum the porosity
/// from the sum of disc areas and ε the thermal strain.
fn mass_error(record: &Record, initial: &Record) -> Option<f64> {
    let solid = |record: &Record| Some(1.0 - record.porosity_sum_of_areas?);
    let now = solid(record)? * (1.0 + record.strain_xx) * (1.0 + record.strain_yy);
    Some(now - solid(initial)? * (1.0 + record.strain).powi(2))
}

/// None of a row that lacks averages. Those of older programs have no F_xy.
fn state_laws(r: &Record, tolerance: f64) -> Option<Found> {
    let [fxx, fyy, f] = [r.fabric_xx?, r.fabric_yy?, r.fabric_index?];
    let [kxx, kyy, kxy] = [r.conductivity_xx?, r.conductivity_yy?, r.conductivity_xy?];
    let [sxx, syy, fxy] = [r.stress_xx?, r.stress_yy?, r.fabric_xy.unwrap_or(0.0)];
    let (size, stress, scale) =
        (kxx.abs() + kyy.abs(), sxx.abs() + syy.abs(), r.young_modulus * r.mean_radius?);
    let [minor_f, minor_k] = [fxx * fyy - fxy * fxy, kxx * kyy - kxy * kxy];
    // Without contacts the fabric tensor is zero.
    let trace = if fxx == 0.0 && fyy == 0.0 { 0.0 } else { fxx + fyy - 1.0 };
    let (porosity, _, overlap) = (r.porosity?, r.porosity_sum_of_areas?, r.overlap_fraction?);
    let zeros = [
        ("trace of F is 1", trace, 1.0),
        ("f = F_xx - F_yy", fxx - fyy - f, 1.0),
        ("f_K = (K_xx - K_yy)/(K_xx + K_yy)", r.fabric_conductivity? * (kxx + kyy) - (kxx - kyy), size),
        ("p = (sigma_xx + sigma_yy)/2", 0.5 * (sxx + syy) - r.pressure?, stress),
        ("reduced stress xx", r.stress_xx_reduced? * scale - sxx, stress),
        ("reduced stress yy", r.stress_yy_reduced? * scale - syy, stress),
    ];
    let holds = [
        ("porosity is 0 to 1", (0.0..=1.0).contains(&porosity), porosity),
        ("overlaps are counted", overlap >= -tolerance, overlap),
        ("F is positive", minor_f >= -4.0 * tolerance, minor_f),
        ("K is positive", kxx >= 0.0 && kyy >= 0.0, kxx.min(kyy)),
        ("K is positive", minor_k >= -tolerance * size * size, minor_k),
    ];
    Some(found(&zeros, &holds, tolerance))
}
