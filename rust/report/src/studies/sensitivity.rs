//! Influence of the parameters of the mechanics on the results: each is changed by more than its uncertainty in the database.

use crate::jobs::execute::Outcome;
use crate::jobs::job::{Job, SolverJob};
use crate::jobs::pool::{Asked, Records};
use crate::plan::{self, CHARTED, FAMILIES};
use crate::settings::Settings;
use msdd_dem_reference::compare::errors;
use msdd_dem_reference::packings::Reference;
use serde::Serialize;

/// Seed of the packing that is used.
const PACKING: usize = 1;

/// One change in one case, with the errors against the discs of the same packing.
#[derive(Clone, Debug, Serialize)]
pub struct Sensitivity {
    pub case: String,
    pub what: String,
    /// Error of T, the largest over time and probes [% of the range].
    pub temperature: Option<f64>,
    /// Error of the mean pressure against the discs in the inner region [% of the paper's range].
    pub pressure: Option<f64>,
    /// Largest difference over largest displacement along x [%]; for HC only, because the grains of the other cases hardly move
    /// along x.
    pub displacement: Option<f64>,
    pub outcome: String,
}

/// Name and keys of each change; the first is the case as shipped.
fn changes() -> Vec<(&'static str, String)> {
    let keys = |text: &str| format!("equilibriumCoeffs {{ {text} }}");
    let walls = |text: &str| keys(&format!("walls {{ \"left|right|bottom|top\" {{ {text} }} }}"));
    vec![
        ("as shipped", String::new()),
        ("wall friction 0.25", walls("friction 0.25;")),
        ("wall friction 0.55", walls("friction 0.55;")),
        ("no stronger grains next to walls", walls("layerStrength 1;")),
        ("layers next to walls half as wide", walls("layer 0.0325;")),
        ("walls that discs do not press into", keys("wallCompliance 0;")),
        ("walls that they press into twice as far", keys("wallCompliance 2.8;")),
    ]
}

fn job(case: &str, keys: &str, quick: bool) -> Option<SolverJob> {
    let configuration = plan::validated(quick).into_iter().find(|c| c.family == FAMILIES[1])?;
    let job = configuration.job(case, PACKING as u32);
    Some(if keys.is_empty() { job } else { job.grains(keys) })
}

fn cases(quick: bool) -> &'static [&'static str] {
    if quick { &CHARTED[2..] } else { &CHARTED }
}

pub fn jobs(settings: &Settings) -> Vec<Asked> {
    let mut jobs = Vec::new();
    for case in cases(settings.quick) {
        for (_, keys) in changes() {
            let job = job(case, &keys, settings.quick);
            jobs.extend(
                job.map(|job| Asked { job: job.into(), guess: if settings.quick { 2.0 } else { 6.0 } }),
            );
        }
    }
    jobs
}

pub fn read(settings: &Settings, records: &Records, references: &[Reference]) -> Vec<Sensitivity> {
    let mut list = Vec::new();
    for reference in references.iter().filter(|r| cases(settings.quick).contains(&r.case.as_str())) {
        for (what, keys) in changes() {
            let job = job(&reference.case, &keys, settings.quick).map(Job::Solver);
            let Some(record) = job.and_then(|job| settings.record(records, &job)) else { continue };
            let run = record.run.as_ref().filter(|_| record.outcome == Outcome::Done);
            let found = run.and_then(|run| errors(&reference.first(PACKING), &[run], false));
            list.push(Sensitivity {
                case: reference.case.clone(),
                what: what.to_string(),
                temperature: found.as_ref().map(|e| e.largest_temperature()),
                pressure: found.as_ref().and_then(|e| e.pressure_inner.map(f64::abs)),
                displacement: found.as_ref().and_then(|e| e.displacement).filter(|_| reference.case == "HC"),
                outcome: record.outcome.as_str().to_string(),
            });
        }
    }
    list
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::BTreeSet;

    #[test]
    fn every_change_is_another_job() {
        for quick in [true, false] {
            let jobs: BTreeSet<String> =
                changes().iter().map(|(_, keys)| format!("{:?}", job("HC", keys, quick).unwrap())).collect();
            assert_eq!(jobs.len(), changes().len());
        }
    }
}
