//! Fast relaxation: FIRE on the contact forces, as for discs.
//!
//! Masses are replaced by ones that give all spheres about the same highest frequency, contacts are not damped, and all
//! spheres are stopped when the power of the forces is negative. Friction keeps its incremental springs, so the force in
//! which a sliding contact ends depends slightly on the path.

use crate::failure::Failure;
use crate::forces::Load;
use crate::simulation::Simulation;
use crate::space::{dot, plus, scaled};
use crate::sphere::Sphere;
use crate::time_step::{StepChoice, contact_stiffness};
use msdd_engine::fire::{Descent, LARGEST_STEP, LOOK_EVERY, Sums, Turn};
use msdd_engine::vector::larger;

impl Simulation {
    /// Relaxes in a fixed box and with fixed radii for at most `steps` steps, or until `balanced` returns true at a
    /// check. Afterwards the spheres are at rest; the steps are counted, but the time is unchanged. Returns whether
    /// `balanced` was reached.
    ///
    /// # Errors
    /// As [`Simulation::run`].
    pub fn relax(&mut self, steps: u64, balanced: impl Fn(&Self) -> bool) -> Result<bool, Failure> {
        let (time, choice) = (self.time, self.step_choice);
        let (drag, restitution) = (self.drag, self.material.restitution);
        let masses: Vec<f64> = self.spheres.iter().map(|sphere| sphere.mass).collect();
        (self.drag, self.material.restitution) = (0.0, 1.0);
        self.spheres.iter_mut().for_each(Sphere::stop);
        self.largest_speed = 0.0;
        self.loads.keep = true;
        let result = self.descend(steps, balanced);
        self.loads.keep = false;
        (self.time, self.step_choice) = (time, choice);
        (self.drag, self.material.restitution) = (drag, restitution);
        for (sphere, mass) in self.spheres.iter_mut().zip(masses) {
            sphere.stop();
            sphere.mass = mass;
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
            let stiffness = contact_stiffness(&self.touching(), 0.0);
            for (sphere, stiffness) in self.spheres.iter_mut().zip(stiffness) {
                sphere.mass = stiffness;
            }
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

    /// Turns the velocities towards the forces of the step just taken, or sets them to zero when the power is negative.
    fn turn(&mut self, descent: &mut Descent) {
        let mut sums = Sums::default();
        for (sphere, load) in self.spheres.iter().zip(self.loads.iter(&self.neighbours)) {
            add(&mut sums, sphere, load);
        }
        let Some(Turn { keep, pull }) = descent.turn(sums, self.time_step) else {
            self.spheres.iter_mut().for_each(Sphere::stop);
            self.largest_speed = 0.0;
            return;
        };
        let mut fastest2 = 0.0f64;
        for (sphere, load) in self.spheres.iter_mut().zip(self.loads.iter(&self.neighbours)) {
            let inertia = sphere.inertia();
            sphere.velocity = plus(scaled(keep, sphere.velocity), pull / sphere.mass, load.force);
            sphere.angular_velocity =
                plus(scaled(keep, sphere.angular_velocity), pull / inertia, load.torque);
            fastest2 = larger(fastest2, dot(sphere.velocity, sphere.velocity));
        }
        self.largest_speed = fastest2.sqrt();
    }
}

/// Adds the power, speed and force of one sphere.
fn add(sums: &mut Sums, sphere: &Sphere, load: &Load) {
    let inertia = sphere.inertia();
    let (velocity, spin) = (sphere.velocity, sphere.angular_velocity);
    sums.power += dot(load.force, velocity) + dot(load.torque, spin);
    sums.speed2 += sphere.mass * dot(velocity, velocity) + inertia * dot(spin, spin);
    sums.force2 += dot(load.force, load.force) / sphere.mass + dot(load.torque, load.torque) / inertia;
}
