//! Averages over the inner part of a bed between two heights.

use crate::mobilised::mobilisation;
use msdd_spheres::space::{dot, plus};
use msdd_spheres::{Contact, Partner, Simulation, Sphere};
use std::f64::consts::PI;

/// The part of a bed between two heights \[m\]; in a cylinder, whose axis is the z axis, within a radius \[m\] of the axis.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Region {
    pub heights: [f64; 2],
    pub radius: Option<f64>,
    /// Of the bed between walls across x and y, or without sides \[m²\]; not used with a radius.
    pub area: f64,
}

impl Region {
    /// \[m³\]
    pub fn volume(&self) -> f64 {
        let area = self.radius.map_or(self.area, |radius| PI * radius * radius);
        area * (self.heights[1] - self.heights[0])
    }

    pub fn holds(&self, [x, y, z]: [f64; 3]) -> bool {
        (self.heights[0]..self.heights[1]).contains(&z)
            && self.radius.is_none_or(|radius| x * x + y * y < radius * radius)
    }

    /// How much of the friction is mobilised there, see [`mobilisation`] \[-\].
    pub fn mobilisation(&self, simulation: &Simulation) -> f64 {
        mobilisation(simulation, |middle| self.holds(middle))
    }

    /// Mean normal stresses \[Pa\], compression positive: along x, y, z, in a cylinder along the radius, around the axis, along z. Love's stress of the contacts between spheres whose
    /// middle lies in the region.
    pub fn stress(&self, simulation: &Simulation) -> [f64; 3] {
        let sum = self.over_contacts(simulation, |contact, axis| {
            dot(contact.force(), axis) * dot(contact.branch, axis)
        });
        sum.map(|sum| sum / self.volume())
    }

    /// The fabric \[-\]: means of the squares of the normals of the same contacts, along the same axes; their sum is 1. NaN without
    /// contacts.
    pub fn fabric(&self, simulation: &Simulation) -> [f64; 3] {
        let sum = self.over_contacts(simulation, |contact, axis| dot(contact.normal, axis).powi(2));
        sum.map(|part| part / sum.iter().sum::<f64>())
    }

    /// Strain of the bed since its spheres were at `before` \[-\], extension positive: along x, y, z; in a cylinder the mean across its axis,
    /// twice, and along it. Along each axis it is the slope of a straight line through the displacements of the spheres that began
    /// in the region, over where they began. In a bed without sides the strain across z is that of its base since it had the lengths
    /// `base` \[m\].
    pub fn strain(&self, simulation: &Simulation, before: &[[f64; 3]], base: Option<[f64; 2]>) -> [f64; 3] {
        let inside = || simulation.spheres.iter().zip(before).filter(|(_, begin)| self.holds(**begin));
        let count = inside().count() as f64;
        let along = |axis: usize| {
            let moved = |(sphere, begin): (&Sphere, &[f64; 3])| sphere.position[axis] - begin[axis];
            let middle = inside().map(|(_, begin)| begin[axis]).sum::<f64>() / count;
            let mean = inside().map(moved).sum::<f64>() / count;
            let (both, square) = inside().fold((0.0, 0.0), |(both, square), one| {
                let from = one.1[axis] - middle;
                (both + from * (moved(one) - mean), square + from * from)
            });
            both / square
        };
        let lengths = base.zip(lengths(simulation));
        let across =
            |axis: usize| lengths.map_or_else(|| along(axis), |(then, now)| now[axis] / then[axis] - 1.0);
        match self.radius {
            None => [across(0), across(1), along(2)],
            Some(_) => {
                let mean = 0.5 * (across(0) + across(1));
                [mean, mean, along(2)]
            }
        }
    }

    /// Sums over the contacts between spheres whose middle lies in the region, for each of the axes.
    fn over_contacts(&self, simulation: &Simulation, along: impl Fn(&Contact, [f64; 3]) -> f64) -> [f64; 3] {
        let mut sum = [0.0; 3];
        simulation.for_each_contact(|contact| {
            let Partner::Sphere(i) = contact.i else { return };
            let middle = plus(simulation.spheres[i].position, 0.5, contact.branch);
            if self.holds(middle) {
                for (sum, axis) in sum.iter_mut().zip(self.axes(middle)) {
                    *sum += along(&contact, axis);
                }
            }
        });
        sum
    }

    /// x, y, z; in a cylinder along the radius, around the axis, along z.
    fn axes(&self, [x, y, _]: [f64; 3]) -> [[f64; 3]; 3] {
        match self.radius {
            None => [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]],
            Some(_) => {
                let off = libm::hypot(x, y).max(f64::MIN_POSITIVE);
                let (c, s) = (x / off, y / off);
                [[c, s, 0.0], [-s, c, 0.0], [0.0, 0.0, 1.0]]
            }
        }
    }
}

/// Lengths of the base of a bed without sides \[m\].
pub fn lengths(simulation: &Simulation) -> Option<[f64; 2]> {
    simulation.boundary.cell().map(|cell| [0, 1].map(|k| cell.lattice.edges[k][k]))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Packing, pack};
    use msdd_spheres::{Material, Stiffness};

    fn packed() -> Simulation {
        let material = Material {
            density: 1.0,
            stiffness: Stiffness::HertzMindlin { young_modulus: 2.0, poisson_ratio: 0.25 },
            friction: 0.3,
            wall_friction: 0.0,
            restitution: 0.3,
        };
        let packing = Packing {
            spheres: 100,
            seed: 5,
            diameter: 1.0,
            sizes: None,
            material,
            pressure: 1e-4,
            steps: 200_000,
        };
        pack(&packing).unwrap().simulation
    }

    #[test]
    fn the_strain_is_that_of_spheres_that_move_alike() {
        let mut simulation = packed();
        let before: Vec<[f64; 3]> = simulation.spheres.iter().map(|sphere| sphere.position).collect();
        let strain = [2e-4, -3e-4, 5e-4];
        for sphere in &mut simulation.spheres {
            sphere.position = std::array::from_fn(|k| 0.1 + (1.0 + strain[k]) * sphere.position[k]);
        }
        let region = |radius| Region { heights: [-1e3, 1e3], radius, area: 1.0 };
        let near = |found: [f64; 3], wanted: [f64; 3]| {
            assert!(found.iter().zip(wanted).all(|(a, b)| (a - b).abs() < 1e-12), "{found:?}, {wanted:?}");
        };
        near(region(None).strain(&simulation, &before, None), strain);
        let base = lengths(&simulation).map(|base| [base[0] / 1.001, base[1] / 0.998]);
        near(region(None).strain(&simulation, &before, base), [1e-3, -2e-3, 5e-4]);
        near(region(Some(1e3)).strain(&simulation, &before, None), [-5e-5, -5e-5, 5e-4]);
    }

    #[test]
    fn the_fabric_of_a_box_that_was_closed_alike_has_no_direction() {
        let simulation = packed();
        for radius in [None, Some(10.0)] {
            let all = Region { heights: [-1e3, 1e3], radius, area: 1.0 };
            let fabric = all.fabric(&simulation);
            assert!((fabric.iter().sum::<f64>() - 1.0).abs() < 1e-12);
            assert!(fabric.iter().all(|part| (part - 1.0 / 3.0).abs() < 0.06), "{fabric:?}");
        }
        let none = Region { heights: [1e3, 2e3], radius: None, area: 1.0 };
        assert!(none.fabric(&simulation).iter().all(|part| part.is_nan()));
    }
}
