//! Initial fields for the solver: averages in windows of the packed box around the cells of a mesh.

use crate::ReferenceError;
use crate::observe::shear_stress;
use crate::window::{corners_around, window};
use msdd_dem::Simulation;
use msdd_rve::Averages;
use rayon::prelude::*;
use std::fmt::Write;

/// Side of a window [m]: about 500 discs (section 3.2.1).
pub const WINDOW: f64 = 0.215;

/// Averages around each of the centres [m], on `threads` threads; results do not depend on them.
///
/// # Errors
/// [`ReferenceError::Parameter`] with a centre outside the box; what the system says when it has no more threads.
pub fn around(
    simulation: &Simulation,
    centres: &[[f64; 2]],
    threads: usize,
) -> Result<Vec<Averages>, ReferenceError> {
    let [left, right, bottom, top] = simulation.walls.position;
    let inside = |[x, y]: [f64; 2]| (left..=right).contains(&x) && (bottom..=top).contains(&y);
    if let Some(centre) = centres.iter().find(|&&centre| !inside(centre)) {
        let (value, allowed) = (format!("{centre:?} m"), format!("inside {:?} m", simulation.walls.position));
        return Err(ReferenceError::Parameter { key: "cell centre", value, allowed });
    }
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads.max(1)).build();
    let pool = pool.map_err(std::io::Error::other)?;
    let average = |&centre: &[f64; 2]| {
        let (low, high) = corners_around(simulation, centre, WINDOW);
        window(simulation, low, high)
    };
    Ok(pool.install(|| centres.par_iter().map(average).collect()))
}

/// The field files: name and text. `note` says where they come from.
pub fn files(averages: &[Averages], note: &str) -> Vec<(&'static str, String)> {
    let scalar = |name, what: &str, value: fn(&Averages) -> f64| {
        let lines = averages.iter().map(|a| format!("{:.6}", value(a)));
        (
            name,
            field(name, ["volScalarField", "scalar", "[0 0 0 0 0 0 0]"], &format!("{what}. {note}"), lines),
        )
    };
    // OpenFOAM's stress: tension positive. The grains are in a plane, so the rest is zero.
    let stress = averages.iter().map(|a| {
        let [xx, xy, yy] = [a.stress_xx, shear_stress(a), a.stress_yy].map(|stress| -stress);
        format!("({xx:.2} {xy:.2} 0 {yy:.2} 0 0)")
    });
    let stress_note = format!("Initial stress [Pa], tension positive. {note}");
    let kind = ["volSymmTensorField", "symmTensor", "[1 -1 -2 0 0 0 0]"];
    vec![
        scalar("porosity", "Initial porosity, overlaps counted once", |a| a.porosity),
        scalar("fabricIndex", "Initial fabric index F_xx - F_yy", |a| a.fabric_index),
        scalar("fabricConductivity", "Initial (K_xx - K_yy)/(K_xx + K_yy)", |a| a.fabric_conductivity),
        ("stress", field("stress", kind, &stress_note, stress)),
    ]
}

/// One field: class, type of its values, dimensions; a note; the values.
fn field(
    name: &str,
    [class, values, dimensions]: [&str; 3],
    note: &str,
    lines: impl ExactSizeIterator<Item = String>,
) -> String {
    let mut text = format!(
        "FoamFile\n{{\n    version     2.0;\n    format      ascii;\n    class       {class};\n    object      {name};\n}}\n\n\
         // {note}\n\n\
         dimensions      {dimensions};\ninternalField   nonuniform List<{values}>\n{}\n(\n",
        lines.len()
    );
    for line in lines {
        let _ = writeln!(text, "{line}");
    }
    text + ");\nboundaryField\n{\n    #includeEtc \"caseDicts/setConstraintTypes\"\n    \".*\"\n    {\n        \
            type    zeroGradient;\n    }\n}\n"
}
