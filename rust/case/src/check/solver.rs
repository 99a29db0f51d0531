//! What the solver finds: `msddFoam -dry-run` makes all that a run needs, and lists every error and warning.
//!
//! A case without mesh gets the one of `system/blockMeshDict`, in a copy beside the case that is removed again: paths that lead
//! out of the case folder work there as well.

use super::domain::BLOCKS;
use super::finding::{Finding, Findings, Severity};
use super::start::Start;
use crate::openfoam;
use msdd_rve::message::shortened;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Output;

/// Name of the program.
pub const PROGRAM: &str = "msddFoam";
/// Where the build of a checkout puts it.
const BUILT: &str = "openfoam/platforms/bin";
/// Text in front of the list of its findings.
const LIST: &str = "Dry run: ";

/// The solver's program: in the path, or in the checkout in which this program was built.
pub fn program() -> Option<PathBuf> {
    let paths = std::env::var_os("PATH").unwrap_or_default();
    let own = std::env::current_exe().ok();
    let checkouts = own.iter().flat_map(|own| own.ancestors()).map(|folder| folder.join(BUILT));
    let places: Vec<PathBuf> = std::env::split_paths(&paths).chain(checkouts).collect();
    places.into_iter().map(|place| place.join(PROGRAM)).find(|file| file.is_file())
}

/// Adds what the solver finds in a case. Errors of the other checks about the same entry are left out.
pub fn check(program: &Path, folder: &Path, start: &Start, found: &mut Findings) {
    let copy = match Copy::with_mesh(folder, start) {
        Ok(copy) => copy,
        Err(problem) => return found.error([BLOCKS, ""], &problem, "", "blockMesh makes no mesh of it"),
    };
    let place = copy.as_ref().map_or(folder, |copy| &copy.0);
    let output = openfoam::command(program)
        .env("LD_LIBRARY_PATH", libraries(program))
        .args(["-dry-run", "-case"])
        .arg(place)
        .output();
    let findings = match output.map_err(|error| error.to_string()).and_then(|output| findings(&output, place))
    {
        Ok(findings) => findings,
        // What ends the solver early often ended foamDictionary, too
        Err(_) if found.counts()[0] > 0 => return,
        Err(problem) => return found.0.push(finding(Severity::Error, &problem)),
    };
    // The mesh itself was judged
    found.0.retain(|old| old.file != BLOCKS || old.severity == Severity::Doubt);
    found.0.retain(|old| !findings.iter().any(|new| is_same(old, new)));
    found.0.extend(findings);
}

/// The folders of libraries, with those of the solver.
fn libraries(program: &Path) -> std::ffi::OsString {
    let own = program.parent().map(|bin| bin.with_file_name("lib"));
    let others = std::env::var_os("LD_LIBRARY_PATH").unwrap_or_default();
    std::env::join_paths(own.into_iter().chain(std::env::split_paths(&others))).unwrap_or(others)
}

/// The findings in the list that the solver prints last; else how it ended.
fn findings(output: &Output, folder: &Path) -> Result<Vec<Finding>, String> {
    let text = String::from_utf8_lossy(&output.stdout);
    if let Some((_, list)) = text.rsplit_once(LIST) {
        return Ok(list.lines().filter_map(listed).collect());
    }
    let stderr = String::from_utf8_lossy(&output.stderr);
    let said = message(if stderr.trim().is_empty() { &text } else { &stderr }, folder);
    Err(format!("{PROGRAM} -dry-run ended with {}: {said}", output.status))
}

/// The finding of a line "Error 1: text".
fn listed(line: &str) -> Option<Finding> {
    let (head, text) = line.split_once(": ")?;
    match head.split_once(' ')?.0 {
        // OpenFOAM lists a hundred types
        "Error" => Some(finding(Severity::Error, &shortened(text))),
        "Warning" => Some(finding(Severity::Doubt, text)),
        _ => None,
    }
}

/// A finding of a text that may begin with a file.
fn finding(severity: Severity, text: &str) -> Finding {
    let (file, advice) = match text.split_once(": ") {
        Some((file, rest)) if file.contains('/') && !file.replace(", line ", "").contains(' ') => {
            (file, rest)
        }
        _ => ("", text),
    };
    let [key, value, allowed] = [(); 3].map(|()| String::new());
    Finding { severity, file: file.to_string(), key, value, allowed, advice: advice.to_string() }
}

/// Whether an error is about the entry that an error of the solver is about.
fn is_same(old: &Finding, new: &Finding) -> bool {
    let whole = format!("{} {}", new.file, new.advice);
    let words = || whole.split(|c: char| !c.is_alphanumeric() && c != '_');
    let key = old.key.rsplit('/').next().unwrap_or_default();
    [old.severity, new.severity] == [Severity::Error; 2]
        && whole.contains(&old.file)
        && (["", "internalField"].contains(&key) || words().any(|word| word == key))
}

/// The end of what a program has printed, on one line.
fn message(text: &str, folder: &Path) -> String {
    let text = text.rsplit_once("FATAL").map_or(text, |(_, rest)| rest);
    let words: Vec<&str> = text.split_whitespace().take(80).collect();
    shortened(&words.join(" ").replace(&format!("{}/", folder.display()), ""))
}

/// A copy of a case that is removed when this is dropped.
struct Copy(PathBuf);

impl Copy {
    /// A copy with a mesh of a case that has none, but a blockMeshDict; none of other cases.
    fn with_mesh(folder: &Path, start: &Start) -> Result<Option<Self>, String> {
        let missing: Vec<String> =
            regions(folder).into_iter().filter(|region| has_no_mesh(folder, region)).collect();
        if missing.is_empty() {
            return Ok(None);
        }
        let whole = folder.canonicalize().map_err(|error| error.to_string())?;
        let name =
            format!(".{}.check-{}", whole.file_name().unwrap_or_default().display(), std::process::id());
        let beside = whole.with_file_name(&name);
        let place = if fs::create_dir(&beside).is_ok() { beside } else { std::env::temp_dir().join(name) };
        let copy = Self(place);
        for part in ["system", "constant", start.name.as_str()] {
            copy_folder(&whole.join(part), &copy.0.join(part))
                .map_err(|error| format!("cannot copy {part}: {error}"))?;
        }
        for region in missing {
            let mut command = openfoam::command(Path::new("blockMesh"));
            if !region.is_empty() {
                command.args(["-region", &region]);
            }
            let output = command.arg("-case").arg(&copy.0).output().map_err(|error| error.to_string())?;
            if !output.status.success() {
                return Err(message(&String::from_utf8_lossy(&output.stderr), &copy.0));
            }
        }
        Ok(Some(copy))
    }
}

impl Drop for Copy {
    fn drop(&mut self) {
        let _ = fs::remove_dir_all(&self.0);
    }
}

/// Names of the regions with a blockMeshDict; that of the bed is empty.
fn regions(folder: &Path) -> Vec<String> {
    let system = folder.join("system");
    let entries = fs::read_dir(&system).into_iter().flatten().flatten();
    let names = entries.filter_map(|entry| entry.file_name().into_string().ok());
    let all = std::iter::once(String::new()).chain(names);
    all.filter(|name| system.join(name).join("blockMeshDict").is_file()).collect()
}

fn has_no_mesh(folder: &Path, region: &str) -> bool {
    let mesh = folder.join("constant").join(region).join("polyMesh");
    !["faces", "faces.gz"].iter().any(|name| mesh.join(name).exists())
}

/// Copies a folder with all that it holds; one that is not there is left out.
fn copy_folder(from: &Path, to: &Path) -> std::io::Result<()> {
    if !from.is_dir() {
        return Ok(());
    }
    fs::create_dir_all(to)?;
    for entry in fs::read_dir(from)? {
        let (path, target) = {
            let entry = entry?;
            (entry.path(), to.join(entry.file_name()))
        };
        if path.is_dir() {
            copy_folder(&path, &target)?;
        } else {
            fs::copy(&path, &target)?;
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_list_of_the_solver_is_read() {
        let error =
            listed("Error 1: constant/granularProperties.surrogate, line 20: Unknown entry 'modle'").unwrap();
        assert_eq!(
            error.to_string(),
            "error: constant/granularProperties.surrogate, line 20: Unknown entry 'modle'"
        );
        let doubt = listed("Warning 2: The mesh has 2 parts: no heat passes").unwrap();
        assert_eq!(doubt.to_string(), "doubt: The mesh has 2 parts: no heat passes");
        assert!(listed("Time = 3").is_none() && listed("End").is_none());
        let own = |file: &str, key: &str| {
            let mut found = Findings::default();
            found.error([file, key], "x", "y", "");
            found.0.remove(0)
        };
        assert!(is_same(&own("constant/granularProperties", "surrogate/modle"), &error));
        assert!(!is_same(&own("constant/granularProperties", "surrogate/model"), &error));
        assert!(!is_same(&own("0/T", "modle"), &error) && !is_same(&own("0/T", "modle"), &doubt));
        let field =
            listed("Error 2: Field porosity in 0/porosity is 12.5 in cell 0, allowed: between 0 and 1")
                .unwrap();
        assert!(field.file.is_empty() && is_same(&own("0/porosity", "internalField"), &field));
    }
}
