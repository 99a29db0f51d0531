//! The last good state of a run that failed, written next to the file that the run should have written.

use crate::Simulation;
use crate::state::{StateError, to_file};
use std::path::{Path, PathBuf};

/// Writes `state` to `<out>.last-good.json` and returns that path. It is an ordinary state file: it can be averaged,
/// drawn, and continued.
///
/// # Errors
/// [`LastGoodError`] when the state cannot be converted to text or the file cannot be written.
pub fn write(out: &Path, state: &Simulation) -> Result<PathBuf, LastGoodError> {
    write_text(out, &to_file(state)?)
}

/// As [`write()`], with the text of the state.
///
/// # Errors
/// [`LastGoodError::File`].
pub fn write_text(out: &Path, text: &str) -> Result<PathBuf, LastGoodError> {
    let mut name = out.as_os_str().to_os_string();
    name.push(".last-good.json");
    let file = PathBuf::from(name);
    msdd_files::write(&file, text.as_bytes())?;
    Ok(file)
}

/// Reasons why the last good state could not be written.
#[derive(Debug, thiserror::Error)]
pub enum LastGoodError {
    #[error(transparent)]
    State(#[from] StateError),
    #[error(transparent)]
    File(#[from] msdd_files::FileError),
}
