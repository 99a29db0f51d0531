//! `msdd database`.

mod check;
mod plot;
mod timing;
mod warning;

pub use warning::warn_without_checksum;

use crate::error::CliError;
use crate::progress::Progress;
use crate::simd::SimdArgument;
use clap::{Args, Subcommand};
use msdd_files::{check_target, read_text, write};
use msdd_rve::database::{Effort, Offenders, Plan, Run, Shard, export_csv, generate, merge, read, seal};
use std::collections::BTreeMap;
use std::ops::ControlFlow;
use std::path::PathBuf;
use std::time::Instant;

#[derive(Subcommand)]
pub enum Command {
    /// Make the RVEs of a plan, or go on where an earlier run stopped.
    Generate(GenerateArguments),
    /// Join the shards of a plan: the file that one process would have made.
    Merge(MergeArguments),
    /// Write a database as CSV, with FILE.columns.csv (units, meaning) and FILE.provenance.json beside it.
    Export(ExportArguments),
    /// Check checksums, and exact laws on every row; print symmetry, size effects and noise floor. Status 1 when a checksum
    /// does not agree or a law is violated.
    Check(check::Arguments),
    /// Give a database or CSV of an older program its checksums, if all laws hold on its rows.
    Seal(SealArguments),
    /// Plan RVEs around the states that a solver asked about outside a model's range.
    Plan(PlanArguments),
    /// Draw the inputs with their hulls, and K and sigma against porosity.
    Plot(plot::Arguments),
}

#[derive(Args)]
pub struct GenerateArguments {
    /// What to make (TOML); see cases/database.
    #[arg(long, value_name = "FILE")]
    plan: PathBuf,
    /// The database (SQLite); an existing one of the same plan is completed.
    #[arg(long, value_name = "FILE")]
    out: PathBuf,
    /// Threads; the rows do not depend on it. Default: all cores.
    #[arg(long, value_parser = crate::threads::parser())]
    threads: Option<u32>,
    /// Part of the plan, as 3/16; `merge` joins the parts.
    #[arg(long, value_name = "NUMBER/COUNT", default_value_t)]
    shard: Shard,
    /// Commit of this program, for the provenance; default: the one it was built from.
    #[arg(long, value_name = "TEXT")]
    commit: Option<String>,
    /// JSON to write: where the time went.
    #[arg(long, value_name = "FILE")]
    timing: Option<PathBuf>,
    #[command(flatten)]
    simd: SimdArgument,
}

#[derive(Args)]
#[command(
    after_help = "Then generate the plan, and train on both: msdd train --database OLD --database NEW --out MODEL"
)]
pub struct PlanArguments {
    /// Cells outside the range, as msddFoam writes them to postProcessing/msddFoam/offenders.json.
    #[arg(long, value_name = "FILE")]
    from: PathBuf,
    /// The plan of the model's database: radii and material are taken from it.
    #[arg(long, value_name = "FILE")]
    like: PathBuf,
    /// The plan (TOML) to write.
    #[arg(long, value_name = "FILE")]
    out: PathBuf,
    /// Discs in a packing.
    #[arg(long, default_value_t = 500)]
    discs: usize,
    /// Packings for each porosity and kind of compression.
    #[arg(long, default_value_t = 4)]
    repeats: u32,
}

#[derive(Args)]
pub struct MergeArguments {
    /// The databases of all shards.
    #[arg(value_name = "DATABASE", required = true)]
    shards: Vec<PathBuf>,
    /// The database to write.
    #[arg(long, value_name = "FILE")]
    out: PathBuf,
}

#[derive(Args)]
pub struct SealArguments {
    /// Database, or the CSV that was exported from one; of the latter, FILE.provenance.json alone is written.
    #[arg(value_name = "FILE")]
    database: PathBuf,
}

#[derive(Args)]
pub struct ExportArguments {
    /// The database.
    #[arg(value_name = "FILE")]
    database: PathBuf,
    /// The CSV file; compressed when it ends in .gz.
    #[arg(long, value_name = "FILE")]
    out: PathBuf,
    /// Significant digits of floats; default: all, so that they read back exactly.
    #[arg(long, value_parser = clap::value_parser!(u8).range(3..=17))]
    digits: Option<u8>,
}

pub fn run(command: &Command) -> Result<(), CliError> {
    match command {
        Command::Generate(arguments) => make(arguments),
        Command::Merge(arguments) => {
            warn_without_checksum(&arguments.shards)?;
            let rows = merge(&arguments.shards, &arguments.out)?;
            outln!("{rows} rows in {}", arguments.out.display());
            Ok(())
        }
        Command::Export(arguments) => {
            warn_without_checksum([&arguments.database])?;
            let rows = export_csv(&arguments.database, &arguments.out, arguments.digits.map(usize::from))?;
            outln!("{rows} rows in {}", arguments.out.display());
            Ok(())
        }
        Command::Check(arguments) => check::run(arguments),
        Command::Seal(arguments) => {
            let rows = seal(&arguments.database)?;
            outln!("{rows} rows sealed in {}", arguments.database.display());
            Ok(())
        }
        Command::Plan(arguments) => plan(arguments),
        Command::Plot(arguments) => plot::run(arguments),
    }
}

fn plan(arguments: &PlanArguments) -> Result<(), CliError> {
    let offenders = Offenders::parse(&read_text(&arguments.from)?, &arguments.from.display().to_string())?;
    let like = Plan::parse(&read_text(&arguments.like)?, &arguments.like.display().to_string())?;
    let effort = Effort { discs: arguments.discs, repeats: arguments.repeats };
    let plan = offenders.plan(&like, effort)?;
    write(&arguments.out, plan.text.as_bytes())?;
    let (cells, packings) = (offenders.rows.len(), plan.jobs().len());
    outln!(
        "{packings} packings, {} states for {cells} queries outside, in {}",
        plan.rows(),
        arguments.out.display()
    );
    Ok(())
}

fn make(arguments: &GenerateArguments) -> Result<(), CliError> {
    arguments.simd.apply()?;
    arguments.timing.iter().try_for_each(|timing| check_target(timing))?;
    let plan = Plan::parse(&read_text(&arguments.plan)?, &arguments.plan.display().to_string())?;
    let cores = std::thread::available_parallelism().map_or(1, usize::from);
    let built = env!("MSDD_COMMIT");
    let run = Run {
        shard: arguments.shard,
        threads: arguments.threads.map_or(cores, |threads| threads as usize),
        commit: arguments.commit.clone().unwrap_or_else(|| built.to_string()),
    };
    let start = Instant::now();
    let mut bar = Progress::new("packings", plan.jobs().len() as u64);
    let made = generate(&plan, &arguments.out, &run, |progress| {
        let note = match progress.failed {
            0 => String::new(),
            failed => format!("({failed} failed)"),
        };
        bar.set(progress.done as u64, progress.total as u64, &note);
        ControlFlow::Continue(())
    })?;
    bar.finish();
    let timing = timing::Timing::new(&made, run.threads, start.elapsed().as_secs_f64());
    if let Some(path) = &arguments.timing {
        timing.write(path)?;
    }
    report(arguments, &timing)
}

/// Rows by outcome, and where the time went.
fn report(arguments: &GenerateArguments, timing: &timing::Timing) -> Result<(), CliError> {
    let records = read(&arguments.out)?.records;
    let mut outcomes: BTreeMap<&str, usize> = BTreeMap::new();
    for record in &records {
        *outcomes.entry(&record.outcome).or_default() += 1;
    }
    let list: Vec<String> = outcomes.iter().map(|(kind, count)| format!("{count} {kind}")).collect();
    outln!("{} rows ({}) in {}", records.len(), list.join(", "), arguments.out.display());
    outln!("{timing}");
    Ok(())
}
