//! A bed whose walls move, over time, as a file.

use crate::coupled::{Prepared, Run};
use crate::scene::Scene;
use std::fmt::Write;

/// Columns between those of the temperatures and of the walls.
const MOVING: [&str; 24] = [
    "T_mean",
    "stress_1",
    "stress_2",
    "stress_3",
    "p",
    "thermal_strain",
    "strain_1",
    "strain_2",
    "strain_3",
    "porosity",
    "porosity_outside",
    "coordination",
    "fabric_1",
    "fabric_2",
    "fabric_3",
    "mobilisation",
    "K_contacts",
    "K_gas",
    "K",
    "depth",
    "radius",
    "unbalanced",
    "yielding",
    "peak",
];
/// The rows of a run as CSV, with comments on where they come from.
pub fn elements(scene: &Scene, prepared: &Prepared, found: &Run) -> String {
    let walls = scene.vessel().walls(0.0);
    let mut text = format!(
        "# Discrete elements: {} spheres, seed {}, {} steps; made by 'msdd bed run' of msdd {} from elements.toml\n",
        prepared.simulation.spheres.len(),
        scene.seed,
        found.steps,
        env!("CARGO_PKG_VERSION"),
    );
    let _ = writeln!(
        text,
        "# heat stored {:.6} J, residual of its balance {:.1e} J. Columns: docs/src/reference/beds.md",
        found.stored, found.residual
    );
    let temperatures = scene.record.distances.iter().map(|d| format!("T_{d}"));
    let pressures = walls.iter().map(|(name, _)| format!("p_{name}"));
    let middle = MOVING.iter().map(ToString::to_string);
    let header: Vec<String> =
        ["time".to_string()].into_iter().chain(temperatures).chain(middle).chain(pressures).collect();
    let _ = writeln!(text, "{}", header.join(","));
    for row in &found.rows {
        let [a, b, c] = row.stress;
        let conductivity = row.contact_conductivity + row.gas_conductivity;
        let mut cells = vec![row.time.to_string()];
        cells.extend(row.temperatures.iter().chain([&row.mean_temperature]).map(|t| format!("{t:.4}")));
        cells.extend([a, b, c, (a + b + c) / 3.0].map(|stress| format!("{stress:.1}")));
        cells.extend(
            [&row.thermal_strain].into_iter().chain(&row.strain).map(|strain| format!("{strain:.4e}")),
        );
        cells.extend([row.porosity, row.porosity_outside].map(finite(5)));
        cells.push(format!("{:.4}", row.coordination));
        cells.extend(row.fabric.iter().chain([&row.mobilisation]).map(|share| finite(5)(*share)));
        let conductivities = [row.contact_conductivity, row.gas_conductivity, conductivity];
        cells.extend(conductivities.map(|k| format!("{k:.5}")));
        cells.extend([row.depth, row.radius].map(finite(7)));
        cells.push(format!("{:.1e}", row.unbalanced));
        cells.extend([row.yielding, row.peak].map(finite(4)));
        cells.extend(row.walls.iter().map(|pressure| format!("{pressure:.1}")));
        let _ = writeln!(text, "{}", cells.join(","));
    }
    text
}

/// A number with so many digits, or nothing.
fn finite(digits: usize) -> impl Fn(f64) -> String {
    move |value| if value.is_finite() { format!("{value:.digits$}") } else { String::new() }
}
