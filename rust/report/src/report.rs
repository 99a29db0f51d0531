//! The report as data: which jobs are run, in which order, and the results that follow from them.

use crate::ReportError;
use crate::failures::{self, Failures};
use crate::jobs::execute::{Stamp, execute, sweep};
use crate::jobs::pool::{self, Progress, Records};
use crate::plan::{self, CHARTED, CostSource};
use crate::settings::Settings;
use crate::studies::chart::{Cheapest, cheapest_of, elements, points, start_up};
use crate::studies::convergence::{self, Convergence};
use crate::studies::detail::{self, Details};
use crate::studies::economy::{self, Saving};
use crate::studies::front::Point;
use crate::studies::known::{self, KnownStates};
use crate::studies::other_cases::{self, OtherCase, OtherCases, Scaling};
use crate::studies::requests::Judged;
use crate::studies::sensitivity::{self, Sensitivity};
use crate::studies::spheres::{self, Spheres};
use crate::studies::targets::{Target, targets};
use crate::studies::validation::{Validated, scatter, validation};
use msdd_dem_reference::packings::{CASES, Reference};
use msdd_dem_reference::solver::Run;
use serde::Serialize;
use std::collections::BTreeMap;

#[derive(Serialize)]
pub struct Report {
    pub schema: &'static str,
    pub quick: bool,
    pub made: Stamp,
    pub jobs: usize,
    pub cached_jobs: usize,
    /// Processor time of a run with a single step, that is of the start of the program \[s\].
    pub start_up: Option<f64>,
    /// Scatter of T between the packings, the largest over time and probes, standard deviation [% of the range].
    pub scatter: BTreeMap<String, f64>,
    pub validation: Vec<Validated>,
    pub targets: Vec<Target>,
    pub chart: BTreeMap<String, Vec<Point>>,
    pub cheapest: Vec<Cheapest>,
    pub economy: Vec<Saving>,
    pub convergence: Vec<Convergence>,
    pub sensitivity: Vec<Sensitivity>,
    pub other_cases: Vec<OtherCase>,
    pub scalings: Vec<Scaling>,
    pub spheres: Spheres,
    pub failures: Failures,
    /// What the report does not contain, and why.
    pub left_out: Vec<String>,
}

/// The report, and the runs that its figures are drawn from.
pub struct Made {
    pub report: Report,
    pub references: Vec<Reference>,
    /// Runs by (case, configuration), one for each packing.
    pub runs: BTreeMap<(String, String), Vec<Run>>,
    pub details: Details,
    pub other_cases: OtherCases,
    /// Hulls of the states in the database, within which models were trained.
    pub known: KnownStates,
    /// Requests for an accuracy in the reference scenes, and how the bands do there.
    pub judged: Judged,
}

/// Makes the report; runs the jobs that the cache does not have.
///
/// # Errors
/// When files of the reference or the cases are missing, or files cannot be written. Jobs that fail are part of the report.
pub fn make(
    settings: &Settings,
    watch: &mut (dyn FnMut(&str, &Progress) + Send),
) -> Result<Made, ReportError> {
    sweep(&settings.place.work);
    pack(settings)?;
    let records = run_all(settings, watch)?;
    let references: Vec<Reference> = CASES
        .iter()
        .map(|(case, _)| Reference::read(&settings.place.checkout, case, settings.seeds()))
        .collect::<Result<_, _>>()?;
    let mut runs = BTreeMap::new();
    let validation = validation(settings, &records, &references, &mut runs);
    let mut chart = BTreeMap::new();
    for case in CHARTED {
        let reference = references.iter().find(|r| r.case == case);
        if let Some(reference) = reference {
            chart.insert(case.to_string(), points(settings, &records, reference));
        }
    }
    let other_cases = other_cases::read(settings, &records, &references)?;
    let known = KnownStates::read(&settings.place.checkout.join(known::DATABASE))?;
    let report = Report {
        schema: "msdd-report-1",
        quick: settings.quick,
        made: settings.place.stamp.clone(),
        jobs: records.len(),
        cached_jobs: records.values().filter(|r| r.cached).count(),
        start_up: settings.record(&records, &start_up().job).map(|r| r.cpu_seconds),
        scatter: references.iter().map(|r| (r.case.clone(), scatter(r))).collect(),
        targets: targets(&validation, settings.quick),
        validation,
        cheapest: CHARTED.iter().flat_map(|case| cheapest_of(case, &chart[*case])).collect(),
        chart,
        convergence: convergence::read(settings, &records),
        sensitivity: sensitivity::read(settings, &records, &references),
        other_cases: other_cases.rows.clone(),
        scalings: other_cases.scalings.clone(),
        spheres: spheres::read(settings, &records)?,
        economy: economy::savings(settings, &records, &references),
        failures: failures::read(settings, &records)?,
        left_out: left_out(settings.quick),
    };
    let details = detail::read(settings, &records)?;
    let judged = Judged::read(&settings.place.checkout.join("cases/scenes"))?;
    Ok(Made { report, references, runs, details, other_cases, known, judged })
}

/// Packs the box of DEM unless its state file is there.
fn pack(settings: &Settings) -> Result<(), ReportError> {
    if settings.quick
        || !settings.run
        || settings.place.checkout.join("results/reference/packed_seed1.json").exists()
    {
        return Ok(());
    }
    let pack = plan::tool("reference pack --case cases/H --seed 1", &[], None, 1800);
    execute(&settings.place, &pack, "pack").map(drop)
}

fn run_all(
    settings: &Settings,
    watch: &mut (dyn FnMut(&str, &Progress) + Send),
) -> Result<Records, ReportError> {
    let mut costs = vec![start_up()];
    let mut rest = Vec::new();
    let first = settings.seeds()[0];
    for configuration in plan::chart(settings.quick) {
        for case in &configuration.cases {
            costs.push(configuration.asked(case, first));
            if configuration.known == CostSource::Run {
                let more = settings.seeds().iter().take(configuration.packings).skip(1);
                rest.extend(more.map(|seed| configuration.asked(case, *seed)));
            }
        }
    }
    for configuration in plan::validated(settings.quick) {
        for case in &configuration.cases {
            let seeds = settings.seeds().iter().take(configuration.packings);
            rest.extend(seeds.map(|seed| configuration.asked(case, *seed)));
        }
    }
    if !settings.quick {
        CHARTED.iter().for_each(|case| costs.extend(elements(case)));
    }
    costs.extend(spheres::jobs(settings.quick));
    rest.extend(detail::jobs(settings));
    rest.extend(convergence::jobs(settings));
    rest.extend(sensitivity::jobs(settings));
    rest.extend(other_cases::jobs());
    rest.extend(economy::jobs(settings));
    rest.extend(failures::jobs(settings.quick)?);
    let (cache, place) = (&settings.cache, &settings.place);
    if !settings.run {
        return pool::found(cache, &[costs, rest].concat());
    }
    // One at a time, so that no other job of ours slows it down by using the same processor caches.
    let mut records = pool::run(cache, place, &costs, 1, &mut |p| watch("cost, one at a time", p))?;
    records.extend(pool::run(cache, place, &rest, settings.at_a_time, &mut |p| watch("accuracy", p))?);
    Ok(records)
}

fn left_out(quick: bool) -> Vec<String> {
    let mut list: Vec<&str> = vec![
        "K_xy of boxes of grains and of cells that are sheared.",
        "The pressure of the discs in the inner region, in the charts and in the cases whose grains do not expand: that of the whole box is used there.",
    ];
    if quick {
        list.push("Quick: one packing, few configurations, coarse meshes, no DEM.");
    }
    list.into_iter().map(str::to_string).collect()
}
