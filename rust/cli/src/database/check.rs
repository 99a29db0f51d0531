//! `msdd database check`.

use crate::error::CliError;
use clap::Args;
use msdd_rve::database::check::{Report, check};
use msdd_rve::database::read;
use std::path::PathBuf;

/// Violations that are printed one by one.
const PRINTED: usize = 20;

#[derive(Args)]
pub struct Arguments {
    /// Database, or the CSV that was exported from one.
    #[arg(value_name = "FILE")]
    database: PathBuf,
}

pub fn run(arguments: &Arguments) -> Result<(), CliError> {
    let report = check(&read(&arguments.database)?);
    print(&report);
    let count = report.violations.len();
    for violation in report.violations.iter().take(PRINTED) {
        eprintln!("violated: {}: {}: {}", violation.row, violation.law, violation.found);
    }
    if count > 0 {
        let file = arguments.database.display();
        return Err(CliError::Message(format!("{file}: {count} violations of exact laws")));
    }
    println!("exact laws: hold on all {} rows", report.rows);
    Ok(())
}

fn print(report: &Report) {
    println!("Mirror symmetry: means over isotropic packings, 0 expected");
    for mean in &report.symmetry {
        println!(
            "  {:>6} discs  {:<28} {:+.5} +- {:.5} ({} packings)",
            mean.discs, mean.quantity, mean.mean, mean.standard_error, mean.packings
        );
    }
    println!(
        "Size: packed states against those of the most frequent size, at equal porosity and fabric index"
    );
    for size in &report.sizes {
        println!(
            "  {:>6} / {} discs  {:<30} {:+.2} % +- {:.2} % ({} packings)",
            size.discs,
            size.base,
            size.quantity,
            100.0 * size.relative,
            100.0 * size.standard_error,
            size.packings
        );
    }
    println!("Noise floor: scatter at equal initial porosity, initial fabric index and strain");
    println!("   discs  output                       scatter   of all values' spread   best R2   states");
    for noise in &report.noise {
        println!(
            "  {:>6}  {:<26} {:>9.2e} {:>20.2} % {:>11.4} {:>8}",
            noise.discs,
            noise.output,
            noise.deviation,
            100.0 * noise.share,
            1.0 - noise.share * noise.share,
            noise.states
        );
    }
}
