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
//! Below κ of about 30 the heat spreads far from straight lines, and the law is 26 to 34 % too low at κ = 10: from 60 down
//! [`crate::effective`] takes its place. Between which pairs gas counts is said in [`crate::conductances`].
//!
//! What passes between a plate and a bed depends on which spheres see it: see [`crate::plate_view_areas`]. The closed form here is that of
//! [`crate::wall`], for a full layer of spheres that touch a wall. The plate is the plane of symmetry between a sphere and its mirror image, whose gap is twice
//! as wide and in which heat jumps twice as far: so G of a sphere and a plate is twice that of the pair, with h of the pair at the
//! double gap and the double M. That counts what goes along straight lines from the facing hemisphere; 0.56 R is added to
//! the bracket for what reaches the plate from farther up and between the spheres, by solutions of the heat equation in
//! a slab of spheres at κ = 1500. It is divided by 1 + M/R, since all heat through a rarefied gas is limited by the jump.

use std::f64::consts::PI;

/// Part of the heat beyond the edge of the smaller of two unequal spheres that the pair of equal ones has too much.
const BEYOND: f64 = 0.75;
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

/// (1 + x) ln(1 + x) − x, also where x is so small that nothing would be left of the difference.
fn lines(x: f64) -> f64 {
    if x > 0.01 {
        return (1.0 + x) * libm::log1p(x) - x;
    }
    x * x * (0.5 - x * (1.0 / 6.0 - x * (1.0 / 12.0 - x * (0.05 - x * (1.0 / 30.0 - x / 42.0)))))
}

/// π k_g/2 (D ln(D/h) − 2 R) \[W/K\], D = 2 R + h; `distance` is h \[m\].
pub fn gas_conductance(conductivity: f64, radius: f64, distance: f64) -> f64 {
    0.5 * PI * conductivity * distance * lines(2.0 * radius / distance)
}

/// The same between spheres of radii r₁ < r₂: [`gas_conductance`] of equal spheres of `radius` 2 R* \[m\], which is exact near a contact, less
/// ¾ of what passes there beyond the edge of the smaller sphere, π k_g (D/2 ln(D/(D − 2 s)) − s) with s² = (2 R*)² − r₁². `smaller` is
/// r₁/(2 R*). Against random walks in packings with radii 5 and 10 % smaller this changes the error of the sum over pairs by 1 % for diameters
/// that differ by ±40 % and for 1:2; without the last term it would by 5 and 11 % (`sizes gas` of the examples of msdd-rve).
pub fn unequal_conductance(conductivity: f64, radius: f64, smaller: f64, distance: f64) -> f64 {
    let equal = gas_conductance(conductivity, radius, distance);
    let (s, both) = (radius * (1.0 - smaller * smaller).max(0.0).sqrt(), 2.0 * radius + distance);
    equal - BEYOND * PI * conductivity * (0.5 * both * -libm::log1p(-2.0 * s / both) - s)
}

/// 2 π k_g (D ln(D/h) − R + 0.56 R/(1 + M/R)) \[W/K\], D = R + h, between a sphere and a plate; `distance` is h \[m\], `jump` M \[m\].
pub fn plate_conductance(conductivity: f64, radius: f64, distance: f64, jump: f64) -> f64 {
    let around = AROUND * radius / (1.0 + jump / radius);
    2.0 * PI * conductivity * (distance * lines(radius / distance) + around)
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

    /// Equal spheres have the bytes of [`gas_conductance`]. Of 1:2, what is taken off is ¾ of the sum over the rays beyond the smaller
    /// sphere; near a contact both laws rise equally as h falls.
    #[test]
    fn unequal_spheres_lose_rays_beyond_the_smaller_one() {
        let (radius, distance) = (4e-3, 2e-5);
        assert_eq!(
            unequal_conductance(0.026, radius, 1.0, distance),
            gas_conductance(0.026, radius, distance)
        );
        let edge: f64 = 3e-3;
        let most = (radius * radius - edge * edge).sqrt();
        let count = 100_000;
        let beyond: f64 = (0..count)
            .map(|k| {
                let s = most * (f64::from(k) + 0.5) / f64::from(count);
                2.0 * PI * 0.026 * s / (distance + 2.0 * (radius - s)) * most / f64::from(count)
            })
            .sum();
        let lost = |h: f64| gas_conductance(0.026, radius, h) - unequal_conductance(0.026, radius, 0.75, h);
        assert!((lost(distance) / (0.75 * beyond) - 1.0).abs() < 1e-6);
        assert!((lost(1e-9) / lost(1e-7) - 1.0).abs() < 1e-3);
    }

    /// Half of the mirrored pair has twice its conductance; the rest is what goes around.
    #[test]
    fn a_plate_is_a_plane_of_symmetry() {
        let (conductivity, radius, distance) = (0.026, 3e-3, 2e-5);
        let pair = gas_conductance(conductivity, radius, 2.0 * distance);
        let around = 2.0 * PI * conductivity * AROUND * radius;
        let plate = plate_conductance(conductivity, radius, distance, 0.0);
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

    /// A rarefied gas passes k_g/h on each area that is seen from the other side: π R² of a pair. Both laws fall with the pressure.
    #[test]
    fn a_rarefied_gas_conducts_by_the_area_that_is_seen() {
        let (conductivity, radius) = (0.026, 3e-3);
        for over in [1e3, 1e6, 1e12] {
            let distance = over * radius;
            let seen = PI * radius * radius * conductivity / distance;
            let pair = gas_conductance(conductivity, radius, distance);
            assert!((pair / seen - 1.0).abs() < 1.0 / over, "{over}: {pair} {seen}");
            let plate = plate_conductance(conductivity, radius, distance, distance) / seen;
            assert!((plate - 1.0 - 2.0 * AROUND).abs() < 2.0 / over, "{over}: {plate}");
        }
        // The series and the closed form meet.
        let [low, high] = [0.01 - 1e-9, 0.01 + 1e-9].map(|x| lines(x) / (x * x));
        assert!((low / high - 1.0).abs() < 1e-9, "{low} {high}");
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
    }
}
