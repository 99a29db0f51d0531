//! How much of a case has to be computed: runs that compute less of it, and the accuracy that is lost.

use crate::jobs::execute::Outcome;
use crate::jobs::job::{Job, Part, SolverJob};
use crate::jobs::pool::{Asked, Records};
use crate::settings::Settings;
use msdd_dem_reference::compare::errors;
use msdd_dem_reference::packings::{CASES, Reference, temperature_range};
use msdd_dem_reference::series::{at, largest};
use msdd_dem_reference::solver::Run;
use serde::Serialize;

/// One way to compute a case: counts and cost of the run of the first packing, errors over all packings.
#[derive(Clone, Debug, Serialize)]
pub struct Saving {
    pub case: String,
    pub what: String,
    pub cells: u64,
    pub steps: u64,
    pub cell_steps: u64,
    /// Number of cell-steps in which the model was evaluated.
    pub cell_queries: u64,
    pub core_seconds: Option<f64>,
    /// Largest difference of T from the run that computes all, over time and probes [% of the range].
    pub change: Option<f64>,
    /// Largest error of T against DEM [% of the range].
    pub error: Option<f64>,
    pub outcome: String,
    pub message: String,
}

const ADAPTIVE: &str = "msddFoam { timeScheme secondOrder; temperatureTolerance 0.05; stateTolerance 0.5; }\n\
                        solvers { T { tolerance 1e-8; } }";

/// Names and jobs of the ways to compute a case; the first one computes all.
fn ways(case: &str) -> Vec<(&'static str, SolverJob)> {
    let all = || SolverJob::new(case, 0);
    let adaptive = || all().solution(ADAPTIVE).control("adjustTimeStep yes;");
    let meshed = |job: SolverJob, mesh, part| SolverJob { mesh, part, ..job };
    let mut ways = vec![
        ("all: 100x30 cells, steps of 10 ms, every cell asked", all()),
        ("asked again after a strain of 1e-3", all().grains("surrogate { smallestStrain 1e-3; }")),
        ("adaptive steps", adaptive()),
        ("adaptive, 50x15 cells", meshed(adaptive(), [50, 15], Part::Whole)),
        ("adaptive, 25x8 cells", meshed(adaptive(), [25, 8], Part::Whole)),
    ];
    if case.starts_with("HC") {
        ways.push(("adaptive, one-dimensional, 100x1", meshed(adaptive(), [100, 1], Part::Whole)));
    } else {
        ways.push(("adaptive, left half, 50x30", meshed(adaptive(), [50, 30], Part::Half)));
        ways.push(("adaptive, quarter, 50x15", meshed(adaptive(), [50, 15], Part::Quarter)));
        ways.push(("adaptive, quarter, 12x4", meshed(adaptive(), [12, 4], Part::Quarter)));
    }
    ways
}

fn cases(quick: bool) -> Vec<&'static str> {
    let all = CASES.iter().map(|case| case.0);
    if quick { vec!["H"] } else { all.collect() }
}

fn with_seed(job: &SolverJob, seed: u32) -> Job {
    Job::Solver(SolverJob { seed, ..job.clone() })
}

pub fn jobs(settings: &Settings) -> Vec<Asked> {
    let ways = cases(settings.quick).into_iter().flat_map(ways);
    ways.flat_map(|(_, job)| settings.seeds().iter().map(move |seed| (with_seed(&job, *seed), 1.0)))
        .map(|(job, guess)| Asked { job, guess })
        .collect()
}

/// Results of all ways to compute the cases.
pub fn savings(settings: &Settings, records: &Records, references: &[Reference]) -> Vec<Saving> {
    let mut list = Vec::new();
    for reference in references.iter().filter(|r| cases(settings.quick).contains(&r.case.as_str())) {
        let ways = ways(&reference.case);
        let Some((_, all)) = ways.first() else { continue };
        for (what, job) in &ways {
            list.push(saving(settings, records, reference, what, job, all));
        }
    }
    list
}

fn saving(
    settings: &Settings,
    records: &Records,
    reference: &Reference,
    what: &str,
    job: &SolverJob,
    all: &SolverJob,
) -> Saving {
    let seeds = settings.seeds();
    let runs_of = |job: &SolverJob| -> Vec<&Run> {
        let found = seeds.iter().filter_map(|seed| settings.record(records, &with_seed(job, *seed)));
        found.filter_map(|record| record.run.as_ref()).collect()
    };
    let (runs, whole) = (runs_of(job), runs_of(all));
    let first = settings.record(records, &with_seed(job, seeds[0]));
    let complete = runs.len() == seeds.len() && whole.len() == seeds.len();
    let changes: Vec<f64> =
        runs.iter().zip(&whole).map(|(run, whole)| change(&reference.times(), run, whole)).collect();
    let count = |of: fn(&Run) -> u64| runs.first().map_or(0, |run| of(run));
    Saving {
        case: reference.case.clone(),
        what: what.to_string(),
        cells: count(|run| run.cells),
        steps: count(|run| run.steps),
        cell_steps: count(|run| run.cell_steps),
        cell_queries: count(|run| run.cell_queries),
        core_seconds: first.filter(|r| r.outcome == Outcome::Done).map(|r| r.cpu_seconds),
        change: complete.then(|| 100.0 / temperature_range(&reference.case) * largest(&changes).abs()),
        error: errors(reference, &runs, false).map(|errors| errors.largest_temperature()),
        outcome: first.map_or("not run", |r| r.outcome.as_str()).to_string(),
        message: first.map_or(String::new(), |r| r.message.clone()),
    }
}

/// Largest difference of T between two runs at the probes [K], over the times after the first second, which coarse meshes do
/// not resolve.
fn change(times: &[f64], run: &Run, whole: &Run) -> f64 {
    let series = |run: &Run, p: usize| -> Vec<[f64; 2]> {
        run.temperature.iter().map(|row| [row[0], row[1 + p]]).collect()
    };
    let differences = (0..3).flat_map(|p| {
        let (a, b) = (series(run, p), series(whole, p));
        times.iter().filter(|t| **t >= 1.0).map(move |&t| at(&a, t) - at(&b, t)).collect::<Vec<_>>()
    });
    largest(&differences.collect::<Vec<_>>())
}
