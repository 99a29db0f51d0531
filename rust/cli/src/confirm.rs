//! What is said and asked before a run that takes long.

use crate::error::CliError;
use std::io::{self, BufRead, IsTerminal};

/// Longest time \[s\] that a run may take without a question.
const LONGEST: f64 = 3600.0;

/// A time in words.
pub fn duration(seconds: f64) -> String {
    match seconds {
        ..120.0 => format!("{seconds:.0} s"),
        ..7200.0 => format!("{:.0} minutes", seconds / 60.0),
        ..172_800.0 => format!("{:.1} hours", seconds / 3600.0),
        ..1e8 => format!("{:.1} days", seconds / 86400.0),
        _ => format!("{:.1e} years", seconds / 3.156e7),
    }
}

/// Says how long a run takes, if that is long; asks on a terminal whether to begin, unless `yes`. `advice`: how it may be made shorter.
///
/// # Errors
/// [`CliError::Message`] with the estimate, when the answer is no or nobody can be asked.
pub fn long_run(seconds: f64, advice: &str, yes: bool) -> Result<(), CliError> {
    if seconds <= LONGEST {
        return Ok(());
    }
    let estimate = format!("about {} on this number of threads, by an estimate", duration(seconds));
    if yes {
        outln!("This run takes {estimate}. {advice}");
        return Ok(());
    }
    let refuse =
        |why: &str| Err(CliError::Message(format!("the run would take {estimate}; {why}. {advice}")));
    if !io::stdin().is_terminal() {
        return refuse("--yes begins it");
    }
    outln!("This run takes {estimate}. {advice}");
    out!("Begin it? [y/N]: ");
    crate::output::flush();
    let mut line = String::new();
    match io::stdin().lock().read_line(&mut line) {
        Ok(_) if ["y", "yes"].contains(&line.trim().to_lowercase().as_str()) => Ok(()),
        _ => refuse("it was not begun"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn times_have_units_that_suit_them() {
        let found = [90.0, 3600.0, 20_000.0, 380_000.0, 1e12].map(duration);
        assert_eq!(found, ["90 s", "60 minutes", "5.6 hours", "4.4 days", "3.2e4 years"]);
    }

    #[test]
    fn only_long_runs_need_a_yes() {
        assert!(long_run(LONGEST, "", false).is_ok() && long_run(1e9, "", true).is_ok());
    }
}
