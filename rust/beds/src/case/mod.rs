//! The description of a bed of spheres: a TOML file from which DEM is run and cases of the solver are written. It says what is poured,
//! what holds it, which walls have which temperature, and how they move.

mod check;
mod former;
mod grains;
mod sections;

use grains::Wrong;
pub use grains::{FRICTION, GasKeys, Grains, RESTITUTION, Vessel};
pub use sections::{
    End, ExperimentKeys, Flow, Heated, Lid, Mechanics, PlateKeys, RecordKeys, Shell, Sides, SolverKeys, Time,
    Turn, Vary,
};

use crate::pour::Container;
use crate::schedule::Schedule;
use grains::REFERENCE_FRACTION;
use msdd_files::{FileError, read_text};
use serde::{Deserialize, Serialize};
use std::path::{Path, PathBuf};
use std::sync::LazyLock;

/// Name of the file in the folder of a case.
pub const FILE: &str = "bed.toml";

/// The file of the bed in a folder: [`FILE`], or one of a former name where only this is there.
pub fn file_in(folder: &Path) -> PathBuf {
    let named = |name: &&str| folder.join(name).exists();
    folder.join(std::iter::once(FILE).chain(former::FILES).find(named).unwrap_or(FILE))
}

/// A bed. SI units.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct BedCase {
    /// Seed of the packing.
    #[serde(default = "one")]
    pub seed: u64,
    /// Heat released in the spheres, over their volume. Tables have to reach the temperatures that it causes, which are not known
    /// beforehand \[W/m³\]. Allowed: `SOURCES`; by the solver also below 0. Default: none.
    pub heat_source: Option<f64>,
    /// A section: the spheres.
    pub grains: Grains,
    /// A section: what they are poured into.
    pub container: Vessel,
    /// A section: a lid that is pressed on after pouring, and then stays or moves. Default: next to a `plate`, no lid; else required.
    pub lid: Option<Lid>,
    /// A section: how the container is turned then, with a `plate` alone. Default: not turned.
    pub turn: Option<Turn>,
    /// A section: the gas between the spheres.
    pub gas: GasKeys,
    /// Blocks `[[heated]]`: walls of given temperature; the others are insulated.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub heated: Vec<Heated>,
    /// A section: one wall that is heated, as in an experiment, through its contacts with spheres that keep their size and their
    /// places. Default: walls of `heated`, and spheres that move.
    pub plate: Option<PlateKeys>,
    /// A section: gas that flows through the bed, for the solver alone. Default: it is at rest.
    pub flow: Option<Flow>,
    /// A section: the compliance of the side of a cylinder. Default: a rigid side.
    pub shell: Option<Shell>,
    /// A section: how a bed without sides is strained across, by DEM alone. Default: it keeps its base.
    pub sides: Option<Sides>,
    /// A section: temperature at the start, intervals, steps.
    pub time: Time,
    /// A section: where temperatures and averages are taken. Default: T in the middle, averages two diameters off the walls.
    #[serde(default)]
    pub record: RecordKeys,
    /// A section: what `case new` needs beyond this. Default: its proposals.
    #[serde(default, skip_serializing_if = "SolverKeys::is_empty")]
    pub solver: SolverKeys,
    /// A section: measurements, with a `plate` alone.
    pub experiment: Option<ExperimentKeys>,
    /// Blocks `[[vary]]`, with a `plate` alone: with `--vary` all is computed again with one value changed.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub vary: Vec<Vary>,
}

fn one() -> u64 {
    1
}

/// Rows of the results of a run, and errors of T of a step \[K\] where spheres move and next to a plate, unless they are given.
const OUTPUTS: f64 = 40.0;
const TOLERANCES: [f64; 2] = [0.02, 0.05];
/// Averages are taken so many diameters from the ends of the bed, and in a cylinder from its side.
const MARGIN: f64 = 2.0;
/// What no plate is.
static NO_PLATE: LazyLock<PlateKeys> = LazyLock::new(PlateKeys::default);

/// What is wrong with a description. The messages name file, key, value and what is allowed.
#[derive(Debug, thiserror::Error)]
pub enum CaseError {
    #[error(transparent)]
    File(#[from] FileError),
    #[error("{file}: {problem}", file = file.display())]
    Read { file: PathBuf, problem: String },
    #[error("{file}: {key} = {value}, allowed: {allowed}", file = file.display())]
    Value { file: PathBuf, key: String, value: String, allowed: String },
}

impl BedCase {
    /// Reads and checks the description in the folder of a case.
    ///
    /// # Errors
    /// The first thing that is wrong.
    pub fn read(folder: &Path) -> Result<Self, CaseError> {
        let case = Self::read_file(&file_in(folder))?;
        case.checked(&file_in(folder))?;
        for vary in &case.vary {
            case.varied(folder, vary)?;
        }
        Ok(case)
    }

    /// Reads a file without checks of what DEM can compute.
    ///
    /// # Errors
    /// What is no description.
    pub fn read_file(file: &Path) -> Result<Self, CaseError> {
        let read = |problem: String| CaseError::Read { file: file.to_path_buf(), problem };
        Self::parse(&former::renewed(read_text(file)?).map_err(read)?, file)
    }

    fn parse(text: &str, file: &Path) -> Result<Self, CaseError> {
        let case: Self = toml::from_str(text).map_err(|error| CaseError::Read {
            file: file.to_path_buf(),
            problem: error.to_string().trim().to_string(),
        })?;
        Ok(case.filled())
    }

    /// Checks a description for DEM; `file` is for messages.
    ///
    /// # Errors
    /// The first thing that is wrong.
    pub fn checked(&self, file: &Path) -> Result<(), CaseError> {
        let wrong =
            |(key, value, allowed)| CaseError::Value { file: file.to_path_buf(), key, value, allowed };
        self.check().map_err(wrong)
    }

    /// With what follows from other values instead of what is not given.
    #[must_use]
    pub fn filled(mut self) -> Self {
        self.grains.filled(&self.container);
        let moves = self.plate.is_none();
        let time = &mut self.time;
        let or = |value: &mut f64, usual: f64| *value = if value.is_nan() { usual } else { *value };
        or(&mut time.output_every, time.end / OUTPUTS);
        or(&mut time.tolerance, TOLERANCES[usize::from(!moves)]);
        // Next to a plate there are none.
        let outputs = (OUTPUTS * time.output_every / time.end).ceil();
        or(&mut time.interval, if moves { time.output_every / outputs } else { 0.0 });
        if moves {
            let (usual, own) = (self.usual_record(), &mut self.record);
            if own.wall.is_empty() {
                own.wall = usual.wall;
            }
            if own.distances.is_empty() {
                own.distances = usual.distances;
            }
            if own.heights == [0.0; 2] {
                (own.heights, own.radius) = (usual.heights, own.radius.or(usual.radius));
            }
        }
        self
    }

    /// Depth of the bed \[m\], about.
    fn usual_depth(&self) -> f64 {
        let solid = self.container.porosity.map_or(REFERENCE_FRACTION, |porosity| 1.0 - porosity);
        self.container.height.unwrap_or_else(|| self.grains.volume() / (self.vessel().area() * solid))
    }

    /// T in the middle, averages [`MARGIN`] diameters off the walls.
    fn usual_record(&self) -> RecordKeys {
        let (depth, d) = (self.usual_depth(), self.grains.diameter);
        let short = |length: f64| libm::round(1e6 * length) / 1e6;
        let inside = |whole: f64, ends: f64| (whole - ends * MARGIN * d).max(0.5 * whole);
        let wall = self.heated.first().map_or("floor", |heated| heated.wall.as_str());
        let [low, high] = [-0.5, 0.5].map(|side| short(0.5 * depth + side * inside(depth, 2.0)));
        let across = match wall {
            "side" => self.container.radius.unwrap_or(depth),
            "x_low" | "x_high" => self.container.base.map_or(depth, |base| base[0]),
            "y_low" | "y_high" => self.container.base.map_or(depth, |base| base[1]),
            _ => depth,
        };
        RecordKeys {
            wall: wall.to_string(),
            distances: vec![short(0.5 * across)],
            heights: [low, high],
            radius: self.container.radius.map(|radius| short(inside(radius, 1.0))),
        }
    }

    /// The same with one value changed.
    ///
    /// # Errors
    /// A section that is not there; what is wrong with the value.
    pub fn varied(&self, folder: &Path, vary: &Vary) -> Result<Self, CaseError> {
        let file = file_in(folder);
        let read = |problem: String| CaseError::Read { file: file.clone(), problem };
        let text = former::renewed(read_text(&file)?).map_err(&read)?;
        let mut table: toml::Table = toml::from_str(&text).map_err(|error| read(error.to_string()))?;
        table.insert("seed".to_string(), toml::Value::Integer(self.seed as i64));
        table.remove("vary");
        let wrong = |allowed: String| {
            let (key, value) = ("vary.key".to_string(), vary.key.clone());
            Err(CaseError::Value { file: file.clone(), key, value, allowed })
        };
        if ["experiment", "vary"].contains(&vary.key.split('.').next().unwrap_or_default()) {
            return wrong("a key of the bed: all are compared with the same measurements".to_string());
        }
        match vary.key.split_once('.') {
            None => {
                table.insert(vary.key.clone(), vary.value.clone());
            }
            Some((section, key)) => {
                let Some(toml::Value::Table(inner)) = table.get_mut(section) else {
                    let sections: Vec<&str> = table.keys().map(String::as_str).collect();
                    return wrong(format!("a key of {}", sections.join(", ")));
                };
                inner.insert(key.to_string(), vary.value.clone());
            }
        }
        let text = toml::to_string(&table).map_err(|error| read(error.to_string()))?;
        Self::parse(&text, &file).and_then(|case| case.checked(&file).map(|()| case)).map_err(|error| {
            match error {
                CaseError::Read { problem, .. } => {
                    read(format!("vary {} = {}: {problem}", vary.key, vary.value))
                }
                CaseError::Value { file, key, value, allowed } if key != vary.key => {
                    CaseError::Value { file, key: format!("vary {}: {key}", vary.key), value, allowed }
                }
                other => other,
            }
        })
    }

    /// The text of a description.
    ///
    /// # Errors
    /// A number that TOML does not have.
    pub fn text(&self, file: &Path) -> Result<String, CaseError> {
        let failed = |problem: String| CaseError::Read { file: file.to_path_buf(), problem };
        toml::to_string(self).map_err(|error| failed(error.to_string()))
    }

    pub fn vessel(&self) -> Container {
        self.container.container()
    }

    /// The plate; one without values for a bed that has none.
    pub fn plate(&self) -> &PlateKeys {
        self.plate.as_ref().unwrap_or(&NO_PLATE)
    }

    /// Pressure of the lid before the start \[Pa\], 0 if none is given.
    pub fn pressure(&self) -> f64 {
        self.lid.as_ref().and_then(|lid| lid.pressure).unwrap_or_default()
    }

    /// How the lid moves: over the depth, or with a pressure \[Pa\].
    pub fn lid_moves(&self) -> (Option<&Schedule>, Option<&Schedule>) {
        self.lid.as_ref().map_or((None, None), |lid| (lid.strain.as_ref(), lid.pressing.as_ref()))
    }

    /// Names of the walls of the container.
    pub fn wall_names(&self) -> Vec<&'static str> {
        self.vessel().walls(0.0).into_iter().map(|(name, _)| name).collect()
    }

    /// Number of a wall by its name.
    pub fn wall(&self, name: &str) -> Option<usize> {
        self.wall_names().iter().position(|known| *known == name)
    }

    /// Whether a wall is heated through a resistance.
    pub fn resists(&self, wall: &str) -> bool {
        self.heated.iter().any(|heated| heated.resists && heated.wall == wall)
    }

    /// Temperatures \[K\] between which everything stays.
    pub fn temperatures(&self) -> [f64; 2] {
        let start = self.time.initial_temperature;
        let heated = self.heated.iter().filter_map(|heated| heated.temperature.as_ref().map(Schedule::range));
        let plate = self.plate.iter().map(|plate| [plate.temperature; 2]);
        heated.chain(plate).fold([start; 2], |[low, high], [a, b]| [low.min(a), high.max(b)])
    }

    /// What the run says of grains so poor that a closure takes the place of the law of pairs.
    pub fn closure(&self) -> Option<String> {
        let text = self.grains.closure(self.temperatures(), &self.gas)?;
        Some(if self.plate.is_some() { text + " (not compared next to a plate)" } else { text })
    }

    /// What the run says if the emissivity depends on the temperature.
    pub fn varying_emissivity(&self) -> Option<String> {
        self.grains.varying_emissivity(self.temperatures())
    }
}
