//! Coming to rest under gravity.

use crate::BedError;
use msdd_spheres::space::{dot, length, plus, scaled};
use msdd_spheres::{Simulation, Sphere};

/// Agitation (kinetic energy over that of falling by a radius) at which a bed counts as at rest.
const AT_REST: f64 = 1e-8;
/// Steps between two looks.
const LOOK_EVERY: u64 = 200;
/// Height of a free fall, over d, that gives the speed at which grains come down. Not settled by any reference; chosen because
/// grains that fall much faster, all at once, bounce back from the floor as a whole, and the friction of the walls then
/// points downwards.
const FALL: f64 = 5.0;

/// Time in which a bed has to come to rest after all grains have come down, over √(d/g).
const REST: f64 = 100.0;
/// One grain in so many is left out of the agitation.
const ROLLING: usize = 1000;

/// How a bed came to rest, or did not.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rest {
    pub at_rest: bool,
    /// The agitation in the end.
    pub kinetic: f64,
    /// Simulated time \[s\] and steps that it took.
    pub time: f64,
    pub steps: u64,
}

impl Rest {
    /// What is listed of a stage; an error of one that still moves.
    pub(crate) fn of(self, stage: &'static str) -> Result<(&'static str, Self), BedError> {
        let Self { at_rest, kinetic, time, .. } = self;
        if at_rest { Ok((stage, self)) } else { Err(BedError::NotSettled { stage, time, kinetic }) }
    }
}

/// Kinetic energy over Σ m g r, without the grains of the highest energy, one in a thousand: a grain that rocks in a hollow of the
/// surface does so long after all others are at rest.
pub fn agitation(simulation: &Simulation, gravity: f64) -> f64 {
    let falling: f64 = simulation.spheres.iter().map(|s| s.mass * gravity * s.radius).sum();
    let mut energies: Vec<f64> = simulation.spheres.iter().map(Sphere::kinetic_energy).collect();
    energies.sort_unstable_by(f64::total_cmp);
    energies.truncate(energies.len() - energies.len() / ROLLING);
    energies.iter().sum::<f64>() / falling
}

/// The speed \[m/s\] at which grains come down, and the drag \[1/s\] that makes it so and also stops grains that roll: nothing
/// else would.
pub(crate) fn descent(diameter: f64, gravity: f64) -> (f64, f64) {
    let speed = (2.0 * gravity * FALL * diameter).sqrt();
    (speed, gravity / speed)
}

/// Simulated time \[s\] within which a stage has to come to rest: twice that of coming down from `height` \[m\], and
/// then [`REST`].
pub(crate) fn longest(diameter: f64, gravity: f64, height: f64) -> f64 {
    REST * (diameter / gravity).sqrt() + 2.0 * height / descent(diameter, gravity).0
}

/// How far on the way to rest, from 0 to 1, by the logarithm of the agitation.
pub fn progress(agitation: f64) -> f64 {
    let begin = 10.0f64;
    ((begin.ln() - agitation.max(AT_REST).ln()) / (begin.ln() - AT_REST.ln())).clamp(0.0, 1.0)
}

/// Runs until the spheres are at rest, at most for `longest` \[s\]. `watch` receives the agitation.
///
/// # Errors
/// Those of [`Simulation::run`].
pub fn settle(
    simulation: &mut Simulation,
    longest: f64,
    mut watch: impl FnMut(f64),
) -> Result<Rest, BedError> {
    let (start, first) = (simulation.time, simulation.steps);
    let gravity = length(simulation.gravity);
    // What falls is slow at first.
    let least = (2.0 * simulation.mean_radius() / gravity).sqrt();
    simulation.drag = descent(2.0 * simulation.mean_radius(), gravity).1;
    loop {
        simulation.run(LOOK_EVERY)?;
        let kinetic = agitation(simulation, gravity);
        watch(kinetic);
        let time = simulation.time - start;
        let at_rest = kinetic < AT_REST && time > least;
        if at_rest || time >= longest {
            simulation.drag = 0.0;
            return Ok(Rest { at_rest, kinetic, time, steps: simulation.steps - first });
        }
    }
}

/// Turns gravity to another direction (a unit vector) within `duration` \[s\], at an even rate.
///
/// # Errors
/// Those of [`Simulation::run`].
pub fn turn(
    simulation: &mut Simulation,
    direction: [f64; 3],
    duration: f64,
    mut watch: impl FnMut(f64),
) -> Result<(), BedError> {
    let (start, gravity) = (simulation.time, length(simulation.gravity));
    let before = simulation.gravity.map(|g| g / gravity);
    let aside = across(before, direction);
    let whole = libm::acos(dot(before, direction).clamp(-1.0, 1.0));
    while simulation.time < start + duration {
        simulation.run(LOOK_EVERY / 4)?;
        let angle = whole * ((simulation.time - start) / duration).min(1.0);
        let turned = plus(scaled(libm::cos(angle), before), libm::sin(angle), aside);
        let norm = length(turned);
        simulation.gravity = turned.map(|g| gravity * g / norm);
        watch(agitation(simulation, gravity));
    }
    simulation.gravity = direction.map(|g| gravity * g);
    Ok(())
}

/// The unit vector across `from` on the side of `to`; any across if both are parallel.
fn across(from: [f64; 3], to: [f64; 3]) -> [f64; 3] {
    let side = |to: [f64; 3]| plus(to, -dot(from, to), from);
    let [a, b, c] = [to, [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]].map(side);
    let found = [a, b, c].into_iter().find(|v| length(*v) > 1e-6).unwrap_or(c);
    scaled(1.0 / length(found), found)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn there_is_a_way_to_every_direction() {
        let down = [0.0, 0.0, -1.0];
        for to in [[0.0, 0.0, 1.0], down, [0.0, -1.0, 0.0], [0.6, 0.0, -0.8]] {
            let aside = across(down, to);
            assert!((length(aside) - 1.0).abs() < 1e-15 && dot(aside, down).abs() < 1e-15);
            let angle = dot(down, to).acos();
            let end = plus(scaled(angle.cos(), down), angle.sin(), aside);
            assert!((0..3).all(|k| (end[k] - to[k]).abs() < 1e-12), "{to:?} {end:?}");
        }
    }
}
