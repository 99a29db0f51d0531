//! One configuration to run. A job contains everything that its result depends on, except the files, which the cache hashes.

use msdd_autotune::settings::Settings;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use std::path::PathBuf;

/// Cells along x and y of the shipped cases.
pub const MESH: [usize; 2] = [100, 30];
/// Width and height of the box of the cases \[m\] (Fig. 7).
pub const BOX: [f64; 2] = [2.15, 0.645];
/// The probes P1, P2, P3, where T is compared \[m\] (Fig. 7).
pub const PROBES: [[f64; 2]; 3] = [[0.3225, 0.3225], [1.075, 0.3225], [1.8275, 0.3225]];

/// Source folders of the discrete element engine and the programs that use it; results depend on them.
pub const ENGINE: [&str; 4] = ["rust/dem", "rust/rve", "rust/dem_reference", "Cargo.lock"];

/// The part of the box that is computed. Where the box is cut, the boundary is a plane of symmetry.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum Part {
    Whole,
    /// The left half.
    Half,
    /// The lower left quarter.
    Quarter,
    /// The box of a case with a box of its own: mesh, fields and probes as shipped.
    Shipped,
}

impl Part {
    /// Width and height of the part of the box that is computed \[m\].
    pub fn size(self) -> [f64; 2] {
        match self {
            Self::Whole | Self::Shipped => BOX,
            Self::Half => [0.5 * BOX[0], BOX[1]],
            Self::Quarter => [0.5 * BOX[0], 0.5 * BOX[1]],
        }
    }

    /// The probes inside of the part; P3 is replaced by its mirror image P1. Probes on a plane of symmetry are moved slightly
    /// inwards.
    pub fn probes(self) -> [[f64; 2]; 3] {
        let inside = |[x, y]: [f64; 2]| {
            let size = self.size();
            [x.min((1.0 - 1e-5) * size[0]), y.min((1.0 - 1e-5) * size[1])]
        };
        match self {
            Self::Whole | Self::Shipped => PROBES,
            _ => [inside(PROBES[0]), inside(PROBES[1]), inside(PROBES[0])],
        }
    }
}

/// A run of `msddFoam`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct SolverJob {
    /// Folder in `cases`.
    pub case: String,
    /// Seed of the packing from whose windows the initial fields are taken.
    pub seed: u32,
    pub mesh: [usize; 2],
    pub part: Part,
    /// Porosity and fabric index of all cells, instead of those of the packing's windows.
    pub uniform: Option<[f64; 2]>,
    /// Text that is added at the end of files of the case: OpenFOAM merges dictionaries, and the last value counts.
    pub append: BTreeMap<String, String>,
    /// End of the simulation \[s\].
    pub end: f64,
    /// C source of a plug-in, relative to the checkout, which the case finds as `plugin.so`.
    pub plugin: Option<String>,
    /// Angle by which the ends of the box are slanted to the right \[degrees\]; its height stays the same.
    pub slant: f64,
    /// Processor time after which the run is stopped \[s\].
    pub limit: u64,
}

impl SolverJob {
    /// The case as shipped, with steps of 10 ms.
    pub fn new(case: &str, seed: u32) -> Self {
        let job = Self {
            case: case.to_string(),
            seed,
            mesh: MESH,
            part: Part::Whole,
            uniform: None,
            append: BTreeMap::new(),
            end: 20.0,
            plugin: None,
            slant: 0.0,
            limit: 600,
        };
        job.control("deltaT 1e-2;")
    }

    /// The first packing on a coarse mesh, which is enough to see where a method fails.
    pub fn coarse(case: &str) -> Self {
        Self { mesh: [25, 8], limit: 120, ..Self::new(case, 1) }
    }

    /// Adds `text` at the end of `file`.
    pub fn with(mut self, file: &str, text: &str) -> Self {
        let entry = self.append.entry(file.to_string()).or_default();
        entry.push_str(text);
        entry.push('\n');
        self
    }
    pub fn control(self, text: &str) -> Self {
        self.with("system/controlDict", text)
    }
    pub fn solution(self, text: &str) -> Self {
        self.with("system/fvSolution", text)
    }
    pub fn grains(self, text: &str) -> Self {
        self.with("constant/granularProperties", text)
    }
    pub fn temperature(self, text: &str) -> Self {
        self.with("0/T", text)
    }
}

/// A run of `msddFoam` in one of the cases of spheres, whose results are compared with what stands next to it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct SpheresJob {
    /// Folder in `cases`.
    pub case: String,
    /// Pairs of text in `system/blockMeshDict` and what stands there instead.
    pub mesh: Vec<(String, String)>,
    /// Text that is added at the end of files of the case.
    pub append: BTreeMap<String, String>,
    /// Arguments of `cases/common/compare-dem`; none: the case has no DEM.
    pub compare: Vec<String>,
    /// Processor time after which the run is stopped \[s\].
    pub limit: u64,
}

/// A run of `msdd`, or of its example `bench`, whose result is its output.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ToolJob {
    /// Arguments of `msdd`; `WORK` stands for the folder of the job.
    pub arguments: Vec<String>,
    /// Files and folders, relative to the checkout, that the result depends on in addition to the arguments.
    pub inputs: Vec<String>,
    /// Output file in `WORK` whose text is kept.
    pub output: Option<String>,
    pub limit: u64,
}

/// A run on a copy of a case of the user's; the copy stands next to it while the job runs.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct CaseJob {
    /// The user's case folder.
    pub folder: PathBuf,
    /// Checksum of the files of the case.
    pub checksum: String,
    pub program: CaseProgram,
    pub limit: u64,
}

#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub enum CaseProgram {
    /// `msddFoam`.
    Solver(CaseRun),
    /// `msdd case solve`, without the chosen run, for a wanted accuracy of T [% of its range].
    Choice(f64),
    /// `msdd reference run`.
    Discs(CaseDiscs),
}

#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct CaseRun {
    pub settings: Settings,
    /// Range of T \[K\], from which the tolerance follows; `None`: that of the case stays.
    pub range: Option<f64>,
    /// Text that is added at the end of files of the case.
    pub append: BTreeMap<String, String>,
    /// Lower left corner and size of the box \[m\] if the run is compared with discs, which are observed at points that stay in
    /// space.
    pub discs: Option<[[f64; 2]; 2]>,
}

#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct CaseDiscs {
    pub seed: u64,
    /// Mean initial porosity of the case, overlaps counted once.
    pub porosity: f64,
    /// Whether the box is closed along x and y, instead of along x alone.
    pub isotropic: bool,
    /// Time between two rows of the results \[s\].
    pub interval: f64,
}

#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub enum Job {
    Solver(SolverJob),
    Spheres(SpheresJob),
    Tool(ToolJob),
    Case(CaseJob),
}

impl Job {
    /// Short name for the progress line.
    pub fn name(&self) -> String {
        match self {
            Self::Solver(job) => format!("{} seed {} on {}x{}", job.case, job.seed, job.mesh[0], job.mesh[1]),
            Self::Spheres(job) => job.case.clone(),
            Self::Tool(job) => {
                format!("msdd {}", job.arguments.iter().take(2).cloned().collect::<Vec<_>>().join(" "))
            }
            Self::Case(job) => {
                let case = job.folder.file_name().unwrap_or_default().to_string_lossy().into_owned();
                match &job.program {
                    CaseProgram::Solver(_) => case,
                    CaseProgram::Choice(percent) => format!("{case}, choice for {percent} %"),
                    CaseProgram::Discs(discs) => format!("{case}, discs, seed {}", discs.seed),
                }
            }
        }
    }

    pub fn limit(&self) -> u64 {
        match self {
            Self::Solver(job) => job.limit,
            Self::Spheres(job) => job.limit,
            Self::Tool(job) => job.limit,
            Self::Case(job) => job.limit,
        }
    }
}

impl From<SolverJob> for Job {
    fn from(job: SolverJob) -> Self {
        Self::Solver(job)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn probes_of_a_part_lie_inside_of_it() {
        for part in [Part::Whole, Part::Half, Part::Quarter] {
            let size = part.size();
            for [x, y] in part.probes() {
                assert!(x < size[0] && y < size[1], "{part:?} {x} {y}");
            }
        }
        assert_eq!(Part::Half.probes()[2], PROBES[0]);
    }

    #[test]
    fn keys_are_appended_in_the_order_given() {
        let job = SolverJob::new("H", 1).control("endTime 1;");
        assert_eq!(job.append["system/controlDict"], "deltaT 1e-2;\nendTime 1;\n");
    }
}
