//! Reads files up to a limit of size.

use crate::FileError;
use std::fs::File;
use std::io::Read;
use std::path::Path;

/// Largest number of bytes that is read of a file, 25 times that of the largest file so far. With a limit, a device without
/// an end, or a small file that unpacks to a huge one, is an error, and does not use up the memory.
pub const MAX_BYTES: u64 = 1 << 29;

/// Reads a file of at most `limit` bytes.
///
/// # Errors
/// [`FileError::Read`]; [`FileError::Large`] when the file has more bytes.
pub fn read(file: &Path, limit: u64) -> Result<Vec<u8>, FileError> {
    let failed = |source| FileError::Read { file: file.to_path_buf(), source };
    let mut bytes = Vec::new();
    File::open(file).map_err(failed)?.take(limit + 1).read_to_end(&mut bytes).map_err(failed)?;
    match bytes.len() as u64 > limit {
        true => Err(FileError::Large { file: file.to_path_buf(), limit }),
        false => Ok(bytes),
    }
}

/// Reads a text of at most [`MAX_BYTES`].
///
/// # Errors
/// Those of [`read`]; [`FileError::Text`] for bytes that are not UTF-8.
pub fn read_text(file: &Path) -> Result<String, FileError> {
    String::from_utf8(read(file, MAX_BYTES)?)
        .map_err(|error| FileError::Text { file: file.to_path_buf(), byte: error.utf8_error().valid_up_to() })
}
