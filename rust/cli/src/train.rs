//! `msdd train`.

use crate::error::CliError;
use crate::rows::training_data;
use crate::score;
use crate::spheres;
use clap::Args;
use msdd_files::{check_target, check_writable, write};
use msdd_rve::database::{Dataset, read_all};
use msdd_surrogate::document::hash;
use msdd_surrogate::{DatabaseProvenance, TrainingOptions, models};
use std::path::PathBuf;
use std::time::Instant;

#[derive(Args)]
pub struct Arguments {
    /// Database, or the CSV that was exported from one; given several times, all of them together. For spheres also a folder
    /// of beds: of folders with bed.toml and results of `msdd bed run --packings`, whose strains inside are taken.
    #[arg(long, value_name = "FILE", required = true)]
    database: Vec<PathBuf>,
    /// Model file (JSON) to write.
    #[arg(long, value_name = "FILE")]
    out: PathBuf,
    /// Kind of model. constant: nothing changes; paper: the network of the paper; increment: the law of the increments, which
    /// needs periodic boxes and takes all their paths of strain; spheres: the law of spheres, for databases of spheres.
    /// Allowed: `constant`, `paper`, `increment`, `spheres`.
    #[arg(long, default_value = models::DEFAULT)]
    model: String,
    /// Name of the model. Default: its kind.
    #[arg(long)]
    name: Option<String>,
    /// Seed of the random split into training, validation and held-out packings, and of the starting weights. A law has no
    /// validation: its packings join the training.
    #[arg(long, default_value_t = 1)]
    seed: u64,
    /// Number of trainings of the paper model from different starting weights; the one with the least validation error is
    /// kept. Allowed: 1 to 100000. Default: 1.
    #[arg(long)]
    restarts: Option<u32>,
    /// Largest number of epochs, that is of Levenberg–Marquardt steps. Allowed: 1 to 100000. Default: 60 for increment, 12
    /// for spheres, 200 for paper.
    #[arg(long)]
    epochs: Option<u32>,
    /// Number of epochs without a smaller validation error after which a training of the paper model ends. Allowed: 1 to
    /// 100000. Default: 20.
    #[arg(long)]
    patience: Option<u32>,
}

pub fn run(arguments: &Arguments) -> Result<(), CliError> {
    check_target(&arguments.out)?;
    if arguments.model == spheres::KIND {
        return spheres::train_and_write(&spheres::Training {
            database: &arguments.database,
            out: &arguments.out,
            name: arguments.name.as_deref(),
            seed: arguments.seed,
            epochs: arguments.epochs,
        });
    }
    let dataset = read_all(&arguments.database)?;
    let data = training_data(&dataset.records);
    let failed = |source| CliError::Training { file: arguments.database[0].clone(), source };
    let kind = models::kind(&arguments.model).map_err(failed)?;
    let options = options(arguments, kind, &dataset)?;
    check_writable(&arguments.out)?;
    let begin = Instant::now();
    let model = (kind.train)(&data, &options).map_err(failed)?;
    let seconds = begin.elapsed().as_secs_f64();
    write(&arguments.out, model.to_json().as_bytes())?;
    score::print_training(model.as_ref(), &data, &options.database.plan_hash).map_err(failed)?;
    outln!("model {} in {}, trained in {seconds:.1} s", model.hash(), arguments.out.display());
    Ok(())
}

fn options(
    arguments: &Arguments,
    kind: &models::Kind,
    dataset: &Dataset,
) -> Result<TrainingOptions, CliError> {
    let mut options = TrainingOptions::default();
    options.name = arguments.name.clone().unwrap_or_else(|| arguments.model.clone());
    options.seed = arguments.seed;
    options.restarts = arguments.restarts.unwrap_or(options.restarts);
    options.max_epochs = arguments.epochs.unwrap_or(kind.epochs);
    options.patience = arguments.patience.unwrap_or(options.patience);
    options.database = provenance(arguments, dataset)?;
    Ok(options)
}

fn provenance(arguments: &Arguments, dataset: &Dataset) -> Result<DatabaseProvenance, CliError> {
    let value = |key: &str| {
        let missing = || format!("{}: no {key} in its provenance", arguments.database[0].display());
        dataset.provenance.get(key).ok_or_else(|| CliError::Message(missing()))
    };
    let bad = |key: &str| {
        let path = arguments.database[0].display().to_string();
        let key = key.to_string();
        move |error: String| CliError::Message(format!("{path}: provenance {key}: {error}"))
    };
    let number = |key: &'static str| value(key)?.parse::<f64>().map_err(|error| bad(key)(error.to_string()));
    let rows = serde_json::to_string(&dataset.records)
        .map_err(|error| CliError::Message(format!("{}: {error}", arguments.database[0].display())))?;
    Ok(DatabaseProvenance {
        rows_hash: Some(hash(&rows)),
        plan_hash: value("plan_hash")?.clone(),
        engine_version: value("engine_version")?.clone(),
        material: serde_json::from_str(value("material")?)
            .map_err(|error| bad("material")(error.to_string()))?,
        radius_min: number("radius_min")?,
        radius_max: number("radius_max")?,
    })
}
