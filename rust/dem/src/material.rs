//! Parameters of the grains.

use serde::{Deserialize, Serialize};

/// Mechanical parameters of the grains, one material for all (paper, Table 2).
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Material {
    /// ρ [kg/m³], of the grains.
    pub density: f64,
    /// E \[Pa\].
    pub young_modulus: f64,
    /// ν [-]: tangential over normal contact stiffness.
    pub stiffness_ratio: f64,
    /// φ \[rad\]: contacts slide at |f_t| = f_n tan φ.
    pub friction_angle: f64,
    /// Wall stiffness over E r [-]. The paper gives no value; 1 is that of the authors' public code (2 would be the
    /// limit r₂ → ∞ of the law for pairs).
    pub wall_stiffness_factor: f64,
    /// μ [-]: damping force −μ |f_c| v/|v|.
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
    pub allowed: &'static str,
}

impl Material {
    /// The parameters: name, value, whether the contact law has a meaning for it, and the values for which it has.
    pub fn parameters(&self) -> [(&'static str, f64, bool, &'static str); 6] {
        // Within these bounds products of several parameters stay finite.
        let positive = |v: f64| (1e-30..=1e30).contains(&v);
        let quarter_turn = |v: f64| (0.0..std::f64::consts::FRAC_PI_2).contains(&v);
        [
            ("density", self.density, positive(self.density), "1e-30 to 1e30 kg/m3"),
            ("young_modulus", self.young_modulus, positive(self.young_modulus), "1e-30 to 1e30 Pa"),
            ("stiffness_ratio", self.stiffness_ratio, (0.0..=1.0).contains(&self.stiffness_ratio), "0 to 1"),
            (
                "friction_angle",
                self.friction_angle,
                quarter_turn(self.friction_angle),
                "0 <= angle < pi/2 rad",
            ),
            (
                "wall_stiffness_factor",
                self.wall_stiffness_factor,
                positive(self.wall_stiffness_factor),
                "1e-30 to 1e30",
            ),
            ("damping", self.damping, (0.0..1.0).contains(&self.damping), "0 <= damping < 1"),
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
