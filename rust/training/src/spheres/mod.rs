//! Data of the law of spheres: paths of strain of boxes and of beds that were poured.

pub mod beds;
mod same;
mod tracks;

use crate::error::TrainingError;
use msdd_rve::database::{Recipe, SpherePlan, read_spheres};
use msdd_surrogate::DatabaseProvenance;
use msdd_surrogate::document::hash;
use msdd_surrogate::spheres::tracks::{Track, set_aside};
use same::SeenValues;
use std::path::PathBuf;

/// Name of the kind of model.
pub const KIND: &str = "spheres";

/// The paths of all files and folders of beds, packings numbered on, and where they come from.
///
/// # Errors
/// Files that cannot be read; boxes of unequal spheres; data of different materials.
pub fn read(files: &[PathBuf]) -> Result<(Vec<Track>, DatabaseProvenance), TrainingError> {
    let (mut all, mut next) = (Vec::new(), 0);
    let (mut plans, mut rows) = (String::new(), String::new());
    let mut provenance = DatabaseProvenance::default();
    let mut known = SeenValues::default();
    for file in files {
        if file.is_dir() {
            let (tracks, text) = beds::tracks(file, next, &mut known)?;
            next = tracks.iter().map(|track| track.packing + 1).max().unwrap_or(next);
            plans += &hash(&text);
            rows += &text;
            all.extend(tracks);
            continue;
        }
        let mut dataset = read_spheres(file)?;
        let plan = dataset.provenance.get("plan").map_or("", String::as_str);
        if SpherePlan::parse(plan, "plan")
            .is_ok_and(|plan| plan.spheres.iter().any(|block| block.sizes.is_some()))
        {
            return Err(TrainingError::Data(format!(
                "{}: sizes: boxes of unequal spheres, allowed: of equal ones, for which the law is",
                file.display()
            )));
        }
        dataset.records.iter_mut().for_each(|record| record.packing += next);
        next = dataset.records.iter().map(|record| record.packing + 1).max().unwrap_or(next);
        all.extend(tracks::tracks(&dataset.records));
        let value = |key: &str| dataset.provenance.get(key).cloned().unwrap_or_default();
        plans += &value("plan_hash");
        rows += &serde_json::to_string(&dataset.records)
            .map_err(|error| TrainingError::Data(format!("{}: {error}", file.display())))?;
        provenance.engine_version = value("engine_version");
        provenance.material = serde_json::from_str(&value("material")).unwrap_or_default();
        known.agree(file, same::of_database(&provenance.material))?;
    }
    provenance.plan_hash = if files.len() > 1 { hash(&plans) } else { plans };
    provenance.rows_hash = Some(hash(&rows));
    set_aside(&mut all);
    Ok((all, provenance))
}
