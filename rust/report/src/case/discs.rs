//! The box of discs of a case: whether discs can be made for it, and which.

use crate::ReportError;
use crate::jobs::job::{CaseDiscs, CaseJob, CaseProgram};
use msdd_autotune::user_case::UserCase;
use msdd_case::dictionary::{Dictionary, Entry};
use msdd_case::packing::{sum_porosity, usual_fabric};
use msdd_case::{Case, CaseError};
use msdd_dem_reference::model::Filling;
use msdd_dem_reference::run::estimated_steps;
use msdd_rve::Compression;
use std::path::Path;

/// Number of discs that are simulated, at most, and at least.
const DISCS: [usize; 2] = [100, 20_000];
/// Processor time of a disc's step [s], which decides what is begun at all.
const STEP: f64 = 1e-7;
/// Processor time after which a packing is stopped \[s\].
pub const LIMIT: u64 = 3600;
/// Seeds of the packings; a quick report takes the first.
const SEEDS: [u64; 3] = [1, 2, 3];

/// The box of a case and its packings.
pub struct Discs {
    /// Lower left corner and size of the box \[m\].
    pub place: [[f64; 2]; 2],
    /// Range of T of the start and the walls \[K\].
    pub range: f64,
    pub jobs: Vec<CaseJob>,
}

/// What is packed for a case.
///
/// # Errors
/// [`ReportError::Case`] with file, key, value and what is allowed if discs cannot be made for the case.
pub fn of(scene: &UserCase, checksum: &str, quick: bool) -> Result<Discs, ReportError> {
    let folder = &scene.folder;
    check_mesh(scene)?;
    let case = Case::read(folder)?;
    check_walls(folder)?;
    let [porosity, fabric] = ["porosity", "fabricIndex"].map(|name| {
        let file = folder.join("0").join(name);
        Dictionary::expanded(&file).and_then(|field| field.mean("internalField"))
    });
    let (porosity, fabric) = (porosity?, fabric?);
    let of_field = |error| match error {
        CaseError::Parameter { value, allowed, .. } => CaseError::Key {
            file: folder.join("0/porosity"),
            key: "internalField".to_string(),
            value,
            allowed,
        },
        other => other,
    };
    // The packing with the nearer fabric index.
    let away = |compression| (fabric - usual_fabric(compression)).abs();
    let isotropic = away(Compression::Isotropic) < away(Compression::Horizontal);
    let filling =
        Filling { porosity: sum_porosity(porosity).map_err(of_field)?, isotropic, ..Filling::of(&case) };
    let discs = filling.discs(&case);
    let refuse = |file: &str, key: &str, value: String, allowed: String| {
        Err(CaseError::Key { file: folder.join(file), key: key.to_string(), value, allowed }.into())
    };
    let [least, most] = DISCS;
    if !(least..=most).contains(&discs) {
        let radius = |count: usize| case.mean_radius * (discs as f64 / count as f64).sqrt();
        let allowed = format!(
            "{:.3e} to {:.3e} m for this box: {least} to {most} discs, it has {discs}",
            radius(most),
            radius(least)
        );
        return refuse("constant/granularProperties", "meanRadius", case.mean_radius.to_string(), allowed);
    }
    let cost = discs as f64 * STEP * estimated_steps(&case);
    if cost > LIMIT as f64 {
        let allowed = format!(
            "at most about {:.2e} s for discs: {discs} of them take {:.1e} steps to the end, and {LIMIT} s of processor time are \
             allowed",
            case.end_time * LIMIT as f64 / cost,
            estimated_steps(&case)
        );
        return refuse("system/controlDict", "endTime", case.end_time.to_string(), allowed);
    }
    let job = |&seed: &u64| CaseJob {
        folder: folder.clone(),
        checksum: checksum.to_string(),
        program: CaseProgram::Discs(CaseDiscs { seed, porosity, isotropic, interval: scene.interval() }),
        limit: LIMIT,
    };
    let seeds = if quick { &SEEDS[..1] } else { &SEEDS[..] };
    let range = case.temperature_range();
    Ok(Discs { place: [case.origin, case.size], range, jobs: seeds.iter().map(job).collect() })
}

/// The mesh is one block in the plane.
fn check_mesh(scene: &UserCase) -> Result<(), CaseError> {
    let refuse = |value: String| {
        CaseError::Key {
        file: scene.folder.join("system/blockMeshDict"),
        key: "blocks".to_string(),
        value,
        allowed: "one block along the axes in the plane of x and y for discs, whose mesh is that of constant/polyMesh"
            .to_string(),
    }
    };
    match &scene.blocks {
        Err(why) => Err(refuse(why.clone())),
        Ok(blocks) if blocks.counts.len() != 1 => Err(refuse(format!("{} blocks", blocks.counts.len()))),
        Ok(blocks) if blocks.counts[0][2] != 1 => {
            Err(refuse(format!("{} cells along z", blocks.counts[0][2])))
        }
        Ok(_) => Ok(()),
    }
}

/// The walls of the discs are rigid and do not move.
fn check_walls(folder: &Path) -> Result<(), CaseError> {
    let grains = Dictionary::expanded(&folder.join("constant/granularProperties"))?;
    let Ok(walls) = grains.dictionary_at("equilibriumCoeffs").and_then(|own| own.dictionary_at("walls"))
    else {
        return Ok(());
    };
    for key in walls.keys() {
        let Some(Entry::Dictionary(wall)) = walls.get_any(&key.text) else { continue };
        if let Ok(kind) = wall.text("type")
            && kind != "rigid"
        {
            return Err(wall.refuse("type", &kind, "rigid for discs"));
        }
        if wall.get("displacement").is_some() {
            return Err(wall.refuse("displacement", "...", "no motion of the walls for discs"));
        }
    }
    Ok(())
}
