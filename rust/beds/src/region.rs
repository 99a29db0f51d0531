//! Averages over the inner part of a bed between two heights.

use crate::mobilised::mobilisation;
use msdd_spheres::space::{dot, plus};
use msdd_spheres::{Partner, Simulation};
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

    /// Mean normal stresses \[Pa\], compression positive: along x, y, z, in a cylinder along the radius, around the axis, along z. Love's
    /// stress of the contacts between spheres whose middle lies in the region.
    pub fn stress(&self, simulation: &Simulation) -> [f64; 3] {
        let mut sum = [0.0; 3];
        simulation.for_each_contact(|contact| {
            let Partner::Sphere(i) = contact.i else { return };
            let middle = plus(simulation.spheres[i].position, 0.5, contact.branch);
            if !self.holds(middle) {
                return;
            }
            let (force, branch) = (contact.force(), contact.branch);
            let axes = match self.radius {
                None => [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]],
                Some(_) => {
                    let off = libm::hypot(middle[0], middle[1]).max(f64::MIN_POSITIVE);
                    let (c, s) = (middle[0] / off, middle[1] / off);
                    [[c, s, 0.0], [-s, c, 0.0], [0.0, 0.0, 1.0]]
                }
            };
            for (sum, axis) in sum.iter_mut().zip(axes) {
                *sum += dot(force, axis) * dot(branch, axis);
            }
        });
        sum.map(|sum| sum / self.volume())
    }
}
