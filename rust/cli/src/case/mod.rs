//! `msdd case`: makes and checks case folders of the solver.

mod ask;
mod check;
mod grain_wishes;
mod new;
mod solve;
mod sphere_wishes;
mod table;
mod wishes;

use crate::error::CliError;
use clap::Subcommand;
pub(crate) use new::checkout;
pub(crate) use solve::{attempt, beside};

#[derive(Subcommand)]
pub enum Command {
    /// Make a new case: asks for what is not given as an option, finds how the grains lie at the start, and writes a
    /// folder that is ready to run.
    New(Box<new::Arguments>),
    /// Check a case folder before the run: lists what is missing, out of range or doubtful.
    Check(check::Arguments),
    /// Find the cheapest settings of the solver for a wanted accuracy of T, by short runs on the case itself, and run them.
    Solve(solve::Arguments),
    /// Print a table that a function object has written, as one whole over all parts of the run.
    Table(table::Arguments),
}

pub fn run(command: &Command) -> Result<(), CliError> {
    match command {
        Command::New(arguments) => new::run(arguments),
        Command::Check(arguments) => check::run(arguments),
        Command::Solve(arguments) => solve::run(arguments),
        Command::Table(arguments) => table::run(arguments),
    }
}
