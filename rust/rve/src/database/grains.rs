//! What a database holds rows of.

use super::spheres::SphereRecord;
use super::table::Row;
use super::{DatabaseError, csv_file, store};
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
    let of_spheres = match store::is_folder(path)? {
        true => store::provenance_of(path)?.get("grains").is_some_and(|grains| grains == "spheres"),
        false => csv_file::head(path)?
            .is_some_and(|head| head.iter().any(|name| name == SphereRecord::COLUMNS[1].0.as_bytes())),
    };
    Ok(if of_spheres { Grains::Spheres } else { Grains::Discs })
}
