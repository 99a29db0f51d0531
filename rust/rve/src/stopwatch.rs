//! Measures the time that each thread spends in each part of the work. No result depends on it.

use std::cell::Cell;
use std::time::Instant;

/// Parts of the work on an RVE.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Stage {
    /// Walls close on the loose discs.
    Packing,
    /// Relaxation after packing.
    PackingSettle,
    /// Strain or wall slip from stop to stop.
    Strain,
    /// Relaxation at the stops.
    StrainSettle,
    /// Porosity, fabric, conductivity, stress of a state.
    Averaging,
}

/// Their names.
pub const STAGES: [&str; 5] = ["packing", "packing_settle", "strain", "strain_settle", "averaging"];

/// Seconds, in the order of [`STAGES`].
pub type Seconds = [f64; 5];

thread_local! {
    static SPENT: Cell<Seconds> = const { Cell::new([0.0; 5]) };
}

/// Does `work` and adds the time it took to the stage.
pub(crate) fn time<T>(stage: Stage, work: impl FnOnce() -> T) -> T {
    let begin = Instant::now();
    let result = work();
    let mut spent = SPENT.get();
    spent[stage as usize] += begin.elapsed().as_secs_f64();
    SPENT.set(spent);
    result
}

/// Seconds that this thread has spent in each stage since the last call.
pub fn take() -> Seconds {
    SPENT.replace([0.0; 5])
}
