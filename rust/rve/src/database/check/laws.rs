//! Exact laws (definitions, bounds and conservation of mass) that every row of a database must obey.

use super::planned::{plan_laws, tolerance, within};
use crate::database::kind::RampName;
use crate::database::record::FAILED;
use crate::database::table::Row;
use crate::database::{Dataset, Plan, Record, Violation};
use std::collections::BTreeMap;

/// All violated laws of all rows; rows of the plan that are missing; rows that the plan does not have.
pub(super) fn violations(dataset: &Dataset) -> Vec<Violation> {
    let packed: BTreeMap<i64, &Record> =
        dataset.records.iter().filter(|r| r.ramp == RampName::Packed).map(|r| (r.packing, r)).collect();
    let tolerance = tolerance(dataset);
    let of_row = |record| {
        let found = row_laws(record, packed.get(&record.packing).copied(), tolerance);
        found.into_iter().map(|(law, found)| Violation { row: record.name(), law, found })
    };
    let mut violations = plan_laws::<Plan>(dataset);
    violations.extend(dataset.records.iter().flat_map(of_row));
    violations
}

type Found = Vec<(&'static str, String)>;

fn row_laws(record: &Record, packed: Option<&Record>, tolerance: f64) -> Found {
    if record.outcome == FAILED || record.failure.is_some() {
        let sound = record.outcome == FAILED && record.failure.is_some() && record.porosity.is_none();
        let text = format!("outcome {}, failure {:?}", record.outcome, record.failure);
        return if sound { Vec::new() } else { vec![("a failure has a reason and no averages", text)] };
    }
    let Some(state) = State::of(record) else {
        return vec![("a state has all averages", "some are absent".to_string())];
    };
    let mut found = state.violations(tolerance);
    match packed.and_then(State::of) {
        Some(initial) => found.extend(mass_law(record, [&state, &initial], tolerance)),
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
fn mass_law(
    record: &Record,
    [state, initial]: [&State; 2],
    tolerance: f64,
) -> Option<(&'static str, String)> {
    let now = (1.0 - state.porosity_sum) * (1.0 + record.strain_xx) * (1.0 + record.strain_yy);
    let law = (1.0 - initial.porosity_sum) * (1.0 + record.strain).powi(2);
    let off = now - law;
    (!within(off, tolerance)).then(|| ("mass", format!("off by {off:.3e}")))
}

/// The averages that the laws use.
struct State {
    porosity: f64,
    porosity_sum: f64,
    overlap: f64,
    fabric: [f64; 3],
    /// Absent in files of older programs.
    fabric_xy: Option<f64>,
    conductivity: [f64; 3],
    fabric_conductivity: f64,
    stress: [f64; 2],
    pressure: f64,
    reduced: [f64; 2],
    scale: f64,
}

impl State {
    fn of(record: &Record) -> Option<Self> {
        Some(Self {
            porosity: record.porosity?,
            porosity_sum: record.porosity_sum_of_areas?,
            overlap: record.overlap_fraction?,
            fabric: [record.fabric_xx?, record.fabric_yy?, record.fabric_index?],
            fabric_xy: record.fabric_xy,
            conductivity: [record.conductivity_xx?, record.conductivity_yy?, record.conductivity_xy?],
            fabric_conductivity: record.fabric_conductivity?,
            stress: [record.stress_xx?, record.stress_yy?],
            pressure: record.pressure?,
            reduced: [record.stress_xx_reduced?, record.stress_yy_reduced?],
            scale: record.young_modulus * record.mean_radius?,
        })
    }

    fn violations(&self, tolerance: f64) -> Found {
        let [fxx, fyy, f] = self.fabric;
        let [kxx, kyy, kxy] = self.conductivity;
        let fxy = self.fabric_xy.unwrap_or(0.0);
        let size = kxx.abs() + kyy.abs();
        let stress = self.stress[0].abs() + self.stress[1].abs();
        // Without contacts the fabric tensor is zero.
        let trace = if fxx == 0.0 && fyy == 0.0 { 0.0 } else { fxx + fyy - 1.0 };
        let off = [
            ("trace of F is 1", trace, 1.0),
            ("f = F_xx - F_yy", fxx - fyy - f, 1.0),
            ("f_K = (K_xx - K_yy)/(K_xx + K_yy)", self.fabric_conductivity * (kxx + kyy) - (kxx - kyy), size),
            ("p = (sigma_xx + sigma_yy)/2", 0.5 * (self.stress[0] + self.stress[1]) - self.pressure, stress),
            ("reduced stress xx", self.reduced[0] * self.scale - self.stress[0], stress),
            ("reduced stress yy", self.reduced[1] * self.scale - self.stress[1], stress),
        ];
        let holds = [
            ("porosity is 0 to 1", (0.0..=1.0).contains(&self.porosity), self.porosity),
            ("overlaps are counted", self.overlap >= -tolerance, self.overlap),
            ("F is positive", fxx * fyy - fxy * fxy >= -4.0 * tolerance, fxx * fyy - fxy * fxy),
            ("K is positive", kxx >= 0.0 && kyy >= 0.0, kxx.min(kyy)),
            ("K is positive", kxx * kyy - kxy * kxy >= -tolerance * size * size, kxx * kyy - kxy * kxy),
        ];
        let off = off.into_iter().filter(|(_, off, scale)| !within(*off, 4.0 * tolerance * scale));
        let holds = holds.into_iter().filter(|(_, holds, _)| !holds);
        off.map(|(law, off, _)| (law, format!("off by {off:.3e}")))
            .chain(holds.map(|(law, _, value)| (law, value.to_string())))
            .collect()
    }
}
