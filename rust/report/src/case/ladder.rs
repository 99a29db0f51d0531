//! The configurations that a case of the user's is run in.

use crate::ReportError;
use crate::jobs::job::CaseRun;
use msdd_autotune::bed::Grains;
use msdd_autotune::settings::{Level, Settings};
use msdd_autotune::user_case::UserCase;
use msdd_case::dictionary::{Dictionary, Entry};
use std::collections::BTreeMap;

/// Kinds of configurations, which are drawn with different markers and colours.
pub const FAMILIES: [&str; 6] = [
    "grains stay",
    "grains move",
    "constant conductivity",
    "first order, steps of one size",
    "the case as it is",
    "chosen by msdd case solve",
];
/// Tolerances of adaptive steps, as shares of the range of T. A quick report leaves out the last.
const TOLERANCES: [f64; 3] = [1e-2, 1e-3, 1e-4];
/// How often the cells along each direction are halved. A quick report leaves out the last, which doubles them.
const HALVED: [i32; 4] = [2, 1, 0, -1];
/// Steps of one size between two of the times that are compared.
const STEPS: [u32; 2] = [10, 100];
/// Tolerance of the runs with constant conductivity.
const DEFAULT_TOLERANCE: f64 = 1e-3;

/// One configuration.
#[derive(Clone, Debug)]
pub struct Rung {
    pub name: String,
    pub family: &'static str,
    pub settings: Settings,
    /// Range of T \[K\], from which the tolerance follows; `None`: that of the case stays.
    pub range: Option<f64>,
    /// Text that is added at the end of files of the case.
    pub append: BTreeMap<String, String>,
}

impl Rung {
    pub fn new(scene: &UserCase, range: f64, settings: Settings) -> Self {
        let name = format!("{}, {}", cells(scene, &settings.levels), percent(settings.tolerance));
        let family = FAMILIES[usize::from(settings.moves)];
        Self { name, family, settings, range: Some(range), append: BTreeMap::new() }
    }

    fn with(mut self, file: &str, text: &str) -> Self {
        self.append.entry(file.to_string()).or_default().push_str(text);
        self
    }

    /// The run, compared with discs in a box of this lower left corner and size \[m\] if there is one.
    pub fn run(&self, discs: Option<[[f64; 2]; 2]>) -> CaseRun {
        let (settings, append) = (self.settings.clone(), self.append.clone());
        CaseRun { settings, range: self.range, append, discs }
    }
}

/// A tolerance in words.
fn percent(tolerance: f64) -> String {
    format!("tolerance {} %", 100.0 * tolerance)
}

/// Cells at these levels in words.
pub fn cells(scene: &UserCase, levels: &[Level]) -> String {
    format!("{} cells", count(scene, levels))
}

/// Number of cells at these levels.
pub fn count(scene: &UserCase, levels: &[Level]) -> usize {
    scene
        .blocks
        .as_ref()
        .map_or(scene.cells, |blocks| blocks.total(&Settings::new(levels.to_vec(), DEFAULT_TOLERANCE, false)))
}

/// The same level along all directions that can be chosen.
pub fn level(scene: &UserCase, halved: i32) -> Vec<Level> {
    vec![Level::Halved(halved); scene.directions().len()]
}

/// Smallest tolerance of the ladder, and how often its finest mesh is halved.
pub fn finest(quick: bool) -> (f64, i32) {
    let left_out = usize::from(quick);
    (TOLERANCES[TOLERANCES.len() - 1 - left_out], HALVED[HALVED.len() - 1 - left_out])
}

/// The configurations. `range`: of T \[K\].
///
/// # Errors
/// [`ReportError::Case`] for dictionaries of the case that cannot be read.
pub fn ladder(scene: &UserCase, range: f64, quick: bool) -> Result<Vec<Rung>, ReportError> {
    let left_out = usize::from(quick);
    let mut meshes: Vec<Vec<Level>> = Vec::new();
    for halved in HALVED.iter().take(HALVED.len() - left_out) {
        let levels = level(scene, *halved);
        if meshes.iter().all(|other| count(scene, other) != count(scene, &levels)) {
            meshes.push(levels);
        }
    }
    let new = |levels: &[Level], tolerance: f64, moves: bool| {
        Rung::new(scene, range, Settings::new(levels.to_vec(), tolerance, moves))
    };
    let mut rungs = Vec::new();
    for moves in [false, true] {
        for levels in &meshes {
            let tolerances = TOLERANCES.iter().take(TOLERANCES.len() - left_out);
            rungs.extend(tolerances.map(|&tolerance| new(levels, tolerance, moves)));
        }
    }
    if let Some(constant) = constant(scene) {
        let coarser = meshes.iter().filter(|levels| levels.iter().all(|level| *level >= Level::Halved(0)));
        for levels in coarser.rev().take(2) {
            let mut rung = new(levels, DEFAULT_TOLERANCE, false);
            rung.family = FAMILIES[2];
            rungs.push(rung.with("constant/granularProperties", &constant));
        }
    }
    let own = level(scene, 0);
    for (moves, steps) in [false, true].into_iter().flat_map(|moves| STEPS.map(|steps| (moves, steps))) {
        if quick && (moves || steps != STEPS[0]) {
            continue;
        }
        let step = scene.interval() / f64::from(steps);
        let grains = if moves { "move" } else { "stay" };
        let mut rung = new(&own, DEFAULT_TOLERANCE, moves);
        rung.family = FAMILIES[3];
        rung.name = format!("{}, steps of {step:.3e} s, grains {grains}", cells(scene, &own));
        rungs.push(
            rung.with("system/controlDict", &format!("adjustTimeStep no;\ndeltaT {step:e};\n"))
                .with("system/fvSolution", "msddFoam { timeScheme paper; }\n"),
        );
    }
    rungs.extend(as_it_is(scene)?);
    Ok(rungs)
}

/// What gives the bed the conductivity of the case's own model at the start. None where the surrogate type constant cannot: it loads
/// models of discs alone, no plug-ins.
fn constant(scene: &UserCase) -> Option<String> {
    let model = scene.model.as_ref().filter(|_| scene.bed.kind == Grains::Discs)?;
    Some(format!("surrogate {{ type constant; constantCoeffs {{ model \"{model}\"; }} }}\n"))
}

/// The case with its own cells, steps and mechanics; none if it leaves them to `msdd case solve`.
fn as_it_is(scene: &UserCase) -> Result<Option<Rung>, ReportError> {
    if scene.accuracy.is_some() {
        return Ok(None);
    }
    let control = Dictionary::expanded(&scene.folder.join("system/controlDict"))?;
    let solution = Dictionary::expanded(&scene.folder.join("system/fvSolution"))?;
    let adjust = control.text("adjustTimeStep").unwrap_or_else(|_| "no".to_string());
    let scheme = match solution.get("msddFoam") {
        Some(Entry::Dictionary(own)) => own.text("timeScheme").ok(),
        _ => None,
    };
    let scheme = scheme.unwrap_or_else(|| "paper".to_string());
    let levels = level(scene, 0);
    let name = cells(scene, &levels);
    let settings = Settings::new(levels, DEFAULT_TOLERANCE, scene.moves == Some(true));
    let rung = Rung { name, family: FAMILIES[4], settings, range: None, append: BTreeMap::new() };
    let steps = format!("adjustTimeStep {adjust};\ndeltaT {:e};\n", scene.first_step);
    Ok(Some(
        rung.with("system/controlDict", &steps)
            .with("system/fvSolution", &format!("msddFoam {{ timeScheme {scheme}; }}\n")),
    ))
}

#[cfg(test)]
mod tests {
    use super::*;
    use msdd_autotune::bed::BandInputs;

    fn scene() -> UserCase {
        let folder = std::env::temp_dir().join(format!("msdd-report-ladder-{}", std::process::id()));
        UserCase {
            folder,
            start: "0".to_string(),
            start_time: 0.0,
            end: 20.0,
            first_step: 0.1,
            write_interval: 5.0,
            accuracy: Some(1.0),
            moves: None,
            blocks: Err("none".to_string()),
            cells: 90,
            points: Vec::new(),
            pressure_accuracy: None,
            conductivity_factor: 1.0,
            model: Some("own.json".to_string()),
            mirror: None,
            box_cells: None,
            averages: Default::default(),
            bounds: [[0.0; 3], [1.0; 3]],
            in_space: false,
            bed: BandInputs {
                kind: Grains::Discs,
                grains: 1000.0,
                mean_radius: 0.005,
                window: 100.0,
                neighbours: Vec::new(),
            },
        }
    }

    #[test]
    fn a_mesh_that_cannot_be_changed_is_taken_once() {
        let rungs = ladder(&scene(), 50.0, false).unwrap();
        let names: Vec<(&str, &str)> = rungs.iter().map(|rung| (rung.family, rung.name.as_str())).collect();
        assert_eq!(names[0], ("grains stay", "90 cells, tolerance 1 %"));
        assert_eq!(names.iter().filter(|name| name.0 == FAMILIES[1]).count(), TOLERANCES.len());
        assert_eq!(rungs.len(), 2 * TOLERANCES.len() + 1 + 4);
        let unique: std::collections::BTreeSet<_> = names.iter().collect();
        assert_eq!(unique.len(), names.len());
        assert!(ladder(&scene(), 50.0, true).unwrap().len() < rungs.len());
    }

    #[test]
    fn the_constant_conductivity_is_that_of_the_own_model() {
        let mut scene = scene();
        let constant = |scene: &UserCase| {
            let rungs = ladder(scene, 50.0, false).unwrap();
            let of = |rung: &Rung| rung.append["constant/granularProperties"].clone();
            rungs.iter().filter(|rung| rung.family == FAMILIES[2]).map(of).collect::<Vec<_>>()
        };
        assert_eq!(
            constant(&scene),
            ["surrogate { type constant; constantCoeffs { model \"own.json\"; } }\n"]
        );
        // Plug-ins, and boxes of grains
        scene.model = None;
        assert_eq!(constant(&scene), Vec::<String>::new());
    }

    #[test]
    fn spheres_do_not_get_the_constant_conductivity_of_discs() {
        let mut scene = scene();
        let discs = ladder(&scene, 50.0, false).unwrap();
        scene.bed.kind = Grains::Spheres;
        let spheres = ladder(&scene, 50.0, false).unwrap();
        assert!(discs.iter().any(|rung| rung.family == FAMILIES[2]));
        assert!(spheres.iter().all(|rung| rung.append.values().all(|text| !text.contains("constant"))));
        assert!(spheres.len() < discs.len());
    }
}
