//! Error against cost: the points of the chart of one case, and the cheapest configuration for each wanted error.

use super::front::{Point, cheapest, mark};
use super::validation::{complete, scatter};
use crate::jobs::execute::{Outcome, Record};
use crate::jobs::job::{Job, SolverJob};
use crate::jobs::pool::{Asked, Records};
use crate::plan::{self, CHARTED, Configuration, CostSource, FAMILIES};
use crate::settings::Settings;
use msdd_dem_reference::compare::{Errors, errors};
use msdd_dem_reference::packings::{Reference, pressure_range};
use msdd_dem_reference::series::statistics;
use msdd_dem_reference::solver::Run;
use serde::Serialize;

/// Errors for which the cheapest configuration is named [% of the range].
pub const WANTED: [f64; 4] = [5.0, 2.0, 1.0, 0.5];
/// Costs [core-s] that the paper gives in section 3.4: 30 h for its reference, 40 s for a multiscale run, with its errors at
/// P2 [%].
const QUOTED: [(&str, f64, Option<[f64; 3]>); 2] =
    [("paper: DEM, 30 h", 108_000.0, None), ("paper: multiscale, 40 s", 40.0, Some([5.3, 2.8, 6.5]))];
/// Simulated time of a segment, a short run by DEM that is only timed [s], and the time steps that are tried [s].
const SEGMENT: f64 = 0.1;
const STEPS: [f64; 2] = [2e-4, 5e-5];
/// The case that is run to its end by DEM. The costs of segments of other cases are multiplied by its ratio of
/// the cost of the whole run to that of a segment.
const WHOLE: &str = "H";

/// The cheapest configuration for an error of T.
#[derive(Clone, Debug, Serialize)]
pub struct Cheapest {
    pub case: String,
    /// Wanted error [% of the range].
    pub error: f64,
    /// Name of the configuration; `None`: no configuration reaches the error.
    pub configuration: Option<String>,
    pub core_seconds: Option<f64>,
}

/// The job of one step of case H, to measure the cost of the start.
pub fn start_up() -> Asked {
    let mut job = SolverJob::new("H", 1);
    job.end = 0.01;
    Asked { job: Job::Solver(job), guess: 0.5 }
}

/// Jobs by DEM: case H to its end, and segments of all cases, also with shorter steps.
pub fn elements(case: &str) -> Vec<Asked> {
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

/// The points of the case of `reference`; those on the Pareto fronts are marked.
pub fn points(settings: &Settings, records: &Records, reference: &Reference) -> Vec<Point> {
    let case = reference.case.as_str();
    let mut points: Vec<Point> = Vec::new();
    for configuration in plan::chart(settings.quick) {
        if configuration.cases.iter().any(|one| one == case) {
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
        CostSource::Run => match complete(
            &settings.records(records, configuration, &reference.case),
            settings.packings(configuration),
        ) {
            Ok(runs) => found = errors(&reference.first(runs.len()), &runs, configuration.affine),
            Err(why) => (outcome, message) = why,
        },
        CostSource::Segment(end, _) => {
            let start = settings.record(records, &start_up().job).map_or(0.0, |record| record.cpu_seconds);
            core_seconds = core_seconds.map(|cpu| start + (cpu - start).max(0.0) * 20.0 / end);
            how = "extrapolated";
        }
        CostSource::Answers(_, name) => {
            core_seconds = cost.and_then(|segment| all_answers(settings, records, reference, segment, name));
            how = "extrapolated";
        }
    }
    Point {
        name: configuration.name.clone(),
        family: configuration.family.clone(),
        core_seconds,
        temperature_error: found.as_ref().map(Errors::largest_temperature),
        pressure_error: found.as_ref().map(|errors| errors.pressure.abs()),
        cost: how.to_string(),
        outcome: outcome.as_str().to_string(),
        message,
        front: [false; 2],
    }
}

/// Estimated cost of a whole run [core-s] whose model is evaluated as often for each cell as in the configuration `name`. The
/// cost of an evaluation is that in the segment, with the packing of the boxes in it. The first evaluation, of all cells at
/// once, is not counted, because no box is strained in it.
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

/// Evaluations per cell in a whole run over those in a segment, each without the first; `None` if the segment has no other.
fn answers_ratio(whole: &Run, segment: &Run) -> Option<f64> {
    let answers = |run: &Run| run.cell_queries.saturating_sub(run.cells) as f64 / run.cells as f64;
    let ratio = answers(whole) / answers(segment);
    ratio.is_finite().then_some(ratio)
}

/// Gives the segments the errors of the configurations that they name.
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

/// DEM: their error is the scatter between packings, since one run is one packing.
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
        pressure_error: Some(100.0 * most / pressure_range(case)),
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
            // The paper's reference has no error, because the paper compares with it; it is drawn at the lower edge.
            temperature_error: errors.map(|e| e[index]),
            pressure_error: errors.map(|_| [9.6, 10.9, 3.0][index]),
            cost: "quoted".to_string(),
            outcome: "quoted".to_string(),
            message: String::new(),
            front: [false; 2],
        })
        .collect()
}

/// The cheapest of the points for each wanted error.
pub fn cheapest_of(case: &str, points: &[Point]) -> Vec<Cheapest> {
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn answers_are_counted_a_cell_without_the_first() {
        let run = |cells, cell_queries| Run { cells, cell_queries, ..Run::default() };
        // 20 evaluations per cell over 0.5.
        assert_eq!(answers_ratio(&run(270, 21 * 270), &run(3000, 4500)), Some(40.0));
        assert_eq!(answers_ratio(&run(270, 540), &run(3000, 3000)), None);
    }
}
