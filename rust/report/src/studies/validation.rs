//! Validation: configurations in all cases against DEM of the same packings.

use crate::jobs::execute::{Outcome, Record};
use crate::jobs::pool::Records;
use crate::plan;
use crate::settings::Settings;
use msdd_dem_reference::compare::{Errors, errors};
use msdd_dem_reference::packings::{Reference, temperature_range};
use msdd_dem_reference::series::statistics;
use msdd_dem_reference::solver::Run;
use serde::Serialize;
use std::collections::BTreeMap;

/// Errors of one configuration in one case against the reference.
#[derive(Clone, Debug, Serialize)]
pub struct Validated {
    pub case: String,
    pub configuration: String,
    pub family: String,
    pub outcome: String,
    pub message: String,
    pub errors: Option<Errors>,
}

/// Runs of a configuration, if those of all `packings` were completed; else the outcome and message of one that was not.
pub fn complete<'a>(records: &[&'a Record], packings: usize) -> Result<Vec<&'a Run>, (Outcome, String)> {
    let runs: Vec<&Run> = records.iter().filter_map(|record| record.run.as_ref()).collect();
    match records.iter().find(|record| record.outcome != Outcome::Done) {
        Some(record) => Err((record.outcome, record.message.clone())),
        None if runs.len() < packings => {
            Err((Outcome::NotRun, format!("{} of {packings} packings so far", runs.len())))
        }
        None => Ok(runs),
    }
}

/// Errors of all validated configurations; runs that were completed are added to `kept`.
pub fn validation(
    settings: &Settings,
    records: &Records,
    references: &[Reference],
    kept: &mut BTreeMap<(String, String), Vec<Run>>,
) -> Vec<Validated> {
    let mut validated = Vec::new();
    for reference in references {
        for configuration in plan::validated(settings.quick) {
            if !configuration.cases.contains(&reference.case) {
                continue;
            }
            let found = complete(
                &settings.records(records, &configuration, &reference.case),
                settings.packings(&configuration),
            );
            let (outcome, message) = match &found {
                Ok(_) => (Outcome::Done, String::new()),
                Err((outcome, message)) => (*outcome, message.clone()),
            };
            let errors = found
                .as_ref()
                .ok()
                .and_then(|runs| errors(&reference.first(runs.len()), runs, configuration.affine));
            if let Ok(runs) = found {
                let runs = runs.into_iter().cloned().collect();
                kept.insert((reference.case.clone(), configuration.name.clone()), runs);
            }
            validated.push(Validated {
                case: reference.case.clone(),
                configuration: configuration.name.clone(),
                family: configuration.family.clone(),
                outcome: outcome.as_str().to_string(),
                message,
                errors,
            });
        }
    }
    validated
}

/// Standard deviation of T between packings, the largest over time and probes [% of the range].
pub fn scatter(reference: &Reference) -> f64 {
    let deviations = reference.temperature();
    let all = deviations.iter().flat_map(|probe| statistics(probe));
    100.0 / temperature_range(&reference.case) * all.map(|(_, deviation)| deviation).fold(0.0, f64::max)
}
