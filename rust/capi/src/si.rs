//! Dimensionless answers to SI units: the one place.

use crate::abi::msdd_material;
use crate::status::Failure;
use msdd_surrogate::kernel::Lanes;

/// Checked scales of a material.
pub(crate) struct Si {
    conductivity: f64,
    stress: f64,
}

/// ℓ, the depth over which contact stiffnesses [N/m] become stresses [m].
const DEPTH: f64 = 1.0;

impl Si {
    pub fn new(material: &msdd_material) -> Result<Self, Failure> {
        let &msdd_material { thermal_conductivity, young_modulus, mean_radius, .. } = material;
        check_scale("material.thermal_conductivity", thermal_conductivity, "above 0, to 1e12 W/(m K)", 1e12)?;
        check_scale("material.young_modulus", young_modulus, "above 0, to 1e15 Pa", 1e15)?;
        check_scale("material.mean_radius", mean_radius, "above 0, to 1e6 m", 1e6)?;
        Ok(Self { conductivity: thermal_conductivity, stress: young_modulus * mean_radius / DEPTH })
    }

    /// K = k K̃ [W/(m K)].
    pub fn conductivity(&self, dimensionless: Lanes) -> Lanes {
        dimensionless.map(|value| self.conductivity * value)
    }

    /// σ̃ = σ ℓ/(E r), initial radius [-].
    pub fn reduced(&self, stress: f64) -> f64 {
        stress / self.stress
    }

    /// σ = σ̃ E r̄ / ℓ [Pa] with the current mean radius r̄ = r (1 + α (T − T⁰)).
    pub fn stress(&self, dimensionless: Lanes, total_thermal_strain: &Lanes) -> Lanes {
        std::array::from_fn(|lane| dimensionless[lane] * (self.stress * (1.0 + total_thermal_strain[lane])))
    }
}

fn check_scale(name: &str, value: f64, allowed: &str, largest: f64) -> Result<(), Failure> {
    if value > 0.0 && value <= largest { Ok(()) } else { Err(Failure::argument(name, value, allowed)) }
}
