//! Thermal expansion of a packed RVE: radii grow or shrink in fixed walls, with stops (section 2.4).

use crate::homogenise::{Averages, homogenise};
use crate::pack::Packed;
use crate::region::RegionKind;
use crate::settle::{Settled, settle};
use crate::{RveError, Simulation};

/// |dε/dt| of a ramp [1/s].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rates {
    pub expansion: f64,
    pub contraction: f64,
}

impl Default for Rates {
    /// Expansion hardly feels the rate; near unjamming, contraction does (−2 % at 2 /s: σ 12 % low).
    fn default() -> Self {
        Self { expansion: 0.1, contraction: 0.02 }
    }
}

/// Largest step count between two looks at the stable time step.
const RUN: u64 = 50;

/// The state at one stop of a ramp.
#[derive(Clone, Debug)]
pub struct Stop {
    /// ε relative to the packed state [-].
    pub strain: f64,
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
    expand_at(&mut packed.simulation.clone(), stops, Rates::default(), |_, _| ())
}

/// As [`expand`], on a simulation that ends at the last stop reached, at given rates. `visit` sees it at each stop.
pub fn expand_at(
    simulation: &mut Simulation,
    stops: &[f64],
    rates: Rates,
    mut visit: impl FnMut(&Stop, &Simulation),
) -> Result<Ramp, RveError> {
    check(stops)?;
    for (key, rate) in [("expansion rate", rates.expansion), ("contraction rate", rates.contraction)] {
        if !(1e-6..=100.0).contains(&rate) {
            return Err(RveError::Parameter { key, value: rate.to_string(), allowed: "1e-6 to 100 1/s" });
        }
    }
    let mut ramp = Ramp { stops: Vec::new(), failure: None };
    for &strain in stops {
        match advance_to(simulation, strain, rates) {
            Ok(stop) => {
                visit(&stop, simulation);
                ramp.stops.push(stop);
            }
            Err(failure) => {
                ramp.failure = Some(failure);
                break;
            }
        }
    }
    Ok(ramp)
}

fn check(stops: &[f64]) -> Result<(), RveError> {
    let mut previous = 0.0f64;
    for &stop in stops {
        let further = stop.abs() > previous.abs() && (previous == 0.0 || stop * previous > 0.0);
        if !(further && stop.abs() <= 0.2) {
            let allowed = "one sign, growing in magnitude, at most 0.2";
            return Err(RveError::Parameter { key: "strains", value: format!("{stops:?}"), allowed });
        }
        previous = stop;
    }
    Ok(())
}

fn advance_to(simulation: &mut Simulation, strain: f64, rates: Rates) -> Result<Stop, RveError> {
    let since = simulation.steps;
    let rate = if strain > simulation.strain() { rates.expansion } else { rates.contraction };
    loop {
        let left = strain - simulation.strain();
        let steps = (left.abs() / (rate * simulation.time_step)).ceil();
        if steps < 1.0 || left.abs() < 1e-12 {
            break;
        }
        // Equal steps that end at the stop, or the first of them.
        simulation.set_strain_rate(left / (steps * simulation.time_step));
        simulation.run((steps as u64).min(RUN))?;
    }
    simulation.set_strain_rate(0.0);
    let settled = settle(simulation, since)?;
    let averages = homogenise(simulation, RegionKind::default());
    Ok(Stop { strain, settled, averages })
}
