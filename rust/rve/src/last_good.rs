//! What is left of a run that failed: its last good state, beside the file that it was to write.

use crate::Simulation;
use crate::state::{StateError, to_file};
use std::path::{Path, PathBuf};

/// Writes `state` to `<out>.last-good.json` and returns that path. It is a state file like any other: it can be averaged,
/// looked at, and run on.
///
/// # Errors
/// [`LastGoodError`] when the state has no text or the file cannot be written.
pub fn write(out: &Path, state: &Simulation) -> Result<PathBuf, LastGoodError> {
    let mut name = out.as_os_str().to_os_string();
    name.push(".last-good.json");
    let file = PathBuf::from(name);
    msdd_files::write(&file, to_file(state)?.as_bytes())?;
    Ok(file)
}

/// Why there is no last good state.
#[derive(Debug, thiserror::Error)]
pub enum LastGoodError {
    #[error(transparent)]
    State(#[from] StateError),
    #[error(transparent)]
    File(#[from] msdd_files::FileError),
}
