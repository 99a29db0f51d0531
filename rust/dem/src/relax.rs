//! Fast relaxation: FIRE (Bitzek et al., Phys. Rev. Lett. 97, 170201, 2006) on the contact forces.
//!
//! The discs do not move as grains would on their way to equilibrium. Masses are replaced by ones that give all discs
//! about the same highest frequency, velocities are turned towards the forces, and all discs are stopped when the power
//! of the forces is negative. Friction keeps its incremental springs, so the force in which a sliding contact ends
//! depends slightly on the path.

use crate::disc::Disc;
use crate::failure::Failure;
use crate::forces::Load;
use crate::simulation::Simulation;
use crate::time_step::{StepChoice, contact_stiffness};
use msdd_engine::fire::{Descent, LARGEST_STEP, LOOK_EVERY, Sums, Turn};
use msdd_engine::vector::larger;

impl Simulation {
    /// Relaxes in fixed walls and with fixed radii for at most `steps` steps, or until `balanced` returns true at a
    /// check. Afterwards the discs are at rest; the steps are counted, but the time is unchanged. Returns whether
    /// `balanced` was reached.
    ///
    /// # Errors
    /// As [`Simulation::run`].
    pub fn relax(&mut self, steps: u64, balanced: impl Fn(&Self) -> bool) -> Result<bool, Failure> {
        let (time, choice, damping, drag) =
            (self.time, self.step_choice, self.material.damping, self.free_drag);
        let masses: Vec<f64> = self.discs.iter().map(|disc| disc.mass).collect();
        (self.material.damping, self.free_drag) = (0.0, 0.0);
        self.discs.iter_mut().for_each(Disc::stop);
        let result = self.descend(steps, balanced);
        (self.time, self.step_choice) = (time, choice);
        (self.material.damping, self.free_drag) = (damping, drag);
        for (disc, mass) in self.discs.iter_mut().zip(masses) {
            disc.stop();
            disc.mass = mass;
        }
        self.largest_speed = 0.0;
        self.watch_time_step()?;
        result
    }

    fn descend(&mut self, steps: u64, balanced: impl Fn(&Self) -> bool) -> Result<bool, Failure> {
        let end = self.steps + steps;
        self.step_choice = StepChoice::Adaptive { safety: LARGEST_STEP };
        let mut descent = Descent::default();
        while self.steps < end {
            self.even_out_masses();
            self.watch_time_step()?;
            descent.limit(self.time_step);
            for _ in 0..LOOK_EVERY.min(end - self.steps) {
                self.time_step = descent.step();
                self.step();
                self.turn(&mut descent);
            }
            self.check()?;
            if balanced(self) {
                return Ok(true);
            }
        }
        Ok(false)
    }

    /// Replaces the masses by ones proportional to the stiffness of each disc's contacts, so that all discs have the
    /// same bound on the time step.
    fn even_out_masses(&mut self) {
        let stiffness = contact_stiffness(&self.touching());
        for (disc, stiffness) in self.discs.iter_mut().zip(stiffness) {
            disc.mass = stiffness;
        }
    }

    /// Turns the velocities towards the forces of the step just taken, or sets them to zero when the power is negative.
    fn turn(&mut self, descent: &mut Descent) {
        let mut sums = Sums::default();
        for (disc, load) in self.discs.iter().zip(self.loads.iter(&self.neighbours)) {
            add(&mut sums, disc, load);
        }
        let Some(Turn { keep, pull }) = descent.turn(sums, self.time_step) else {
            self.discs.iter_mut().for_each(Disc::stop);
            self.largest_speed = 0.0;
            return;
        };
        let mut fastest2 = 0.0f64;
        for (disc, load) in self.discs.iter_mut().zip(self.loads.iter(&self.neighbours)) {
            let per_mass = pull / disc.mass;
            disc.vx = keep * disc.vx + per_mass * load.fx;
            disc.vy = keep * disc.vy + per_mass * load.fy;
            let per_inertia = 2.0 * per_mass / (disc.radius * disc.radius);
            disc.angular_velocity = keep * disc.angular_velocity + per_inertia * load.torque;
            fastest2 = larger(fastest2, disc.vx * disc.vx + disc.vy * disc.vy);
        }
        self.largest_speed = fastest2.sqrt();
    }
}

/// Adds the power, speed and force of one disc.
fn add(sums: &mut Sums, disc: &Disc, load: &Load) {
    let inertia = 0.5 * disc.mass * disc.radius * disc.radius;
    sums.power += load.fx * disc.vx + load.fy * disc.vy + load.torque * disc.angular_velocity;
    sums.speed2 += disc.mass * (disc.vx * disc.vx + disc.vy * disc.vy)
        + inertia * disc.angular_velocity * disc.angular_velocity;
    sums.force2 += (load.fx * load.fx + load.fy * load.fy) / disc.mass + load.torque * load.torque / inertia;
}
