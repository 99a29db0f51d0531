//! `comparisons ranges`: the ranges of the scenes and beds by which the default models are compared with DEM.

use crate::dem::{BedPlan, Plan, PlannedScene, Use, data};
use clap::Args;
use msdd_beds::case::BedCase;
use msdd_beds::packings::{at_start, column};
use msdd_beds::pour::Container;
use msdd_cli::shared::CliError;
use msdd_files::{read_text, write};
use msdd_spheres::law::effective_modulus;
use msdd_surrogate::compared::{Compared, Ranges};
use msdd_training::dem_start::packings;
use std::path::{Path, PathBuf};

/// Significant digits of the ranges, rounded outwards.
const DIGITS: i32 = 3;

#[derive(Args)]
#[command(
    after_help = "Example: comparisons ranges --scenes cases/scenes/plan.toml --beds cases/beds/plan.toml \\
    --out rust/surrogate/src/compared.json"
)]
pub struct Arguments {
    /// The plan of scenes of discs, next to windows.csv.gz.
    #[arg(long, value_name = "FILE")]
    scenes: PathBuf,
    /// The plan of beds of spheres, next to a folder of each name with bed.toml and the files dem-<seed>.csv.
    #[arg(long, value_name = "FILE")]
    beds: PathBuf,
    /// File for the ranges (JSON).
    #[arg(long, value_name = "FILE")]
    out: PathBuf,
}

pub fn run(arguments: &Arguments) -> Result<(), CliError> {
    let ranges = Compared { discs: discs(&arguments.scenes)?, spheres: spheres(&arguments.beds)? };
    let text = serde_json::to_string_pretty(&ranges)
        .map_err(|error| CliError::Message(format!("ranges: {error}")))?;
    Ok(write(&arguments.out, format!("{text}\n").as_bytes())?)
}

/// Widens a range to these values.
fn include(ranges: &mut Ranges, quantity: &str, values: impl IntoIterator<Item = f64>) {
    for value in values {
        let [least, most] = ranges.entry(quantity.to_string()).or_insert([f64::INFINITY, f64::NEG_INFINITY]);
        (*least, *most) = (least.min(value), most.max(value));
    }
}

fn rounded_outwards(mut ranges: Ranges) -> Ranges {
    for [least, most] in ranges.values_mut() {
        (*least, *most) = (0.0 - up(-*least), up(*most));
    }
    ranges
}

/// The next number of [`DIGITS`] digits that is not below this one.
fn up(value: f64) -> f64 {
    if value == 0.0 {
        return 0.0;
    }
    let power = value.abs().log10().floor() as i32 - (DIGITS - 1);
    // A number that has these digits stays, although tenths are not exact.
    let digits = (value / 10f64.powi(power) - 1e-9).ceil();
    format!("{digits}e{power}").parse().unwrap_or(value)
}

fn folder(plan: &Path) -> &Path {
    plan.parent().unwrap_or(Path::new("."))
}

fn discs(plan: &Path) -> Result<Ranges, CliError> {
    let scenes = Plan::read(plan)?.scenes;
    let compared = |scene: &&PlannedScene| scene.purpose != Use::Outside;
    let mut ranges = Ranges::new();
    for scene in scenes.iter().filter(compared) {
        let case = scene.case()?;
        let start = case.initial_temperature;
        let walls = case.walls.iter().flat_map(msdd_case::walls::WallOverTime::temperatures);
        let strains = walls.chain([start]).map(|wall| scene.thermal_expansion * (wall - start));
        include(&mut ranges, "thermal_strain", strains);
        include(&mut ranges, "grains_across", scene.size.map(|length| length / 2.0));
        include(&mut ranges, "heat_source", [0.0]);
    }
    let text = data::read(folder(plan), "windows.csv.gz")?;
    let wrong = || {
        CliError::Message("windows.csv.gz: allowed: the columns scene and pressure of the plan".to_string())
    };
    let mut lines = text.lines();
    let names: Vec<&str> = lines.next().unwrap_or_default().split(',').collect();
    let place = |name: &str| names.iter().position(|known| *known == name).ok_or_else(wrong);
    let (name, pressure) = (place("scene")?, place("pressure")?);
    for line in lines {
        let cells: Vec<&str> = line.split(',').collect();
        let of = |scene: &&PlannedScene| cells.get(name) == Some(&scene.name.as_str());
        let Some(scene) = scenes.iter().filter(compared).find(of) else { continue };
        let value: f64 = cells.get(pressure).and_then(|cell| cell.parse().ok()).ok_or_else(wrong)?;
        include(&mut ranges, "reduced_pressure", [value / (scene.young_modulus * scene.mean_radius)]);
    }
    Ok(rounded_outwards(ranges))
}

fn spheres(plan: &Path) -> Result<Ranges, CliError> {
    let mut ranges = Ranges::new();
    for planned in BedPlan::read(plan)?.scenes.iter().filter(|bed| bed.purpose != Use::Outside) {
        let folder = folder(plan).join(&planned.name);
        let bed = BedCase::read(&folder)?;
        let grains = &bed.grains;
        let (temperatures, start) = (bed.temperatures(), bed.time.initial_temperature);
        let expansion = grains.thermal_expansion.unwrap_or(0.0);
        include(&mut ranges, "temperature", temperatures);
        include(&mut ranges, "thermal_strain", temperatures.map(|t| expansion * (t - start)));
        include(&mut ranges, "conductivity_ratio", grains.ratios(temperatures, &bed.gas));
        include(&mut ranges, "heat_source", [0.0]);
        let modulus = effective_modulus(grains.young_modulus, grains.poisson_ratio);
        for (_, file) in packings(&folder)? {
            let text = read_text(&file)?;
            let missing = |name: &str| CliError::Message(format!("{}: no column {name}", file.display()));
            let pressures = column(&text, "p").ok_or_else(|| missing("p"))?;
            include(&mut ranges, "reduced_pressure", pressures.iter().map(|p| p / modulus));
            let depth = at_start(&text, "depth").ok_or_else(|| missing("depth"))?;
            let across = match bed.vessel() {
                Container::Endless { .. } => depth,
                Container::Box { base: [x, y] } => depth.min(x).min(y),
                Container::Cylinder { radius } => depth.min(2.0 * radius),
            };
            include(&mut ranges, "grains_across", [across / grains.diameter]);
        }
    }
    Ok(rounded_outwards(ranges))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_shipped_ranges_are_those_of_the_scenes_and_beds() {
        let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
        let found = Compared {
            discs: discs(&root.join("cases/scenes/plan.toml")).unwrap(),
            spheres: spheres(&root.join("cases/beds/plan.toml")).unwrap(),
        };
        let shipped = read_text(&root.join("rust/surrogate/src/compared.json")).unwrap();
        assert_eq!(serde_json::from_str::<Compared>(&shipped).unwrap(), found);
    }

    #[test]
    fn ranges_are_rounded_outwards() {
        let ranges = Ranges::from([("a".to_string(), [-9.6e-5, 0.1234]), ("b".to_string(), [12.0, 33.21])]);
        let rounded = rounded_outwards(ranges);
        assert_eq!((rounded["a"], rounded["b"]), ([-9.6e-5, 0.124], [12.0, 33.3]));
    }
}
