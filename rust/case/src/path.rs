//! Paths that OpenFOAM can work with.

use crate::{CaseError, refused};
use std::path::Path;

/// What is allowed.
pub const ALLOWED: &str = "a path without blanks and quotation marks, which OpenFOAM cannot work with";

/// Refuses a path with blanks or quotation marks: OpenFOAM removes them from paths and then finds no files.
///
/// # Errors
/// [`CaseError::Parameter`].
pub fn check(whole: &Path) -> Result<(), CaseError> {
    let is_refused = |byte: &u8| byte.is_ascii_whitespace() || b"\"'".contains(byte);
    match whole.as_os_str().as_encoded_bytes().iter().any(is_refused) {
        true => Err(refused("folder", whole.display().to_string(), ALLOWED)),
        false => Ok(()),
    }
}
