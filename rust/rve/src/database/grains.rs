//! What a database holds rows of.

use super::spheres::SphereRecord;
use super::table::Row;
use super::{DatabaseError, csv_file, schema};
use msdd_files::FileError;
use std::io::Read;
use std::path::Path;

/// The grains of a database.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Grains {
    Discs,
    Spheres,
}

/// What a database, or the CSV that was exported from one, holds rows of. What holds no rows of spheres is taken for a file
/// of discs, whose reader says what is wrong with it.
///
/// # Errors
/// A file that cannot be read.
pub fn grains(path: &Path) -> Result<Grains, DatabaseError> {
    let of_spheres = if is_sqlite(path)? {
        let connection = schema::open(path, false);
        connection.is_ok_and(|connection| schema::holds::<SphereRecord>(&connection).unwrap_or(false))
    } else {
        csv_file::head(path)?
            .is_some_and(|head| head.iter().any(|name| name == SphereRecord::COLUMNS[1].0.as_bytes()))
    };
    Ok(if of_spheres { Grains::Spheres } else { Grains::Discs })
}

/// Whether a file is an SQLite database.
///
/// # Errors
/// A file that cannot be read, or is no regular file.
pub(super) fn is_sqlite(path: &Path) -> Result<bool, DatabaseError> {
    let failed = |source| FileError::Read { file: path.to_path_buf(), source };
    // Only regular files: a pipe can be read only once, and a device has no end.
    if !std::fs::metadata(path).map_err(failed)?.is_file() {
        let problem = "it is no regular file".to_string();
        return Err(DatabaseError::Format { path: path.to_path_buf(), problem });
    }
    let mut start = Vec::new();
    std::fs::File::open(path).map_err(failed)?.take(16).read_to_end(&mut start).map_err(failed)?;
    Ok(start == b"SQLite format 3\0")
}
