//! Speed against accuracy for a case of the user's: it is run in a ladder of configurations, which are compared with a run that
//! is finer in space and time, or with DEM of the same box.
//!
//! | module | what |
//! |---|---|
//! | [`mod@ladder`] | the configurations |
//! | [`discs`] | whether discs can be made for the case, and which |
//! | [`errors`] | how far a run is from the reference |
//! | [`mod@reference`] | the reference |
//! | `work` | the case, and the records of its jobs |

pub mod discs;
pub mod errors;
pub mod ladder;
pub mod reference;
mod work;

use crate::ReportError;
use crate::jobs::execute::{Outcome, Stamp, sweep};
use crate::jobs::job::{CaseProgram, Job};
use crate::jobs::pool::{Asked, Records};
use crate::jobs::user_case;
use crate::settings::Settings;
use crate::studies::front::{Point, cheapest, mark};
use errors::{Errors, Truth};
use ladder::{FAMILIES, Rung, ladder, level};
use msdd_autotune::record::{self, sentence};
use msdd_autotune::user_case::UserCase;
use msdd_case::CaseError;
use msdd_files::Lock;
use reference::Reference;
use serde::Serialize;
use std::collections::BTreeSet;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use work::{Watch, Work};

/// Accuracies for which `msdd case solve` is asked [% of the range of T].
pub const ACCURACIES: [f64; 3] = [5.0, 2.0, 1.0];

/// One configuration.
#[derive(Clone, Debug, Serialize)]
pub struct Row {
    #[serde(flatten)]
    pub point: Point,
    /// Cells of the mesh; `None` if the run failed.
    pub cells: Option<usize>,
    pub wall_seconds: Option<f64>,
    pub errors: Errors,
}

/// What `msdd case solve` chose.
#[derive(Clone, Debug, Serialize)]
pub struct Choice {
    /// Wanted accuracy of T [% of its range].
    pub accuracy: f64,
    /// The choice in words, or why there is none.
    pub what: String,
    /// Name of its row; `None` if nothing was chosen.
    pub row: Option<String>,
    /// Its own estimate of the error of T [% of the range].
    pub estimate: Option<f64>,
    /// Processor time of the search \[s\].
    pub search_seconds: f64,
    /// The choice, its error, and where it lies, as sentences.
    pub sentence: String,
}

#[derive(Serialize)]
pub struct CaseReport {
    pub schema: &'static str,
    /// Name of the case folder.
    pub case: String,
    pub quick: bool,
    pub made: Stamp,
    pub jobs: usize,
    pub cached_jobs: usize,
    /// Range of T, of which errors are given in percent \[K\].
    pub range: f64,
    /// Number of points and of times at which runs are compared.
    pub points: usize,
    pub times: usize,
    pub reference: Reference,
    pub rows: Vec<Row>,
    pub choices: Vec<Choice>,
}

/// Refuses a folder that is no case with a mesh.
fn check(folder: &Path) -> Result<(), CaseError> {
    let there = |file: PathBuf, problem: &str| match file.exists() {
        true => Ok(()),
        false => Err(CaseError::Read { file, problem: problem.to_string() }),
    };
    there(folder.to_path_buf(), "no such folder; allowed: the folder of a case")?;
    let control = folder.join("system/controlDict");
    there(control, "no such file; allowed: the folder of a case, which has it")?;
    let mesh = folder.join("constant/polyMesh");
    there(mesh, "no such folder: the case has no mesh yet, which blockMesh makes in it")
}

/// Makes the report on the case in `folder`; runs the jobs that the cache does not have. `discs`: whether the reference is one by
/// DEM. The folder stays as it is; copies are made next to it and removed.
///
/// # Errors
/// When the folder is no case, discs cannot be made for it, it cannot be run at all, or files cannot be written.
pub fn make(
    mut settings: Settings,
    folder: &Path,
    discs: bool,
    watch: &mut Watch,
) -> Result<CaseReport, ReportError> {
    check(folder)?;
    let scene = UserCase::read(folder)?;
    let lock = Arc::new(Lock::take(&user_case::copy_of(&scene.folder))?);
    user_case::check(&scene.folder)?;
    settings.place.lock = Some(lock);
    sweep(&settings.place.work);
    let checksum = scene.checksum()?;
    let discs = discs.then(|| discs::of(&scene, &checksum, settings.quick)).transpose()?;
    let mut work = Work { settings: &settings, scene: &scene, checksum, discs, records: Records::new() };
    let report = report(&mut work, watch);
    user_case::clear(&scene.folder)?;
    report
}

fn report(work: &mut Work, watch: &mut Watch) -> Result<CaseReport, ReportError> {
    let (scene, quick) = (work.scene, work.settings.quick);
    let range = range(work, watch)?;
    let rungs = ladder(scene, range, quick)?;
    // From few cells to many: what takes too long on few is not begun on more.
    let sizes: BTreeSet<usize> = rungs.iter().map(|rung| size(work, rung)).collect();
    for cells in sizes {
        let here = rungs.iter().filter(|rung| size(work, rung) == cells && !is_hopeless(work, rung, &rungs));
        let jobs: Vec<Asked> = here.map(|rung| asked(work, rung)).collect();
        work.run(&format!("configurations, {cells} cells"), &jobs, watch)?;
    }
    let mut choices = Vec::new();
    let jobs = ACCURACIES.map(|accuracy| Asked { job: choice_job(work, accuracy), guess: 10.0 });
    work.run("choices of msdd case solve", &jobs, watch)?;
    for accuracy in ACCURACIES {
        choices.push(choice_of(work, accuracy));
    }
    let chosen: Vec<Rung> = choices.iter().filter_map(|(_, rung)| rung.clone()).collect();
    let jobs: Vec<Asked> = chosen.iter().map(|rung| asked(work, rung)).collect();
    work.run("chosen runs", &jobs, watch)?;
    let (truth, reference) = reference::make(work, &rungs, range, watch)?;
    let rungs = [rungs, chosen].concat();
    let mut rows: Vec<Row> = rungs.iter().map(|rung| row_of(work, rung, &truth)).collect();
    let mut points: Vec<Point> = rows.iter().map(|row| row.point.clone()).collect();
    mark(&mut points);
    rows.iter_mut().zip(points).for_each(|(row, point)| row.point = point);
    let choices = choices.into_iter().map(|(choice, _)| placed(choice, &rows)).collect();
    Ok(CaseReport {
        schema: "msdd-case-report-1",
        case: scene.folder.file_name().unwrap_or_default().to_string_lossy().into_owned(),
        quick,
        made: work.settings.place.stamp.clone(),
        jobs: work.records.len(),
        cached_jobs: work.records.values().filter(|record| record.cached).count(),
        range: truth.range,
        points: scene.points.len(),
        times: truth.temperature.times.len(),
        reference,
        rows,
        choices,
    })
}

/// Range of T [K], which a run on few cells shows.
fn range(work: &mut Work, watch: &mut Watch) -> Result<f64, ReportError> {
    let settings = msdd_autotune::settings::Settings::new(level(work.scene, 2), 1e-3, false);
    let rung = Rung { range: None, ..Rung::new(work.scene, 0.0, settings) };
    let job = work.solver(&rung, work.limit());
    work.run("range of T", &[Asked { job: job.clone(), guess: 1.0 }], watch)?;
    let why = |work: &Work| {
        let record = work.record(&job);
        record.map_or("not run".to_string(), |record| {
            format!("{}: {}", record.outcome.as_str(), record.message)
        })
    };
    match work.measured(&job).map(|measured| measured.range) {
        Some(range) if range > 0.0 => Ok(range),
        Some(_) => Err(ReportError::Useless { problem: "T is the same everywhere and always".to_string() }),
        None => {
            Err(ReportError::Useless { problem: format!("it does not run on {}, {}", rung.name, why(work)) })
        }
    }
}

fn size(work: &Work, rung: &Rung) -> usize {
    ladder::count(work.scene, &rung.settings.levels)
}

/// Whether a run of the same kind on fewer cells, with steps that are no smaller, was stopped at its limit.
fn is_hopeless(work: &Work, rung: &Rung, rungs: &[Rung]) -> bool {
    let like = |other: &&Rung| {
        other.family == rung.family
            && other.settings.moves == rung.settings.moves
            && other.settings.tolerance >= rung.settings.tolerance
            && other.append == rung.append
            && size(work, other) < size(work, rung)
    };
    let stopped = |other: &Rung| {
        let record = work.record(&work.solver(other, work.limit()));
        record.is_some_and(|record| record.outcome == Outcome::TimedOut)
    };
    rungs.iter().filter(like).any(stopped)
}

/// A job of the ladder, with a guess of its cost from cells and steps.
fn asked(work: &Work, rung: &Rung) -> Asked {
    let Rung { settings, .. } = rung;
    let cells = size(work, rung) as f64;
    let steps = (1e-3 / settings.tolerance).cbrt() * if settings.moves { 4.0 } else { 1.0 };
    Asked { job: work.solver(rung, work.limit()), guess: 0.4 + 1e-4 * cells * steps }
}

fn choice_job(work: &Work, accuracy: f64) -> Job {
    work.job(CaseProgram::Choice(accuracy), work.limit())
}

/// The choice for an accuracy, and the configuration that it is.
fn choice_of(work: &Work, accuracy: f64) -> (Choice, Option<Rung>) {
    let record = work.record(&choice_job(work, accuracy));
    let read = record
        .filter(|record| record.outcome == Outcome::Done)
        .and_then(|record| serde_json::from_str::<record::Record>(record.file.as_deref()?).ok());
    let search_seconds = record.map_or(0.0, |record| record.cpu_seconds);
    let choice = |what, row, estimate| Choice {
        accuracy,
        what,
        row,
        estimate,
        search_seconds,
        sentence: String::new(),
    };
    let Some(read) = read else {
        let why = record.map_or("not run".to_string(), |record| record.message.clone());
        return (choice(why, None, None), None);
    };
    let found = &read.found;
    let warning = read.warning.as_ref().map_or(String::new(), |text| format!(" ({text})"));
    let what = sentence(&found.settings, work.scene, found.range) + &warning;
    // The chart's windows are those of the whole box.
    let mut settings = found.settings.clone();
    settings.halved.clear();
    let mut rung = Rung::new(work.scene, found.range, settings);
    let grains = if found.settings.moves { "grains move" } else { "grains stay" };
    (rung.name, rung.family) = (format!("for {accuracy} %: {}, {grains}", rung.name), FAMILIES[5]);
    (choice(what, Some(rung.name.clone()), Some(found.total())), Some(rung))
}

fn row_of(work: &Work, rung: &Rung, truth: &Truth) -> Row {
    let job = work.solver(rung, work.limit());
    let record = work.record(&job);
    let done = record.filter(|record| record.outcome == Outcome::Done);
    let measured = work.measured(&job);
    let errors = measured.as_ref().map_or(Errors::default(), |measured| truth.errors(measured));
    let message = match record {
        Some(_) if done.is_some() && errors.temperature.is_none() => {
            "none of its times is one of the reference's".to_string()
        }
        Some(record) => record.message.clone(),
        None if work.settings.run => "the same on fewer cells was stopped at its limit".to_string(),
        None => String::new(),
    };
    let point = Point {
        name: rung.name.clone(),
        family: rung.family.to_string(),
        core_seconds: done.map(|record| record.cpu_seconds),
        temperature_error: errors.temperature.map(|error| error.worst),
        pressure_error: errors.pressure.map(|error| error.worst),
        cost: if record.is_some_and(|record| record.cached) { "cached" } else { "measured" }.to_string(),
        outcome: record.map_or(Outcome::NotRun, |record| record.outcome).as_str().to_string(),
        message,
        front: [false; 2],
    };
    let wall_seconds = done.map(|record| record.wall_seconds);
    Row { point, cells: measured.map(|measured| measured.size), wall_seconds, errors }
}

/// The choice with the sentence on where it lies among the others.
fn placed(choice: Choice, rows: &[Row]) -> Choice {
    let Choice { accuracy, what, search_seconds, .. } = &choice;
    let row = choice.row.as_ref().and_then(|name| rows.iter().find(|row| row.point.name == *name));
    let others: Vec<Point> =
        rows.iter().map(|row| row.point.clone()).filter(|p| p.family != FAMILIES[5]).collect();
    let best = match cheapest(&others, *accuracy) {
        Some(point) => format!(
            "the cheapest of the other runs within {accuracy} % took {:.2} core-s ({}: {})",
            point.core_seconds.unwrap_or(f64::NAN),
            point.family,
            point.name
        ),
        None => format!("none of the other runs is within {accuracy} %"),
    };
    let sentence = match row {
        None => format!("For {accuracy} % msdd case solve chose nothing: {what}; {best}."),
        Some(row) => match row.point.place(0) {
            Some((cost, error)) => format!(
                "For {accuracy} % msdd case solve chose {what}. Its error is {error:.2} % ({:.2} % by its own estimate), it took \
                 {cost:.2} core-s after a search of {search_seconds:.2} core-s, and lies {} the front; {best}.",
                choice.estimate.unwrap_or(f64::NAN),
                if row.point.front[0] { "on" } else { "behind" }
            ),
            None => format!(
                "For {accuracy} % msdd case solve chose {what}, which is {}: {}; {best}.",
                row.point.outcome, row.point.message
            ),
        },
    };
    Choice { sentence, ..choice }
}
