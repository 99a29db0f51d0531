//! Conversion of dimensionless results to SI units. No other file converts.

use crate::abi::msdd_grains;
use crate::grains::Grains;
use crate::status::Failure;
use msdd_surrogate::kernel::Lanes;

/// Checked scales of a material.
pub(crate) struct Si {
    conductivity: f64,
    stress: f64,
}

/// ℓ, the depth over which contact stiffnesses [N/m] become stresses [m].
const DEPTH: f64 = 1.0;
/// Largest stress that a caller may give [Pa]: above any real one, and far from overflow.
pub(crate) const LARGEST_STRESS: f64 = 1e30;

impl Si {
    /// Checks the scales against the ranges that materials can have. Within these, K, E r and the stresses of any state
    /// are finite and above zero.
    pub fn new(grains: &Grains) -> Result<Self, Failure> {
        let msdd_grains { conductivity, young_modulus, radius, .. } = grains.numbers;
        check_scale("material.conductivity", conductivity, (1e-12, 1e12, "1e-12 to 1e12 W/(m K)"))?;
        check_scale("material.young_modulus", young_modulus, (1e-9, 1e15, "1e-9 to 1e15 Pa"))?;
        check_scale("material.radius", radius, (1e-12, 1e6, "1e-12 to 1e6 m"))?;
        Ok(Self { conductivity, stress: young_modulus * radius / DEPTH })
    }

    /// K = k K̃ [W/(m K)].
    pub fn conductivity(&self, dimensionless: Lanes) -> Lanes {
        dimensionless.map(|value| self.conductivity * value)
    }

    /// K/k; finite for K up to [`LARGEST_STRESS`].
    pub fn of_grains(&self, conductivity: f64) -> f64 {
        conductivity / self.conductivity
    }

    /// Reduced stress σ̃ = σ ℓ/(E r) with the initial radius r [-]; finite for |σ| up to [`LARGEST_STRESS`].
    pub fn reduced(&self, stress: f64) -> f64 {
        stress / self.stress
    }

    /// σ = σ̃ E r̄ / ℓ [Pa] with the current mean radius r̄ = r (1 + α (T − T⁰)). Limited to the largest floating-point
    /// number, so that a state far outside of every trained range does not give infinity.
    pub fn stress(&self, dimensionless: Lanes, total_thermal_strain: &Lanes) -> Lanes {
        let stress = |lane: usize| dimensionless[lane] * (self.stress * (1.0 + total_thermal_strain[lane]));
        std::array::from_fn(|lane| stress(lane).clamp(f64::MIN, f64::MAX))
    }
}

/// Refuses a scale outside of its range. `allowed`: the two ends of the range, and its text for the message.
fn check_scale(name: &str, value: f64, allowed: (f64, f64, &str)) -> Result<(), Failure> {
    let (low, high, text) = allowed;
    if (low..=high).contains(&value) { Ok(()) } else { Err(Failure::number(name, value, text)) }
}
