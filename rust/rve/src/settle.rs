//! Relaxation to static equilibrium.

use crate::RveError;
use msdd_dem::Simulation;
use serde::{Deserialize, Serialize};

/// Least number of steps between two copies of the last good state; the copies then take a thousandth of the run time.
pub(crate) const KEEP_EVERY: u64 = 1000;

/// An assembly is in equilibrium ("settled") when mean |resultant| < this times the mean contact force. The paper says
/// "static equilibrium" without a number; 1e-4 leaves the pressure within 1e-3 of its limit.
pub const UNBALANCED_LIMIT: f64 = 1e-4;
/// Added to the mean contact force, in units of E r̄² / 1 m · 1 m, so that a state without force chains can count as
/// settled.
const FORCE_FLOOR: f64 = 1e-5;
/// Below this p̃ = p ℓ / (E r̄) the grains count as bearing no load, "unjammed" (jammed packings have 0.01 to 0.3).
pub const UNJAMMED_PRESSURE: f64 = 2e-4;
/// Largest number of steps of a relaxation; typical are 1 000 to 5 000.
const STEP_CAP: u64 = 60_000;
/// Steps between two checks of the balance.
const LOOK_EVERY: u64 = 50;

/// How forces are brought into balance.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Relaxation {
    /// The grains' own motion, with the paper's damping.
    #[default]
    Damped,
    /// FIRE: several times as fast, but not along the path of the grains' own motion, see [`Simulation::relax`].
    Fire,
}

/// How a relaxation ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Outcome {
    /// Forces in balance, and the grains carry load.
    Settled,
    /// The largest number of steps was reached before the balance.
    Capped,
    /// The grains carry no load, whether the forces came into balance or not.
    Unjammed,
}

msdd_beds::named!(Outcome);

/// Report of a relaxation.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Settled {
    pub outcome: Outcome,
    /// Steps of the ramp or compression and of the relaxation after it.
    pub steps: u64,
    /// mean |resultant| / (mean contact force + floor) at the end [-].
    pub unbalanced: f64,
}

/// Runs until the forces balance. `since` is the step count at which the present load stage began.
pub fn settle(simulation: &mut Simulation, relaxation: Relaxation, since: u64) -> Result<Settled, RveError> {
    settle_to(simulation, relaxation, UNBALANCED_LIMIT, since)
}

/// As [`settle`], with `limit` [-] instead of [`UNBALANCED_LIMIT`].
pub fn settle_to(
    simulation: &mut Simulation,
    relaxation: Relaxation,
    limit: f64,
    since: u64,
) -> Result<Settled, RveError> {
    let balanced = |simulation: &Simulation| unbalanced_force(simulation) < limit;
    match relaxation {
        Relaxation::Fire => {
            simulation.relax(STEP_CAP, balanced)?;
        }
        Relaxation::Damped => {
            let end = simulation.steps + STEP_CAP;
            while simulation.steps < end {
                simulation.run(LOOK_EVERY)?;
                if balanced(simulation) {
                    break;
                }
            }
        }
    }
    let unbalanced = unbalanced_force(simulation);
    let outcome = if mean_pressure(simulation) < UNJAMMED_PRESSURE {
        Outcome::Unjammed
    } else if unbalanced < limit {
        Outcome::Settled
    } else {
        Outcome::Capped
    };
    Ok(Settled { outcome, steps: simulation.steps - since, unbalanced })
}

/// Measure of the force balance: mean |resultant of contact forces| over the discs / (mean normal contact force +
/// floor) [-].
pub fn unbalanced_force(simulation: &Simulation) -> f64 {
    let mut resultant = vec![[0.0f64; 2]; simulation.discs.len()];
    let (mut sum, mut count) = (0.0, 0.0f64);
    simulation.for_each_contact(|contact| {
        let [fx, fy] = contact.force();
        resultant[contact.j][0] += fx;
        resultant[contact.j][1] += fy;
        if let Ok(i) = contact.i {
            resultant[i][0] -= fx;
            resultant[i][1] -= fy;
        }
        sum += contact.normal_force();
        count += 1.0;
    });
    let mean = resultant.iter().map(|[x, y]| (x * x + y * y).sqrt()).sum::<f64>() / resultant.len() as f64;
    let radius = simulation.mean_radius();
    let floor = FORCE_FLOOR * simulation.material.young_modulus * radius * radius;
    mean / (sum / count.max(1.0) + floor)
}

/// p̃ = p ℓ / (E r̄) [-] of the whole box, from the normal forces only.
fn mean_pressure(simulation: &Simulation) -> f64 {
    let mut sum = 0.0;
    simulation.for_each_contact(|contact| {
        let [x, y] = contact.branch;
        sum += contact.normal_force() * (x * x + y * y).sqrt();
    });
    let pressure = 0.5 * sum / simulation.walls.area();
    pressure / (simulation.material.young_modulus * simulation.mean_radius())
}
