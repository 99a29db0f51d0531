//! `msdd summary`: what the solver left in the case folders, as a table, as JSON and as a plot.

mod plot;
mod read;
mod table;

use crate::error::CliError;
use crate::files::write_atomically;
use clap::Args;
use read::{CaseResult, Model};
use serde::Serialize;
use std::collections::BTreeMap;
use std::path::PathBuf;

/// The cases, by folder, and how they are called: with a star, they do not expand.
const CASES: [(&str, &str); 6] =
    [("H", "H"), ("C", "C"), ("HC", "HC"), ("Hstar", "H*"), ("Cstar", "C*"), ("HCstar", "HC*")];

#[derive(Args)]
pub struct Arguments {
    /// Folder of the case folders H, C, HC, Hstar, Cstar, HCstar.
    #[arg(long, value_name = "DIR", default_value = "cases")]
    cases: PathBuf,
    /// JSON to write.
    #[arg(long, value_name = "FILE", default_value = "results/summary.json")]
    out: PathBuf,
    /// Plot of T at P2 to write (SVG).
    #[arg(long, value_name = "FILE", default_value = "results/temperature.svg")]
    plot: PathBuf,
}

#[derive(Serialize)]
struct Summary<'a> {
    cases: BTreeMap<&'static str, &'a CaseResult>,
    model: &'a Model,
}

/// A case and how it is called.
struct Named {
    folder: &'static str,
    name: &'static str,
    result: CaseResult,
}

pub fn run(arguments: &Arguments) -> Result<(), CliError> {
    let mut named = Vec::new();
    let mut models: Vec<(&str, Model)> = Vec::new();
    for (folder, name) in CASES {
        let (result, model) = read::case(&arguments.cases.join(folder))?;
        named.push(Named { folder, name, result });
        models.push((folder, model));
    }
    let (first, model) = &models[0];
    if let Some((other, differing)) = models.iter().find(|(_, m)| m.hash != model.hash) {
        return Err(CliError::Message(format!(
            "cases {first} and {other} were run with different models ({} and {}): run them again",
            model.hash, differing.hash
        )));
    }
    let cases = named.iter().map(|case| (case.folder, &case.result)).collect();
    let json = serde_json::to_string_pretty(&Summary { cases, model })
        .map_err(|error| CliError::Message(error.to_string()))?;
    write_atomically(&arguments.out, json.as_bytes())?;
    write_atomically(&arguments.plot, plot::temperature(&named)?.as_bytes())?;
    print!("{}", table::text(&named));
    println!("model {} ({})", model.hash, model.source);
    println!("figures: {}   plot: {}", arguments.out.display(), arguments.plot.display());
    Ok(())
}
