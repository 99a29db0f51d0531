//! Numbers with units, as `80C`, `210 GPa` or `46 W/(m K)`. A number without a unit is in SI units, a temperature in kelvin.

use crate::property::Property;
use crate::schedule::Schedule;
use serde::{Deserialize, Deserializer, de};

/// A quantity: what it is called, and its units with their size and zero in SI units. The first one is that of a plain number.
pub struct Kind {
    name: &'static str,
    units: &'static [(&'static str, f64, f64)],
}

/// 0 °C in kelvin.
const ICE: f64 = 273.15;

pub static TEMPERATURE: Kind = Kind {
    name: "a temperature",
    units: &[("K", 1.0, 0.0), ("C", 1.0, ICE), ("degC", 1.0, ICE), ("°C", 1.0, ICE)],
};
pub static LENGTH: Kind = Kind {
    name: "a length",
    units: &[("m", 1.0, 0.0), ("mm", 1e-3, 0.0), ("um", 1e-6, 0.0), ("µm", 1e-6, 0.0), ("nm", 1e-9, 0.0)],
};
pub static STRESS: Kind = Kind {
    name: "a stress",
    units: &[("Pa", 1.0, 0.0), ("kPa", 1e3, 0.0), ("MPa", 1e6, 0.0), ("GPa", 1e9, 0.0)],
};
pub static DENSITY: Kind =
    Kind { name: "a density", units: &[("kg/m3", 1.0, 0.0), ("g/cm3", 1e3, 0.0), ("kg/m^3", 1.0, 0.0)] };
pub static CONDUCTIVITY: Kind = Kind {
    name: "a thermal conductivity",
    units: &[("W/(m K)", 1.0, 0.0), ("W/m/K", 1.0, 0.0), ("W/mK", 1.0, 0.0), ("mW/(m K)", 1e-3, 0.0)],
};
pub static HEAT_CAPACITY: Kind = Kind {
    name: "a specific heat capacity",
    units: &[("J/(kg K)", 1.0, 0.0), ("kJ/(kg K)", 1e3, 0.0), ("J/kg/K", 1.0, 0.0), ("J/kgK", 1.0, 0.0)],
};
pub static EXPANSION: Kind =
    Kind { name: "a thermal expansion coefficient", units: &[("1/K", 1.0, 0.0), ("ppm/K", 1e-6, 0.0)] };
pub static FORCE: Kind = Kind { name: "a force", units: &[("N", 1.0, 0.0), ("kN", 1e3, 0.0)] };
pub static RATIO: Kind = Kind { name: "a number", units: &[("", 1.0, 0.0)] };

impl Kind {
    /// The unit of a plain number; empty for ratios.
    pub fn unit(&self) -> &'static str {
        self.units.first().map_or("", |unit| unit.0)
    }

    /// What a text may be, for messages.
    pub fn allowed(&self) -> String {
        let units: Vec<&str> = self.units.iter().map(|unit| unit.0).filter(|unit| !unit.is_empty()).collect();
        match units.as_slice() {
            [] => format!("{} without a unit", self.name),
            [first, ..] => format!("{} in {}; a plain number is in {first}", self.name, units.join(", ")),
        }
    }

    /// The number in SI units.
    ///
    /// # Errors
    /// What is allowed.
    pub fn parse(&self, text: &str) -> Result<f64, String> {
        let text = text.trim();
        let begins = text.starts_with(|c: char| c.is_ascii_digit() || "+-.".contains(c));
        let ends = (1..=text.len()).rev().filter(|end| begins && text.is_char_boundary(*end));
        let mut split = ends.filter_map(|end| Some((text[..end].parse::<f64>().ok()?, &text[end..])));
        let (value, unit) = split.next().ok_or_else(|| self.allowed())?;
        let plain = |unit: &str| unit.replace([' ', '*', '·'], "");
        let unit = plain(unit);
        let known = self.units.iter().find(|(name, ..)| unit.is_empty() || plain(name) == unit);
        let (_, size, zero) = known.ok_or_else(|| self.allowed())?;
        // Without a unit the bytes of the number stay.
        Ok(if unit.is_empty() { value } else { value * size + zero })
    }
}

/// A number, or a text with a unit.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(untagged, expecting = "a number, or a text of a number and its unit")]
pub enum Given {
    Number(f64),
    Text(String),
}

impl Given {
    /// In SI units.
    ///
    /// # Errors
    /// The text and what is allowed, with `, allowed: ` between.
    pub fn value(&self, kind: &Kind) -> Result<f64, String> {
        match self {
            Self::Number(value) => Ok(*value),
            Self::Text(text) => kind.parse(text).map_err(|allowed| format!("\"{text}\", allowed: {allowed}")),
        }
    }
}

/// A number, or rows of a temperature or time and a number; each may have its unit.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(untagged, expecting = "a number with or without its unit, or a table of pairs of them")]
pub enum GivenTable {
    One(Given),
    Table(Vec<[Given; 2]>),
}

impl GivenTable {
    /// Over the temperature.
    ///
    /// # Errors
    /// As those of [`Given::value`].
    pub fn property(&self, kind: &Kind) -> Result<Property, String> {
        Ok(match self {
            Self::One(one) => Property::Constant(one.value(kind)?),
            Self::Table(rows) => {
                let row = |[t, value]: &[Given; 2]| Ok([t.value(&TEMPERATURE)?, value.value(kind)?]);
                Property::Table(rows.iter().map(row).collect::<Result<_, String>>()?)
            }
        })
    }
}

/// For serde: a temperature \[K\].
pub fn kelvin<'de, D: Deserializer<'de>>(of: D) -> Result<f64, D::Error> {
    Given::deserialize(of)?.value(&TEMPERATURE).map_err(de::Error::custom)
}

/// For serde: a temperature over time \[K\], which may be missing.
///
/// # Errors
/// Those of [`Given::value`].
pub fn kelvin_over_time<'de, D: Deserializer<'de>>(of: D) -> Result<Option<Schedule>, D::Error> {
    let read = |given: &Given| given.value(&TEMPERATURE).map_err(de::Error::custom);
    Ok(Some(match GivenTable::deserialize(of)? {
        GivenTable::One(one) => Schedule::Constant(read(&one)?),
        GivenTable::Table(rows) => {
            let row = |[time, value]: &[Given; 2]| match time {
                Given::Number(time) => Ok([*time, read(value)?]),
                Given::Text(text) => {
                    Err(de::Error::custom(format!("\"{text}\", allowed: a time in s without unit")))
                }
            };
            Schedule::Table(rows.iter().map(row).collect::<Result<_, _>>()?)
        }
    }))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_have_their_units() {
        for (kind, text, value) in [
            (&TEMPERATURE, "80C", 353.15),
            (&TEMPERATURE, "-20 degC", 253.15),
            (&TEMPERATURE, " 350 ", 350.0),
            (&TEMPERATURE, "350K", 350.0),
            (&STRESS, "210 GPa", 210e9),
            (&LENGTH, "6.4mm", 6.4e-3),
            (&CONDUCTIVITY, "46 W/(m·K)", 46.0),
            (&EXPANSION, "12 ppm/K", 12e-6),
            (&LENGTH, "1e-3", 1e-3),
            (&FORCE, "1e2N", 100.0),
        ] {
            let found = kind.parse(text).unwrap();
            assert!((found - value).abs() <= 1e-15 * value.abs(), "{text}: {found}");
        }
        for (kind, text) in
            [(&STRESS, "210 mm"), (&TEMPERATURE, "80F"), (&LENGTH, "nan"), (&LENGTH, "mm"), (&RATIO, "3 m")]
        {
            assert_eq!(kind.parse(text), Err(kind.allowed()), "{text}");
        }
        assert_eq!(LENGTH.allowed(), "a length in m, mm, um, µm, nm; a plain number is in m");
    }

    #[test]
    fn temperatures_of_files_may_be_in_degrees() {
        #[derive(Deserialize)]
        struct Keys {
            #[serde(deserialize_with = "kelvin")]
            a: f64,
            #[serde(deserialize_with = "kelvin_over_time")]
            b: Option<Schedule>,
        }
        let keys: Keys = toml::from_str("a = \"80C\"\nb = [[0.0, 293.15], [5, \"100 C\"]]").unwrap();
        assert_eq!((keys.a, keys.b), (353.15, Some(Schedule::Table(vec![[0.0, 293.15], [5.0, 373.15]]))));
        let wrong = toml::from_str::<Keys>("a = \"80 mm\"\nb = 1.0").err().unwrap().to_string();
        assert!(wrong.contains("\"80 mm\", allowed: a temperature in K, C"), "{wrong}");
    }
}
