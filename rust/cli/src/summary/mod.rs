//! `msdd summary`: the solver's results in the case folders compared with DEM of the same cases, as a table, as JSON
//! and as a plot.

mod discs;
#[cfg(test)]
mod fixture;
mod plot;
mod read;
mod table;

use crate::error::CliError;
use crate::output::write_json;
use clap::Args;
use discs::{Comparison, Discs, Named};
use msdd_dem_reference::packings::CASES;
use msdd_files::write;
use read::{CaseResult, Model};
use serde::Serialize;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

#[derive(Args)]
pub struct Arguments {
    /// Folder with the case folders H, C, HC, Hstar, Cstar, HCstar after runs with the paper's scheme: grains stay in their cells.
    #[arg(long, value_name = "DIR", default_value = "cases")]
    cases: PathBuf,
    /// Folder with the same cases after runs with grains that move (`mechanics equilibrium`); without it these are left out.
    #[arg(long, value_name = "DIR")]
    moving: Option<PathBuf>,
    /// Folder of the results by DEM.
    #[arg(long, value_name = "DIR", default_value = "cases/reference")]
    reference: PathBuf,
    /// JSON file to write.
    #[arg(long, value_name = "FILE", default_value = "results/summary.json")]
    out: PathBuf,
    /// SVG file to write: T at the three probes in all cases.
    #[arg(long, value_name = "FILE", default_value = "results/temperature.svg")]
    plot: PathBuf,
}

#[derive(Serialize)]
struct Summary<'a> {
    /// With the paper's scheme.
    cases: BTreeMap<&'static str, &'a CaseResult>,
    /// With grains that move.
    moving: BTreeMap<&'static str, &'a CaseResult>,
    comparison: BTreeMap<&'static str, Comparison<'a>>,
    model: &'a Model,
}

/// Reads, checks and reports the cases. All of them are read before anything is written.
pub fn run(arguments: &Arguments) -> Result<(), CliError> {
    let (named, model) = read_all(&arguments.cases, arguments.moving.as_deref(), &arguments.reference)?;
    let summary = Summary {
        cases: named.iter().map(|case| (case.folder, &case.stay)).collect(),
        moving: named.iter().filter_map(|case| Some((case.folder, case.moving.as_ref()?))).collect(),
        comparison: named.iter().map(|case| (case.folder, case.comparison())).collect(),
        model: &model,
    };
    write_json(&arguments.out, &summary)?;
    write(&arguments.plot, plot::temperature(&named)?.as_bytes())?;
    out!("{}", table::text(&named));
    outln!("model: {}, SHA-256 {}", model.source, model.hash);
    outln!("numbers: {}   plot: {}", arguments.out.display(), arguments.plot.display());
    Ok(())
}

/// The six cases in the folder `cases` and, with grains that move, in `moving`, and the model they were run with. Runs with
/// different models are refused, because their results cannot be compared.
fn read_all(cases: &Path, moving: Option<&Path>, reference: &Path) -> Result<(Vec<Named>, Model), CliError> {
    let mut named = Vec::new();
    let mut models: Vec<(PathBuf, Model)> = Vec::new();
    for (folder, name) in CASES {
        let mut run = |parent: &Path| -> Result<CaseResult, CliError> {
            let path = parent.join(folder);
            let result = read::case(&path)?;
            models.push((path, result.model.clone()));
            Ok(result)
        };
        let stay = run(cases)?;
        let moving = moving.map(run).transpose()?;
        named.push(Named { folder, name, stay, moving, discs: Discs::read(reference, folder)? });
    }
    let (first, model) = models.swap_remove(0);
    if let Some((other, differing)) = models.iter().find(|(_, m)| m.hash != model.hash) {
        return Err(CliError::Message(format!(
            "cases {} and {} were run with different models ({} and {}): run them again",
            first.display(),
            other.display(),
            model.hash,
            differing.hash
        )));
    }
    Ok((named, model))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn arguments(folder: &fixture::Cases, moving: bool) -> Arguments {
        Arguments {
            cases: folder.path().to_path_buf(),
            moving: moving.then(|| folder.path().to_path_buf()),
            reference: fixture::reference(),
            out: folder.path().join("results/summary.json"),
            plot: folder.path().join("results/temperature.svg"),
        }
    }

    #[test]
    fn six_cases_of_one_model_are_written_as_table_json_and_plot() {
        let folder = fixture::Cases::new("good");
        let arguments = arguments(&folder, true);
        run(&arguments).unwrap();
        let json: serde_json::Value =
            serde_json::from_str(&std::fs::read_to_string(&arguments.out).unwrap()).unwrap();
        assert_eq!(json["cases"].as_object().unwrap().len(), CASES.len());
        assert_eq!(json["moving"].as_object().unwrap().len(), CASES.len());
        assert_eq!(json["cases"]["HCstar"]["probes"]["P2"][1], serde_json::json!([5.0, 80.0]));
        assert_eq!(json["cases"]["H"]["final"]["pressure"], 5000.0);
        assert!(json["cases"]["H"]["final"].get("time").is_none());
        let compared = &json["comparison"]["H"];
        assert_eq!(compared["discs"]["temperature"]["P1"].as_array().unwrap().len(), 201);
        assert!(compared["grains_move"]["temperature"][0].is_f64());
        assert_eq!(json["model"]["hash"], "abc");
        assert!(std::fs::read_to_string(&arguments.plot).unwrap().ends_with("</svg>\n"));
    }

    #[test]
    fn cases_of_different_models_are_refused_by_name() {
        let folder = fixture::Cases::new("models");
        folder.write_summary("Cstar", &fixture::SOLVER.replace("abc", "def"));
        let error = run(&arguments(&folder, false)).err().unwrap().to_string();
        assert!(
            error.contains("H and ") && error.contains("Cstar were run with different models"),
            "{error}"
        );
        assert!(error.contains("(abc and def)"), "{error}");
    }
}
