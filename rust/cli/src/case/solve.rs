//! `msdd case solve`.

use crate::error::CliError;
use clap::Args;
use msdd_autotune::bands::Law;
use msdd_autotune::cells::ORDER;
use msdd_autotune::found::{Differences, Found, Share, Values, difference};
use msdd_autotune::interval;
use msdd_autotune::quantity::Quantity;
use msdd_autotune::record::{self, Record, sentence};
use msdd_autotune::runs::SearchTarget;
use msdd_autotune::search::{KEYS, find};
use msdd_autotune::settings::{Level, Settings};
use msdd_autotune::trial::{self, Outcome, Purpose};
use msdd_autotune::user_case::{ACCURACIES, UserCase};
use msdd_autotune::{ChoiceError, Missed};
use msdd_case::numbers::short;
use msdd_files::Lock;
use msdd_rve::message::number;
use std::path::{Path, PathBuf};
use std::time::Instant;

#[derive(Args)]
#[command(after_help = "msddFoam does the same when system/fvSolution says so:

    msddFoam { accuracy 1; }

Short runs on coarse meshes show what it changes to run half of a box that mirrors, to let the grains move, to take a constant
conductivity or larger steps, and to halve the cells along each direction of system/blockMeshDict. What the model and the scatter of packings leave open is estimated, too. The cheapest
combination that stays below the wanted accuracy is then run in the folder FOLDER.chosen next to the case, a complete case of its
own; its file choice.json and the key 'choice' of its summary.json hold what was tried, what it cost, and the estimates; bands.csv
holds 90 % bands of T, pressure, conductivity and displacement at points and times. A second call takes the choice without a
search, and goes on with a run that was killed.

The case needs its mesh (blockMesh). If constant/granularProperties names 'mechanics', it stays as named;
--choose-mechanics leaves it open. If the wanted accuracy cannot be reached, the best that can be reached is run, and a
warning says which it is and why.

Example: msdd case solve cases/HC --accuracy 1 --choose-mechanics")]
pub struct Arguments {
    /// The case folder, with its mesh.
    folder: PathBuf,
    /// Wanted accuracy of T [% of its range]. Allowed: 0.001 to 100. Default: `accuracy` of system/fvSolution.
    #[arg(long, value_name = "PERCENT", value_parser = percent)]
    accuracy: Option<f64>,
    /// Wanted accuracy of p [% of its range], in addition to T. Allowed: 0.001 to 100. Default: `pressureAccuracy` of
    /// system/fvSolution, if there is one.
    #[arg(long, value_name = "PERCENT", value_parser = percent)]
    pressure_accuracy: Option<f64>,
    /// Find out whether the grains have to move, whatever the case says.
    #[arg(long)]
    choose_mechanics: bool,
    /// Search again, even if the choice for this case and this accuracy exists.
    #[arg(long)]
    again: bool,
    /// Only search; do not run what was chosen.
    #[arg(long)]
    choose_only: bool,
}

/// A wanted accuracy [%].
fn percent(text: &str) -> Result<f64, String> {
    let [least, most] = ACCURACIES;
    let value = text.parse().ok().filter(|value: &f64| (least..=most).contains(value));
    value.ok_or_else(|| format!("allowed: {least} to {most} %"))
}

pub fn run(arguments: &Arguments) -> Result<(), CliError> {
    let failed = |error: ChoiceError| CliError::Message(error.to_string());
    let mut scene = UserCase::read(&arguments.folder).map_err(failed)?;
    if arguments.choose_mechanics {
        scene.moves = None;
    }
    let Some(accuracy) = arguments.accuracy.or(scene.accuracy) else {
        let file = scene.folder.join("system/fvSolution");
        return Err(CliError::Message(format!(
            "{}: msddFoam/accuracy = missing, allowed: {} to {} [% of the range of T]; or give --accuracy",
            file.display(),
            ACCURACIES[0],
            ACCURACIES[1]
        )));
    };
    super::check::report_or_note(&scene.folder)?;
    let wanted = Wanted { accuracy, pressure: arguments.pressure_accuracy.or(scene.pressure_accuracy) };
    solve(&scene, wanted, arguments).map_err(failed)
}

/// Wanted accuracies [% of the ranges of T and p].
#[derive(Clone, Copy)]
struct Wanted {
    accuracy: f64,
    pressure: Option<f64>,
}

/// A folder next to the case.
pub fn beside(scene: &UserCase, ending: &str) -> PathBuf {
    let name = scene.folder.file_name().unwrap_or_default().to_string_lossy();
    scene.folder.with_file_name(format!("{name}.{ending}"))
}

fn solve(scene: &UserCase, wanted: Wanted, arguments: &Arguments) -> Result<(), ChoiceError> {
    let accuracy = wanted.accuracy;
    let chosen = beside(scene, "chosen");
    let lock = Lock::take(&chosen)?;
    let mut checksum = scene.checksum()?;
    if arguments.choose_mechanics {
        checksum += ", mechanics open";
    }
    let earlier = Record::earlier(&chosen, &checksum, accuracy, wanted.pressure).filter(|_| !arguments.again);
    // Before a long search: neither folder may be somebody else's.
    trial::clear(&beside(scene, "trial"))?;
    let (mut record, seen) = match earlier {
        Some(earlier) => {
            outln!("The choice for this case and {} % exists: no search.", number(accuracy));
            earlier
        }
        None => {
            trial::check_ours(&chosen)?;
            let (record, seen) = search(scene, wanted, checksum, &lock)?;
            let range = Some(record.found.range).filter(|&range| range > 0.0);
            trial::make(scene, &record.found.settings, range, Purpose::Chosen, &chosen)?;
            record::write_seen(&seen, &chosen)?;
            record.write(scene, &chosen)?;
            (record, seen)
        }
    };
    outln!("\n{}", record.text(scene).trim_end());
    if arguments.choose_only {
        return Ok(());
    }
    if record.run_seconds.is_some() {
        outln!("\nThe run is complete: {}", chosen.display());
        return Ok(());
    }
    outln!("\nRunning it in {} ...", chosen.display());
    let outcome = trial::run(scene, &record.found.settings, &chosen, &lock)?;
    let mut space = Values::new();
    if record.found.range > 0.0
        && let Some((half, ratio)) = half(scene, &record, &lock)?
    {
        // The error of the finer of two runs whose cells differ by this factor.
        space = difference(&outcome, &half, 1.0 / (ratio.powi(ORDER) - 1.0));
        let percent = 100.0 * space[&Quantity::Temperature].rms() / record.found.range;
        let how = format!("the chosen run and one with cells {ratio:.3} times as large along each direction");
        record.checked = Some(Share { source: "cells, checked".to_string(), percent, how });
    }
    let bands = interval::bands(scene, &outcome, &seen, &space, &Law::shipped(scene.bed.kind));
    interval::write_table(scene, &bands, outcome.beyond.as_ref(), &chosen)?;
    record.bands = interval::means(&bands);
    record.beyond.clone_from(&outcome.beyond);
    record.run_warnings.clone_from(&outcome.warnings);
    record.run_seconds = Some(outcome.seconds);
    record.write(scene, &chosen)?;
    record.add_to_summary(&chosen)?;
    outln!("Done in {:.1} s, after {:.1} s of search.", outcome.seconds, record.search_seconds);
    if let Some(share) = &record.checked {
        outln!("Error of the cells by {}: {:.3} % of the range of T.", share.how, share.percent);
    }
    outln!(
        "\n{}At each point and time: {}.\n{}",
        interval::text(&record.bands, record.beyond.as_ref()),
        chosen.join(interval::FILE).display(),
        record.warnings().trim_end()
    );
    Ok(())
}

/// How often a search is repeated with the best accuracy that the one before has offered.
const REPEATS: usize = 2;

/// Searches for the wanted accuracy, or else for the best that can be had.
fn search(
    scene: &UserCase,
    wanted: Wanted,
    checksum: String,
    lock: &Lock,
) -> Result<(Record, Differences), ChoiceError> {
    let began = Instant::now();
    let (mut within, mut warning) = (wanted, None);
    let mut found = search_once(scene, within, lock);
    for _ in 0..REPEATS {
        let Err(ChoiceError::OutOfReach { missed, reason }) = &found else { break };
        within = within.at_best(missed);
        let best: Vec<String> = missed.iter().map(|one| wanted.instead(one)).collect();
        let text = format!("{}: {reason}", best.join("; "));
        outln!("{text}.");
        warning = Some(text);
        found = search_once(scene, within, lock);
    }
    let (found, seen) = found?;
    let record = Record {
        accuracy: wanted.accuracy,
        pressure_accuracy: wanted.pressure,
        warning,
        checksum,
        found,
        search_seconds: began.elapsed().as_secs_f64(),
        run_seconds: None,
        checked: None,
        bands: Vec::new(),
        beyond: None,
        run_warnings: Vec::new(),
    };
    Ok((record, seen))
}

impl Wanted {
    /// What was wanted, with the best of what cannot be had.
    fn at_best(self, missed: &[Missed]) -> Self {
        let best = |key: &str| missed.iter().find(|one| one.key == key).map(|one| one.best);
        Self { accuracy: best(KEYS[0]).unwrap_or(self.accuracy), pressure: best(KEYS[1]).or(self.pressure) }
    }

    /// What is run instead of an accuracy that cannot be had.
    fn instead(self, missed: &Missed) -> String {
        let (asked, name) = match missed.key == KEYS[0] {
            true => (self.accuracy, "T"),
            false => (self.pressure.unwrap_or(missed.asked), "p"),
        };
        format!(
            "{asked} % of the range of {name} was requested; {:.2} % is the best that can be reached",
            missed.best
        )
    }
}

fn search_once(scene: &UserCase, wanted: Wanted, lock: &Lock) -> Result<(Found, Differences), ChoiceError> {
    let Wanted { accuracy, pressure } = wanted;
    let (bed, law) = (scene.bed.clone(), Law::shipped(scene.bed.kind));
    let wishes = SearchTarget {
        accuracy,
        pressure,
        cells: scene.directions(),
        mirrors: scene.mirrors(),
        moves: scene.moves,
        constant: scene.model.is_some(),
        bed,
        law,
    };
    let folder = beside(scene, "trial");
    let also =
        pressure.map_or(String::new(), |percent| format!(", and of p of at most {} %", short(percent)));
    outln!(
        "Looking for the cheapest run with an error of T of at most {} % of its range{also}:",
        short(accuracy)
    );
    let found = find(&wishes, &mut |settings: &Settings, range| {
        let outcome = attempt(scene, settings, range, &folder, lock);
        match &outcome {
            Ok(done) => {
                outln!("  {:6.2} s  {}", done.seconds, sentence(settings, scene, range.unwrap_or(0.0)))
            }
            Err(error) => outln!("   failed  {}: {error}", sentence(settings, scene, range.unwrap_or(0.0))),
        }
        outcome
    });
    trial::clear(&folder)?;
    found
}

/// Makes the case of a combination in a folder, and runs it.
pub fn attempt(
    scene: &UserCase,
    settings: &Settings,
    range: Option<f64>,
    folder: &Path,
    lock: &Lock,
) -> Result<Outcome, ChoiceError> {
    let began = Instant::now();
    trial::make(scene, settings, range, Purpose::Trial, folder)?;
    let outcome = trial::run(scene, settings, folder, lock)?;
    Ok(Outcome { seconds: began.elapsed().as_secs_f64(), ..outcome })
}

/// A run with about half the cells along each direction of the chosen one, if there can be fewer, and by what factor they are fewer along
/// that of the directions where it is least.
fn half(scene: &UserCase, record: &Record, lock: &Lock) -> Result<Option<(Outcome, f64)>, ChoiceError> {
    let settings = &record.found.settings;
    let cells = scene.directions();
    let coarser =
        |(k, &level): (usize, &Level)| level.coarser(settings.own_cells(k, cells[k])).unwrap_or(level);
    let levels: Vec<Level> = settings.levels.iter().enumerate().map(coarser).collect();
    let own = |k: usize| settings.own_cells(k, cells[k]);
    let ratios = (0..levels.len())
        .map(|k| settings.levels[k].cells(own(k)) as f64 / levels[k].cells(own(k)) as f64)
        .filter(|&ratio| ratio > 1.0);
    let ratio = ratios.fold(f64::INFINITY, f64::min);
    if ratio.is_infinite() {
        return Ok(None);
    }
    let half = Settings { levels, ..settings.clone() };
    let folder = beside(scene, "trial");
    let other = attempt(scene, &half, Some(record.found.range), &folder, lock);
    trial::clear(&folder)?;
    other.map(|other| Some((other, ratio)))
}
