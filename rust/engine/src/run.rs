//! Many steps in a row with regular checks: the time step is adapted to the contacts, and a state that has gone wrong
//! ends the run. On one thread or several.

use crate::pace::Pace;
use crate::team;
use rayon::ThreadPool;
use std::sync::Arc;
use std::time::Instant;

/// Steps between two checks, at which the time step is chosen again. A check costs about as much as a step.
pub const LOOK_EVERY: u64 = 50;

/// Grains that move in steps.
pub trait Assembly: Clone + Send {
    /// Why a run ends early.
    type Failure;
    /// Steps taken.
    fn steps(&self) -> u64;
    /// Takes one step; shared among the threads of the present pool when `shared`.
    fn take_step(&mut self, shared: bool);
    /// Applies the choice of time step to the present contacts.
    ///
    /// # Errors
    /// When a fixed step exceeds the bound.
    fn watch_time_step(&mut self) -> Result<(), Self::Failure>;
    /// # Errors
    /// For states that only a failed run can reach.
    fn check(&self) -> Result<(), Self::Failure>;
    /// Whether a state that has passed the check may be kept as the last good one.
    fn may_be_kept(&self) -> bool;
    fn threads(&mut self) -> &mut Threads;
    fn last_good(&mut self) -> &mut Option<LastGood<Self>>;
}

/// A copy of the state at the last successful check.
#[derive(Clone, Debug)]
pub struct LastGood<A> {
    /// Least number of steps between two copies.
    pub every: u64,
    pub state: Box<A>,
}

/// The threads that share the steps of a large assembly.
#[derive(Clone, Debug, Default)]
pub struct Threads {
    /// None when all steps run on the caller's thread.
    pool: Option<Arc<ThreadPool>>,
    pace: Pace,
}

impl Threads {
    /// Sets the number of threads.
    ///
    /// # Errors
    /// The error of the operating system when it cannot start the threads.
    pub fn set(&mut self, threads: usize) -> std::io::Result<()> {
        self.pool = None;
        if threads > 1 {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build();
            self.pool = Some(Arc::new(pool.map_err(std::io::Error::other)?));
        }
        Ok(())
    }
}

/// Takes `count` steps without checking the state in between; shared among the threads whenever that is faster than one
/// thread.
pub fn take_steps<A: Assembly>(assembly: &mut A, count: u64) {
    let Some(pool) = assembly.threads().pool.clone() else {
        return (0..count).for_each(|_| assembly.take_step(false));
    };
    let mut left = count;
    while left > 0 {
        let (shared, steps) = assembly.threads().pace.next(left);
        let begin = Instant::now();
        if shared {
            team::together(&pool, || (0..steps).for_each(|_| assembly.take_step(true)));
        } else {
            (0..steps).for_each(|_| assembly.take_step(false));
        }
        assembly.threads().pace.record(shared, steps, begin.elapsed());
        left -= steps;
    }
}

/// Takes `steps` steps. The state is checked and the time step is set after every 50 of them.
///
/// # Errors
/// The first failure found. The assembly is then left in the failed state; for an earlier one see [`keep_last_good`].
pub fn run<A: Assembly>(assembly: &mut A, steps: u64) -> Result<(), A::Failure> {
    let end = assembly.steps() + steps;
    while assembly.steps() < end {
        let block = LOOK_EVERY.min(end - assembly.steps());
        assembly.watch_time_step()?;
        take_steps(assembly, block);
        assembly.check()?;
        let now = assembly.steps();
        if let Some(LastGood { every, state }) = assembly.last_good() {
            let every = *every;
            if now >= state.steps() + every && assembly.may_be_kept() {
                keep_last_good(assembly, every);
            }
        }
    }
    Ok(())
}

/// Makes [`run`] keep a copy of the last good state: first the present one, then at each successful check that is at
/// least `every` steps after the last copy a new one. A copy costs about as much as a step.
pub fn keep_last_good<A: Assembly>(assembly: &mut A, every: u64) {
    *assembly.last_good() = None;
    let state = Box::new(assembly.clone());
    *assembly.last_good() = Some(LastGood { every, state });
}
