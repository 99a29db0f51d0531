//! Printing. When standard output cannot be written, for example because a disk is full, the work goes on and its files are
//! written; the error is reported at the end.

use crate::error::CliError;
use std::fmt::Arguments;
use std::io::{self, Write};
use std::path::Path;
use std::sync::OnceLock;

/// The first failure to write to standard output.
static FAILED: OnceLock<io::Error> = OnceLock::new();

/// As `println!`, but never panics.
macro_rules! outln {
    () => { $crate::output::print(format_args!("\n")) };
    ($($text:tt)*) => { $crate::output::print(format_args!("{}\n", format_args!($($text)*))) };
}

/// As `print!`, but never panics.
macro_rules! out {
    ($($text:tt)*) => { $crate::output::print(format_args!($($text)*)) };
}

/// Prints a line on standard error; a failure is ignored.
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
    // A failure is ignored, because there is no other place where it could be reported.
    let _ = writeln!(io::stderr(), "{text}");
}

fn keep(result: io::Result<()>) {
    if let Err(error) = result {
        let _ = FAILED.set(error);
    }
}

/// Flushes standard output. An error when anything could not be written.
pub fn finish() -> Result<(), CliError> {
    keep(io::stdout().flush());
    FAILED.get().map_or(Ok(()), |error| Err(CliError::Output(error.to_string())))
}

fn json(value: &impl serde::Serialize) -> Result<String, CliError> {
    serde_json::to_string_pretty(value).map_err(|error| CliError::Message(error.to_string()))
}

/// Writes a value as JSON.
///
/// # Errors
/// When it has no form in JSON, or the file cannot be written.
pub fn write_json(path: &Path, value: &impl serde::Serialize) -> Result<(), CliError> {
    Ok(msdd_files::write(path, (json(value)? + "\n").as_bytes())?)
}

/// Prints a value as JSON.
///
/// # Errors
/// When it has no form in JSON.
pub fn print_json(value: &impl serde::Serialize) -> Result<(), CliError> {
    outln!("{}", json(value)?);
    Ok(())
}
