//! Checks a case folder before a run, with `msddFoam -dry-run`: it makes all that a run needs, and lists every error and warning.
//!
//! A case without a mesh gets the one of `system/blockMeshDict`, in a copy next to the case that is removed again: paths that lead
//! out of the case folder work there as well.

mod copy;
mod finding;

pub use finding::{Finding, Severity};

use crate::openfoam::{self, message};
use crate::path;
use copy::Copy;
use msdd_rve::message::shortened;
use std::path::{Path, PathBuf};
use std::process::Output;

/// Name of the program.
const PROGRAM: &str = "msddFoam";
/// Where the build of a checkout puts it.
const BUILT: &str = "openfoam/platforms/bin";
/// Text in front of the list of its findings.
const LIST: &str = "Dry run: ";

/// The check cannot be made: the solver is not there.
#[derive(Debug, thiserror::Error)]
#[error(
    "msddFoam, which checks cases, is neither in the path nor built above this program: openfoam/Allwmake in the checkout builds it"
)]
pub struct NoSolver;

/// What `msddFoam -dry-run` finds in a case, in its order. The case is left as it is.
///
/// # Errors
/// [`NoSolver`] when the solver is not built.
pub fn check(folder: &Path) -> Result<Vec<Finding>, NoSolver> {
    let error = |text: &str| vec![Finding::new(Severity::Error, text)];
    if !folder.is_dir() {
        let text = format!("{}: no such folder; 'msdd case new' begins a case", folder.display());
        return Ok(error(&text));
    }
    let Ok(whole) = folder.canonicalize() else {
        return Ok(error("the current folder was deleted: go to another"));
    };
    if let Err(problem) = path::check(&whole) {
        return Ok(error(&format!("{problem}: move the case")));
    }
    let program = program().ok_or(NoSolver)?;
    Ok(found_by(&program, &whole).unwrap_or_else(|problem| error(&problem)))
}

/// The solver's program: in the path, or in the checkout in which this program was built.
fn program() -> Option<PathBuf> {
    let paths = std::env::var_os("PATH").unwrap_or_default();
    let own = std::env::current_exe().ok();
    let checkouts = own.iter().flat_map(|own| own.ancestors()).map(|folder| folder.join(BUILT));
    let places: Vec<PathBuf> = std::env::split_paths(&paths).chain(checkouts).collect();
    places.into_iter().map(|place| place.join(PROGRAM)).find(|file| file.is_file())
}

fn found_by(program: &Path, case: &Path) -> Result<Vec<Finding>, String> {
    let copy = Copy::with_mesh(case)?;
    let place = copy.as_ref().map_or(case, Copy::folder);
    let output = openfoam::command(program)
        .env("LD_LIBRARY_PATH", libraries(program))
        .args(["-dry-run", "-case"])
        .arg(place)
        .output();
    listed(&output.map_err(|error| error.to_string())?, place)
}

/// The folders of libraries, with those of the solver.
fn libraries(program: &Path) -> std::ffi::OsString {
    let own = program.parent().map(|bin| bin.with_file_name("lib"));
    let others = std::env::var_os("LD_LIBRARY_PATH").unwrap_or_default();
    std::env::join_paths(own.into_iter().chain(std::env::split_paths(&others))).unwrap_or(others)
}

/// The findings in the list that the solver prints last; else how it ended.
fn listed(output: &Output, folder: &Path) -> Result<Vec<Finding>, String> {
    let text = String::from_utf8_lossy(&output.stdout);
    if let Some((_, list)) = text.rsplit_once(LIST) {
        return Ok(list.lines().filter_map(finding).collect());
    }
    let stderr = String::from_utf8_lossy(&output.stderr);
    let said = message(if stderr.trim().is_empty() { &text } else { &stderr }, folder);
    Err(format!("{PROGRAM} -dry-run ended with {}: {said}", output.status))
}

/// The finding of a line such as "Error 1: text".
fn finding(line: &str) -> Option<Finding> {
    let (head, text) = line.split_once(": ")?;
    match head.split_once(' ')?.0 {
        "Not" => Some(Finding::new(Severity::Omission, text)),
        // OpenFOAM lists a hundred types
        "Error" => Some(Finding::new(Severity::Error, &shortened(text))),
        "Warning" => Some(Finding::new(Severity::Warning, text)),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_list_of_the_solver_is_read_and_folders_that_hold_no_case_are_named() {
        for (line, found) in [
            ("Error 1: constant/g, line 2: 'modle'", "error: constant/g, line 2: 'modle'"),
            ("Warning 2: The mesh has 2 parts: no heat", "warning: The mesh has 2 parts: no heat"),
            ("Not checked: the fluid regions (gas)", "not checked: the fluid regions (gas)"),
            ("Time = 3", ""),
        ] {
            assert_eq!(finding(line).map_or(String::new(), |finding| finding.to_string()), found);
        }
        let blank = std::env::temp_dir().join(format!("msdd {} check", std::process::id()));
        let found = || check(&blank).unwrap().iter().map(Finding::to_string).collect::<Vec<_>>().join("\n");
        assert!(found().ends_with("check: no such folder; 'msdd case new' begins a case"), "{}", found());
        std::fs::create_dir(&blank).unwrap();
        assert!(found().contains("a path without blanks"), "{}", found());
        std::fs::remove_dir(&blank).unwrap();
    }
}
