//! The report as data: which jobs are run, in which order, and what follows from them.

use crate::compare::{Errors, errors};
use crate::convergence::{self, Convergence};
use crate::detail::{self, Details};
use crate::economy::{self, Saving};
use crate::execute::{Outcome, Place, Record, Stamp, execute, sweep};
use crate::failures::{self, Failures};
use crate::front::{Point, cheapest, mark};
use crate::job::Job;
use crate::known::{self, KnownStates};
use crate::other_cases::{self, OtherCase, OtherCases, Scaling};
use crate::output::Run;
use crate::plan::{self, CHARTED, Configuration, FAMILIES, Known};
use crate::pool::{self, Asked, Progress, Records};
use crate::reference::{CASES, Reference, SEEDS, statistics, temperature_range};
use crate::sensitivity::{self, Sensitivity};
use crate::targets::{Target, targets};
use crate::{ReportError, cache::Cache};
use serde::Serialize;
use std::collections::BTreeMap;

/// Errors for which the cheapest configuration is named [% of the range].
pub const WANTED: [f64; 4] = [5.0, 2.0, 1.0, 0.5];
/// The paper's own costs [core-s]: a reference of 30 h, a multiscale run of 40 s (its section 3.4), and its errors at P2 [%].
const QUOTED: [(&str, f64, Option<[f64; 3]>); 2] = [
    ("paper: discrete elements, 30 h", 108_000.0, None),
    ("paper: multiscale, 40 s", 40.0, Some([5.3, 2.8, 6.5])),
];
/// Simulated time of a segment by discrete elements [s], and the steps that are tried [s].
const SEGMENT: f64 = 0.1;
const STEPS: [f64; 2] = [2e-4, 5e-5];
/// The case that is run as a whole by discrete elements; costs of segments are scaled by its ratio of whole to segment.
const WHOLE: &str = "H";

/// One configuration in one case against the reference.
#[derive(Clone, Debug, Serialize)]
pub struct Validated {
    pub case: String,
    pub configuration: String,
    pub family: String,
    pub outcome: String,
    pub message: String,
    pub errors: Option<Errors>,
}

/// The cheapest configuration for an error of T.
#[derive(Clone, Debug, Serialize)]
pub struct Cheapest {
    pub case: String,
    /// [% of the range]
    pub error: f64,
    /// None: none reaches it.
    pub configuration: Option<String>,
    pub core_seconds: Option<f64>,
}

#[derive(Serialize)]
pub struct Report {
    pub schema: &'static str,
    pub quick: bool,
    pub made: Stamp,
    pub jobs: usize,
    pub cached_jobs: usize,
    /// Processor time of one step: the start [core-s].
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
    pub failures: Failures,
    /// What was left out, and why.
    pub left_out: Vec<String>,
}

/// The report, and the runs that its figures are drawn from.
pub struct Made {
    pub report: Report,
    pub references: Vec<Reference>,
    /// By (case, configuration): one run a packing.
    pub runs: BTreeMap<(String, String), Vec<Run>>,
    pub details: Details,
    pub other_cases: OtherCases,
    /// States of the database, where models know the material.
    pub known: KnownStates,
}

/// What to make.
pub struct Settings {
    pub quick: bool,
    pub place: Place,
    pub cache: Cache,
    pub at_a_time: usize,
    /// Whether jobs are run that the cache does not have; else they are reported as not run.
    pub run: bool,
}

impl Settings {
    pub fn seeds(&self) -> &'static [u32] {
        if self.quick { &SEEDS[..1] } else { &SEEDS }
    }

    /// Number of packings that a configuration is run for.
    fn packings(&self, configuration: &Configuration) -> usize {
        self.seeds().len().min(configuration.packings)
    }

    /// Records of one configuration in a case, a packing each.
    fn records<'a>(
        &self,
        records: &'a Records,
        configuration: &Configuration,
        case: &str,
    ) -> Vec<&'a Record> {
        let job = |seed: &u32| Job::Solver(configuration.job(case, *seed));
        let seeds = self.seeds().iter().take(configuration.packings);
        seeds.filter_map(|seed| self.record(records, &job(seed))).collect()
    }

    pub fn record<'a>(&self, records: &'a Records, job: &Job) -> Option<&'a Record> {
        records.get(&self.cache.key(job).ok()?)
    }
}

/// Makes the report: runs what the cache does not have.
///
/// # Errors
/// Files of the reference or the cases that are missing or cannot be written; jobs that fail are part of the report.
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
        targets: targets(&validation),
        validation,
        cheapest: CHARTED.iter().flat_map(|case| cheapest_of(case, &chart[*case])).collect(),
        chart,
        convergence: convergence::read(settings, &records),
        sensitivity: sensitivity::read(settings, &records, &references),
        other_cases: other_cases.rows.clone(),
        scalings: other_cases.scalings.clone(),
        economy: economy::savings(settings, &records, &references),
        failures: failures::read(settings, &records),
        left_out: left_out(settings.quick),
    };
    let details = detail::read(settings, &records)?;
    Ok(Made { report, references, runs, details, other_cases, known })
}

/// Packs the box of the discrete elements unless it is there.
fn pack(settings: &Settings) -> Result<(), ReportError> {
    if settings.quick
        || !settings.run
        || settings.place.checkout.join("results/reference/packed_seed1.json").exists()
    {
        return Ok(());
    }
    let arguments = ["reference", "pack", "--case", "cases/H", "--seed", "1"].map(str::to_string);
    execute(&settings.place, &plan::tool(arguments.to_vec(), &[], 1800), "pack").map(drop)
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
            if configuration.known == Known::Run {
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
    rest.extend(detail::jobs(settings));
    rest.extend(convergence::jobs(settings));
    rest.extend(sensitivity::jobs(settings));
    rest.extend(other_cases::jobs());
    rest.extend(economy::jobs(settings));
    rest.extend(failures::jobs(settings.quick));
    let (cache, place) = (&settings.cache, &settings.place);
    if !settings.run {
        return pool::found(cache, &[costs, rest].concat());
    }
    // Alone, so that no other job of ours takes from its caches.
    let mut records = pool::run(cache, place, &costs, 1, &mut |p| watch("cost, one at a time", p))?;
    records.extend(pool::run(cache, place, &rest, settings.at_a_time, &mut |p| watch("accuracy", p))?);
    Ok(records)
}

/// One step of case H.
fn start_up() -> Asked {
    let mut job = crate::job::SolverJob::new("H", 1);
    job.end = 0.01;
    Asked { job: Job::Solver(job), guess: 0.5 }
}

/// Case H as a whole, and segments of all with shorter steps, too.
fn elements(case: &str) -> Vec<Asked> {
    let segment = |step: Option<f64>| Asked {
        job: plan::elements(case, SEGMENT, step, 600),
        guess: step.map_or(4.0, |s| 3e-3 / s),
    };
    let mut jobs = vec![segment(None)];
    jobs.extend(STEPS.map(|step| segment(Some(step))));
    if case == WHOLE {
        jobs.push(Asked { job: plan::elements(case, 20.0, None, 1200), guess: 150.0 });
    }
    jobs
}

/// Runs of a configuration, if those of all `packings` ended well; else why not.
fn complete<'a>(records: &[&'a Record], packings: usize) -> Result<Vec<&'a Run>, (Outcome, String)> {
    let runs: Vec<&Run> = records.iter().filter_map(|record| record.run.as_ref()).collect();
    match records.iter().find(|record| record.outcome != Outcome::Done) {
        Some(record) => Err((record.outcome, record.message.clone())),
        None if runs.len() < packings => {
            Err((Outcome::NotRun, format!("{} of {packings} packings so far", runs.len())))
        }
        None => Ok(runs),
    }
}

fn validation(
    settings: &Settings,
    records: &Records,
    references: &[Reference],
    kept: &mut BTreeMap<(String, String), Vec<Run>>,
) -> Vec<Validated> {
    let mut validated = Vec::new();
    for reference in references {
        for configuration in plan::validated(settings.quick) {
            if !configuration.cases.contains(&reference.case.as_str()) {
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
                family: configuration.family.to_string(),
                outcome: outcome.as_str().to_string(),
                message,
                errors,
            });
        }
    }
    validated
}

fn points(settings: &Settings, records: &Records, reference: &Reference) -> Vec<Point> {
    let case = reference.case.as_str();
    let mut points: Vec<Point> = Vec::new();
    for configuration in plan::chart(settings.quick) {
        if configuration.cases.contains(&case) {
            points.push(point(settings, records, reference, &configuration));
        }
    }
    borrow_errors(&mut points, settings.quick);
    if !settings.quick {
        points.extend(element_points(settings, records, reference));
    }
    points.extend(quoted(case));
    mark(&mut points);
    points
}

fn point(
    settings: &Settings,
    records: &Records,
    reference: &Reference,
    configuration: &Configuration,
) -> Point {
    let first = Job::Solver(configuration.job(&reference.case, settings.seeds()[0]));
    let cost = settings.record(records, &first).filter(|record| record.outcome == Outcome::Done);
    let mut core_seconds = cost.map(|record| record.cpu_seconds);
    let mut how = if cost.is_some_and(|record| record.cached) { "cached" } else { "measured" };
    let mut found = None;
    let (mut outcome, mut message) = (Outcome::Done, String::new());
    match &configuration.known {
        Known::Run => match complete(
            &settings.records(records, configuration, &reference.case),
            settings.packings(configuration),
        ) {
            Ok(runs) => found = errors(&reference.first(runs.len()), &runs, configuration.affine),
            Err(why) => (outcome, message) = why,
        },
        Known::Segment(end, _) => {
            let start = settings.record(records, &start_up().job).map_or(0.0, |record| record.cpu_seconds);
            core_seconds = core_seconds.map(|cpu| start + (cpu - start).max(0.0) * 20.0 / end);
            how = "extrapolated";
        }
        Known::Answers(_, name) => {
            core_seconds = cost.and_then(|segment| all_answers(settings, records, reference, segment, name));
            how = "extrapolated";
        }
    }
    Point {
        name: configuration.name.clone(),
        family: configuration.family.to_string(),
        core_seconds,
        temperature_error: found.as_ref().map(Errors::largest_temperature),
        pressure_error: found.as_ref().map(|errors| errors.pressure.abs()),
        cost: how.to_string(),
        outcome: outcome.as_str().to_string(),
        message,
        front: [false; 2],
    }
}

/// Cost of a whole run [core-s] whose cells are answered as often as those of the configuration of a name. The cost of an
/// answer is that of the segment, its packings included. The first question, of all cells at once, strains none.
fn all_answers(
    settings: &Settings,
    records: &Records,
    reference: &Reference,
    segment: &Record,
    name: &str,
) -> Option<f64> {
    let chart = plan::chart(settings.quick);
    let whole = chart.iter().find(|configuration| configuration.name == name)?;
    let job = Job::Solver(whole.job(&reference.case, settings.seeds()[0]));
    let whole = settings.record(records, &job)?.run.as_ref()?;
    answers_ratio(whole, segment.run.as_ref()?).map(|ratio| segment.cpu_seconds * ratio)
}

/// Answers a cell of a whole run over those of a segment, each without the first; none if the segment has no other.
fn answers_ratio(whole: &Run, segment: &Run) -> Option<f64> {
    let answers = |run: &Run| run.cell_queries.saturating_sub(run.cells) as f64 / run.cells as f64;
    let ratio = answers(whole) / answers(segment);
    ratio.is_finite().then_some(ratio)
}

/// Segments take the error of the configuration that they name.
fn borrow_errors(points: &mut [Point], quick: bool) {
    for configuration in plan::chart(quick) {
        let Some(from) = configuration.known.borrowed() else { continue };
        let errors = points.iter().find(|p| p.name == from).map(|p| (p.temperature_error, p.pressure_error));
        let point = points.iter_mut().find(|p| p.name == configuration.name);
        if let (Some(point), Some((temperature, pressure))) = (point, errors) {
            (point.temperature_error, point.pressure_error) = (temperature, pressure);
        }
    }
}

/// Standard deviation of T between packings, the largest over time and probes [% of the range].
fn scatter(reference: &Reference) -> f64 {
    let deviations = reference.temperature();
    let all = deviations.iter().flat_map(|probe| statistics(probe));
    100.0 / temperature_range(&reference.case) * all.map(|(_, deviation)| deviation).fold(0.0, f64::max)
}

/// Discrete elements: their error is the scatter between packings, since one run is one packing.
fn element_points(settings: &Settings, records: &Records, reference: &Reference) -> Vec<Point> {
    let case = reference.case.as_str();
    let cost = |case: &str, end: f64, step: Option<f64>, limit: u64| {
        let record = settings.record(records, &plan::elements(case, end, step, limit))?;
        (record.outcome == Outcome::Done).then_some((record.cpu_seconds, record.cached))
    };
    let whole = cost(WHOLE, 20.0, None, 1200);
    let scale = whole.zip(cost(WHOLE, SEGMENT, None, 600)).map(|(whole, segment)| whole.0 / segment.0);
    let scaled = |step| scale.zip(cost(case, SEGMENT, step, 600)).map(|(scale, segment)| scale * segment.0);
    let own = whole.filter(|_| case == WHOLE);
    let pressure: Vec<f64> =
        statistics(&reference.series("pressure")).iter().map(|(_, deviation)| *deviation).collect();
    let most = pressure.iter().copied().fold(0.0, f64::max);
    let base = Point {
        name: "one packing, steps from the bound".to_string(),
        family: FAMILIES[7].to_string(),
        core_seconds: own.map(|w| w.0).or_else(|| scaled(None)),
        temperature_error: Some(scatter(reference)),
        pressure_error: Some(100.0 * most / crate::reference::pressure_range(case)),
        cost: own.map_or("extrapolated", |w| if w.1 { "cached" } else { "measured" }).to_string(),
        outcome: if whole.is_some() { "done" } else { "not run" }.to_string(),
        message: String::new(),
        front: [false; 2],
    };
    let finer = STEPS.map(|step| Point {
        name: format!("one packing, steps {} ms", 1e3 * step),
        core_seconds: scaled(Some(step)),
        cost: "extrapolated".to_string(),
        ..base.clone()
    });
    [vec![base], finer.to_vec()].concat()
}

fn quoted(case: &str) -> Vec<Point> {
    let index = CHARTED.iter().position(|c| *c == case).unwrap_or(0);
    QUOTED
        .iter()
        .map(|(name, cost, errors)| Point {
            name: (*name).to_string(),
            family: FAMILIES[8].to_string(),
            core_seconds: Some(*cost),
            // The paper's reference is what it judges by: drawn at the lower edge, without an error of its own.
            temperature_error: errors.map(|e| e[index]),
            pressure_error: errors.map(|_| [9.6, 10.9, 3.0][index]),
            cost: "quoted".to_string(),
            outcome: "quoted".to_string(),
            message: String::new(),
            front: [false; 2],
        })
        .collect()
}

fn cheapest_of(case: &str, points: &[Point]) -> Vec<Cheapest> {
    let of = |error: f64| {
        let found = cheapest(points, error);
        Cheapest {
            case: case.to_string(),
            error,
            configuration: found.map(|point| format!("{}: {}", point.family, point.name)),
            core_seconds: found.and_then(|point| point.core_seconds),
        }
    };
    WANTED.map(of).to_vec()
}

fn left_out(quick: bool) -> Vec<String> {
    let mut list: Vec<&str> = vec![
        "K_xy of boxes of grains and of cells that are sheared.",
        "The discs' pressure off their walls in the charts, and in the cases whose grains do not expand: the whole box stands there.",
    ];
    if quick {
        list.push("Quick: one packing, few configurations, coarse meshes, no discrete elements.");
    }
    list.into_iter().map(str::to_string).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn answers_are_counted_a_cell_without_the_first() {
        let run = |cells, cell_queries| Run { cells, cell_queries, ..Run::default() };
        // 20 answers a cell against 0.5.
        assert_eq!(answers_ratio(&run(270, 21 * 270), &run(3000, 4500)), Some(40.0));
        assert_eq!(answers_ratio(&run(270, 540), &run(3000, 3000)), None);
    }
}
