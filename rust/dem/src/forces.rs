//! Contact forces of discs on walls (Table 1).

use crate::contacts::WallPart;
use crate::disc::Disc;
use crate::law::{PairLaw, tangential_force, wall_stiffness};
use crate::walls::{Flow, Side, Walls};

/// Resultant of the contact forces [N] and their torque [N m] on one disc.
#[derive(Clone, Copy, Debug, Default)]
#[repr(C, align(32))]
pub struct Load {
    pub fx: f64,
    pub fy: f64,
    pub torque: f64,
    /// Padding, so that a load fills the vector that the kernels write; has no meaning.
    pub(crate) spare: f64,
}

impl Load {
    pub(crate) fn add(&mut self, other: &Self) {
        self.fx += other.fx;
        self.fy += other.fy;
        self.torque += other.torque;
    }
}

/// Adds the forces of one wall to `loads`, updates the friction history, and returns the force on the wall, (normal,
/// tangential) [N]: normal positive when the grains push the wall outwards, tangential along t = (−n_y, n_x) of the
/// inward normal. The first elements of `discs` and `loads` belong to disc `first`.
pub(crate) fn add_wall(
    law: PairLaw,
    side: Side,
    (walls, flow): (&Walls, Flow),
    contacts: WallPart,
    (first, discs): (usize, &[Disc]),
    loads: &mut [Load],
) -> [f64; 2] {
    let [nx, ny] = side.normal();
    let [wall_vx, wall_vy] = walls.velocity(side);
    let mut on_wall = [0.0; 2];
    for (&i, history) in contacts.disc.iter().zip(contacts.tangential) {
        let k = i as usize - first;
        let disc = &discs[k];
        let distance = walls.distance(side, disc.x, disc.y);
        let overlap = disc.radius - distance;
        if overlap <= 0.0 {
            *history = 0.0;
            continue;
        }
        let [carried_x, carried_y] = flow.at(disc.x, disc.y);
        let speed = (disc.vy + carried_y - wall_vy) * nx
            - (disc.vx + carried_x - wall_vx) * ny
            - distance * disc.angular_velocity;
        let stiffness = wall_stiffness(law.young_modulus, law.wall_factor, disc.radius);
        let normal = stiffness * overlap;
        let tangential = tangential_force(
            *history,
            law.stiffness_ratio * stiffness,
            speed * law.dt,
            law.friction * normal,
        );
        *history = tangential;
        let load = Load {
            fx: normal * nx - tangential * ny,
            fy: normal * ny + tangential * nx,
            torque: -distance * tangential,
            ..Load::default()
        };
        loads[k].add(&load);
        on_wall[0] += normal;
        on_wall[1] -= tangential;
    }
    on_wall
}
