//! Averages over the inner part of a bed between two heights.

use crate::mobilised::mobilisation;
use msdd_spheres::space::{dot, plus};
use msdd_spheres::{Contact, Partner, Simulation};
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Packing, pack};
    use msdd_spheres::{Material, Stiffness};

    #[test]
    fn the_fabric_of_a_box_that_was_closed_alike_has_no_direction() {
        let material = Material {
            density: 1.0,
            stiffness: Stiffness::HertzMindlin { young_modulus: 2.0, poisson_ratio: 0.25 },
            friction: 0.3,
            wall_friction: 0.0,
            restitution: 0.3,
        };
        let packing =
            Packing { spheres: 100, seed: 5, diameter: 1.0, material, pressure: 1e-4, steps: 200_000 };
        let simulation = pack(&packing).unwrap().simulation;
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
