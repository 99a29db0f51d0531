//! How far a database is, for those who have it made in parts.

use super::plan::Plan;
use super::recipe::Recipe;
use super::spheres::{SpherePlan, SphereRecord};
use super::store::{COMPLETE, Store};
use super::table::Row;
use super::{DatabaseError, Grains, Record, grains, schema};
use std::path::Path;

/// What is stored in a file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Stored {
    /// Number of packings.
    pub packings: usize,
    /// Whether the file is finished: it has all packings of its shard.
    pub complete: bool,
    /// Hash of the plan.
    pub plan_hash: String,
}

/// What is stored in a file, which may be being written; none when there is no file or nothing in it yet.
///
/// # Errors
/// A file that is no database; those of SQLite.
pub fn stored(path: &Path) -> Result<Option<Stored>, DatabaseError> {
    let is_begun = std::fs::metadata(path).is_ok_and(|file| file.len() > 0);
    if !is_begun || schema::open(path, false).is_ok_and(|file| schema::is_empty(&file).unwrap_or(false)) {
        return Ok(None);
    }
    match grains(path)? {
        Grains::Discs => of::<Record>(path),
        Grains::Spheres => of::<SphereRecord>(path),
    }
    .map(Some)
}

fn of<R: Row>(path: &Path) -> Result<Stored, DatabaseError> {
    let store = Store::<R>::open(path)?;
    let mut provenance = store.provenance()?;
    Ok(Stored {
        packings: store.packings()?.len(),
        complete: provenance.contains_key(COMPLETE),
        plan_hash: provenance.remove("plan_hash").unwrap_or_default(),
    })
}

/// Hash of a plan of any grains, and the number of its packings. `file` names it in errors.
///
/// # Errors
/// [`DatabaseError::Plan`].
pub fn planned_packings(text: &str, file: &str) -> Result<(String, usize), DatabaseError> {
    Ok(if SpherePlan::has_sphere_schema(text) {
        let plan = SpherePlan::parse(text, file)?;
        (plan.hash(), plan.jobs().len())
    } else {
        let plan = Plan::parse(text, file)?;
        (plan.hash(), plan.jobs().len())
    })
}
