//! OpenFOAM's programs and the solver.

use crate::ChoiceError;
use std::path::Path;
use std::process::Command;

/// OpenFOAM's programs need to know where Debian's package has its `etc/`.
const DEBIAN_PROJECT_DIR: &str = "/usr/share/openfoam";
/// Number of last lines that stand for a message, where a program ends without one.
const LAST: usize = 4;
/// Largest number of characters of a program's message.
const MESSAGE: usize = 2000;

/// Runs one of OpenFOAM's programs, or the solver, in a case folder and returns what it prints. Its standard input is that of
/// `command`; none of them reads it.
///
/// # Errors
/// [`ChoiceError::Run`] with the last lines that it printed.
pub fn foam(folder: &Path, command: &mut Command) -> Result<String, ChoiceError> {
    let program = command.get_program().to_string_lossy().into_owned();
    let failed = |problem: String| ChoiceError::Run {
        program: program.clone(),
        folder: folder.to_path_buf(),
        problem,
    };
    command.current_dir(folder).env("PWD", folder);
    if std::env::var_os("WM_PROJECT_DIR").is_none() {
        command.env("WM_PROJECT_DIR", DEBIAN_PROJECT_DIR);
    }
    let output = command
        .output()
        .map_err(|error| failed(format!("{error} (. scripts/foam-env sets the paths of the solver)")))?;
    let text = String::from_utf8_lossy(&output.stdout).into_owned();
    if output.status.success() {
        return Ok(text);
    }
    let all = format!("{text}\n{}", String::from_utf8_lossy(&output.stderr));
    let said: Vec<&str> = match all.find("FOAM FATAL") {
        // The message, without the line before it and the lines on where it comes from.
        Some(at) => {
            let body = all[at..].lines().skip(1);
            body.take_while(|line| !line.trim_start().starts_with("From ")).collect()
        }
        None => {
            let lines: Vec<&str> = all.lines().filter(|line| !line.trim().is_empty()).collect();
            lines[lines.len().saturating_sub(LAST)..].to_vec()
        }
    };
    let said = said.join(" ").split_whitespace().collect::<Vec<_>>().join(" ");
    let tail: String = said.chars().take(MESSAGE).collect();
    Err(failed(format!("{}: {tail}", output.status)))
}
