//! What is chosen for wanted accuracies in the reference scenes, and how far it is from the discs.

use crate::bands::{Done, Windows};
use crate::dem::SceneResults;
use msdd_autotune::ChoiceError;
use msdd_autotune::bands::Law;
use msdd_autotune::quantity::Quantity;
use msdd_autotune::runs::SearchTarget;
use msdd_autotune::search::find;
use msdd_autotune::settings::{Level, Settings};
use msdd_autotune::trial::{self, Outcome};
use msdd_autotune::user_case::UserCase;
use msdd_case::numbers::plain;
use msdd_cli::shared::{CliError, attempt, beside};
use msdd_files::{Column, Lock, names, write};
use msdd_report::studies::requests::{Request, Tally, tallies};
use std::fmt::Write as _;
use std::path::{Path, PathBuf};

/// Wanted accuracies [% of the range of T].
const ASKED: [f64; 3] = [5.0, 2.0, 1.0];
/// The run that stands for the exact solution of the model's equations: cells halved so often along each direction, and tolerance.
const FINE: (i32, f64) = (3, 1e-4);
/// Configurations among which the cheapest that would have done is looked for: halvings of the case's cells along each direction,
/// motion, and tolerance.
const HALVINGS: [i32; 4] = [2, 1, 0, -1];
const TOLERANCE: f64 = 1e-2;
const COLUMNS: [Column; 13] = [
    ("scene", "-", "name of the scene"),
    ("use", "-", "what it is for"),
    ("seed", "-", "of the packing"),
    ("asked", "%", "wanted accuracy"),
    ("best_offered", "%", "if the request was refused: the best accuracy that is possible"),
    ("estimate", "%", "estimated error, all together"),
    ("numerical_estimate", "%", "its part by steps, cells and grains that stay"),
    (
        "error_numerical",
        "%",
        "difference from a run with eight times the cells along each direction and a tolerance of 0.01 % of the range",
    ),
    (
        "error_discs",
        "%",
        "difference from the discs, means over the windows; of a refused request, the smallest of eight configurations",
    ),
    ("cells", "-", "cells of the chosen run"),
    ("processor_seconds", "s", "processor time of the chosen run"),
    ("search_seconds", "s", "wall time of the search"),
    (
        "cheapest_processor_seconds",
        "s",
        "processor time of the cheapest of these configurations and the chosen one whose difference from the discs is within the request",
    ),
];

/// Runs of one packing, each combination once.
struct Runs<'a> {
    scene: &'a UserCase,
    range: f64,
    folder: PathBuf,
    lock: Lock,
    done: Vec<(Settings, Outcome)>,
}

impl Runs<'_> {
    fn run(&mut self, settings: &Settings) -> Result<Outcome, ChoiceError> {
        if let Some((_, outcome)) = self.done.iter().find(|(known, _)| known == settings) {
            return Ok(outcome.clone());
        }
        let outcome = attempt(self.scene, settings, Some(self.range), &self.folder, &self.lock);
        trial::clear(&self.folder)?;
        let outcome = outcome?;
        self.done.push((settings.clone(), outcome.clone()));
        Ok(outcome)
    }
}

/// The discs' T in the windows by time.
struct Discs {
    windows: Windows,
    rows: Vec<(f64, Vec<f64>)>,
}

impl Discs {
    fn of(results: &SceneResults) -> Result<Self, CliError> {
        let windows = Windows::of(results)?;
        let column = |name: &str| results.windows.column(name).unwrap_or_default();
        let mut rows: Vec<(f64, Vec<f64>)> = Vec::new();
        for (time, value) in column("time").into_iter().zip(column("T")).filter(|row| row.0 > 0.0) {
            match rows.last_mut().filter(|last| last.0 == time) {
                Some(last) => last.1.push(value),
                None => rows.push((time, vec![value])),
            }
        }
        Ok(Self { windows, rows })
    }

    /// Root of the mean square of the difference of T [K] over windows and times.
    fn error(&self, run: &Outcome) -> f64 {
        let series = run.series(Quantity::Temperature);
        let mut squares = Vec::new();
        for (time, discs) in &self.rows {
            let Some(row) = series.at(*time) else { return f64::NAN };
            squares.extend(self.windows.means(row).iter().zip(discs).map(|(a, b)| (a - b).powi(2)));
        }
        (squares.iter().sum::<f64>() / squares.len() as f64).sqrt()
    }
}

/// Asks for [`ASKED`] in each scene, for its first packing, with these bands, and writes what came of it.
pub fn judge(all: &[Done], law: &Law, file: &Path) -> Result<(), CliError> {
    let failed = |error: ChoiceError| CliError::Message(error.to_string());
    println!("requests: {ASKED:?} % in {} scenes", all.len());
    let mut csv = names(&COLUMNS).join(",") + "\n";
    for (planned, packings) in all {
        let Some((results, folder)) = packings.first() else { continue };
        let discs = Discs::of(results)?;
        let mut scene = UserCase::read(folder).map_err(failed)?;
        let standard = scene.points.len();
        scene.points.extend(discs.windows.points(scene.points[0][2]));
        let range = planned.case()?.temperature_range();
        let folder = beside(&scene, "trial");
        let lock = Lock::take(&folder).map_err(|error| failed(error.into()))?;
        let mut runs = Runs { scene: &scene, range, folder, lock, done: Vec::new() };
        let count = scene.directions().len();
        let even = |halved: i32, tolerance: f64, moves: bool| {
            Settings::new(vec![Level::Halved(halved); count], tolerance, moves)
        };
        let fine = runs.run(&even(-FINE.0, FINE.1, true)).map_err(failed)?;
        let percent = |error: f64| 100.0 * error / range;
        let numerical = |run: &Outcome| {
            let mut difference =
                run.series(Quantity::Temperature).minus(fine.series(Quantity::Temperature), 1.0);
            difference.values.iter_mut().for_each(|row| row.truncate(standard));
            percent(difference.rms())
        };
        let mut others = Vec::new();
        for halved in HALVINGS {
            for moves in [false, true] {
                let run = runs.run(&even(halved, TOLERANCE, moves)).map_err(failed)?;
                others.push((percent(discs.error(&run)), run.processor));
            }
        }
        for asked in ASKED {
            let wishes = SearchTarget {
                accuracy: asked,
                pressure: None,
                cells: scene.directions(),
                mirrors: scene.mirrors(),
                moves: None,
                constant: scene.model.is_some(),
                bed: scene.bed.clone(),
                law: law.clone(),
            };
            let mut search_seconds = 0.0;
            let found = find(&wishes, &mut |settings: &Settings, _| {
                let outcome = runs.run(settings)?;
                search_seconds += outcome.seconds;
                Ok(outcome)
            });
            let head = format!("{},{},{},{asked}", planned.name, planned.purpose.as_str(), results.seed);
            match found {
                Ok((found, _)) => {
                    let run = runs.run(&found.settings).map_err(failed)?;
                    let own = (percent(discs.error(&run)), run.processor);
                    let enough = others.iter().chain([&own]).filter(|other| other.0 <= asked);
                    let cheapest = enough.map(|other| other.1).fold(f64::INFINITY, f64::min);
                    let estimate: f64 = found.shares.iter().map(|share| share.percent).sum();
                    let numbers = [
                        found.total(),
                        estimate,
                        numerical(&run),
                        own.0,
                        run.cells as f64,
                        run.processor,
                        search_seconds,
                    ];
                    let cheapest = if cheapest.is_finite() { plain(cheapest) } else { String::new() };
                    let texts: Vec<String> = numbers.into_iter().map(plain).collect();
                    let _ = writeln!(csv, "{head},,{},{cheapest}", texts.join(","));
                    println!(
                        "{:25} {asked} %: estimate {:.2} (numerical {estimate:.2}), true {:.2}, discs {:.2}",
                        planned.name,
                        found.total(),
                        numerical(&run),
                        own.0
                    );
                }
                Err(ChoiceError::OutOfReach { missed, reason }) => {
                    let best = missed.first().map_or(f64::NAN, |one| one.best);
                    let could = others.iter().map(|other| other.0).fold(f64::INFINITY, f64::min);
                    let _ = writeln!(csv, "{head},{},,,,{},,,,", plain(best), plain(could));
                    println!(
                        "{:25} {asked} %: refused, best {best:.2}; discs {could:.2}: {reason}",
                        planned.name
                    );
                }
                Err(error) => return Err(failed(error)),
            }
        }
        // Complete scenes are not lost when a later one fails.
        write(file, csv.as_bytes())?;
    }
    summary(file)
}

/// Prints the shares over the scenes of each kind.
fn summary(file: &Path) -> Result<(), CliError> {
    let requests: Vec<Request> =
        msdd_report::rows(file).map_err(|error| CliError::Message(error.to_string()))?;
    for tally in tallies(&requests) {
        let Tally { purpose, asked, kept, met, refused, possible, cost, highest_cost } = tally;
        let [median, most] = [cost, highest_cost].map(|cost| cost.unwrap_or(f64::NAN));
        println!(
            "{purpose:10} {asked:>2} %: within {met} of {kept}; refused {refused}, of which {possible} could have been done; cost over the cheapest {median:.2} in the median, {most:.2} at most"
        );
    }
    Ok(())
}
