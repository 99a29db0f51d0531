//! Progress of long work on standard error: a bar with the time left on a terminal, else a line every ten seconds.

use indicatif::{ProgressBar, ProgressStyle};
use std::io::IsTerminal;
use std::time::{Duration, Instant};

/// Time between two lines when standard error is not a terminal.
const LINE_EVERY: Duration = Duration::from_secs(10);

pub struct Progress {
    bar: Option<ProgressBar>,
    what: &'static str,
    start: Instant,
    /// Count at the first report. It was done by an earlier run, so it is left out when the time left is estimated.
    first: Option<u64>,
    last_line: Instant,
}

impl Progress {
    pub fn new(what: &'static str, total: u64) -> Self {
        let style = "{msg} [{elapsed_precise}] {wide_bar} {pos}/{len} ({eta} left)";
        let bar = std::io::stderr().is_terminal().then(|| {
            let bar = ProgressBar::new(total).with_message(what);
            match ProgressStyle::with_template(style) {
                Ok(style) => bar.with_style(style),
                Err(_) => bar,
            }
        });
        Self { bar, what, start: Instant::now(), first: None, last_line: Instant::now() }
    }

    /// Shows `done` of `total`, with a note.
    pub fn set(&mut self, done: u64, total: u64, note: &str) {
        let first = *self.first.get_or_insert(done);
        if let Some(bar) = &self.bar {
            if done == first {
                bar.reset_eta();
            }
            bar.set_length(total);
            bar.set_position(done);
            bar.set_message(format!("{} {note}", self.what));
            return;
        }
        if self.last_line.elapsed() >= LINE_EVERY || done == total {
            self.last_line = Instant::now();
            let elapsed = self.start.elapsed().as_secs_f64();
            let left = match (total - done, done - first) {
                (0, _) | (_, 0) => String::new(),
                (rest, new) => format!(", {:.0} s left", elapsed / new as f64 * rest as f64),
            };
            note!("{} {done}/{total} after {elapsed:.0} s{left} {note}", self.what);
        }
    }

    pub fn finish(&self) {
        if let Some(bar) = &self.bar {
            bar.finish_and_clear();
        }
    }
}
