//! `msdd database`.

use crate::error::CliError;
use crate::files::read_text;
use crate::progress::Progress;
use crate::simd::SimdArgument;
use clap::{Args, Subcommand};
use msdd_rve::database::{Plan, export_csv, generate, read};
use std::collections::BTreeMap;
use std::path::PathBuf;
use std::time::Instant;

#[derive(Subcommand)]
pub enum Command {
    /// Make the RVEs of a plan, or go on where an earlier run stopped.
    Generate(GenerateArguments),
    /// Write a database as CSV, with FILE.columns.csv (units, meaning) and FILE.provenance.json beside it.
    Export(ExportArguments),
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
    #[arg(long)]
    threads: Option<usize>,
    #[command(flatten)]
    simd: SimdArgument,
}

#[derive(Args)]
pub struct ExportArguments {
    /// The database.
    #[arg(value_name = "FILE")]
    database: PathBuf,
    /// The CSV file.
    #[arg(long, value_name = "FILE")]
    out: PathBuf,
}

pub fn run(command: &Command) -> Result<(), CliError> {
    match command {
        Command::Generate(arguments) => make(arguments),
        Command::Export(arguments) => {
            let rows = export_csv(&arguments.database, &arguments.out)?;
            println!("{rows} rows in {}", arguments.out.display());
            Ok(())
        }
    }
}

fn make(arguments: &GenerateArguments) -> Result<(), CliError> {
    arguments.simd.apply()?;
    let plan = Plan::parse(&read_text(&arguments.plan)?, &arguments.plan.display().to_string())?;
    let cores = std::thread::available_parallelism().map_or(1, usize::from);
    let threads = arguments.threads.unwrap_or(cores);
    let start = Instant::now();
    let total = plan.jobs().len() as u64;
    let mut bar = Progress::new("packings", total);
    generate(&plan, &arguments.out, threads, |progress| {
        let note = match progress.failed {
            0 => String::new(),
            failed => format!("({failed} failed)"),
        };
        bar.set(progress.done as u64, total, &note);
    })?;
    bar.finish();
    report(arguments, start.elapsed().as_secs_f64())
}

/// Rows by outcome.
fn report(arguments: &GenerateArguments, seconds: f64) -> Result<(), CliError> {
    let records = read(&arguments.out)?.records;
    let mut outcomes: BTreeMap<&str, usize> = BTreeMap::new();
    for record in &records {
        let kind = record.outcome.split(':').next().unwrap_or_default();
        *outcomes.entry(kind).or_default() += 1;
    }
    let list: Vec<String> = outcomes.iter().map(|(kind, count)| format!("{count} {kind}")).collect();
    println!("{} rows ({}) in {}, {seconds:.1} s", records.len(), list.join(", "), arguments.out.display());
    Ok(())
}
