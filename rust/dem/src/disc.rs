//! One grain.

use msdd_engine::Grain;
use std::f64::consts::PI;

/// Fields of a group of discs: one vector per field, one lane per disc, in the order of [`Disc`].
pub(crate) type Columns<V> = [V; 8];

/// A disc (cylinder of 1 m length). It fills one cache line, so that the contact loop reads all it needs of a partner
/// in one load.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(C, align(64))]
pub struct Disc {
    /// Centre \[m\].
    pub x: f64,
    pub y: f64,
    /// Current radius \[m\].
    pub radius: f64,
    /// Velocity [m/s].
    pub vx: f64,
    pub vy: f64,
    /// ω [rad/s], counter-clockwise.
    pub angular_velocity: f64,
    /// m = ρ π r₀² · 1 m \[kg\]: constant while the radius changes.
    pub mass: f64,
    /// T \[K\].
    pub temperature: f64,
}

impl Disc {
    /// A disc at rest at 0 K; mass from `density` [kg/m³] and `radius` \[m\].
    pub fn at_rest(x: f64, y: f64, radius: f64, density: f64) -> Self {
        Self {
            x,
            y,
            radius,
            vx: 0.0,
            vy: 0.0,
            angular_velocity: 0.0,
            mass: density * PI * radius * radius,
            temperature: 0.0,
        }
    }

    /// Sets all velocities to zero.
    pub fn stop(&mut self) {
        (self.vx, self.vy, self.angular_velocity) = (0.0, 0.0, 0.0);
    }

    /// |v| [m/s].
    pub fn speed(&self) -> f64 {
        (self.vx * self.vx + self.vy * self.vy).sqrt()
    }

    /// Area of the disc, π r² \[m²\].
    pub fn area(&self) -> f64 {
        PI * self.radius * self.radius
    }
}

impl Grain<2> for Disc {
    #[inline(always)]
    fn centre(&self) -> [f64; 2] {
        [self.x, self.y]
    }
    #[inline(always)]
    fn radius(&self) -> f64 {
        self.radius
    }
    #[inline(always)]
    fn at(self, [x, y]: [f64; 2]) -> Self {
        Self { x, y, ..self }
    }
}
