//! Writing a file whole or not at all: it is written next to the one that it will replace, and then renamed.

use crate::FileError;
use std::fs::{self, FileType, Permissions};
use std::io::{self, Write};
use std::os::unix::fs::{FileTypeExt, PermissionsExt};
use std::path::{Path, PathBuf};
use tempfile::NamedTempFile;

/// Largest number of characters of a file's name that are used in the name of its part, because names may have 255 bytes.
const NAME: usize = 30;

/// A file that is being written. It has a unique name, so two writers do not disturb each other, nor does a file that a
/// killed program left. If it is dropped before [`Part::put`], it is removed.
pub struct Part {
    temporary: NamedTempFile,
    file: PathBuf,
}

impl Part {
    /// Makes an empty file next to `file`, and its folder when it is missing.
    ///
    /// # Errors
    /// Those of [`check_target`]; [`FileError::Write`].
    pub fn beside(file: &Path) -> Result<Self, FileError> {
        check_target(file)?;
        let folder = folder(file);
        fs::create_dir_all(folder).map_err(failed(folder))?;
        let name: String =
            file.file_name().unwrap_or_default().to_string_lossy().chars().take(NAME).collect();
        let temporary = tempfile::Builder::new()
            .prefix(&format!("{name}."))
            .suffix(".part")
            // The permissions of any new file; the system removes those in the user's mask (umask).
            .permissions(Permissions::from_mode(0o666))
            .tempfile_in(folder)
            .map_err(failed(file))?;
        Ok(Self { temporary, file: file.to_path_buf() })
    }

    /// Present path of the part.
    pub fn path(&self) -> &Path {
        self.temporary.path()
    }

    /// Replaces the file by this one, after all of it has been written to the disk.
    ///
    /// # Errors
    /// Those of [`check_target`]; [`FileError::Write`].
    pub fn put(self) -> Result<(), FileError> {
        let Self { temporary, file } = self;
        temporary.as_file().sync_all().map_err(failed(&file))?;
        check_target(&file)?;
        temporary.persist(&file).map_err(|error| failed(&file)(error.error))?;
        // Some systems cannot sync a folder, so a failure is ignored; the file is whole in any case.
        let _ = fs::File::open(folder(&file)).and_then(|folder| folder.sync_all());
        Ok(())
    }
}

/// Writes a whole file. Also when the program is killed, the disk is full or another program writes, either the old or the
/// new file is there, never a part of one.
///
/// # Errors
/// Those of [`check_target`]; [`FileError::Write`].
pub fn write(file: &Path, bytes: &[u8]) -> Result<(), FileError> {
    let mut part = Part::beside(file)?;
    part.temporary.write_all(bytes).map_err(failed(file))?;
    part.put()
}

/// Checks that a file can be written, and makes its folder when it is missing: before work that takes long.
///
/// # Errors
/// Those of [`check_target`]; [`FileError::Write`].
pub fn check_writable(file: &Path) -> Result<(), FileError> {
    Part::beside(file).map(drop)
}

/// Checks that a file of this name may be written: there is none yet, or a regular file.
///
/// # Errors
/// [`FileError::Link`] for a symbolic link, wherever it leads; [`FileError::Kind`] for a folder, a device, a pipe.
pub fn check_target(file: &Path) -> Result<(), FileError> {
    let kind = |kind| Err(FileError::Kind { file: file.to_path_buf(), kind });
    if file.file_name().is_none() || file.as_os_str().as_encoded_bytes().ends_with(b"/") {
        return kind("no name of a file");
    }
    let found = match fs::symlink_metadata(file) {
        Ok(metadata) => metadata.file_type(),
        Err(error) if error.kind() == io::ErrorKind::NotFound => return Ok(()),
        Err(error) => return Err(failed(file)(error)),
    };
    if found.is_symlink() {
        let target = fs::read_link(file).unwrap_or_default();
        return Err(FileError::Link { file: file.to_path_buf(), target });
    }
    if found.is_file() { Ok(()) } else { kind(name(found)) }
}

fn name(kind: FileType) -> &'static str {
    match kind {
        kind if kind.is_dir() => "a folder",
        kind if kind.is_char_device() || kind.is_block_device() => "a device",
        kind if kind.is_fifo() => "a pipe",
        _ => "a socket",
    }
}

fn folder(file: &Path) -> &Path {
    file.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."))
}

fn failed(file: &Path) -> impl FnOnce(io::Error) -> FileError + use<> {
    let file = file.to_path_buf();
    |source| FileError::Write { file, source }
}
