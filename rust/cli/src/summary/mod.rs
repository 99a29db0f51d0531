//! `msdd summary`: what the solver left in the case folders, as a table, as JSON and as a plot.

#[cfg(test)]
mod fixture;
mod plot;
mod read;
mod table;

use crate::error::CliError;
use clap::Args;
use msdd_files::write;
use read::{CaseResult, Model, Named};
use serde::Serialize;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

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

/// Reads, checks and reports. All cases are read before anything is written.
pub fn run(arguments: &Arguments) -> Result<(), CliError> {
    let (named, model) = read_all(&arguments.cases)?;
    let cases = named.iter().map(|case| (case.folder, &case.result)).collect();
    let json = serde_json::to_string_pretty(&Summary { cases, model: &model })
        .map_err(|error| CliError::Message(error.to_string()))?;
    write(&arguments.out, json.as_bytes())?;
    write(&arguments.plot, plot::temperature(&named)?.as_bytes())?;
    out!("{}", table::text(&named));
    outln!("model {} ({})", model.hash, model.source);
    outln!("figures: {}   plot: {}", arguments.out.display(), arguments.plot.display());
    Ok(())
}

/// The six cases in the folder `cases`, and the one model they were run with: figures of different models are no comparison.
fn read_all(cases: &Path) -> Result<(Vec<Named>, Model), CliError> {
    let mut named = Vec::new();
    let mut models: Vec<(&str, Model)> = Vec::new();
    for (folder, name) in CASES {
        let (result, model) = read::case(&cases.join(folder))?;
        named.push(Named { folder, name, result });
        models.push((folder, model));
    }
    let (first, model) = models.swap_remove(0);
    if let Some((other, differing)) = models.iter().find(|(_, m)| m.hash != model.hash) {
        return Err(CliError::Message(format!(
            "cases {first} and {other} were run with different models ({} and {}): run them again",
            model.hash, differing.hash
        )));
    }
    Ok((named, model))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn six_cases_of_one_model_are_written_as_table_json_and_plot() {
        let folder = fixture::Cases::new("good");
        let arguments = Arguments {
            cases: folder.path().to_path_buf(),
            out: folder.path().join("results/summary.json"),
            plot: folder.path().join("results/temperature.svg"),
        };
        run(&arguments).unwrap();
        let json: serde_json::Value =
            serde_json::from_str(&std::fs::read_to_string(&arguments.out).unwrap()).unwrap();
        assert_eq!(json["cases"].as_object().unwrap().len(), CASES.len());
        assert_eq!(json["cases"]["HCstar"]["probes"]["P2"][1], serde_json::json!([5.0, 80.0]));
        assert_eq!(json["cases"]["H"]["final"]["pressure"], 5000.0);
        assert!(json["cases"]["H"]["final"].get("time").is_none());
        assert_eq!(json["model"]["hash"], "abc");
        assert!(std::fs::read_to_string(&arguments.plot).unwrap().ends_with("</svg>\n"));
    }

    #[test]
    fn cases_of_different_models_are_refused_by_name() {
        let folder = fixture::Cases::new("models");
        folder.write_summary("Cstar", &fixture::SOLVER.replace("abc", "def"));
        let error = read_all(folder.path()).err().unwrap().to_string();
        assert!(error.contains("cases H and Cstar were run with different models (abc and def)"), "{error}");
    }
}
