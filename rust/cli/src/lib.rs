//! `msdd`: everything in multiscale data-driven simulation but the solver itself: cases, databases, models, references. The
//! only crate that parses arguments and prints.
#![forbid(unsafe_code)]

#[macro_use]
mod output;

mod bed;
mod case;
mod confirm;
mod database;
mod draw;
mod error;
mod named;
mod progress;
mod reference;
mod rve;
mod score;
mod simd;
mod spheres;
mod summary;
mod threads;
mod train;

use clap::{CommandFactory, Parser, Subcommand};
use std::process::ExitCode;

/// Version, and the commit that this program was built from.
const VERSION: &str = concat!(env!("CARGO_PKG_VERSION"), " (commit ", env!("MSDD_COMMIT"), ")");

const AFTER_HELP: &str = "\
A bed of spheres, from its description to a page of results:
  msdd case new store --spheres --shape cylinder --radius 0.25 --height 1 --flow 0.05 --flow-temperature 500 --yes
  store/Allrun
  msdd case show store --animate

A model of other grains:
  msdd database generate --plan cases/database/quick.toml --out results/quick
  msdd train --database results/quick --out results/model.json
then name the model in a case's constant/granularProperties and run msddFoam.";

/// Multiscale data-driven simulation of heat conduction with thermal expansion in granular media: everything but the solver
#[derive(Parser)]
#[command(name = "msdd", version = VERSION, after_help = AFTER_HELP, arg_required_else_help = true)]
struct Program {
    #[command(subcommand)]
    command: Command,
}

#[derive(Subcommand)]
enum Command {
    /// Make a case for the solver, check it, choose its settings, show its results.
    #[command(subcommand)]
    Case(case::Command),
    /// Generate and export databases of packed and expanded RVEs.
    #[command(subcommand)]
    Database(database::Command),
    /// Pack, expand and average a single RVE.
    #[command(subcommand)]
    Rve(rve::Command),
    /// Simulate a bed of spheres that was measured: pour, heat, compare.
    #[command(subcommand)]
    Bed(bed::Command),
    /// Simulate the whole box of a case by DEM: the reference that the solver is compared with.
    #[command(subcommand)]
    Reference(reference::Command),
    /// Train a surrogate model on a database, and print how good it is on packings that the training never saw.
    Train(train::Arguments),
    /// Measure the errors of a trained model on packings that were not used in its training: table, JSON, plots.
    ///
    /// Errors of thermal strains in one step and in many, and, for a model with a mechanical tangent, errors along the paths
    /// of strain of periodic boxes, by kind of path and number of grains.
    Score(score::Arguments),
    /// Compare the solver's results of the six cases with DEM: table, JSON and plot.
    Summary(summary::Arguments),
}

/// What examples share with the program.
pub mod shared {
    pub use crate::bed::foam::{files, probes};
    pub use crate::bed::geometry::Geometry;
    pub use crate::case::{attempt, beside, checkout};
    pub use crate::error::CliError;
    pub use crate::progress::Progress;
    pub use crate::rve::{read_state, write_state};
    pub use crate::simd::SimdArgument;
    pub use crate::threads::parser as threads_parser;
}

/// The description of all commands, for the book.
pub fn command() -> clap::Command {
    Program::command()
}

/// Runs the program with the arguments that it was called with.
pub fn run() -> ExitCode {
    // When the reader of a pipe, such as head, closes it, the program ends by the signal instead of a panic.
    sigpipe::reset();
    let result = match Program::parse().command {
        Command::Case(command) => case::run(&command),
        Command::Database(command) => database::run(&command),
        Command::Rve(command) => rve::run(&command),
        Command::Bed(command) => bed::run(&command),
        Command::Reference(command) => reference::run(&command),
        Command::Train(arguments) => train::run(&arguments),
        Command::Score(arguments) => score::run(&arguments),
        Command::Summary(arguments) => summary::run(&arguments),
    };
    let mut code = ExitCode::SUCCESS;
    for error in [result, output::finish()].into_iter().filter_map(Result::err) {
        note!("msdd: {error}");
        code = ExitCode::FAILURE;
    }
    code
}
