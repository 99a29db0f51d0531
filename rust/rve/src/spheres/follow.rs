//! Straining a periodic box of spheres, and rest after it.

use super::strain::{Strain, over};
use crate::stopwatch::{self, Stage};
use crate::{Outcome, Settled};
use msdd_beds::averages::stress;
use msdd_beds::conductivity::mean;
use msdd_spheres::space::{Matrix, length, plus};
use msdd_spheres::time_step::SAFETY;
use msdd_spheres::{Failure, Partner, Simulation, StepChoice};

/// Strain rate over √(p/ρ)/d, the inertial number of straining. Not settled by any reference; chosen because three
/// times as much lowers the shear stress of a box that is sheared by 1 % by 3 % (ten times: 9 %), and the pressure of one that is
/// compressed by 1 % by 0.04 % (0.13 %).
const RATE: f64 = 3e-4;
/// (p/E*)^(2/3) over the increment, for the pressure that an increment is taken to build up or to take away: a box that loses its load
/// is not strained ever more slowly. Closing on all sides builds up five to seven times as much.
const BUILDS_UP: f64 = 0.1;
/// Drag over √(p/ρ)/d.
const DRAG: f64 = 3.0;
/// Mean resultant over mean contact force at which a box counts as at rest.
const BALANCED: f64 = 1e-4;
/// Added to the mean contact force, over E* d².
const FORCE_FLOOR: f64 = 1e-12;
/// p/E* below which the grains count as bearing no load.
pub const UNJAMMED_PRESSURE: f64 = 1e-10;
/// Steps after which a box that is not at rest is given up, and steps without load after which it counts as unjammed.
const MAX_STEPS: u64 = 30_000;
const MAX_UNJAMMED: u64 = 2_000;
/// Steps between two checks.
const LOOK_EVERY: u64 = 50;

/// Strains the box along a straight line by `step`, which is relative to its present state, and lets it come to rest.
///
/// # Errors
/// The [`Failure`] of a run.
pub fn advance(simulation: &mut Simulation, step: Strain) -> Result<Settled, Failure> {
    let since = simulation.steps;
    stopwatch::time(Stage::Strain, || strain(simulation, step))?;
    stopwatch::time(Stage::StrainSettle, || rest(simulation, since))
}

/// Strains without rest after it.
fn strain(simulation: &mut Simulation, step: Strain) -> Result<(), Failure> {
    let per_time = per_time(simulation, libm::pow(BUILDS_UP * step.largest(), 1.5));
    simulation.drag = DRAG * per_time;
    let whole = step.largest() / (RATE * per_time);
    let growth = step.thermal * (1.0 + simulation.strain());
    let mut done = 0.0;
    while done < 1.0 {
        simulation.choose_time_step(StepChoice::Adaptive { safety: SAFETY })?;
        let left = ((1.0 - done) * whole / simulation.time_step).ceil().max(1.0);
        let part = (1.0 - done) / left;
        let per_time = part / simulation.time_step;
        simulation.set_strain_rate(growth * per_time);
        let steps = (left as u64).min(LOOK_EVERY);
        for _ in 0..steps {
            simulation.set_velocity_gradient(gradient(step, done, per_time));
            simulation.step();
            done += part;
        }
        simulation.check()?;
        if steps as f64 == left {
            break;
        }
    }
    simulation.set_strain_rate(0.0);
    simulation.set_velocity_gradient([[0.0; 3]; 3]);
    Ok(())
}

/// Velocity gradient with which the box moves on from F = 1 + `done` H to 1 + (`done` + dt `per_time`) H in one step:
/// `per_time` H F⁻¹.
fn gradient(step: Strain, done: f64, per_time: f64) -> Matrix {
    let [x, y, z, xy, xz, yz] = over(step.stretch, step.times(done).stretch);
    [[x, xy, xz], [0.0, y, yz], [0.0, 0.0, z]].map(|row| row.map(|part| per_time * part))
}

/// Runs until the forces balance. `since`: step count at which the load was changed.
///
/// # Errors
/// The [`Failure`] of a run.
pub fn rest(simulation: &mut Simulation, since: u64) -> Result<Settled, Failure> {
    let (end, mut unloaded) = (simulation.steps + MAX_STEPS, 0);
    loop {
        simulation.drag = DRAG * per_time(simulation, UNJAMMED_PRESSURE);
        simulation.run(LOOK_EVERY)?;
        let unbalanced = unbalanced_force(simulation);
        let carries_load = pressure(simulation) >= UNJAMMED_PRESSURE;
        unloaded = if carries_load { 0 } else { unloaded + LOOK_EVERY };
        let outcome = match carries_load {
            true if unbalanced < BALANCED => Outcome::Settled,
            true if simulation.steps >= end => Outcome::Capped,
            false if unloaded >= MAX_UNJAMMED || simulation.steps >= end => Outcome::Unjammed,
            _ => continue,
        };
        simulation.drag = 0.0;
        return Ok(Settled { outcome, steps: simulation.steps - since, unbalanced });
    }
}

/// √(p/ρ)/d with a pressure of `least` at least \[1/s\].
fn per_time(simulation: &Simulation, least: f64) -> f64 {
    let pressure = pressure(simulation).max(least);
    (pressure / simulation.material.density).sqrt() / (2.0 * simulation.mean_radius())
}

/// p = tr σ/3 \[Pa\].
pub(super) fn pressure(simulation: &Simulation) -> f64 {
    mean(&stress(simulation))
}

/// Mean |resultant of the contact forces| over the spheres / (mean normal contact force + floor) \[-\].
pub fn unbalanced_force(simulation: &Simulation) -> f64 {
    let mut resultant = vec![[0.0f64; 3]; simulation.spheres.len()];
    let (mut sum, mut count) = (0.0, 0.0f64);
    simulation.for_each_contact(|contact| {
        let force = contact.force();
        resultant[contact.j] = plus(resultant[contact.j], 1.0, force);
        if let Partner::Sphere(i) = contact.i {
            resultant[i] = plus(resultant[i], -1.0, force);
        }
        sum += contact.normal_force;
        count += 1.0;
    });
    let mean = resultant.iter().map(|force| length(*force)).sum::<f64>() / resultant.len() as f64;
    let diameter = 2.0 * simulation.mean_radius();
    mean / (sum / count.max(1.0) + FORCE_FLOOR * diameter * diameter)
}
