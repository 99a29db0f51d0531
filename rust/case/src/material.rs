//! Materials of grains: TOML files. Named ones are compiled into the program, others are the user's.
//!
//! | key | what | required |
//! |---|---|---|
//! | `about`, `source` | what it is; where the numbers are from | |
//! | `temperature` | proposed temperature of a bed at the start | |
//! | `diameter` | of the grains, mean of discs, Sauter mean of spheres | yes |
//! | `density`, `young_modulus` | of a grain | yes |
//! | `thermal_conductivity`, `heat_capacity` | a number, or a table over the temperature for spheres | yes |
//! | `thermal_expansion` | linear coefficient | yes |
//! | `poisson_ratio` | | of spheres |
//! | `roughness`, `hardness` | height of the asperities over their slope; of the surface | `hardness` with `roughness` |
//! | `emissivity` | as the conductivity; without it spheres do not radiate | |
//! | `crush_load` | force on a contact at which a sphere breaks | |
//!
//! A required value may be given by its option of `msdd case new` instead. Numbers are in SI units, or texts with a unit.

use crate::grains::{GRAIN_EXPANSIONS, GRAIN_VALUES, Grains};
use crate::{CaseError, refused};
use msdd_beds::property::Property;
use msdd_beds::units::{self, Given, GivenTable, Kind};
use msdd_rve::message;
use serde::Deserialize;
use std::path::Path;
use std::sync::LazyLock;

/// The keys of a file.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Keys {
    about: Option<String>,
    source: Option<String>,
    temperature: Option<Given>,
    diameter: Option<Given>,
    density: Option<Given>,
    young_modulus: Option<Given>,
    thermal_conductivity: Option<GivenTable>,
    heat_capacity: Option<GivenTable>,
    thermal_expansion: Option<Given>,
    poisson_ratio: Option<Given>,
    roughness: Option<Given>,
    hardness: Option<Given>,
    emissivity: Option<GivenTable>,
    crush_load: Option<Given>,
}

/// A key with a value: its kind, and its range in SI units.
struct Key {
    name: &'static str,
    kind: &'static Kind,
    range: [f64; 2],
}

/// Ranges of Poisson's ratio, hardness \[Pa\] and the force at which a sphere breaks \[N\].
pub const POISSON_RATIOS: [f64; 2] = [-0.99, 0.5];
pub const HARDNESSES: [f64; 2] = [1.0, 1e15];
pub const CRUSH_LOADS: [f64; 2] = [1e-12, 1e9];

macro_rules! keys {
    ($($constant:ident = $name:literal: $kind:ident, $range:expr;)*) => {
        $(static $constant: Key = Key { name: $name, kind: &units::$kind, range: $range };)*
        /// The keys with values, for messages.
        static KEYS: &[&Key] = &[$(&$constant),*];
    };
}

keys! {
    TEMPERATURE = "temperature": TEMPERATURE, [0.0, 1e5];
    DIAMETER = "diameter": LENGTH, [2.0 * GRAIN_VALUES[0], 2.0 * GRAIN_VALUES[1]];
    DENSITY = "density": DENSITY, GRAIN_VALUES;
    YOUNG_MODULUS = "young_modulus": STRESS, GRAIN_VALUES;
    THERMAL_CONDUCTIVITY = "thermal_conductivity": CONDUCTIVITY, GRAIN_VALUES;
    HEAT_CAPACITY = "heat_capacity": HEAT_CAPACITY, GRAIN_VALUES;
    THERMAL_EXPANSION = "thermal_expansion": EXPANSION, GRAIN_EXPANSIONS;
    POISSON_RATIO = "poisson_ratio": RATIO, POISSON_RATIOS;
    ROUGHNESS = "roughness": LENGTH, [0.0, 0.01 * GRAIN_VALUES[1]];
    HARDNESS = "hardness": STRESS, HARDNESSES;
    EMISSIVITY = "emissivity": RATIO, [0.0, 1.0];
    CRUSH_LOAD = "crush_load": FORCE, CRUSH_LOADS;
}

impl Key {
    fn allowed(&self) -> String {
        let unit = if self.kind.unit().is_empty() { String::new() } else { format!(" {}", self.kind.unit()) };
        // The largest roughness depends on the spheres, which are checked when they are complete.
        let range = match self.name {
            "roughness" => "0 to a hundredth of the radius,".to_string(),
            _ => message::range(self.range),
        };
        range + &unit
    }
}

/// All keys with their ranges.
fn all_keys() -> String {
    let keys: Vec<String> = KEYS.iter().map(|key| format!("{} ({})", key.name, key.allowed())).collect();
    format!("the keys about, source (texts), {}", keys.join(", "))
}

/// A material in SI units.
#[derive(Clone, Debug, PartialEq)]
pub struct Material {
    pub name: String,
    /// Description, and the source of the numbers.
    pub about: String,
    /// Proposed initial temperature \[K\].
    pub temperature: f64,
    pub diameter: Option<f64>,
    pub density: Option<f64>,
    pub young_modulus: Option<f64>,
    pub thermal_conductivity: Option<Property>,
    pub heat_capacity: Option<Property>,
    pub thermal_expansion: Option<f64>,
    pub poisson_ratio: Option<f64>,
    pub roughness: Option<f64>,
    pub hardness: Option<f64>,
    pub emissivity: Option<Property>,
    pub crush_load: Option<f64>,
}

macro_rules! named {
    ($kind:literal: $($name:literal),*) => {
        [$(($name, include_str!(concat!("../materials/", $kind, "/", $name, ".toml")))),*]
    };
}

/// Name and text of the named materials.
pub const DISCS: [(&str, &str); 4] = named!("discs": "paper", "steel", "glass", "alumina");
/// The same of spheres.
pub const SPHERES: [(&str, &str); 4] =
    named!("spheres": "steel", "glass", "alumina", "lithium-orthosilicate");

/// The named materials of discs; the first one is the default.
pub static OF_DISCS: LazyLock<Vec<Material>> = LazyLock::new(|| shipped(&DISCS));
/// The named materials of spheres; the first one is the default.
pub static OF_SPHERES: LazyLock<Vec<Material>> = LazyLock::new(|| shipped(&SPHERES));

/// A test reads all of them.
fn shipped(files: &[(&str, &str)]) -> Vec<Material> {
    files.iter().filter_map(|(name, text)| Material::parse(name, name, text).ok()).collect()
}

/// Room temperature \[K\], for materials that propose none.
const REFERENCE_TEMPERATURE: f64 = 293.15;

impl Material {
    /// The material that a name or a file means.
    ///
    /// # Errors
    /// A name that is not among `named` and no file; a file that cannot be read or has a wrong value.
    pub fn find(named: &[Self], given: &str) -> Result<Self, CaseError> {
        if let Some(found) = named.iter().find(|material| material.name == given) {
            return Ok(found.clone());
        }
        let file = Path::new(given);
        if file.extension().is_none_or(|extension| extension != "toml") {
            let names: Vec<&str> = named.iter().map(|material| material.name.as_str()).collect();
            let allowed = format!("{}; or a file FILE.toml with the values of another", names.join(", "));
            return Err(refused("material", given, allowed));
        }
        let name = file.file_stem().unwrap_or_default().to_string_lossy();
        Self::parse(&name, given, &msdd_files::read_text(file)?)
    }

    /// `file` is for messages.
    fn parse(name: &str, file: &str, text: &str) -> Result<Self, CaseError> {
        let keys: Keys = toml::from_str(text).map_err(|error| {
            let error = error.to_string();
            // What serde expected is in the list of all keys, which has their ranges.
            let problem = error.split(", expected one of").next().unwrap_or_default().trim();
            refused(file, problem, all_keys())
        })?;
        let wrong = |key: &Key, text: &str| {
            let (value, allowed) = text.split_once(", allowed: ").unwrap_or((text, "see above"));
            refused(format!("{file}: {}", key.name), value, allowed)
        };
        let number = |key: &Key, given: &Option<Given>| {
            let Some(given) = given else { return Ok::<_, CaseError>(None) };
            let value = given.value(key.kind).map_err(|text| wrong(key, &text))?;
            match (key.range[0]..=key.range[1]).contains(&value) {
                true => Ok(Some(value)),
                false => Err(wrong(key, &format!("{}, allowed: {}", message::number(value), key.allowed()))),
            }
        };
        let table = |key: &Key, given: &Option<GivenTable>| {
            let Some(given) = given else { return Ok::<_, CaseError>(None) };
            let property = given.property(key.kind).map_err(|text| wrong(key, &text))?;
            // Whether it covers the temperatures of a bed is another question.
            let rows = property.rows();
            let covered = [rows.first(), rows.last()].map(|row| row.copied().unwrap_or_default());
            let told = |(value, allowed)| wrong(key, &format!("{value}, allowed: {allowed}"));
            property.check(covered, key.range).map_err(told)?;
            Ok(Some(property))
        };
        let source = keys.source.map_or(String::new(), |source| format!(" ({source})"));
        Ok(Self {
            name: name.to_string(),
            about: keys.about.unwrap_or_else(|| format!("values of {name}.toml")) + &source,
            temperature: number(&TEMPERATURE, &keys.temperature)?.unwrap_or(REFERENCE_TEMPERATURE),
            diameter: number(&DIAMETER, &keys.diameter)?,
            density: number(&DENSITY, &keys.density)?,
            young_modulus: number(&YOUNG_MODULUS, &keys.young_modulus)?,
            thermal_conductivity: table(&THERMAL_CONDUCTIVITY, &keys.thermal_conductivity)?,
            heat_capacity: table(&HEAT_CAPACITY, &keys.heat_capacity)?,
            thermal_expansion: number(&THERMAL_EXPANSION, &keys.thermal_expansion)?,
            poisson_ratio: number(&POISSON_RATIO, &keys.poisson_ratio)?,
            roughness: number(&ROUGHNESS, &keys.roughness)?,
            hardness: number(&HARDNESS, &keys.hardness)?,
            emissivity: table(&EMISSIVITY, &keys.emissivity)?,
            crush_load: number(&CRUSH_LOAD, &keys.crush_load)?,
        })
    }

    /// A required value: from an option, else from the file.
    ///
    /// # Errors
    /// It is missing: what would serve.
    pub fn required(
        &self,
        key: &str,
        option: Option<f64>,
        own: Option<f64>,
        kind: &Kind,
    ) -> Result<f64, CaseError> {
        option.or(own).ok_or_else(|| {
            let allowed = format!("{}; or the option --{}", kind.allowed(), key.replace('_', "-"));
            refused(format!("material {}: {key}", self.name), "missing", allowed)
        })
    }

    /// The grains with these values, and the others of the file; properties at the proposed temperature.
    ///
    /// # Errors
    /// A value that is in neither.
    pub fn grains(&self, own: &Values) -> Result<Grains, CaseError> {
        let at =
            |property: &Option<Property>| property.as_ref().map(|property| property.at(self.temperature));
        let known: [(&str, Option<f64>, &Kind); 6] = [
            ("density", self.density, &units::DENSITY),
            ("young_modulus", self.young_modulus, &units::STRESS),
            ("thermal_conductivity", at(&self.thermal_conductivity), &units::CONDUCTIVITY),
            ("heat_capacity", at(&self.heat_capacity), &units::HEAT_CAPACITY),
            ("thermal_expansion", self.thermal_expansion, &units::EXPANSION),
            ("diameter", self.diameter.map(|diameter| 0.5 * diameter), &units::LENGTH),
        ];
        let mut values = [0.0; 6];
        for ((value, own), (key, usual, kind)) in values.iter_mut().zip(own).zip(known) {
            *value = self.required(key, *own, usual, kind)?;
        }
        Ok(Grains::from(values))
    }
}

/// Values that replace those of a material, in the order of [`Grains::named`].
pub type Values = [Option<f64>; 6];

#[cfg(test)]
mod tests {
    use super::*;

    const OWN: &str = "about = \"balls\"\ndiameter = \"3 mm\"\ndensity = \"2.4 g/cm3\"\nyoung_modulus = \"71 GPa\"\n\
        poisson_ratio = 0.22\nthermal_conductivity = [[\"20C\", 1.0], [\"400 C\", 1.4]]\nheat_capacity = 800\n\
        thermal_expansion = \"8.8 ppm/K\"\ncrush_load = \"120 N\"\n";

    #[test]
    fn all_named_materials_are_read() {
        assert_eq!((OF_DISCS.len(), OF_SPHERES.len()), (DISCS.len(), SPHERES.len()));
        for material in OF_DISCS.iter().chain(OF_SPHERES.iter()) {
            material.grains(&Values::default()).unwrap().check().unwrap();
        }
    }

    #[test]
    fn a_file_has_units_and_tables() {
        let own = Material::parse("own", "own.toml", OWN).unwrap();
        let grains = own.grains(&[Some(2500.0), None, None, None, None, None]).unwrap();
        assert_eq!((grains.density, grains.young_modulus, grains.mean_radius), (2500.0, 71e9, 1.5e-3));
        assert!((grains.thermal_expansion - 8.8e-6).abs() < 1e-18);
        assert_eq!(own.thermal_conductivity.unwrap().at(0.5 * (293.15 + 673.15)), 1.2);
        assert_eq!(own.crush_load, Some(120.0));
    }

    #[test]
    fn the_description_may_be_left_out() {
        let own = Material::parse("own", "some/own.toml", &OWN.replace("about = \"balls\"\n", "")).unwrap();
        assert_eq!(own.about, "values of own.toml");
    }

    #[test]
    fn what_is_missing_or_wrong_is_named() {
        let read = |from: &str, to: &str| Material::parse("own", "own.toml", &OWN.replace(from, to));
        for (from, to, text) in [
            (
                "71 GPa",
                "71 mm",
                "own.toml: young_modulus = \"71 mm\", allowed: a stress in Pa, kPa, MPa, GPa; a plain number is in Pa",
            ),
            (
                "400 C",
                "400 mm",
                "own.toml: thermal_conductivity = \"400 mm\", allowed: a temperature in K, C",
            ),
            (
                "[\"400 C\", 1.4]",
                "[\"400 C\", -1.4]",
                "own.toml: thermal_conductivity = -1.4, allowed: 1e-12 to 1e15",
            ),
            (
                "density",
                "densty",
                "unknown field `densty`, allowed: the keys about, source (texts), temperature",
            ),
            (
                "density",
                "densty",
                ", poisson_ratio (-0.99 to 0.5), roughness (0 to a hundredth of the radius, m), hardness (1 to 1e15 Pa), ",
            ),
            ("2.4 g/cm3", "-2.4 g/cm3", "own.toml: density = -2400, allowed: 1e-12 to 1e15 kg/m3"),
            ("0.22", "0.6", "own.toml: poisson_ratio = 0.6, allowed: -0.99 to 0.5"),
        ] {
            let found = read(from, to).unwrap_err().to_string();
            assert!(found.contains(text), "{found}");
        }
        let without =
            read("heat_capacity = 800\n", "").unwrap().grains(&Values::default()).unwrap_err().to_string();
        assert!(
            without.starts_with(
                "material own: heat_capacity = missing, allowed: a specific heat capacity in J/(kg K)"
            ) && without.ends_with("or the option --heat-capacity"),
            "{without}"
        );
        let unknown = Material::find(&OF_SPHERES, "chalk").unwrap_err().to_string();
        assert!(unknown.contains("material = chalk, allowed: steel, glass"), "{unknown}");
    }
}
