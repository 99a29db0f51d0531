//! A flat wall that is pressed onto a bed: it moves as a body of its own mass, until it is at rest under the pressure. Or one that
//! closes a bed: it moves to a place.

use crate::BedError;
use crate::settle::{Rest, agitation, descent, settle};
use msdd_spheres::space::{dot, length};
use msdd_spheres::{Simulation, Surface};

/// Steps between two changes of the wall's velocity, and such changes between two looks.
const STEPS: u64 = 20;
const LOOK_EVERY: u64 = 10;
/// The wall weighs what gives the pressure under gravity, but no less than so many layers of grains: a lighter one would be thrown
/// back and forth between two changes of its velocity. The force is that of the pressure all the same.
const LAYERS: f64 = 2.0;
/// The wall's velocity fades at this rate times √(g/d), so that it does not bounce for long.
const DRAG: f64 = 3.0;
/// Relative error of the pressure, and kinetic energy over Σ m g r, at which wall and bed count as at rest.
const BALANCED: [f64; 2] = [2e-3, 1e-8];
/// A wall that closes a bed compresses it at this rate times √(g/d), under its own weight in the middle an inertial number of 0.002 or less.
const CLOSING: f64 = 3e-3;

/// Presses wall number `wall` with `pressure` \[Pa\] on `area` \[m²\], for at most `longest` \[s\], and leaves it at rest where it is
/// then. First it is moved to where it just touches the nearest grain, if that is in front of it. `watch` receives the
/// agitation of the bed.
///
/// # Errors
/// A wall that is not flat; those of [`Simulation::run`].
pub fn press(
    simulation: &mut Simulation,
    wall: usize,
    (pressure, area): (f64, f64),
    longest: f64,
    mut watch: impl FnMut(f64),
) -> Result<Rest, BedError> {
    let (start, first) = (simulation.time, simulation.steps);
    let gravity = length(simulation.gravity);
    let normal = approach(simulation, wall)?;
    // A full layer has one grain on d² of the wall.
    let heaviest = simulation.spheres.iter().fold(0.0f64, |mass, sphere| mass.max(sphere.mass));
    let layer = heaviest * area / (2.0 * simulation.mean_radius()).powi(2);
    let force = pressure * area;
    let mass = (force / gravity).max(LAYERS * layer);
    let fade = DRAG * (gravity / (2.0 * simulation.mean_radius())).sqrt();
    simulation.drag = descent(2.0 * simulation.mean_radius(), gravity).1;
    let (mut speed, mut blocks) = (0.0, 0);
    loop {
        simulation.run(STEPS)?;
        let dt = STEPS as f64 * simulation.time_step;
        let borne = -dot(simulation.wall_force[wall], normal);
        speed = (speed + dt * (force - borne) / mass) / (1.0 + dt * fade);
        set_speed(simulation, wall, normal.map(|n| speed * n));
        blocks += 1;
        if blocks % LOOK_EVERY != 0 {
            continue;
        }
        let kinetic = agitation(simulation, gravity);
        watch(kinetic);
        let time = simulation.time - start;
        let at_rest = (borne / force - 1.0).abs() < BALANCED[0] && kinetic < BALANCED[1];
        if at_rest || time >= longest {
            simulation.drag = 0.0;
            set_speed(simulation, wall, [0.0; 3]);
            return Ok(Rest { at_rest, kinetic, time, steps: simulation.steps - first });
        }
    }
}

/// Moves wall number `lid`, which faces down, to `depth` \[m\] above z = 0, and lets the bed come to rest for at most `longest` \[s\].
/// `watch` receives the agitation of the bed.
///
/// # Errors
/// A wall that is not flat; a bed that the lid does not touch there; those of [`Simulation::run`].
pub fn close(
    simulation: &mut Simulation,
    lid: usize,
    depth: f64,
    longest: f64,
    mut watch: impl FnMut(f64),
) -> Result<Rest, BedError> {
    let (start, first) = (simulation.time, simulation.steps);
    let (gravity, diameter) = (length(simulation.gravity), 2.0 * simulation.mean_radius());
    let normal = approach(simulation, lid)?;
    let highest = simulation.boundary.walls()[lid].point[2];
    if highest <= depth {
        return Err(BedError::LidNotTouching { depth, highest });
    }
    simulation.drag = descent(diameter, gravity).1;
    let speed = CLOSING * (gravity / diameter).sqrt() * depth;
    let steps = STEPS * LOOK_EVERY;
    loop {
        let left = simulation.boundary.walls()[lid].point[2] - depth;
        if left <= 1e-9 * depth {
            break;
        }
        let time = steps as f64 * simulation.time_step;
        set_speed(simulation, lid, normal.map(|n| speed.min(left / time) * n));
        simulation.run(steps)?;
        watch(agitation(simulation, gravity));
    }
    set_speed(simulation, lid, [0.0; 3]);
    let rest = settle(simulation, longest, watch)?;
    Ok(Rest { time: simulation.time - start, steps: simulation.steps - first, ..rest })
}

pub(crate) fn set_speed(simulation: &mut Simulation, wall: usize, velocity: [f64; 3]) {
    if let Some(wall) = simulation.boundary.walls_mut().get_mut(wall) {
        wall.velocity = velocity;
    }
}

/// Moves the wall to the nearest grain. Returns its normal.
fn approach(simulation: &mut Simulation, wall: usize) -> Result<[f64; 3], BedError> {
    let Some(moved) = simulation.boundary.walls_mut().get_mut(wall) else { return Err(BedError::NotFlat) };
    let Surface::Flat { normal } = moved.surface else { return Err(BedError::NotFlat) };
    let gap = simulation.spheres.iter().map(|s| moved.distance(s.position) - s.radius);
    let gap = gap.fold(f64::INFINITY, f64::min);
    if gap.is_finite() && gap > 0.0 {
        moved.point = std::array::from_fn(|k| moved.point[k] + gap * normal[k]);
        simulation.rebuild_neighbours();
    }
    Ok(normal)
}
