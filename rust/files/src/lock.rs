//! A lock, so that only one program at a time works on a file.

use crate::{FileError, check_target};
use std::fs::{self, File, TryLockError};
use std::io::{self, Read, Write};
use std::os::unix::fs::MetadataExt;
use std::path::{Path, PathBuf};

/// Shows other programs, by a locked file next to a file, that this program is at work on it. The operating system releases
/// the lock when the program ends, however it ends, so the lock file of a killed program does not keep others out.
#[derive(Debug)]
pub struct Lock {
    path: PathBuf,
    /// The lock file, which is locked as long as it is open.
    file: File,
}

impl Lock {
    /// Takes the lock on `file`: makes and locks the file `FILE.lock`, which is removed when the lock is dropped.
    ///
    /// # Errors
    /// [`FileError::Held`], without waiting, when another program has the lock; those of [`check_target`];
    /// [`FileError::Write`].
    pub fn take(file: &Path) -> Result<Self, FileError> {
        let mut path = file.as_os_str().to_os_string();
        path.push(".lock");
        let path = PathBuf::from(path);
        let failed = |source| FileError::Write { file: path.clone(), source };
        loop {
            check_target(&path)?;
            let options = File::options().read(true).write(true).create(true).truncate(false).clone();
            let mut lock = options.open(&path).map_err(failed)?;
            match lock.try_lock() {
                Ok(()) => (),
                Err(TryLockError::Error(source)) => return Err(failed(source)),
                Err(TryLockError::WouldBlock) => {
                    return Err(FileError::Held { file: file.to_path_buf(), holder: holder(&mut lock) });
                }
            }
            // The previous holder may have removed the file after it was opened here. Then this lock is of no use, because
            // others would make and lock a new file: try again.
            if is_at(&lock, &path).map_err(failed)? {
                lock.set_len(0).and_then(|()| lock.write_all(own_name().as_bytes())).map_err(failed)?;
                return Ok(Self { path, file: lock });
            }
        }
    }
}

impl Lock {
    /// The locked file as a further handle: a program that is started with it, as its standard input, holds the lock, too,
    /// even if this program is killed.
    ///
    /// # Errors
    /// [`FileError::Write`].
    pub fn handle(&self) -> Result<File, FileError> {
        self.file.try_clone().map_err(|source| FileError::Write { file: self.path.clone(), source })
    }
}

impl Drop for Lock {
    fn drop(&mut self) {
        let _ = fs::remove_file(&self.path);
    }
}

fn is_at(file: &File, path: &Path) -> io::Result<bool> {
    let own = file.metadata()?;
    match fs::symlink_metadata(path) {
        Ok(there) => Ok((own.dev(), own.ino()) == (there.dev(), there.ino())),
        Err(error) if error.kind() == io::ErrorKind::NotFound => Ok(false),
        Err(error) => Err(error),
    }
}

fn own_name() -> String {
    let host = fs::read_to_string("/proc/sys/kernel/hostname").unwrap_or_default();
    let host = if host.trim().is_empty() { "this machine" } else { host.trim() };
    format!("process {} on {host}", std::process::id())
}

fn holder(lock: &mut File) -> String {
    let mut text = String::new();
    match lock.take(200).read_to_string(&mut text) {
        Ok(_) if !text.is_empty() => text,
        _ => "another process".to_string(),
    }
}
