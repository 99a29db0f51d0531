//! The contents of a folder.

use crate::FileError;
use std::path::{Path, PathBuf};

/// Files and folders in `folder`, sorted by name, because the order of the system differs from machine to machine.
///
/// # Errors
/// [`FileError::Read`] with the folder.
pub fn list(folder: &Path) -> Result<Vec<PathBuf>, FileError> {
    let failed = |source| FileError::Read { file: folder.to_path_buf(), source };
    let entries = std::fs::read_dir(folder).map_err(failed)?;
    let mut files: Vec<PathBuf> =
        entries.map(|entry| entry.map(|e| e.path())).collect::<Result<_, _>>().map_err(failed)?;
    files.sort();
    Ok(files)
}
