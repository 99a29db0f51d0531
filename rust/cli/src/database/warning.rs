//! What a user should know of a database before anything is made of it.

use crate::error::CliError;
use msdd_rve::database::has_checksum;
use std::path::Path;

/// Says which files have no checksums, before anything is made of them.
pub fn warn_without_checksum(files: impl IntoIterator<Item = impl AsRef<Path>>) -> Result<(), CliError> {
    for file in files {
        let file = file.as_ref();
        if !has_checksum(file)? {
            note!(
                "warning: {} has no checksums, so damage that breaks no law goes unseen; msdd database seal gives it some",
                file.display()
            );
        }
    }
    Ok(())
}
