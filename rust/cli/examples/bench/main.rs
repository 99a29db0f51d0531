//! Measures speed, stability limits and rates, for `scripts/results`, `scripts/report` and `scripts/compare-engines`.
//!
//! ```sh
//! cargo run --release -p msdd-cli --example bench -- dem --help
//! ```

mod dem;
mod inference;
mod limits;
mod stability;

use clap::Parser;
use std::process::ExitCode;

#[derive(Parser)]
enum Command {
    /// Time of a step of the discrete element engine.
    Dem(dem::Arguments),
    /// Largest stable mechanical and thermal time steps: predicted by the bounds, and measured.
    Stability(stability::Arguments),
    /// How slowly RVEs have to be packed and strained, how well forces have to balance, and how models follow as contacts open.
    Limits(limits::Arguments),
    /// Time that a surrogate model needs for a step of one cell, by size of the batch.
    Inference(inference::Arguments),
}

fn main() -> ExitCode {
    let result = match Command::parse() {
        Command::Dem(arguments) => dem::run(&arguments),
        Command::Stability(arguments) => stability::run(&arguments),
        Command::Limits(arguments) => limits::run(&arguments),
        Command::Inference(arguments) => inference::run(&arguments),
    };
    let Err(error) = result else { return ExitCode::SUCCESS };
    eprintln!("bench: {error}");
    ExitCode::FAILURE
}
