//! A bed whose walls move, over time, as a file.

use crate::case::BedCase;
use crate::coupled::{Prepared, Run};
use msdd_files::{Column, names};
use std::fmt::Write;

/// Columns between those of the temperatures and of the walls.
const MOVING: [Column; 24] = [
    ("T_mean", "K", "mean temperature of the spheres in the region of averages"),
    (
        "stress_1",
        "Pa",
        "mean normal stress of the contacts there, compression positive: along x; in a cylinder along the radius",
    ),
    ("stress_2", "Pa", "the same along y; in a cylinder around the axis"),
    ("stress_3", "Pa", "the same along z"),
    ("p", "Pa", "mean of the three"),
    ("thermal_strain", "-", "mean growth of the radii of the spheres there since the start, over the radius"),
    (
        "strain_1",
        "-",
        "strain of the bed there since the start, extension positive, along the axis of stress_1: slope of a straight line through the displacements of the spheres; in a cylinder the mean across its axis. Across z, a bed without sides has none",
    ),
    ("strain_2", "-", "the same along the axis of stress_2"),
    ("strain_3", "-", "the same along the axis of stress_3"),
    ("porosity", "-", "porosity there"),
    (
        "porosity_outside",
        "-",
        "in a cylinder between the same heights, from the `radius` of `[record]` to half a diameter before the side, where the centres of the first layer are; empty in a box",
    ),
    ("coordination", "-", "contacts per sphere there, with walls"),
    (
        "fabric_1",
        "-",
        "fabric there: mean square of the component of the normals of contacts along the axis of stress_1; the sum of the three is 1",
    ),
    ("fabric_2", "-", "the same along the axis of stress_2"),
    ("fabric_3", "-", "the same along the axis of stress_3"),
    (
        "mobilisation",
        "-",
        "tangential force of the contacts there over the tangential force at which they would slide",
    ),
    ("K_contacts", "W/(m K)", "conductivity along z there at the mean temperature, by contacts"),
    ("K_gas", "W/(m K)", "the same by gas"),
    ("K", "W/(m K)", "the sum, with radiation if the spheres radiate"),
    ("depth", "m", "depth of the bed"),
    ("radius", "m", "radius of the cylinder; empty in a box"),
    ("unbalanced", "-", "force along z that is not in balance, over the force on the lid or the weight"),
    (
        "yielding",
        "-",
        "share of the contacts in which Hertz's peak stress exceeds 1.6 times the yield stress; empty without one",
    ),
    (
        "peak",
        "-",
        "largest of Hertz's peak stresses over 1.6 times the yield stress; above 1 the elastic law ends",
    ),
];
/// The rows of a run as CSV, with comments on where they come from.
pub fn elements(scene: &BedCase, prepared: &Prepared, found: &Run) -> String {
    let walls = scene.vessel().walls(0.0);
    let mut text = format!(
        "# DEM: {} spheres, seed {}, {} steps; made by 'msdd bed run' of msdd {} from bed.toml\n",
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
    let middle = names(&MOVING).map(str::to_string);
    let header: Vec<String> =
        ["time".to_string()].into_iter().chain(temperatures).chain(middle).chain(pressures).collect();
    let _ = writeln!(text, "{}", header.join(","));
    for row in &found.rows {
        let [a, b, c] = row.stress;
        let mut cells = vec![row.time.to_string()];
        cells.extend(row.temperatures.iter().chain([&row.mean_temperature]).map(|t| format!("{t:.4}")));
        cells.extend([a, b, c, (a + b + c) / 3.0].map(|stress| format!("{stress:.1}")));
        cells.extend(
            [&row.thermal_strain].into_iter().chain(&row.strain).map(|strain| format!("{strain:.4e}")),
        );
        cells.extend([row.porosity, row.porosity_outside].map(finite(5)));
        cells.push(format!("{:.4}", row.coordination));
        cells.extend(row.fabric.iter().chain([&row.mobilisation]).map(|share| finite(5)(*share)));
        let conductivities = [row.contact_conductivity, row.gas_conductivity, row.conductivity()];
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
