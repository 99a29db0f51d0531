//! `msdd ablation`: how much each input of the networks contributes to their accuracy.

use crate::database::warn_without_checksum;
use crate::error::CliError;
use crate::rows::training_data;
use clap::Args;
use msdd_files::{check_target, write};
use msdd_rve::database::read_all;
use msdd_surrogate::ablation::{self, Line};
use msdd_surrogate::state::training::StateOptions;
use serde_json::json;
use std::path::PathBuf;

#[derive(Args)]
#[command(
    after_help = "As Table 3 of the paper. The data are split into training and test data by packing. Splitting them by sample \
gives too small errors, because samples of the same packing, which resemble each other, are then in both."
)]
pub struct Arguments {
    /// Database, or the CSV that was exported from one; given several times, all of them together.
    #[arg(long, value_name = "FILE", required = true)]
    database: Vec<PathBuf>,
    /// Seed of the random splits and starting weights.
    #[arg(long, default_value_t = 1)]
    seed: u64,
    /// Largest number of Levenberg-Marquardt steps for each network.
    #[arg(long, default_value_t = 20)]
    epochs: u32,
    /// JSON file to write.
    #[arg(long, value_name = "FILE")]
    json: Option<PathBuf>,
}

pub fn run(arguments: &Arguments) -> Result<(), CliError> {
    arguments.json.iter().try_for_each(|json| check_target(json))?;
    warn_without_checksum(&arguments.database)?;
    let dataset = read_all(&arguments.database)?;
    let rows = training_data(&dataset.records).rows;
    let failed = |source| CliError::Training { file: arguments.database[0].clone(), source };
    let mut options = StateOptions::default();
    (options.common.seed, options.common.max_epochs, options.common.restarts) =
        (arguments.seed, arguments.epochs, 1);
    options.common.database.plan_hash = dataset.provenance.get("plan_hash").cloned().unwrap_or_default();
    outln!("R2 (Eq. 12) of one step on what the fit did not see; {} epochs", arguments.epochs);
    outln!(
        "{:<44} {:>7} {:>7} {:>7} {:>7} {:>7}",
        "paper's network, all states",
        "d eta",
        "d f",
        "d f_K",
        "K",
        "sigma"
    );
    let paper = ablation::paper(&rows, &options.common).map_err(failed)?;
    for line in &paper {
        let s = &line.scores;
        print(line, [s.delta_porosity, s.delta_fabric_index, f64::NAN, s.conductivity, s.stress]);
    }
    outln!("state model fitted to single steps, jammed states");
    let state = ablation::state(&rows, &options).map_err(failed)?;
    for line in &state {
        let s = &line.scores;
        let fabric = s.delta_fabric_conductivity.unwrap_or(f64::NAN);
        print(line, [s.delta_porosity, s.delta_fabric_index, fabric, s.conductivity, s.stress]);
    }
    if let Some(path) = &arguments.json {
        let text = serde_json::to_string_pretty(&json!({ "paper": paper, "state": state }))
            .map_err(|error| CliError::Message(format!("cannot write the scores: {error}")))?;
        write(path, (text + "\n").as_bytes())?;
    }
    Ok(())
}

fn print<T>(line: &Line<T>, values: [f64; 5]) {
    let what = match line.without {
        None => format!("  all inputs, split by {}", if line.random_split { "sample" } else { "packing" }),
        Some(input) => format!("  without {input}"),
    };
    let text = |value: f64| if value.is_nan() { "-".to_string() } else { format!("{value:.4}") };
    let columns: Vec<String> = values.map(|value| format!("{:>7}", text(value))).to_vec();
    outln!("{what:<44} {}", columns.join(" "));
}
