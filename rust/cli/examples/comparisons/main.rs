//! Compares the solver with DEM in the scenes and beds of a plan, fits its error bands, and finds the ranges that were compared.
//! `cases/scenes/make`, `cases/beds/make` and `cases/common/compare-beds` run it.
//!
//! ```sh
//! cargo run --release -p msdd-cli --example comparisons -- scenes --help
//! ```

mod bands;
mod beds;
mod calibrate;
mod dem;
mod ranges;
mod requests;
mod scenes;
#[cfg(test)]
mod tests;

use clap::Parser;
use std::process::ExitCode;

#[derive(Parser)]
enum Command {
    /// Make the reference scenes of a plan, and compare the solver with them.
    Scenes(scenes::Arguments),
    /// Compare the solver with beds of spheres of a plan, packing by packing.
    ///
    /// Each run starts from the start of its DEM. Prints how far the solver is from them, and how far packings
    /// are from each other.
    Beds(beds::Arguments),
    /// Find the ranges of the scenes and beds by which the default models are compared with DEM.
    Ranges(ranges::Arguments),
}

fn main() -> ExitCode {
    let result = match Command::parse() {
        Command::Scenes(arguments) => scenes::run(&arguments),
        Command::Beds(arguments) => beds::run(&arguments),
        Command::Ranges(arguments) => ranges::run(&arguments),
    };
    let Err(error) = result else { return ExitCode::SUCCESS };
    eprintln!("comparisons: {error}");
    ExitCode::FAILURE
}
