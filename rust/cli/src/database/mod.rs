//! `msdd database`.

mod check;
mod timing;

use crate::error::CliError;
use crate::output::write_json;
use crate::progress::Progress;
use crate::simd::SimdArgument;
use clap::{Args, Subcommand};
use msdd_files::{check_target, read_text, write};
use msdd_rve::database::{
    Effort, Grains, Offenders, Plan, Recipe, Record, Run, Shard, SpherePlan, SphereRecord, export_csv,
    generate, grains, inspect,
};
use std::collections::BTreeMap;
use std::ops::ControlFlow;
use std::path::PathBuf;
use std::time::Instant;

#[derive(Subcommand)]
pub enum Command {
    /// Generate the RVEs of a plan, or continue where an earlier run stopped.
    Generate(GenerateArguments),
    /// Write a database as CSV, with FILE.columns.csv (units, meaning) and FILE.provenance.json.
    Export(ExportArguments),
    /// Check laws that hold exactly for every row; print symmetry. The exit status
    /// is 1 if a law is violated.
    Check(check::Arguments),
    /// Write a plan for RVEs around states of a solver's run that were outside of the model's trained range.
    Plan(PlanArguments),
}

#[derive(Args)]
#[command(after_help = "Example:
  msdd database generate --plan cases/database/quick.toml --out results/quick

On a cluster, as an array of 16 jobs of Slurm (a job that failed is submitted again in the same way):
  sbatch --array=1-16 --wrap 'msdd database generate --plan p.toml --out db --threads 1 --shard $SLURM_ARRAY_TASK_ID/16'")]
pub struct GenerateArguments {
    /// The plan (TOML), which says what to generate; see cases/database.
    #[arg(long, value_name = "FILE")]
    plan: PathBuf,
    /// Folder of the database, with a file for each packing; an existing one of the same plan is completed, so a killed run
    /// goes on.
    #[arg(long, value_name = "DIR")]
    out: PathBuf,
    /// Number of threads; the rows do not depend on it. Default: all processor cores.
    #[arg(long, value_parser = crate::threads::parser())]
    threads: Option<u32>,
    /// Generate one part of the plan, such as 3/16 for the third of 16. All parts may be generated at once, by several
    /// processes or machines, in the same folder.
    #[arg(long, value_name = "NUMBER/COUNT", default_value_t)]
    shard: Shard,
    /// JSON file to write: how long each part of the work took.
    #[arg(long, value_name = "FILE")]
    timing: Option<PathBuf>,
    #[command(flatten)]
    simd: SimdArgument,
}

#[derive(Args)]
#[command(
    after_help = "Afterwards generate the database of the plan, and train a model on the old and the new database: \
msdd train --database OLD --database NEW --out MODEL"
)]
pub struct PlanArguments {
    /// States outside of the trained range, as msddFoam writes them to postProcessing/msddFoam/offenders.json.
    #[arg(long, value_name = "FILE")]
    from: PathBuf,
    /// The plan of the model's database: radii, material and boundary are taken from it.
    #[arg(long, value_name = "FILE")]
    like: PathBuf,
    /// The plan (TOML) to write.
    #[arg(long, value_name = "FILE")]
    out: PathBuf,
    /// Number of discs in a packing. Allowed: 10 to 1000000.
    #[arg(long, default_value_t = 500)]
    discs: usize,
    /// Number of packings for each porosity and kind of compression. Allowed: ≥ 1.
    #[arg(long, default_value_t = 4)]
    repeats: u32,
}

#[derive(Args)]
pub struct ExportArguments {
    /// The database.
    #[arg(value_name = "DIR")]
    database: PathBuf,
    /// The CSV file; compressed when it ends in .gz.
    #[arg(long, value_name = "FILE")]
    out: PathBuf,
    /// Significant digits of numbers; default: as many as are needed to read the same numbers again.
    #[arg(long, value_parser = clap::value_parser!(u8).range(3..=17))]
    digits: Option<u8>,
}

pub fn run(command: &Command) -> Result<(), CliError> {
    match command {
        Command::Generate(arguments) => make(arguments),
        Command::Export(arguments) => {
            let rows = export_csv(&arguments.database, &arguments.out, arguments.digits.map(usize::from))?;
            outln!("{rows} rows in {}", arguments.out.display());
            Ok(())
        }
        Command::Check(arguments) => check::run(arguments),
        Command::Plan(arguments) => plan(arguments),
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
    let (text, file) = (read_text(&arguments.plan)?, arguments.plan.display().to_string());
    match SpherePlan::has_sphere_schema(&text) {
        true => make_rows(arguments, &SpherePlan::parse(&text, &file)?),
        false => make_rows(arguments, &Plan::parse(&text, &file)?),
    }
}

fn make_rows<P: Recipe>(arguments: &GenerateArguments, plan: &P) -> Result<(), CliError> {
    let cores = std::thread::available_parallelism().map_or(1, usize::from);
    let run = Run {
        shard: arguments.shard,
        threads: arguments.threads.map_or(cores, |threads| threads as usize),
        commit: env!("MSDD_COMMIT").to_string(),
    };
    let start = Instant::now();
    let mut bar = Progress::new("packings", plan.jobs().len() as u64);
    let made = generate(plan, &arguments.out, &run, |progress| {
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
        write_json(path, &timing)?;
    }
    report(arguments, &timing)
}

/// Prints the number of rows by outcome, and how long each part of the work took.
fn report(arguments: &GenerateArguments, timing: &timing::Timing) -> Result<(), CliError> {
    let outcomes: Vec<String> = match grains(&arguments.out)? {
        Grains::Discs => {
            inspect::<Record>(&arguments.out)?.records.into_iter().map(|row| row.outcome).collect()
        }
        Grains::Spheres => {
            inspect::<SphereRecord>(&arguments.out)?.records.into_iter().map(|row| row.outcome).collect()
        }
    };
    let mut counts: BTreeMap<&str, usize> = BTreeMap::new();
    for outcome in &outcomes {
        *counts.entry(outcome).or_default() += 1;
    }
    let list: Vec<String> = counts.iter().map(|(kind, count)| format!("{count} {kind}")).collect();
    outln!("{} rows ({}) in {}", outcomes.len(), list.join(", "), arguments.out.display());
    outln!("{timing}");
    Ok(())
}
