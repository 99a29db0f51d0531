//! Energy of an assembly, and where the work done on it goes.
//!
//! Between two states the stored energy grows by the work of the walls, less what damping, drag and friction take away. The
//! table lists the terms of one step. v and v' are the velocities of j relative to i at the contact (or of a sphere) before
//! and after the step, an overline is their mean; u = v_t Δt is the slip over the step; f_t° is the friction that the
//! contact remembers from the step before, after it was turned and scaled, and f_t' the new one.
//!
//! | term | one step |
//! |---|---|
//! | damping | −f_d · v̄ Δt, with the part f_d of the contact force that is neither elastic nor remembered |
//! | drag | the kinetic energy that is taken away |
//! | sliding | −½ (f_t° + f_t') · (u + (f_t' − f_t°)/k_t): the friction times the plastic slip |
//! | resizing | what a friction spring loses as its contact gets larger or smaller or opens: ½ f_t²/k_t before less ½ f_t°²/k_t after |
//! | walls | mean force of this step and the one before on the spheres times the wall's velocity Δt |
//!
//! All losses are at least 0, up to round-off. Kinetic energy is accounted for exactly; the work of the elastic forces is
//! taken by the trapezoidal rule, as explained for discs (`msdd_dem::audit`); the error of the balance falls with Δt. Boxes that deform, spheres and cylinders that grow are not audited.

use crate::contact::{Contact, Partner};
use crate::law::{self, History, Touch};
use crate::simulation::Simulation;
use crate::space::{cross, dot, minus, plus, scaled};
use crate::sphere::Sphere;

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

/// Work and losses since [`EnergyAudit::new`] \[J\], and the energy stored then.
#[derive(Clone, Debug, PartialEq)]
pub struct EnergyAudit {
    /// Lost to damping in contacts.
    pub damping: f64,
    /// Lost to [`Simulation::drag`].
    pub drag: f64,
    /// Lost in sliding contacts.
    pub sliding: f64,
    /// Lost by friction springs whose contacts change in size or open.
    pub resizing: f64,
    /// Work of the walls on the spheres.
    pub walls: f64,
    stored: f64,
    /// Force on each wall in the last step, none before the first.
    wall_force: Option<Vec<[f64; 3]>>,
}

impl EnergyAudit {
    /// Starts the audit at the present state.
    pub fn new(simulation: &Simulation) -> Self {
        Self {
            damping: 0.0,
            drag: 0.0,
            sliding: 0.0,
            resizing: 0.0,
            walls: 0.0,
            stored: simulation.synchronised_energy(),
            wall_force: None,
        }
    }

    /// All losses \[J\].
    pub fn lost(&self) -> f64 {
        self.damping + self.drag + self.sliding + self.resizing
    }

    /// Work done on the spheres, less all losses, less the increase of the stored energy since the start \[J\]: 0 up to
    /// the error of the time integration.
    pub fn residual(&self, simulation: &Simulation) -> f64 {
        self.walls - self.lost() - (simulation.synchronised_energy() - self.stored)
    }

    /// Adds the work of the walls, with the mean of the forces of this step and the one before.
    fn add_walls(&mut self, simulation: &Simulation) {
        let walls = simulation.boundary.walls().iter().zip(&simulation.wall_force);
        for (number, (wall, &force)) in walls.enumerate() {
            let last = self.wall_force.as_ref().map_or(force, |forces| forces[number]);
            let mean = scaled(0.5, plus(force, 1.0, last));
            self.walls -= dot(mean, wall.velocity) * simulation.time_step;
        }
        self.wall_force = Some(simulation.wall_force.clone());
    }
}

/// Velocity of j relative to i at the contact.
fn velocity(simulation: &Simulation, spheres: &[Sphere], contact: &Contact) -> [f64; 3] {
    let of_j = &spheres[contact.j];
    match contact.i {
        Partner::Wall(wall) => {
            let arm = of_j.radius - contact.overlap;
            let wall = &simulation.boundary.walls()[wall];
            let apart = minus(of_j.velocity, wall.velocity_at(of_j.position, contact.normal));
            minus(apart, cross(scaled(arm, of_j.angular_velocity), contact.normal))
        }
        Partner::Sphere(i) => {
            let of_i = &spheres[i];
            let arms = [of_i.radius - 0.5 * contact.overlap, of_j.radius - 0.5 * contact.overlap];
            let spin = plus(scaled(arms[0], of_i.angular_velocity), arms[1], of_j.angular_velocity);
            minus(minus(of_j.velocity, of_i.velocity), cross(spin, contact.normal))
        }
    }
}

fn friction([x, y, z, _]: History) -> [f64; 3] {
    [x, y, z]
}

impl Simulation {
    /// Kinetic energy \[J\]; in a periodic box that of the motion relative to the flow.
    pub fn kinetic_energy(&self) -> f64 {
        self.spheres.iter().map(Sphere::kinetic_energy).sum()
    }

    /// The energy stored now. Velocities are those half a step before the positions (leapfrog), so the total of an
    /// elastic system oscillates by a part that is proportional to the time step.
    pub fn energy(&self) -> Energy {
        let law = self.law();
        let mut energy = Energy { kinetic: self.kinetic_energy(), ..Energy::default() };
        self.touching().for_each_candidate(|contact| {
            let [x, y, z, a] = contact.history;
            energy.normal += law.energy(contact.overlap, contact.effective_radius, [0.0; 3])[0];
            // A contact that has just opened keeps its friction until the next step.
            energy.tangential += law.friction_energy([x, y, z], a);
        });
        energy.potential = -self.spheres.iter().map(|s| s.mass * dot(self.gravity, s.position)).sum::<f64>();
        energy
    }

    /// The stored energy at one time. Velocities are half a step behind the positions, so with the power P of the forces
    /// the kinetic energy is larger by ½ Δt P; friction springs are one step behind, so their energy is smaller by Δt P_t.
    fn synchronised_energy(&self) -> f64 {
        let mut power: f64 = self.spheres.iter().map(|s| s.mass * dot(self.gravity, s.velocity)).sum();
        self.touching().for_each_candidate(|contact| {
            let apart = velocity(self, &self.spheres, &contact);
            power +=
                contact.normal_force * dot(apart, contact.normal) - dot(friction(contact.history), apart);
        });
        self.energy().total() + 0.5 * self.time_step * power
    }

    /// Takes the same step as [`Simulation::step`], bit for bit, and adds its energies to `audit`. Takes several times
    /// as long.
    pub fn step_audited(&mut self, audit: &mut EnergyAudit) {
        let before = self.spheres.clone();
        let mut known = std::collections::HashMap::new();
        for contact in self.state().friction {
            known.insert((contact.i, contact.j, contact.shift), contact.history);
        }
        self.step();
        // The contacts as the step has seen them: spheres before, walls after.
        let after = std::mem::replace(&mut self.spheres, before);
        let (law, dt) = (self.law(), self.time_step);
        self.touching().for_each_candidate(|contact| {
            let key = (contact.i, contact.j, contact.shift);
            let old = known.get(&key).copied().unwrap_or_default();
            let [start, end] = [&self.spheres, &after].map(|spheres| velocity(self, spheres, &contact));
            let a = law.size(contact.overlap, contact.effective_radius);
            let kept = law::kept(contact.normal, a, old);
            audit.resizing += law.friction_energy(friction(old), old[3]) - law.friction_energy(kept, a);
            if a == 0.0 {
                return;
            }
            let new = friction(contact.history);
            let along = plus(start, -dot(start, contact.normal), contact.normal);
            // Without tangential stiffness there is no friction.
            let stiffness = law.tangential * a;
            let elastic = if stiffness > 0.0 { scaled(1.0 / stiffness, minus(kept, new)) } else { [0.0; 3] };
            let plastic = minus(scaled(dt, along), elastic);
            audit.sliding -= 0.5 * dot(plus(kept, 1.0, new), plastic);
            let mass = match contact.i {
                Partner::Wall(_) => after[contact.j].mass,
                Partner::Sphere(i) => {
                    let masses = [after[i].mass, after[contact.j].mass];
                    masses[0] * masses[1] / (masses[0] + masses[1])
                }
            };
            let touch = Touch {
                normal: contact.normal,
                overlap: contact.overlap,
                velocity: start,
                spin: [0.0; 3],
                radius: contact.effective_radius,
                mass,
                friction: law.friction[usize::from(matches!(contact.i, Partner::Wall(_)))],
            };
            let (normal, tangential, _) = law.force(&touch, old);
            let damping = plus(minus(tangential, new), normal - contact.normal_force, contact.normal);
            audit.damping -= 0.5 * dt * dot(damping, plus(start, 1.0, end));
        });
        self.spheres = after;
        audit.add_walls(self);
        let keep = (1.0 - self.drag * dt).max(0.0);
        if keep < 1.0 {
            audit.drag += self.kinetic_energy() * (1.0 / (keep * keep) - 1.0);
        }
    }
}
