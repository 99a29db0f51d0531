//! Wall friction: long walls slip along the grains, and the mobilised friction is measured at given slips.

use crate::expand::{Protocol, Ramp, Stop, Strains, rest};
use crate::scale::speed_factor;
use crate::settle::Relaxation;
use crate::stopwatch::{self, Stage};
use crate::{RveError, Simulation};
use msdd_dem::Side;

/// Speed of the walls [m/s] for the paper's grains; as in packing. The grains come to rest at each stop.
const SLIP_SPEED: f64 = 0.03;
/// Slip over the mean radius that counts as zero [-].
const NO_SLIP: f64 = 2e-10;
/// Largest slip over the mean radius [-].
const LARGEST_SLIP: f64 = 200.0;
/// Largest number of steps between two updates of the time step.
const RUN: u64 = 50;

/// Friction and slip of the sliding walls, mean of bottom and top.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Sliding {
    /// Mobilised friction: tangential over normal force of the wall, positive against the motion [-].
    pub friction: f64,
    /// Slip: displacement of the wall less that of the grains that touch it (which move because the assembly behind
    /// them deforms), weighted by their normal forces \[m\].
    pub slip: f64,
}

/// Moves bottom and top towards +x by the given displacements \[m\], counted from the present state and growing: the end
/// walls hold the grains back, as in a box whose ends are heated differently. The assembly relaxes at each stop; `visit` is called there with friction and slip.
///
/// # Errors
/// [`RveError::Parameter`] for displacements that are not allowed. A failure on the way is in [`Ramp::failure`].
pub fn slide(
    simulation: &mut Simulation,
    slips: &[f64],
    relaxation: Relaxation,
    mut visit: impl FnMut(&Stop, Sliding),
) -> Result<Ramp, RveError> {
    let largest = LARGEST_SLIP * simulation.mean_radius();
    let growing =
        slips.windows(2).all(|pair| pair[0] < pair[1]) && slips.iter().all(|&s| s > 0.0 && s <= largest);
    if !growing {
        let allowed = "growing, above 0, at most 200 mean radii [m]";
        return RveError::parameter("slips", format!("{slips:?}"), allowed);
    }
    let start: Vec<f64> = simulation.discs.iter().map(|disc| disc.x).collect();
    let mut ramp = Ramp { stops: Vec::new(), failure: None };
    let mut done = 0.0;
    for &slip in slips {
        match slip_by(simulation, slip - done, relaxation) {
            Ok(stop) => {
                visit(&stop, sliding(simulation, slip, &start));
                ramp.stops.push(stop);
                done = slip;
            }
            Err(failure) => {
                ramp.failure = Some(failure);
                break;
            }
        }
    }
    Ok(ramp)
}

fn slip_by(simulation: &mut Simulation, way: f64, relaxation: Relaxation) -> Result<Stop, RveError> {
    let since = simulation.steps;
    stopwatch::time(Stage::Strain, || -> Result<(), RveError> {
        let mut left = way;
        let radius = simulation.mean_radius();
        let wall_speed = SLIP_SPEED * speed_factor(&simulation.material, radius);
        while left > NO_SLIP * radius {
            let steps = (left / (wall_speed * simulation.time_step)).ceil();
            let speed = left / (steps * simulation.time_step);
            simulation.walls.tangential_velocity = [0.0, 0.0, speed, speed];
            let begin = simulation.time;
            simulation.run((steps as u64).min(RUN))?;
            left -= speed * (simulation.time - begin);
        }
        Ok(())
    })?;
    rest(simulation, Strains::default(), Protocol { relaxation, ..Protocol::default() }, since)
}

/// Friction and slip after a displacement `way` [m] of the walls; `start` has x of the discs [m] before it. All values
/// are 0 when a wall has no normal force.
fn sliding(simulation: &Simulation, way: f64, start: &[f64]) -> Sliding {
    let mut mean = Sliding::default();
    for side in [Side::Bottom, Side::Top] {
        let (mut normal, mut tangential, mut moved) = (0.0, 0.0, 0.0);
        simulation.for_each_contact(|contact| {
            if contact.i == Err(side) {
                let [x, y] = contact.force();
                // Force on the disc: normal inwards, tangential along the motion of the wall that drags it.
                let inwards = side.normal()[1] * y;
                normal += inwards;
                tangential += x;
                moved += inwards * (simulation.discs[contact.j].x - start[contact.j]);
            }
        });
        if normal > 0.0 {
            mean.friction += 0.5 * tangential / normal;
            mean.slip += 0.5 * (way - moved / normal);
        }
    }
    mean
}

/// Friction at walls that have not moved: what the packing procedure left.
pub fn at_rest(simulation: &Simulation) -> Sliding {
    let start: Vec<f64> = simulation.discs.iter().map(|disc| disc.x).collect();
    sliding(simulation, 0.0, &start)
}
