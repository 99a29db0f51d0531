//! `msdd reference compare`: temperatures of a run of the solver compared with DEM.

use crate::error::CliError;
use clap::Args;
use msdd_case::Case;
use msdd_dem_reference::compare::{check_grains, check_points, temperature_errors};
use msdd_dem_reference::results::Results;
use msdd_dem_reference::solver::{probe_points, probe_rows};
use msdd_dem_reference::start::InitialMeans;
use msdd_rve::message::number;
use std::path::PathBuf;

#[derive(Args)]
#[command(after_help = "Example, after cases/corner/Allrun:
  msdd reference compare --case cases/corner --discs cases/reference/results/corner_seed11.json
The case needs the function object spaceProbes, which the shipped cases have.")]
pub struct Arguments {
    /// Case folder in which msddFoam has run.
    #[arg(long, value_name = "DIR")]
    case: PathBuf,
    /// Result of `msdd reference run` for the same case.
    #[arg(long, value_name = "FILE")]
    discs: PathBuf,
}

/// The range of temperatures of the case [K].
fn range_of(case: &Case) -> Result<f64, CliError> {
    let range = case.temperature_range();
    if range > 0.0 {
        return Ok(range);
    }
    let problem = "all walls and the start have one temperature";
    Err(CliError::Message(format!("{}: {problem}", case.folder.display())))
}

/// Prints the largest difference over time at each probe, and the largest absolute value of all probes.
pub fn run(arguments: &Arguments) -> Result<(), CliError> {
    let discs = Results::read(&arguments.discs)?;
    let case = Case::read(&arguments.case)?;
    check_grains(&case, &discs)?;
    check_points(&probe_points(&arguments.case)?, &discs)?;
    let solver = probe_rows(&arguments.case)?;
    let range = range_of(&case)?;
    if let Some(difference) = InitialMeans::of(&case)?.and_then(|start| start.difference(&discs.model)) {
        outln!("Warning: {difference}");
    }
    let errors = temperature_errors(&solver, &discs, range)?;
    outln!(
        "T of the solver minus T of the discs, means in windows of {} mm, where they differ most",
        number(1e3 * discs.probe_window)
    );
    for (probe, error) in (1..).zip(&errors) {
        outln!("P{probe} {error:+.3} % of {} K", number(range));
    }
    outln!("largest {:.3} %", errors.iter().map(|error| error.abs()).fold(0.0, f64::max));
    Ok(())
}
