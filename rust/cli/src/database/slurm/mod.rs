//! `msdd database slurm`: the parts (shards) of a plan as an array of jobs of a cluster's scheduler, and a job that joins them.
//!
//! | module | what |
//! |---|---|
//! | `parts` | the parts of the plan: what of each is there |
//! | `indices` | lists of numbers of parts, as Slurm writes them |
//! | `scripts` | the scripts of the jobs |
//! | `scheduler` | calls of sbatch, squeue and scancel |

mod indices;
mod parts;
mod scheduler;
mod scripts;

use crate::error::CliError;
use crate::progress::Progress;
use clap::Args;
use indices::ranges;
use msdd_files::read_text;
use parts::{Parts, Standing};
use scheduler::{Queued, Scheduler};
use std::collections::BTreeMap;
use std::path::PathBuf;
use std::time::Duration;

/// Times that a part is submitted again without a new packing in it.
const MAX_ATTEMPTS: u32 = 3;

#[derive(Args)]
#[command(
    after_help = "The parts are in the folder FILE.parts next to the database, with the scripts and logs of the jobs. All nodes must \
see it, the plan and this program at the same path. Give the same command again, at any time: it submits what is missing and is not \
queued, and reports the progress of all parts. Finished parts are never made again."
)]
pub struct Arguments {
    /// The plan (TOML), which says what to generate; see cases/database.
    #[arg(long, value_name = "FILE")]
    plan: PathBuf,
    /// The database (SQLite) to make.
    #[arg(long, value_name = "FILE")]
    out: PathBuf,
    /// Number of parts: jobs of the array. It cannot be changed later. Allowed: 1 to the number of packings.
    #[arg(long, value_name = "NUMBER", value_parser = clap::value_parser!(u32).range(1..))]
    array: u32,
    /// Number of threads, and so of processor cores, of each part.
    #[arg(long, default_value_t = 1, value_parser = crate::threads::parser())]
    threads: u32,
    /// Further option of sbatch, such as --sbatch=--partition=long; may be given several times.
    #[arg(long, value_name = "OPTION", allow_hyphen_values = true)]
    sbatch: Vec<String>,
    /// Only say how far the parts are; submit nothing.
    #[arg(long, conflicts_with = "wait")]
    status: bool,
    /// Wait until the database is there; submit again what fails on the way. A part that ends three times without a new
    /// packing ends it.
    #[arg(long)]
    wait: bool,
    /// Seconds between two looks of --wait.
    #[arg(long, value_name = "SECONDS", default_value_t = 10, value_parser = clap::value_parser!(u64).range(1..=3600))]
    every: u64,
    /// Commit of this program, for the provenance; default: the one it was built from.
    #[arg(long, value_name = "TEXT")]
    commit: Option<String>,
}

pub fn run(arguments: &Arguments) -> Result<(), CliError> {
    let text = read_text(&arguments.plan)?;
    let parts = Parts::new((&text, &arguments.plan), &arguments.out, arguments.array)?;
    let scheduler = Scheduler::new(&parts);
    let mut bar = arguments.wait.then(|| Progress::new("packings", parts.packings() as u64));
    let mut attempts = Attempts::default();
    loop {
        let standing = parts.standing()?;
        let queued = scheduler.queued()?;
        if standing.complete {
            if let Some(bar) = bar {
                bar.finish();
            }
            outln!("{} packings in {}", standing.stored(), arguments.out.display());
            return Ok(());
        }
        let missing = standing.missing(&queued.parts);
        if let Some(bar) = &mut bar {
            let done = format!("({} of {} parts done)", standing.finished(), parts.count());
            bar.set(standing.stored() as u64, parts.packings() as u64, &done);
        }
        if !arguments.status {
            attempts.count(&missing, &standing, &parts)?;
            attempts.count_merge(&queued, &standing, &parts)?;
            submit(arguments, &parts, &scheduler, &missing, (&queued, &standing))?;
        }
        if bar.is_none() {
            report(&parts, &standing, &queued.parts, if arguments.status { &missing } else { &[] });
            return Ok(());
        }
        std::thread::sleep(Duration::from_secs(arguments.every));
    }
}

/// How often each part was submitted since it last grew, and how often joining them was.
#[derive(Default)]
struct Attempts {
    parts: BTreeMap<u32, (usize, u32)>,
    merges: u32,
}

impl Attempts {
    /// Counts joining, if all parts are done and nothing is queued.
    fn count_merge(&mut self, queued: &Queued, standing: &Standing, parts: &Parts) -> Result<(), CliError> {
        self.merges += u32::from(standing.all_finished() && !queued.merge);
        if self.merges <= MAX_ATTEMPTS {
            return Ok(());
        }
        let log = parts.log("merge");
        Err(CliError::Message(format!(
            "the parts are not joined, tried {MAX_ATTEMPTS} times; the log is {}",
            log.display()
        )))
    }

    /// Counts parts that are about to be submitted.
    fn count(&mut self, missing: &[u32], standing: &Standing, parts: &Parts) -> Result<(), CliError> {
        for &part in missing {
            let stored = standing.stored_in(part);
            let (before, count) = self.parts.entry(part).or_insert((stored, 0));
            if *before < stored {
                (*before, *count) = (stored, 0);
            }
            *count += 1;
            if *count > MAX_ATTEMPTS {
                let log = parts.log(&part.to_string());
                return Err(CliError::Message(format!(
                    "part {part} of {} ended {MAX_ATTEMPTS} times without a new packing; its log is {}",
                    parts.count(),
                    log.display()
                )));
            }
        }
        Ok(())
    }
}

/// Submits the parts that are missing, and the job that joins all of them once they are done.
fn submit(
    arguments: &Arguments,
    parts: &Parts,
    scheduler: &Scheduler,
    missing: &[u32],
    (queued, standing): (&Queued, &Standing),
) -> Result<(), CliError> {
    if missing.is_empty() && (queued.merge || !queued.jobs.is_empty() && !standing.all_finished()) {
        return Ok(());
    }
    let scripts = scripts::write(parts, &arguments.plan, arguments.threads, arguments.commit.as_deref())?;
    let mut jobs = queued.jobs.clone();
    if !missing.is_empty() {
        let job =
            scheduler.submit_parts(&scripts.part, &ranges(missing), arguments.threads, &arguments.sbatch)?;
        outln!("job {job}: parts {} of {}", ranges(missing), parts.count());
        jobs.push(job);
    }
    if queued.merge {
        scheduler.cancel_merge()?;
    }
    let job = scheduler.submit_merge(&scripts.merge, &jobs, &arguments.sbatch)?;
    outln!("job {job}: joins the parts in {}", arguments.out.display());
    Ok(())
}

fn report(parts: &Parts, standing: &Standing, queued: &[u32], missing: &[u32]) {
    outln!(
        "{} of {} packings, {} of {} parts done",
        standing.stored(),
        parts.packings(),
        standing.finished(),
        parts.count()
    );
    if !queued.is_empty() {
        outln!("queued or running: parts {}", ranges(queued));
    }
    if !missing.is_empty() {
        outln!("missing and not queued: parts {}; without --status they are submitted", ranges(missing));
    }
    outln!("logs: {}", parts.log("*").display());
}
