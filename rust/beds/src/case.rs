//! The description of a bed that was measured: a TOML file that says what is poured, how it is handled, what heats it.

use crate::effective::{GOOD, MIN_RATIO, closure_error};
use crate::exchange::{Emissivities, Exchange, OutOfRange, RADIATING, Tracing, exchange};
use crate::named_gases::GasName;
use crate::pour::{Container, Pouring, WIDEST};
use crate::property::{Property, VALUES};
use crate::rays::Enclosure;
use crate::settle::longest;
use crate::sizes::{Moments, Sizes};
use crate::units::kelvin;
use msdd_engine::message::{number, range};
use msdd_files::{FileError, read_text};
use msdd_spheres::{Material, Simulation, Stiffness};
use serde::{Deserialize, Serialize};
use std::path::{Path, PathBuf};

/// A bed. SI units.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct BedCase {
    /// Seed of the packing.
    #[serde(default = "one")]
    pub seed: u64,
    /// A section: the spheres.
    pub grains: Grains,
    /// A section: what they are poured into.
    pub container: Vessel,
    /// A section: a lid that is pressed on after pouring, and then stays. Default: no lid.
    pub lid: Option<Lid>,
    /// A section: how the container is turned then. Default: not turned.
    pub turn: Option<Turn>,
    /// A section: the gas between the grains.
    pub gas: GasKeys,
    /// A section: the wall that is heated.
    pub plate: PlateKeys,
    /// A section: how long, and where temperatures are recorded.
    pub heat: Heat,
    /// A section: measurements.
    pub experiment: Option<ExperimentKeys>,
    /// Blocks `[[vary]]`: with `--vary` all is computed again with one value changed.
    #[serde(default)]
    pub vary: Vec<Vary>,
}

/// The spheres.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Grains {
    /// Number of spheres. Allowed: `NUMBERS`.
    pub number: usize,
    /// Diameter of all of them; with `sizes`, their Sauter mean Σ d³/Σ d² \[m\]. Allowed: `POSITIVE`.
    pub diameter: f64,
    /// Density of their material [kg/m³]. Allowed: `POSITIVE`.
    pub density: f64,
    /// Young's modulus of their material: how large contacts are for heat \[Pa\]. Allowed: `POSITIVE`.
    pub young_modulus: f64,
    /// Poisson's ratio. Allowed: `POISSON_RATIOS`.
    pub poisson_ratio: f64,
    /// Young's modulus with which the grains move; with a softer one steps are longer \[Pa\]. Allowed: `SIMULATED`.
    pub simulated_young_modulus: f64,
    /// Coefficient of friction of two grains. Allowed: `FRICTIONS`.
    pub friction: f64,
    /// Coefficient of friction of a grain and a wall. Allowed: `FRICTIONS`.
    pub wall_friction: f64,
    /// Ratio of the speeds after and before a collision. Allowed: `RESTITUTIONS`.
    pub restitution: f64,
    /// Thermal conductivity: a number, or a table of pairs of temperature and value, straight in between, which covers all
    /// temperatures of the run [W/(m K)]. Allowed: `MIN_RATIO` or more times the conductivity of the gas at all temperatures of the
    /// run; below `GOOD` times, a closure for poor conductors is used, and the run says so.
    pub conductivity: Property,
    /// Specific heat capacity: a number or a table, as the conductivity [J/(kg K)]. Allowed: `VALUES`.
    pub heat_capacity: Property,
    /// Height of the asperities (root mean square) over their slope, σ/m \[m\]. Allowed: 0 (smooth), or `POSITIVE`. Default: smooth.
    pub roughness: Option<f64>,
    /// Hardness of the surface \[Pa\]. Allowed: `POSITIVE`; required with a roughness above 0.
    pub hardness: Option<f64>,
    /// Yield stress; contacts beyond it are reported \[Pa\]. Allowed: `POSITIVE`. Default: nothing is reported.
    pub yield_stress: Option<f64>,
    /// Emissivity of the surface, a number or a table, as the conductivity: grains above 0 exchange heat by radiation, as opaque,
    /// grey and diffuse bodies, along rays that are traced once, with the value in the middle of the temperatures of the run.
    /// Allowed: 0 (without radiation), or `RADIATING`. Default: without radiation.
    pub emissivity: Option<Property>,
    /// Rays from each grain. Allowed: `RAYS`; below `FEW_RAYS` the run says what noise they leave. Default: 1000.
    pub rays: Option<usize>,
    /// Linear coefficient of thermal expansion, in `dem.toml` alone [1/K]. Allowed: `EXPANSIONS`. Default: spheres keep their
    /// size.
    pub thermal_expansion: Option<f64>,
    /// Distribution of the diameters, scaled so that their Sauter mean is `diameter`: `uniform` with the least and the largest one (by
    /// number), `normal` or `log_normal` with the standard deviation over the mean (by number, cut at two standard deviations), or
    /// `sieve` with rows of an opening and the share of the mass that passes it; two rows of one opening are spheres of that
    /// diameter. As `sieve=[[1,0],[1,0.3],[2,0.3],[2,1]]`. Allowed: up to 1:4. Default: equal spheres.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub sizes: Option<Sizes>,
}

/// What the grains are poured into: `base` or `radius`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Vessel {
    /// A box: its lengths along x and y. Its walls are `floor`, `x_low`, `x_high`, `y_low`, `y_high`, `lid` \[m\].
    /// Allowed: `TWO_DIAMETERS`; `WIDE`. Default: this or `radius`.
    pub base: Option<[f64; 2]>,
    /// An upright cylinder: its radius. Its walls are `floor`, `side`, `lid` \[m\]. Allowed: `ONE_DIAMETER`; `WIDE`.
    /// Default: this or `base`.
    pub radius: Option<f64>,
    /// Whether the bed repeats itself beyond the sides of `base`; its walls are `floor`, `lid`. In `dem.toml` alone.
    /// Allowed: `true`, `false`; the `base` has `MORE_DIAMETERS`.
    #[serde(default)]
    pub endless: bool,
    /// Acceleration of gravity, first along −z [m/s²]. Allowed: `POSITIVE`, and so large that the spheres come to rest within
    /// `MAX_STEPS` steps.
    #[serde(default = "usual_gravity")]
    pub gravity: f64,
}

#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Lid {
    /// Pressure with which the lid is pressed on \[Pa\]. Allowed: `POSITIVE`. Default: this or `porosity`.
    pub pressure: Option<f64>,
    /// Share of the pores in the volume between floor and lid at which the lid stops. Its pressure then is that of spheres
    /// with `simulated_young_modulus`, and in proportion to it. Allowed: `POROSITIES`. Default: this or `pressure`.
    pub porosity: Option<f64>,
}

impl Lid {
    /// Its height above the floor \[m\], if a porosity is given, for a volume of grains \[m³\] on an area \[m²\].
    pub fn depth(&self, solid: f64, area: f64) -> Option<f64> {
        self.porosity.map(|porosity| solid / (area * (1.0 - porosity)))
    }
}

#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Turn {
    /// The wall that is the floor afterwards. Allowed: a flat wall.
    pub down: String,
}

#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct GasKeys {
    /// The gas; its properties depend on temperature.
    pub name: GasName,
    /// Its pressure, which sets the mean free path \[Pa\]. Allowed: `POSITIVE`.
    #[serde(default = "usual_pressure")]
    pub pressure: f64,
    /// Thermal accommodation at all surfaces. Allowed: `ACCOMMODATION`.
    #[serde(default = "usual_accommodation")]
    pub accommodation: f64,
}

/// The wall that is heated.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct PlateKeys {
    /// The wall that is heated. Allowed: a flat wall that the bed touches; with `pressure`, not the one on which the bed rests.
    pub wall: String,
    /// Its temperature from t = 0 on, a number or a text with a unit, as `"80C"` \[K\]. Allowed: `TEMPERATURES`.
    #[serde(deserialize_with = "kelvin")]
    pub temperature: f64,
    /// Pressure with which it is pressed onto the bed before that \[Pa\]. Allowed: `POSITIVE`. Default: it stays where it is.
    pub pressure: Option<f64>,
    /// Young's modulus of its material \[Pa\]. Allowed: `POSITIVE`.
    pub young_modulus: f64,
    /// Poisson's ratio of its material. Allowed: `POISSON_RATIOS`.
    pub poisson_ratio: f64,
    /// Thermal conductivity of its material [W/(m K)]. Allowed: `POSITIVE`. Default: its surface has one temperature.
    pub conductivity: Option<f64>,
    /// σ/m of a grain and the plate \[m\]. Allowed: 0 (smooth), or `POSITIVE`. Default: smooth.
    pub roughness: Option<f64>,
    /// Hardness of the softer of the two \[Pa\]. Allowed: `POSITIVE`; required with a roughness above 0.
    pub hardness: Option<f64>,
    /// Emissivity of its surface, which radiates to grains that do. Allowed: 0 (reflects everything), or `RADIATING`. Default: that
    /// of the grains.
    pub emissivity: Option<f64>,
}

#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Heat {
    /// Temperature of all grains at the start, a number or a text with a unit \[K\]. Allowed: `TEMPERATURES`.
    #[serde(deserialize_with = "kelvin")]
    pub initial_temperature: f64,
    /// End of the run \[s\]. Allowed: `POSITIVE`.
    pub end: f64,
    /// Time between two rows of `temperature.csv` \[s\]. Allowed: `OUTPUT_EVERY`.
    pub output_every: f64,
    /// Estimated error of T that a step may make \[K\]. Allowed: `POSITIVE`.
    #[serde(default = "usual_tolerance")]
    pub tolerance: f64,
    /// Distances from the plate at which T is recorded \[m\]. Allowed: where there are grains.
    pub probes: Vec<f64>,
}

#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ExperimentKeys {
    /// A CSV file in the folder of the case: the header `distance_m,time_s,temperature_C`, then one measurement a line; lines
    /// that begin with `#` are comments. Allowed: each distance is one of `heat.probes`.
    pub file: PathBuf,
}

#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Vary {
    /// The value that is changed, as `seed` or `gas.accommodation`; the bed is poured again if its packing depends on it.
    /// Allowed: any key but `experiment.file`.
    pub key: String,
    /// The other value. Allowed: as for the key.
    pub value: toml::Value,
}

fn one() -> u64 {
    1
}

fn usual_gravity() -> f64 {
    9.81
}

fn usual_pressure() -> f64 {
    101_325.0
}

fn usual_accommodation() -> f64 {
    0.9
}

fn usual_tolerance() -> f64 {
    0.05
}

/// Most steps in which poured grains have to come to rest: those of cases/beds have some 500 000.
const MAX_STEPS: f64 = 1e8;
/// Name of the file in the folder of a case.
pub const FILE: &str = "bed.toml";
/// Parts of the temperatures of a run at which the conductivity of the grains is held against that of the gas.
const LOOKS: u32 = 50;
/// Beginnings of the keys that the packing does not depend on.
const HEAT_ONLY: [&str; 14] = [
    "grains.conductivity",
    "grains.heat_capacity",
    "grains.young_modulus",
    "grains.roughness",
    "grains.hardness",
    "grains.yield_stress",
    "gas.",
    "heat.",
    "plate.temperature",
    "plate.conductivity",
    "plate.young_modulus",
    "plate.poisson_ratio",
    "plate.roughness",
    "plate.hardness",
];

impl Vary {
    /// Whether the bed has to be poured again.
    pub fn changes_packing(&self) -> bool {
        !HEAT_ONLY.iter().any(|key| self.key.starts_with(key))
    }
}

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
        let file = folder.join(FILE);
        let case = Self::parse(&file, &read_text(&file)?)?;
        for vary in &case.vary {
            case.varied(folder, vary)?;
        }
        Ok(case)
    }

    fn parse(file: &Path, text: &str) -> Result<Self, CaseError> {
        let read = |problem: String| CaseError::Read { file: file.to_path_buf(), problem };
        let case: Self = toml::from_str(text).map_err(|error| read(error.to_string().trim().to_string()))?;
        case.check().map_err(|(key, value, allowed)| CaseError::Value {
            file: file.to_path_buf(),
            key,
            value,
            allowed,
        })?;
        Ok(case)
    }

    /// The same with one value changed.
    ///
    /// # Errors
    /// A section that is not there; what is wrong with the value.
    pub fn varied(&self, folder: &Path, vary: &Vary) -> Result<Self, CaseError> {
        let file = folder.join(FILE);
        let read = |problem: String| CaseError::Read { file: file.clone(), problem };
        let mut table: toml::Table =
            toml::from_str(&read_text(&file)?).map_err(|error| read(error.to_string()))?;
        table.insert("seed".to_string(), toml::Value::Integer(self.seed as i64));
        table.remove("vary");
        if ["experiment", "vary"].contains(&vary.key.split('.').next().unwrap_or_default()) {
            let allowed = "a key of the bed: all are compared with the same measurements".to_string();
            let (key, value) = ("vary.key".to_string(), vary.key.clone());
            return Err(CaseError::Value { file, key, value, allowed });
        }
        match vary.key.split_once('.') {
            None => {
                table.insert(vary.key.clone(), vary.value.clone());
            }
            Some((section, key)) => {
                let Some(toml::Value::Table(inner)) = table.get_mut(section) else {
                    let sections: Vec<&str> = table.keys().map(String::as_str).collect();
                    let allowed = format!("a key of {}", sections.join(", "));
                    let (key, value) = ("vary.key".to_string(), vary.key.clone());
                    return Err(CaseError::Value { file, key, value, allowed });
                };
                inner.insert(key.to_string(), vary.value.clone());
            }
        }
        let text = toml::to_string(&table).map_err(|error| read(error.to_string()))?;
        Self::parse(&file, &text).map_err(|error| match error {
            CaseError::Read { problem, .. } => read(format!("vary {} = {}: {problem}", vary.key, vary.value)),
            CaseError::Value { file, key, value, allowed } if key != vary.key => {
                CaseError::Value { file, key: format!("vary {}: {key}", vary.key), value, allowed }
            }
            other => other,
        })
    }

    /// Temperatures \[K\] between which everything stays.
    pub fn temperatures(&self) -> [f64; 2] {
        let (a, b) = (self.heat.initial_temperature, self.plate.temperature);
        [a.min(b), a.max(b)]
    }

    /// What the run says of grains so poor that a closure takes the place of the law of pairs.
    pub fn closure(&self) -> Option<String> {
        let text = self.grains.closure(self.temperatures(), &self.gas);
        text.map(|text| text + " (not compared next to a plate)")
    }

    /// What the run says if the emissivity depends on the temperature.
    pub fn varying_emissivity(&self) -> Option<String> {
        self.grains.varying_emissivity(self.temperatures())
    }

    /// Key, value, what is allowed of the first value outside its range.
    fn check(&self) -> Result<(), (String, String, String)> {
        let range = self.temperatures();
        self.grains.check_sizes()?;
        for (key, value, allowed, good) in self.numbers() {
            if !good {
                return Err((key.to_string(), number(value), allowed.to_string()));
            }
        }
        hardness("plate.hardness", self.plate.roughness, self.plate.hardness)?;
        if self.grains.thermal_expansion.is_some() || self.container.endless {
            let key = if self.container.endless { "container.endless" } else { "grains.thermal_expansion" };
            let allowed = "only in dem.toml, where grains expand".to_string();
            return Err((key.into(), "given".into(), allowed));
        }
        self.grains.check(range, &self.gas)?;
        self.container.check(&self.grains)?;
        if let Some(lid) = &self.lid
            && lid.pressure.is_some() == lid.porosity.is_some()
        {
            let given = if lid.pressure.is_some() {
                "pressure and porosity"
            } else {
                "neither pressure nor porosity"
            };
            return Err(("lid".into(), given.into(), "one of pressure and porosity".into()));
        }
        let names = self.wall_names();
        let turned = self.turn.iter().map(|turn| ("turn.down", &turn.down));
        for (key, name) in turned.chain([("plate.wall", &self.plate.wall)]) {
            let flat = names.iter().any(|known| known == name) && name != "side";
            if !flat {
                let flat: Vec<&str> = names.into_iter().filter(|name| *name != "side").collect();
                return Err((key.into(), name.clone(), flat.join(", ")));
            }
        }
        let bottom = self.turn.as_ref().map_or("floor", |turn| turn.down.as_str());
        if self.plate.pressure.is_some() && self.plate.wall == bottom {
            let allowed =
                "no pressure for the wall on which the bed rests, or another plate.wall".to_string();
            return Err(("plate.wall".into(), format!("{bottom} with plate.pressure"), allowed));
        }
        let untouched = self.lid.is_none() && self.plate.pressure.is_none() && bottom != "lid";
        if untouched && self.plate.wall == "lid" {
            let allowed =
                "a section [lid] or plate.pressure: else the lid does not touch the bed".to_string();
            return Err(("plate.wall".into(), "lid".into(), allowed));
        }
        Ok(())
    }

    /// Names of the walls of the container.
    pub fn wall_names(&self) -> Vec<&'static str> {
        self.vessel().walls(0.0).into_iter().map(|(name, _)| name).collect()
    }

    /// The container.
    pub fn vessel(&self) -> Container {
        self.container.container()
    }

    fn numbers(&self) -> Vec<Ranged> {
        let (p, h) = (&self.plate, &self.heat);
        let mut all = self.grains.numbers();
        all.extend(self.container.numbers(&self.grains));
        all.extend(self.gas.numbers());
        let lid = |key: fn(&Lid) -> Option<f64>| self.lid.as_ref().and_then(key);
        all.extend([
            ranged("plate.young_modulus", p.young_modulus, POSITIVE),
            ranged("heat.end", h.end, POSITIVE),
            ranged("heat.tolerance", h.tolerance, POSITIVE),
            ranged("plate.hardness", p.hardness.unwrap_or(1.0), POSITIVE),
            ranged("plate.conductivity", p.conductivity.unwrap_or(1.0), POSITIVE),
            ranged("plate.pressure", p.pressure.unwrap_or(1.0), POSITIVE),
            ranged("lid.pressure", lid(|lid| lid.pressure).unwrap_or(1.0), POSITIVE),
            ranged("plate.poisson_ratio", p.poisson_ratio, POISSON_RATIOS),
            emissivity("plate.emissivity", p.emissivity.unwrap_or(1.0), "reflects everything"),
            ("heat.probes", h.probes.len() as f64, "one at least".into(), !h.probes.is_empty()),
            (
                "heat.output_every",
                h.output_every,
                OUTPUT_EVERY.into(),
                h.output_every <= h.end && h.output_every >= 1e-5 * h.end,
            ),
            rough("plate.roughness", p.roughness),
        ]);
        all.extend(lid(|lid| lid.porosity).map(|porosity| ranged("lid.porosity", porosity, POROSITIES)));
        all.push(temperature("plate.temperature", p.temperature));
        all.push(temperature("heat.initial_temperature", h.initial_temperature));
        all.extend(h.probes.iter().map(|&probe| ranged("heat.probes", probe, POSITIVE)));
        all
    }
}

/// A number: its key, the value, what is allowed, whether it is so.
pub(crate) type Ranged = (&'static str, f64, String, bool);
/// A value that is wrong: its key, the value, what is allowed.
type Wrong = (String, String, String);

/// What numbers may be; the comments of the keys name these.
pub(crate) const POSITIVE: [f64; 2] = [1e-12, 1e15];
pub(crate) const TEMPERATURES: [f64; 2] = [1.0, 5000.0];
pub(crate) const EXPANSIONS: [f64; 2] = [0.0, 0.01];
const NUMBERS: [f64; 2] = [1.0, 1_000_000.0];
const FRICTIONS: [f64; 2] = [0.0, 10.0];
const RESTITUTIONS: [f64; 2] = [0.001, 1.0];
const POISSON_RATIOS: [f64; 2] = [0.0, 0.5];
const RAYS: [f64; 2] = [1.0, 1_000_000.0];
const DEFAULT_RAYS: usize = 1000;
const POROSITIES: [f64; 2] = [0.35, 0.7];
/// Difference of scaled exchanges from those traced with their own emissivity, see `tests/radiation.rs` \[%\].
const SCALED_ERROR: f64 = 2.0;
const SIMULATED: &str = "1e-12 to that of the material, young_modulus";
const ACCOMMODATION: &str = "0 < accommodation <= 1";
const OUTPUT_EVERY: &str = "a hundred-thousandth of end, to end";
const ONE_DIAMETER: &str = "one diameter of the largest grain at least";
const TWO_DIAMETERS: &str = "two diameters of the largest grain at least";
const MORE_DIAMETERS: &str = "two and a half diameters of the largest grain at least";
const WIDE: &str = "a floor of at most 10 squares of the diameter for each grain";

fn inside(value: f64, [low, high]: [f64; 2]) -> bool {
    (low..=high).contains(&value)
}

pub(crate) fn ranged(key: &'static str, value: f64, allowed: [f64; 2]) -> Ranged {
    (key, value, range(allowed), inside(value, allowed))
}

pub(crate) fn temperature(key: &'static str, value: f64) -> Ranged {
    (key, value, range(TEMPERATURES) + " K", inside(value, TEMPERATURES))
}

fn emissivity(key: &'static str, value: f64, none: &str) -> Ranged {
    let good = value == 0.0 || inside(value, RADIATING);
    (key, value, format!("0 ({none}), or {}", range(RADIATING)), good)
}

fn rough(key: &'static str, value: Option<f64>) -> Ranged {
    let good = value.is_none_or(|v| v == 0.0 || inside(v, POSITIVE));
    (key, value.unwrap_or_default(), format!("0 (smooth), or {}", range(POSITIVE)), good)
}

fn hardness(key: &str, roughness: Option<f64>, hardness: Option<f64>) -> Result<(), Wrong> {
    if roughness.is_some_and(|height| height > 0.0) && hardness.is_none() {
        let allowed = "a value, because a roughness is given".to_string();
        return Err((key.to_string(), "not given".to_string(), allowed));
    }
    Ok(())
}

impl Grains {
    /// ε in the middle of two temperatures \[K\], with which rays are traced, if the grains radiate.
    fn emissivity_between(&self, [low, high]: [f64; 2]) -> Option<f64> {
        let emissivity = self.emissivity.as_ref().map(|emissivity| emissivity.at(0.5 * (low + high)));
        emissivity.filter(|emissivity| *emissivity > 0.0)
    }

    /// What the run says if the emissivity depends on the temperature.
    pub(crate) fn varying_emissivity(&self, [low, high]: [f64; 2]) -> Option<String> {
        let table @ Property::Table(_) = self.emissivity.as_ref()? else { return None };
        Some(format!(
            "radiation: the emissivity of the grains is {:.3} at {low:.0} K and {:.3} at {high:.0} K; rays are traced with {:.3}, and what grains \
             exchange is scaled by the law's conductivity by radiation, which is within {SCALED_ERROR} % of rays with each emissivity",
            table.at(low),
            table.at(high),
            self.emissivity_between([low, high])?
        ))
    }

    /// Traces the radiation in a bed between two temperatures \[K\], if the grains radiate. `walls`: numbers of those that do, and their
    /// emissivities unless they are those of the grains; others reflect everything.
    pub(crate) fn exchange(
        &self,
        simulation: &Simulation,
        walls: &[(usize, Option<f64>)],
        range: [f64; 2],
        (seed, threads): (u64, usize),
    ) -> Result<Option<Exchange>, OutOfRange> {
        let Some(spheres) = self.emissivity_between(range) else { return Ok(None) };
        let mut emissivities = Emissivities { spheres, walls: vec![0.0; simulation.boundary.walls().len()] };
        walls.iter().for_each(|&(wall, own)| emissivities.walls[wall] = own.unwrap_or(spheres));
        let tracing = Tracing { rays: self.rays.unwrap_or(DEFAULT_RAYS), seed, threads };
        exchange(&Enclosure::new(simulation), &emissivities, &tracing).map(Some)
    }

    /// Pours the grains into a container under `gravity` \[m/s²\].
    pub(crate) fn pouring(&self, seed: u64, container: Container, gravity: f64, threads: usize) -> Pouring {
        let mut pouring = Pouring {
            spheres: self.number,
            seed,
            diameter: self.diameter,
            sizes: self.sizes.clone(),
            material: Material {
                density: self.density,
                stiffness: Stiffness::HertzMindlin {
                    young_modulus: self.simulated_young_modulus,
                    poisson_ratio: self.poisson_ratio,
                },
                friction: self.friction,
                wall_friction: self.wall_friction,
                restitution: self.restitution,
            },
            container,
            gravity,
            longest: 0.0,
            threads,
        };
        pouring.longest = longest(self.diameter, gravity, pouring.height().max(container.width()));
        pouring
    }

    pub(crate) fn check_sizes(&self) -> Result<(), Wrong> {
        let checked = self.sizes.as_ref().map_or(Ok(()), Sizes::check);
        checked.map_err(|problem| ("grains.sizes".into(), problem.value, problem.allowed))
    }

    /// Of the diameters over the Sauter mean.
    pub fn moments(&self) -> Moments {
        Moments::new(self.sizes.as_ref(), self.number)
    }

    /// Volume of all grains \[m³\].
    pub fn volume(&self) -> f64 {
        self.number as f64 * std::f64::consts::PI / 6.0 * self.diameter.powi(3) * self.moments().volume
    }

    pub(crate) fn numbers(&self) -> Vec<Ranged> {
        let simulated = self.simulated_young_modulus;
        let constant = match self.emissivity {
            Some(Property::Constant(emissivity)) => emissivity,
            _ => RADIATING[1],
        };
        vec![
            ranged("grains.diameter", self.diameter, POSITIVE),
            ranged("grains.density", self.density, POSITIVE),
            ranged("grains.young_modulus", self.young_modulus, POSITIVE),
            ranged("grains.hardness", self.hardness.unwrap_or(1.0), POSITIVE),
            ranged("grains.yield_stress", self.yield_stress.unwrap_or(1.0), POSITIVE),
            ranged("grains.number", self.number as f64, NUMBERS),
            ranged("grains.friction", self.friction, FRICTIONS),
            ranged("grains.wall_friction", self.wall_friction, FRICTIONS),
            ranged("grains.restitution", self.restitution, RESTITUTIONS),
            ranged("grains.poisson_ratio", self.poisson_ratio, POISSON_RATIOS),
            (
                "grains.simulated_young_modulus",
                simulated,
                SIMULATED.into(),
                inside(simulated, POSITIVE) && simulated <= self.young_modulus,
            ),
            emissivity("grains.emissivity", constant, "without radiation"),
            ranged("grains.rays", self.rays.unwrap_or(DEFAULT_RAYS) as f64, RAYS),
            rough("grains.roughness", self.roughness),
        ]
    }

    /// Checks what depends on the temperatures of a run \[K\] and on the gas.
    pub(crate) fn check(&self, range: [f64; 2], keys: &GasKeys) -> Result<(), Wrong> {
        hardness("grains.hardness", self.roughness, self.hardness)?;
        let mut properties = vec![
            ("grains.conductivity", &self.conductivity, VALUES),
            ("grains.heat_capacity", &self.heat_capacity, VALUES),
        ];
        if let Some(table @ Property::Table(_)) = &self.emissivity {
            properties.push(("grains.emissivity", table, RADIATING));
        }
        for (key, property, values) in properties {
            property.check(range, values).map_err(|error| {
                let text = error.to_string();
                let (value, allowed) = text.split_once(", allowed: ").unwrap_or((&text, "see above"));
                (key.to_string(), value.to_string(), allowed.to_string())
            })?;
        }
        let [low, high] = keys.name.range();
        if range[0] < low || range[1] > high {
            let allowed = format!("a gas that is known there; this one: {low} to {high} K");
            return Err((
                "gas.name".into(),
                format!("{} at {} K to {} K", keys.name.as_str(), number(range[0]), number(range[1])),
                allowed,
            ));
        }
        let [least, _] = self.ratios(range, keys);
        if least < MIN_RATIO {
            let text = format!("grains that conduct {MIN_RATIO} times as well as the gas, at least");
            return Err(("grains.conductivity".into(), format!("{least:.2} times that of the gas"), text));
        }
        Ok(())
    }

    /// What a run between two temperatures \[K\] says of grains so poor that a closure takes the place of the law of pairs.
    pub(crate) fn closure(&self, range: [f64; 2], keys: &GasKeys) -> Option<String> {
        let [least, most] = self.ratios(range, keys);
        (least < GOOD).then(|| {
            format!(
                "the grains conduct {least:.1} to {most:.1} times as well as the gas: heat does not go from grain to grain alone, so the conductances \
                 follow a closure for poor conductors, which is within {:.0} % of direct solutions of the heat equation",
                100.0 * closure_error(most.min(GOOD)).max(closure_error(least))
            )
        })
    }

    /// The least and the largest conductivity over that of the gas, between two temperatures \[K\].
    pub fn ratios(&self, range: [f64; 2], keys: &GasKeys) -> [f64; 2] {
        let ratio = |t: f64| {
            let gas = keys.name.at(t, keys.pressure, keys.accommodation);
            gas.map_or(f64::INFINITY, |gas| self.conductivity.at(t) / gas.conductivity)
        };
        // A table may dip at a row, and the gas is no straight line between two.
        let between = (0..=LOOKS).map(|k| range[0] + (range[1] - range[0]) * f64::from(k) / f64::from(LOOKS));
        let rows = self.conductivity.rows().into_iter().filter(|t| (range[0]..=range[1]).contains(t));
        let all: Vec<f64> = between.chain(rows).map(ratio).collect();
        [all.iter().copied().fold(f64::INFINITY, f64::min), all.iter().copied().fold(0.0, f64::max)]
    }
}

impl GasKeys {
    pub(crate) fn numbers(&self) -> Vec<Ranged> {
        let accommodation = self.accommodation;
        vec![
            ranged("gas.pressure", self.pressure, POSITIVE),
            (
                "gas.accommodation",
                accommodation,
                ACCOMMODATION.into(),
                accommodation > 0.0 && accommodation <= 1.0,
            ),
        ]
    }
}

impl Vessel {
    pub(crate) fn container(&self) -> Container {
        match (self.base, self.radius) {
            (Some(base), _) if self.endless => Container::Endless { base },
            (Some(base), _) => Container::Box { base },
            (None, radius) => Container::Cylinder { radius: radius.unwrap_or_default() },
        }
    }

    pub(crate) fn check(&self, grains: &Grains) -> Result<(), Wrong> {
        let (value, allowed) = match (self.base, self.radius) {
            (None, Some(_)) if self.endless => ("endless with a radius", "endless with a base"),
            (Some(_), None) | (None, Some(_)) => return self.check_gravity(grains),
            _ => ("both or neither of base and radius", "one of base and radius"),
        };
        Err(("container".into(), value.into(), allowed.into()))
    }

    /// Refuses a gravity so low that the grains would take too many steps to come to rest.
    fn check_gravity(&self, grains: &Grains) -> Result<(), Wrong> {
        let pouring = grains.pouring(0, self.container(), self.gravity, 1);
        let excess = pouring.longest / pouring.step() / MAX_STEPS;
        if excess.is_nan() || excess <= 1.0 {
            return Ok(());
        }
        // The time goes with g^(-1/2), and the time step at most with g^(-1/10).
        let least = self.gravity * excess.powf(2.5);
        let allowed = format!(
            "about {least:.0e} m/s2 at least for these grains, which would take up to {:.0e} steps to come to rest; {MAX_STEPS:.0e} are allowed",
            excess * MAX_STEPS
        );
        Err(("container.gravity".into(), number(self.gravity), allowed))
    }

    pub(crate) fn numbers(&self, grains: &Grains) -> Vec<Ranged> {
        let (d, count) = (grains.diameter * grains.moments().largest, grains.number as f64);
        let base = self.base.unwrap_or([2.0 * d; 2]);
        let radius = self.radius.unwrap_or(d);
        // The other one of base and radius is just large enough.
        let floor = (base[0] * base[1]).max(std::f64::consts::PI * radius * radius)
            / (count * grains.diameter * grains.diameter);
        // A grain must not meet two images of another.
        let (least, narrow) = match self.endless {
            false => (2.0, TWO_DIAMETERS),
            true => (2.5, MORE_DIAMETERS),
        };
        vec![
            ranged("container.gravity", self.gravity, POSITIVE),
            ("container.base", base[0], narrow.into(), self.base.is_none() || base[0] >= least * d),
            ("container.base", base[1], narrow.into(), self.base.is_none() || base[1] >= least * d),
            ("container.radius", radius, ONE_DIAMETER.into(), radius >= d),
            (
                if self.base.is_some() { "container.base" } else { "container.radius" },
                if self.base.is_some() { base[0].max(base[1]) } else { radius },
                WIDE.into(),
                floor.is_finite() && floor <= WIDEST.max(4.0 / count),
            ),
        ]
    }
}
