//! Parameters of the grains.

use msdd_engine::message::range;
use serde::{Deserialize, Serialize};

/// Mechanical parameters of the grains, one material for all (paper, Table 2).
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Material {
    /// Density of the grains [kg/m³]. Allowed: `POSITIVE`.
    pub density: f64,
    /// Young's modulus E \[Pa\]. Allowed: `POSITIVE`.
    pub young_modulus: f64,
    /// Tangential over normal stiffness of a contact. Allowed: `RATIOS`.
    pub stiffness_ratio: f64,
    /// Angle of friction φ between grains: contacts slide at |f_t| = f_n tan φ \[rad\]. Allowed: `ANGLES`.
    pub friction_angle: f64,
    /// Stiffness of a contact with a wall, over E times the radius of the grain. The paper gives no value; 1 is that of the
    /// authors' public code (2 would be the limit of the law for pairs with r₂ → ∞). Allowed: `POSITIVE`.
    pub wall_stiffness_factor: f64,
    /// Damping force of a grain over the force on it. Allowed: `DAMPINGS`.
    pub damping: f64,
}

impl Default for Material {
    /// Table 2 of the paper.
    fn default() -> Self {
        Self {
            density: 3000.0,
            young_modulus: 1.0e7,
            stiffness_ratio: 0.8,
            friction_angle: 0.5,
            wall_stiffness_factor: 1.0,
            damping: 0.1,
        }
    }
}

/// A material parameter outside its allowed range.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[error("material: {key} = {value}, allowed: {allowed}", value = msdd_engine::message::number(*value))]
pub struct MaterialError {
    pub key: &'static str,
    pub value: f64,
    pub allowed: String,
}

/// What parameters may be. Within these bounds products of several stay finite.
const POSITIVE: [f64; 2] = [1e-30, 1e30];
const RATIOS: [f64; 2] = [0.0, 1.0];
const ANGLES: &str = "0 <= angle < pi/2 rad";
const DAMPINGS: &str = "0 <= damping < 1";

impl Material {
    /// The parameters: name, value, whether the contact law has a meaning for it, and the values for which it has.
    pub fn parameters(&self) -> [(&'static str, f64, bool, String); 6] {
        let ranged = |key, value, allowed: [f64; 2], unit: &str| {
            (key, value, (allowed[0]..=allowed[1]).contains(&value), range(allowed) + unit)
        };
        let quarter_turn = (0.0..std::f64::consts::FRAC_PI_2).contains(&self.friction_angle);
        let damped = (0.0..1.0).contains(&self.damping);
        [
            ranged("density", self.density, POSITIVE, " kg/m3"),
            ranged("young_modulus", self.young_modulus, POSITIVE, " Pa"),
            ranged("stiffness_ratio", self.stiffness_ratio, RATIOS, ""),
            ("friction_angle", self.friction_angle, quarter_turn, ANGLES.to_string()),
            ranged("wall_stiffness_factor", self.wall_stiffness_factor, POSITIVE, ""),
            ("damping", self.damping, damped, DAMPINGS.to_string()),
        ]
    }

    /// Refuses values for which the contact law has no meaning; names the first such key.
    pub fn check(&self) -> Result<(), MaterialError> {
        match self.parameters().into_iter().find(|parameter| !parameter.2) {
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
        assert_eq!(Material::default().check(), Ok(()));
        let bad = Material { young_modulus: f64::NAN, ..Material::default() };
        assert!(bad.check().unwrap_err().to_string().starts_with("material: young_modulus = NaN"));
        let bad = Material { damping: 1.0, ..Material::default() };
        assert_eq!(bad.check().unwrap_err().key, "damping");
    }
}
