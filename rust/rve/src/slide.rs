//! Long walls that slip along the grains: how much of the wall friction a given slip mobilises.

use crate::expand::{Protocol, Ramp, Stop, Strains, rest};
use crate::settle::Relaxation;
use crate::stopwatch::{self, Stage};
use crate::{RveError, Simulation};
use msdd_dem::Side;
use serde::{Deserialize, Serialize};

/// Speed of the walls [m/s]: that of packing, and the grains come to rest at each stop.
const SLIP_SPEED: f64 = 0.03;
/// Largest step count between two looks at the stable time step.
const RUN: u64 = 50;

/// Which way bottom and top move.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Slide {
    /// Both towards +x: the end walls hold the grains back, as in a box whose ends are heated differently.
    #[default]
    Same,
    /// Bottom towards −x, top towards +x: the grains are sheared as well.
    Opposite,
}

impl Slide {
    /// Direction of bottom and top along x.
    fn directions(self) -> [f64; 2] {
        match self {
            Self::Same => [1.0, 1.0],
            Self::Opposite => [-1.0, 1.0],
        }
    }
}

/// Moves bottom and top along x through the given slips [m] from here, growing. The assembly relaxes at each stop;
/// `visit` sees it there with the mobilised friction: tangential over normal force of the wall, positive against the
/// motion, mean of bottom and top [-].
///
/// # Errors
/// [`RveError::Parameter`] for unusable slips. What goes wrong on the way is in [`Ramp::failure`].
pub fn slide(
    simulation: &mut Simulation,
    slips: &[f64],
    (slide, relaxation): (Slide, Relaxation),
    mut visit: impl FnMut(&Stop, f64),
) -> Result<Ramp, RveError> {
    let growing =
        slips.windows(2).all(|pair| pair[0] < pair[1]) && slips.iter().all(|&s| s > 0.0 && s <= 1.0);
    if !growing {
        let allowed = "growing, above 0, at most 1 m";
        return Err(RveError::Parameter { key: "slips", value: format!("{slips:?}"), allowed });
    }
    let mut ramp = Ramp { stops: Vec::new(), failure: None };
    let mut done = 0.0;
    for &slip in slips {
        match slip_by(simulation, slip - done, slide, relaxation) {
            Ok(stop) => {
                visit(&stop, mobilised_friction(simulation, slide));
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

fn slip_by(
    simulation: &mut Simulation,
    way: f64,
    slide: Slide,
    relaxation: Relaxation,
) -> Result<Stop, RveError> {
    let since = simulation.steps;
    stopwatch::time(Stage::Strain, || -> Result<(), RveError> {
        let mut left = way;
        while left > 1e-12 {
            let steps = (left / (SLIP_SPEED * simulation.time_step)).ceil();
            let speed = left / (steps * simulation.time_step);
            let [bottom, top] = slide.directions();
            simulation.walls.tangential_velocity = [0.0, 0.0, speed * bottom, speed * top];
            let begin = simulation.time;
            simulation.run((steps as u64).min(RUN))?;
            left -= speed * (simulation.time - begin);
        }
        Ok(())
    })?;
    rest(simulation, Strains::default(), Protocol { relaxation, ..Protocol::default() }, since)
}

/// Mean over bottom and top of tangential over normal force, positive against the motion; 0 without normal force.
pub fn mobilised_friction(simulation: &Simulation, slide: Slide) -> f64 {
    let sides = [Side::Bottom, Side::Top].into_iter().zip(slide.directions());
    let friction = |(side, direction): (Side, f64)| {
        let mut force = [0.0; 2];
        simulation.for_each_contact(|contact| {
            if contact.i == Err(side) {
                let [x, y] = contact.force();
                // On the disc: normal inwards, tangential along the motion of the wall that drags it.
                force[0] += side.normal()[1] * y;
                force[1] += direction * x;
            }
        });
        if force[0] > 0.0 { force[1] / force[0] } else { 0.0 }
    };
    0.5 * sides.map(friction).sum::<f64>()
}
