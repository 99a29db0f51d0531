//! Makes the rows of a plan on several threads; what is made depends on the plan alone.

use super::DatabaseError;
use super::plan::{Job, Plan};
use super::record::Record;
use super::store::Store;
use crate::{Averages, Ramp, RegionKind, RveError, expand, homogenise, pack};
use std::collections::BTreeMap;
use std::path::Path;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::mpsc;

/// How far a generation has come.
#[derive(Clone, Copy, Debug)]
pub struct Progress {
    /// Packings in the database, those of earlier runs included.
    pub done: usize,
    pub total: usize,
    /// Of them: jobs that failed in this run. They are rows too.
    pub failed: usize,
}

/// Fills the database at `path` with what the plan still lacks, on `threads` threads. Packings are stored whole and in
/// plan order, each in one transaction: a killed run resumes at the next one. `progress` is called after each.
///
/// # Errors
/// [`DatabaseError::Mismatch`] when the file holds another plan or was made by another engine version; storage errors.
pub fn generate(
    plan: &Plan,
    path: &Path,
    threads: usize,
    mut progress: impl FnMut(Progress),
) -> Result<(), DatabaseError> {
    let mut store = Store::open_for(path, plan)?;
    let jobs = plan.jobs();
    let todo = &jobs[store.packings()?.min(jobs.len())..];
    let mut state = Progress { done: jobs.len() - todo.len(), total: jobs.len(), failed: 0 };
    progress(state);

    let next = AtomicUsize::new(0);
    let stop = AtomicBool::new(false);
    let (sender, receiver) = mpsc::channel();
    std::thread::scope(|scope| {
        for _ in 0..threads.clamp(1, todo.len().max(1)) {
            let (sender, next, stop) = (sender.clone(), &next, &stop);
            scope.spawn(move || {
                while let Some(job) = todo.get(next.fetch_add(1, Ordering::Relaxed)) {
                    if stop.load(Ordering::Relaxed) || sender.send((job.packing, rows(plan, job))).is_err() {
                        return;
                    }
                }
            });
        }
        drop(sender);
        // Rows wait here until all packings before theirs are stored.
        let mut waiting: BTreeMap<i64, Vec<Record>> = BTreeMap::new();
        for (packing, records) in receiver {
            waiting.insert(packing, records);
            while let Some(records) = waiting.remove(&(state.done as i64)) {
                if let Err(error) = store.insert(&records) {
                    stop.store(true, Ordering::Relaxed);
                    return Err(error);
                }
                state.done += 1;
                state.failed += usize::from(records.iter().any(|r| r.outcome.starts_with("failed")));
                progress(state);
            }
        }
        Ok(())
    })
}

/// The rows of one packing. Failures are rows, too.
fn rows(plan: &Plan, job: &Job) -> Vec<Record> {
    let material = &plan.material;
    let packed = match pack(&job.spec, material) {
        Ok(packed) => packed,
        Err(error) => {
            return vec![Record::new(job, material, ("packed", 0, 0.0), Err(error.to_string()), None)];
        }
    };
    let initial = homogenise(&packed.simulation, RegionKind::default());
    let start = Ok((&packed.settled, &initial));
    let mut records = vec![Record::new(job, material, ("packed", 0, 0.0), start, Some(&initial))];
    let (up, down) = plan.ramps();
    for (name, strains) in [("up", up), ("down", down)] {
        let stops = expand(&packed, &strains);
        records.extend(ramp_rows(plan, job, (name, &strains), stops, &initial));
    }
    records
}

/// The stops of a ramp, and its failure as a row after them.
fn ramp_rows(
    plan: &Plan,
    job: &Job,
    (name, strains): (&str, &[f64]),
    ramp: Result<Ramp, RveError>,
    initial: &Averages,
) -> Vec<Record> {
    let ramp = ramp.unwrap_or_else(|failure| Ramp { stops: Vec::new(), failure: Some(failure) });
    let row = |stop: usize, state| {
        Record::new(job, &plan.material, (name, stop + 1, strains[stop]), state, Some(initial))
    };
    let reached = ramp.stops.iter().enumerate().map(|(k, stop)| row(k, Ok((&stop.settled, &stop.averages))));
    let failed = ramp.failure.map(|failure| row(ramp.stops.len(), Err(failure.to_string())));
    reached.chain(failed).collect()
}
