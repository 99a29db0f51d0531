//! Reads the solver's results in one case folder.

use crate::error::CliError;
use msdd_case::tables::{self, Table};
use msdd_files::read_text;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use std::path::Path;

/// Names of the probes, in the order of `cases/common/controlDict`.
pub const PROBES: [&str; 3] = ["P1", "P2", "P3"];

/// (t [s], T [K]) at each probe, by name.
pub type Probes = BTreeMap<&'static str, Vec<(f64, f64)>>;

/// One case.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct CaseResult {
    pub wall_seconds: f64,
    /// Processor time of all processes [s]; absent in files of an older solver.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub cpu_seconds: Option<f64>,
    pub steps: u64,
    pub queries: u64,
    pub clamped_queries: u64,
    /// Absent in files of an older solver.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub mechanics: Option<Mechanics>,
    #[serde(skip_deserializing)]
    pub probes: Probes,
    #[serde(rename = "final")]
    pub end: End,
    #[serde(skip_serializing)]
    pub model: Model,
}

/// Effort and accuracy of the solution for equilibrium of the stress.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Mechanics {
    /// "none" or "equilibrium".
    pub kind: String,
    /// Time steps in which equilibrium was solved for.
    pub solves: u64,
    /// Iterations of Newton's method, and of the solver of its linear equations.
    pub iterations: u64,
    pub linear_iterations: u64,
    /// Time steps whose strain had to be applied in parts, and time steps that ended above the tolerance of the residual.
    pub cut_steps: u64,
    pub unconverged_steps: u64,
    /// Largest residual at the end of a time step [Pa], and largest displacement at the end of the run [m].
    pub residual: f64,
    pub displacement: f64,
}

/// Means over the volume at the end of a run. K in W/(m K), stresses in Pa, compression positive.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct End {
    #[serde(skip_serializing)]
    pub time: f64,
    pub porosity: f64,
    pub fabric: f64,
    pub conductivity_xx: f64,
    pub conductivity_yy: f64,
    pub stress_xx: f64,
    pub stress_yy: f64,
    pub pressure: f64,
}

/// The surrogate that a case was run with.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Model {
    pub source: String,
    pub hash: String,
    pub library_version: String,
}

/// Reads the results of the case in `folder`.
pub fn case(folder: &Path) -> Result<CaseResult, CliError> {
    let path = folder.join("postProcessing/msddFoam/summary.json");
    if !path.exists() {
        let text = format!("{} is missing: run {}/Allrun first", path.display(), folder.display());
        return Err(CliError::Message(text));
    }
    let mut result = solver_summary(&read_text(&path)?)
        .map_err(|text| CliError::Message(format!("{}: {text}", path.display())))?;
    // The points of OpenFOAM's own function object `probes` move with the mesh, that is with the grains; those of spaceProbes
    // stay where they are.
    let table = tables::read(folder, "probes", None)?;
    result.probes = probes(&table)?;
    Ok(result)
}

/// Parses the solver's summary, which has no probes. JSON has no NaN, so the summary of a run that ended with one does not parse; the error then
/// shows the line with the NaN.
fn solver_summary(text: &str) -> Result<CaseResult, String> {
    serde_json::from_str(text).map_err(|error| {
        let line = text.lines().nth(error.line().saturating_sub(1)).unwrap_or_default().trim();
        let number = line.rsplit(':').next().unwrap_or_default().trim().trim_end_matches(',');
        match number.parse::<f64>() {
            Ok(value) if !value.is_finite() => format!("'{line}' is not a finite number"),
            _ => format!("{error}, in '{line}'"),
        }
    })
}

/// OpenFOAM writes the finite number -VGREAT = -1e300 for a probe that lies in no cell; values below this limit are that.
const OUTSIDE: f64 = -1e299;

/// Rows of OpenFOAM's probes: time, then one value a probe.
fn probes(table: &Table) -> Result<Probes, CliError> {
    let problem = |text: String| CliError::Message(format!("{}: {text}", table.file.display()));
    let rows = table.numbers()?;
    for (row, line) in rows.iter().zip(&table.rows) {
        if row.len() != 1 + PROBES.len() {
            return Err(problem(format!("'{line}', expected a time and {} finite numbers", PROBES.len())));
        }
        if row.iter().any(|&value| value < OUTSIDE) {
            return Err(problem(format!("'{line}': a probe lies outside the mesh")));
        }
    }
    if rows.is_empty() {
        return Err(problem("holds no values".to_string()));
    }
    let column = |k: usize| rows.iter().map(|row| (row[0], row[k + 1])).collect();
    Ok(PROBES.into_iter().enumerate().map(|(k, name)| (name, column(k))).collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn probes_of(text: &str) -> Result<Probes, CliError> {
        let rows = text.lines().map(str::to_string).collect();
        probes(&Table { file: "T".into(), head: Vec::new(), rows })
    }

    #[test]
    fn probes_are_read_by_column() {
        let table = probes_of("  0.1  50 51 52\n  0.2 60 61 62\n").unwrap();
        assert_eq!(table["P1"], [(0.1, 50.0), (0.2, 60.0)]);
        assert_eq!(table["P3"], [(0.1, 52.0), (0.2, 62.0)]);
    }

    #[test]
    fn bad_probes_are_refused_with_the_line() {
        let refusal = |text: &str| probes_of(text).unwrap_err().to_string();
        assert!(refusal("").contains("no values"));
        assert!(refusal("0.1 50 nan 52\n").ends_with("'nan' in '0.1 50 nan 52'"));
        assert!(refusal("0.1 50 51 52\n0.2 60\n").starts_with("T: '0.2 60', expected a time and 3"));
        assert!(refusal("0.1 50 x 51 52\n").contains("'x' in "));
        assert!(refusal("0.1 50 -1e+300 52\n").contains("outside the mesh"));
    }

    #[test]
    fn a_summary_with_a_number_that_is_not_finite_is_refused_with_its_line() {
        let good = crate::summary::fixture::SOLVER;
        assert_eq!(solver_summary(good).unwrap().end.pressure, 5000.0);
        for (from, to) in [("5000", "-nan"), ("5000", "inf"), ("0.08,", "nan,")] {
            let error = solver_summary(&good.replace(from, to)).err().unwrap();
            assert!(error.contains(to) && error.contains("is not a finite number"), "{error}");
        }
        let error = solver_summary(&good.replace("\"pressure\": 5000", "\"pressure\": true")).err().unwrap();
        assert!(error.contains("invalid type") && error.contains("true"), "{error}");
    }

    #[test]
    fn a_case_without_results_is_named() {
        let error = case(Path::new("cases/none")).unwrap_err().to_string();
        assert!(error.contains("cases/none/postProcessing/msddFoam/summary.json is missing"), "{error}");
    }
}
