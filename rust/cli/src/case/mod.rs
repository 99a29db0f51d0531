//! `msdd case`: case folders of the solver, begun and checked.

mod ask;
mod check;
mod grain_wishes;
mod new;
mod wishes;

use crate::error::CliError;
use clap::Subcommand;

#[derive(Subcommand)]
pub enum Command {
    /// Begin a case of your own: asks for what is not given, packs grains, writes a folder that runs.
    New(Box<new::Arguments>),
    /// Say before a run what is missing, out of range or doubtful in a case folder.
    Check(check::Arguments),
}

pub fn run(command: &Command) -> Result<(), CliError> {
    match command {
        Command::New(arguments) => new::run(arguments),
        Command::Check(arguments) => check::run(arguments),
    }
}
