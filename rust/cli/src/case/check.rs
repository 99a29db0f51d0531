//! `msdd case check`.

use crate::error::CliError;
use clap::Args;
use msdd_case::check::check_with_solver;
use std::path::{Path, PathBuf};

#[derive(Args)]
#[command(
    after_help = "Each line is an error (the solver refuses the case) or a doubt (the solver runs it, but the result may be wrong), with file, key,
value, what is allowed, and what to do. The exit status is 1 with errors, 0 without. If msddFoam is installed, 'msddFoam -dry-run' makes
all that a run needs, on the mesh of the case, and its messages are listed. No step is computed and the case is left as it is;
OpenFOAM must be installed, because its program foamDictionary reads the files.

Example: msdd case check cases/H"
)]
pub struct Arguments {
    /// The case folder.
    folder: PathBuf,
}

pub fn run(arguments: &Arguments) -> Result<(), CliError> {
    report(&arguments.folder)
}

/// Prints what a check finds.
///
/// # Errors
/// [`CliError::Message`] with the number of errors.
pub fn report(folder: &Path) -> Result<(), CliError> {
    let (found, omission) = check_with_solver(folder);
    for finding in &found.0 {
        outln!("{finding}");
    }
    if !omission.is_empty() {
        outln!("{omission}");
    }
    let [errors, doubts] = found.counts();
    let many =
        |count: usize, what: &str| if count == 1 { format!("1 {what}") } else { format!("{count} {what}s") };
    let folder = folder.display();
    if errors > 0 {
        let (errors, doubts) = (many(errors, "error"), many(doubts, "doubt"));
        return Err(CliError::Message(format!(
            "{folder}: {errors} and {doubts}; the case will not run as it is"
        )));
    }
    match doubts {
        0 => outln!("{folder}: checked, nothing is missing, out of range or doubtful"),
        _ => outln!("{folder}: checked, no errors, {}", many(doubts, "doubt")),
    }
    Ok(())
}
