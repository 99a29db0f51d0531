//! One grain.

use msdd_engine::Grain;
use std::f64::consts::PI;

/// Fields of a group of spheres, one vector per field, one lane per sphere: x, y, z, radius; vx, vy, vz, mass; and the
/// three components of the angular velocity.
pub(crate) type Columns<V> = [V; 11];

/// A sphere. It fills two cache lines; all that the contact law needs is in the first line and a half.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(C, align(64))]
pub struct Sphere {
    /// x \[m\] of the centre.
    pub position: [f64; 3],
    /// Current radius \[m\].
    pub radius: f64,
    /// v [m/s]; in a periodic box relative to the flow of the cell.
    pub velocity: [f64; 3],
    /// m = 4/3 π ρ r₀³ \[kg\]: constant while the radius changes.
    pub mass: f64,
    /// ω [rad/s].
    pub angular_velocity: [f64; 3],
    /// T \[K\].
    pub temperature: f64,
    /// Radius at zero strain \[m\].
    pub reference_radius: f64,
    /// Padding up to two cache lines; has no meaning.
    pub(crate) spare: [f64; 3],
}

impl Sphere {
    /// A sphere at rest at 0 K; mass from `density` [kg/m³] and `radius` \[m\].
    pub fn at_rest(position: [f64; 3], radius: f64, density: f64) -> Self {
        Self {
            position,
            radius,
            velocity: [0.0; 3],
            mass: density * 4.0 / 3.0 * PI * radius * radius * radius,
            angular_velocity: [0.0; 3],
            temperature: 0.0,
            reference_radius: radius,
            spare: [0.0; 3],
        }
    }

    /// Sets all velocities to zero.
    pub fn stop(&mut self) {
        (self.velocity, self.angular_velocity) = ([0.0; 3], [0.0; 3]);
    }

    /// I = 2/5 m r² [kg m²].
    pub fn inertia(&self) -> f64 {
        0.4 * self.mass * self.radius * self.radius
    }

    /// ½ m v² + ½ I ω² \[J\].
    pub fn kinetic_energy(&self) -> f64 {
        let square = |[x, y, z]: [f64; 3]| x * x + y * y + z * z;
        0.5 * (self.mass * square(self.velocity) + self.inertia() * square(self.angular_velocity))
    }

    /// 4/3 π r³ \[m³\].
    pub fn volume(&self) -> f64 {
        4.0 / 3.0 * PI * self.radius * self.radius * self.radius
    }
}

impl Grain<3> for Sphere {
    #[inline(always)]
    fn centre(&self) -> [f64; 3] {
        self.position
    }
    #[inline(always)]
    fn radius(&self) -> f64 {
        self.radius
    }
    #[inline(always)]
    fn at(self, position: [f64; 3]) -> Self {
        Self { position, ..self }
    }
}
