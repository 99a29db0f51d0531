//! Parameters of the grains.

use msdd_engine::message::number;
use serde::{Deserialize, Serialize};

/// Stiffness of contacts.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum Stiffness {
    /// Hertz (normal) and Mindlin (tangential), by Young's modulus E \[Pa\] and Poisson's ratio ν [-] of the grains.
    HertzMindlin { young_modulus: f64, poisson_ratio: f64 },
    /// Springs of constant stiffness [N/m] along the normal and along the contact plane.
    Linear { normal: f64, tangential: f64 },
}

/// Mechanical parameters of the grains, one material for all; walls are of the same material.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Material {
    /// Density ρ of the grains [kg/m³].
    pub density: f64,
    /// `hertz_mindlin` with `young_modulus` and `poisson_ratio` of the grains, or `linear` with the spring constants `normal`
    /// and `tangential` [Pa, –; N/m].
    pub stiffness: Stiffness,
    /// Coefficient of friction μ between grains: contacts slide at |f_t| = μ f_n.
    pub friction: f64,
    /// The same of contacts with walls.
    pub wall_friction: f64,
    /// Speed after over speed before a head-on collision of two grains, at any speed; 1 is without damping.
    pub restitution: f64,
}

/// A material parameter outside its allowed range.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[error("material: {key} = {value}, allowed: {allowed}", value = number(*value))]
pub struct MaterialError {
    pub key: &'static str,
    pub value: f64,
    pub allowed: &'static str,
}

impl Material {
    /// Refuses values for which the contact law has no meaning.
    ///
    /// # Errors
    /// The first parameter outside its range, by its key.
    pub fn check(&self) -> Result<(), MaterialError> {
        // Within these bounds products of several parameters stay finite.
        let positive = |v: f64| (1e-30..=1e30).contains(&v);
        let mut parameters = vec![("density", self.density, positive(self.density), "1e-30 to 1e30 kg/m3")];
        match self.stiffness {
            Stiffness::HertzMindlin { young_modulus: e, poisson_ratio: nu } => parameters.extend([
                ("young_modulus", e, positive(e), "1e-30 to 1e30 Pa"),
                ("poisson_ratio", nu, (0.0..=0.5).contains(&nu), "0 to 0.5"),
            ]),
            Stiffness::Linear { normal, tangential } => parameters.extend([
                ("normal", normal, positive(normal), "1e-30 to 1e30 N/m"),
                (
                    "tangential",
                    tangential,
                    tangential == 0.0 || positive(tangential),
                    "0, or 1e-30 to 1e30 N/m",
                ),
            ]),
        }
        for (key, value) in [("friction", self.friction), ("wall_friction", self.wall_friction)] {
            parameters.push((key, value, value == 0.0 || positive(value), "0, or 1e-30 to 1e30"));
        }
        let e = self.restitution;
        parameters.push(("restitution", e, (1e-3..=1.0).contains(&e), "0.001 to 1"));
        match parameters.into_iter().find(|parameter| !parameter.2) {
            None => Ok(()),
            Some((key, value, _, allowed)) => Err(MaterialError { key, value, allowed }),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn check_names_the_key_and_the_range() {
        let good = Material {
            density: 7850.0,
            stiffness: Stiffness::HertzMindlin { young_modulus: 2e11, poisson_ratio: 0.29 },
            friction: 0.3,
            wall_friction: 0.0,
            restitution: 1.0,
        };
        assert_eq!(good.check(), Ok(()));
        let bad = Material {
            stiffness: Stiffness::HertzMindlin { young_modulus: 2e11, poisson_ratio: 0.6 },
            ..good.clone()
        };
        assert_eq!(bad.check().unwrap_err().to_string(), "material: poisson_ratio = 0.6, allowed: 0 to 0.5");
        let bad = Material { restitution: 0.0, ..good.clone() };
        assert_eq!(bad.check().unwrap_err().key, "restitution");
        let bad = Material { wall_friction: f64::NAN, ..good };
        assert_eq!(bad.check().unwrap_err().key, "wall_friction");
    }
}
