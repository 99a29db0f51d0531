//! Files: written whole or not at all, read up to a limit, and made by one program at a time.
//!
//! | module | what |
//! |---|---|
//! | [`part`] | writes a file next to the one that it will replace, and then renames it |
//! | [`lock`] | a lock, so that only one program at a time works on a file |
//! | [`limit`] | reads files up to a limit of size |
//! | [`folder`] | the contents of a folder |
#![forbid(unsafe_code)]

pub mod folder;
pub mod limit;
pub mod lock;
pub mod part;

pub use folder::list;
pub use limit::{MAX_BYTES, read, read_text};
pub use lock::Lock;
pub use part::{Part, check_target, check_writable, write};

use std::io;
use std::path::PathBuf;

/// What can be wrong with a file. Every message names the file.
#[derive(Debug, thiserror::Error)]
pub enum FileError {
    #[error(
        "{file}: is a symbolic link to {target}, which is neither followed nor replaced; name the file itself or remove the \
         link", file = file.display(), target = target.display()
    )]
    Link { file: PathBuf, target: PathBuf },
    #[error("{file}: is {kind}, allowed: a regular file, or a name that is not there yet", file = file.display())]
    Kind { file: PathBuf, kind: &'static str },
    #[error(
        "{file}: {holder} is at work on it; wait until that has ended", file = file.display()
    )]
    Held { file: PathBuf, holder: String },
    #[error("cannot write {file}: {source}", file = file.display())]
    Write { file: PathBuf, source: io::Error },
    #[error("cannot read {file}: {source}", file = file.display())]
    Read { file: PathBuf, source: io::Error },
    #[error("cannot read {file}: it holds more than {limit} bytes, the most that is read", file = file.display())]
    Large { file: PathBuf, limit: u64 },
    #[error("cannot read {file}: byte {byte} is not UTF-8 text", file = file.display())]
    Text { file: PathBuf, byte: usize },
}

/// A column of a table: name, unit, meaning. The book prints these lists.
pub type Column = (&'static str, &'static str, &'static str);

/// The names of columns, as the head of a table has them.
pub fn names<const N: usize>(columns: &[Column; N]) -> [&'static str; N] {
    columns.map(|(name, _, _)| name)
}
