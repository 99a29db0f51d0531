//! Conductances of heat between the spheres of a simulation: through contacts, and through the gas between near pairs.
//!
//! Gas counts between all pairs whose centres are nearer than [`NEAR`] times the sum of their radii. The farther ones would be
//! counted twice, since heat does not go straight between them. The number is calibrated on solutions of the heat
//! equation in packings of 100 spheres at κ = 1500, where the sum is within 4 %. Below κ of about 30 the heat spreads far
//! from straight lines, and the law is 26 to 34 % too low at κ = 10: see [`crate::effective`].

use crate::gas::unequal_conductance;
use crate::solid::Solid;
use msdd_engine::grid::{pairs_within, pairs_within_cell};
use msdd_engine::lattice::Image;
use msdd_spheres::space::{length, minus};
use msdd_spheres::{Partner, Simulation};

/// Distance of the centres over the sum of the radii, up to which gas conducts between two spheres.
pub const NEAR: f64 = 1.18;

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

/// Two spheres between which gas conducts.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Near {
    pub i: usize,
    pub j: usize,
    /// From the centre of i to that of (the image of) j \[m\].
    pub branch: [f64; 3],
    /// 2 R* \[m\]: that of two equal spheres which count as these two.
    pub radius: f64,
    /// The smaller radius over 2 R*, by the masses: exactly 1 of equal spheres, whatever their temperatures.
    pub smaller: f64,
    /// Distance of the surfaces \[m\], 0 if they touch.
    pub gap: f64,
}

/// All contacts between spheres.
pub fn contact_links(simulation: &Simulation, solid: &Solid) -> Vec<Link> {
    let mut links = Vec::new();
    simulation.for_each_contact(|contact| {
        if let Partner::Sphere(i) = contact.i {
            let size = solid.contact_size(contact.normal_force, contact.effective_radius);
            let conductance = solid.conductivity * size;
            links.push(Link { i, j: contact.j, branch: contact.branch, conductance });
        }
    });
    links
}

/// All pairs between which gas conducts.
pub fn near_pairs(simulation: &Simulation) -> Vec<Near> {
    let spheres = &simulation.spheres;
    let largest = spheres.iter().fold(0.0f64, |largest, sphere| largest.max(sphere.radius));
    let skin = 2.0 * (NEAR - 1.0) * largest;
    let (rows, ghosts) = match simulation.cell() {
        Some(cell) => pairs_within_cell(spheres, skin, &cell.lattice, false),
        None => (pairs_within(spheres, skin), Vec::new()),
    };
    let mut pairs = Vec::new();
    for (&i, &j) in rows.i().iter().zip(rows.j()) {
        let (i, j) = (i as usize, j as usize);
        let (a, mut b, j) = match j.checked_sub(spheres.len()) {
            None => (spheres[i], spheres[j], j),
            Some(ghost) => {
                let Image { owner, shift }: Image<3> = ghosts[ghost];
                let b = spheres[owner as usize];
                let b = simulation.cell().map_or(b, |cell| cell.lattice.image(&b, shift));
                (spheres[i], b, owner as usize)
            }
        };
        b.position = minus(b.position, a.position);
        let (distance, reach) = (length(b.position), a.radius + b.radius);
        if distance < NEAR * reach {
            let (radius, gap) = (2.0 * a.radius * b.radius / reach, (distance - reach).max(0.0));
            let ratio = a.mass.min(b.mass) / a.mass.max(b.mass);
            let smaller = if ratio == 1.0 { 1.0 } else { 0.5 * (1.0 + libm::cbrt(ratio)) };
            pairs.push(Near { i, j, branch: b.position, radius, smaller, gap });
        }
    }
    pairs
}

/// Gas of conductivity `conductivity` \[W/(m K)\] between near pairs. `least_distance` is the part of h without the gap
/// \[m\] (see [`crate::gas::Gas::least_distance`]) for a radius.
pub fn gas_links(near: &[Near], conductivity: f64, least_distance: impl Fn(f64) -> f64) -> Vec<Link> {
    let link = |&Near { i, j, branch, radius, smaller, gap }: &Near| {
        let conductance = unequal_conductance(conductivity, radius, smaller, gap + least_distance(radius));
        Link { i, j, branch, conductance }
    };
    near.iter().map(link).collect()
}
