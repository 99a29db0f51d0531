//! Makes the case folder of a job with spheres, and compares a run in it with DEM of the case.

use crate::jobs::job::SpheresJob;
use crate::{ReportError, read_text, write_text};
use std::path::Path;
use std::process::Command;

const MESH: &str = "system/blockMeshDict";
const ELEMENTS: &str = "dem.csv";

/// Writes the case of `job` into `folder`.
///
/// # Errors
/// When files of the case cannot be read or written, or the mesh has not the text that the job changes.
pub fn write_case(checkout: &Path, job: &SpheresJob, folder: &Path) -> Result<(), ReportError> {
    let case = checkout.join("cases").join(&job.case);
    for part in ["0", "constant", "system"] {
        for file in msdd_files::list(&case.join(part))? {
            // The mesh of an earlier run by hand.
            if file.is_dir() {
                continue;
            }
            let mut text = read_text(&file)?.replace("\"../../", &format!("\"{}/cases/", checkout.display()));
            let name = format!("{part}/{}", file.file_name().unwrap_or_default().to_string_lossy());
            if name == MESH {
                text = changed(&text, &job.mesh)
                    .map_err(|from| ReportError::Read { file, problem: format!("no '{from}' in it") })?;
            }
            let keys = job.append.get(&name).map_or("", String::as_str);
            write_text(&folder.join(&name), &format!("{text}\n{keys}"))?;
        }
    }
    if !job.compare.is_empty() {
        write_text(&folder.join(ELEMENTS), &read_text(&case.join(ELEMENTS))?)?;
    }
    Ok(())
}

/// All changes at once: what one has put there is not changed by another.
///
/// # Errors
/// What is to be changed and is not there.
fn changed(text: &str, changes: &[(String, String)]) -> Result<String, String> {
    let mark = |k: usize| format!("\u{0}{k}\u{0}");
    let mut text = text.to_string();
    for (k, (from, _)) in changes.iter().enumerate() {
        if !text.contains(from) {
            return Err(from.clone());
        }
        text = text.replace(from, &mark(k));
    }
    Ok(changes.iter().enumerate().fold(text, |text, (k, (_, to))| text.replace(&mark(k), to)))
}

/// The table of differences from DEM; empty without these.
///
/// # Errors
/// Why there is none.
pub fn compared(checkout: &Path, job: &SpheresJob, folder: &Path) -> Result<String, String> {
    if job.compare.is_empty() {
        return Ok(String::new());
    }
    let program = checkout.join("cases/common/compare-dem");
    let output = Command::new(&program).args(&job.compare).current_dir(folder).output();
    let output = output.map_err(|error| format!("{}: {error}", program.display()))?;
    let text = |bytes: &[u8]| String::from_utf8_lossy(bytes).into_owned();
    if output.status.success() { Ok(text(&output.stdout)) } else { Err(text(&output.stderr)) }
}
