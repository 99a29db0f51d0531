//! What of the user's case can be chosen.

use crate::ChoiceError;
use crate::average::Averages;
use crate::bed::{BandInputs, Grains};
use crate::mirror::{Files, Mirror, corners};
use crate::settings::{Level, Settings};
use msdd_case::CaseError;
use msdd_case::dictionary::{Dictionary, Entry, Token, joined};
use msdd_case::path;
use sha2::{Digest, Sha256};
use std::path::{Path, PathBuf};
use std::process::Command;
use std::sync::OnceLock;

/// Least and largest accuracy that can be asked for [% of a range].
pub const ACCURACIES: [f64; 2] = [1e-3, 100.0];
/// Points along each direction at which runs are compared.
const POINTS: [usize; 3] = [7, 5, 3];
/// Grains of the window over which a value with a band is a mean.
const WINDOW: f64 = 100.0;
/// Times at which runs are compared, at least.
const TIMES: f64 = 20.0;

/// Numbers of cells of the blocks of `system/blockMeshDict`, and the text around them.
#[derive(Clone, Debug, PartialEq)]
pub struct Blocks {
    tokens: Vec<String>,
    /// Where the three numbers of each block stand in the text.
    places: Vec<usize>,
    /// Numbers of cells of each block.
    pub counts: Vec<[usize; 3]>,
}

impl Blocks {
    fn read(tokens: &[Token]) -> Option<Self> {
        let tokens: Vec<String> = tokens.iter().map(|token| token.text.clone()).collect();
        let (mut places, mut counts) = (Vec::new(), Vec::new());
        let mut at = 0;
        while let Some(hex) = tokens[at..].iter().position(|token| token == "hex") {
            // The list of corners, perhaps the name of a zone, then the list of cells.
            let corners = at + hex + tokens[at + hex..].iter().position(|token| token == ")")?;
            let place = corners + 1 + tokens[corners + 1..].iter().position(|token| token == "(")? + 1;
            let number = |k: usize| tokens.get(place + k)?.parse::<usize>().ok();
            counts.push([number(0)?, number(1)?, number(2)?]);
            places.push(place);
            at = place;
        }
        (!counts.is_empty()).then_some(Self { tokens, places, counts })
    }

    /// The directions that can be chosen by themselves: those of a single block, else all together. Each is the list of places
    /// in the counts of a block.
    pub fn directions(&self) -> Vec<Vec<usize>> {
        let many = |k: &usize| self.counts.iter().any(|count| count[*k] > 1);
        let used: Vec<usize> = (0..3).filter(many).collect();
        match self.counts.len() {
            1 => used.into_iter().map(|k| vec![k]).collect(),
            _ => vec![used],
        }
    }

    /// Fewest cells of any block along a direction.
    pub fn cells(&self, direction: &[usize]) -> usize {
        self.counts.iter().flat_map(|count| direction.iter().map(|&k| count[k])).min().unwrap_or(1)
    }

    /// Numbers of cells of each block of a combination.
    pub fn counts_at(&self, settings: &Settings) -> Vec<[usize; 3]> {
        let mut all = self.counts.clone();
        for (number, (direction, level)) in self.directions().iter().zip(&settings.levels).enumerate() {
            for count in &mut all {
                for &k in direction {
                    count[k] = level.cells(settings.own_cells(number, count[k]));
                }
            }
        }
        all
    }

    /// Number of cells of the mesh.
    pub fn total(&self, settings: &Settings) -> usize {
        self.counts_at(settings).iter().map(|count| count.iter().product::<usize>()).sum()
    }

    /// Directions of a single block along which a combination has fewer cells than the case: name, its cells, those of the case.
    pub fn coarser(&self, settings: &Settings) -> Vec<(&'static str, usize, usize)> {
        let &[counts] = self.counts.as_slice() else { return Vec::new() };
        let all =
            self.directions().into_iter().zip(&settings.levels).enumerate().map(|(number, (k, level))| {
                let own = settings.own_cells(number, counts[k[0]]);
                (["x", "y", "z"][k[0]], level.cells(own), own)
            });
        all.filter(|(_, cells, own)| cells < own).collect()
    }

    /// The entry `blocks` of blockMeshDict.
    pub fn text(&self, settings: &Settings) -> String {
        let mut tokens = self.tokens.clone();
        for (&place, count) in self.places.iter().zip(self.counts_at(settings)) {
            for (k, cells) in count.iter().enumerate() {
                tokens[place + k] = cells.to_string();
            }
        }
        tokens.join(" ")
    }
}

/// The user's case.
#[derive(Clone, Debug)]
pub struct UserCase {
    pub folder: PathBuf,
    /// Name of the folder with the initial fields.
    pub start: String,
    pub start_time: f64,
    pub end: f64,
    pub first_step: f64,
    /// Interval of the times that the user writes \[s\].
    pub write_interval: f64,
    /// Wanted accuracy of T [% of its range], if the case names one.
    pub accuracy: Option<f64>,
    /// Wanted accuracy of p [% of its range], if the case names one.
    pub pressure_accuracy: Option<f64>,
    /// Whether grains move, if the case says so.
    pub moves: Option<bool>,
    /// An error if the mesh is not that of `system/blockMeshDict`; then it is taken as it is, for the reason given.
    pub blocks: Result<Blocks, String>,
    pub cells: usize,
    /// Points at which runs are compared \[m\].
    pub points: Vec<[f64; 3]>,
    pub bed: BandInputs,
    /// Factor of the conductivity that the case requests.
    pub conductivity_factor: f64,
    /// Name of its model, if it is of the type `network`, in whose place a constant conductivity can be taken.
    pub model: Option<String>,
    /// What is known of a box that is its own mirror image.
    pub mirror: Option<Mirror>,
    /// Cells of the mesh along x, y and z, if it is a rectangular box with cells of one size.
    pub box_cells: Option<[usize; 3]>,
    /// What [`UserCase::averages`] has read.
    pub averages: OnceLock<Option<Averages>>,
    /// Lowest and highest coordinates of the mesh \[m\].
    pub bounds: [[f64; 3]; 2],
    /// Whether the mesh extends along z.
    pub in_space: bool,
}

/// Settings are looked for on other meshes of the bed, which solids next to it would have to follow.
fn refuse_regions(folder: &Path) -> Result<(), ChoiceError> {
    let file = folder.join("constant/regionProperties");
    if !file.exists() {
        return Ok(());
    }
    let problem =
        "the bed has solids next to it, allowed where settings are searched: a bed alone".to_string();
    Err(CaseError::Read { file, problem }.into())
}

impl UserCase {
    /// Reads a case folder.
    ///
    /// # Errors
    /// [`ChoiceError::Case`] for files that are missing or wrong, [`ChoiceError::Run`] when the mesh cannot be checked.
    pub fn read(folder: &Path) -> Result<Self, ChoiceError> {
        let folder = std::fs::canonicalize(folder)
            .map_err(|error| CaseError::Read { file: folder.to_path_buf(), problem: error.to_string() })?;
        path::check(&folder)?;
        refuse_regions(&folder)?;
        let expanded = |name: &str| Dictionary::expanded(&folder.join(name));
        let control = expanded("system/controlDict")?;
        let solution = expanded("system/fvSolution")?;
        let grains = expanded("constant/granularProperties")?;
        // A number, perhaps after its dimensions.
        let own = |key: &str| grains.value(key).ok()?.last()?.text.parse::<f64>().ok();
        let conductivity_factor = own("conductivityFactor").unwrap_or(1.0);
        let mean_radius = own("meanRadius").filter(|&value| value > 0.0).ok_or_else(|| CaseError::Read {
            file: folder.join("constant/granularProperties"),
            problem: "meanRadius is missing or not a number, allowed: > 0 m".to_string(),
        })?;
        let positive = |key: &str| control.number(key, |value| value > 0.0, "> 0");
        let (start, start_time) = first_time(&folder)?;
        let end = control.number("endTime", |value| value > start_time, "after the first time")?;
        let first_step = positive("deltaT")?;
        let steps = control.text("writeControl").is_ok_and(|text| text == "timeStep");
        let write_interval = positive("writeInterval")? * if steps { first_step } else { 1.0 };
        let wanted = |key: &str| match solution.get("msddFoam") {
            Some(Entry::Dictionary(own)) if own.get(key).is_some() => {
                let [least, most] = ACCURACIES;
                let allowed = format!("0 (no request), or {least} to {most} %");
                let known = |value: f64| value == 0.0 || (least..=most).contains(&value);
                let value = own.number(key, known, &allowed)?;
                Ok::<_, CaseError>(Some(value).filter(|&value| value > 0.0))
            }
            _ => Ok(None),
        };
        let (accuracy, pressure_accuracy) = (wanted("accuracy")?, wanted("pressureAccuracy")?);
        let grains_given = match solution.get("msddFoam") {
            Some(Entry::Dictionary(own)) if own.get("grains").is_some() => {
                Some(own.number("grains", |value| (1.0..=1e15).contains(&value), "1 to 1e15")?)
            }
            _ => None,
        };
        let moves = grains.text("mechanics").ok().map(|text| text == "equilibrium");
        let mesh = mesh(&folder)?;
        let spheres = grains
            .dictionary_at("surrogate")
            .is_ok_and(|own| own.text("type").is_ok_and(|text| text == "spheres"));
        let bed = mesh.bed(if spheres { Grains::Spheres } else { Grains::Discs }, mean_radius);
        let block_mesh = expanded("system/blockMeshDict").ok();
        let blocks = block_mesh
            .as_ref()
            .and_then(|dictionary| Blocks::read(dictionary.value("blocks").ok()?))
            .ok_or("there is no system/blockMeshDict with blocks of hexahedra")
            .and_then(|blocks| {
                let levels = vec![Level::Halved(0); blocks.directions().len()];
                match blocks.total(&Settings::new(levels, 0.0, false)) == mesh.cells {
                    true => Ok(blocks),
                    false => Err("the mesh is not that of system/blockMeshDict"),
                }
            })
            .map_err(str::to_string);
        let model = model(&grains);
        let single = blocks.as_ref().ok().and_then(|blocks| <[_; 1]>::try_from(blocks.counts.clone()).ok());
        let box_cells = single
            .map(|[count]| count)
            .filter(|_| block_mesh.as_ref().is_some_and(|dictionary| corners(dictionary).is_some()));
        let mirror = match (single, &model, &block_mesh) {
            (Some([count]), Some(_), Some(mesh)) => {
                Mirror::read(&folder, &start, count, &Files { mesh, control: &control, grains: &grains })
            }
            _ => None,
        };
        Ok(Self {
            start,
            start_time,
            end,
            first_step,
            write_interval,
            accuracy,
            pressure_accuracy,
            moves,
            blocks,
            cells: mesh.cells,
            points: mesh.points(),
            bed: BandInputs { grains: grains_given.unwrap_or(bed.grains), ..bed },
            conductivity_factor,
            model,
            mirror,
            box_cells,
            averages: OnceLock::new(),
            bounds: mesh.bounds,
            in_space: mesh.directions[2],
            folder,
        })
    }

    /// Cells along each direction that can be chosen.
    pub fn directions(&self) -> Vec<usize> {
        self.blocks.as_ref().map_or(Vec::new(), |blocks| {
            blocks.directions().iter().map(|direction| blocks.cells(direction)).collect()
        })
    }

    /// Which of these directions mirror.
    pub fn mirrors(&self) -> Vec<bool> {
        match (&self.blocks, &self.mirror) {
            (Ok(blocks), Some(mirror)) => blocks
                .directions()
                .iter()
                .map(|direction| mirror.along.get(direction[0]) == Some(&true))
                .collect(),
            _ => Vec::new(),
        }
    }

    /// Whether halves along x and y are run.
    pub fn halves(&self, settings: &Settings) -> [bool; 2] {
        let mut halves = [false; 2];
        for (number, direction) in self.blocks.iter().flat_map(Blocks::directions).enumerate() {
            for &k in direction.iter().filter(|&&k| k < 2) {
                halves[k] = settings.halves(number);
            }
        }
        halves
    }

    /// The initial fields for means over other cells; none if OpenFOAM has to map them.
    pub fn averages(&self) -> Option<&Averages> {
        let read = || Averages::read(&self.folder.join(&self.start), self.box_cells?);
        self.averages.get_or_init(read).as_ref()
    }

    /// Interval of the times at which runs are compared \[s\]: a part of the user's own interval, so that the times of the chosen
    /// run are among those of all others.
    pub fn interval(&self) -> f64 {
        let span = (self.end - self.start_time) / TIMES;
        let own = self.write_interval.min(self.end - self.start_time);
        own / (own / span).ceil().max(1.0)
    }

    /// Checksum of what a run depends on: this version, the files of the case with their names, those that they include, and the
    /// model or plug-in that it names.
    ///
    /// # Errors
    /// [`ChoiceError::File`].
    pub fn checksum(&self) -> Result<String, ChoiceError> {
        let mut files: Vec<PathBuf> = Vec::new();
        for part in [self.start.as_str(), "constant", "system"] {
            add_all(&self.folder.join(part), DEPTH, &mut files);
        }
        if let Ok(grains) = Dictionary::expanded(&self.folder.join("constant/granularProperties")) {
            for file in models(&grains) {
                add(&self.folder.join(file), &mut files);
            }
        }
        files.sort();
        let mut sum = Sha256::new();
        sum.update(env!("CARGO_PKG_VERSION"));
        for file in files {
            let name = file.strip_prefix(&self.folder).unwrap_or(&file);
            sum.update(name.as_os_str().as_encoded_bytes());
            sum.update([0]);
            sum.update(std::fs::read(&file).unwrap_or_default());
            sum.update([0]);
        }
        Ok(sum.finalize().iter().map(|byte| format!("{byte:02x}")).collect())
    }
}

/// The model of the type `network`, as the file names it.
fn model(grains: &Dictionary) -> Option<String> {
    let surrogate = grains.dictionary_at("surrogate").ok()?;
    let own = surrogate.dictionary_at("networkCoeffs").unwrap_or(surrogate);
    let [name] = own.value("model").ok()? else { return None };
    (surrogate.text("type").ok()? == "network").then(|| name.text.clone())
}

/// Folders in folders in which files of a case are looked for.
const DEPTH: usize = 6;

/// Adds the files of a folder and of those in it.
fn add_all(folder: &Path, depth: usize, files: &mut Vec<PathBuf>) {
    for file in msdd_files::list(folder).unwrap_or_default() {
        if file.is_dir() && depth > 0 {
            add_all(&file, depth - 1, files);
        } else {
            add(&file, files);
        }
    }
}

/// Files of models and plug-ins that `surrogate` names.
fn models(grains: &Dictionary) -> Vec<String> {
    let Ok(surrogate) = grains.dictionary_at("surrogate") else { return Vec::new() };
    let own = surrogate.keys().filter_map(|key| match surrogate.get(&key.text) {
        Some(Entry::Dictionary(own)) => Some(own),
        _ => None,
    });
    let all = std::iter::once(surrogate).chain(own);
    all.flat_map(|dictionary| ["model", "library"].map(|key| dictionary.value(key).map(joined)))
        .filter_map(Result::ok)
        .map(|name| name.trim_matches('"').to_string())
        .collect()
}

/// Adds a file and those that it includes.
fn add(file: &Path, files: &mut Vec<PathBuf>) {
    if !file.is_file() || files.iter().any(|known| known == file) {
        return;
    }
    files.push(file.to_path_buf());
    let text = String::from_utf8_lossy(&std::fs::read(file).unwrap_or_default()).into_owned();
    let folder = file.parent().unwrap_or(Path::new(""));
    for line in text.lines().map(str::trim).filter(|line| line.starts_with("#include")) {
        if let Some(name) = line.split('"').nth(1) {
            add(&folder.join(name), files);
        }
    }
}

/// Name and value of the earliest time folder.
fn first_time(folder: &Path) -> Result<(String, f64), ChoiceError> {
    let names = msdd_files::list(folder)?.into_iter().filter(|path| path.is_dir());
    let times = names.filter_map(|path| {
        let name = path.file_name()?.to_str()?.to_string();
        let time: f64 = name.parse().ok()?;
        Some((name, time))
    });
    times.min_by(|a, b| a.1.total_cmp(&b.1)).ok_or_else(|| {
        let problem = "there is no folder with initial fields, such as 0".to_string();
        CaseError::Read { file: folder.to_path_buf(), problem }.into()
    })
}

/// The mesh of a case: number of cells, lowest and highest coordinates [m], and the directions in which it extends.
struct Mesh {
    cells: usize,
    /// [m³]
    volume: f64,
    bounds: [[f64; 3]; 2],
    directions: [bool; 3],
    /// Whether it is a wedge of a round bed.
    wedge: bool,
}

/// The mesh, as it is described by OpenFOAM's program checkMesh.
fn mesh(folder: &Path) -> Result<Mesh, ChoiceError> {
    let said = crate::program::foam(folder, Command::new("checkMesh").args(["-noTopology", "-constant"]))?;
    let wrong = |problem: &str| ChoiceError::Run {
        program: "checkMesh".to_string(),
        folder: folder.to_path_buf(),
        problem: problem.to_string(),
    };
    let after = |name: &str| said.split_once(name).map(|(_, rest)| rest.lines().next().unwrap_or_default());
    let cells = after("    cells:").and_then(|text| text.trim().parse().ok());
    let volume = after("Total volume = ")
        .and_then(|text| text.split_whitespace().next()?.trim_end_matches('.').parse::<f64>().ok());
    let bounds = after("Overall domain bounding box").and_then(|text| {
        let words = text.split(|c: char| c.is_whitespace() || c == '(' || c == ')');
        let numbers: Vec<f64> = words.filter_map(|word| word.parse().ok()).collect();
        <[f64; 6]>::try_from(numbers).ok()
    });
    let directions = after("geometric (non-empty/wedge) directions (").and_then(|text| {
        let words: Vec<bool> = text.split([' ', ')']).take(3).map(|word| word == "1").collect();
        <[bool; 3]>::try_from(words).ok()
    });
    match (cells, volume, bounds, directions) {
        (Some(cells), Some(volume), Some([a, b, c, d, e, f]), Some(directions)) => {
            let boundary = msdd_files::read_text(&folder.join("constant/polyMesh/boundary"));
            let wedge = boundary
                .is_ok_and(|text| text.lines().any(|line| line.split_whitespace().eq(["type", "wedge;"])));
            Ok(Mesh { cells, volume, bounds: [[a, b, c], [d, e, f]], directions, wedge })
        }
        _ => Err(wrong(
            "it did not print the number of cells, the volume, the bounding box and the directions",
        )),
    }
}

impl Mesh {
    fn count(&self, k: usize) -> usize {
        if self.directions[k] { POINTS[k] } else { 1 }
    }

    /// The bed of grains of this mean radius [m]. Discs fill the plane; in space there are as many as in a cut through its middle.
    fn bed(&self, kind: Grains, mean_radius: f64) -> BandInputs {
        let size: Vec<f64> = (0..3).map(|k| self.bounds[1][k] - self.bounds[0][k]).collect();
        let area = (self.volume / size[2]).min(size[0] * size[1]);
        let mut neighbours = Vec::new();
        let mut stride = 1;
        for (direction, length) in size.iter().enumerate() {
            let count = self.count(direction);
            for point in 0..(0..3).map(|k| self.count(k)).product() {
                if point / stride % count + 1 < count {
                    neighbours.push(([point, point + stride], direction, length / count as f64));
                }
            }
            stride *= count;
        }
        let grains = kind.number(mean_radius, self.volume * self.turns(), area);
        BandInputs { kind, grains, mean_radius, window: WINDOW, neighbours }
    }

    /// How many such meshes make the bed: those of a full turn, if this is a wedge about x or y, else 1.
    fn turns(&self) -> f64 {
        let half_width = self.bounds[1][2];
        // The radius is the direction across the axis in which the box of this wedge has the mesh's volume.
        let radius = [0, 1].into_iter().min_by(|&a, &b| {
            let off = |k: usize| {
                let ([low, high], length) =
                    ([self.bounds[0][k], self.bounds[1][k]], self.bounds[1][1 - k] - self.bounds[0][1 - k]);
                (length * half_width * (high * high - low * low) / high - self.volume).abs()
            };
            off(a).total_cmp(&off(b))
        });
        match radius {
            Some(k) if self.wedge => std::f64::consts::PI / (half_width / self.bounds[1][k]).atan(),
            _ => 1.0,
        }
    }

    /// Points at which runs are compared [m].
    fn points(&self) -> Vec<[f64; 3]> {
        let [low, high] = self.bounds;
        let count = |k: usize| self.count(k);
        let at = |k: usize, i: usize| low[k] + (high[k] - low[k]) * (i as f64 + 0.5) / count(k) as f64;
        let mut all = Vec::new();
        for z in 0..count(2) {
            for y in 0..count(1) {
                all.extend((0..count(0)).map(|x| [at(0, x), at(1, y), at(2, z)]));
            }
        }
        all
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn blocks(text: &str) -> Blocks {
        let dictionary = Dictionary::parse(Path::new("x"), text).unwrap();
        Blocks::read(dictionary.value("blocks").unwrap()).unwrap()
    }

    fn at(levels: &[Level]) -> Settings {
        Settings::new(levels.to_vec(), 0.0, false)
    }

    #[test]
    fn a_single_block_is_halved_along_each_direction_by_itself() {
        let one = blocks("blocks ( hex ( 0 1 2 3 4 5 6 7 ) zone ( 100 30 1 ) simpleGrading ( 1 1 1 ) );");
        assert_eq!(one.directions(), [[0], [1]]);
        assert_eq!(
            one.text(&at(&[Level::Halved(2), Level::One])),
            "( hex ( 0 1 2 3 4 5 6 7 ) zone ( 25 1 1 ) simpleGrading ( 1 1 1 ) )"
        );
        assert_eq!(one.total(&at(&[Level::Halved(1), Level::Halved(1)])), 50 * 15);
        assert_eq!(one.coarser(&at(&[Level::Halved(0), Level::Halved(1)])), [("y", 15, 30)]);
        let half = Settings { halved: vec![false, true], ..at(&[Level::Halved(1), Level::Halved(0)]) };
        assert_eq!(one.total(&half), 50 * 15);
    }

    #[test]
    fn a_bed_has_as_many_grains_as_its_area_holds_and_neighbours_along_each_direction() {
        let (bounds, directions) = ([[0.0; 3], [0.7, 0.5, 0.01]], [true, true, false]);
        let mesh = Mesh { cells: 1, volume: 0.0035, bounds, directions, wedge: false };
        let bed = mesh.bed(Grains::Discs, 0.01);
        assert!((bed.grains - 0.35 / 3.7e-4).abs() < 1e-6, "{}", bed.grains);
        assert_eq!(bed.neighbours.len(), 6 * 5 + 7 * 4);
        let points = mesh.points();
        for &([a, b], direction, distance) in &bed.neighbours {
            assert!((points[b][direction] - points[a][direction] - distance).abs() < 1e-12);
            assert_eq!(points[b][1 - direction], points[a][1 - direction]);
        }
    }

    #[test]
    fn a_bed_of_spheres_has_as_many_grains_as_its_volume_holds_and_a_wedge_those_of_the_round_bed() {
        let (radius, length) = (0.1, 0.3);
        let round =
            std::f64::consts::PI * radius * radius * length / (4.0 / 3.0 * std::f64::consts::PI * 1e-6 / 0.6);
        let half = 2.5f64.to_radians();
        let (y, z) = (radius * half.cos(), radius * half.sin());
        let volume = y * z * length;
        let wedge = |bounds| Mesh { cells: 1, volume, bounds, directions: [true, true, false], wedge: true };
        for bounds in [[[0.0, 0.0, -z], [length, y, z]], [[0.0, -length, -z], [y, 0.0, z]]] {
            let found = wedge(bounds).bed(Grains::Spheres, 0.01).grains;
            assert!((found / round - 1.0).abs() < 3e-3, "{found} {round}");
        }
        let bounds = [[0.0; 3], [0.2, 0.2, 0.3]];
        let space = Mesh { cells: 1, volume: 0.012, bounds, directions: [true; 3], wedge: false };
        let found = space.bed(Grains::Spheres, 0.01);
        assert!((found.grains - 0.012 * 0.6 / (4.0 / 3.0 * std::f64::consts::PI * 1e-6)).abs() < 1e-6);
        assert_eq!(found.neighbours.len(), (6 * 5 * 3) + (7 * 4 * 3) + (7 * 5 * 2));
    }

    #[test]
    fn several_blocks_are_halved_together() {
        let two = blocks(
            "blocks ( hex ( 0 1 2 3 4 5 6 7 ) ( 8 30 1 ) simpleGrading ( 1 1 1 ) hex ( 1 2 3 4 5 6 7 8 ) ( 16 30 1 ) simpleGrading ( 1 1 1 ) );",
        );
        assert_eq!(two.directions(), [[0, 1]]);
        assert_eq!(two.cells(&[0, 1]), 8);
        assert_eq!(two.total(&at(&[Level::Halved(1)])), 4 * 15 + 8 * 15);
    }
}
