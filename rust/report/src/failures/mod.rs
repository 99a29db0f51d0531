//! The failure map: where methods lose accuracy or fail, predicted and measured, and what the programs do there.
//!
//! | module | what |
//! |---|---|
//! | [`rows`] | configurations outside of what a method can do, and whether the program refuses, ends, cuts or reports them |
//! | [`elements`] | DEM: time steps, strain rates, limits of equilibrium, loss of contacts |
//! | [`solver`] | long time steps, contrasts of conductivity, slanted cells |
//! | [`cycles`] | thermal cycles |
//! | [`drift`] | models when a strain is divided into many increments |

pub mod cycles;
pub mod drift;
pub mod elements;
pub mod rows;
pub mod solver;

use crate::ReportError;
use crate::jobs::execute::Outcome;
use crate::jobs::job::Job;
use crate::jobs::pool::{Asked, Records};
use crate::settings::Settings;
use serde::Serialize;
use serde_json::Value;

#[derive(Clone, Debug, Default, Serialize)]
pub struct Failures {
    pub rows: Vec<rows::Row>,
    /// As [`elements::stability`] and [`elements::limits`] write them.
    pub stable_steps: Vec<Value>,
    pub limits: Option<Value>,
    pub coupling: Vec<solver::Coupling>,
    pub contrast: Vec<solver::Contrast>,
    pub slant: Vec<solver::Slant>,
    pub cycles: Vec<cycles::Cycles>,
    pub drift: Vec<drift::Drift>,
}

/// # Errors
/// As [`rows::edges`].
pub fn jobs(quick: bool) -> Result<Vec<Asked>, ReportError> {
    let mut jobs: Vec<Job> = rows::edges(quick)?.iter().map(rows::Edge::job).collect();
    jobs.push(elements::stability(quick));
    jobs.push(elements::limits(quick));
    jobs.extend(solver::jobs(quick));
    if !quick {
        jobs.push(drift::score());
        jobs.extend(cycles::jobs());
    }
    Ok(jobs.into_iter().map(|job| Asked { guess: 2.0, job }).collect())
}

/// Makes the failure map from the records of the jobs.
///
/// # Errors
/// As [`rows::edges`].
pub fn read(settings: &Settings, records: &Records) -> Result<Failures, ReportError> {
    let done =
        |job: &Job| settings.record(records, job).filter(|record| record.outcome == Outcome::Done).cloned();
    Ok(Failures {
        rows: rows::read(settings, records)?,
        stable_steps: done(&elements::stability(settings.quick))
            .and_then(|r| serde_json::from_str(&r.printed).ok())
            .unwrap_or_default(),
        limits: done(&elements::limits(settings.quick))
            .and_then(|r| serde_json::from_str(r.file.as_deref()?).ok()),
        coupling: solver::coupling(settings, records),
        contrast: solver::contrast(settings, records),
        slant: solver::slant(settings, records),
        cycles: if settings.quick { Vec::new() } else { cycles::read(settings, records) },
        drift: done(&drift::score()).and_then(|r| r.file.as_deref().map(drift::drift)).unwrap_or_default(),
    })
}
