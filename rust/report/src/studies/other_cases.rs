//! Two cases that were not used to choose any parameter, run as shipped and compared with discs of other packings: another
//! geometry (`corner`), another material (`material`). Their packings also serve to compare two ways to make a stress
//! dimensionless.

use crate::jobs::execute::Outcome;
use crate::jobs::job::{Job, Part, SolverJob};
use crate::jobs::pool::{Asked, Records};
use crate::settings::Settings;
use crate::{ReportError, read_text};
use msdd_dem_reference::compare::temperature_errors;
use msdd_dem_reference::packings::Reference;
use msdd_dem_reference::results::Results;
use msdd_dem_reference::solver::Run;
use serde::Serialize;
use std::collections::BTreeMap;
use std::path::Path;

/// A shipped case: folder, result of the discs, range of T [K], mesh.
struct Other {
    case: &'static str,
    discs: &'static str,
    range: f64,
    mesh: [usize; 2],
}

const OTHERS: [Other; 2] = [
    Other { case: "corner", discs: "corner_seed11", range: 50.0, mesh: [60, 60] },
    Other { case: "material", discs: "material_seed12", range: 100.0, mesh: [50, 15] },
];
/// Name of each way to run a case, and its keys.
pub const WAYS: [(&str, &str); 2] = [("grains move", ""), ("grains stay", "mechanics none;")];

/// One way to run such a case. Signed: solver minus DEM.
#[derive(Clone, Debug, Serialize)]
pub struct OtherCase {
    pub case: String,
    pub what: String,
    /// Errors of T at P1, P2, P3, the largest over time [% of the range].
    pub temperature: Option<[f64; 3]>,
    /// Mean pressure at the end \[Pa\]: solver, discs (whole box).
    pub pressure: Option<[f64; 2]>,
    pub outcome: String,
}

/// Pressure of the packed box of a case, made dimensionless in two ways.
#[derive(Clone, Debug, Serialize)]
pub struct Scaling {
    pub case: String,
    pub young_modulus: f64,
    pub mean_radius: f64,
    pub porosity: f64,
    /// Pressure of the packed box \[Pa\].
    pub pressure: f64,
    /// p/E, as in the paper.
    pub over_modulus: f64,
    /// p ℓ/(E r̄), ℓ = 1 m.
    pub reduced: f64,
}

/// Results of the comparison, and the time series for the figure by (case, way).
#[derive(Default)]
pub struct OtherCases {
    pub rows: Vec<OtherCase>,
    pub discs: Vec<Results>,
    pub runs: BTreeMap<(String, String), Run>,
    pub scalings: Vec<Scaling>,
}

fn job(other: &Other, keys: &str) -> SolverJob {
    // As shipped, also with the case's own time steps
    let job = SolverJob { append: BTreeMap::new(), ..SolverJob::new(other.case, 0) };
    let job = SolverJob { part: Part::Shipped, mesh: other.mesh, ..job };
    if keys.is_empty() { job } else { job.grains(keys) }
}

pub fn jobs() -> Vec<Asked> {
    let all = OTHERS.iter().flat_map(|other| WAYS.map(|(_, keys)| job(other, keys)));
    all.map(|job| Asked { job: job.into(), guess: 2.0 }).collect()
}

/// # Errors
/// [`ReportError::Read`] for results of the discs or keys of a case that are missing.
pub fn read(
    settings: &Settings,
    records: &Records,
    references: &[Reference],
) -> Result<OtherCases, ReportError> {
    let checkout = &settings.place.checkout;
    let mut found = OtherCases::default();
    for other in &OTHERS {
        let file = checkout.join(format!("cases/reference/results/{}.json", other.discs));
        let discs = Results::read(&file)?;
        for (what, keys) in WAYS {
            let Some(record) = settings.record(records, &Job::Solver(job(other, keys))) else { continue };
            let run = record.run.as_ref().filter(|_| record.outcome == Outcome::Done);
            let end = discs.series.column("pressure").and_then(|p| p.last().copied());
            found.rows.push(OtherCase {
                case: other.case.to_string(),
                what: what.to_string(),
                temperature: run.and_then(|run| {
                    let rows: Vec<Vec<f64>> = run.temperature.iter().map(|row| row.to_vec()).collect();
                    temperature_errors(&rows, &discs, other.range).ok()?.try_into().ok()
                }),
                pressure: run.zip(end).map(|(run, end)| [run.end_pressure, end]),
                outcome: record.outcome.as_str().to_string(),
            });
            if let Some(run) = run {
                found.runs.insert((other.case.to_string(), what.to_string()), run.clone());
            }
        }
        found.discs.push(discs);
    }
    let first = references.iter().find(|r| r.case == "H").and_then(|r| r.results.first());
    for discs in first.into_iter().chain(&found.discs) {
        found.scalings.push(scaling(checkout, discs)?);
    }
    Ok(found)
}

fn scaling(checkout: &Path, discs: &Results) -> Result<Scaling, ReportError> {
    let [modulus, radius] = ["youngModulus", "meanRadius"].map(|key| grain_value(checkout, &discs.case, key));
    let (modulus, radius, pressure) = (modulus?, radius?, discs.model.pressure);
    Ok(Scaling {
        case: discs.case.clone(),
        young_modulus: modulus,
        mean_radius: radius,
        porosity: discs.model.porosity,
        pressure,
        over_modulus: pressure / modulus,
        reduced: pressure / (modulus * radius),
    })
}

/// A number of `constant/granularProperties`: that of the case, else that of the common file.
pub(crate) fn grain_value(checkout: &Path, case: &str, key: &str) -> Result<f64, ReportError> {
    let own = checkout.join(format!("cases/{case}/constant/granularProperties"));
    let common = checkout.join("cases/common/granularProperties");
    for file in [&own, &common] {
        let text = read_text(file)?;
        let mut lines =
            text.lines().map(str::trim).filter_map(|line| line.strip_prefix(key)?.strip_suffix(';'));
        if let Some(value) = lines.next_back() {
            return value.trim().parse().map_err(|_| ReportError::Read {
                file: file.clone(),
                problem: format!("{key} = {value} is no number"),
            });
        }
    }
    Err(ReportError::Read {
        file: own,
        problem: format!("{key} is missing, here and in {}", common.display()),
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_reduced_pressure_is_that_of_the_grains_and_the_other_is_not() {
        let checkout = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
        let [first, other] = ["H_seed1", "material_seed12"].map(|name| {
            let discs =
                Results::read(&checkout.join(format!("cases/reference/results/{name}.json"))).unwrap();
            scaling(&checkout, &discs).unwrap()
        });
        assert_eq!((first.young_modulus, other.young_modulus, other.mean_radius), (1e7, 4e7, 2.5e-3));
        assert!((other.reduced / first.reduced - 1.0).abs() < 0.05, "{first:?} {other:?}");
        assert!(other.over_modulus / first.over_modulus < 0.6);
    }
}
