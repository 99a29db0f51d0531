//! A file in the making, beside the one that it will replace.

use crate::FileError;
use std::fs::{self, FileType, Permissions};
use std::io::{self, Write};
use std::os::unix::fs::{FileTypeExt, PermissionsExt};
use std::path::{Path, PathBuf};
use tempfile::NamedTempFile;

/// Characters of a file's name that stand in the name of its part: names have 255 bytes at most.
const NAME: usize = 30;

/// A file in the making. It has a name that nothing had before, so two writers do not meet and what a killed one left is in
/// nobody's way. Dropped before [`Part::put`], it is gone.
pub struct Part {
    temporary: NamedTempFile,
    file: PathBuf,
}

impl Part {
    /// Begins an empty file beside `file`, whose folder is made when it is missing.
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
            // As any new file has them: the system takes away what the user's mask says.
            .permissions(Permissions::from_mode(0o666))
            .tempfile_in(folder)
            .map_err(failed(file))?;
        Ok(Self { temporary, file: file.to_path_buf() })
    }

    /// Where it stands now.
    pub fn path(&self) -> &Path {
        self.temporary.path()
    }

    /// Puts it in the place of the file, once it is on the disk.
    ///
    /// # Errors
    /// Those of [`check_target`]; [`FileError::Write`].
    pub fn put(self) -> Result<(), FileError> {
        let Self { temporary, file } = self;
        temporary.as_file().sync_all().map_err(failed(&file))?;
        check_target(&file)?;
        temporary.persist(&file).map_err(|error| failed(&file)(error.error))?;
        // Some systems cannot do that to a folder; the file is whole with or without.
        let _ = fs::File::open(folder(&file)).and_then(|folder| folder.sync_all());
        Ok(())
    }
}

/// Writes a whole file: a kill, a full disk or another writer leave the old file or the new one.
///
/// # Errors
/// Those of [`check_target`]; [`FileError::Write`].
pub fn write(file: &Path, bytes: &[u8]) -> Result<(), FileError> {
    let mut part = Part::beside(file)?;
    part.temporary.write_all(bytes).map_err(failed(file))?;
    part.put()
}

/// Whether a file of this name may be written: nothing or a regular file stands there.
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
