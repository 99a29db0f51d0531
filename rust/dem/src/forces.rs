//! Contact forces of one step: pairs row by row, then walls (Table 1).

use crate::contacts::{ContactRows, WallContacts};
use crate::disc::Disc;
use crate::law::{pair_stiffness, tangential_force, wall_stiffness};
use crate::material::Material;
use crate::walls::{Side, Walls};

/// Resultant of the contact forces [N] and their torque [N m] on one disc.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[repr(C, align(32))]
pub struct Load {
    pub fx: f64,
    pub fy: f64,
    pub torque: f64,
}

/// Material numbers as the contact loop wants them.
#[derive(Clone, Copy)]
pub(crate) struct ContactLaw {
    young_modulus: f64,
    stiffness_ratio: f64,
    friction: f64,
    wall_factor: f64,
    dt: f64,
}

impl ContactLaw {
    pub fn new(material: &Material, dt: f64) -> Self {
        Self {
            young_modulus: material.young_modulus,
            stiffness_ratio: material.stiffness_ratio,
            friction: material.friction_angle.tan(),
            wall_factor: material.wall_stiffness_factor,
            dt,
        }
    }

    /// (f_n, f_t) [N] from stiffness, overlap and relative tangential speed; `previous` is the stored f_t.
    #[inline(always)]
    fn force(&self, stiffness: f64, overlap: f64, speed: f64, previous: f64) -> (f64, f64) {
        let normal = stiffness * overlap;
        let tangential = tangential_force(
            previous,
            self.stiffness_ratio * stiffness,
            speed * self.dt,
            self.friction * normal,
        );
        (normal, tangential)
    }
}

/// Adds the forces of all pairs to `loads`, and updates their friction history.
pub(crate) fn add_pairs(law: ContactLaw, discs: &[Disc], rows: &mut ContactRows, loads: &mut [Load]) {
    for i in 0..discs.len() {
        let a = &discs[i];
        let mut on_a = Load::default();
        for k in rows.row(i) {
            let j = rows.partner[k] as usize;
            let b = &discs[j];
            let (dx, dy) = (b.x - a.x, b.y - a.y);
            let reach = a.radius + b.radius;
            let distance2 = dx * dx + dy * dy;
            if distance2 >= reach * reach {
                rows.tangential[k] = 0.0;
                continue;
            }
            let distance = distance2.sqrt();
            let (nx, ny) = (dx / distance, dy / distance);
            let overlap = reach - distance;
            // Lever arms end at the middle of the overlap.
            let (arm_a, arm_b) = (a.radius - 0.5 * overlap, b.radius - 0.5 * overlap);
            // Velocity of j relative to i at the contact, along t = (-n_y, n_x).
            let speed = (b.vy - a.vy) * nx
                - (b.vx - a.vx) * ny
                - (arm_a * a.angular_velocity + arm_b * b.angular_velocity);
            let stiffness = pair_stiffness(law.young_modulus, a.radius, b.radius);
            let (normal, tangential) = law.force(stiffness, overlap, speed, rows.tangential[k]);
            rows.tangential[k] = tangential;

            let (fx, fy) = (normal * nx - tangential * ny, normal * ny + tangential * nx);
            let on_b = &mut loads[j];
            on_b.fx += fx;
            on_b.fy += fy;
            on_b.torque -= arm_b * tangential;
            on_a.fx -= fx;
            on_a.fy -= fy;
            on_a.torque -= arm_a * tangential;
        }
        let load = &mut loads[i];
        load.fx += on_a.fx;
        load.fy += on_a.fy;
        load.torque += on_a.torque;
    }
}

/// Adds the forces of one wall to `loads`, updates the friction history, and returns the force on the wall,
/// (normal, tangential) [N]: normal positive when the grains push the wall outwards, tangential along
/// t = (−n_y, n_x) of the inward normal.
pub(crate) fn add_wall(
    law: ContactLaw,
    side: Side,
    walls: &Walls,
    discs: &[Disc],
    contacts: &mut WallContacts,
    loads: &mut [Load],
) -> [f64; 2] {
    let [nx, ny] = side.normal();
    let [wall_vx, wall_vy] = walls.velocity(side);
    let mut on_wall = [0.0; 2];
    for (&i, history) in contacts.disc.iter().zip(&mut contacts.tangential) {
        let disc = &discs[i as usize];
        let distance = walls.distance(side, disc.x, disc.y);
        let overlap = disc.radius - distance;
        if overlap <= 0.0 {
            *history = 0.0;
            continue;
        }
        let speed = (disc.vy - wall_vy) * nx - (disc.vx - wall_vx) * ny - distance * disc.angular_velocity;
        let stiffness = wall_stiffness(law.young_modulus, law.wall_factor, disc.radius);
        let (normal, tangential) = law.force(stiffness, overlap, speed, *history);
        *history = tangential;
        let load = &mut loads[i as usize];
        load.fx += normal * nx - tangential * ny;
        load.fy += normal * ny + tangential * nx;
        load.torque -= distance * tangential;
        on_wall[0] += normal;
        on_wall[1] -= tangential;
    }
    on_wall
}
