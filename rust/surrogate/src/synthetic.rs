//! Synthetic states that resemble granular ones, for tests only. η and f follow a law without hidden variables.

use crate::StateRow;

/// Rows of `packings` packings, each with an up and a down ramp of `stops` stops after the packed state.
pub fn rows(packings: i64, stops: i64) -> Vec<StateRow> {
    let mut rows = Vec::new();
    for packing in 0..packings {
        let share = (packing as f64 + 0.5) / packings as f64;
        let (start, fabric) = (0.07 + 0.11 * share, 0.15 * (packing as f64 * 2.4).sin() * share);
        for (ramp, sign) in [("up", 1.0), ("down", -1.0)] {
            rows.extend((0..=stops).map(|stop| {
                let strain = sign * 0.05 * stop as f64 / stops as f64;
                state(packing, ramp, stop, strain, start, fabric)
            }));
        }
    }
    rows
}

fn state(packing: i64, ramp: &str, stop: i64, strain: f64, start: f64, fabric: f64) -> StateRow {
    // The law is dη/dL = −2 (0.37 + 2.6 (η − 0.06)) and df/dL = −8 f with L = ln(1 + ε), so strains compose exactly.
    let logarithmic = strain.ln_1p();
    let rest = 0.06 - 0.37 / 2.6;
    let porosity = rest + (start - rest) * (-5.2 * logarithmic).exp();
    let fabric_index = fabric * (-8.0 * logarithmic).exp();
    let squeeze = (0.2 - porosity).max(0.0);
    let (conductivity, pressure) = (0.15 + 2.6 * squeeze, 0.4 * squeeze + 4.0 * squeeze * squeeze);
    StateRow {
        packing,
        ramp: ramp.to_string(),
        stop,
        strain,
        porosity,
        fabric_index,
        conductivity_xx: conductivity * (1.0 + 1.2 * fabric_index),
        conductivity_yy: conductivity * (1.0 - 1.2 * fabric_index),
        conductivity_network: None,
        stress_xx: pressure * (1.0 + 2.0 * fabric_index),
        stress_yy: pressure * (1.0 - 2.0 * fabric_index),
        porosity_sum_of_areas: porosity - 0.3 * squeeze,
        load_bearing: true,
    }
}
