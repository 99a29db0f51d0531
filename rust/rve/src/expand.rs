//! Straining a packed RVE: radii grow or shrink in fixed walls, with stops (section 2.4); or walls move as well.

use crate::homogenise::{Averages, homogenise};
use crate::last_good;
use crate::pack::Packed;
use crate::region::RegionKind;
use crate::settle::{Relaxation, Settled, settle};
use crate::stopwatch::{self, Stage};
use crate::{RveError, Simulation};

/// How a path is followed: the rate of the strain that changes most [1/s], when contacts close and when they open, and
/// what brings the forces into balance at the stops.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Protocol {
    pub expansion_rate: f64,
    pub contraction_rate: f64,
    pub relaxation: Relaxation,
}

impl Default for Protocol {
    /// Expansion hardly feels the rate; near unjamming, contraction does (−2 % at 2 /s: σ 12 % low).
    fn default() -> Self {
        Self { expansion_rate: 0.1, contraction_rate: 0.02, relaxation: Relaxation::default() }
    }
}

/// Largest step count between two looks at the stable time step.
const RUN: u64 = 50;

/// Strains relative to the start of a path [-].
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Strains {
    /// ε of the radii.
    pub thermal: f64,
    /// Extension of the box along x and y: both walls move by half of it.
    pub xx: f64,
    pub yy: f64,
}

impl Strains {
    pub fn thermal(strain: f64) -> Self {
        Self { thermal: strain, ..Self::default() }
    }
}

/// The state at one stop of a path.
#[derive(Clone, Debug)]
pub struct Stop {
    pub strains: Strains,
    pub settled: Settled,
    pub averages: Averages,
}

/// A ramp as far as it went.
#[derive(Clone, Debug)]
pub struct Ramp {
    pub stops: Vec<Stop>,
    /// Why it ended before the last stop asked for.
    pub failure: Option<RveError>,
}

/// One monotone ramp from the packed state through `stops`: strains relative to the packed state, all of one sign,
/// growing in magnitude. The RVE relaxes at each stop before it is averaged.
///
/// # Errors
/// [`RveError::Parameter`] for unusable stops. What goes wrong on the way is in [`Ramp::failure`].
pub fn expand(packed: &Packed, stops: &[f64]) -> Result<Ramp, RveError> {
    check_monotone(stops)?;
    let path: Vec<Strains> = stops.iter().copied().map(Strains::thermal).collect();
    follow(&mut packed.simulation.clone(), &path, Protocol::default(), |_, _| ())
}

/// Follows a path of thermal strain and wall strain from stop to stop, straight in between. The simulation ends at the
/// last stop reached; `visit` sees it at each. After a failure, [`Simulation::take_last_good`] has the last good state.
///
/// # Errors
/// [`RveError::Parameter`] for unusable strains or rates. What goes wrong on the way is in [`Ramp::failure`].
pub fn follow(
    simulation: &mut Simulation,
    path: &[Strains],
    protocol: Protocol,
    mut visit: impl FnMut(&Stop, &Simulation),
) -> Result<Ramp, RveError> {
    check(path, protocol)?;
    simulation.reset_strain();
    simulation.keep_last_good(last_good::EVERY);
    let start = [simulation.walls.width(), simulation.walls.height()];
    let mut ramp = Ramp { stops: Vec::new(), failure: None };
    for &strains in path {
        match advance_to(simulation, strains, start, protocol) {
            Ok(stop) => {
                visit(&stop, simulation);
                ramp.stops.push(stop);
            }
            Err(failure) => {
                ramp.failure = Some(failure);
                return Ok(ramp);
            }
        }
    }
    simulation.take_last_good();
    Ok(ramp)
}

fn check(path: &[Strains], protocol: Protocol) -> Result<(), RveError> {
    for (key, rate) in
        [("expansion rate", protocol.expansion_rate), ("contraction rate", protocol.contraction_rate)]
    {
        if !(1e-6..=100.0).contains(&rate) {
            return Err(RveError::Parameter { key, value: rate.to_string(), allowed: "1e-6 to 100 1/s" });
        }
    }
    let values = path.iter().flat_map(|s| [("thermal strain", s.thermal), ("xx", s.xx), ("yy", s.yy)]);
    for (key, value) in values {
        if !(-0.2..=0.2).contains(&value) {
            return Err(RveError::Parameter { key, value: value.to_string(), allowed: "-0.2 to 0.2" });
        }
    }
    Ok(())
}

fn check_monotone(stops: &[f64]) -> Result<(), RveError> {
    let mut previous = 0.0f64;
    for &stop in stops {
        if stop.abs() <= previous.abs() || stop * previous < 0.0 {
            let allowed = "one sign, growing in magnitude";
            return Err(RveError::Parameter { key: "strains", value: format!("{stops:?}"), allowed });
        }
        previous = stop;
    }
    Ok(())
}

/// Straight on to `target`, then at rest until the forces balance. `start` is the box at zero strain [m].
fn advance_to(
    simulation: &mut Simulation,
    target: Strains,
    [width, height]: [f64; 2],
    protocol: Protocol,
) -> Result<Stop, RveError> {
    let since = simulation.steps;
    stopwatch::time(Stage::Strain, || strain_to(simulation, target, [width, height], protocol))?;
    rest(simulation, target, protocol.relaxation, since)
}

/// Relaxes in resting walls and averages.
pub(crate) fn rest(
    simulation: &mut Simulation,
    strains: Strains,
    relaxation: Relaxation,
    since: u64,
) -> Result<Stop, RveError> {
    simulation.set_strain_rate(0.0);
    simulation.walls.stop();
    let settled = stopwatch::time(Stage::StrainSettle, || settle(simulation, relaxation, since))?;
    let averages = stopwatch::time(Stage::Averaging, || homogenise(simulation, RegionKind::default()));
    Ok(Stop { strains, settled, averages })
}

fn strain_to(
    simulation: &mut Simulation,
    target: Strains,
    [width, height]: [f64; 2],
    protocol: Protocol,
) -> Result<(), RveError> {
    loop {
        let walls = &simulation.walls;
        let thermal = target.thermal - simulation.strain();
        let (dx, dy) =
            (width * (1.0 + target.xx) - walls.width(), height * (1.0 + target.yy) - walls.height());
        let largest = thermal.abs().max(dx.abs() / width).max(dy.abs() / height);
        // Contacts open when radii shrink or walls recede.
        let loosening = 2.0 * thermal < dx / width + dy / height;
        let rate = if loosening { protocol.contraction_rate } else { protocol.expansion_rate };
        let steps = (largest / (rate * simulation.time_step)).ceil();
        if steps < 1.0 || largest < 1e-12 {
            return Ok(());
        }
        // Equal steps that end at the stop, or the first of them.
        let time = steps * simulation.time_step;
        simulation.set_strain_rate(thermal / time);
        let (vx, vy) = (0.5 * dx / time, 0.5 * dy / time);
        simulation.walls.normal_velocity = [-vx, vx, -vy, vy];
        simulation.run((steps as u64).min(RUN))?;
    }
}
