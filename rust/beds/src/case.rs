//! The description of a bed that was measured: a TOML file that says what is poured, how it is handled, what heats it.

use crate::effective::{GOOD, LEAST_RATIO, closure_error};
use crate::named_gases::GasName;
use crate::pour::{Container, Pouring, WIDEST};
use crate::property::Property;
use crate::settle::longest;
use msdd_engine::message::number;
use msdd_files::{FileError, read_text};
use msdd_spheres::{Material, Stiffness};
use serde::{Deserialize, Serialize};
use std::path::{Path, PathBuf};

/// A bed. SI units.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct BedCase {
    /// Seed of the packing.
    #[serde(default = "one")]
    pub seed: u64,
    pub grains: Grains,
    pub container: Vessel,
    /// The lid that is pressed on after pouring, and stays.
    pub lid: Option<Lid>,
    pub turn: Option<Turn>,
    pub gas: GasKeys,
    pub plate: PlateKeys,
    pub heat: Heat,
    pub experiment: Option<ExperimentKeys>,
    /// What else the experiment is compared with, one value changed at a time.
    #[serde(default)]
    pub vary: Vec<Vary>,
}

/// Equal spheres.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Grains {
    pub number: usize,
    pub diameter: f64,
    pub density: f64,
    pub young_modulus: f64,
    pub poisson_ratio: f64,
    /// With which the grains move; contacts conduct as the real one says.
    pub simulated_young_modulus: f64,
    pub friction: f64,
    pub wall_friction: f64,
    pub restitution: f64,
    pub conductivity: Property,
    pub heat_capacity: Property,
    /// σ/m.
    pub roughness: Option<f64>,
    pub hardness: Option<f64>,
    pub yield_stress: Option<f64>,
    /// α [1/K]; of beds whose walls move ([`crate::scene`]).
    pub thermal_expansion: Option<f64>,
}

/// What the grains are poured into: `base` or `radius`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Vessel {
    pub base: Option<[f64; 2]>,
    pub radius: Option<f64>,
    /// Whether the bed repeats itself beyond the base; of beds whose walls move ([`crate::scene`]).
    #[serde(default)]
    pub endless: bool,
    #[serde(default = "usual_gravity")]
    pub gravity: f64,
}

#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Lid {
    /// It is pressed on until the bed bears this \[Pa\],
    pub pressure: Option<f64>,
    /// or until the pores have this share of the volume below it.
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
    /// The wall that is the floor afterwards.
    pub down: String,
}

#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct GasKeys {
    pub name: GasName,
    #[serde(default = "usual_pressure")]
    pub pressure: f64,
    #[serde(default = "usual_accommodation")]
    pub accommodation: f64,
}

/// The wall that is heated.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct PlateKeys {
    pub wall: String,
    pub temperature: f64,
    /// With which it is pressed on; it stays where it is if that is not given.
    pub pressure: Option<f64>,
    pub young_modulus: f64,
    pub poisson_ratio: f64,
    /// Of the plate; its surface has one temperature if that is not given.
    pub conductivity: Option<f64>,
    /// σ/m of a grain and the plate, and the hardness of the softer one.
    pub roughness: Option<f64>,
    pub hardness: Option<f64>,
}

#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Heat {
    pub initial_temperature: f64,
    pub end: f64,
    pub output_every: f64,
    #[serde(default = "usual_tolerance")]
    pub tolerance: f64,
    /// Distances from the plate at which T is recorded.
    pub probes: Vec<f64>,
}

#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ExperimentKeys {
    /// In the folder of the case.
    pub file: PathBuf,
}

#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Vary {
    pub key: String,
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
const MOST_STEPS: f64 = 1e8;
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
        text.map(|text| text + " (not compared beside a plate)")
    }

    /// Key, value, what is allowed of the first value outside its range.
    fn check(&self) -> Result<(), (String, String, String)> {
        let range = self.temperatures();
        for (key, value, allowed, good) in self.numbers() {
            if !good {
                return Err((key.to_string(), number(value), allowed.to_string()));
            }
        }
        hardness("plate.hardness", self.plate.roughness, self.plate.hardness)?;
        if self.grains.thermal_expansion.is_some() || self.container.endless {
            let key = if self.container.endless { "container.endless" } else { "grains.thermal_expansion" };
            let allowed = "only in elements.toml, where grains expand".to_string();
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
        for (key, value) in [
            ("plate.young_modulus", p.young_modulus),
            ("heat.end", h.end),
            ("heat.tolerance", h.tolerance),
            ("plate.hardness", p.hardness.unwrap_or(1.0)),
            ("plate.conductivity", p.conductivity.unwrap_or(1.0)),
            ("plate.pressure", p.pressure.unwrap_or(1.0)),
            ("lid.pressure", self.lid.as_ref().and_then(|lid| lid.pressure).unwrap_or(1.0)),
        ] {
            all.push((key, value, POSITIVE, positive(value)));
        }
        all.extend([
            ("plate.poisson_ratio", p.poisson_ratio, "0 to 0.5", (0.0..=0.5).contains(&p.poisson_ratio)),
            ("heat.probes", h.probes.len() as f64, "one at least", !h.probes.is_empty()),
            (
                "heat.output_every",
                h.output_every,
                "a hundred-thousandth of end, to end",
                h.output_every <= h.end && h.output_every >= 1e-5 * h.end,
            ),
            rough("plate.roughness", p.roughness),
        ]);
        if let Some(porosity) = self.lid.as_ref().and_then(|lid| lid.porosity) {
            all.push(("lid.porosity", porosity, "0.35 to 0.7", (0.35..=0.7).contains(&porosity)));
        }
        for (key, value) in
            [("plate.temperature", p.temperature), ("heat.initial_temperature", h.initial_temperature)]
        {
            all.push((key, value, "1 to 5000 K", (1.0..=5000.0).contains(&value)));
        }
        for &probe in &h.probes {
            all.push(("heat.probes", probe, POSITIVE, positive(probe)));
        }
        all
    }
}

/// A number: its key, the value, what is allowed, whether it is so.
pub(crate) type Ranged = (&'static str, f64, &'static str, bool);
/// A value that is wrong: its key, the value, what is allowed.
type Wrong = (String, String, String);

const POSITIVE: &str = "1e-12 to 1e15";

fn positive(value: f64) -> bool {
    (1e-12..=1e15).contains(&value)
}

fn rough(key: &'static str, value: Option<f64>) -> Ranged {
    let good = value.is_none_or(|v| v == 0.0 || positive(v));
    (key, value.unwrap_or_default(), "0 (smooth), or 1e-12 to 1e15", good)
}

fn hardness(key: &str, roughness: Option<f64>, hardness: Option<f64>) -> Result<(), Wrong> {
    if roughness.is_some_and(|height| height > 0.0) && hardness.is_none() {
        let allowed = "a value, because a roughness is given".to_string();
        return Err((key.to_string(), "not given".to_string(), allowed));
    }
    Ok(())
}

impl Grains {
    /// Pours the grains into a container under `gravity` \[m/s²\].
    pub(crate) fn pouring(&self, seed: u64, container: Container, gravity: f64, threads: usize) -> Pouring {
        let height = container.loose_height(self.number, self.diameter).max(container.width());
        Pouring {
            spheres: self.number,
            seed,
            diameter: self.diameter,
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
            longest: longest(self.diameter, gravity, height),
            threads,
        }
    }

    pub(crate) fn numbers(&self) -> Vec<Ranged> {
        let mut all = Vec::new();
        for (key, value) in [
            ("grains.diameter", self.diameter),
            ("grains.density", self.density),
            ("grains.young_modulus", self.young_modulus),
            ("grains.hardness", self.hardness.unwrap_or(1.0)),
            ("grains.yield_stress", self.yield_stress.unwrap_or(1.0)),
        ] {
            all.push((key, value, POSITIVE, positive(value)));
        }
        all.extend([
            ("grains.number", self.number as f64, "1 to 1000000", (1..=1_000_000).contains(&self.number)),
            ("grains.friction", self.friction, "0 to 10", (0.0..=10.0).contains(&self.friction)),
            (
                "grains.wall_friction",
                self.wall_friction,
                "0 to 10",
                (0.0..=10.0).contains(&self.wall_friction),
            ),
            ("grains.restitution", self.restitution, "0.001 to 1", (1e-3..=1.0).contains(&self.restitution)),
            (
                "grains.poisson_ratio",
                self.poisson_ratio,
                "0 to 0.5",
                (0.0..=0.5).contains(&self.poisson_ratio),
            ),
            (
                "grains.simulated_young_modulus",
                self.simulated_young_modulus,
                "1e-12 to that of the material, young_modulus",
                positive(self.simulated_young_modulus) && self.simulated_young_modulus <= self.young_modulus,
            ),
            rough("grains.roughness", self.roughness),
        ]);
        all
    }

    /// Checks what depends on the temperatures of a run \[K\] and on the gas.
    pub(crate) fn check(&self, range: [f64; 2], keys: &GasKeys) -> Result<(), Wrong> {
        hardness("grains.hardness", self.roughness, self.hardness)?;
        for (key, property) in
            [("grains.conductivity", &self.conductivity), ("grains.heat_capacity", &self.heat_capacity)]
        {
            property.check(range).map_err(|error| {
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
        if least < LEAST_RATIO {
            let text = format!("grains that conduct {LEAST_RATIO} times as well as the gas, at least");
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
            ("gas.pressure", self.pressure, POSITIVE, positive(self.pressure)),
            (
                "gas.accommodation",
                accommodation,
                "0 < accommodation <= 1",
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
        let excess = pouring.longest / pouring.step() / MOST_STEPS;
        if excess.is_nan() || excess <= 1.0 {
            return Ok(());
        }
        // The time goes with g^(-1/2), and the time step at most with g^(-1/10).
        let least = self.gravity * excess.powf(2.5);
        let allowed = format!(
            "about {least:.0e} m/s2 at least for these grains, which would take up to {:.0e} steps to come to rest; {MOST_STEPS:.0e} are allowed",
            excess * MOST_STEPS
        );
        Err(("container.gravity".into(), number(self.gravity), allowed))
    }

    pub(crate) fn numbers(&self, grains: &Grains) -> Vec<Ranged> {
        let (d, count) = (grains.diameter, grains.number as f64);
        let base = self.base.unwrap_or([2.0 * d; 2]);
        let radius = self.radius.unwrap_or(d);
        // The other one of base and radius is just large enough.
        let floor = (base[0] * base[1]).max(std::f64::consts::PI * radius * radius) / (count * d * d);
        let wide = "a floor of at most 10 squares of the diameter for each grain";
        // A grain must not meet two images of another.
        let (least, narrow) = match self.endless {
            false => (2.0, "two diameters at least"),
            true => (2.5, "two and a half diameters at least"),
        };
        vec![
            ("container.gravity", self.gravity, POSITIVE, positive(self.gravity)),
            ("container.base", base[0], narrow, self.base.is_none() || base[0] >= least * d),
            ("container.base", base[1], narrow, self.base.is_none() || base[1] >= least * d),
            ("container.radius", radius, "one diameter at least", radius >= d),
            (
                if self.base.is_some() { "container.base" } else { "container.radius" },
                if self.base.is_some() { base[0].max(base[1]) } else { radius },
                wide,
                floor.is_finite() && floor <= WIDEST.max(4.0 / count),
            ),
        ]
    }
}
