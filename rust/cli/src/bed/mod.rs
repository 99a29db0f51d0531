//! `msdd bed`: beds of spheres that were measured.

mod arguments;
mod files;
pub(crate) mod foam;
mod from_case;
pub(crate) mod geometry;
mod law;
mod moving;
mod plot;
mod results;
mod slack;
mod table;

use crate::error::CliError;
use arguments::RunArguments;
use clap::Subcommand;
use msdd_beds::case::{BedCase, CaseError, Vary, file_in};
use msdd_beds::experiment::{self, Measured};
use msdd_files::{check_writable, write};
use std::path::{Path, PathBuf};

#[derive(Subcommand)]
pub enum Command {
    /// Pour a bed of equal spheres, press and turn it, heat it, and compare its temperatures with measured ones.
    Run(RunArguments),
    /// Write a case folder of the solver for the bed of a bed.toml.
    ///
    /// Walls, heating, lid and shell are those of the file. Fixed or moved plates have a slack of 1 diameter, of which a tenth
    /// is recovered (slackLayer, slackRecovery): the mean of the beds that were measured, for any friction of the plates. `msdd bed slack`
    /// measures it for this bed. Fixed walls have the friction of a bed for wall_friction.
    Case(foam::Arguments),
    /// Write the bed.toml of a case of the solver with spheres, for `msdd bed run`.
    ///
    /// The reverse of `msdd bed case`: box or cylinder, spheres, gas, walls with a temperature, gravity, lid, shell and
    /// friction of walls. Heat from inside and other conditions of walls are left out and named.
    FromCase(from_case::Arguments),
    /// Measure the slack of spheres next to plates, from results of `msdd bed run --packings`.
    ///
    /// It is what the plates have moved towards each other beyond the strain inside times the depth, over the strain inside
    /// without the own growth of the spheres. The numbers are valid for the depth between the plates; where a mesh is less
    /// deep, its walls take them times its depth over that one.
    #[command(alias = "give")]
    Slack(slack::Arguments),
    /// Follow the law of spheres alone along the strain that 'msdd bed run' recorded, and compare its pressure with the spheres'.
    Law(law::Arguments),
}

pub fn run(command: &Command) -> Result<(), CliError> {
    match command {
        Command::Run(arguments) => run_case(arguments),
        Command::Case(arguments) => foam::run(arguments),
        Command::FromCase(arguments) => from_case::run(arguments),
        Command::Slack(arguments) => slack::run(arguments),
        Command::Law(arguments) => law::run(arguments),
    }
}

fn run_case(arguments: &RunArguments) -> Result<(), CliError> {
    let folder = &arguments.case;
    let mut case = BedCase::read(folder)?;
    if case.plate.is_none() {
        return run_moving(arguments);
    }
    if arguments.packings.is_some() {
        return Err(CliError::Message("--packings, allowed: of a bed without a plate".to_string()));
    }
    if let Some(seed) = arguments.seed {
        case.seed = seed;
    }
    let measured = measurements(folder, &case)?;
    let out = results_folder(arguments);
    let vary: &[Vary] = if arguments.vary { &case.vary } else { &[] };
    let vary = vary.iter().map(|vary| Ok((vary.clone(), case.varied(folder, vary)?)));
    let vary = vary.collect::<Result<_, CaseError>>()?;
    for file in files::NAMES {
        check_writable(&out.join(file))?;
    }
    let failed = |source| CliError::Bed { file: file_in(folder), source };
    let threads = arguments.threads as usize;
    let results = results::compute(case, vary, measured, threads, failed, |results| {
        // All files at first; then what one value changes is added to one of them.
        let written = if results.varied.is_empty() {
            files::NAMES.into_iter().zip(files::texts(results)?).collect()
        } else {
            vec![(files::NAMES[1], files::comparison(results))]
        };
        for (file, text) in written {
            write(&out.join(file), text.as_bytes())?;
        }
        Ok(())
    })?;
    table::print(&results);
    outln!("results: {}", out.display());
    Ok(())
}

/// That of `--out`, or one with the name of the case, also if it is given as `.`.
fn results_folder(arguments: &RunArguments) -> PathBuf {
    arguments.out.clone().unwrap_or_else(|| {
        let whole = arguments.case.canonicalize().unwrap_or_else(|_| arguments.case.clone());
        Path::new("results/beds").join(whole.file_name().unwrap_or("bed".as_ref()))
    })
}

fn run_moving(arguments: &RunArguments) -> Result<(), CliError> {
    if arguments.vary {
        return Err(CliError::Message("--vary, allowed: of a bed with a plate".to_string()));
    }
    let out = results_folder(arguments);
    match arguments.packings {
        Some(count) => moving::compute_packings(arguments, count, &out),
        None => moving::compute(arguments, &out),
    }
}

/// The measurements of a case; none without an experiment.
fn measurements(folder: &Path, case: &BedCase) -> Result<Vec<Measured>, CliError> {
    let Some(experiment) = &case.experiment else { return Ok(Vec::new()) };
    let file = folder.join(&experiment.file);
    let measured = experiment::read(&file)?;
    experiment::check(&file, &measured, &case.record.distances)?;
    Ok(measured)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn results_have_the_name_of_the_case_however_it_is_given() {
        let folder = |case: &str, out: Option<&str>| {
            let (case, out) = (case.into(), out.map(PathBuf::from));
            results_folder(&RunArguments {
                case,
                out,
                seed: None,
                packings: None,
                vary: false,
                yes: false,
                threads: 1,
            })
        };
        let here = std::env::current_dir().unwrap();
        let expected = Path::new("results/beds").join(here.file_name().unwrap());
        for case in [".", "src/..", here.to_str().unwrap()] {
            assert_eq!(folder(case, None), expected, "{case}");
        }
        assert_eq!(folder("no/such/case", None), Path::new("results/beds/case"));
        assert_eq!(folder(".", Some("there")), Path::new("there"));
    }
}
