//! What is left of a run that failed: its last good state, beside the file that it was to write.

use crate::Simulation;
use crate::state::to_json;
use std::ffi::OsString;
use std::io;
use std::path::{Path, PathBuf};

/// Steps between two copies of the state at least: they cost a thousandth of a run.
pub const EVERY: u64 = 1000;

/// Writes `state` to `<out>.last-good.json` and returns that path. It is a state file like any other: it can be averaged,
/// looked at, and run on.
///
/// # Errors
/// What the system says when the file cannot be written.
pub fn write(out: &Path, state: &Simulation) -> io::Result<PathBuf> {
    let file = beside(out, ".last-good.json");
    let part = beside(&file, ".part");
    if let Some(folder) = out.parent().filter(|folder| !folder.as_os_str().is_empty()) {
        std::fs::create_dir_all(folder)?;
    }
    std::fs::write(&part, to_json(state).map_err(io::Error::other)?)?;
    std::fs::rename(&part, &file)?;
    Ok(file)
}

fn beside(path: &Path, ending: &str) -> PathBuf {
    let mut name: OsString = path.file_name().unwrap_or_default().to_os_string();
    name.push(ending);
    path.with_file_name(name)
}
