//! The part of a state file besides discs, walls and friction history that a run needs to continue bit for bit.

use crate::periodic::{Image, Shift};
use crate::simulation::Simulation;
use crate::walls::Side;
use msdd_engine::lattice::{forward, index_of};

/// Time, strain and radii at which a run continues.
#[derive(Clone, Debug, PartialEq)]
pub struct RunState {
    /// t \[s\].
    pub time: f64,
    pub steps: u64,
    /// Δt \[s\] of the next step.
    pub time_step: f64,
    /// ε [-] and dε/dt [1/s], relative to the reference radii.
    pub strain: f64,
    pub strain_rate: f64,
    /// Radii at ε = 0 \[m\], one per disc.
    pub reference_radius: Vec<f64>,
}

impl Simulation {
    pub fn run_state(&self) -> RunState {
        RunState {
            time: self.time,
            steps: self.steps,
            time_step: self.time_step,
            strain: self.strain,
            strain_rate: self.strain_rate,
            reference_radius: self.reference_radius.clone(),
        }
    }

    /// Sets time, strain and radii to those of `state`.
    ///
    /// # Panics
    /// When the number of reference radii is not that of the discs.
    pub fn set_run_state(&mut self, state: RunState) {
        assert_eq!(state.reference_radius.len(), self.discs.len(), "one reference radius a disc");
        self.time = state.time;
        self.steps = state.steps;
        self.time_step = state.time_step;
        self.strain = state.strain;
        self.strain_rate = state.strain_rate;
        self.set_reference_radii(state.reference_radius);
    }

    /// Sets the stored tangential force of a contact \[N\]: `i` a disc or a wall, `j` a disc. It is the force on j along
    /// t, which is the same number whichever of two discs is called i. Returns false when the two are not near each
    /// other.
    pub fn set_tangential_force(&mut self, i: Result<usize, Side>, j: usize, force: f64) -> bool {
        match i {
            Ok(i) => self.set_tangential_force_across(i, j, [0, 0], force),
            Err(side) => self.neighbours.walls[side as usize].set_tangential(j as u32, force),
        }
    }

    /// As [`Simulation::set_tangential_force`], for disc i and the image of j by `shift` in a periodic box.
    pub fn set_tangential_force_across(&mut self, i: usize, j: usize, shift: Shift, force: f64) -> bool {
        let (i, j) = (i as u32, j as u32);
        let [a, b] = shift;
        let (i, image) = if forward(i, j, shift) {
            (i, Image { owner: j, shift })
        } else {
            (j, Image { owner: i, shift: [-a, -b] })
        };
        let index = index_of(&image, self.discs.len(), &self.neighbours.ghosts);
        index.is_some_and(|index| self.neighbours.pairs.set_tangential(i as usize, index, force))
    }
}
