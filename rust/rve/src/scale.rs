//! Scaling of wall speeds and strain rates from the paper's grains to grains of any size, such that they are equally
//! slow relative to the grains' own motion.
//!
//! A contact oscillates with the period √(ρ r/E), and a disturbance travels through the grains at the speed √(E r/ρ),
//! both up to the same factors for all grains. A speed or rate that is given for the paper's grains is therefore
//! multiplied by the ratio of these quantities to those of the paper's grains. Without this, walls at 0.03 m/s would
//! throw grains of 10 µm together rather than press them.

use crate::Material;

/// Mean radius of the paper's grains, for which speeds and rates are given [m].
const RADIUS: f64 = 5e-3;

/// Factor of speeds [-] for grains of the mean radius `radius` \[m\].
pub fn speed_factor(material: &Material, radius: f64) -> f64 {
    factor(material, radius, |m, r| m.young_modulus * r / m.density)
}

/// Factor of strain rates and of the drag [-] for grains of the mean radius `radius` \[m\].
pub fn rate_factor(material: &Material, radius: f64) -> f64 {
    factor(material, radius, |m, r| m.young_modulus / (m.density * r))
}

/// Root of a quantity over that of the paper's grains.
fn factor(material: &Material, radius: f64, squared: fn(&Material, f64) -> f64) -> f64 {
    root_as_power_of_two(squared(material, radius) / squared(&Material::default(), RADIUS))
}

/// The power of two nearest to √`square`. Rounding the factor by up to √2 is harmless, since the rates are slow enough.
/// Powers of two change no digit: grains about as large as the paper's keep the factor 1, and an assembly four times as
/// large gives exactly scaled results.
fn root_as_power_of_two(square: f64) -> f64 {
    let exponent = (0.5 * libm::log2(square)).round();
    libm::exp2(exponent)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn factors_follow_radius_stiffness_and_density() {
        let paper = Material::default();
        let of =
            |material: &Material, radius| (speed_factor(material, radius), rate_factor(material, radius));
        for radius in [3e-3, 5e-3, 9e-3] {
            assert_eq!(of(&paper, radius), (1.0, 1.0), "{radius}");
        }
        assert_eq!(of(&paper, 5e-3 / 1024.0), (1.0 / 32.0, 32.0));
        assert_eq!(of(&paper, 5e-3 * 16.0), (4.0, 0.25));
        let hard = Material { young_modulus: 64.0 * paper.young_modulus, ..paper.clone() };
        assert_eq!(of(&hard, 5e-3), (8.0, 8.0));
        let heavy = Material { density: 4.0 * paper.density, ..paper };
        assert_eq!(of(&heavy, 5e-3), (0.5, 0.5));
    }

    #[test]
    fn factors_stay_finite_at_the_ends_of_what_is_allowed() {
        let far = |young_modulus, density| Material { young_modulus, density, ..Material::default() };
        for (material, radius) in [(far(1e30, 1e-30), 1e30), (far(1e-30, 1e30), 1e-30)] {
            for factor in [speed_factor(&material, radius), rate_factor(&material, radius)] {
                assert!(factor.is_finite() && factor > 0.0, "{factor}");
            }
        }
    }
}
