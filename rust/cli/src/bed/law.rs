//! `msdd bed law`: the constitutive model alone along the strain that was recorded in a bed.

use crate::error::CliError;
use clap::Args;
use msdd_beds::case::{BedCase, FILE, file_in};
use msdd_beds::packings::column;
use msdd_files::{check_target, list, read_text, write};
use msdd_spheres::law::effective_modulus;
use msdd_surrogate::spheres::law::Law;
use msdd_surrogate::spheres::model::SphereModel;
use msdd_surrogate::spheres::state::State;
use msdd_surrogate::spheres::tensor::{contraction, deviator, mean};
use msdd_surrogate::spheres::tracks::{Point as DataPoint, Step, Track, follow};
use msdd_training::dem_start::packings;
use msdd_training::spheres::beds::track;
use std::fmt::Write;
use std::path::{Path, PathBuf};

#[derive(Args)]
#[command(after_help = "Examples:
  msdd bed run mybed --out mybed && msdd bed law mybed
  msdd bed law cases/beds --out results/law

The law begins with stress, solid fraction, contacts and fabric of the first row of dem.csv, and follows the strain of the rows. No
wall, no weight and no other place of the bed plays a part, so that differences are due to the law. Under a lid
that presses, and in a shell, 'stress kept' follows the stress along the axis instead of the strain there: where the side leaves a bed
under its weight, a small error of the strain changes the pressure by decades. 'jamming' is by how much the solid fraction without
load has grown, in units of 1e-5: of the spheres from their strain and pressure, and of the law. 'shear' is the length of the
path of the shear strain.")]
pub struct Arguments {
    /// Folders with bed.toml and dem-<seed>.csv, or dem.csv alone; or folders of such folders.
    #[arg(required = true)]
    folders: Vec<PathBuf>,
    /// A model file of spheres; default: the one that is compiled in.
    #[arg(long, value_name = "FILE")]
    model: Option<PathBuf>,
    /// Write the states over time to NAME.csv of each bed in this folder.
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
}

/// What spheres and law do over time in one packing. Pressures in Pa.
struct Course {
    name: String,
    rows: Vec<Row>,
    /// Whether the lid kept its pressure.
    pressed: bool,
}

struct Row {
    time: f64,
    spheres: Point,
    /// Along the recorded strain.
    strained: Point,
    /// With the stress of the spheres along the axis instead of the strain there; as `strained` under a lid that stays.
    kept: Point,
    shear: f64,
}

#[derive(Clone, Copy)]
struct Point {
    pressure: f64,
    /// Elastic compression v.
    compression: f64,
    /// Solid fraction at jamming.
    jamming: f64,
}

pub fn run(arguments: &Arguments) -> Result<(), CliError> {
    let law = match &arguments.model {
        None => SphereModel::builtin(),
        Some(file) => SphereModel::read(&read_text(file)?),
    };
    let law = law.map_err(|error| CliError::Message(error.to_string()))?.file.law;
    let mut paths = Vec::new();
    for folder in folders_of(&arguments.folders)? {
        paths.extend(paths_of(&law, &folder)?);
    }
    if let Some(out) = &arguments.out {
        for path in &paths {
            let file = out.join(format!("{}.csv", path.name));
            check_target(&file)?;
            write(&file, csv(path).as_bytes())?;
        }
    }
    print(&paths);
    Ok(())
}

/// Folders of beds, and those within folders.
pub(super) fn folders_of(given: &[PathBuf]) -> Result<Vec<PathBuf>, CliError> {
    let is_bed = |folder: &Path| file_in(folder).is_file();
    let mut all = Vec::new();
    for folder in given {
        let before = all.len();
        match is_bed(folder) {
            true => all.push(folder.clone()),
            false => all.extend(list(folder)?.into_iter().filter(|inner| is_bed(inner))),
        }
        if all.len() == before {
            let allowed = format!("a folder with {FILE}, or a folder of such folders");
            return Err(CliError::Message(format!("{}: no {FILE}, allowed: {allowed}", folder.display())));
        }
    }
    Ok(all)
}

/// The results of the packings of a bed: the numbers of their seeds and the files, or the mean alone.
pub(super) fn results_of(folder: &Path) -> Result<Vec<(Option<u64>, PathBuf)>, CliError> {
    let mean = folder.join("dem.csv");
    match packings(folder) {
        Ok(all) => Ok(all.into_iter().map(|(seed, file)| (Some(seed), file)).collect()),
        Err(_) if mean.is_file() => Ok(vec![(None, mean)]),
        Err(error) => Err(error.into()),
    }
}

fn paths_of(law: &Law, folder: &Path) -> Result<Vec<Course>, CliError> {
    let scene = BedCase::read(folder)?;
    let modulus = effective_modulus(scene.grains.young_modulus, scene.grains.poisson_ratio);
    let whole = folder.canonicalize().unwrap_or_else(|_| folder.to_path_buf());
    let bed = whole.file_name().unwrap_or_default().display().to_string();
    let mut all = Vec::new();
    for (seed, file) in results_of(folder)? {
        let text = read_text(&file)?;
        let times = column(&text, "time").unwrap_or_default();
        let track = track(folder, &scene, &file, &text, 0)?;
        let name = seed.map_or(bed.clone(), |seed| format!("{bed}-{seed}"));
        all.push(Course {
            name,
            rows: rows(law, &track, &times, modulus),
            pressed: track.steps.iter().any(|step| step.free_axis.is_some()),
        });
    }
    Ok(all)
}

fn rows(law: &Law, track: &Track, times: &[f64], modulus: f64) -> Vec<Row> {
    let mut strained = track.clone();
    strained.steps.iter_mut().for_each(|step| step.free_axis = None);
    let point = |state: &State| Point {
        pressure: modulus * mean(law.stress(state)),
        compression: state.compression,
        jamming: state.jamming,
    };
    let (mut shear, mut solid) = (0.0, track.packed.solid);
    let [along, kept] = [follow(law, &strained), follow(law, track)];
    let numbered = along.iter().zip(&kept).zip(times).enumerate();
    numbered
        .map(|(k, ((strained, kept), &time))| {
            if k > 0 {
                let part = deviator(track.steps[k - 1].strain());
                shear += contraction(&part, &part).sqrt();
                // Not the solid fraction that was counted: the region stays where it is, while spheres enter and leave it.
                let Step { thermal, stretch: [x, y, z, ..], .. } = track.steps[k - 1];
                solid *= (1.0 + thermal).powi(3) / ((1.0 + x) * (1.0 + y) * (1.0 + z));
            }
            let data = track.point(k);
            let state = DataPoint { solid, ..*data }.state(law);
            let spheres = Point { pressure: modulus * mean(data.stress), ..point(&state) };
            Row { time, spheres, strained: point(strained), kept: point(kept), shear }
        })
        .collect()
}

fn csv(path: &Course) -> String {
    let mut text = String::from("time,shear");
    for who in ["spheres", "law", "law_stress_kept"] {
        let _ = write!(text, ",p_{who},compression_{who},jamming_{who}");
    }
    text.push('\n');
    for row in &path.rows {
        let _ = write!(text, "{},{:.6e}", row.time, row.shear);
        for point in [row.spheres, row.strained, row.kept] {
            let _ = write!(text, ",{:.6e},{:.6e},{:.7}", point.pressure, point.compression, point.jamming);
        }
        text.push('\n');
    }
    text
}

fn print(paths: &[Course]) {
    outln!(
        "bed                      p of spheres [kPa]        p of law less that, rms [kPa]    jamming, at the end [1e-5]       shear"
    );
    outln!(
        "                         largest    at the end     strain     stress kept           spheres    law   stress kept     [1e-5]"
    );
    for path in paths {
        let Some((first, last)) = path.rows.first().zip(path.rows.last()) else { continue };
        let most = path.rows.iter().map(|row| row.spheres.pressure).fold(0.0, f64::max);
        let rms = |of: fn(&Row) -> Point| {
            let squares = path.rows.iter().map(|row| (of(row).pressure - row.spheres.pressure).powi(2));
            1e-3 * (squares.sum::<f64>() / path.rows.len() as f64).sqrt()
        };
        let grown = |of: fn(&Row) -> Point| 1e5 * (of(last).jamming - of(first).jamming);
        let only = |value: f64| if path.pressed { format!("{value:.2}") } else { "-".to_string() };
        outln!(
            "{:<22} {:>9.2} {:>13.2} {:>10.2} {:>15} {:>17.1} {:>6.1} {:>13} {:>10.0}",
            path.name,
            1e-3 * most,
            1e-3 * last.spheres.pressure,
            rms(|row| row.strained),
            only(rms(|row| row.kept)),
            grown(|row| row.spheres),
            grown(|row| row.strained),
            only(grown(|row| row.kept)),
            1e5 * last.shear
        );
    }
}
