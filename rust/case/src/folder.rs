//! Makes the files of a new case. The folder is complete and includes no files of other cases, so it can stand anywhere.

use crate::disc_model;
use crate::fields::{FieldKind, head, uniform};
use crate::numbers::{plain, rounded};
use crate::packing::{Packing, Spread};
use crate::path;
use crate::scene::DiscCase;
use crate::values::{compression_name, fill, stop_when_steady, values};
use crate::{CaseError, refused};
use std::fs;
use std::os::unix::fs::PermissionsExt;
use std::path::{Path, PathBuf};

macro_rules! template {
    ($name:literal) => {
        include_str!(concat!("../templates/", $name))
    };
}

/// Text of `constant/fvOptions`, without its head, for heat released in the bed \[W/m³\].
pub fn heat_source(in_bed: f64) -> String {
    template!("fvOptions").replace("@heatSource@", &plain(in_bed))
}

/// One file of a case: path below the folder, text, and whether it is executable.
pub struct File {
    pub path: &'static str,
    pub text: String,
    pub program: bool,
}

impl File {
    /// A file of OpenFOAM, with its head.
    pub fn foam(path: &'static str, class: &str, text: &str) -> Self {
        let object = path.rsplit('/').next().unwrap_or(path);
        Self { path, text: head(class, object) + text, program: false }
    }

    /// A field of the start with one value for all cells; `path`: in the folder `0`.
    pub fn field(path: &'static str, kind: FieldKind, note: &str, value: &str) -> Self {
        Self { path, text: uniform(path.trim_start_matches("0/"), kind, note, value), program: false }
    }
}

/// Refuses a folder that cannot become a case; `force` allows one that is not empty.
///
/// # Errors
/// [`CaseError::Parameter`].
pub fn check_folder(folder: &Path, force: bool) -> Result<PathBuf, CaseError> {
    let refuse = |value: &Path, allowed: &str| Err(refused("folder", value.display().to_string(), allowed));
    let Ok(whole) = std::path::absolute(folder) else {
        return refuse(folder, "a folder, or a name that is not there yet");
    };
    path::check(&whole)?;
    let holds = fs::read_dir(folder).map(|mut entries| entries.next().is_some());
    match holds {
        Ok(true) if !force => refuse(
            folder,
            "an empty folder, or a name that is not there yet; with --force the files that 'case new' writes are replaced, and \
             all others stay",
        ),
        Ok(_) => Ok(whole),
        Err(_) if folder.symlink_metadata().is_err() => Ok(whole),
        Err(_) => refuse(folder, "a folder, or a name that is not there yet"),
    }
}

/// The files of the case. `checkout`: folder of MSDD in which the solver was built; `name`: name of the case folder.
pub fn files(scene: &DiscCase, packing: &Packing, name: &str, checkout: &Path) -> Vec<File> {
    let values = values(scene, packing, name, checkout);
    let filled = |template: &str| fill(template, &values);
    let foam = |path, class: &str, template: &str| File::foam(path, class, &filled(template));
    let tolerance = match scene.tolerance {
        Some(value) => format!("temperatureTolerance    {};", plain(value)),
        None => "// temperatureTolerance    0.05;".to_string(),
    };
    let mut files = with_keys(name, checkout, tolerance, scene.steady);
    files.extend([
        File { path: "README.md", text: filled(template!("README.md")), program: false },
        foam("constant/granularProperties", "dictionary", template!("granularProperties")),
        foam("system/controlDict", "dictionary", template!("controlDict")),
        foam("system/blockMeshDict", "dictionary", template!("blockMeshDict")),
        foam("system/decomposeParDict", "dictionary", template!("decomposeParDict")),
        foam("0/T", "volScalarField", template!("T")),
    ]);
    if scene.heat_source.is_some() {
        files.push(foam("constant/fvOptions", "dictionary", template!("fvOptions")));
    }
    if let Some(text) = scene.model.file() {
        files.push(File { path: disc_model::FILE, text: text.to_string(), program: false });
    }
    files.extend(initial_fields(packing));
    files
}

/// The files that hardly depend on the bed: what runs and removes, and numerical schemes. `tolerance`: error of T that a step may
/// make \[K\]; `grains`: number of grains of the bed, of which the mesh may be a part.
pub fn programs(name: &str, checkout: &Path, tolerance: f64, grains: usize, steady: bool) -> Vec<File> {
    let keys = format!(
        "temperatureTolerance    {};\n\n    // Number of grains of the whole bed, for 'msdd case solve'\n    grains                  {grains};",
        plain(rounded(tolerance, 2))
    );
    with_keys(name, checkout, keys, steady)
}

/// These files with the first keys of `system/fvSolution`.
fn with_keys(name: &str, checkout: &Path, keys: String, steady: bool) -> Vec<File> {
    let keys = keys + &stop_when_steady(steady);
    let values =
        vec![("checkout", checkout.display().to_string()), ("name", name.to_string()), ("tolerance", keys)];
    let foam = |path, template: &str| File::foam(path, "dictionary", &fill(template, &values));
    vec![
        File { path: "Allrun", text: fill(template!("Allrun"), &values), program: true },
        File { path: "Allclean", text: fill(template!("Allclean"), &values), program: true },
        foam("system/fvSchemes", template!("fvSchemes")),
        foam("system/fvSolution", template!("fvSolution")),
    ]
}

/// Writes the files, each whole or not at all; a folder that is not there yet gets its name when all of them are in it. Until then
/// it is `<name>.making`, which a killed program leaves behind and the next one replaces.
///
/// # Errors
/// [`CaseError::File`].
pub fn write(folder: &Path, files: &[File]) -> Result<(), CaseError> {
    let Some(name) = folder.file_name().filter(|_| !folder.exists()) else {
        return write_files(folder, files);
    };
    let mut making = name.to_os_string();
    making.push(".making");
    let making = folder.with_file_name(making);
    let failed = |source| msdd_files::FileError::Write { file: making.clone(), source };
    if making.exists() {
        fs::remove_dir_all(&making).map_err(failed)?;
    }
    write_files(&making, files)?;
    Ok(fs::rename(&making, folder).map_err(failed)?)
}

fn write_files(folder: &Path, files: &[File]) -> Result<(), CaseError> {
    for file in files {
        let path = folder.join(file.path);
        msdd_files::write(&path, file.text.as_bytes())?;
        if file.program {
            let failed = |source| msdd_files::FileError::Write { file: path.clone(), source };
            let mode = fs::metadata(&path).map_err(failed)?.permissions().mode();
            // Executable for everybody who may read it.
            fs::set_permissions(&path, fs::Permissions::from_mode(mode | (mode & 0o444) >> 2))
                .map_err(failed)?;
        }
    }
    Ok(())
}

/// The fields porosity, fabricIndex and stress, with the same value in all cells.
fn initial_fields(packing: &Packing) -> Vec<File> {
    let origin = format!(
        "Mean of {} periodic boxes of {} packed grains, {} compression: written by 'msdd case new'",
        packing.boxes,
        packing.grains,
        compression_name(packing.compression)
    );
    let field =
        |path, kind, what: &str, value: String| File::field(path, kind, &format!("{what}\n{origin}"), &value);
    let [xx, yy] = packing.stress.map(|stress| -rounded(stress.mean, 5));
    let ratio = |spread: Spread| format!("{:.4}", spread.mean);
    let porosity = "Initial porosity: share of the plane without grains, overlaps counted once";
    let fabric = "Initial fabric index F_xx - F_yy: above 0 when more contacts point along x";
    let stress = "Initial stress (xx xy xz yy yz zz) [Pa], tension positive as everywhere in OpenFOAM";
    vec![
        field("0/porosity", FieldKind::Ratio, porosity, ratio(packing.porosity)),
        field("0/fabricIndex", FieldKind::Ratio, fabric, ratio(packing.fabric_index)),
        field("0/stress", FieldKind::Stress, stress, format!("({xx} 0 0 {yy} 0 0)")),
    ]
}

#[cfg(test)]
#[path = "folder_tests.rs"]
mod tests;
