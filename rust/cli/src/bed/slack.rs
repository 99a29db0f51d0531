//! `msdd bed slack`: the slack of spheres next to plates.

use super::law::{folders_of, results_of};
use crate::error::CliError;
use crate::output::write_json;
use clap::Args;
use msdd_beds::case::BedCase;
use msdd_beds::plates::{self, Give};
use msdd_files::{check_target, read_text};
use serde::Serialize;
use std::path::{Path, PathBuf};

#[derive(Args)]
#[command(after_help = "Examples:
  msdd bed slack cases/database/poured
  msdd bed run mybed --packings 3 --out mybed && msdd bed slack mybed

Spheres at a plate find no hold, and a bed between plates is shortened by more than its strain inside, which 'msdd bed run' records.
'slackLayer' is the thickness of bed, in diameters, that does this at each plate while the bed is pressed, 'back' the same while it is let
up: the keys of a wall in the solver's granularProperties are slackLayer, and slackRecovery = back/slackLayer. The second number is how much one packing
differs from the mean. A lid of constant pressure gives no value.")]
pub struct Arguments {
    /// Folders with bed.toml and dem-<seed>.csv, or dem.csv alone; or folders of such folders.
    #[arg(required = true)]
    folders: Vec<PathBuf>,
    /// Write the numbers to this file, too.
    #[arg(long, value_name = "FILE")]
    json: Option<PathBuf>,
}

/// What a bed's plates give; NaN becomes null.
#[derive(Serialize)]
struct PlateCompliance {
    name: String,
    wall_friction: f64,
    packings: usize,
    /// Mean and standard deviation of one packing.
    give: [f64; 2],
    back: [f64; 2],
}

pub fn run(arguments: &Arguments) -> Result<(), CliError> {
    arguments.json.iter().try_for_each(|json| check_target(json))?;
    let mut beds = Vec::new();
    for folder in folders_of(&arguments.folders)? {
        beds.push(bed(&folder)?);
    }
    outln!("bed                   packings  wall friction   give [d]  packings   back [d]  packings");
    for bed in &beds {
        let [give, back] =
            [bed.give, bed.back].map(|[mean, scatter]| format!("{:>10}{:>10}", told(mean), told(scatter)));
        outln!("{:<20}{:>10}{:>15} {give} {back}", bed.name, bed.packings, bed.wall_friction);
    }
    let all = |of: fn(&PlateCompliance) -> [f64; 2]| join(beds.iter().map(|bed| of(bed)[0]));
    let [[give, _], [back, _]] = [all(|bed| bed.give), all(|bed| bed.back)];
    outln!("{:<45} {:>10}{:10} {:>10}", "mean of the beds", told(give), "", told(back));
    if let Some(path) = &arguments.json {
        write_json(path, &beds)?;
    }
    Ok(())
}

fn bed(folder: &Path) -> Result<PlateCompliance, CliError> {
    let scene = BedCase::read(folder)?;
    let mut gives: Vec<Give> = Vec::new();
    for (_, file) in results_of(folder)? {
        let give = plates::give(&read_text(&file)?, scene.grains.diameter);
        gives.push(give.ok_or_else(|| {
            CliError::Message(format!(
                "{}: no strain inside, allowed: dem.csv of this version's 'msdd bed run'",
                file.display()
            ))
        })?);
    }
    Ok(PlateCompliance {
        name: folder.file_name().unwrap_or_default().display().to_string(),
        wall_friction: scene.grains.wall_friction,
        packings: gives.len(),
        give: join(gives.iter().map(|give| give.thickness)),
        back: join(gives.iter().map(|give| give.back)),
    })
}

fn told(value: f64) -> String {
    if value.is_finite() { format!("{value:.2}") } else { "–".to_string() }
}

/// Mean and standard deviation of those that are known.
fn join(values: impl Iterator<Item = f64>) -> [f64; 2] {
    let known: Vec<f64> = values.filter(|value| value.is_finite()).collect();
    let count = known.len() as f64;
    let mean = known.iter().sum::<f64>() / count;
    let squares: f64 = known.iter().map(|value| (value - mean).powi(2)).sum();
    [mean, if known.len() > 1 { (squares / (count - 1.0)).sqrt() } else { f64::NAN }]
}
