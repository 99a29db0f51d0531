//! Heat of a simulation: turning it on, resuming it from a stored state, conducting it.

use super::Simulation;
use crate::contact::Touching;
use crate::heat::{HeatPipes, HeatState, Thermal, WallHeat};

impl Simulation {
    /// Turns heat on: pipes between touching discs and to the walls. The present radii become the reference radii of
    /// the present temperatures; from now on r = r_ref (1 + α (T − T_ref)) (Eqs. 6 and 7, not compounded).
    pub fn enable_heat(&mut self, thermal: Thermal, walls: [WallHeat; 4]) {
        self.reset_strain();
        self.pipes = Some(Box::new(HeatPipes::new(thermal, walls, &self.discs)));
    }

    /// Turns heat on with the state of an earlier run; radii, reference radii and temperatures must be those of that
    /// run.
    ///
    /// # Panics
    /// When `state` does not have one value per disc.
    pub fn resume_heat(&mut self, thermal: Thermal, walls: [WallHeat; 4], state: HeatState) {
        let lengths = [state.reference_temperature.len(), state.mode.len()];
        assert_eq!(lengths, [self.discs.len(); 2], "one value a disc");
        let mut pipes = HeatPipes::new(thermal, walls, &self.discs);
        pipes.set_state(state);
        self.pipes = Some(Box::new(pipes));
    }

    /// Changes the thermal boundary conditions of the walls; does nothing when heat is off.
    pub fn set_wall_heat(&mut self, walls: [WallHeat; 4]) {
        if let Some(pipes) = &mut self.pipes {
            pipes.walls = walls;
        }
    }

    /// The heat pipes, when heat is on.
    pub fn heat(&self) -> Option<&HeatPipes> {
        self.pipes.as_deref()
    }

    /// Conducts heat over `dt` \[s\] in the present geometry, without motion; does nothing when heat is off.
    pub fn conduct(&mut self, dt: f64) {
        self.conduct_through(dt, |pipes, touching, _| pipes.connect(touching));
    }

    /// Takes one explicit Euler step of heat of any length `dt` \[s\] through the pipes of the last
    /// [`Simulation::conduct`]. Used to measure at which step the scheme turns unstable.
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
