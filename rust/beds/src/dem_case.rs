//! The description of a bed whose walls move while heat flows through it: a TOML file that says what is poured, which walls have
//! which temperature, and how they move.

use crate::case::{
    CaseError, EXPANSIONS, GasKeys, Grains, POSITIVE, Ranged, TEMPERATURES, Vessel, ranged, temperature,
};
use crate::pour::Container;
use crate::schedule::Schedule;
use crate::units::{kelvin, kelvin_over_time};
use msdd_engine::message::number;
use msdd_files::read_text;
use serde::{Deserialize, Serialize};
use std::f64::consts::PI;
use std::path::{Path, PathBuf};

/// Name of the file in the folder of a case.
pub const FILE: &str = "dem.toml";
/// Its name before version 0.3, which is still read.
const FORMER_FILE: &str = "elements.toml";

/// The file of the bed in a folder: [`FILE`], or that of its former name where only this is there.
pub fn file_in(folder: &Path) -> PathBuf {
    let former = folder.join(FORMER_FILE);
    let file = folder.join(FILE);
    if !file.exists() && former.exists() { former } else { file }
}

/// Least height of a region of averages in diameters, and least number of spheres in it. Layers beside a plate alternate every 0.82
/// diameters; of 30 spheres, with some 70 contacts, a mean stress scatters by about 15 %, as forces scatter about as much as their mean.
const MIN_HEIGHT: f64 = 2.0;
const MIN_SPHERES: f64 = 30.0;
/// What numbers may be.
const STRAINS: [f64; 2] = [-0.2, 0.2];
const SOURCES: [f64; 2] = [0.0, 1e12];
const STEPS: [f64; 2] = [100.0, 10_000_000.0];
const INTERVAL: &str = "a hundred-thousandth of end, to output_every";
const OUTPUT_EVERY: &str = "interval to end";
/// Solid fraction by which they are counted.
const REFERENCE_FRACTION: f64 = 0.6;

/// A bed. SI units.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct DemCase {
    /// Seed of the packing.
    #[serde(default = "one")]
    pub seed: u64,
    /// Heat released in the spheres, over their volume. Tables have to reach the temperatures that it causes, which are not known
    /// beforehand \[W/m³\]. Allowed: `SOURCES`. Default: none.
    pub heat_source: Option<f64>,
    /// A section: the spheres.
    pub grains: Grains,
    /// A section: what they are poured into.
    pub container: Vessel,
    /// A section: how the lid is pressed on and moved.
    pub lid: LidKeys,
    /// A section: the gas between the spheres.
    pub gas: GasKeys,
    /// Blocks `[[heated]]`: walls of given temperature; the others are insulated.
    pub heated: Vec<Heated>,
    /// A section: the side of a cylinder that gives way. Default: a rigid side.
    pub shell: Option<Shell>,
    /// A section: how a bed without sides is strained across. Default: it keeps its base.
    pub sides: Option<Sides>,
    /// A section: temperature at the start, intervals, steps.
    pub time: Time,
    /// A section: where temperatures and averages are taken.
    pub record: RecordKeys,
}

/// The lid: pressed on while the grains harden, and then moved.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct LidKeys {
    /// Pressure with which the lid is pressed on before the start \[Pa\]. Allowed: `POSITIVE`.
    pub pressure: f64,
    /// Over time: how far it has moved towards the spheres since the start, over the depth of the bed. Allowed: `STRAINS`.
    /// Default: it stays where it is.
    pub strain: Option<Schedule>,
    /// Over time: the pressure with which it goes on pressing, instead of `strain` \[Pa\]. Allowed: `POSITIVE`. Default: it stays
    /// where it is.
    pub pressing: Option<Schedule>,
}

/// A wall of given temperature.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Heated {
    /// Name of the wall. Allowed: a wall of the container.
    pub wall: String,
    /// Its temperature over time; each may be a text with a unit, as `"80C"` \[K\]. Allowed: `TEMPERATURES`.
    #[serde(deserialize_with = "kelvin_over_time")]
    pub temperature: Schedule,
}

/// The side of a cylinder, when it gives way.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Shell {
    /// Young's modulus E_w of the side of the cylinder. Its radius R grows by R²/(E_w t) times the pressure beyond that of the
    /// start \[Pa\]. Allowed: `POSITIVE`.
    pub young_modulus: f64,
    /// Its thickness t \[m\]. Allowed: `POSITIVE`.
    pub thickness: f64,
    /// Its linear coefficient of thermal expansion; it has the temperature of the heated wall `side`, else that of the start
    /// [1/K]. Allowed: `EXPANSIONS`.
    #[serde(default)]
    pub thermal_expansion: f64,
}

/// Strain of the base of a bed without sides (`container.endless`).
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Sides {
    /// Over time: extension of the base along x since the start, over its length \[-\]. Allowed: `STRAINS`.
    pub strain_x: Schedule,
    /// The same along y. Allowed: `STRAINS`.
    pub strain_y: Schedule,
}

#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Time {
    /// Temperature of all spheres at the start, a number or a text with a unit \[K\]. Allowed: `TEMPERATURES`.
    #[serde(deserialize_with = "kelvin")]
    pub initial_temperature: f64,
    /// End of the run \[s\]. Allowed: `POSITIVE`.
    pub end: f64,
    /// Time between two changes of radii, walls and contacts: heat flows, then grains grow and walls move. Heated walls have the
    /// temperature of the middle of each interval, so it has to be short where that changes fast \[s\]. Allowed: `INTERVAL`.
    pub interval: f64,
    /// Steps of DEM in each interval, at least; where the bed lags there are more. Allowed: `STEPS`.
    pub steps: u64,
    /// Time between two rows of the results \[s\]. Allowed: `OUTPUT_EVERY`.
    pub output_every: f64,
    /// Estimated error of T that a step of heat may make \[K\]. Allowed: `POSITIVE`.
    #[serde(default = "usual_tolerance")]
    pub tolerance: f64,
}

#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct RecordKeys {
    /// The wall from which distances are counted. Allowed: a wall of the container.
    pub wall: String,
    /// Distances at which T is recorded: the value there of a straight line through the spheres within 1.5 diameters, from `side`
    /// those between `heights` \[m\]. Allowed: where there are spheres.
    pub distances: Vec<f64>,
    /// Two heights above the floor, between which averages are taken \[m\]. Allowed: rising, `MIN_HEIGHT` diameters apart at
    /// least, within the bed; about `MIN_SPHERES` spheres at least between them.
    pub heights: [f64; 2],
    /// In a cylinder, the distance from the axis within which averages are taken \[m\]. Allowed: a diameter to the radius of the
    /// container. Default: required in a cylinder.
    pub radius: Option<f64>,
}

fn one() -> u64 {
    1
}

fn usual_tolerance() -> f64 {
    0.02
}

/// A value that is wrong: its key, the value, what is allowed.
type Wrong = (String, String, String);

impl DemCase {
    /// Reads and checks the description in the folder of a case.
    ///
    /// # Errors
    /// The first thing that is wrong.
    pub fn read(folder: &Path) -> Result<Self, CaseError> {
        let file = file_in(folder);
        let scene: Self = toml::from_str(&read_text(&file)?).map_err(|error| CaseError::Read {
            file: file.clone(),
            problem: error.to_string().trim().to_string(),
        })?;
        scene.checked(&file)?;
        Ok(scene)
    }

    /// Checks a description; `file` is for messages.
    ///
    /// # Errors
    /// The first thing that is wrong.
    pub fn checked(&self, file: &Path) -> Result<(), CaseError> {
        let wrong =
            |(key, value, allowed)| CaseError::Value { file: file.to_path_buf(), key, value, allowed };
        self.check().map_err(wrong)
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

    /// Number of a wall by its name.
    pub fn wall(&self, name: &str) -> Option<usize> {
        self.vessel().walls(0.0).iter().position(|(known, _)| *known == name)
    }

    /// Temperatures \[K\] between which everything stays.
    pub fn temperatures(&self) -> [f64; 2] {
        let start = self.time.initial_temperature;
        self.heated.iter().fold([start, start], |[low, high], heated| {
            let [a, b] = heated.temperature.range();
            [low.min(a), high.max(b)]
        })
    }

    /// What the run says of grains so poor that a closure takes the place of the law of pairs.
    pub fn closure(&self) -> Option<String> {
        self.grains.closure(self.temperatures(), &self.gas)
    }

    /// What the run says if the emissivity depends on the temperature.
    pub fn varying_emissivity(&self) -> Option<String> {
        self.grains.varying_emissivity(self.temperatures())
    }

    fn check(&self) -> Result<(), Wrong> {
        let wrong =
            |key: &str, value: String, allowed: &str| Err((key.to_string(), value, allowed.to_string()));
        self.grains.check_sizes()?;
        let mut numbers = self.grains.numbers();
        numbers.extend(self.container.numbers(&self.grains));
        numbers.extend(self.gas.numbers());
        numbers.extend(self.numbers());
        if let Some((key, value, allowed, _)) = numbers.into_iter().find(|number| !number.3) {
            return wrong(key, number(value), &allowed);
        }
        self.container.check(&self.grains)?;
        for heated in &self.heated {
            let told = |(value, allowed)| ("heated.temperature".to_string(), value, allowed);
            heated.temperature.check(TEMPERATURES).map_err(told)?;
        }
        self.grains.check(self.temperatures(), &self.gas)?;
        let heated = self.heated.iter().map(|heated| ("heated.wall", &heated.wall));
        for (key, name) in heated.chain([("record.wall", &self.record.wall)]) {
            if self.wall(name).is_none() {
                let names: Vec<&str> = self.vessel().walls(0.0).into_iter().map(|(name, _)| name).collect();
                return wrong(key, name.clone(), &names.join(", "));
            }
        }
        match (&self.lid.strain, &self.lid.pressing) {
            (Some(_), Some(_)) => {
                return wrong("lid", "strain and pressing".into(), "one of strain and pressing, or neither");
            }
            (Some(path), None) => {
                path.check(STRAINS).map_err(|(value, allowed)| ("lid.strain".into(), value, allowed))?;
            }
            (None, Some(path)) => {
                path.check(POSITIVE).map_err(|(value, allowed)| ("lid.pressing".into(), value, allowed))?;
            }
            (None, None) => {}
        }
        if self.shell.is_some() && self.container.radius.is_none() {
            return wrong("shell", "a box".into(), "a shell around a cylinder: container.radius");
        }
        if let Some(Sides { strain_x, strain_y }) = &self.sides {
            if !self.container.endless {
                return wrong("sides", "given".into(), "a bed without sides: container.endless = true");
            }
            for (key, strain) in [("sides.strain_x", strain_x), ("sides.strain_y", strain_y)] {
                strain.check(STRAINS).map_err(|(value, allowed)| (key.to_string(), value, allowed))?;
            }
        }
        if self.record.radius.is_some() != self.container.radius.is_some() {
            return wrong("record.radius", "given or not".into(), "given in a cylinder, and nowhere else");
        }
        let [low, high] = self.record.heights;
        if !low.is_finite() || !high.is_finite() || low >= high {
            return wrong("record.heights", format!("{:?}", self.record.heights), "two rising heights");
        }
        self.check_region()
    }

    /// Refuses averages over fewer spheres than have a mean.
    fn check_region(&self) -> Result<(), Wrong> {
        let (d, [low, high]) = (self.grains.diameter, self.record.heights);
        let short = |length: f64| number(libm::round(1e9 * length) / 1e9);
        let wrong = |key: &str, value: String, allowed: String| Err((key.to_string(), value, allowed));
        if low < 0.0 || high - low < MIN_HEIGHT * d {
            let allowed = format!(
                "two heights above the floor, {MIN_HEIGHT} diameters apart at least: {} m",
                short(MIN_HEIGHT * d)
            );
            return wrong("record.heights", format!("{:?}", self.record.heights), allowed);
        }
        let area = match (self.record.radius, self.container.radius) {
            (Some(inner), Some(radius)) if inner < d || inner > radius => {
                let allowed = format!(
                    "{} to {} m, from a diameter to the radius of the container",
                    short(d),
                    short(radius)
                );
                return wrong("record.radius", number(inner), allowed);
            }
            (Some(inner), _) => PI * inner * inner,
            (None, _) => self.vessel().area(),
        };
        let volume = PI / 6.0 * d * d * d * self.grains.moments().volume;
        let spheres = REFERENCE_FRACTION * area * (high - low) / volume;
        if spheres < MIN_SPHERES {
            let allowed = format!("a region of {MIN_SPHERES} spheres at least: more height, or a wider bed");
            return wrong(
                "record.heights",
                format!("{:?}, about {spheres:.0} spheres", self.record.heights),
                allowed,
            );
        }
        Ok(())
    }

    fn numbers(&self) -> Vec<Ranged> {
        let time = &self.time;
        let of_shell = |key: fn(&Shell) -> f64, none: f64| self.shell.as_ref().map_or(none, key);
        let mut all = vec![
            temperature("time.initial_temperature", time.initial_temperature),
            (
                "time.interval",
                time.interval,
                INTERVAL.into(),
                time.interval >= 1e-5 * time.end && time.interval <= time.output_every,
            ),
            ("time.output_every", time.output_every, OUTPUT_EVERY.into(), time.output_every <= time.end),
            ranged("time.steps", time.steps as f64, STEPS),
            ranged("heat_source", self.heat_source.unwrap_or(0.0), SOURCES),
            (
                "record.distances",
                self.record.distances.len() as f64,
                "one at least".into(),
                !self.record.distances.is_empty(),
            ),
            ranged("time.end", time.end, POSITIVE),
            ranged("time.tolerance", time.tolerance, POSITIVE),
            ranged("lid.pressure", self.lid.pressure, POSITIVE),
            ranged("shell.young_modulus", of_shell(|shell| shell.young_modulus, 1.0), POSITIVE),
            ranged("shell.thickness", of_shell(|shell| shell.thickness, 1.0), POSITIVE),
            ranged("record.radius", self.record.radius.unwrap_or(1.0), POSITIVE),
            ranged("shell.thermal_expansion", of_shell(|shell| shell.thermal_expansion, 0.0), EXPANSIONS),
            ranged("grains.thermal_expansion", self.grains.thermal_expansion.unwrap_or(0.0), EXPANSIONS),
        ];
        let distances = self.record.distances.iter();
        all.extend(distances.map(|&distance| ranged("record.distances", distance, POSITIVE)));
        all
    }
}
