//! What runs need to know of spheres: regular checks of the state, the choice of the time step, copies of good states.

use crate::contact::Partner;
use crate::failure::{Failure, LARGEST_OVERLAP, LARGEST_STRIDE};
use crate::simulation::Simulation;
use crate::space::length;
use crate::time_step::StepChoice;
use msdd_engine::grain::largest_radius;
use msdd_engine::run::{self, Assembly, LastGood, Threads};

impl Assembly for Simulation {
    type Failure = Failure;

    fn steps(&self) -> u64 {
        self.steps
    }

    fn take_step(&mut self, shared: bool) {
        self.step_shared(shared);
    }

    fn watch_time_step(&mut self) -> Result<(), Failure> {
        Self::watch_time_step(self)
    }

    fn check(&self) -> Result<(), Failure> {
        Self::check(self)
    }

    fn may_be_kept(&self) -> bool {
        true
    }

    fn threads(&mut self) -> &mut Threads {
        &mut self.threads
    }

    fn last_good(&mut self) -> &mut Option<LastGood<Self>> {
        &mut self.last_good
    }
}

impl Simulation {
    /// Takes `steps` steps. The state is checked and the time step is set, as chosen by
    /// [`Simulation::choose_time_step`], after every 50 of them.
    ///
    /// # Errors
    /// The first [`Failure`] found. The simulation is then left in the failed state; for an earlier one see
    /// [`Simulation::keep_last_good`].
    pub fn run(&mut self, steps: u64) -> Result<(), Failure> {
        run::run(self, steps)
    }

    /// Makes [`Simulation::run`] keep a copy of the last good state: first the present one, then at each successful
    /// check that is at least `every` steps after the last copy a new one.
    pub fn keep_last_good(&mut self, every: u64) {
        run::keep_last_good(self, every);
    }

    /// Returns the last copy and stops keeping copies.
    pub fn take_last_good(&mut self) -> Option<Self> {
        self.last_good.take().map(|kept| *kept.state)
    }

    /// Returns an error for states that only a failed run can reach: positions or velocities that are not finite, a
    /// sphere that moves too far in one step, two spheres that overlap too much, a periodic box that is too small.
    ///
    /// # Errors
    /// The first such [`Failure`].
    pub fn check(&self) -> Result<(), Failure> {
        let time = self.time;
        if let Some(cell) = self.boundary.cell() {
            let largest = largest_radius(&self.spheres);
            cell.check(largest).map_err(|problem| Failure::Cell { problem, time })?;
        }
        for (sphere, s) in self.spheres.iter().enumerate() {
            let numbers = s.position.iter().chain(&s.velocity).chain(&s.angular_velocity);
            if !numbers.sum::<f64>().is_finite() {
                return Err(Failure::NonFinite { sphere, time });
            }
            let ratio = length(s.velocity) * self.time_step / s.radius;
            if ratio > LARGEST_STRIDE {
                return Err(Failure::Speed { sphere, ratio, time });
            }
        }
        let mut worst: Option<Failure> = None;
        self.for_each_contact(|contact| {
            if let Partner::Sphere(i) = contact.i {
                let ratio = 2.0 * contact.overlap / (self.spheres[i].radius + self.spheres[contact.j].radius);
                if ratio > LARGEST_OVERLAP && worst.is_none() {
                    worst = Some(Failure::Overlap { i, j: contact.j, ratio, time });
                }
            }
        });
        worst.map_or(Ok(()), Err)
    }

    /// Chooses how [`Simulation::run`] sets the time step.
    ///
    /// # Errors
    /// A fixed step above the present stability bound, when the choice is [`msdd_engine::Excess::Refuse`].
    pub fn choose_time_step(&mut self, choice: StepChoice) -> Result<(), Failure> {
        self.step_choice = choice;
        self.watch_time_step()
    }

    /// Applies the choice of time step to the present contacts.
    pub(crate) fn watch_time_step(&mut self) -> Result<(), Failure> {
        let bound = self.stable_step();
        match (self.step_choice.step(bound), self.step_choice) {
            (Some(step), _) => self.time_step = step,
            (None, StepChoice::Fixed { step, .. } | StepChoice::Adaptive { safety: step }) => {
                return Err(Failure::TimeStep { step, bound, time: self.time });
            }
        }
        Ok(())
    }
}
