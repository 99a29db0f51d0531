//! The plan of the scenes: a TOML file with one `[[scenes]]` block each.

use msdd_case::Case;
use msdd_case::disc_model::DiscModel;
use msdd_case::grains::Grains;
use msdd_case::packing::{InitialPacking, POROSITIES, RADIUS_RANGE};
use msdd_case::scene::{DiscCase, Mechanics, parse_wall, proposed_cells};
use msdd_case::walls::WallOverTime;
use msdd_dem::{Material, Thermal};
use msdd_dem_reference::ReferenceError;
use msdd_dem_reference::model::{Filling, ModelSpec, SUM_POROSITY};
use msdd_files::read_text;
use msdd_rve::Compression;
use serde::{Deserialize, Serialize};
use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

/// Places of the probes as shares of width and height: the middle, and halfway from it to each wall.
const PROBES: [[f64; 2]; 5] = [[0.25, 0.5], [0.5, 0.5], [0.75, 0.5], [0.5, 0.25], [0.5, 0.75]];

/// What the keys may be.
const NAMES: &str = "lower-case letters, digits and -";
const RADII: &str = "two numbers from 0.1 on whose mean is 1";
const SUM_POROSITIES: [f64; 2] = [0.0, 0.2];
const FRICTIONS: [f64; 2] = [0.0, 10.0];
const DISCS: [usize; 2] = [100, 20_000];

/// What a scene is for.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Use {
    /// Error bands may be fitted to it.
    Calibrate,
    /// Error bands are judged by it, and nothing is fitted to it.
    Judge,
    /// Grains or strains that the shipped model was not trained for.
    Outside,
}

impl Use {
    pub fn as_str(self) -> &'static str {
        match self {
            Self::Calibrate => "calibrate",
            Self::Judge => "judge",
            Self::Outside => "outside",
        }
    }
}

/// How the box was closed when it was packed.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Closing {
    Horizontal,
    Isotropic,
}

/// A plan.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Plan {
    /// Number of output times, evenly spaced over each run; the start is recorded as well.
    pub outputs: usize,
    pub scenes: Vec<PlannedScene>,
}

/// One scene. SI units unless said otherwise.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct PlannedScene {
    /// Name of the scene. Allowed: `NAMES`; no other scene has it.
    pub name: String,
    /// What it is for: to fit error bands to, to judge them by, or to see them outside of what the shipped model was trained for.
    #[serde(rename = "use")]
    pub purpose: Use,
    /// Seed of each packing. Allowed: two at least; no other packing of the plan has it.
    pub seeds: Vec<u64>,
    /// Width and height of the box \[mean radii\]. Allowed: each at least 8; `DISCS` discs in all.
    #[serde(rename = "box")]
    pub size: [f64; 2],
    /// What the left wall does, as in `msdd case new`: a text \[K\]. Allowed: a temperature, `insulated`, or temperatures over time.
    pub left: String,
    /// The right wall. Allowed: as `left`.
    pub right: String,
    /// The bottom. Allowed: as `left`.
    pub bottom: String,
    /// The top. Allowed: as `left`.
    pub top: String,
    /// Temperature at the start \[K\]. Allowed: `DISC_TEMPERATURES`.
    pub initial_temperature: f64,
    /// Density of the grains [kg/m³]. Allowed: `GRAIN_VALUES`.
    pub density: f64,
    /// Young's modulus of the grains \[Pa\]. Allowed: `GRAIN_VALUES`.
    pub young_modulus: f64,
    /// Thermal conductivity of the grains [W/(m K)]. Allowed: `GRAIN_VALUES`.
    pub thermal_conductivity: f64,
    /// Specific heat capacity of the grains [J/(kg K)]. Allowed: `GRAIN_VALUES`.
    pub heat_capacity: f64,
    /// Linear thermal expansion coefficient of the grains [1/K]. Allowed: `GRAIN_EXPANSIONS`.
    pub thermal_expansion: f64,
    /// Mean radius of the grains \[m\]. Allowed: `GRAIN_VALUES`.
    pub mean_radius: f64,
    /// Porosity to pack to, of the whole box, overlaps counted twice; counted once, it is about 0.02 to 0.05 higher.
    /// Allowed: `SUM_POROSITIES`.
    #[serde(default = "usual_porosity")]
    pub porosity: f64,
    /// How the box closes: along x alone, or along x and y by the same strain.
    #[serde(default = "usual_closing")]
    pub compression: Closing,
    /// Smallest and largest radius over the mean radius. Allowed: `RADII`.
    #[serde(default = "usual_radii")]
    pub radii: [f64; 2],
    /// Coefficient of friction tan φ of grains and walls; not while the box closes. Allowed: `FRICTIONS`. Default: as in the paper,
    /// 0.546.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub friction: Option<f64>,
    /// End of the run \[s\]. Allowed: `END_TIMES`.
    pub end: f64,
}

fn usual_porosity() -> f64 {
    SUM_POROSITY
}

fn usual_closing() -> Closing {
    Closing::Horizontal
}

fn usual_radii() -> [f64; 2] {
    RADIUS_RANGE
}

impl Plan {
    /// Reads and checks a plan.
    ///
    /// # Errors
    /// [`ReferenceError::File`], [`ReferenceError::Read`] with the scene, key, value and what is allowed.
    pub fn read(file: &Path) -> Result<Self, ReferenceError> {
        let wrong = |problem: String| ReferenceError::Read { file: file.to_path_buf(), problem };
        let plan: Self =
            toml::from_str(&read_text(file)?).map_err(|error| wrong(error.to_string().trim().to_string()))?;
        plan.check().map_err(|(place, error)| wrong(format!("{place}{error}")))?;
        Ok(plan)
    }

    /// The first error, with the scene that it is in.
    fn check(&self) -> Result<(), (String, ReferenceError)> {
        let here = |error| (String::new(), error);
        allow("outputs", self.outputs, (1..=100).contains(&self.outputs), "1 to 100").map_err(here)?;
        allow("scenes", self.scenes.len(), !self.scenes.is_empty(), "one at least").map_err(here)?;
        let (mut names, mut seeds) = (BTreeSet::new(), BTreeSet::new());
        for scene in &self.scenes {
            let in_scene = |error| (format!("scene {}: ", scene.name), error);
            let unique = names.insert(&scene.name);
            allow("name", &scene.name, unique, "a name that no other scene has").map_err(in_scene)?;
            for seed in &scene.seeds {
                allow("seeds", seed, seeds.insert(seed), "numbers that no other packing has")
                    .map_err(in_scene)?;
            }
            scene.check().map_err(in_scene)?;
        }
        Ok(())
    }
}

fn allow(
    key: &'static str,
    value: impl std::fmt::Display,
    good: bool,
    allowed: &str,
) -> Result<(), ReferenceError> {
    if good {
        return Ok(());
    }
    Err(ReferenceError::Parameter { key, value: value.to_string(), allowed: allowed.to_string() })
}

impl PlannedScene {
    fn check(&self) -> Result<(), ReferenceError> {
        let word = |c: char| c.is_ascii_lowercase() || c.is_ascii_digit() || c == '-';
        let good = !self.name.is_empty() && self.name.chars().all(word);
        allow("name", &self.name, good, NAMES)?;
        allow(
            "seeds",
            self.seeds.len(),
            self.seeds.len() > 1,
            "two at least, so that their scatter is known",
        )?;
        let within = |key, value: f64, [least, most]: [f64; 2]| {
            allow(key, value, (least..=most).contains(&value), &format!("{least} to {most}"))
        };
        within("porosity", self.porosity, SUM_POROSITIES)?;
        let [low, high] = self.radii;
        let good = (0.1..=1.0).contains(&low) && (low + high - 2.0).abs() < 1e-9;
        allow("radii", format!("[{low}, {high}]"), good, RADII)?;
        within("friction", self.friction.unwrap_or_default(), FRICTIONS)?;
        self.scene(self.porosity)?.check()?;
        let (discs, [least, most]) = (self.spec(0)?.discs, DISCS);
        allow(
            "box",
            format!("{:?} mean radii", self.size),
            (least..=most).contains(&discs),
            &format!("{least} to {most} discs"),
        )
    }

    fn walls(&self) -> Result<[WallOverTime; 4], ReferenceError> {
        let wall = |key: &'static str, text: &String| {
            parse_wall(text).map_err(|allowed| ReferenceError::Parameter {
                key,
                value: text.clone(),
                allowed,
            })
        };
        Ok([
            wall("left", &self.left)?,
            wall("right", &self.right)?,
            wall("bottom", &self.bottom)?,
            wall("top", &self.top)?,
        ])
    }

    /// Width and height of the box \[m\].
    pub fn box_size(&self) -> [f64; 2] {
        self.size.map(|length| length * self.mean_radius)
    }

    /// The solver's scene for a packing of this porosity, overlaps counted once; one that no packing of the model's training had
    /// is moved to the next that one had.
    ///
    /// # Errors
    /// [`ReferenceError::Parameter`] for a wall that is not understood.
    pub fn scene(&self, porosity: f64) -> Result<DiscCase, ReferenceError> {
        let size = self.box_size();
        Ok(DiscCase {
            size,
            cells: proposed_cells(size, self.mean_radius),
            walls: self.walls()?,
            initial_temperature: self.initial_temperature,
            material: format!("grains of the scene {}", self.name),
            grains: Grains {
                density: self.density,
                young_modulus: self.young_modulus,
                thermal_conductivity: self.thermal_conductivity,
                heat_capacity: self.heat_capacity,
                thermal_expansion: self.thermal_expansion,
                mean_radius: self.mean_radius,
            },
            model: DiscModel::shipped()?,
            start: InitialPacking::Porosity(porosity.clamp(POROSITIES[0], POROSITIES[1])),
            compression: match self.compression {
                Closing::Horizontal => Compression::Horizontal,
                Closing::Isotropic => Compression::Isotropic,
            },
            mechanics: Mechanics::Equilibrium,
            heat_source: None,
            end_time: self.end,
            tolerance: None,
            steady: false,
            probes: PROBES.map(|share| [share[0] * size[0], share[1] * size[1]]).to_vec(),
        })
    }

    /// The case that the discs are simulated for.
    ///
    /// # Errors
    /// As [`PlannedScene::scene`].
    pub fn case(&self) -> Result<Case, ReferenceError> {
        let scene = self.scene(self.porosity)?;
        Ok(Case {
            folder: PathBuf::new(),
            name: self.name.clone(),
            material: Material {
                friction_angle: self.friction.map_or(Material::default().friction_angle, libm::atan),
                ..scene.grains.material()
            },
            thermal: Thermal {
                conductivity: self.thermal_conductivity,
                heat_capacity: self.heat_capacity,
                expansion: self.thermal_expansion,
            },
            mean_radius: self.mean_radius,
            radii: self.radii,
            source: "plan".to_string(),
            initial_temperature: self.initial_temperature,
            walls: scene.walls,
            origin: [0.0; 2],
            size: scene.size,
            end_time: self.end,
            probes: scene.probes,
        })
    }

    /// What is packed.
    ///
    /// # Errors
    /// As [`PlannedScene::scene`].
    pub fn spec(&self, seed: u64) -> Result<ModelSpec, ReferenceError> {
        let isotropic = self.compression == Closing::Isotropic;
        let filling = Filling { porosity: self.porosity, radii: self.radii, isotropic };
        Ok(ModelSpec { discs: filling.discs(&self.case()?), seed, filling })
    }
}
