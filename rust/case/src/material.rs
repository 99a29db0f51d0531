//! Materials of grains: TOML files. Named ones are compiled into the program, others are the user's.
//!
//! | key | what | required |
//! |---|---|---|
//! | `about`, `source` | what it is; where the numbers are from | `about` |
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

use crate::CaseError;
use crate::grains::Grains;
use msdd_beds::property::{Property, VALUES};
use msdd_beds::units::{self, Given, GivenTable, Kind};
use serde::Deserialize;
use std::path::Path;
use std::sync::LazyLock;

/// The keys of a file.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Keys {
    about: String,
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

fn refuse(key: String, value: String, allowed: String) -> CaseError {
    CaseError::Parameter { key, value, allowed }
}

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
            return Err(refuse("material".to_string(), given.to_string(), allowed));
        }
        let name = file.file_stem().unwrap_or_default().to_string_lossy();
        Self::parse(&name, given, &msdd_files::read_text(file)?)
    }

    /// `file` is for messages.
    fn parse(name: &str, file: &str, text: &str) -> Result<Self, CaseError> {
        let keys: Keys = toml::from_str(text).map_err(|error| {
            refuse(
                file.to_string(),
                error.to_string().trim().to_string(),
                "the keys of a material".to_string(),
            )
        })?;
        let wrong = |key: &str, text: &str| {
            let (value, allowed) = text.split_once(", allowed: ").unwrap_or((text, "see above"));
            refuse(format!("{file}: {key}"), value.to_string(), allowed.to_string())
        };
        let number = |key: &str, given: &Option<Given>, kind: &Kind| {
            let value = given.as_ref().map(|given| given.value(kind)).transpose();
            value.map_err(|text| wrong(key, &text))
        };
        let table = |key: &str, given: &Option<GivenTable>, kind: &Kind, values: [f64; 2]| {
            let Some(given) = given else { return Ok::<_, CaseError>(None) };
            let property = given.property(kind).map_err(|text| wrong(key, &text))?;
            // Whether it covers the temperatures of a bed is another question.
            let rows = property.rows();
            let range = [rows.first(), rows.last()].map(|row| row.copied().unwrap_or_default());
            property.check(range, values).map_err(|error| wrong(key, &error.to_string()))?;
            Ok(Some(property))
        };
        let source = keys.source.map_or(String::new(), |source| format!(" ({source})"));
        Ok(Self {
            name: name.to_string(),
            about: keys.about + &source,
            temperature: number("temperature", &keys.temperature, &units::TEMPERATURE)?
                .unwrap_or(REFERENCE_TEMPERATURE),
            diameter: number("diameter", &keys.diameter, &units::LENGTH)?,
            density: number("density", &keys.density, &units::DENSITY)?,
            young_modulus: number("young_modulus", &keys.young_modulus, &units::STRESS)?,
            thermal_conductivity: table(
                "thermal_conductivity",
                &keys.thermal_conductivity,
                &units::CONDUCTIVITY,
                VALUES,
            )?,
            heat_capacity: table("heat_capacity", &keys.heat_capacity, &units::HEAT_CAPACITY, VALUES)?,
            thermal_expansion: number("thermal_expansion", &keys.thermal_expansion, &units::EXPANSION)?,
            poisson_ratio: number("poisson_ratio", &keys.poisson_ratio, &units::RATIO)?,
            roughness: number("roughness", &keys.roughness, &units::LENGTH)?,
            hardness: number("hardness", &keys.hardness, &units::STRESS)?,
            emissivity: table("emissivity", &keys.emissivity, &units::RATIO, [0.0, 1.0])?,
            crush_load: number("crush_load", &keys.crush_load, &units::FORCE)?,
        })
    }

    /// A required value: that of an option, else that of the file.
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
            refuse(format!("material {}: {key}", self.name), "missing".to_string(), allowed)
        })
    }

    /// The grains with these values instead of those of the file; properties at the proposed temperature.
    ///
    /// # Errors
    /// A value that is in neither.
    pub fn grains(&self, own: &Values) -> Result<Grains, CaseError> {
        let at =
            |property: &Option<Property>| property.as_ref().map(|property| property.at(self.temperature));
        let Values {
            density,
            young_modulus,
            thermal_conductivity,
            heat_capacity,
            thermal_expansion,
            mean_radius,
        } = *own;
        let conductivity = at(&self.thermal_conductivity);
        let radius = self.diameter.map(|diameter| 0.5 * diameter);
        Ok(Grains {
            density: self.required("density", density, self.density, &units::DENSITY)?,
            young_modulus: self.required(
                "young_modulus",
                young_modulus,
                self.young_modulus,
                &units::STRESS,
            )?,
            thermal_conductivity: self.required(
                "thermal_conductivity",
                thermal_conductivity,
                conductivity,
                &units::CONDUCTIVITY,
            )?,
            heat_capacity: self.required(
                "heat_capacity",
                heat_capacity,
                at(&self.heat_capacity),
                &units::HEAT_CAPACITY,
            )?,
            thermal_expansion: self.required(
                "thermal_expansion",
                thermal_expansion,
                self.thermal_expansion,
                &units::EXPANSION,
            )?,
            mean_radius: self.required("diameter", mean_radius, radius, &units::LENGTH)?,
        })
    }
}

/// Values that replace those of a material.
#[derive(Clone, Copy, Debug, Default)]
pub struct Values {
    pub density: Option<f64>,
    pub young_modulus: Option<f64>,
    pub thermal_conductivity: Option<f64>,
    pub heat_capacity: Option<f64>,
    pub thermal_expansion: Option<f64>,
    pub mean_radius: Option<f64>,
}

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
        let grains = own.grains(&Values { density: Some(2500.0), ..Values::default() }).unwrap();
        assert_eq!((grains.density, grains.young_modulus, grains.mean_radius), (2500.0, 71e9, 1.5e-3));
        assert!((grains.thermal_expansion - 8.8e-6).abs() < 1e-18);
        assert_eq!(own.thermal_conductivity.unwrap().at(0.5 * (293.15 + 673.15)), 1.2);
        assert_eq!(own.crush_load, Some(120.0));
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
                "own.toml: thermal_conductivity = -1.4, allowed: 1e-30 to 1e30",
            ),
            ("density", "densty", "unknown field `densty`"),
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
