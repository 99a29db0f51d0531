//! Measures whether sharing the steps among several threads is faster at the moment than one thread.
//!
//! When another job holds a core, the thread on that core is suspended in the middle of its share and all others wait
//! for it: two threads are then slower than one. Shared steps and those of one thread give the same bits, so results do
//! not depend on the choice, which follows the clock.

use std::time::Duration;

/// Steps between two trials of the mode (shared or alone) that is not in use; below, the steps of one trial.
const STRETCH: u64 = 256;
const TRIAL: u64 = 12;
/// Weight of the newest measurement in the running mean.
const NEWEST: f64 = 0.5;

/// Measured time per step, alone (one thread) and shared.
#[derive(Clone, Debug, Default)]
pub struct Pace {
    /// Seconds per step: \[alone, shared\].
    seconds: [Option<f64>; 2],
    since_trial: u64,
}

impl Pace {
    /// How to take the next steps: shared or not, and how many at most.
    pub fn next(&self, left: u64) -> (bool, u64) {
        let better = match self.seconds {
            [_, None] => return (true, left.min(TRIAL)),
            [None, _] => return (false, left.min(TRIAL)),
            [Some(alone), Some(shared)] => shared < alone,
        };
        if self.since_trial >= STRETCH {
            (!better, left.min(TRIAL))
        } else {
            (better, left.min(STRETCH - self.since_trial))
        }
    }

    /// Records that `steps` steps, taken as [`Pace::next`] said, have cost the time `elapsed`.
    pub fn record(&mut self, shared: bool, steps: u64, elapsed: Duration) {
        let trial = self.since_trial >= STRETCH;
        self.since_trial = if trial { 0 } else { self.since_trial + steps };
        let now = elapsed.as_secs_f64() / steps as f64;
        let mean = &mut self.seconds[usize::from(shared)];
        *mean = Some(mean.map_or(now, |old| old + NEWEST * (now - old)));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Number of the 10 000 steps that are taken shared when a shared step takes the time `shared` and one alone takes
    /// 10.
    fn shared_steps(shared: u64) -> u64 {
        let (mut pace, mut taken, mut left) = (Pace::default(), 0, 10_000);
        while left > 0 {
            let (is_shared, steps) = pace.next(left);
            assert!(steps > 0);
            let cost = if is_shared { shared } else { 10 };
            pace.record(is_shared, steps, Duration::from_micros(cost * steps));
            taken += if is_shared { steps } else { 0 };
            left -= steps;
        }
        taken
    }

    #[test]
    fn the_faster_way_takes_nearly_all_steps() {
        assert!(shared_steps(5) > 9_400, "{}", shared_steps(5));
        assert!(shared_steps(20) < 600, "{}", shared_steps(20));
    }
}
