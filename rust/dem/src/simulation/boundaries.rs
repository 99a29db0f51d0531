//! The first stage of a step, before the forces: motion of walls, cell and radii, and affine motion of the discs.

use super::Simulation;
use crate::walls::Flow;

impl Simulation {
    /// Moves walls and cell and sets the radii, to their values at the end of the step.
    pub(super) fn advance_boundaries(&mut self) {
        let dt = self.time_step;
        self.strain += self.strain_rate * dt;
        let growth = self.advance_radii();
        self.carry_discs();
        if let Some(periodic) = &mut self.periodic {
            periodic.advance(&self.walls, dt);
            self.walls.advance(dt);
            let [xx, yy, xy] = self.flow().gradient;
            self.neighbours.skin.record_flow((xx * xx + yy * yy + xy * xy).sqrt(), dt);
            self.neighbours.skin.record_motion(self.largest_speed, 0.0, growth / dt, dt);
            return;
        }
        self.walls.advance(dt);
        let wall_speed = self.walls.largest_speed();
        // The affine motion moves discs at most as fast as the walls.
        let speed = self.largest_speed + if self.affine { wall_speed } else { 0.0 };
        self.neighbours.skin.record_motion(speed, wall_speed, growth / dt, dt);
    }

    /// The affine motion that carries the grains along in this step.
    pub(crate) fn flow(&self) -> Flow {
        match &self.periodic {
            Some(periodic) => self.walls.sheared_flow(periodic.shear_rate),
            None if self.affine => self.walls.flow(),
            None => Flow::NONE,
        }
    }

    fn carry_discs(&mut self) {
        let flow = self.flow();
        if flow != Flow::NONE {
            let dt = self.time_step;
            for disc in &mut self.discs {
                let [ux, uy] = flow.at(disc.x, disc.y);
                disc.x += dt * ux;
                disc.y += dt * uy;
            }
        }
    }

    /// Sets the radii from strain and temperature; returns the largest growth [m].
    fn advance_radii(&mut self) -> f64 {
        let factor = 1.0 + self.strain;
        match &self.pipes {
            Some(pipes) if pipes.thermal.expansion != 0.0 => {
                let mut growth = 0.0f64;
                let references = self.reference_radius.iter().zip(&pipes.reference_temperature);
                for (disc, (radius, temperature)) in self.discs.iter_mut().zip(references) {
                    let thermal = pipes.thermal.expansion * (disc.temperature - temperature);
                    let radius = radius * (factor + thermal);
                    let grown = radius - disc.radius;
                    growth = if grown > growth { grown } else { growth };
                    disc.radius = radius;
                }
                growth
            }
            // The sweep sets these radii, or the neighbour search when it runs.
            _ if self.strain_rate != 0.0 => {
                (self.strain_rate * self.time_step * self.largest_reference_radius).max(0.0)
            }
            _ => 0.0,
        }
    }

    /// Sets the radii when they depend on the strain rate alone.
    pub(super) fn scale_radii(&mut self) {
        if let Some(factor) = self.radius_factor() {
            for (disc, radius) in self.discs.iter_mut().zip(&self.reference_radius) {
                disc.radius = radius * factor;
            }
        }
    }

    /// Radii over reference radii when they depend on the strain rate alone; else none.
    pub(super) fn radius_factor(&self) -> Option<f64> {
        let by_heat = self.pipes.as_ref().is_some_and(|pipes| pipes.thermal.expansion != 0.0);
        (self.strain_rate != 0.0 && !by_heat).then_some(1.0 + self.strain)
    }
}
