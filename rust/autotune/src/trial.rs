//! The case folder of a combination, and its run.

use crate::ChoiceError;
use crate::mirror::{self, Mirror};
use crate::program::foam;
use crate::quantity::Quantity;
use crate::series::Series;
use crate::settings::{Level, Settings};
use crate::user_case::UserCase;
use msdd_case::tables;
use msdd_files::{Lock, list, read_text, write};
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use std::fmt::Write as _;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::time::Instant;

/// Name of the function objects whose results are compared.
const WATCH: &str = "msddChoice";
/// File that shows that a folder was made here, so that it may be replaced.
const OURS: &str = ".msdd-autotune";

/// What a case folder is for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Purpose {
    /// To be compared with others: nothing is written but what that takes.
    Trial,
    /// The run that the user asked for, with all that he wants written.
    Chosen,
}

/// What a run has given.
#[derive(Clone, Debug)]
pub struct Outcome {
    pub values: BTreeMap<Quantity, Series>,
    /// Thermal strain of the grains, and pressure at each point after the first step \[Pa\], if that was watched.
    pub strain: Series,
    pub start_pressure: Vec<f64>,
    /// Largest minus smallest T anywhere, the walls included \[K\].
    pub range: f64,
    pub cells: usize,
    /// Wall time with the making of the mesh \[s\].
    pub seconds: f64,
    /// Processor time of the solver alone \[s\].
    pub processor: f64,
    /// What lies beyond the values by which the model was compared with DEM.
    pub beyond: Option<Beyond>,
    /// The solver's warnings at its start.
    pub warnings: Vec<String>,
}

/// Beyond what was compared nothing is known of the model's error.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Beyond {
    /// First time at which that was so \[s\].
    pub since: f64,
    /// Each quantity with its values.
    pub what: Vec<String>,
}

impl Beyond {
    /// As the solver's summary reports it.
    fn read(summary: &serde_json::Value) -> Option<Self> {
        let compared = &summary["compared"];
        let what = compared["beyond"].as_array()?.iter().filter_map(|part| part.as_str().map(str::to_string));
        Some(Self { since: compared["beyond_since"].as_f64()?, what: what.collect() })
    }

    /// In a cell of a table: the quantities with the value that is farthest beyond.
    pub fn brief(&self) -> String {
        let brief = |part: &String| part.split([',', '(']).next().unwrap_or_default().trim().to_string();
        self.what.iter().map(brief).collect::<Vec<_>>().join("; ")
    }
}

impl Outcome {
    /// A quantity that every run has.
    ///
    /// # Panics
    /// For a displacement of a run in which the grains stay.
    pub fn series(&self, quantity: Quantity) -> &Series {
        &self.values[&quantity]
    }
}

/// Makes the case of `settings` in `folder`, which stands next to the user's, so that relative paths in its files mean the same.
/// `range`: of T \[K\], once it is known.
///
/// # Errors
/// When files cannot be read or written, OpenFOAM cannot make the mesh or map the fields, or `folder` is somebody else's.
pub fn make(
    scene: &UserCase,
    settings: &Settings,
    range: Option<f64>,
    purpose: Purpose,
    folder: &Path,
) -> Result<(), ChoiceError> {
    copy(scene, folder, &|name| overrides(scene, settings, range, purpose, name))?;
    if purpose == Purpose::Chosen {
        accompany(scene, folder)?;
    }
    let halved = scene.halves(settings).contains(&true);
    if !halved && settings.levels.iter().all(|&level| level == Level::Halved(0)) {
        return link_mesh(scene, folder);
    }
    foam(folder, &mut Command::new("blockMesh"))?;
    // Only boxes with uniform fields mirror.
    if halved || scene.averages().is_some() {
        return Ok(());
    }
    let fields = list(&folder.join(&scene.start))?;
    let nonuniform: Vec<PathBuf> = fields
        .into_iter()
        .filter(|file| {
            read(file).is_ok_and(|bytes| holds(&bytes, b"nonuniform") || holds(&bytes, b"#include"))
        })
        .collect();
    if nonuniform.is_empty() {
        return Ok(());
    }
    // Means over the cells of the coarser mesh. The fields of the target would be read, and have the wrong number of values.
    for file in nonuniform {
        remove(&file)?;
    }
    let arguments = ["-consistent", "-mapMethod", "cellVolumeWeight", "-sourceTime", &scene.start];
    foam(folder, Command::new("mapFieldsPar").arg(&scene.folder).args(arguments))?;
    Ok(())
}

/// Scripts of the user's case, and the file that ParaView opens.
fn accompany(scene: &UserCase, folder: &Path) -> Result<(), ChoiceError> {
    for name in ["Allrun", "Allclean"] {
        let (own, copy) = (scene.folder.join(name), folder.join(name));
        if own.is_file() {
            std::fs::copy(&own, &copy).map_err(|error| unreadable(&own, &error))?;
        }
    }
    let name = folder.file_name().unwrap_or_default().to_string_lossy();
    Ok(write(&folder.join(format!("{name}.foam")), b"")?)
}

/// Makes a copy of the user's case as it is in `folder`, which stands next to it; its mesh is linked.
///
/// # Errors
/// When files cannot be read or written, or `folder` is somebody else's.
pub fn plain(scene: &UserCase, folder: &Path) -> Result<(), ChoiceError> {
    copy(scene, folder, &|_| String::new())?;
    link_mesh(scene, folder)
}

/// Copies the user's case without its mesh; `keys` are added at the end of the file of a name.
fn copy(scene: &UserCase, folder: &Path, keys: &dyn Fn(&str) -> String) -> Result<(), ChoiceError> {
    clear(folder)?;
    mark(folder)?;
    for part in [scene.start.as_str(), "constant", "system"] {
        for file in list(&scene.folder.join(part))?.into_iter().filter(|file| file.is_file()) {
            let name = format!("{part}/{}", file.file_name().unwrap_or_default().to_string_lossy());
            let mut bytes = read(&file)?;
            let keys = keys(&name);
            if !keys.is_empty() {
                bytes.extend(format!("\n// Chosen for the wanted accuracy\n{keys}").bytes());
            }
            write(&folder.join(&name), &bytes)?;
        }
    }
    // Folders that a boundary condition or a model may read.
    for other in list(&scene.folder.join("constant"))?.into_iter().filter(|path| path.is_dir()) {
        let name = other.file_name().unwrap_or_default();
        if name != "polyMesh" {
            link(&other, &folder.join("constant").join(name))?;
        }
    }
    Ok(())
}

/// Makes a folder with the file that shows that it was made here. It gets its name when it has that file, so that what a killed
/// program leaves is known.
fn mark(folder: &Path) -> Result<(), ChoiceError> {
    let spare = sweep(folder)?;
    std::fs::create_dir(&spare)
        .and_then(|()| std::fs::write(spare.join(OURS), "Made by msdd, which may replace this folder.\n"))
        .and_then(|()| std::fs::rename(&spare, folder))
        .map_err(|error| unreadable(folder, &error))
}

/// The name that a folder has before it is marked and when it is all but removed. What a kill has left there, at most the mark, is
/// removed.
fn sweep(folder: &Path) -> Result<PathBuf, ChoiceError> {
    let name = folder.file_name().unwrap_or_default().to_string_lossy();
    let spare = folder.with_file_name(format!("{name}.making"));
    let _ = std::fs::remove_file(spare.join(OURS));
    match std::fs::remove_dir(&spare) {
        Err(error) if error.kind() != std::io::ErrorKind::NotFound => {
            Err(ChoiceError::Foreign { folder: spare })
        }
        _ => Ok(spare),
    }
}

fn link_mesh(scene: &UserCase, folder: &Path) -> Result<(), ChoiceError> {
    link(&scene.folder.join("constant/polyMesh"), &folder.join("constant/polyMesh"))
}

/// Refuses a folder that [`make`] has not made.
///
/// # Errors
/// [`ChoiceError::Foreign`].
pub fn check_ours(folder: &Path) -> Result<(), ChoiceError> {
    match folder.symlink_metadata().is_ok() && !folder.join(OURS).is_file() {
        true => Err(ChoiceError::Foreign { folder: folder.to_path_buf() }),
        false => Ok(()),
    }
}

/// Removes a folder that [`make`] has made, if it is there. The file that shows who made it goes last, under another name, so that
/// a kill leaves nothing that would be taken for somebody else's.
///
/// # Errors
/// [`ChoiceError::Foreign`] if it was made by somebody else, [`ChoiceError::Read`] if it cannot be removed.
pub fn clear(folder: &Path) -> Result<(), ChoiceError> {
    check_ours(folder)?;
    let spare = sweep(folder)?;
    if folder.symlink_metadata().is_err() {
        return Ok(());
    }
    for entry in list(folder)?.into_iter().filter(|entry| !entry.ends_with(OURS)) {
        let directory = entry.symlink_metadata().is_ok_and(|of| of.is_dir());
        let removed = if directory { std::fs::remove_dir_all(&entry) } else { std::fs::remove_file(&entry) };
        removed.map_err(|error| unreadable(&entry, &error))?;
    }
    std::fs::rename(folder, &spare).map_err(|error| unreadable(folder, &error))?;
    sweep(folder).map(drop)
}

/// Runs the solver in the folder that [`make`] has made for a combination, or goes on with a run that was killed. The solver holds the lock, too: if this
/// program is killed alone, no other starts a second solver in the folder before the first has ended.
///
/// # Errors
/// [`ChoiceError::Run`] with the solver's message; [`ChoiceError::Read`] when its results cannot be read.
pub fn run(
    scene: &UserCase,
    settings: &Settings,
    folder: &Path,
    lock: &Lock,
) -> Result<Outcome, ChoiceError> {
    let began = Instant::now();
    let log = foam(folder, Command::new("msddFoam").stdin(lock.handle()?))?;
    write(&folder.join("log.msddFoam"), log.as_bytes())?;
    let mut outcome = read_outcome(folder, began.elapsed().as_secs_f64())?;
    turn_back(scene, settings, &mut outcome);
    Ok(outcome)
}

/// Turns displacements around at points whose image in the other half was run.
fn turn_back(scene: &UserCase, settings: &Settings, outcome: &mut Outcome) {
    let halved = scene.halves(settings);
    for (k, quantity) in [Quantity::DisplacementX, Quantity::DisplacementY].into_iter().enumerate() {
        let Some(series) = outcome.values.get_mut(&quantity) else { continue };
        for row in &mut series.values {
            for (value, &point) in row.iter_mut().zip(&scene.points) {
                if mirror::beyond(point, halved, scene.bounds)[k] {
                    *value = -*value;
                }
            }
        }
    }
}

/// Changes of T over T that are none.
const NOISE: f64 = 1e-9;

/// Reads what a run of `seconds` has left in the folder of a combination.
///
/// # Errors
/// [`ChoiceError::File`], [`ChoiceError::Read`] when its results cannot be read.
pub fn read_outcome(folder: &Path, seconds: f64) -> Result<Outcome, ChoiceError> {
    let read = |field: &str| Series::read(folder, WATCH, field);
    let temperature = read("T")?;
    let points = temperature.values.first().map_or(0, Vec::len);
    let mut values = BTreeMap::new();
    let moved = tables::parts(folder, WATCH, Some("D")).is_ok();
    for quantity in Quantity::ALL.into_iter().filter(|quantity| moved || !quantity.needs_motion()) {
        let (field, component) = quantity.field();
        values.insert(quantity, read(field)?.component(points, component));
    }
    let strain = read("thermalStrain")?;
    // None if the first step is longer than the time in which it is watched, as with steps of one size.
    let first = Series::read(folder, &format!("{WATCH}Start"), "pressure").ok();
    let start_pressure = first.and_then(|series| series.values.into_iter().next()).unwrap_or_default();
    let mut range = values[&Quantity::Temperature].range();
    for (_, file) in tables::parts(folder, &format!("{WATCH}Range"), None)? {
        range = range.max(extremes(&file)?);
    }
    // What is left of rounding and of the linear solver, where nothing heats or cools
    if range <= NOISE * values[&Quantity::Temperature].rms() {
        range = 0.0;
    }
    let summary = folder.join("postProcessing/msddFoam/summary.json");
    let text = read_text(&summary)?;
    let summary: serde_json::Value = serde_json::from_str(&text)
        .map_err(|error| ChoiceError::Read { file: summary, problem: error.to_string() })?;
    let cells = summary["cells"].as_u64().unwrap_or(0) as usize;
    let processor = summary["cpu_seconds"].as_f64().unwrap_or(0.0);
    let beyond = Beyond::read(&summary);
    let warnings = serde_json::from_value(summary["warnings"].clone()).unwrap_or_default();
    Ok(Outcome { values, strain, start_pressure, range, cells, seconds, processor, beyond, warnings })
}

/// Keys that are added at the end of a file of the case.
fn overrides(
    scene: &UserCase,
    settings: &Settings,
    range: Option<f64>,
    purpose: Purpose,
    name: &str,
) -> String {
    match name {
        "system/controlDict" => control(scene, settings, purpose),
        "system/fvSolution" => {
            let tolerance = range.map_or(String::new(), |range| {
                format!(" temperatureTolerance {:e};", settings.tolerance * range)
            });
            format!("msddFoam {{ accuracy 0; timeScheme secondOrder;{tolerance} }}\n")
        }
        "constant/granularProperties" => {
            let mechanics = if settings.moves { "equilibrium" } else { "none" };
            let factor = settings.conductivity * scene.conductivity_factor;
            let mut keys = format!("mechanics {mechanics};\nconductivityFactor {factor:e};\n");
            if let (Some([x, y]), Some(model)) = (settings.constant, &scene.model) {
                let _ = writeln!(
                    keys,
                    "surrogate\n{{\n    type constant;\n    constantCoeffs {{ model \"{model}\"; conductivity ({x:e} 0 0 {y:e} 0 {y:e}); }}\n}}"
                );
            }
            keys
        }
        "system/blockMeshDict" => match &scene.blocks {
            Ok(blocks) => {
                let halved = scene.halves(settings);
                let mirror = scene.mirror.as_ref().filter(|_| halved.contains(&true));
                let half = mirror.map_or(String::new(), |mirror| mirror.mesh(halved));
                format!("blocks {};\n{half}", blocks.text(settings))
            }
            Err(_) => String::new(),
        },
        field if field.starts_with(&format!("{}/", scene.start)) => match scene.halves(settings) {
            [false, false] => averaged(scene, settings, &field[scene.start.len() + 1..]),
            halved => Mirror::field(halved),
        },
        _ => String::new(),
    }
}

/// Entry of an initial field on the mesh of a combination; none on the user's mesh, or where OpenFOAM maps the fields.
fn averaged(scene: &UserCase, settings: &Settings, field: &str) -> String {
    let Ok(blocks) = &scene.blocks else { return String::new() };
    let cells = blocks.counts_at(settings)[0];
    if scene.box_cells == Some(cells) {
        return String::new();
    }
    scene.averages().map_or(String::new(), |averages| averages.entry(field, cells))
}

/// When function objects of a trial run write what is compared; fields are not written.
pub fn watched(scene: &UserCase) -> String {
    format!("writeControl adjustableRunTime; writeInterval {:e};", scene.interval())
}

fn control(scene: &UserCase, settings: &Settings, purpose: Purpose) -> String {
    let displacement = if settings.moves { " D" } else { "" };
    let span = scene.end - scene.start_time;
    let first = scene.first_step.min(span / 1000.0);
    let halved = scene.halves(settings);
    let points = scene.points.iter().map(|&point| mirror::inside(point, halved, scene.bounds));
    let points: Vec<String> = points.map(|[x, y, z]| format!("({x} {y} {z})")).collect();
    let when = match purpose {
        Purpose::Trial => watched(scene),
        Purpose::Chosen => "writeControl writeTime;".to_string(),
    };
    let watch = format!(
        "functions\n{{\n    {WATCH}\n    {{\n        type probes; libs (\"libsampling.so\"); interpolationScheme cellPoint;\n\
         \x20       fields (T pressure conductivity thermalStrain{displacement});\n\
         \x20       {when} probeLocations ({});\n    }}\n\
         \x20   {WATCH}Start\n    {{\n        type probes; libs (\"libsampling.so\"); interpolationScheme cellPoint;\n\
         \x20       fields (pressure); probeLocations $..{WATCH}.probeLocations;\n\
         \x20       writeControl timeStep; timeEnd {:e};\n    }}\n\
         \x20   {WATCH}Range\n    {{\n        type fieldMinMax; libs (\"libfieldFunctionObjects.so\"); fields (T); location no;\n\
         \x20       {when}\n    }}\n}}\n",
        points.join(" "),
        scene.start_time + 1.5 * first
    );
    let mut keys = "adjustTimeStep yes;\nwriteControl adjustableRunTime;\n".to_string();
    let _ = writeln!(keys, "deltaT {first:e};");
    match purpose {
        // Only what is watched is written
        Purpose::Trial => {
            let _ = writeln!(keys, "startFrom firstTime;\nwriteInterval {:e};", 2.0 * span);
            keys + "#remove functions\n" + &watch
        }
        Purpose::Chosen => {
            let _ = writeln!(keys, "startFrom latestTime;\nwriteInterval {:e};", scene.write_interval);
            if let (Some(mirror), [true, _] | [_, true]) = (&scene.mirror, halved) {
                keys += &mirror.functions(halved, scene.bounds);
            }
            keys + &watch
        }
    }
}

/// Largest minus smallest value in a file of OpenFOAM's function object `fieldMinMax`.
fn extremes(file: &Path) -> Result<f64, ChoiceError> {
    let text = read_text(file)?;
    let rows = text.lines().filter(|line| !line.trim_start().starts_with('#'));
    let values: Vec<f64> =
        rows.flat_map(|line| line.split_whitespace().skip(1).filter_map(|word| word.parse().ok())).collect();
    let high = values.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    let low = values.iter().copied().fold(f64::INFINITY, f64::min);
    match high >= low {
        true => Ok(high - low),
        false => Err(ChoiceError::Read { file: file.to_path_buf(), problem: "no values".to_string() }),
    }
}

fn holds(bytes: &[u8], word: &[u8]) -> bool {
    bytes.windows(word.len()).any(|window| window == word)
}

fn unreadable(file: &Path, error: &std::io::Error) -> ChoiceError {
    ChoiceError::Read { file: file.to_path_buf(), problem: error.to_string() }
}

fn read(file: &Path) -> Result<Vec<u8>, ChoiceError> {
    std::fs::read(file).map_err(|error| unreadable(file, &error))
}

fn remove(file: &Path) -> Result<(), ChoiceError> {
    std::fs::remove_file(file).map_err(|error| unreadable(file, &error))
}

fn link(from: &Path, to: &Path) -> Result<(), ChoiceError> {
    std::os::unix::fs::symlink(from, to).map_err(|error| unreadable(to, &error))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_a_kill_leaves_is_replaced_and_what_is_the_users_is_kept() {
        let root = std::env::temp_dir().join(format!("msdd-autotune-trial-{}", std::process::id()));
        let (folder, mesh) = (root.join("bed.trial"), root.join("polyMesh"));
        let there = || folder.symlink_metadata().is_ok();
        std::fs::create_dir_all(&mesh).unwrap();
        // As kills leave it: before the name is given, and after it is taken away
        let spare = root.join("bed.trial.making");
        for marked in [false, true] {
            std::fs::create_dir(&spare).unwrap();
            if marked {
                std::fs::write(spare.join(OURS), "").unwrap();
            }
            clear(&folder).unwrap();
            assert!(spare.symlink_metadata().is_err());
        }
        mark(&folder).unwrap();
        std::fs::create_dir(folder.join("system")).unwrap();
        link(&mesh, &folder.join("polyMesh")).unwrap();
        clear(&folder).unwrap();
        assert!(!there() && mesh.is_dir() && spare.symlink_metadata().is_err());
        // The user's, even if it is empty
        std::fs::create_dir(&folder).unwrap();
        assert!(matches!(clear(&folder), Err(ChoiceError::Foreign { .. })));
        std::fs::create_dir_all(folder.join("results")).unwrap();
        assert!(matches!(clear(&folder), Err(ChoiceError::Foreign { .. })));
        assert!(folder.join("results").is_dir());
        std::fs::remove_dir_all(&root).unwrap();
    }
}
