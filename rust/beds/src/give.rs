//! Walls that move while a bed is heated: along a given path, under a given pressure, or as the shell of a vessel gives way.
//!
//! A wall that gives way moves as a body of the mass of some layers of grains, pushed by the grains on one side and by what holds it
//! on the other, and stopped by the same drag as the grains; only where it comes to rest counts. A thin shell (thickness t, radius R,
//! Young's modulus E_w) holds with the pressure p₀ + E_w t/R² (u − u_T), where u is what its radius has grown by, u_T = α_w (T − T₀) R is its
//! own expansion, and p₀ the pressure of the grains at the start (Timoshenko & Woinowsky-Krieger, Theory of Plates and Shells, 1959,
//! section 15.1: the hoop alone).

use crate::press::set_speed;
use msdd_spheres::{Simulation, Surface};
use std::f64::consts::PI;

/// Mass of a wall that gives way, in layers of grains.
const LAYERS: f64 = 8.0;

/// What holds a wall that gives way.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Hold {
    /// It is where it is said to be: moved towards the grains by this since the start \[m\].
    Place { moved: f64 },
    /// It presses with this \[Pa\].
    Pressure { pressure: f64 },
    /// A shell.
    Shell {
        /// E_w t/R² \[Pa/m\].
        stiffness: f64,
        /// p₀ \[Pa\].
        at_start: f64,
        /// u_T \[m\].
        grown: f64,
    },
}

/// Drag \[1/s\] over the diameter over the depth of a bed and the time step: near critical for its slowest wave, because a wave of a
/// jammed bed crosses about a thirtieth of a grain in a step.
const DRAG: f64 = 0.05;

/// The drag on grains and walls \[1/s\] that stops a bed of a depth \[m\] soonest.
pub(crate) fn drag(simulation: &Simulation, depth: f64) -> f64 {
    DRAG * 2.0 * simulation.mean_radius() / depth / simulation.time_step
}

/// A wall that moves.
#[derive(Clone, Debug, PartialEq)]
pub struct Moving {
    /// By its number.
    pub wall: usize,
    pub hold: Hold,
    /// Moved towards the grains since the start \[m\].
    pub moved: f64,
    /// Towards the grains \[m/s\].
    speed: f64,
}

/// Area of a wall against a bed \[m²\]; `across` \[m²\] is that of a flat one, `height` \[m\] that of a cylinder.
pub fn wall_area(simulation: &Simulation, wall: usize, across: f64, height: f64) -> f64 {
    match simulation.boundary.walls()[wall].surface {
        Surface::Flat { .. } => across,
        Surface::Cylinder { radius, .. } => 2.0 * PI * radius * height,
    }
}

impl Moving {
    pub fn new(wall: usize, hold: Hold) -> Self {
        Self { wall, hold, moved: 0.0, speed: 0.0 }
    }

    /// Chooses its velocity for the next steps, which take about `dt` \[s\]; `pressure` is that of the grains \[Pa\]. A cylinder is moved at once.
    pub fn steer(&mut self, simulation: &mut Simulation, pressure: f64, dt: f64) {
        let (outside, stiffness) = match self.hold {
            Hold::Place { moved } => {
                self.speed = (moved - self.moved) / dt;
                (f64::NAN, 0.0)
            }
            Hold::Pressure { pressure } => (pressure, 0.0),
            Hold::Shell { stiffness, at_start, grown } => (at_start - stiffness * (self.moved + grown), stiffness),
        };
        if outside.is_finite() {
            let sphere = &simulation.spheres[0];
            let mass = LAYERS * sphere.mass / (4.0 * sphere.radius * sphere.radius);
            // The spring of a shell is taken implicitly.
            let resisting = 1.0 + dt * simulation.drag + dt * dt * stiffness / mass;
            self.speed = (self.speed + dt * (outside - pressure) / mass) / resisting;
        }
        match simulation.boundary.walls()[self.wall].surface {
            Surface::Flat { normal } => set_speed(simulation, self.wall, normal.map(|n| self.speed * n)),
            Surface::Cylinder { radius, .. } => {
                simulation.set_cylinder_radius(self.wall, radius - self.speed * dt);
                self.moved += self.speed * dt;
            }
        }
    }

    /// Notes that a flat wall has moved with its velocity for `elapsed` \[s\].
    pub fn note(&mut self, simulation: &Simulation, elapsed: f64) {
        if let Surface::Flat { .. } = simulation.boundary.walls()[self.wall].surface {
            self.moved += self.speed * elapsed;
        }
    }

    /// Stops it.
    pub fn stop(&mut self, simulation: &mut Simulation) {
        self.speed = 0.0;
        set_speed(simulation, self.wall, [0.0; 3]);
    }
}
