//! `msdd train`.

use crate::error::CliError;
use crate::files::write_atomically;
use crate::progress::Progress;
use clap::Args;
use msdd_rve::database::{Dataset, Kind, RampName, Record, read};
use msdd_surrogate::{DatabaseProvenance, Report, StateRow, TrainingOptions};
use std::path::PathBuf;

#[derive(Args)]
pub struct Arguments {
    /// Database, or the CSV that was exported from one.
    #[arg(long, value_name = "FILE")]
    database: PathBuf,
    /// Model file (JSON) to write.
    #[arg(long, value_name = "FILE")]
    out: PathBuf,
    /// Name of the model.
    #[arg(long, default_value = "paper")]
    name: String,
    /// Fixes the split into training, validation and held-out packings, and the starting weights.
    #[arg(long, default_value_t = 1)]
    seed: u64,
    /// Starts from other weights; the best on the validation packings is kept.
    #[arg(long, default_value_t = 1)]
    restarts: u32,
    /// Levenberg–Marquardt steps at most.
    #[arg(long, default_value_t = 200)]
    epochs: u32,
}

pub fn run(arguments: &Arguments) -> Result<(), CliError> {
    let dataset = read(&arguments.database)?;
    let rows = state_rows(&dataset.records);
    let options = TrainingOptions {
        name: arguments.name.clone(),
        seed: arguments.seed,
        restarts: arguments.restarts,
        max_epochs: arguments.epochs,
        database: provenance(arguments, &dataset)?,
        ..TrainingOptions::default()
    };
    let epochs = u64::from(arguments.restarts) * u64::from(arguments.epochs);
    let mut bar = Progress::new("epochs at most", epochs);
    let trained = msdd_surrogate::train(&rows, &options, |progress| {
        let done = u64::from(progress.restart) * u64::from(arguments.epochs) + u64::from(progress.epoch);
        let (training, validation) = (progress.training_error, progress.validation_error);
        bar.set(done, epochs, &format!("mse {training:.3e}, validation {validation:.3e}"));
    });
    bar.finish();
    let failed = |source| CliError::Training { file: arguments.database.clone(), source };
    let (model, report) = trained.map_err(failed)?;
    write_atomically(&arguments.out, model.to_json().as_bytes())?;
    print(&report);
    println!("model {} in {}", model.hash(), arguments.out.display());
    Ok(())
}

/// The rows that training can use: thermal ramps from the packed state, all but failures. The packed state is stop 0 of both ramps. Stresses become
/// dimensionless, σ ℓ/(E r̄) with ℓ = 1 m and the current r̄; the solid fraction is that of the averaging region.
fn state_rows(records: &[Record]) -> Vec<StateRow> {
    let row = |record: &Record, ramp: &str| {
        let scale = record.young_modulus * record.mean_radius?;
        Some(StateRow {
            packing: record.packing,
            ramp: ramp.to_string(),
            stop: record.stop,
            strain: record.strain,
            porosity: record.porosity?,
            fabric_index: record.fabric_index?,
            conductivity_xx: record.conductivity_xx?,
            conductivity_yy: record.conductivity_yy?,
            stress_xx: record.stress_xx? / scale,
            stress_yy: record.stress_yy? / scale,
            porosity_sum_of_areas: record.porosity? - record.overlap_fraction?,
            load_bearing: record.outcome != "unjammed",
        })
    };
    let mut rows = Vec::new();
    for record in records.iter().filter(|record| record.kind == Kind::Thermal) {
        match record.ramp {
            RampName::Packed => rows.extend(["up", "down"].iter().filter_map(|ramp| row(record, ramp))),
            RampName::Up | RampName::Down => rows.extend(row(record, record.ramp.as_str())),
            _ => (),
        }
    }
    rows
}

fn provenance(arguments: &Arguments, dataset: &Dataset) -> Result<DatabaseProvenance, CliError> {
    let value = |key: &str| {
        let missing = || format!("{}: no {key} in its provenance", arguments.database.display());
        dataset.provenance.get(key).ok_or_else(|| CliError::Message(missing()))
    };
    let bad = |key: &str| {
        let path = arguments.database.display().to_string();
        let key = key.to_string();
        move |error: String| CliError::Message(format!("{path}: provenance {key}: {error}"))
    };
    let number = |key: &'static str| value(key)?.parse::<f64>().map_err(|error| bad(key)(error.to_string()));
    Ok(DatabaseProvenance {
        plan_hash: value("plan_hash")?.clone(),
        engine_version: value("engine_version")?.clone(),
        material: serde_json::from_str(value("material")?)
            .map_err(|error| bad("material")(error.to_string()))?,
        radius_min: number("radius_min")?,
        radius_max: number("radius_max")?,
    })
}

fn print(report: &Report) {
    let (packings, samples) = (&report.packings, &report.samples);
    println!(
        "{} epochs, best {}, stopped: {:?}; mse {:.3e}, validation {:.3e}",
        report.epochs, report.best_epoch, report.stopping, report.training_error, report.validation_error
    );
    println!();
    println!("R2 (Eq. 12)          training  validation    held out");
    println!(
        "packings (samples) {:>4} ({}) {:>4} ({}) {:>4} ({})",
        packings.training,
        samples.training,
        packings.validation,
        samples.validation,
        packings.test,
        samples.test
    );
    let scores = &report.scores;
    let line = |name: &str, score: fn(&msdd_surrogate::scores::Scores) -> f64| {
        let [a, b, c] = [&scores.training, &scores.validation, &scores.test].map(score);
        println!("{name:<18} {a:>11.4} {b:>11.4} {c:>11.4}");
    };
    line("delta porosity", |s| s.delta_porosity);
    line("delta fabric index", |s| s.delta_fabric_index);
    line("conductivity xx", |s| s.conductivity_xx);
    line("conductivity yy", |s| s.conductivity_yy);
    line("stress xx", |s| s.stress_xx);
    line("stress yy", |s| s.stress_yy);
    line("conductivity", |s| s.conductivity);
    line("stress", |s| s.stress);
    println!();
    println!("Drift: a strain in one and in many increments, held-out packings, relative rms error");
    println!("  strain  increments  conductivity    stress   porosity (abs.)");
    for drift in &report.drift {
        println!(
            "{:>+8.3} {:>11} {:>12.2}% {:>8.2}% {:>17.5}",
            drift.strain,
            drift.increments,
            100.0 * drift.conductivity,
            100.0 * drift.stress,
            drift.porosity
        );
    }
}
