//! Values in the files of a new case: numbers and names as text.

use crate::numbers::{plain, rounded, short};
use crate::packing::{Packing, RADIUS_RANGE, Spread};
use crate::scene::{DiscCase, Mechanics, WALLS};
use crate::walls::WallOverTime;
use msdd_beds::property::Property;
use msdd_dem::{Material, WallHeat};
use msdd_rve::Compression;
use std::f64::consts::PI;
use std::path::Path;

/// Number of times at which fields are written during the run, and number of rows in the probes' tables.
const WRITES: f64 = 4.0;
const PROBE_LINES: f64 = 200.0;
/// Least number of time steps of a run, so that curves of T are smooth.
const STEPS: f64 = 100.0;

/// To estimate the duration of a discrete element simulation: time step over [`contact_period`], and time for one grain and step
/// on one core [s]. From 20 s of case H with 15 000 grains and steps of 1 ms, 131 core-seconds.
const DISCS_STEP: f64 = 0.8;
const DISCS_COST: f64 = 4e-7;

/// Last entries of the condition of a wall with a coefficient or a flux and without a resistance.
const EXTERNAL: &str =
    "\n        kappaMethod     lookup;\n        kappa           K;\n        value           $internalField;";

const NO_SOURCE: &str = "; but msdd reference cannot simulate heat sources and refuses this case";

pub(crate) type Values = Vec<(&'static str, String)>;

/// The values that replace `@key@` in the templates.
pub(crate) fn values(scene: &DiscCase, packing: &Packing, name: &str, checkout: &Path) -> Values {
    let depth = scene.cell()[0].min(scene.cell()[1]);
    let moves = scene.mechanics == Mechanics::Equilibrium;
    let mut values: Values = vec![
        ("spaceProbes", when(moves, || include_str!("../templates/spaceProbes").to_string())),
        ("wallProfile", String::new()),
        ("checkout", checkout.display().to_string()),
        ("name", name.to_string()),
        ("mechanics", mechanics_name(scene.mechanics).to_string()),
        ("depth", short(depth)),
        ("probes", probes(scene, depth)),
        ("probesNote", format!(". z is between 0 and {} m", short(depth))),
        ("initialTemperature", plain(scene.initial_temperature)),
        ("walls", walls(WALLS.into_iter().zip(&scene.walls), false)),
        ("libraries", libraries(&scene.walls, false)),
        ("parts", "$..numberOfSubdomains 1 1".to_string()),
        ("heatSource", plain(scene.heat_source.unwrap_or(0.0))),
    ];
    values.extend(times(scene.end_time, scene.first_step()));
    values.extend([("model", scene.model.entry()), ("modelAbout", scene.model.about())]);
    values.extend(scene.grains.named().map(|(key, value, _)| (key, plain(value))));
    values.extend(mesh_values(scene, packing));
    values.extend(readme_values(scene, packing));
    values
}

/// The times of `system/controlDict` \[s\], of a run with this end and first step.
pub(crate) fn times(end: f64, first_step: f64) -> Values {
    vec![
        ("endTime", plain(end)),
        ("deltaT", plain(first_step)),
        ("maxDeltaT", plain(rounded(end / STEPS, 2))),
        ("writeInterval", plain(end / WRITES)),
        ("probeInterval", plain(rounded(end / PROBE_LINES, 2))),
    ]
}

fn mesh_values(scene: &DiscCase, packing: &Packing) -> Values {
    let [width, height] = scene.size;
    let [cell_width, cell_height] = scene.cell();
    let grains = |area| grains_in(area, packing.porosity.mean, scene.grains.mean_radius);
    let (discs, in_cell) = (grains(width * height), grains(cell_width * cell_height));
    vec![
        ("width", plain(width)),
        ("height", plain(height)),
        ("nx", scene.cells[0].to_string()),
        ("ny", scene.cells[1].to_string()),
        ("cellWidth", short(cell_width)),
        ("cellHeight", short(cell_height)),
        ("grainsInCell", format!("{in_cell:.1}")),
        ("discs", plain(rounded(discs, 2))),
        ("discsTime", discs_time(scene, discs)),
    ]
}

/// Number of grains on an area \[m²\] with this porosity, if overlaps are neglected.
pub fn grains_in(area: f64, porosity: f64, mean_radius: f64) -> f64 {
    let [low, high] = RADIUS_RANGE.map(|ratio| ratio * mean_radius);
    // Mean of r² for radii that are uniformly distributed between the two.
    area * (1.0 - porosity) / (PI * (low * low + low * high + high * high) / 3.0)
}

fn readme_values(scene: &DiscCase, packing: &Packing) -> Values {
    vec![
        ("wallRows", wall_rows(WALLS.into_iter().zip(&scene.walls))),
        ("material", scene.material.clone()),
        ("compression", compression_name(packing.compression).to_string()),
        ("boxes", packing.boxes.to_string()),
        ("boxGrains", packing.grains.to_string()),
        ("packing", table(packing)),
        ("sourceRow", source(scene.heat_source)),
        ("noSource", when(scene.heat_source.is_some(), || NO_SOURCE.to_string())),
    ]
}

/// Keys of `system/fvSolution` of a run that ends once it is steady.
pub(crate) fn stop_when_steady(steady: bool) -> String {
    let text = "\n\n    // The run ends once T and p would change by less than this share in as long a time as the run so far\n    \
                stopWhenSteady          1e-3;";
    when(steady, || text.to_string())
}

/// Rows of the table in README.md for the walls.
pub(crate) fn wall_rows<'a>(walls: impl Iterator<Item = (&'a str, &'a WallOverTime)>) -> String {
    walls.map(|(name, wall)| format!("| {name} wall | {} | `0/T` |\n", describe(wall))).collect()
}

/// Heat released in the bed [W/m³], as text.
pub(crate) fn source(heat_source: Option<f64>) -> String {
    match heat_source {
        Some(value) => format!("{} W/m3", plain(value)),
        None => "nothing (no such file)".to_string(),
    }
}

/// Time in which a grain oscillates on its contacts \[s\], about: √(ρ r̄ ℓ/E), ℓ = 1 m.
pub fn contact_period(material: &Material, mean_radius: f64) -> f64 {
    (material.density * mean_radius / material.young_modulus).sqrt()
}

/// Estimated time of one core \[s\] for discs that are simulated to `end` \[s\]; `period` \[s\]: [`contact_period`].
pub fn discs_seconds(end: f64, period: f64, discs: f64) -> f64 {
    end / (DISCS_STEP * period) * discs * DISCS_COST
}

/// Estimated duration of a discrete element simulation of the case, as text; from measurements with the paper's grains.
fn discs_time(scene: &DiscCase, discs: f64) -> String {
    let period = contact_period(&scene.grains.material(), scene.grains.mean_radius);
    let seconds = discs_seconds(scene.end_time, period, discs);
    match seconds {
        ..60.0 => "seconds".to_string(),
        ..3600.0 => format!("{:.0} minutes", seconds / 60.0),
        ..86400.0 => format!("{:.0} hours", seconds / 3600.0),
        _ => format!("{} days: stiff grains need short steps", plain(rounded(seconds / 86400.0, 2))),
    }
}

/// Thermal boundary condition of a wall, as text.
pub fn describe(wall: &WallOverTime) -> String {
    match wall {
        WallOverTime::Steady(WallHeat::Temperature(value)) => format!("{} K", plain(*value)),
        WallOverTime::Steady(_) => "insulated".to_string(),
        WallOverTime::Coefficient { coefficient, outside } => {
            format!("{} W/(m2 K) to {} K outside", plain(*coefficient), plain(*outside))
        }
        WallOverTime::Flux(flux) => format!("{} W/m2 into the bed", plain(*flux)),
        WallOverTime::Table(rows) => {
            let row = |[time, value]: &[f64; 2]| format!("{} K at {} s", plain(*value), plain(*time));
            rows.iter().map(row).collect::<Vec<_>>().join(", ")
        }
    }
}

/// Rows of the table of the initial state: quantity, mean, scatter.
pub fn packing_rows(packing: &Packing) -> Vec<[String; 3]> {
    let row = |what: &str, spread: Spread, digits: usize| {
        [what.to_string(), format!("{:.digits$}", spread.mean), format!("{:.digits$}", spread.deviation)]
    };
    let pascal = |what: &str, spread: Spread| {
        [what.to_string(), plain(rounded(spread.mean, 4)), plain(rounded(spread.deviation, 2))]
    };
    vec![
        row("porosity (overlaps counted once)", packing.porosity, 4),
        pascal("pressure [Pa]", packing.pressure),
        pascal("stress along x [Pa], compression positive", packing.stress[0]),
        pascal("stress along y [Pa]", packing.stress[1]),
        row("fabric index F_xx - F_yy", packing.fabric_index, 4),
        row("conductivity of the bed over the conductivity of the grains", packing.conductivity, 4),
    ]
}

fn table(packing: &Packing) -> String {
    let row = |[what, mean, deviation]: [String; 3]| format!("| {what} | {mean} | {deviation} |\n");
    let rows: String = packing_rows(packing).into_iter().map(row).collect();
    format!("| quantity | mean | scatter |\n|---|---|---|\n{}", rows.trim_end())
}

fn probes(scene: &DiscCase, depth: f64) -> String {
    let z = short(0.5 * depth);
    let line = |[x, y]: &[f64; 2]| format!("            ({} {} {z})", plain(*x), plain(*y));
    scene.probes.iter().map(line).collect::<Vec<_>>().join("\n")
}

/// Patches of `0/T`. `resist`: walls that heat passes contain the resistance between wall and grains.
pub(crate) fn walls<'a>(walls: impl Iterator<Item = (&'a str, &'a WallOverTime)>, resist: bool) -> String {
    let block = |(name, wall): (&str, &WallOverTime)| {
        format!("    {name}\n    {{\n        {}\n    }}\n", condition(wall, resist))
    };
    walls.map(block).collect()
}

/// Rows of a wall's temperature over time, as OpenFOAM's table.
fn rows_of(rows: &[[f64; 2]]) -> String {
    let list: String =
        rows.iter().map(|[time, value]| format!(" ({} {})", plain(*time), plain(*value))).collect();
    format!("table ({list} )")
}

/// The condition of a wall; `resist`: with the resistance between wall and grains, if heat passes.
fn condition(wall: &WallOverTime, resist: bool) -> String {
    let with_mode = |mode: &str, entries: String| {
        let [kind, end] = match resist {
            true => ["granularWall", ""],
            false => ["externalWallHeatFluxTemperature", EXTERNAL],
        };
        format!("type            {kind};\n        mode            {mode};\n        {entries}{end}")
    };
    let temperature = |value: String| with_mode("temperature", format!("temperature     {value};"));
    let [uniform, constant] = if resist { [""; 2] } else { ["uniform ", "constant "] };
    match wall {
        WallOverTime::Coefficient { coefficient, outside } => {
            let (h, outside) = (plain(*coefficient), plain(*outside));
            let h = format!("h               {uniform}{h};\n        Ta              {constant}{outside};");
            with_mode("coefficient", h)
        }
        WallOverTime::Flux(flux) => with_mode("flux", format!("q               {uniform}{};", plain(*flux))),
        WallOverTime::Table(rows) if resist => temperature(rows_of(rows)),
        WallOverTime::Table(rows) => format!(
            "type            uniformFixedValue;\n        uniformValue    {};\n        value           uniform {};",
            rows_of(rows),
            plain(rows[0][1])
        ),
        WallOverTime::Steady(WallHeat::Temperature(value)) if resist => temperature(plain(*value)),
        WallOverTime::Steady(WallHeat::Temperature(value)) => {
            format!("type    fixedValue;\n        value   uniform {};", plain(*value))
        }
        WallOverTime::Steady(_) => "type    zeroGradient;".to_string(),
    }
}

/// Entry of `system/controlDict` for the conditions of the walls; `resist` as for [`walls`].
pub(crate) fn libraries(walls: &[WallOverTime], resist: bool) -> String {
    let library = |condition: &str, name: &str| {
        format!("\n// With {condition} of 0/T\nlibs            (\"{name}\");\n")
    };
    let external =
        |wall: &WallOverTime| matches!(wall, WallOverTime::Coefficient { .. } | WallOverTime::Flux(_));
    if resist && walls.iter().any(WallOverTime::conducts) {
        library("granularWall", "libgranularThermo.so")
    } else if !resist && walls.iter().any(external) {
        library("externalWallHeatFluxTemperature", "libcompressibleTurbulenceModels.so")
    } else {
        String::new()
    }
}

/// Name of the mechanics in `constant/granularProperties`.
pub fn mechanics_name(mechanics: Mechanics) -> &'static str {
    match mechanics {
        Mechanics::None => "none",
        Mechanics::Equilibrium => "equilibrium",
    }
}

pub fn compression_name(compression: Compression) -> &'static str {
    match compression {
        Compression::Isotropic => "isotropic",
        Compression::Horizontal => "horizontal",
        Compression::Intermediate => "intermediate",
        Compression::Sheared => "sheared",
    }
}

/// A text, or an empty one.
pub fn when(given: bool, text: impl FnOnce() -> String) -> String {
    if given { text() } else { String::new() }
}

/// Replaces every `@key@` by its value.
pub(crate) fn fill(template: &str, values: &Values) -> String {
    values.iter().fold(template.to_string(), |text, (key, value)| text.replace(&format!("@{key}@"), value))
}

/// A property as the solver reads it.
pub fn property_text(of: &Property) -> String {
    match of {
        Property::Constant(value) => plain(*value),
        Property::Table(rows) => {
            let rows: Vec<String> =
                rows.iter().map(|[t, value]| format!("({} {})", plain(*t), plain(*value))).collect();
            format!("table ({})", rows.join(" "))
        }
    }
}
