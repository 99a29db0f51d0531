//! Runs many jobs, several at the same time, and takes results from the cache where it has them.

use crate::ReportError;
use crate::jobs::cache::Cache;
use crate::jobs::execute::{Place, Record, execute};
use crate::jobs::job::Job;
use std::collections::{BTreeMap, BTreeSet};
use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::time::Instant;

/// Results by the key of the job in the cache.
pub type Records = BTreeMap<String, Record>;

/// Progress of a set of jobs.
pub struct Progress<'a> {
    pub done: usize,
    pub total: usize,
    /// Estimated times of the jobs that have run and of all jobs that have to run \[s\].
    pub work: [f64; 2],
    /// Time that has passed since the first job was started \[s\].
    pub elapsed: f64,
    pub last: &'a str,
}

/// A job and an estimate of its wall time \[s\], which is only used to show the time left.
#[derive(Clone, Debug)]
pub struct Asked {
    pub job: Job,
    pub guess: f64,
}

/// The results of the jobs that the cache has.
///
/// # Errors
/// [`ReportError::Read`] for a file of a job that is missing; [`ReportError::Empty`] when the cache has nothing.
pub fn found(cache: &Cache, jobs: &[Asked]) -> Result<Records, ReportError> {
    let mut records = Records::new();
    for asked in jobs {
        let key = cache.key(&asked.job)?;
        if let Some(record) = cache.get(&key) {
            records.insert(key, record);
        }
    }
    match records.is_empty() {
        true => Err(ReportError::Empty { cache: cache.folder().to_path_buf() }),
        false => Ok(records),
    }
}

/// Runs the jobs that the cache does not have, each once, `at_a_time` at the same time.
///
/// # Errors
/// The first error that is not the outcome of a job. Jobs that are running are finished first.
pub fn run(
    cache: &Cache,
    place: &Place,
    jobs: &[Asked],
    at_a_time: usize,
    watch: &mut (dyn FnMut(&Progress) + Send),
) -> Result<Records, ReportError> {
    let mut records = Records::new();
    let mut waiting = Vec::new();
    let mut seen = BTreeSet::new();
    for asked in jobs {
        let key = cache.key(&asked.job)?;
        if !seen.insert(key.clone()) {
            continue;
        }
        match cache.get(&key) {
            Some(record) => drop(records.insert(key, record)),
            None => waiting.push((key, asked)),
        }
    }
    let total = seen.len();
    let all: f64 = waiting.iter().map(|(_, asked)| asked.guess).sum();
    let began = Instant::now();
    let next = AtomicUsize::new(0);
    let state = Mutex::new((records, 0.0, None, watch));
    let worker = || {
        while let Some((key, asked)) = waiting.get(next.fetch_add(1, Ordering::Relaxed)) {
            let result = execute(place, &asked.job, &key[..16]).and_then(|record| {
                if record.is_settled() { cache.put(key, &record).map(|()| record) } else { Ok(record) }
            });
            let Ok(mut state) = state.lock() else { return };
            let (records, work, failed, watch) = &mut *state;
            match result {
                Ok(record) => drop(records.insert(key.clone(), record)),
                Err(error) => {
                    failed.get_or_insert(error);
                    next.store(waiting.len(), Ordering::Relaxed);
                }
            }
            *work += asked.guess;
            watch(&Progress {
                done: records.len(),
                total,
                work: [*work, all],
                elapsed: began.elapsed().as_secs_f64(),
                last: &asked.job.name(),
            });
        }
    };
    std::thread::scope(|scope| (0..at_a_time).for_each(|_| drop(scope.spawn(worker))));
    let (records, _, failed, _) = match state.into_inner() {
        Ok(state) => state,
        Err(poisoned) => poisoned.into_inner(),
    };
    failed.map_or(Ok(records), Err)
}
