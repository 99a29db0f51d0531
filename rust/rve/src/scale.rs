//! How fast walls close and strains grow for grains of any size: as fast as the paper's, measured by the grains' own motion.
//!
//! A contact swings with the period √(ρ r/E) and carries a push at the speed √(E r/ρ), both up to factors that are the same
//! for all. A speed or a rate given for the grains of the paper is therefore multiplied by the ratio of these to the
//! paper's: at 0.03 m/s grains of 10 µm are thrown together rather than pressed.

use crate::Material;

/// The grains for which speeds and rates are given [m].
const RADIUS: f64 = 5e-3;

/// Factor of speeds [-] for grains of the mean radius `radius` [m].
pub(crate) fn speed_factor(material: &Material, radius: f64) -> f64 {
    let paper = Material::default();
    let squared = |m: &Material, r: f64| m.young_modulus * r / m.density;
    root_as_power_of_two(squared(material, radius) / squared(&paper, RADIUS))
}

/// Factor of strain rates and of the drag [-] for grains of the mean radius `radius` [m].
pub(crate) fn rate_factor(material: &Material, radius: f64) -> f64 {
    let paper = Material::default();
    let squared = |m: &Material, r: f64| m.young_modulus / (m.density * r);
    root_as_power_of_two(squared(material, radius) / squared(&paper, RADIUS))
}

/// The power of two next to √`square`. What is slow enough has room for a factor of √2, and powers of two keep every bit:
/// those of grains about as large as the paper's, and those of an assembly that is four times as large.
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
