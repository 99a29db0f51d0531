//! Runs of the validated configurations that write additional data for figures: walls, sub-regions over time, the initial state.

use crate::ReportError;
use crate::jobs::execute::Outcome;
use crate::jobs::job::{Job, SolverJob};
use crate::jobs::pool::{Asked, Records};
use crate::plan::{self, CHARTED, Configuration, FAMILIES};
use crate::settings::Settings;
use crate::studies::other_cases::grain_value;
use msdd_dem_reference::solver::Run;
use std::collections::BTreeMap;

/// Function object that writes time, mean pressure, and for each wall mean pressure and normal stress \[Pa\] in the cells at it.
pub const WALLS: &str = "watchWalls";
/// Columns of the normal stress at left, right, bottom and top in the rows of [`WALLS`].
pub const WALL_COLUMNS: [usize; 4] = [3, 5, 7, 9];
/// Function object that writes sub-regions at several times: time, x and y index, [`msdd_dem_reference::solver::COLUMNS`].
pub const REGIONS: &str = "watchRegions";

/// The case from which the initial state is read: its grains do not expand, so their state never changes.
const START: &str = "Hstar";

/// Runs of all packings by (case, configuration), and the initial state by configuration.
#[derive(Default)]
pub struct Details {
    pub watched: BTreeMap<(String, String), Vec<Run>>,
    pub start: BTreeMap<String, Vec<Run>>,
    /// E \[Pa\], r̄ \[m\] and α [1/K] of the grains in these cases.
    pub grains: [f64; 3],
}

fn watched_job(configuration: &Configuration, case: &str, seed: u32) -> SolverJob {
    let every = |seconds: f64| {
        format!("libs (\"libgranularFunctionObjects.so\"); writeControl runTime; writeInterval {seconds};")
    };
    configuration.job(case, seed).control(&format!(
        "functions\n{{\n    {WALLS} {{ type wallPressure; {} }}\n    {REGIONS} {{ type subRegions; windows (10 3); {} }}\n}}",
        every(0.5),
        every(1.0)
    ))
}

fn start_job(configuration: &Configuration, seed: u32) -> SolverJob {
    // One step
    SolverJob { end: 0.1, ..configuration.job(START, seed).control("deltaT 0.1;") }
}

/// The configuration with grains that move, for stresses at the walls and states over time.
fn watched(quick: bool) -> impl Iterator<Item = Configuration> {
    plan::validated(quick).into_iter().filter(|c| c.family == FAMILIES[1])
}

/// The configurations with the law and with the paper's network, whose initial conductivities differ.
fn started(quick: bool) -> impl Iterator<Item = Configuration> {
    plan::validated(quick).into_iter().filter(|c| [FAMILIES[0], FAMILIES[2]].contains(&c.family.as_str()))
}

pub fn jobs(settings: &Settings) -> Vec<Asked> {
    let mut jobs = Vec::new();
    for seed in settings.seeds() {
        for configuration in watched(settings.quick) {
            for case in CHARTED {
                let job = Job::Solver(watched_job(&configuration, case, *seed));
                jobs.push(Asked { job, guess: configuration.guess });
            }
        }
        for configuration in started(settings.quick) {
            jobs.push(Asked { job: Job::Solver(start_job(&configuration, *seed)), guess: 0.5 });
        }
    }
    jobs
}

/// Reads the data of all packings for which there are records.
///
/// # Errors
/// [`ReportError::Read`] for the grains of the cases.
pub fn read(settings: &Settings, records: &Records) -> Result<Details, ReportError> {
    let all = |job: &dyn Fn(u32) -> SolverJob| -> Option<Vec<Run>> {
        let run = |seed: &u32| {
            let record = settings.record(records, &Job::Solver(job(*seed)))?;
            record.run.clone().filter(|_| record.outcome == Outcome::Done)
        };
        settings.seeds().iter().map(run).collect()
    };
    let value = |key: &str| grain_value(&settings.place.checkout, CHARTED[0], key);
    let grains = [value("youngModulus")?, value("meanRadius")?, value("thermalExpansion")?];
    let mut details = Details { grains, ..Details::default() };
    for configuration in watched(settings.quick) {
        for case in CHARTED {
            if let Some(runs) = all(&|seed| watched_job(&configuration, case, seed)) {
                details.watched.insert((case.to_string(), configuration.name.clone()), runs);
            }
        }
    }
    for configuration in started(settings.quick) {
        if let Some(runs) = all(&|seed| start_job(&configuration, seed)) {
            details.start.insert(configuration.name.clone(), runs);
        }
    }
    Ok(details)
}
