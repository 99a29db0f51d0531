//! Warnings about a database before it is used.

use crate::error::CliError;
use msdd_rve::database::has_checksum;
use std::path::Path;

/// Warns of files without checksums.
pub fn warn_without_checksum(files: impl IntoIterator<Item = impl AsRef<Path>>) -> Result<(), CliError> {
    for file in files {
        let file = file.as_ref();
        // A folder of beds has none.
        if !file.is_dir() && !has_checksum(file)? {
            note!(
                "warning: {} has no checksums, so damage that violates no exact law is not noticed; msdd database seal adds them",
                file.display()
            );
        }
    }
    Ok(())
}
