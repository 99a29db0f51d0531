//! `msdd case`: makes and checks case folders of the solver.

mod check;
mod common_options;
mod disc_options;
mod new;
mod prompts;
mod show;
mod solve;
mod sphere_options;
mod table;

use crate::error::CliError;
use clap::Subcommand;
pub use new::checkout;
pub use solve::{attempt, beside};

#[derive(Subcommand)]
pub enum Command {
    /// Make a new case: prompts for options that are not given, finds the initial packing, and writes a folder that is ready to
    /// run.
    ///
    /// The bed is of discs in the plane, packed by DEM, or, with --spheres, of spheres with gas between them. These fill
    /// a box, or an upright cylinder, which is computed as a wedge.
    ///
    /// The initial state of spheres follows from the law of spheres, for a bed that was poured and pressed from above: the
    /// horizontal stress is 0.8 of the vertical one, there are 0.4 contacts per sphere more than in a periodic box, and more
    /// of them point upwards (fabric 0.35 instead of 1/3). The law is valid for a friction of 0.3. There is gravity, and
    /// walls have the friction of a sphere, 0.3. All walls are rigid but a top that presses and a side that is a shell.
    ///
    /// The bed begins at rest under its weight, of which rough walls carry a part (restStress). Walls that heat passes have the
    /// resistance between wall and spheres, unless --wall-material none.
    New(Box<new::Arguments>),
    /// Check a case folder before the run: lists errors and warnings.
    Check(check::Arguments),
    /// Choose mesh, time step and grain motion for a target accuracy of T, by short runs on the case itself, and run with them.
    ///
    /// The results, with 90 % bands, are in the folder FOLDER.chosen.
    Solve(solve::Arguments),
    /// Show the results of a run: writes a page with key numbers, maps, curves and the end of its log.
    Show(show::Arguments),
    /// Print a table that a function object has written, as one whole over all parts of the run. The exit status is 1 if
    /// there is no such table, or if parts have other points or columns.
    Table(table::Arguments),
}

pub fn run(command: &Command) -> Result<(), CliError> {
    match command {
        Command::New(arguments) => new::run(arguments),
        Command::Check(arguments) => check::run(arguments),
        Command::Solve(arguments) => solve::run(arguments),
        Command::Show(arguments) => show::run(arguments),
        Command::Table(arguments) => table::run(arguments),
    }
}
