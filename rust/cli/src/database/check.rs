//! `msdd database check`.

use crate::error::CliError;
use clap::Args;
use msdd_rve::database::check::{Mean, check};
use msdd_rve::database::spheres::check::TwinDifference;
use msdd_rve::database::{Dataset, Grains, Record, SphereRecord, Violation, grains, inspect, spheres};
use std::path::{Path, PathBuf};

/// Largest number of violations that are printed one by one.
const PRINTED: usize = 20;

#[derive(Args)]
pub struct Arguments {
    /// Database, or the CSV that was exported from one.
    #[arg(value_name = "FILE")]
    database: PathBuf,
}

pub fn run(arguments: &Arguments) -> Result<(), CliError> {
    let path = &arguments.database;
    match grains(path)? {
        Grains::Discs => {
            let dataset = inspect::<Record>(path)?;
            let report = check(&dataset);
            print_symmetry(&report.symmetry);
            verdict(path, &dataset, &report.violations)
        }
        Grains::Spheres => {
            let dataset = inspect::<SphereRecord>(path)?;
            let report = spheres::check::check(&dataset);
            print_symmetry(&report.symmetry);
            print_twins(&report.twins);
            verdict(path, &dataset, &report.violations)
        }
    }
}

/// Prints violated laws, which are an error.
fn verdict<R>(path: &Path, dataset: &Dataset<R>, violations: &[Violation]) -> Result<(), CliError> {
    let (file, count) = (path.display(), violations.len());
    for violation in violations.iter().take(PRINTED) {
        note!("violated: {violation}");
    }
    if count > 0 {
        return Err(CliError::Message(format!("{file}: {count} violations of exact laws")));
    }
    outln!("exact laws: hold on all {} rows", dataset.records.len());
    Ok(())
}

fn print_twins(twins: &[TwinDifference]) {
    outln!("Twins: differences between packings that are equal by symmetry, of settled pairs");
    for twin in twins {
        let what = if twin.turned { "axes with other names" } else { "grown radii, shrunk box" };
        outln!(
            "  {:<24} {:<25} median {:.1e}, largest {:.1e} ({} pairs)",
            what,
            twin.quantity,
            twin.median,
            twin.largest,
            twin.pairs
        );
    }
}

fn print_symmetry(means: &[Mean]) {
    outln!("Mirror symmetry: means over isotropic packings, 0 expected");
    for mean in means {
        outln!(
            "  {:>6} {:<7} {:<28} {:+.5} +- {:.5} ({} packings)",
            mean.count,
            mean.grains,
            mean.quantity,
            mean.mean,
            mean.standard_error,
            mean.packings
        );
    }
}
