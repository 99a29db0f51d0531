//! Conductances of heat between two spheres of the same material: through their contact, and through the gas around it.
//!
//! Through a contact of radius a, of two bodies that are large against it: 2 k_s a (Carslaw & Jaeger, Conduction of Heat in
//! Solids, 1959, section 8.2). a follows from the force, a = (3 F R*/(4 E*))^(1/3), with the real stiffness of the
//! material. A simulation may be softer than the material to save time. The forces of a bed at rest hardly depend on
//! that, but its contacts are then too large, as E^(-1/3). (A correction by E^(-1/5), which is that of an impact of given
//! energy, leaves them too large.)
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
//! Gas counts between all pairs whose centres are nearer than [`NEAR`] times the sum of their radii. The farther ones would be
//! counted twice, since heat does not go straight between them. The number is calibrated on solutions of the heat
//! equation in packings of 100 spheres at κ = 1500, where the sum is within 4 %. Below κ of about 30 the heat spreads far
//! from straight lines, and the law is 26 to 34 % too low at κ = 10: see [`LEAST_RATIO`].

use msdd_engine::grid::pairs_within_cell;
use msdd_engine::message::number;
use msdd_spheres::space::{length, minus};
use msdd_spheres::{Boundary, Partner, Simulation};
use std::f64::consts::PI;

/// Distance of the centres over the sum of the radii, up to which gas conducts between two spheres.
pub const NEAR: f64 = 1.18;
/// k_s/k_g below which the law for gas does not hold.
pub const LEAST_RATIO: f64 = 30.0;

/// The material of the spheres, as far as heat is concerned.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Solid {
    /// k_s \[W/(m K)\].
    pub conductivity: f64,
    /// E* \[Pa\] of two spheres, of the real material.
    pub effective_modulus: f64,
}

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

/// A property for which the laws have no meaning.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[error("heat: {key} = {}, allowed: {allowed}", number(*value))]
pub struct PropertyError {
    pub key: &'static str,
    pub value: f64,
    pub allowed: &'static str,
}

/// The first property outside its range.
fn first_bad(properties: &[(&'static str, f64, bool, &'static str)]) -> Result<(), PropertyError> {
    match properties.iter().find(|property| !property.2) {
        None => Ok(()),
        Some(&(key, value, _, allowed)) => Err(PropertyError { key, value, allowed }),
    }
}

fn positive(value: f64) -> bool {
    (1e-30..=1e30).contains(&value)
}

impl Solid {
    /// # Errors
    /// The first property outside its range.
    pub fn check(&self) -> Result<(), PropertyError> {
        let modulus = self.effective_modulus;
        first_bad(&[
            ("solid conductivity", self.conductivity, positive(self.conductivity), "1e-30 to 1e30 W/(m K)"),
            ("effective_modulus", modulus, positive(modulus), "1e-30 to 1e30 Pa"),
        ])
    }
}

impl Gas {
    /// Checks the gas for use between spheres of `solid`.
    ///
    /// # Errors
    /// The first property outside its range; a gas that conducts too well for the law.
    pub fn check(&self, solid: &Solid) -> Result<(), PropertyError> {
        let ratio = solid.conductivity / self.conductivity;
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
}

/// a = (3 F R*/(4 E*))^(1/3) \[m\].
pub fn contact_radius(force: f64, effective_radius: f64, effective_modulus: f64) -> f64 {
    libm::cbrt(0.75 * force * effective_radius / effective_modulus)
}

/// π k_g/2 (D ln(D/h) − 2 R) \[W/K\], D = 2 R + h; `distance` is h \[m\].
pub fn gas_conductance(conductivity: f64, radius: f64, distance: f64) -> f64 {
    let between = 2.0 * radius + distance;
    0.5 * PI * conductivity * (between * libm::log(between / distance) - 2.0 * radius)
}

/// A conductance between two spheres.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Link {
    pub i: usize,
    pub j: usize,
    /// From the centre of i to that of (the image of) j \[m\].
    pub branch: [f64; 3],
    /// \[W/K\]
    pub conductance: f64,
}

/// 2 k_s a of all contacts between spheres.
pub fn contact_links(simulation: &Simulation, solid: &Solid) -> Vec<Link> {
    let mut links = Vec::new();
    simulation.for_each_contact(|contact| {
        if let Partner::Sphere(i) = contact.i {
            let radius =
                contact_radius(contact.normal_force, contact.effective_radius, solid.effective_modulus);
            let conductance = 2.0 * solid.conductivity * radius;
            links.push(Link { i, j: contact.j, branch: contact.branch, conductance });
        }
    });
    links
}

/// Gas between all near pairs of a periodic box, of conductivity `conductivity` \[W/(m K)\]; none between walls.
/// `least_distance` is the part of h without the gap \[m\] (see [`Gas::least_distance`]) for a radius; two spheres of
/// unequal radii count as two of the radius 2 R*.
pub fn gas_links(
    simulation: &Simulation,
    conductivity: f64,
    least_distance: impl Fn(f64) -> f64,
) -> Vec<Link> {
    let Boundary::Periodic(cell) = &simulation.boundary else { return Vec::new() };
    let spheres = &simulation.spheres;
    let largest = spheres.iter().fold(0.0f64, |largest, sphere| largest.max(sphere.radius));
    let (rows, ghosts) = pairs_within_cell(spheres, 2.0 * (NEAR - 1.0) * largest, &cell.lattice);
    let mut links = Vec::new();
    for (&i, &j) in rows.i().iter().zip(rows.j()) {
        let (i, j) = (i as usize, j as usize);
        let (j, shift) = match j.checked_sub(spheres.len()) {
            None => (j, [0; 3]),
            Some(ghost) => (ghosts[ghost].owner as usize, ghosts[ghost].shift),
        };
        let (a, b) = (&spheres[i], cell.lattice.image(&spheres[j], shift));
        let branch = minus(b.position, a.position);
        let (distance, reach) = (length(branch), a.radius + b.radius);
        if distance < NEAR * reach {
            let radius = 2.0 * a.radius * b.radius / reach;
            let gap = (distance - reach).max(0.0);
            let conductance = gas_conductance(conductivity, radius, gap + least_distance(radius));
            links.push(Link { i, j, branch, conductance });
        }
    }
    links
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
        let steel = Solid { conductivity: 42.0, effective_modulus: 1.1e11 };
        assert_eq!(air.check(&steel), Ok(()));
        let refused = |gas: Gas| gas.check(&steel).unwrap_err().to_string();
        let text = refused(Gas { accommodation: 0.0, ..air });
        assert_eq!(text, "heat: accommodation = 0, allowed: 0 < accommodation <= 1");
        assert!(refused(Gas { conductivity: 4.2, ..air }).contains("at least 30"));
    }
}
