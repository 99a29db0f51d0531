//! What the program prints. A full disk behind standard output ends neither the work nor its files; it is told at the end.

use crate::error::CliError;
use std::fmt::Arguments;
use std::io::{self, Write};
use std::sync::OnceLock;

/// The first failure.
static FAILED: OnceLock<io::Error> = OnceLock::new();

/// `println!`, but never a panic.
macro_rules! outln {
    () => { $crate::output::print(format_args!("\n")) };
    ($($text:tt)*) => { $crate::output::print(format_args!("{}\n", format_args!($($text)*))) };
}

/// `print!`, but never a panic.
macro_rules! out {
    ($($text:tt)*) => { $crate::output::print(format_args!($($text)*)) };
}

/// A line on standard error, as far as it takes it.
macro_rules! note {
    ($($text:tt)*) => { $crate::output::note(format_args!($($text)*)) };
}

pub fn print(text: Arguments) {
    keep(io::stdout().lock().write_fmt(text));
}

/// Shows what was printed so far, before an answer is waited for.
pub fn flush() {
    keep(io::stdout().flush());
}

pub fn note(text: Arguments) {
    // There is no other place to complain at.
    let _ = writeln!(io::stderr(), "{text}");
}

fn keep(result: io::Result<()>) {
    if let Err(error) = result {
        let _ = FAILED.set(error);
    }
}

/// Whether all of it was written.
pub fn finish() -> Result<(), CliError> {
    keep(io::stdout().flush());
    FAILED.get().map_or(Ok(()), |error| Err(CliError::Output(error.to_string())))
}
