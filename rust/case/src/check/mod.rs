//! Checks a case folder before a run: finds what is missing, out of range or doubtful.
//!
//! | module | what |
//! |---|---|
//! | [`finding`] | the findings |
//! | [`keys`] | the keys of the solver's dictionaries and what they may hold |
//! | [`grains`] | `constant/granularProperties` and the model |
//! | [`control`] | `system/controlDict`, `system/fvSolution` |
//! | [`mesh`] | mesh and `system/blockMeshDict` |
//! | [`fields`] | the fields in `0` |
//! | [`state`] | the initial state, against the range of the model |
//! | [`scales`] | temperatures, lengths and times, against each other |

pub mod control;
pub mod fields;
pub mod finding;
pub mod grains;
pub mod keys;
pub mod mesh;
pub mod scales;
pub mod state;

pub use finding::{Finding, Findings, Severity};

use crate::dictionary::Dictionary;
use crate::grains::Grains;
use crate::path;
use fields::FIELDS;
use rayon::prelude::*;
use std::path::Path;

/// Files that are read through `foamDictionary`, and whether the solver needs them.
const FILES: [(&str, bool); 11] = [
    (control::CONTROL, true),
    (control::SOLUTION, true),
    ("system/fvSchemes", true),
    (mesh::BLOCKS, false),
    (grains::FILE, true),
    (scales::SOURCES, false),
    ("0/T", true),
    ("0/porosity", true),
    ("0/fabricIndex", true),
    ("0/conductivity", false),
    ("0/stress", false),
];

/// Checks a case folder. Needs OpenFOAM's `foamDictionary`.
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
    check_path(folder, &mut found);
    let files = read(folder, &mut found);
    let file = |name: &str| files.iter().find(|(path, _)| *path == name).map(|(_, dictionary)| dictionary);
    let mesh = mesh::check(folder, file(mesh::BLOCKS), &mut found);
    let times = file(control::CONTROL)
        .and_then(|control| control::check(control, file(control::SOLUTION), &mut found));
    let properties = file(grains::FILE);
    let model =
        properties.and_then(|properties| grains::check(folder, properties, &mesh.names(), &mut found));
    let values = FIELDS.each_ref().map(|field| {
        file(field.file).and_then(|dictionary| fields::check(field, dictionary, &mesh, &mut found))
    });
    let [temperature, porosity, fabric_index, conductivity, stress] = &values;
    let scene = scales::Scene::new(file("0/T"), temperature.as_ref(), file(scales::SOURCES), &mesh, times);
    scene.check_walls(&mut found);
    let grains = properties.and_then(numbers);
    if let (Some(grains), Some(porosity), Some(fabric_index)) = (grains, porosity, fabric_index) {
        scene.check_cells(&grains, porosity.mean(0), &mut found);
        let (conductivity, stress) = (conductivity.as_ref(), stress.as_ref());
        let start = state::Start { porosity, fabric_index, conductivity, stress };
        if let (Some(model), Some(properties)) = (&model, properties) {
            let bed = state::check(model.as_ref(), &start, &grains, properties, &mut found);
            scene.check_strains(&grains, &bed, &mut found, |strain, found| {
                state::walk(model.as_ref(), &start, &grains, strain, found);
            });
            scene.check_times(&bed, &mut found);
        }
    }
    found
}

/// Refuses paths that OpenFOAM cannot work with.
fn check_path(folder: &Path, found: &mut Findings) {
    let whole = folder.canonicalize().unwrap_or_default();
    if path::check(&whole).is_err() {
        found.error(["folder", ""], &whole.display().to_string(), path::ALLOWED, "move the case");
    }
}

/// Reads the files of the case, and adds a finding for each that is missing or cannot be read.
fn read(folder: &Path, found: &mut Findings) -> Vec<(&'static str, Dictionary)> {
    let there = |name: &str| folder.join(name).exists() || folder.join(format!("{name}.gz")).exists();
    let results: Vec<_> = FILES
        .par_iter()
        .map(|&(name, required)| {
            (name, required, there(name).then(|| Dictionary::expanded(&folder.join(name))))
        })
        .collect();
    let mut files = Vec::new();
    for (name, required, result) in results {
        match result {
            Some(Ok(dictionary)) => files.push((name, dictionary)),
            Some(Err(error)) => found.refused(name, error, ""),
            None if required => {
                let advice = "The solver needs this file; 'msdd case new' writes a case with all of them";
                found.error([name, ""], "missing", "", advice);
            }
            None => {}
        }
    }
    files
}

/// The six properties of the grains, if all are valid.
fn numbers(file: &Dictionary) -> Option<Grains> {
    let value = |key: &str| {
        let text = file.value(key).ok()?.last()?;
        text.text.parse::<f64>().ok().filter(|value| value.is_finite())
    };
    let grains = Grains {
        density: value("density")?,
        young_modulus: value("youngModulus")?,
        thermal_conductivity: value("thermalConductivity")?,
        heat_capacity: value("heatCapacity")?,
        thermal_expansion: value("thermalExpansion")?,
        mean_radius: value("meanRadius")?,
    };
    grains.check().ok().map(|()| grains)
}
