//! Checks a case folder before a run: finds what is missing, out of range or doubtful.
//!
//! | module | what |
//! |---|---|
//! | [`bed`] | a bed: a whole case, or a region of one |
//! | `files` | the files that are read |
//! | [`regions`] | cases of several regions |
//! | `header` | the heads of files |
//! | [`finding`] | the findings |
//! | [`keys`] | the keys of the solver's dictionaries and what they may hold |
//! | `dimensions` | dimensions in brackets |
//! | [`grains`] | `constant/granularProperties` and the model |
//! | `gas` | the conductivity of spheres beside that of their gas |
//! | [`gravity`] | `constant/g`, and the stress at the start that follows from it |
//! | [`control`] | `system/controlDict`, `system/fvSolution` |
//! | `linear` | the linear solver of T, and the schemes |
//! | `functions` | function objects that need a flow or a thermo |
//! | `libraries` | libraries and code that a case brings along |
//! | `sizes` | values that no bed has |
//! | `solver` | what the solver finds: `msddFoam -dry-run` |
//! | `start` | the time at which a run begins |
//! | [`mesh`] | the mesh |
//! | `domain` | what is known of a mesh |
//! | `blocks` | `system/blockMeshDict` |
//! | `made` | the files in `constant/polyMesh` |
//! | `probes` | probes outside of the mesh |
//! | `sources` | sources and constraints |
//! | `zones` | zones and sets of cells that are named |
//! | `tables` | functions of temperature or time |
//! | `temperatures` | the temperatures of a bed, and properties that depend on them |
//! | `held` | whether walls hold a bed whose grains move |
//! | `walls` | friction at walls, and wedges |
//! | `weight` | gravity and the stress at the start |
//! | `conditions` | conditions of T with which the solver cannot work |
//! | [`fields`] | the fields in `0` |
//! | [`state`] | the initial state, against the range of the model |
//! | [`scales`] | temperatures, lengths and times, against each other |

pub mod bed;
mod blocks;
mod conditions;
pub mod control;
mod dimensions;
mod domain;
pub mod fields;
mod files;
pub mod finding;
mod functions;
mod gas;
pub mod grains;
pub mod gravity;
mod header;
mod held;
pub mod keys;
mod libraries;
mod linear;
mod made;
pub mod mesh;
mod probes;
pub mod regions;
pub mod scales;
mod sizes;
mod solver;
mod sources;
mod spheres;
mod start;
pub mod state;
mod tables;
mod temperatures;
mod walls;
mod weight;
mod zones;

pub use finding::{Finding, Findings, Severity};

use crate::dictionary::Dictionary;
use crate::path;
use std::path::Path;

/// Files that are read through `foamDictionary`, and whether the solver needs them.
const FILES: [(&str, bool); 13] = [
    (control::DECOMPOSITION, false),
    (control::SOLUTION, true),
    (linear::SCHEMES, true),
    (domain::BLOCKS, false),
    (grains::FILE, true),
    (gravity::FILE, false),
    (sources::FILES[0], false),
    (sources::FILES[1], false),
    ("0/T", true),
    ("0/porosity", true),
    ("0/fabricIndex", true),
    ("0/conductivity", false),
    ("0/stress", false),
];

/// What a check does not look at, in a sentence; empty if it looks at everything.
pub type Omission = &'static str;

/// What the solver does not make of a case of `chtMultiRegionFoam`.
const FLUIDS: Omission =
    "of fluid regions, turbulence and combustion models and the equations are not checked";

/// Checks a case folder as [`check`] does, and lets the solver make all that it needs for a run of it.
pub fn check_with_solver(folder: &Path) -> (Findings, Omission) {
    let mut found = check(folder);
    // Else there is nothing more to say
    if !folder.canonicalize().is_ok_and(|whole| whole.is_dir() && path::check(&whole).is_ok()) {
        return (found, "");
    }
    let Some(program) = solver::program() else {
        return (
            found,
            "msddFoam is not in the path, and was not asked to make the case: . scripts/foam-env",
        );
    };
    let control = Dictionary::expanded(&folder.join(control::CONTROL)).ok();
    let start = start::Start::find(folder, control.as_ref());
    solver::check(&program, folder, &start, &mut found);
    (found, if has_regions_alone(folder) { FLUIDS } else { "" })
}

/// Whether a case is one of `chtMultiRegionFoam`: with a bed outside of the regions it is one of `msddFoam`, with solids.
fn has_regions_alone(folder: &Path) -> bool {
    folder.join(regions::FILE).exists() && !folder.join(grains::FILE).exists()
}

/// Checks a case folder, of `msddFoam` or of several regions. Needs OpenFOAM's `foamDictionary`.
pub fn check(folder: &Path) -> Findings {
    let mut found = Findings::default();
    if !folder.is_dir() {
        found.error(
            [&folder.display().to_string(), ""],
            "no such folder",
            "the folder of a case",
            "'msdd case new' begins one",
        );
        return found;
    }
    if !check_path(folder, &mut found) {
        // OpenFOAM would not find any of the files
        return found;
    }
    if has_regions_alone(folder) {
        regions::check(folder, &mut found);
        return found;
    }
    let own = files::read(folder, &[(control::CONTROL, true)], str::to_string, &mut found);
    let control = files::file(&own, control::CONTROL);
    let start = start::Start::find(folder, control);
    let mut files = files::read(folder, &FILES, |name| start.path(name), &mut found);
    let file = |name: &str| files::file(&files, name);
    let is_plane = file(grains::FILE).is_none_or(grains::is_plane);
    let mesh = mesh::check(&folder.join("constant"), file(domain::BLOCKS), is_plane, &mut found);
    let times =
        control.and_then(|control| control::check(control, file(control::SOLUTION), start.time, &mut found));
    control.into_iter().for_each(|control| functions::check(control, &mut found));
    file(control::DECOMPOSITION).into_iter().for_each(|own| control::check_decomposition(own, &mut found));
    // A library of somebody else may add solvers
    let closed =
        !found.0.iter().any(|finding| [finding.file.as_str(), &finding.key] == [control::CONTROL, "libs"]);
    if let Some(solution) = file(control::SOLUTION).filter(|_| closed) {
        linear::check_solver(solution, &mut found);
    }
    file(linear::SCHEMES).into_iter().for_each(|schemes| linear::check_schemes(schemes, &mesh, &mut found));
    files.extend(own);
    bed::check([folder, Path::new("")], &files, &mesh, (times, &start), &mut found);
    for finding in &mut found.0 {
        finding.file = start.path(&finding.file);
    }
    found
}

/// Refuses paths that OpenFOAM cannot work with; returns whether it can work with this one.
fn check_path(folder: &Path, found: &mut Findings) -> bool {
    let Ok(whole) = folder.canonicalize() else {
        let advice = "The current folder was deleted: go to another";
        found.error(["folder", ""], &folder.display().to_string(), "a folder that is there", advice);
        return false;
    };
    let good = path::check(&whole).is_ok();
    if !good {
        found.error(["folder", ""], &whole.display().to_string(), path::ALLOWED, "move the case");
    }
    good
}
