//! Makes the rows of a plan on several threads. The rows depend on the plan alone.

use super::recipe::Recipe;
use super::table::Row;
use super::{DatabaseError, Shard, store};
use crate::stopwatch::{self, Seconds};
use std::ops::ControlFlow;
use std::path::Path;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::mpsc;

/// Settings of one run of the generator.
#[derive(Clone, Debug, Default)]
pub struct Run {
    /// The part of the plan to make.
    pub shard: Shard,
    pub threads: usize,
    /// Commit of the program, for the provenance.
    pub commit: String,
}

/// Progress of a generation.
#[derive(Clone, Copy, Debug, Default)]
pub struct Progress {
    /// Packings stored in the database, those of earlier runs included.
    pub done: usize,
    pub total: usize,
    /// Packings of this run with at least one stop that was not reached. They have all their rows, too.
    pub failed: usize,
    /// Rows made in this run.
    pub rows: usize,
    /// Seconds of all threads of this run, divided by [`stopwatch::Stage`].
    pub seconds: Seconds,
    /// Seconds spent writing the file.
    pub storing: f64,
}

/// Adds to the database in the folder `path` all packings of the shard that it does not contain yet. Each packing is stored
/// as soon as it is made, so a killed run loses only the packings that it was working on. The most expensive packings are
/// made first, so that at the end no thread is left alone with one of them. `progress` is called after each packing, and may
/// end the run there.
///
/// # Errors
/// [`DatabaseError::File`] when another run is working on this shard, before anything is made;
/// [`DatabaseError::Mismatch`] when the folder holds another plan, or was made by another engine version; storage errors.
pub fn generate<P: Recipe>(
    plan: &P,
    path: &Path,
    run: &Run,
    mut progress: impl FnMut(Progress) -> ControlFlow<()>,
) -> Result<Progress, DatabaseError> {
    if !store::is_folder(path)? {
        msdd_files::check_target(path)?;
    }
    store::open(path, plan, &run.commit)?;
    // Two runs of the same shard would make the same packings.
    let _lock =
        msdd_files::Lock::take(&path.join(format!("shard-{}", run.shard.to_string().replace('/', "-of-"))))?;
    let stored = store::packings(path)?;
    let packing = |job: &P::Job| P::packing(job).0;
    let mut todo: Vec<P::Job> = plan.jobs().into_iter().filter(|job| run.shard.holds(packing(job))).collect();
    let total = todo.len();
    todo.retain(|job| !stored.contains_key(&packing(job)));
    todo.sort_by_key(|job| std::cmp::Reverse(P::cost(job)));
    let mut state = Progress { done: total - todo.len(), total, ..Progress::default() };
    if progress(state).is_break() {
        return Ok(state);
    }
    make(plan, &todo, run.threads, |records, seconds| {
        let begin = std::time::Instant::now();
        store::insert(path, &records)?;
        state.storing += begin.elapsed().as_secs_f64();
        state.done += 1;
        state.rows += records.len();
        state.failed += usize::from(records.iter().any(|record| record.failure().is_some()));
        for (sum, seconds) in state.seconds.iter_mut().zip(seconds) {
            *sum += seconds;
        }
        Ok(progress(state))
    })?;
    Ok(state)
}

/// Makes the jobs, each by the next free thread. `store` receives the rows of each job as it is finished, with the time
/// they took.
fn make<P: Recipe>(
    plan: &P,
    todo: &[P::Job],
    threads: usize,
    mut store: impl FnMut(Vec<P::Row>, Seconds) -> Result<ControlFlow<()>, DatabaseError>,
) -> Result<(), DatabaseError> {
    let next = AtomicUsize::new(0);
    let stop = AtomicBool::new(false);
    let (sender, receiver) = mpsc::channel();
    std::thread::scope(|scope| {
        for _ in 0..threads.clamp(1, todo.len().max(1)) {
            let (sender, next, stop) = (sender.clone(), &next, &stop);
            scope.spawn(move || {
                while let Some(job) = todo.get(next.fetch_add(1, Ordering::Relaxed)) {
                    let records = plan.make(job);
                    if stop.load(Ordering::Relaxed) || sender.send((records, stopwatch::take())).is_err() {
                        return;
                    }
                }
            });
        }
        drop(sender);
        for (records, seconds) in receiver {
            let stored = store(records, seconds);
            if !matches!(stored, Ok(ControlFlow::Continue(()))) {
                stop.store(true, Ordering::Relaxed);
                return stored.map(|_| ());
            }
        }
        Ok(())
    })
}
