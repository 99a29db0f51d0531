//! `msdd train`.

use crate::database::warn_without_checksum;
use crate::error::CliError;
use crate::rows::training_data;
use crate::score;
use clap::Args;
use msdd_files::{check_target, write};
use msdd_rve::database::{Dataset, read_all};
use msdd_surrogate::document::hash;
use msdd_surrogate::state::training::StateOptions;
use msdd_surrogate::state::variables::Variables;
use msdd_surrogate::{DatabaseProvenance, models};
use std::path::PathBuf;
use std::time::Instant;

#[derive(Args)]
pub struct Arguments {
    /// Database, or the CSV that was exported from one; given several times, all of them together.
    #[arg(long, value_name = "FILE", required = true)]
    database: Vec<PathBuf>,
    /// Model file (JSON) to write.
    #[arg(long, value_name = "FILE")]
    out: PathBuf,
    /// Kind of model: constant, paper or state.
    #[arg(long, default_value = models::DEFAULT)]
    model: String,
    /// Name of the model. Default: its kind.
    #[arg(long)]
    name: Option<String>,
    /// Seed of the random split into training, validation and held-out packings, and of the starting weights.
    #[arg(long, default_value_t = 1)]
    seed: u64,
    /// Number of trainings from different starting weights; the one with the least validation error is kept.
    #[arg(long)]
    restarts: Option<u32>,
    /// Largest number of epochs, that is of Levenberg–Marquardt steps.
    #[arg(long)]
    epochs: Option<u32>,
    /// Number of epochs without a smaller validation error after which a training ends.
    #[arg(long)]
    patience: Option<u32>,
    /// State model: neurons in each hidden layer of the network for the rates of the state; one or two layers.
    #[arg(long, value_delimiter = ',', default_value = "4")]
    hidden: Vec<usize>,
    /// State model: neurons in each hidden layer of the readout, the network from the state to K and stress; one or two layers.
    #[arg(long, value_delimiter = ',', default_value = "4")]
    readout: Vec<usize>,
    /// State model: leave fabric_conductivity or deviator out of the state.
    #[arg(long, value_delimiter = ',')]
    without: Vec<String>,
}

pub fn run(arguments: &Arguments) -> Result<(), CliError> {
    check_target(&arguments.out)?;
    warn_without_checksum(&arguments.database)?;
    let dataset = read_all(&arguments.database)?;
    let data = training_data(&dataset.records);
    let failed = |source| CliError::Training { file: arguments.database[0].clone(), source };
    let kind = models::kind(&arguments.model).map_err(failed)?;
    let options = options(arguments, &dataset)?;
    let begin = Instant::now();
    let model = (kind.train)(&data, &options).map_err(failed)?;
    let seconds = begin.elapsed().as_secs_f64();
    write(&arguments.out, model.to_json().as_bytes())?;
    score::print_training(model.as_ref(), &data, &options.common.database.plan_hash).map_err(failed)?;
    outln!("model {} in {}, trained in {seconds:.1} s", model.hash(), arguments.out.display());
    Ok(())
}

fn options(arguments: &Arguments, dataset: &Dataset) -> Result<StateOptions, CliError> {
    let mut options = StateOptions::default();
    let common = &mut options.common;
    if arguments.model == "paper" {
        (common.restarts, common.max_epochs) = (1, 200);
    }
    common.name = arguments.name.clone().unwrap_or_else(|| arguments.model.clone());
    common.seed = arguments.seed;
    common.restarts = arguments.restarts.unwrap_or(common.restarts);
    common.max_epochs = arguments.epochs.unwrap_or(common.max_epochs);
    common.patience = arguments.patience.unwrap_or(common.patience);
    common.database = provenance(arguments, dataset)?;
    options.hidden = arguments.hidden.clone();
    options.readout_hidden = arguments.readout.clone();
    options.variables = Variables::ALL;
    for name in &arguments.without {
        match name.as_str() {
            "fabric_conductivity" => options.variables.fabric_conductivity = false,
            "deviator" => options.variables.stress_deviator = false,
            other => {
                let allowed = "fabric_conductivity, deviator";
                return Err(CliError::Message(format!("--without {other}, allowed: {allowed}")));
            }
        }
    }
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
