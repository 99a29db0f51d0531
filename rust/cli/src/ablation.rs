//! `msdd ablation`: how much each input of the network, and each part of the law of the increments, contributes to the accuracy.

use crate::database::warn_without_checksum;
use crate::error::CliError;
use crate::rows::training_data;
use crate::score::print_paths;
use crate::spheres;
use clap::Args;
use msdd_files::{check_target, write};
use msdd_rve::database::read_all;
use msdd_surrogate::TrainingOptions;
use msdd_surrogate::ablation::{self, Line};
use msdd_surrogate::increment::forms::Form;
use msdd_surrogate::increment::training::USUAL_EPOCHS;
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
    /// Number that the random splits and starting weights follow from.
    #[arg(long, default_value_t = 1)]
    seed: u64,
    /// Largest number of Levenberg–Marquardt steps for each network; a law takes at least 60. Allowed: 1 to 100000.
    #[arg(long, default_value_t = 20)]
    epochs: u32,
    /// Only compare the law of the increments with a learned form of it.
    #[arg(long)]
    forms: bool,
    /// Only the parts of the law of spheres, fitted to a third of the packings; the database is one of spheres; not with
    /// --forms.
    #[arg(long, conflicts_with = "forms")]
    spheres: bool,
    /// JSON file to write.
    #[arg(long, value_name = "FILE")]
    json: Option<PathBuf>,
}

pub fn run(arguments: &Arguments) -> Result<(), CliError> {
    arguments.json.iter().try_for_each(|json| check_target(json))?;
    warn_without_checksum(&arguments.database)?;
    if arguments.spheres {
        let (epochs, json) = (arguments.epochs, arguments.json.as_deref());
        return spheres::print_ablation(&arguments.database, arguments.seed, epochs, json);
    }
    let dataset = read_all(&arguments.database)?;
    let data = training_data(&dataset.records);
    let failed = |source| CliError::Training { file: arguments.database[0].clone(), source };
    let mut options = TrainingOptions { restarts: 1, seed: arguments.seed, ..TrainingOptions::default() };
    options.max_epochs = arguments.epochs;
    options.database.plan_hash = dataset.provenance.get("plan_hash").cloned().unwrap_or_default();
    let (mut paper, mut law, mut forms) = (Vec::new(), Vec::new(), Vec::new());
    if !arguments.forms {
        outln!("R2 (Eq. 12) of one step on what the fit did not see; {} epochs", arguments.epochs);
        outln!("{:<44} {:>7} {:>7} {:>7} {:>7}", "paper's network, all states", "d eta", "d f", "K", "sigma");
        paper = ablation::paper(&data.rows, &options).map_err(failed)?;
        for line in &paper {
            let s = &line.scores;
            print(line, [s.delta_porosity, s.delta_fabric_index, s.conductivity, s.stress]);
        }
    }
    if !data.tracks.is_empty() {
        options.max_epochs = options.max_epochs.max(USUAL_EPOCHS);
        if !arguments.forms {
            law = ablation::increments(&data, &options).map_err(failed)?;
        }
        for line in &law {
            outln!();
            outln!(
                "law of the increments, {}",
                line.without.map_or("all".into(), |part| format!("without {part}"))
            );
            print_paths(&line.scores);
        }
        forms.extend(ablation::forms(&data, &options).map_err(failed)?);
        forms.iter().for_each(print_form);
    }
    if let Some(path) = &arguments.json {
        let text = serde_json::to_string_pretty(&json!({ "paper": paper, "increment": law, "forms": forms }))
            .map_err(|error| CliError::Message(format!("cannot write the scores: {error}")))?;
        write(path, (text + "\n").as_bytes())?;
    }
    Ok(())
}

fn print_form(form: &Form) {
    outln!();
    outln!(
        "{} form: {} numbers, trained in {:.0} s, {:.0} ns for an increment of a cell",
        form.name,
        form.numbers,
        form.training_seconds,
        form.nanoseconds
    );
    print_paths(&form.paths);
    for cycles in &form.cycles {
        outln!(
            "  {} closed cycles up to {:.0e}, many times: {:>5.1} % create energy, p changes by {:.2} %",
            cycles.cycles,
            cycles.amplitude,
            100.0 * cycles.creating,
            100.0 * cycles.drift
        );
    }
}

fn print<T>(line: &Line<T>, values: [f64; 4]) {
    let what = match line.without {
        None => format!("  all inputs, split by {}", if line.random_split { "sample" } else { "packing" }),
        Some(input) => format!("  without {input}"),
    };
    outln!("{what:<44} {}", values.map(|value| format!("{value:>7.4}")).join(" "));
}
