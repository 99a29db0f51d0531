//! All that a run needs to continue bit for bit.

use crate::boundary::{Boundary, Cell, SmallCell};
use crate::contact::Partner;
use crate::law::History;
use crate::material::Material;
use crate::simulation::Simulation;
use crate::sphere::Sphere;
use msdd_engine::Image;
use msdd_engine::lattice::{forward, index_of};

/// Friction history of one contact, on j; `shift` is that of j's image in a periodic box.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Friction {
    pub i: Partner,
    pub j: usize,
    pub shift: [i32; 3],
    pub history: History,
}

/// State of a [`Simulation`] between two steps. Instruction set, threads and the choice of the time step are not part
/// of it.
#[derive(Clone, Debug, PartialEq)]
pub struct State {
    pub material: Material,
    pub spheres: Vec<Sphere>,
    pub boundary: Boundary,
    /// [m/s²]
    pub gravity: [f64; 3],
    /// [1/s]
    pub drag: f64,
    /// t \[s\] and Δt \[s\] of the next step.
    pub time: f64,
    pub time_step: f64,
    pub steps: u64,
    /// ε of the radii \[-\], and its rate \[1/s\].
    pub strain: f64,
    pub strain_rate: f64,
    pub friction: Vec<Friction>,
}

impl Simulation {
    pub fn state(&self) -> State {
        let mut friction = Vec::new();
        self.touching().for_each_candidate(|contact| {
            let (i, j, shift, history) = (contact.i, contact.j, contact.shift, contact.history);
            if history != [0.0; 4] {
                friction.push(Friction { i, j, shift, history });
            }
        });
        State {
            material: self.material.clone(),
            spheres: self.spheres.clone(),
            boundary: self.boundary.clone(),
            gravity: self.gravity,
            drag: self.drag,
            time: self.time,
            time_step: self.time_step,
            steps: self.steps,
            strain: self.strain,
            strain_rate: self.strain_rate,
            friction,
        }
    }

    /// A simulation that continues from a state.
    ///
    /// # Errors
    /// [`SmallCell`] when a sphere could touch two images of another one.
    pub fn from_state(state: State) -> Result<Self, SmallCell> {
        let mut simulation = Self::new(state.material, state.spheres, state.boundary)?;
        (simulation.gravity, simulation.drag) = (state.gravity, state.drag);
        (simulation.time, simulation.steps) = (state.time, state.steps);
        (simulation.strain, simulation.strain_rate) = (state.strain, state.strain_rate);
        simulation.time_step = state.time_step;
        for friction in state.friction {
            simulation.set_history(friction);
        }
        Ok(simulation)
    }

    /// Sets the friction history of a contact. Returns false when the two are not near each other.
    pub fn set_history(&mut self, friction: Friction) -> bool {
        let Friction { i, j, shift, history } = friction;
        match i {
            Partner::Wall(wall) => self
                .neighbours
                .walls
                .get_mut(wall)
                .is_some_and(|contacts| contacts.set_history(j as u32, history)),
            Partner::Sphere(i) => {
                let (mut i, mut image, mut history) = (i as u32, Image { owner: j as u32, shift }, history);
                if !forward(i, image.owner, shift) {
                    (i, image) = (image.owner, Image { owner: i, shift: shift.map(|number| -number) });
                    let [x, y, z, a] = history;
                    history = [-x, -y, -z, a];
                }
                let index = index_of(&image, self.spheres.len(), &self.neighbours.ghosts);
                let pair = index.and_then(|index| self.neighbours.pairs.rows.find(i as usize, index));
                pair.map(|k| self.neighbours.pairs.set_history(k, history)).is_some()
            }
        }
    }

    /// The cell of a periodic box; none between walls.
    pub fn cell(&self) -> Option<&Cell> {
        self.boundary.cell()
    }
}
