//! The parameters of the law that are fitted to stresses: name, range, and how the fit counts them.

use super::contacts::Contacts;
use super::law::{Element, Law};
use crate::SurrogateError;
use crate::document::field;
use nalgebra::DVector;
use serde_json::Value;
use std::collections::BTreeMap;

/// How the fit counts a parameter, and its range.
enum Scale {
    /// By its logarithm.
    Logarithm([f64; 2]),
    /// Over this.
    Over(f64, [f64; 2]),
}

use Scale::{Logarithm, Over};

/// A bound for a message: 1e-6 instead of 0.000001.
fn short(bound: f64) -> String {
    let (plain, power) = (bound.to_string(), format!("{bound:e}"));
    if plain.len() > power.len() + 1 { power } else { plain }
}

impl Scale {
    fn range(&self) -> [f64; 2] {
        match self {
            Logarithm(range) | Over(_, range) => *range,
        }
    }

    /// Whether a value is in the range; else the range in words.
    fn check(&self, value: f64) -> Result<(), String> {
        let [least, most] = self.range();
        match (least..=most).contains(&value) {
            true => Ok(()),
            false => Err(format!("{} to {}", short(least), short(most))),
        }
    }
}

const FREE: [f64; 2] = [-1e4, 1e4];
const SIZE: [f64; 2] = [1e-6, 1e6];
const STRENGTH: [f64; 2] = [1e-6, 2.0];
const OF_FABRIC: [f64; 2] = [1e-6, 20.0];
const POWER: [f64; 2] = [-2.0, 1.0];

/// Parameters as they are named in a model file, in its object `law`. Coefficients of x are divided by 10.
const TABLE: [(&str, Scale); 52] = [
    ("bulk[0]", Logarithm(SIZE)),
    ("bulk[1]", Over(10.0, FREE)),
    ("bulk[2]", Over(1.0, [-5.0, 5.0])),
    ("bulk[3]", Over(1.0, [-1.0, 2.0])),
    ("bulk[4]", Over(1.0, [-1.0, 2.0])),
    ("bulk[5]", Over(1.0, [-20.0, 20.0])),
    ("shear[0]", Over(10.0, FREE)),
    ("shear[1]", Over(1.0, [-1.0, 1.0])),
    ("shear[2]", Over(1.0, [-5.0, 5.0])),
    ("dilatancy[0]", Over(0.1, FREE)),
    ("dilatancy[1]", Over(1.0, FREE)),
    ("dilatancy[2]", Over(0.1, FREE)),
    ("dilatancy[3]", Over(1.0, FREE)),
    ("dilatancy[4]", Over(10.0, FREE)),
    ("collapse[0]", Over(0.1, [0.0, 10.0])),
    ("collapse[1]", Over(10.0, FREE)),
    ("collapse[2]", Over(1.0, [0.0, 3.0])),
    ("collapse[3]", Over(1.0, [0.05, 20.0])),
    ("mobilising", Over(0.1, [0.0, 100.0])),
    ("settling[0]", Over(1.0, [0.0, 10.0])),
    ("settling[1]", Logarithm([1e-9, 1.0])),
    ("settling[2]", Over(10.0, FREE)),
    ("settling[3]", Over(0.1, [0.0, 0.5])),
    ("fabric[0]", Over(1.0, [0.0, 100.0])),
    ("elements[0].stiffness", Logarithm(SIZE)),
    ("elements[0].strength", Logarithm(STRENGTH)),
    ("elements[0].growth", Over(10.0, FREE)),
    ("elements[0].free", Over(1.0, [-10.0, 10.0])),
    ("elements[0].hardening", Over(1.0, [-3.0, 3.0])),
    ("elements[0].power", Over(1.0, POWER)),
    ("elements[1].stiffness", Logarithm(SIZE)),
    ("elements[1].strength", Logarithm(STRENGTH)),
    ("elements[1].growth", Over(10.0, FREE)),
    ("elements[1].free", Over(1.0, [-10.0, 10.0])),
    ("elements[1].hardening", Over(1.0, [-3.0, 3.0])),
    ("elements[1].power", Over(1.0, POWER)),
    ("elements[2].stiffness", Logarithm(SIZE)),
    ("elements[2].strength", Logarithm(STRENGTH)),
    ("elements[2].growth", Over(10.0, FREE)),
    ("elements[2].free", Over(1.0, [-10.0, 10.0])),
    ("elements[2].hardening", Over(1.0, [-3.0, 3.0])),
    ("elements[2].power", Over(1.0, POWER)),
    ("elements[3].stiffness", Logarithm(SIZE)),
    ("elements[3].strength", Logarithm(OF_FABRIC)),
    ("elements[3].growth", Over(10.0, FREE)),
    ("elements[3].free", Over(1.0, [-10.0, 10.0])),
    ("elements[3].hardening", Over(1.0, [-3.0, 3.0])),
    ("elements[3].power", Over(1.0, POWER)),
    ("least_contacts", Over(1.0, [0.0, 6.0])),
    ("forgetting", Over(1.0, [0.0, 1.0])),
    ("bulk[6]", Over(1.0, [-10.0, 1.0])),
    ("lode", Over(1.0, [0.0, 0.8])),
];

/// The value of a parameter in the law as JSON.
fn at<'a>(law: &'a mut Value, name: &str) -> Option<&'a mut Value> {
    let pointer = name.replace(['[', '.'], "/").replace(']', "");
    law.pointer_mut(&format!("/{pointer}"))
}

fn document(law: &Law) -> Value {
    serde_json::to_value(law).unwrap_or_else(|error| unreachable!("plain numbers: {error}"))
}

/// Refuses a law with a parameter outside of its range.
///
/// # Errors
/// [`SurrogateError::Field`] with name, value and range.
pub(super) fn check(law: &Law) -> Result<(), SurrogateError> {
    let mut law = document(law);
    TABLE.iter().try_for_each(|(name, scale)| {
        // A number that is not finite is null in JSON.
        let value = at(&mut law, name).and_then(|value| value.as_f64()).unwrap_or(f64::NAN);
        scale.check(value).or_else(|range| field(&format!("law.{name}"), value, range))
    })
}

/// The parameters that a fit changes, and the law that has the others.
pub struct Free {
    base: Value,
    rows: Vec<&'static (&'static str, Scale)>,
}

impl Free {
    /// All but the `fixed` ones, whose values are given.
    ///
    /// # Errors
    /// [`SurrogateError::Option`] for a name that no parameter has, and for a value outside of its range.
    pub fn new(fixed: &BTreeMap<String, f64>) -> Result<Self, SurrogateError> {
        let mut base = document(&beginning());
        for (name, &value) in fixed {
            let refuse = |allowed: String| {
                let value = format!("{name}={value}");
                Err(SurrogateError::Option { key: "fix", value, allowed: allowed.into() })
            };
            let Some((name, scale)) = TABLE.iter().find(|row| row.0 == name) else {
                let names: Vec<&str> = TABLE.iter().map(|row| row.0).collect();
                return refuse(format!("a value of one of these: {}", names.join(", ")));
            };
            if let Err(range) = scale.check(value) {
                return refuse(range);
            }
            if let Some(place) = at(&mut base, name) {
                *place = value.into();
            }
        }
        Ok(Self { base, rows: TABLE.iter().filter(|row| !fixed.contains_key(row.0)).collect() })
    }

    /// Their number.
    pub fn count(&self) -> usize {
        self.rows.len()
    }

    /// The parameters at which a fit starts, as it counts them.
    pub fn start(&self) -> DVector<f64> {
        self.of(self.base.clone())
    }

    fn of(&self, mut law: Value) -> DVector<f64> {
        let all = self.rows.iter().map(|(name, scale)| {
            let value = at(&mut law, name).and_then(|value| value.as_f64()).unwrap_or(f64::NAN);
            match scale {
                Logarithm(_) => value.ln(),
                Over(size, _) => value / size,
            }
        });
        DVector::from_vec(all.collect())
    }

    /// The law of these parameters, each the nearest value in its range.
    pub fn law(&self, parameters: &DVector<f64>) -> Law {
        let mut law = self.base.clone();
        for ((name, scale), value) in self.rows.iter().zip(parameters.iter()) {
            let [least, most] = scale.range();
            let value = match scale {
                Logarithm(_) => value.exp(),
                Over(size, _) => size * value,
            };
            if let Some(place) = at(&mut law, name) {
                // NaN becomes the least: JSON has none.
                *place = value.max(least).min(most).into();
            }
        }
        serde_json::from_value(law).unwrap_or_else(|error| unreachable!("plain numbers: {error}"))
    }
}

/// Where the fit begins: values of an earlier fit, to three digits.
pub fn beginning() -> Law {
    let element = |[stiffness, strength, growth, unmobilised, hardening, power]: [f64; 6]| Element {
        stiffness,
        strength,
        growth,
        unmobilised,
        hardening,
        power,
    };
    Law {
        bulk: [0.0784, 8.99, 0.0334, 0.216, 0.122, -3.81, -0.856],
        shear: [5.95, 0.16, 0.159],
        least_contacts: 4.12,
        forgetting: 0.249,
        elements: [
            element([0.179, 0.128, 17.1, 0.291, 0.229, -1.27]),
            element([0.816, 0.0474, -19.8, 1.94, 0.32, -0.773]),
            element([0.441, 0.106, 6.19, 0.586, 0.205, -1.0]),
            element([0.0908, 0.526, 7.64, -0.738, 0.187, -0.202]),
        ],
        dilatancy: [0.01, 0.395, -0.0185, -0.287, 4.62],
        collapse: [0.105, 62.9, 0.154, 1.65],
        mobilising: 0.0317,
        opening_densification: [0.0406, 0.00029, 153.0, 0.0306],
        fabric: [5.75, 0.642],
        lode: 0.45,
        contacts: Contacts {
            sheared: [4.17, 10.1, -5.26, 5.61, 48.7, -0.0919],
            surplus: 1.82,
            fading: [0.4, 0.6],
        },
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn free(fixed: &[(&str, f64)]) -> Result<Free, SurrogateError> {
        Free::new(&fixed.iter().map(|(name, value)| (name.to_string(), *value)).collect())
    }

    #[test]
    fn each_name_is_a_number_of_the_law() {
        let mut law = document(&beginning());
        for (name, _) in &TABLE {
            assert!(at(&mut law, name).is_some_and(|value| value.is_f64()), "{name}");
        }
        assert!(check(&beginning()).is_ok());
    }

    #[test]
    fn parameters_are_the_numbers_of_the_law() {
        let all = free(&[]).expect("none fixed");
        let mut law = beginning();
        law.bulk[1] *= 1.5;
        law.opening_densification[1] *= 2.0;
        let again = all.law(&all.of(document(&law)));
        let change = |a: f64, b: f64| (a / b - 1.0).abs();
        assert!(change(again.bulk[1], law.bulk[1]) < 1e-12, "{again:?}");
        assert!(change(again.opening_densification[1], law.opening_densification[1]) < 1e-12, "{again:?}");
        // Ranges are kept, so that every file of a training can be read.
        for far in [-1e3, 1e3] {
            assert!(all.law(&DVector::from_element(all.count(), far)).check().is_ok());
        }
    }

    #[test]
    fn fixed_parameters_stay() {
        let some = free(&[("lode", 0.2), ("elements[3].free", -1.0)]).expect("good");
        assert_eq!(some.count(), TABLE.len() - 2);
        let law = some.law(&DVector::from_element(some.count(), 0.3));
        assert_eq!((law.lode, law.elements[3].unmobilised), (0.2, -1.0));
        let text =
            |fixed: &[(&str, f64)]| free(fixed).err().map(|error| error.to_string()).unwrap_or_default();
        assert_eq!(text(&[("lode", 0.9)]), "training option fix = lode=0.9, allowed: 0 to 0.8");
        let unknown = text(&[("load", 0.1)]);
        assert!(
            unknown.contains("fix = load=0.1, allowed: a value of one of these: bulk[0], ")
                && unknown.contains("lode"),
            "{unknown}"
        );
    }
}
