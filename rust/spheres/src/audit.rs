//! Energy of an assembly, and where the work done on it goes.

use crate::simulation::Simulation;
use crate::space::dot;

/// Energy stored in an assembly \[J\].
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Energy {
    /// Σ ½ m v² + ½ I ω².
    pub kinetic: f64,
    /// Of the contacts' normal overlaps: for Hertz's law Σ 8/15 E* a δ².
    pub normal: f64,
    /// Of the friction springs: Σ ½ f_t²/k_t.
    pub tangential: f64,
    /// −Σ m g · x.
    pub potential: f64,
}

impl Energy {
    pub fn total(&self) -> f64 {
        self.kinetic + self.normal + self.tangential + self.potential
    }
}

impl Simulation {
    /// Kinetic energy \[J\]; in a periodic box that of the motion relative to the flow.
    pub fn kinetic_energy(&self) -> f64 {
        let of = |s: &crate::Sphere| {
            s.mass * dot(s.velocity, s.velocity) + s.inertia() * dot(s.angular_velocity, s.angular_velocity)
        };
        0.5 * self.spheres.iter().map(of).sum::<f64>()
    }

    /// The energy stored now. Velocities are those half a step before the positions (leapfrog), so the total of an
    /// elastic system oscillates by a part that is proportional to the time step.
    pub fn energy(&self) -> Energy {
        let law = self.law();
        let mut energy = Energy { kinetic: self.kinetic_energy(), ..Energy::default() };
        self.for_each_contact(|contact| {
            let [normal, tangential] =
                law.energy(contact.overlap, contact.effective_radius, contact.tangential_force());
            energy.normal += normal;
            energy.tangential += tangential;
        });
        energy.potential = -self.spheres.iter().map(|s| s.mass * dot(self.gravity, s.position)).sum::<f64>();
        energy
    }
}
