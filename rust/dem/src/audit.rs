//! Energy audit: where the work done on the grains goes.
//!
//! Stored: elastic, Σ ½ s_n δ² + ½ f_t²/s_t, and kinetic with spin, Σ ½ m v² + ¼ m r² ω². Between two states,
//! stored energy grows by the work of walls and of growing radii, less damping, drag and friction.
//!
//! The terms of one step of symplectic Euler, from (x, v, f_t, r) at its start to (x', v', f_t', r') at its end, all
//! with the contact forces of that step, which are taken at x, r' and the moved walls. [δ] is their overlap, u their
//! slip over the step, Δ a change over the step, and an overline the mean of start and end:
//!
//! | term | one step |
//! |---|---|
//! | damping | −f_d · v̄ Δt, f_d = −μ \|f_c\| v/\|v\| |
//! | drag | the kinetic energy that discs without contact force lose |
//! | friction | −f_t' (u + Δf_t/s_t) ≥ 0: the force times the plastic slip; all of f_t when a contact opens |
//! | walls | force of each wall on the grains times its velocity Δt, normal and along the wall |
//! | growth | f_n Δ(r_i + r_j) + ½ δ² Δs_n + ½ f_t² Δ(1/s_t), and ¼ m ω² Δ(r²) of the spin |
//!
//! Kinetic energy is accounted for exactly. What is left over is that the force of a step acts along v̄, while the
//! contacts deform by v' (normal) and v (slip): first order in Δt, and without drift as long as contacts stay closed
//! and stick, for then it adds up to differences between the ends of the run (as symplectic Euler conserves a
//! neighbouring energy).

use crate::contacts::{PairList, WallContacts};
use crate::disc::Disc;
use crate::law::{damping_scale, pair_stiffness, wall_stiffness};
use crate::simulation::Simulation;
use crate::walls::Side;

/// Work and losses since [`EnergyAudit::new`] [J], and the energy stored then.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EnergyAudit {
    /// Lost to the damping force (Table 1).
    pub damping: f64,
    /// Lost to [`Simulation::free_drag`].
    pub drag: f64,
    /// Lost in sliding contacts; never falls.
    pub friction: f64,
    /// Work of the walls on the grains.
    pub walls: f64,
    /// Work of changing radii.
    pub growth: f64,
    stored: f64,
}

/// What a step forgets.
struct Start {
    discs: Vec<Disc>,
    pairs: PairList,
    walls: [WallContacts; 4],
}

/// One candidate contact during a step.
struct Strained {
    /// δ [m]; not positive when open.
    overlap: f64,
    /// s_n [N/m] with the radii at the start and the end of the step.
    stiffness: [f64; 2],
    /// f_t [N] likewise.
    tangential: [f64; 2],
    /// Way of j relative to i along t [m].
    slip: f64,
    /// Growth of the radii together [m].
    growth: f64,
}

impl EnergyAudit {
    pub fn new(simulation: &Simulation) -> Self {
        let stored = simulation.elastic_energy() + simulation.kinetic_energy();
        Self { damping: 0.0, drag: 0.0, friction: 0.0, walls: 0.0, growth: 0.0, stored }
    }

    /// Work done on the grains, less all losses, less what is stored more than at the beginning [J]: 0 up to the
    /// error of the time integration.
    pub fn residual(&self, simulation: &Simulation) -> f64 {
        let gained = simulation.elastic_energy() + simulation.kinetic_energy() - self.stored;
        self.walls + self.growth - self.damping - self.drag - self.friction - gained
    }

    /// |residual| over the work done, |walls| + |growth| [-]; over the energy stored at the beginning when no work was
    /// done.
    pub fn imbalance(&self, simulation: &Simulation) -> f64 {
        let work = self.walls.abs() + self.growth.abs();
        self.residual(simulation).abs() / if work > 0.0 { work } else { self.stored }
    }

    fn add_motion(&mut self, before: &Disc, after: &Disc, force: [f64; 2], damping: f64, dt: f64) {
        // The spin turns on with the inertia of the new radius.
        let spin = before.angular_velocity;
        self.growth +=
            0.25 * before.mass * spin * spin * (after.radius * after.radius - before.radius * before.radius);
        let force2 = force[0] * force[0] + force[1] * force[1];
        if force2 > 0.0 {
            let scale = damping_scale(damping, force2, before.vx * before.vx + before.vy * before.vy);
            let along = before.vx * (before.vx + after.vx) + before.vy * (before.vy + after.vy);
            self.damping += 0.5 * dt * scale * along;
        } else {
            let grown = Disc { radius: after.radius, ..*before };
            self.drag += kinetic_energy(&grown) - kinetic_energy(after);
        }
    }

    fn add_contact(&mut self, contact: &Strained, stiffness_ratio: f64) {
        let &Strained { overlap, stiffness: [old, new], tangential: [before, after], slip, growth } = contact;
        let touching = overlap > 0.0;
        if touching {
            self.growth += overlap * (new * growth + 0.5 * overlap * (new - old));
        }
        if before != 0.0 {
            self.growth += 0.5 * before * before / stiffness_ratio * (1.0 / new - 1.0 / old);
        }
        let compliance = 1.0 / (stiffness_ratio * new);
        if touching && after != 0.0 {
            // Round-off of a sticking contact is no friction.
            self.friction += (-after * (slip + (after - before) * compliance)).max(0.0);
        } else if before != 0.0 {
            self.friction += 0.5 * before * before * compliance;
        }
    }
}

fn kinetic_energy(disc: &Disc) -> f64 {
    let spin = disc.radius * disc.angular_velocity;
    0.5 * disc.mass * (disc.vx * disc.vx + disc.vy * disc.vy + 0.5 * spin * spin)
}

impl Simulation {
    /// Σ ½ m v² + ¼ m r² ω² [J].
    pub fn kinetic_energy(&self) -> f64 {
        self.discs.iter().map(kinetic_energy).sum()
    }

    /// Σ ½ s_n δ² + ½ f_t²/s_t [J].
    pub fn elastic_energy(&self) -> f64 {
        // A contact that opened in the last motion keeps its f_t until the next step, which counts its loss.
        let start = self.start();
        let mut sum = 0.0;
        self.for_each_strained(&start, |contact| {
            let ([_, stiffness], [_, tangential]) = (contact.stiffness, contact.tangential);
            let overlap = contact.overlap.max(0.0);
            sum += 0.5 * stiffness * overlap * overlap;
            if tangential != 0.0 {
                sum += 0.5 * tangential * tangential / (self.material.stiffness_ratio * stiffness);
            }
        });
        sum
    }

    /// [`Simulation::step`], bit for bit, with its energies added to `audit`. Several times as expensive.
    pub fn step_audited(&mut self, audit: &mut EnergyAudit) {
        let start = self.start();
        self.step();
        let ratio = self.material.stiffness_ratio;
        self.for_each_strained(&start, |contact| audit.add_contact(&contact, ratio));
        let dt = self.time_step;
        for ((before, after), load) in start.discs.iter().zip(&self.discs).zip(&self.loads) {
            audit.add_motion(before, after, [load.fx, load.fy], self.material.damping, dt);
        }
        audit.walls += dt * self.wall_power();
    }

    fn start(&self) -> Start {
        Start {
            discs: self.discs.clone(),
            pairs: self.neighbours.pairs.clone(),
            walls: self.neighbours.walls.clone(),
        }
    }

    /// Power of the walls on the grains in the last step [W].
    fn wall_power(&self) -> f64 {
        let power = |side: Side| {
            let ([nx, ny], [vx, vy]) = (side.normal(), self.walls.velocity(side));
            let [outwards, along] = self.wall_force[side as usize];
            outwards * (nx * vx + ny * vy) - along * (nx * vy - ny * vx)
        };
        Side::ALL.into_iter().map(power).sum()
    }

    /// Calls `visit` with every candidate contact as the step saw it that began at `start` and ended at `self`:
    /// centres and velocities of the start, radii and walls of the end.
    fn for_each_strained(&self, start: &Start, mut visit: impl FnMut(Strained)) {
        let (young_modulus, dt) = (self.material.young_modulus, self.time_step);
        let pairs = &self.neighbours.pairs;
        for (k, (&i, &j)) in pairs.i().iter().zip(pairs.j()).enumerate() {
            let ([a, b], [ra, rb]) =
                ([i, j].map(|d| &start.discs[d as usize]), [i, j].map(|d| self.discs[d as usize].radius));
            let (dx, dy) = (b.x - a.x, b.y - a.y);
            let distance = (dx * dx + dy * dy).sqrt();
            let overlap = ra + rb - distance;
            let arms = (ra - 0.5 * overlap) * a.angular_velocity + (rb - 0.5 * overlap) * b.angular_velocity;
            let speed = ((b.vy - a.vy) * dx - (b.vx - a.vx) * dy) / distance - arms;
            visit(Strained {
                overlap,
                stiffness: [
                    pair_stiffness(young_modulus, a.radius, b.radius),
                    pair_stiffness(young_modulus, ra, rb),
                ],
                tangential: [start.pairs.tangential_of(i as usize, j), pairs.tangential[k]],
                slip: speed * dt,
                growth: (ra - a.radius) + (rb - b.radius),
            });
        }
        for side in Side::ALL {
            self.for_each_strained_at(side, start, &mut visit);
        }
    }

    fn for_each_strained_at(&self, side: Side, start: &Start, visit: &mut impl FnMut(Strained)) {
        let (young_modulus, factor) = (self.material.young_modulus, self.material.wall_stiffness_factor);
        let ([nx, ny], [wall_vx, wall_vy]) = (side.normal(), self.walls.velocity(side));
        let contacts = &self.neighbours.walls[side as usize];
        for (&i, &tangential) in contacts.disc.iter().zip(&contacts.tangential) {
            let (disc, radius) = (&start.discs[i as usize], self.discs[i as usize].radius);
            let distance = self.walls.distance(side, disc.x, disc.y);
            let speed =
                (disc.vy - wall_vy) * nx - (disc.vx - wall_vx) * ny - distance * disc.angular_velocity;
            visit(Strained {
                overlap: radius - distance,
                stiffness: [disc.radius, radius].map(|r| wall_stiffness(young_modulus, factor, r)),
                tangential: [start.walls[side as usize].tangential_of(i), tangential],
                slip: speed * self.time_step,
                growth: radius - disc.radius,
            });
        }
    }
}
