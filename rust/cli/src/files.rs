//! Files of the program.

use crate::error::CliError;
use std::path::{Path, PathBuf};

/// Reads a text file.
pub fn read_text(path: &Path) -> Result<String, CliError> {
    std::fs::read_to_string(path).map_err(|source| CliError::Read { path: path.to_path_buf(), source })
}

/// Writes beside, then renames: a killed write leaves the old file. Makes the folder when it is missing.
pub fn write_atomically(path: &Path, bytes: &[u8]) -> Result<(), CliError> {
    let failed = |path: &Path| {
        let path: PathBuf = path.to_path_buf();
        move |source| CliError::Write { path, source }
    };
    if let Some(folder) = path.parent().filter(|folder| !folder.as_os_str().is_empty()) {
        std::fs::create_dir_all(folder).map_err(failed(folder))?;
    }
    let mut name = path.file_name().unwrap_or_default().to_os_string();
    name.push(".part");
    let part = path.with_file_name(name);
    std::fs::write(&part, bytes).map_err(failed(&part))?;
    std::fs::rename(&part, path).map_err(failed(path))
}
