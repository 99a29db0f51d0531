//! Heat through the gas between two spheres, and between a sphere and a plate.
//!
//! Through the gas between two spheres of radius R, along straight lines between the facing hemispheres whose distance on
//! the axis is h: G = π k_g/2 (D ln(D/h) − 2 R) with D = 2 R + h. The distance is the effective one,
//! h = gap + M + R/κ² (50 + 9 κ √(M/R)), where κ = k_s/k_g:
//!
//! * M is the jump length of the temperature at both surfaces, M = 2 (2 − α)/α · 2γ/(1 + γ) · Λ/Pr (Kennard, Kinetic Theory
//!   of Gases, 1938, ch. 8), with the accommodation α, the ratio γ of heat capacities, the mean free path Λ, and the Prandtl
//!   number Pr.
//! * The last term is what the heat loses on its way through the solids to a spot with little gas. Without a jump it is the
//!   result of Batchelor & O'Brien (Proc. R. Soc. A 355, 313, 1977: π k_g R (2 ln κ − 3.9), and ln 50 = 3.9); the mixed
//!   term was fitted to numerical solutions of their integral equation with the gap M + r²/R.
//!
//! Below κ of about 30 the heat spreads far from straight lines, and the law is 26 to 34 % too low at κ = 10: see
//! [`LEAST_RATIO`]. Between which pairs gas counts is said in [`crate::links`].
//!
//! A plate of one temperature is the plane of symmetry between a sphere and its mirror image, whose gap is twice as wide and
//! in which heat jumps twice as far: so G of a sphere and a plate is twice that of the pair, with h of the pair at the
//! double gap and the double M. That counts what goes along straight lines from the facing hemisphere; 0.56 R is added to
//! the bracket for what reaches the plate from farther up and between the spheres, by solutions of the heat equation in
//! a slab of spheres at κ = 1500.

use crate::property::{PropertyError, first_bad, positive};
use std::f64::consts::PI;

/// k_s/k_g below which the law for gas does not hold.
pub const LEAST_RATIO: f64 = 30.0;
/// What a plate gains on the integral over straight lines, over R.
const AROUND: f64 = 0.56;

/// The gas between the spheres.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Gas {
    /// k_g \[W/(m K)\].
    pub conductivity: f64,
    /// Λ \[m\].
    pub mean_free_path: f64,
    /// Pr \[-\].
    pub prandtl: f64,
    /// γ = c_p/c_v \[-\].
    pub heat_capacity_ratio: f64,
    /// α \[-\].
    pub accommodation: f64,
}

impl Gas {
    /// Checks the gas for use between spheres of `solid_conductivity` \[W/(m K)\].
    ///
    /// # Errors
    /// The first property outside its range; a gas that conducts too well for the law.
    pub fn check(&self, solid_conductivity: f64) -> Result<(), PropertyError> {
        let ratio = solid_conductivity / self.conductivity;
        let (path, gamma, alpha) = (self.mean_free_path, self.heat_capacity_ratio, self.accommodation);
        first_bad(&[
            ("gas conductivity", self.conductivity, positive(self.conductivity), "1e-30 to 1e30 W/(m K)"),
            ("mean_free_path", path, path == 0.0 || positive(path), "0, or 1e-30 to 1e30 m"),
            ("prandtl", self.prandtl, positive(self.prandtl), "1e-30 to 1e30"),
            ("heat_capacity_ratio", gamma, (1.0..=2.0).contains(&gamma), "1 to 2"),
            ("accommodation", alpha, alpha > 0.0 && alpha <= 1.0, "0 < accommodation <= 1"),
            (
                "solid over gas conductivity",
                ratio,
                ratio >= LEAST_RATIO,
                "at least 30: below, heat goes other ways",
            ),
        ])
    }

    /// M \[m\].
    pub fn jump_length(&self) -> f64 {
        let (alpha, gamma) = (self.accommodation, self.heat_capacity_ratio);
        2.0 * (2.0 - alpha) / alpha * 2.0 * gamma / (1.0 + gamma) * self.mean_free_path / self.prandtl
    }

    /// The part of h that is there even if the spheres touch \[m\], for spheres of radius R \[m\] and k_s \[W/(m K)\].
    pub fn least_distance(&self, radius: f64, solid_conductivity: f64) -> f64 {
        let (jump, ratio) = (self.jump_length(), solid_conductivity / self.conductivity);
        jump + radius / (ratio * ratio) * (50.0 + 9.0 * ratio * (jump / radius).sqrt())
    }

    /// h \[m\] between a sphere and a plate, whose surfaces are `gap` \[m\] apart; see the head of this module.
    pub fn plate_distance(&self, gap: f64, radius: f64, solid_conductivity: f64) -> f64 {
        let (jump, ratio) = (2.0 * self.jump_length(), solid_conductivity / self.conductivity);
        let spreading = radius / (ratio * ratio) * (50.0 + 9.0 * ratio * (jump / radius).sqrt());
        gap.max(0.0) + 0.5 * (jump + spreading)
    }
}

/// π k_g/2 (D ln(D/h) − 2 R) \[W/K\], D = 2 R + h; `distance` is h \[m\].
pub fn gas_conductance(conductivity: f64, radius: f64, distance: f64) -> f64 {
    let between = 2.0 * radius + distance;
    0.5 * PI * conductivity * (between * libm::log(between / distance) - 2.0 * radius)
}

/// 2 π k_g (D ln(D/h) − R + 0.56 R) \[W/K\], D = R + h, between a sphere and a plate; `distance` is h \[m\].
pub fn plate_conductance(conductivity: f64, radius: f64, distance: f64) -> f64 {
    let between = radius + distance;
    let lines = between * libm::log(between / distance) - radius;
    2.0 * PI * conductivity * (lines + AROUND * radius)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The integral over the facing hemispheres, ∫ k_g 2π r dr/(h + 2 (R − √(R² − r²))).
    #[test]
    fn gas_conductance_is_the_integral_over_straight_lines() {
        let (conductivity, radius, distance) = (0.026, 3e-3, 2e-5);
        let count = 200_000;
        let sum: f64 = (0..count)
            .map(|k| {
                // s = √(R² − r²) as the variable: r dr = −s ds.
                let s = radius * (f64::from(k) + 0.5) / f64::from(count);
                2.0 * PI * conductivity * s / (distance + 2.0 * (radius - s)) * radius / f64::from(count)
            })
            .sum();
        assert!((gas_conductance(conductivity, radius, distance) / sum - 1.0).abs() < 1e-5);
    }

    /// Half of the mirrored pair has twice its conductance; the rest is what goes around.
    #[test]
    fn a_plate_is_a_plane_of_symmetry() {
        let (conductivity, radius, distance) = (0.026, 3e-3, 2e-5);
        let pair = gas_conductance(conductivity, radius, 2.0 * distance);
        let around = 2.0 * PI * conductivity * AROUND * radius;
        let plate = plate_conductance(conductivity, radius, distance);
        assert!(((plate - around) / (2.0 * pair) - 1.0).abs() < 1e-12, "{plate} {pair}");
        let air = Gas {
            conductivity,
            mean_free_path: 0.0,
            prandtl: 0.7,
            heat_capacity_ratio: 1.4,
            accommodation: 1.0,
        };
        let least = air.plate_distance(-1.0, radius, 42.0);
        assert!((least / (0.5 * air.least_distance(radius, 42.0)) - 1.0).abs() < 1e-12);
    }

    #[test]
    fn jump_length_of_air_is_about_three_mean_free_paths() {
        let air = Gas {
            conductivity: 0.0257,
            mean_free_path: 68e-9,
            prandtl: 0.71,
            heat_capacity_ratio: 1.4,
            accommodation: 0.9,
        };
        assert!((air.jump_length() / 68e-9 - 2.0 * 1.1 / 0.9 * 2.8 / 2.4 / 0.71).abs() < 1e-12);
        assert_eq!(air.check(42.0), Ok(()));
        let refused = |gas: Gas| gas.check(42.0).unwrap_err().to_string();
        let text = refused(Gas { accommodation: 0.0, ..air });
        assert_eq!(text, "heat: accommodation = 0, allowed: 0 < accommodation <= 1");
        assert!(refused(Gas { conductivity: 4.2, ..air }).contains("at least 30"));
    }
}
