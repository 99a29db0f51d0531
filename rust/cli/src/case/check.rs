//! `msdd case check`.

use crate::error::CliError;
use clap::Args;
use msdd_case::check::{Finding, Severity, check};
use std::path::{Path, PathBuf};

#[derive(Args)]
#[command(
    after_help = "Each line is an error (the solver refuses the case) or a warning (the solver runs it, but the result may not be what was meant), with
file, key, value and what is allowed. The exit status is 1 with errors, 0 without. 'msddFoam -dry-run' makes all that a run needs, on the
mesh of the case or, where there is none, on the mesh of blockMeshDict in a copy. No step is computed and the case is left as it is.
Libraries, plug-ins and coded conditions that the case names are loaded.

Example: msdd case check cases/H"
)]
pub struct Arguments {
    /// The case folder.
    folder: PathBuf,
}

pub fn run(arguments: &Arguments) -> Result<(), CliError> {
    let found = check(&arguments.folder).map_err(|problem| CliError::Message(problem.to_string()))?;
    report(&arguments.folder, &found)
}

/// Checks a case and prints what is found; without the solver, that the case is not checked.
///
/// # Errors
/// [`CliError::Message`] with the number of errors.
pub fn report_or_note(folder: &Path) -> Result<(), CliError> {
    match check(folder) {
        Ok(found) => report(folder, &found),
        Err(problem) => {
            outln!("{}: not checked: {problem}", folder.display());
            Ok(())
        }
    }
}

fn report(folder: &Path, found: &[Finding]) -> Result<(), CliError> {
    for finding in found {
        outln!("{finding}");
    }
    let count = |severity| found.iter().filter(|finding| finding.severity == severity).count();
    let many = |count: usize, what: &str| format!("{count} {what}{}", if count == 1 { "" } else { "s" });
    let (errors, warned) = (count(Severity::Error), count(Severity::Warning));
    let warnings = many(warned, "warning");
    let folder = folder.display();
    if errors > 0 {
        let errors = many(errors, "error");
        return Err(CliError::Message(format!(
            "{folder}: {errors} and {warnings}; the case will not run as it is"
        )));
    }
    match warned {
        0 => outln!("{folder}: checked, no errors, no warnings"),
        _ => outln!("{folder}: checked, no errors, {warnings}"),
    }
    Ok(())
}
