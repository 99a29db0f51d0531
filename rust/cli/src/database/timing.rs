//! How long the parts of the generation of a database took.

use msdd_rve::database::Progress;
use msdd_rve::stopwatch::STAGES;
use serde::Serialize;
use std::collections::BTreeMap;
use std::fmt;

#[derive(Serialize)]
pub struct Timing {
    /// Number of rows made in this run.
    rows: usize,
    /// Wall time [s].
    seconds: f64,
    rows_per_second: f64,
    threads: usize,
    /// Time by part of the work, summed over all threads [s]; storing is done by a thread of its own at the same time.
    stages: BTreeMap<&'static str, f64>,
}

impl Timing {
    pub fn new(made: &Progress, threads: usize, seconds: f64) -> Self {
        let mut stages: BTreeMap<&str, f64> = STAGES.into_iter().zip(made.seconds).collect();
        stages.insert("storing", made.storing);
        let rows_per_second = made.rows as f64 / seconds.max(f64::MIN_POSITIVE);
        Self { rows: made.rows, seconds, rows_per_second, threads, stages }
    }
}

impl fmt::Display for Timing {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let total = self.stages.values().sum::<f64>().max(f64::MIN_POSITIVE);
        let share = |(stage, seconds): (&&str, &f64)| format!("{stage} {:.0} %", 100.0 * seconds / total);
        let shares: Vec<String> =
            self.stages.iter().map(|(stage, seconds)| share((stage, seconds))).collect();
        write!(
            f,
            "{} rows made in {:.1} s on {} threads, {:.1} rows/s ({})",
            self.rows,
            self.seconds,
            self.threads,
            self.rows_per_second,
            shares.join(", ")
        )
    }
}
