//! What runs of a user's case are compared with: a run that is finer in space and time, or discs.

use super::errors::{Errors, Truth, mean};
use super::ladder::{Rung, cells, count, finest, level};
use super::work::{Watch, Work};
use crate::ReportError;
use crate::jobs::execute::Outcome;
use crate::jobs::job::Job;
use crate::jobs::pool::Asked;
use crate::jobs::user_case::Measured;
use msdd_autotune::settings::Settings;
use serde::Serialize;

/// How many times finer than the case's own cells, and shorter than the shortest steps of the ladder, the run is; the next is
/// taken if it fails. 8 is tried only if it is expected to end in time.
const FINER: [i32; 3] = [8, 4, 2];
/// Processor time after which it is stopped [s]; of a quick report.
const LIMITS: [u64; 2] = [1800, 300];

/// The reference.
#[derive(Clone, Debug, Default, Serialize)]
pub struct Reference {
    /// What it is, as sentences.
    pub what: String,
    /// How many times finer than the case's cells it is; `None` for discs, and for a mesh that cannot be changed.
    pub finer: Option<i32>,
    /// Cells of its mesh, or discs of a packing.
    pub size: usize,
    /// Processor time of the run, or of the packings \[s\].
    pub core_seconds: f64,
    /// Error of T that it has itself, by the order of the methods, if that is known [%].
    pub own_error: Option<f64>,
    /// Standard deviation between the packings of the discs, if there are several.
    pub scatter: Option<Errors>,
}

/// Makes the reference. `range`: of T \[K\].
///
/// # Errors
/// [`ReportError::Useless`] if no reference comes to its end.
pub fn make(
    work: &mut Work,
    rungs: &[Rung],
    range: f64,
    watch: &mut Watch,
) -> Result<(Truth, Reference), ReportError> {
    if work.discs.is_some() { of_discs(work, watch) } else { of_finer(work, rungs, range, watch) }
}

fn of_discs(work: &mut Work, watch: &mut Watch) -> Result<(Truth, Reference), ReportError> {
    let Some(discs) = &work.discs else { return Ok(Default::default()) };
    let (range, jobs): (f64, Vec<Job>) = (discs.range, discs.jobs.iter().cloned().map(Job::Case).collect());
    let asked: Vec<Asked> = jobs.iter().map(|job| Asked { job: job.clone(), guess: 60.0 }).collect();
    work.run("discs", &asked, watch)?;
    let (mut packings, mut core_seconds, mut failed) = (Vec::new(), 0.0, Vec::new());
    for job in &jobs {
        core_seconds += work.record(job).map_or(0.0, |record| record.cpu_seconds);
        match work.measured(job) {
            Some(measured) => packings.push(measured),
            None => failed.push(why(work, job)),
        }
    }
    let Some(first) = packings.first() else {
        let problem = format!("no packing of discs came to its end: {}", failed.join("; "));
        return Err(ReportError::Useless { problem });
    };
    let size = first.size;
    let of =
        |k: usize| packings.iter().filter_map(|p| Some(p.packing?[k])).sum::<f64>() / packings.len() as f64;
    let mut what = format!(
        "DEM: the mean of {} of {size} discs in the same box, closed to the case's mean porosity. Before heating it has \
         porosity {:.4}, overlaps counted once, and pressure {:.4e} Pa away from the walls, and fabric index {:.3}. The runs start from the fields of the case, not from \
         these packings.",
        match packings.len() {
            1 => "one packing".to_string(),
            many => format!("{many} packings"),
        },
        of(0),
        of(2),
        of(1)
    );
    for problem in &failed {
        what += &format!(" A further packing {problem}.");
    }
    let (truth, scatter) = mean(&packings, range);
    Ok((truth, Reference { what, finer: None, size, core_seconds, own_error: None, scatter }))
}

/// Why a job has no result.
fn why(work: &Work, job: &Job) -> String {
    work.record(job).map_or("was not run".to_string(), |record| {
        let outcome = if record.outcome == Outcome::Done { "gave nothing" } else { record.outcome.as_str() };
        format!("{outcome}: {}", record.message)
    })
}

fn of_finer(
    work: &mut Work,
    rungs: &[Rung],
    range: f64,
    watch: &mut Watch,
) -> Result<(Truth, Reference), ReportError> {
    let quick = work.settings.quick;
    let limit = LIMITS[usize::from(quick)];
    let done = |work: &Work, rung: &Rung| work.measured(&work.solver(rung, work.limit())).is_some();
    let moves = rungs.iter().any(|rung| rung.settings.moves && done(work, rung));
    let (tolerance, halved) = finest(quick);
    let can_refine = !work.scene.directions().is_empty();
    let mut notes = String::new();
    if !moves {
        notes += " Grains stay, since no run in which they move came to its end.";
    }
    if let Err(reason) = &work.scene.blocks {
        notes += &format!(" Its cells are those of the case: {reason}.");
    }
    for finer in FINER {
        let times = (f64::from(finer)).log2().round() as i32;
        let levels = level(work.scene, -times);
        // A step grows with the square root of the tolerance.
        let settings = Settings::new(levels, tolerance / f64::from(finer).powi(2), moves);
        let rung = Rung::new(work.scene, range, settings);
        let guess = estimate(work, rungs, &rung).unwrap_or(limit as f64);
        if finer == FINER[0] && (quick || guess > limit as f64) {
            if !quick && can_refine {
                notes += &format!(
                    " One that is {finer} times as fine was expected to take {guess:.0} core-s, {limit} are allowed."
                );
            }
            continue;
        }
        let job = work.solver(&rung, limit);
        work.run("reference", &[Asked { job: job.clone(), guess }], watch)?;
        let Some(measured) = work.measured(&job) else {
            notes += &format!(" A run with {} was tried, and {}.", rung.name, why(work, &job));
            continue;
        };
        let truth = Truth::of(&measured, range);
        let core_seconds = work.record(&job).map_or(0.0, |record| record.cpu_seconds);
        let what = format!(
            "A run of the same solver on {}{}, with adaptive steps of second order and a tolerance of {:.2e} % of the range of T, \
             about {finer} times shorter than the shortest adaptive ones of the chart{}.{notes}",
            cells(work.scene, &rung.settings.levels),
            if can_refine {
                format!(", {finer} times as fine along each direction as those of the case")
            } else {
                String::new()
            },
            100.0 * rung.settings.tolerance,
            if moves { ", with grains that move" } else { "" }
        );
        // The finest run of the chart differs from the reference by this factor in its cells (second order) and in its steps.
        let space = f64::from(finer) / f64::from(1 << -halved.min(0));
        let order = if moves { 1 } else { 2 };
        let share = |ratio: f64, order: i32| 1.0 / (ratio.powi(order) - 1.0);
        let share = share(f64::from(finer), order).max(if can_refine { share(space, 2) } else { 0.0 });
        let nearest =
            Rung::new(work.scene, range, Settings::new(level(work.scene, halved), tolerance, moves));
        let own_error =
            nearest_error(work, &nearest, &truth).map(|error| share * error).filter(|e| e.is_finite());
        let finer = can_refine.then_some(finer);
        let reference =
            Reference { what, finer, size: measured.size, core_seconds, own_error, scatter: None };
        return Ok((truth, reference));
    }
    let problem = format!("it has no reference to compare with:{notes}");
    Err(ReportError::Useless { problem })
}

fn nearest_error(work: &Work, rung: &Rung, truth: &Truth) -> Option<f64> {
    let measured: Measured = work.measured(&work.solver(rung, work.limit()))?;
    truth.errors(&measured).temperature.map(|error| error.worst)
}

/// Processor time that a run will take [s], about: that of the longest run with the same motion, times the cells to the power
/// 1.2, times the steps, which go with the square root of the tolerance.
fn estimate(work: &Work, rungs: &[Rung], wanted: &Rung) -> Option<f64> {
    let cost = |rung: &Rung| {
        let job = work.solver(rung, work.limit());
        work.record(&job).filter(|record| record.outcome == Outcome::Done).map(|record| record.cpu_seconds)
    };
    let like = rungs.iter().filter(|rung| rung.family == wanted.family);
    let known = like.filter_map(|rung| Some((rung, cost(rung)?))).max_by(|a, b| a.1.total_cmp(&b.1));
    let (rung, seconds) = known?;
    let cells = |rung: &Rung| count(work.scene, &rung.settings.levels) as f64;
    let steps = (rung.settings.tolerance / wanted.settings.tolerance).sqrt();
    Some(seconds * steps * (cells(wanted) / cells(rung)).powf(1.2))
}
