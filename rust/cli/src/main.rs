//! `msdd`: the offline work of multiscale data-driven simulation. The only place that parses arguments and prints.
#![forbid(unsafe_code)]

#[macro_use]
mod output;

mod ablation;
mod bench;
mod case;
mod database;
mod draw;
mod error;
mod progress;
mod reference;
mod report;
mod rows;
mod rve;
mod score;
mod simd;
mod summary;
mod threads;
mod train;

use clap::{Parser, Subcommand};
use std::process::ExitCode;

/// Version, and the commit that this was built from.
const VERSION: &str = concat!(env!("CARGO_PKG_VERSION"), " (commit ", env!("MSDD_COMMIT"), ")");

const AFTER_HELP: &str = "\
The way of the data:
  msdd database generate --plan cases/database/quick.toml --out results/quick.msdd
  msdd train --database results/quick.msdd --out results/model.json
then name the model in a case's constant/granularProperties, run msddFoam, and
  msdd summary --cases cases --out results/summary.json --plot results/temperature.svg";

/// Multiscale data-driven simulation of heat conduction with thermal expansion in granular media: the offline work.
#[derive(Parser)]
#[command(name = "msdd", version = VERSION, after_help = AFTER_HELP, arg_required_else_help = true)]
struct Program {
    #[command(subcommand)]
    command: Command,
}

#[derive(Subcommand)]
enum Command {
    /// Begin a case of your own, or check one before it runs.
    #[command(subcommand)]
    Case(case::Command),
    /// Generate and export databases of packed and expanded RVEs.
    #[command(subcommand)]
    Database(database::Command),
    /// Pack, expand and average a single RVE.
    #[command(subcommand)]
    Rve(rve::Command),
    /// The box of a case by discrete elements: the reference that the solver is compared with.
    #[command(subcommand)]
    Reference(reference::Command),
    /// Measure speed; prints JSON.
    #[command(subcommand)]
    Bench(bench::Command),
    /// Train the surrogate on a database.
    Train(train::Arguments),
    /// Judge a trained model on packings that it never saw: table, JSON, plots.
    Score(score::Arguments),
    /// What each input of the networks is worth: trains them without it.
    Ablation(ablation::Arguments),
    /// Speed against accuracy: runs what is missing, writes a page and its figures.
    Report(report::Arguments),
    /// Table, JSON and plot of solver results.
    Summary(summary::Arguments),
}

fn main() -> ExitCode {
    // A reader that closes the pipe, such as head, ends the program instead of making it panic.
    sigpipe::reset();
    let result = match Program::parse().command {
        Command::Case(command) => case::run(&command),
        Command::Database(command) => database::run(&command),
        Command::Rve(command) => rve::run(&command),
        Command::Reference(command) => reference::run(&command),
        Command::Bench(command) => bench::run(&command),
        Command::Train(arguments) => train::run(&arguments),
        Command::Score(arguments) => score::run(&arguments),
        Command::Ablation(arguments) => ablation::run(&arguments),
        Command::Report(arguments) => report::run(&arguments),
        Command::Summary(arguments) => summary::run(&arguments),
    };
    let mut code = ExitCode::SUCCESS;
    for error in [result, output::finish()].into_iter().filter_map(Result::err) {
        note!("msdd: {error}");
        code = ExitCode::FAILURE;
    }
    code
}
