//! `msdd database check`.

use crate::error::CliError;
use clap::Args;
use msdd_rve::database::check::{Report, check};
use msdd_rve::database::inspect;
use std::path::PathBuf;

/// Note on a file of an older program, which is accepted.
const NO_CHECKSUMS: &str =
    "there are none, so damage that violates no exact law is not noticed; msdd database seal adds them";
/// Largest number of violations that are printed one by one.
const PRINTED: usize = 20;

#[derive(Args)]
pub struct Arguments {
    /// Database, or the CSV that was exported from one.
    #[arg(value_name = "FILE")]
    database: PathBuf,
}

pub fn run(arguments: &Arguments) -> Result<(), CliError> {
    let (dataset, damage) = inspect(&arguments.database)?;
    let report = check(&dataset);
    print(&report);
    let (file, count) = (arguments.database.display(), report.violations.len());
    for violation in report.violations.iter().take(PRINTED) {
        note!("violated: {violation}");
    }
    for problem in &damage {
        note!("damaged: {problem}");
    }
    if count > 0 || !damage.is_empty() {
        let damaged = if damage.is_empty() { "" } else { "is damaged: a checksum does not agree; " };
        return Err(CliError::Message(format!("{file}: {damaged}{count} violations of exact laws")));
    }
    outln!("checksums: {}", if dataset.has_checksum() { "agree" } else { NO_CHECKSUMS });
    outln!("exact laws: hold on all {} rows", report.rows);
    Ok(())
}

fn print(report: &Report) {
    outln!("Mirror symmetry: means over isotropic packings, 0 expected");
    for mean in &report.symmetry {
        outln!(
            "  {:>6} discs  {:<28} {:+.5} +- {:.5} ({} packings)",
            mean.discs,
            mean.quantity,
            mean.mean,
            mean.standard_error,
            mean.packings
        );
    }
    outln!("Size: packed states against those of the most frequent size, at equal porosity and fabric index");
    for size in &report.sizes {
        outln!(
            "  {:>6} / {} discs  {:<30} {:+.2} % +- {:.2} % ({} packings)",
            size.discs,
            size.base,
            size.quantity,
            100.0 * size.relative,
            100.0 * size.standard_error,
            size.packings
        );
    }
    outln!("Noise floor: scatter at equal initial porosity, initial fabric index and strain");
    outln!("   discs  output                       scatter   of all values' spread   best R2   states");
    for noise in &report.noise {
        outln!(
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
