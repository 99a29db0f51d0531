//! Makes the files of a new case of a bed of spheres.

use super::blocks::{Across, Blocks};
use super::scene::{Lid, SphereCase};
use super::shape::{HALF_ANGLE, INNER, Shape};
use super::start::{FABRIC, InitialBed, LATERAL};
use super::wall;
use crate::CaseError;
use crate::fields::FieldKind;
use crate::folder::{File, programs};
use crate::numbers::{plain, rounded, short};
use crate::scene::Mechanics;
use crate::values::{
    Values, fill, libraries, mechanics_name, property_text, source, times, wall_rows, walls, when,
};
use std::f64::consts::PI;
use std::path::Path;

macro_rules! template {
    ($name:literal) => {
        include_str!(concat!("../../templates/", $name))
    };
}

/// The files of the case. `checkout`: folder of MSDD in which the solver was built; `name`: name of the case folder.
///
/// # Errors
/// [`CaseError::Model`] when the shipped law cannot be read.
pub fn files(scene: &SphereCase, name: &str, checkout: &Path) -> Result<Vec<File>, CaseError> {
    let values = values(scene, name, checkout)?;
    let filled = |template: &str| fill(template, &values);
    let foam = |path, class: &str, template: &str| File::foam(path, class, &filled(template));
    let mut files = programs(name, checkout, tolerance(scene), scene.number() as usize, scene.steady);
    files.extend([
        File { path: "README.md", text: filled(template!("spheres/README.md")), program: false },
        foam("constant/granularProperties", "dictionary", template!("spheres/granularProperties")),
        foam("system/controlDict", "dictionary", template!("controlDict")),
        File::foam("system/blockMeshDict", "dictionary", &mesh(scene)),
        foam("system/decomposeParDict", "dictionary", template!("decomposeParDict")),
        foam("0/T", "volScalarField", template!("T")),
    ]);
    files.extend(initial_fields(scene));
    if scene.heat_source.is_some() {
        files.push(foam("constant/fvOptions", "dictionary", template!("fvOptions")));
    }
    if scene.gravity > 0.0 {
        let vector = scene.shape.upwards(-scene.gravity);
        let text = format!("dimensions      [0 1 -2 0 0 0 0];\nvalue           {vector};\n");
        files.push(File::foam("constant/g", "uniformDimensionedVectorField", &text));
    }
    Ok(files)
}

/// \[K\]
fn tolerance(scene: &SphereCase) -> f64 {
    let [least, most] = scene.temperatures();
    // A bed that is heated from inside alone has no range before it is run.
    let range = if most > least { most - least } else { 10.0 };
    scene.tolerance.unwrap_or(1e-3 * range)
}

/// Porosity, fabric index, and the stress unless it follows from the weight, with the same value in all cells.
fn initial_fields(scene: &SphereCase) -> Vec<File> {
    let note = "Initial porosity: 1 - volume of the spheres over the volume";
    let mut fields = vec![
        File::field("0/porosity", FieldKind::Ratio, note, &plain(scene.porosity)),
        File::field("0/fabricIndex", FieldKind::Ratio, "Not used with spheres", "0"),
    ];
    if !rests(scene) {
        let note = "Initial stress (xx xy xz yy yz zz) [Pa], tension positive as everywhere in OpenFOAM: the vertical one is the \
                    pressure on the top";
        let vertical = scene.pressure;
        let horizontal = rounded(-LATERAL * vertical, 6);
        let stress = scene.shape.tensor(horizontal, -vertical);
        fields.push(File::field("0/stress", FieldKind::Stress, note, &stress));
    }
    fields
}

fn values(scene: &SphereCase, name: &str, checkout: &Path) -> Result<Values, CaseError> {
    let start = scene.start()?;
    let probe = |probe: &Vec<f64>| format!("            {}", scene.shape.point(probe));
    let places: Vec<String> = scene.probes.iter().map(|probe| scene.shape.place(probe)).collect();
    let named = || scene.shape.walls().iter().copied().zip(&scene.walls);
    let (roughness, hardness) = (scene.spheres.roughness, scene.spheres.hardness);
    let wall = scene.wall_material.map(|wall| wall.entry(roughness, hardness, 0.0));
    let mut values: Values = vec![
        ("checkout", checkout.display().to_string()),
        ("name", name.to_string()),
        ("mechanics", mechanics_name(scene.mechanics).to_string()),
        ("probes", scene.probes.iter().map(probe).collect::<Vec<_>>().join("\n")),
        ("probesNote", String::new()),
        ("probeColumns", places.join("; ")),
        ("spaceProbes", String::new()),
        ("wallProfile", template!("spheres/wallProfile").to_string()),
        ("initialTemperature", plain(scene.initial_temperature)),
        ("walls", walls(named(), scene.wall_material.is_some()) + inner(&scene.shape)),
        ("libraries", libraries(&scene.walls, scene.wall_material.is_some())),
        ("wall", wall.unwrap_or_default()),
        ("wallResistance", wall_resistance(scene)),
        ("wallRows", wall_rows(named())),
        ("wedge", wedge(&scene.shape).to_string()),
        ("heatSource", plain(scene.heat_source.unwrap_or(0.0))),
        ("sourceRow", source(scene.heat_source)),
        ("parts", scene.shape.parts(&scene.cells)),
        ("material", scene.material.clone()),
    ];
    values.extend(times(scene.end_time, scene.first_step()?));
    let over = [
        ("thermalConductivity", &scene.spheres.conductivity),
        ("heatCapacity", &scene.spheres.heat_capacity),
    ];
    values.extend(scene.spheres.grains.named().map(|(key, value, _)| {
        let table = over.iter().find(|(name, _)| *name == key);
        (key, table.map_or_else(|| plain(value), |(_, property)| property_text(property)))
    }));
    values.extend(scene.spheres.named().map(|(key, value, _)| (key, plain(value))));
    values.push(("emissivity", property_text(&scene.spheres.emissivity)));
    values.push(("sizeSpread", plain(scene.spheres.size_spread)));
    values.push(("sizes", sizes(&scene.shape)));
    values.push(("diameter", diameter(scene)));
    let counts = match (scene.shape, scene.cells.as_slice()) {
        (Shape::Cylinder { .. }, &[across, along]) => vec![along, across, 1],
        (_, cells) => cells.to_vec(),
    };
    values.push(("cells", counts.iter().map(ToString::to_string).collect::<Vec<_>>().join(" ")));
    values.extend(bed_values(scene, &start)?);
    Ok(values)
}

/// The hole for the axis, in `0/T`.
fn inner(shape: &Shape) -> &'static str {
    match shape {
        Shape::Box(_) => "",
        Shape::Cylinder { .. } => "    inner\n    {\n        type    zeroGradient;\n    }\n",
    }
}

/// What a cylinder's mesh means for the numbers, for README.md.
fn wedge(shape: &Shape) -> &'static str {
    match shape {
        Shape::Box(_) => "",
        Shape::Cylinder { .. } => {
            "- **The mesh is a wedge of 5 degrees, x is the height and y the radius**: points in the files are (height radius 0), and\n  \
             `conductivity_xx` is the vertical conductivity. Heat and sources in J and W, in the log and in the tables, are 1/72 of the values of\n  \
             the whole bed.\n"
        }
    }
}

fn mesh(scene: &SphereCase) -> String {
    let (height, cells) = (scene.shape.height(), &scene.cells);
    let along = cells[cells.len() - 1];
    let (across, patches, order, about): (_, _, &[usize], _) = match scene.shape {
        Shape::Box([width, depth, _]) => (
            Across::Box([width, depth], [cells[0], cells[1]]),
            ["left", "right", "front", "back", "bottom", "top"],
            &[0, 1, 2, 3, 4, 5],
            "",
        ),
        Shape::Cylinder { radius, .. } => (
            Across::Wedge(vec![INNER * radius, radius], vec![cells[0]]),
            ["inner", "side", "bottom", "top", "front", "back"],
            &[1, 2, 3, 0, 4, 5],
            ", as a wedge of 5 degrees. The axis is x and points upwards, the radius is y;\n// a narrow hole stands for the axis (inner)",
        ),
    };
    let blocks = Blocks {
        across,
        levels: vec![0.0, height],
        cells: vec![along],
        patches,
        order,
        zone: None,
        digits: 10,
        symmetric: false,
    };
    format!(
        "// {}{about}. A cell should not be smaller than a sphere, {} m.\n\nscale   1;\n\n{}",
        sizes(&scene.shape),
        diameter(scene),
        blocks.text()
    )
}

fn diameter(scene: &SphereCase) -> String {
    plain(rounded(2.0 * scene.spheres.radius(), 6))
}

/// The shape in words.
fn sizes(shape: &Shape) -> String {
    match *shape {
        Shape::Cylinder { radius, height } => {
            format!("a cylinder with a radius of {radius} m and a height of {height} m")
        }
        Shape::Box([width, depth, height]) => format!("a box of {width} x {depth} x {height} m"),
    }
}

/// The stress at the start, for README.md.
fn stress_row(scene: &SphereCase) -> String {
    match rests(scene) {
        true => "at rest under weight and pressure on the top | `constant/granularProperties`".to_string(),
        false => format!("{} Pa everywhere | `0/stress`", plain(scene.pressure)),
    }
}

const FLOW_RESULT: &str = "\n- **Gas**: its temperature is `gasTemperature` in the time folders; mass flux, temperature at the outlet and \
                           pressure drop over time are in `postProcessing/flow`.";

fn bed_values(scene: &SphereCase, start: &InitialBed) -> Result<Values, CaseError> {
    let [along, up] = FABRIC;
    let gravity = match rests(scene) {
        true => format!("{} m/s2 downwards", plain(scene.gravity)),
        false => "none (no such file)".to_string(),
    };
    Ok(vec![
        ("rest", rest(scene)),
        ("flow", flow(scene)),
        ("flowRow", flow_row(scene)),
        ("flowResult", when(scene.flow.is_some(), || FLOW_RESULT.to_string())),
        ("notFlow", if scene.flow.is_some() { "" } else { ", and flow of the gas" }.to_string()),
        ("gas", scene.gas.name.to_string()),
        ("gasPressure", plain(scene.gas.pressure)),
        ("accommodation", plain(scene.gas.accommodation)),
        ("coordination", short(start.coordination)),
        ("fabric", scene.shape.tensor(along, up)),
        ("held", held(scene)),
        ("leftOut", left_out(scene)),
        ("lateral", plain(LATERAL)),
        ("conductivity", short(start.conductivity)),
        ("byGas", short(start.by_gas)),
        ("byContacts", short(start.conductivity - start.by_gas - start.by_radiation)),
        ("byRadiation", short(start.by_radiation)),
        ("number", plain(rounded(scene.number(), 2))),
        ("porosity", plain(scene.porosity)),
        ("pressure", plain(scene.pressure)),
        ("stressRow", stress_row(scene)),
        ("gravity", gravity),
    ])
}

/// How top and side hold the spheres, for README.md.
fn held(scene: &SphereCase) -> String {
    let top = match (scene.mechanics, scene.lid) {
        (Mechanics::None, _) => return "nothing moves".to_string(),
        (_, Lid::Presses) => "the top is a stiff plate under a constant load",
        (_, Lid::Stays) => "the top is fixed",
    };
    let side = match &scene.shell {
        Some(_) => "a thin elastic shell",
        None => "fixed",
    };
    let friction = match scene.wall_friction {
        0.0 => "walls are smooth".to_string(),
        friction => format!("walls: {}", wall::sentence(friction)),
    };
    let slack = || format!("; a slack of {} diameters at top and bottom", plain(scene.slack_layer));
    let give = when(scene.slack_layer > 0.0, slack);
    format!("{top}, the side is {side}; {friction}{give}")
}

/// The resistance of the walls, for README.md.
fn wall_resistance(scene: &SphereCase) -> String {
    match scene.wall_material {
        Some(wall) => format!(
            "Walls that heat passes are of {}: the resistance between wall and spheres, which touch it in one layer, is in series with \
             what `0/T` gives (condition `granularWall`; `resistance off` leaves it out).",
            wall.name
        ),
        None => {
            "A wall has its temperature where the mesh ends, without a resistance between wall and spheres."
                .to_string()
        }
    }
}

/// What is left out of this bed, for README.md.
fn left_out(scene: &SphereCase) -> String {
    scene.notes().iter().map(|note| format!("- {note}\n")).collect()
}

/// What `constant/granularProperties` says of walls and of the stress at the start.
fn rest(scene: &SphereCase) -> String {
    if scene.mechanics == Mechanics::None {
        return String::new();
    }
    let slack = || format!(" slackLayer {}; slackRecovery 0.1;", plain(scene.slack_layer));
    let give = when(scene.slack_layer > 0.0, slack);
    let rigid = wall::entry(scene.wall_friction, scene.spheres.sphere());
    let friction = wall::friction(scene.wall_friction, scene.spheres.sphere());
    let entry = |name: &str| match name {
        "top" if scene.lid == Lid::Presses => {
            format!("type piston; pressure constant {};{friction}", plain(scene.pressure))
        }
        "top" | "bottom" => rigid.clone() + &give,
        "side" => side(scene).unwrap_or_else(|| rigid.clone()),
        "inner" => "type frictionless;".to_string(),
        _ => rigid.clone(),
    };
    let inner = match scene.shape {
        Shape::Box(_) => None,
        Shape::Cylinder { .. } => Some("inner"),
    };
    let names = scene.shape.walls().iter().copied().chain(inner);
    let walls: String = names.map(|name| format!("        {name:8} {{ {} }}\n", entry(name))).collect();
    let mut text = format!(
        "\n// Walls: rigid and frictionless ones stay, piston is a stiff plate under a load (pressure where air would press), shell is a thin\n\
         // compliant vessel that expands with its own temperature, along its axis from fixedPoint. friction is tangential over normal\n\
         // stress, less than the coefficient of a sphere, and slip [m] that at half of it; without them spheres slide freely.\n\
         // slackLayer: slack of the spheres at a smooth wall, in diameters of bed\n\
         equilibriumCoeffs\n{{\n    walls\n    {{\n{walls}    }}\n}}\n"
    );
    if rests(scene) {
        text += &format!(
            "\n// The stress at the start: under the weight of what lies above and the pressure on the top, less what rough walls carry (Janssen);\n\
             // lateral: the horizontal one over the vertical one\nrestStress\n{{\n    lateral         {};\n    surface         {};\n}}\n",
            plain(LATERAL),
            plain(scene.pressure)
        );
    }
    text
}

/// What `constant/granularProperties` says of the gas that flows.
fn flow(scene: &SphereCase) -> String {
    let Some(flow) = scene.flow else { return String::new() };
    let [inlet, outlet] = flow.ends();
    // The mesh of a cylinder is a wedge
    let (share, note) = match scene.shape {
        Shape::Box(_) => (1.0, ""),
        Shape::Cylinder { .. } => (HALF_ANGLE / PI, "; the wedge has 1/72 of the mass flow of the bed"),
    };
    format!(
        "\n// Gas that flows through the bed: mass flow [kg/s]{note}, and its temperature where it enters [K]. Both may be functions of\n\
         // time, as massFlow table ((0 0.004) (3600 0)); gas that comes back then needs a temperature at the outlet\n\
         flow                through;\n\
         throughCoeffs\n{{\n    massFlow        {};\n    inlet           {{ patch {inlet}; temperature {}; }}\n    \
         outlet          {{ patch {outlet}; }}\n}}\n",
        plain(rounded(share * flow.mass, 10)),
        plain(flow.temperature)
    )
}

/// The flow, for README.md.
fn flow_row(scene: &SphereCase) -> String {
    scene.flow.map_or_else(String::new, |flow| {
        let [inlet, outlet] = flow.ends();
        format!(
            "| flow | {} kg/s of {} K from {inlet} to {outlet} | `constant/granularProperties` |\n",
            plain(flow.mass),
            plain(flow.temperature)
        )
    })
}

/// The side of a cylinder as a shell.
fn side(scene: &SphereCase) -> Option<String> {
    match (&scene.shell, scene.shape) {
        (Some(shell), Shape::Cylinder { radius, .. }) => Some(format!(
            "type shell; youngModulus {}; thickness {}; radius {};{}{}",
            plain(shell.young_modulus),
            plain(shell.thickness),
            plain(radius),
            wall::expansion(shell.thermal_expansion, scene.initial_temperature, scene.wall_friction),
            wall::friction(scene.wall_friction, scene.spheres.sphere())
        )),
        _ => None,
    }
}

/// Whether the bed begins at rest under its weight.
fn rests(scene: &SphereCase) -> bool {
    scene.gravity > 0.0
}

#[cfg(test)]
#[path = "folder_tests.rs"]
mod tests;
