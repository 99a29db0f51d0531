//! `msdd train`.

use crate::error::CliError;
use crate::score;
use crate::spheres;
use clap::Args;
use msdd_files::{check_target, check_writable, write};
use msdd_surrogate::models;
use msdd_training::{Request, Trained, train};
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
    /// A parameter of the law of spheres that keeps this value while the others are fitted, by its name in a model file's object
    /// `law`, for example `lode=0.45` or `elements[3].free=0`; may be repeated. A name that no parameter has gets the list.
    #[arg(long, value_name = "NAME=VALUE", value_parser = parameter)]
    fix: Vec<(String, f64)>,
}

/// `NAME=VALUE`.
fn parameter(text: &str) -> Result<(String, f64), String> {
    let allowed = "NAME=VALUE, for example lode=0.45";
    let (name, value) = text.split_once('=').ok_or_else(|| format!("allowed: {allowed}"))?;
    let value = value.trim().parse().map_err(|error| format!("{error}, allowed: {allowed}"))?;
    Ok((name.trim().to_string(), value))
}

pub fn run(arguments: &Arguments) -> Result<(), CliError> {
    check_target(&arguments.out)?;
    check_writable(&arguments.out)?;
    let begin = Instant::now();
    let trained = train(&Request {
        database: arguments.database.clone(),
        model: arguments.model.clone(),
        name: arguments.name.clone(),
        seed: arguments.seed,
        restarts: arguments.restarts,
        epochs: arguments.epochs,
        patience: arguments.patience,
        fix: arguments.fix.iter().cloned().collect(),
        threads: 0,
    })?;
    let seconds = begin.elapsed().as_secs_f64();
    write(&arguments.out, trained.to_json().as_bytes())?;
    match &trained {
        Trained::Discs { model, data, plan_hash } => {
            let failed = |source| CliError::Model { file: arguments.out.clone(), source };
            score::print_training(model.as_ref(), data, plan_hash).map_err(failed)?;
        }
        Trained::Spheres { model, tracks } => spheres::print_training(model, tracks)?,
    }
    outln!("model {} in {}, trained in {seconds:.1} s", trained.hash(), arguments.out.display());
    Ok(())
}
