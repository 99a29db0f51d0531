//! Heat of a simulation: turned on, resumed, conducted.

use super::Simulation;
use crate::contact::Touching;
use crate::heat::{HeatPipes, HeatState, Thermal, WallHeat};

impl Simulation {
    /// Turns heat on: pipes between touching discs and to the walls; the present radii belong to the present
    /// temperatures, and follow r = r_ref (1 + α (T − T_ref)) from now on (Eqs. 6 and 7, not compounded).
    pub fn enable_heat(&mut self, thermal: Thermal, walls: [WallHeat; 4]) {
        self.reset_strain();
        self.pipes = Some(Box::new(HeatPipes::new(thermal, walls, &self.discs)));
    }

    /// Turns heat on where an earlier run stood; radii, reference radii and temperatures are those of its state.
    ///
    /// # Panics
    /// When `state` has not one value a disc.
    pub fn resume_heat(&mut self, thermal: Thermal, walls: [WallHeat; 4], state: HeatState) {
        let lengths = [state.reference_temperature.len(), state.mode.len()];
        assert_eq!(lengths, [self.discs.len(); 2], "one value a disc");
        let mut pipes = HeatPipes::new(thermal, walls, &self.discs);
        pipes.set_state(state);
        self.pipes = Some(Box::new(pipes));
    }

    /// What the walls do to heat from now on; nothing when heat is off.
    pub fn set_wall_heat(&mut self, walls: [WallHeat; 4]) {
        if let Some(pipes) = &mut self.pipes {
            pipes.walls = walls;
        }
    }

    /// The heat pipes, when heat is on.
    pub fn heat(&self) -> Option<&HeatPipes> {
        self.pipes.as_deref()
    }

    /// Conducts heat over `dt` [s] on the present geometry, without motion; nothing when heat is off.
    pub fn conduct(&mut self, dt: f64) {
        self.conduct_through(dt, |pipes, touching, _| pipes.connect(touching));
    }

    /// One explicit Euler step of heat, however long, through the pipes of the last [`Simulation::conduct`]: to find
    /// out where it turns unstable.
    pub fn conduct_once(&mut self, dt: f64) {
        if let Some(pipes) = &mut self.pipes {
            pipes.take_substeps(false, &mut self.discs, 1, dt);
        }
    }

    pub(super) fn conduct_through(&mut self, dt: f64, update: fn(&mut HeatPipes, &Touching, parallel: bool)) {
        if let Some(mut pipes) = self.pipes.take() {
            update(&mut pipes, &self.touching(), self.shared);
            pipes.conduct(self.shared, &mut self.discs, dt);
            self.pipes = Some(pipes);
        }
    }
}
