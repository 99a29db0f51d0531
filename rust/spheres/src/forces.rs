//! Resultants on the spheres, and contact forces of walls.

use crate::boundary::Wall;
use crate::contacts::WallPart;
use crate::law::{ContactLaw, Touch};
use crate::space::{cross, minus, plus, scaled};
use crate::sphere::Sphere;

/// Resultant of the contact forces \[N\] and their torque \[N m\] on one sphere.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[repr(C, align(64))]
pub struct Load {
    pub force: [f64; 3],
    /// Padding, so that force and torque fill a vector each; has no meaning.
    pub(crate) spare: f64,
    pub torque: [f64; 3],
    pub(crate) spare_too: f64,
}

impl Load {
    pub(crate) fn add(&mut self, other: &Self) {
        self.force = plus(self.force, 1.0, other.force);
        self.torque = plus(self.torque, 1.0, other.torque);
    }
}

/// Adds the forces of one wall to `loads`, updates the friction history, and returns the force on the wall \[N\]. The
/// first elements of `spheres` and `loads` belong to sphere `first`.
pub(crate) fn add_wall(
    law: &ContactLaw,
    wall: &Wall,
    contacts: WallPart,
    (first, spheres): (usize, &[Sphere]),
    loads: &mut [Load],
) -> [f64; 3] {
    let mut on_wall = [0.0; 3];
    for (&i, history) in contacts.sphere.iter().zip(contacts.history) {
        let k = i as usize - first;
        let sphere = &spheres[k];
        let (distance, across) = wall.foot(sphere.position);
        let overlap = sphere.radius - distance;
        if overlap <= 0.0 {
            *history = [0.0; 4];
            continue;
        }
        let touch = Touch {
            normal: across,
            overlap,
            velocity: minus(sphere.velocity, wall.velocity_at(sphere.position, across)),
            spin: scaled(distance, sphere.angular_velocity),
            radius: sphere.radius,
            mass: sphere.mass,
            friction: law.friction[1],
        };
        let (normal, tangential, new) = law.force(&touch, *history);
        *history = new;
        let force = plus(tangential, normal, across);
        let torque = scaled(distance, cross(tangential, across));
        loads[k].add(&Load { force, torque, ..Load::default() });
        on_wall = minus(on_wall, force);
    }
    on_wall
}
