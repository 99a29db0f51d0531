//! What runs need to know of discs: regular checks of the state, the choice of the time step, copies of good states.

use crate::failure::{Failure, LARGEST_OVERLAP, LARGEST_STRIDE};
use crate::periodic::check_size;
use crate::simulation::Simulation;
use crate::time_step::StepChoice;
use msdd_engine::run::{self, Assembly, LastGood, Threads};

impl Assembly for Simulation {
    type Failure = Failure;

    fn steps(&self) -> u64 {
        self.steps
    }

    fn take_step(&mut self, shared: bool) {
        self.shared = shared;
        self.step();
        self.shared = false;
    }

    fn watch_time_step(&mut self) -> Result<(), Failure> {
        Self::watch_time_step(self)
    }

    fn check(&self) -> Result<(), Failure> {
        Self::check(self)
    }

    fn may_be_kept(&self) -> bool {
        self.centres_are_inside()
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
    /// check that is at least `every` steps after the last copy a new one. A copy costs about as much as a step.
    pub fn keep_last_good(&mut self, every: u64) {
        run::keep_last_good(self, every);
    }

    /// Returns the last copy and stops keeping copies.
    pub fn take_last_good(&mut self) -> Option<Simulation> {
        self.last_good.take().map(|kept| *kept.state)
    }

    /// Whether the centres of all discs are between the walls. A run continues when they are not, which occurs in
    /// packings of 6 % porosity. But readers of state files refuse such a state, so it is not kept as the last good
    /// one.
    fn centres_are_inside(&self) -> bool {
        let mut inside = true;
        self.for_each_contact(|contact| {
            inside &= contact.i.is_ok() || contact.overlap < self.discs[contact.j].radius;
        });
        inside
    }

    /// Returns an error for states that only a failed run can reach: positions or velocities that are not finite, a
    /// disc that moves too far in one step, two discs that overlap too much, a periodic box that is too small for its
    /// discs.
    pub fn check(&self) -> Result<(), Failure> {
        let time = self.time;
        if self.periodic.is_some() {
            let largest = self.discs.iter().map(|d| d.radius).fold(0.0, f64::max);
            check_size(&self.walls, largest).map_err(|problem| Failure::Cell { problem, time })?;
        }
        for (disc, d) in self.discs.iter().enumerate() {
            if !(d.x + d.y + d.vx + d.vy + d.angular_velocity).is_finite() {
                return Err(Failure::NonFinite { disc, time });
            }
            let ratio = d.speed() * self.time_step / d.radius;
            if ratio > LARGEST_STRIDE {
                return Err(Failure::Speed { disc, ratio, time });
            }
        }
        let mut worst: Option<Failure> = None;
        self.for_each_contact(|contact| {
            if let Ok(i) = contact.i {
                let ratio = 2.0 * contact.overlap / (self.discs[i].radius + self.discs[contact.j].radius);
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
    /// A fixed step above the present stability bound, when the choice is
    /// [`Excess::Refuse`](crate::time_step::Excess::Refuse).
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
