//! The description of a bed that was measured: a TOML file that says what is poured, how it is handled, what heats it.

use crate::named_gases::GasName;
use crate::pour::WIDEST;
use crate::property::Property;
use msdd_engine::message::number;
use msdd_files::{FileError, read_text};
use serde::Deserialize;
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
#[derive(Clone, Debug, PartialEq, Deserialize)]
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
}

/// What the grains are poured into: `base` or `radius`.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Vessel {
    pub base: Option<[f64; 2]>,
    pub radius: Option<f64>,
    #[serde(default = "usual_gravity")]
    pub gravity: f64,
}

#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Lid {
    pub pressure: f64,
}

#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Turn {
    /// The wall that is the floor afterwards.
    pub down: String,
}

#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct GasKeys {
    pub name: GasName,
    #[serde(default = "usual_pressure")]
    pub pressure: f64,
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

fn usual_tolerance() -> f64 {
    0.05
}

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
            other => other,
        })
    }

    /// Temperatures \[K\] between which everything stays.
    pub fn temperatures(&self) -> [f64; 2] {
        let (a, b) = (self.heat.initial_temperature, self.plate.temperature);
        [a.min(b), a.max(b)]
    }

    /// Key, value, what is allowed of the first value outside its range.
    fn check(&self) -> Result<(), (String, String, String)> {
        let range = self.temperatures();
        for (key, value, allowed, good) in self.numbers() {
            if !good {
                return Err((key.to_string(), number(value), allowed.to_string()));
            }
        }
        let (g, p) = (&self.grains, &self.plate);
        for (key, rough, hard) in
            [("grains.hardness", g.roughness, g.hardness), ("plate.hardness", p.roughness, p.hardness)]
        {
            if rough.is_some_and(|height| height > 0.0) && hard.is_none() {
                let allowed = "a value, because a roughness is given".to_string();
                return Err((key.to_string(), "not given".to_string(), allowed));
            }
        }
        for (key, property) in [
            ("grains.conductivity", &self.grains.conductivity),
            ("grains.heat_capacity", &self.grains.heat_capacity),
        ] {
            property.check(range).map_err(|error| {
                let text = error.to_string();
                let (value, allowed) = text.split_once(", allowed: ").unwrap_or((&text, "see above"));
                (key.to_string(), value.to_string(), allowed.to_string())
            })?;
        }
        let [low, high] = self.gas.name.range();
        if range[0] < low || range[1] > high {
            let allowed = format!("a gas that is known there; this one: {low} to {high} K");
            return Err((
                "gas.name".into(),
                format!("{} at {} K to {} K", self.gas.name.as_str(), number(range[0]), number(range[1])),
                allowed,
            ));
        }
        let ratio = |t: f64| {
            let gas = self.gas.name.at(t, self.gas.pressure, self.gas.accommodation);
            gas.map_or(f64::INFINITY, |gas| self.grains.conductivity.at(t) / gas.conductivity)
        };
        // A table may dip at a row, and the gas is no straight line between two.
        let between = (0..=LOOKS).map(|k| range[0] + (range[1] - range[0]) * f64::from(k) / f64::from(LOOKS));
        let rows = self.grains.conductivity.rows().into_iter().filter(|t| (range[0]..=range[1]).contains(t));
        let least = between.chain(rows).map(ratio).fold(f64::INFINITY, f64::min);
        if least < crate::gas::LEAST_RATIO {
            let allowed = format!(
                "grains that conduct {} times as well as the gas, at least: the heat of poorer ones does not go from grain to grain (msddFoam has a law for such beds)",
                crate::gas::LEAST_RATIO
            );
            return Err(("grains.conductivity".into(), format!("{least:.1} times that of the gas"), allowed));
        }
        match (self.container.base, self.container.radius) {
            (Some(_), None) | (None, Some(_)) => {}
            _ => {
                let value = "both or neither of base and radius".to_string();
                return Err(("container".into(), value, "one of base and radius".into()));
            }
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
    pub fn vessel(&self) -> crate::pour::Container {
        match (self.container.base, self.container.radius) {
            (Some(base), _) => crate::pour::Container::Box { base },
            (None, radius) => crate::pour::Container::Cylinder { radius: radius.unwrap_or_default() },
        }
    }

    fn numbers(&self) -> Vec<(&'static str, f64, &'static str, bool)> {
        const POSITIVE: &str = "1e-12 to 1e15";
        const TEMPERATURE: &str = "1 to 5000 K";
        let positive = |v: f64| (1e-12..=1e15).contains(&v);
        let none_or = |v: Option<f64>| v.is_none_or(positive);
        let (g, p, h) = (&self.grains, &self.plate, &self.heat);
        let base = self.container.base.unwrap_or([2.0 * g.diameter; 2]);
        let radius = self.container.radius.unwrap_or(g.diameter);
        // The other one of base and radius is just large enough.
        let floor = (base[0] * base[1]).max(std::f64::consts::PI * radius * radius);
        let floor = floor / (g.number as f64 * g.diameter * g.diameter);
        let wide = "a floor of at most 10 squares of the diameter for each grain";
        let mut all = Vec::new();
        for (key, value) in [
            ("grains.diameter", g.diameter),
            ("grains.density", g.density),
            ("grains.young_modulus", g.young_modulus),
            ("container.gravity", self.container.gravity),
            ("gas.pressure", self.gas.pressure),
            ("plate.young_modulus", p.young_modulus),
            ("heat.end", h.end),
            ("heat.tolerance", h.tolerance),
        ] {
            all.push((key, value, POSITIVE, positive(value)));
        }
        all.extend([
            ("grains.number", g.number as f64, "1 to 1000000", (1..=1_000_000).contains(&g.number)),
            ("grains.friction", g.friction, "0 to 10", (0.0..=10.0).contains(&g.friction)),
            ("grains.wall_friction", g.wall_friction, "0 to 10", (0.0..=10.0).contains(&g.wall_friction)),
            ("grains.restitution", g.restitution, "0.001 to 1", (1e-3..=1.0).contains(&g.restitution)),
            ("grains.poisson_ratio", g.poisson_ratio, "0 to 0.5", (0.0..=0.5).contains(&g.poisson_ratio)),
            ("plate.poisson_ratio", p.poisson_ratio, "0 to 0.5", (0.0..=0.5).contains(&p.poisson_ratio)),
            (
                "gas.accommodation",
                self.gas.accommodation,
                "0 < accommodation <= 1",
                self.gas.accommodation > 0.0 && self.gas.accommodation <= 1.0,
            ),
            (
                "grains.simulated_young_modulus",
                g.simulated_young_modulus,
                "1e-12 to that of the material, young_modulus",
                positive(g.simulated_young_modulus) && g.simulated_young_modulus <= g.young_modulus,
            ),
            ("heat.probes", h.probes.len() as f64, "one at least", !h.probes.is_empty()),
            (
                "heat.output_every",
                h.output_every,
                "a hundred-thousandth of end, to end",
                h.output_every <= h.end && h.output_every >= 1e-5 * h.end,
            ),
            ("container.base", base[0], "two diameters at least", base[0] >= 2.0 * g.diameter),
            ("container.base", base[1], "two diameters at least", base[1] >= 2.0 * g.diameter),
            ("container.radius", radius, "one diameter at least", radius >= g.diameter),
            (
                if self.container.base.is_some() { "container.base" } else { "container.radius" },
                if self.container.base.is_some() { base[0].max(base[1]) } else { radius },
                wide,
                floor.is_finite() && floor <= WIDEST.max(4.0 / g.number as f64),
            ),
        ]);
        for (key, value) in [
            ("grains.hardness", g.hardness),
            ("grains.yield_stress", g.yield_stress),
            ("plate.hardness", p.hardness),
            ("plate.conductivity", p.conductivity),
            ("plate.pressure", p.pressure),
            ("lid.pressure", self.lid.as_ref().map(|lid| lid.pressure)),
        ] {
            all.push((key, value.unwrap_or(1.0), POSITIVE, none_or(value)));
        }
        for (key, value) in [("grains.roughness", g.roughness), ("plate.roughness", p.roughness)] {
            let good = value.is_none_or(|v| v == 0.0 || positive(v));
            all.push((key, value.unwrap_or_default(), "0 (smooth), or 1e-12 to 1e15", good));
        }
        for (key, value) in
            [("plate.temperature", p.temperature), ("heat.initial_temperature", h.initial_temperature)]
        {
            all.push((key, value, TEMPERATURE, (1.0..=5000.0).contains(&value)));
        }
        for &probe in &h.probes {
            all.push(("heat.probes", probe, POSITIVE, positive(probe)));
        }
        all
    }
}
