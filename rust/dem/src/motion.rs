//! Damping and motion: symplectic Euler (Eqs. 3 and 4).

use crate::disc::Disc;
use crate::forces::Load;
use crate::law::damping_force;

/// Velocities, then positions, over `dt` [s]. Returns the largest speed of a disc [m/s].
///
/// `damping` is μ of Table 1. `free_drag` [1/s] slows discs without contact force, which Table 1 leaves undamped.
pub(crate) fn advance(discs: &mut [Disc], loads: &[Load], damping: f64, free_drag: f64, dt: f64) -> f64 {
    let keep_free = (1.0 - free_drag * dt).max(0.0);
    let mut largest2 = 0.0f64;
    for (disc, load) in discs.iter_mut().zip(loads) {
        let force = [load.fx, load.fy];
        let [dx, dy] = damping_force(damping, force, [disc.vx, disc.vy]);
        let touched = load.fx != 0.0 || load.fy != 0.0 || load.torque != 0.0;
        let keep = if touched { 1.0 } else { keep_free };
        let per_mass = dt / disc.mass;
        disc.vx = keep * (disc.vx + per_mass * (load.fx + dx));
        disc.vy = keep * (disc.vy + per_mass * (load.fy + dy));
        // I = m r²/2 with the current radius.
        disc.angular_velocity =
            keep * (disc.angular_velocity + 2.0 * per_mass * load.torque / (disc.radius * disc.radius));
        disc.x += dt * disc.vx;
        disc.y += dt * disc.vy;
        largest2 = largest2.max(disc.vx * disc.vx + disc.vy * disc.vy);
    }
    largest2.sqrt()
}
