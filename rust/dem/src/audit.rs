//! Energy audit of a run: where the work done on the grains goes.
//!
//! The grains store elastic energy, Σ ½ s_n δ² + ½ f_t²/s_t over the contacts, and kinetic energy including that of
//! spin, Σ ½ m v² + ¼ m r² ω² over the discs. Between two states the stored energy grows by the work of the walls and
//! of the growing radii, less what damping, drag and friction take away.
//!
//! The table lists the terms of one step of symplectic Euler, from (x, v, f_t, r) at its start to (x', v', f_t', r') at
//! its end. The contact forces of a step are those at x, r' and the moved walls. u is the slip over the step and Δ a
//! change over the step. An overline is a mean: of velocities that of start and end, of forces that of the previous
//! step and this one:
//!
//! | term | one step |
//! |---|---|
//! | damping | −f_d · v̄ Δt, f_d = −μ \|f_c\| v/\|v\| |
//! | drag | the kinetic energy that discs without contact force lose |
//! | friction | −f̄_t (u + Δf_t/s_t): the force times the plastic slip; ½ f_t²/s_t when a contact opens |
//! | walls | mean force of each wall on the grains times its velocity Δt, normal and along the wall |
//! | growth | ḡ Δr of each disc, g = Σ f_n + ½ (δ² − f_t²/(s_n s_t)) ∂s_n/∂r; and ¼ m ω² Δ(r²) of its spin |
//!
//! Why the forces of two steps are averaged: the work of a force is taken along v̄, but the contacts are deformed by v
//! in the previous step and by v' in this one. Only with the mean of both forces do the terms add up (summation by
//! parts); with the forces of one step alone, the error of a jammed heap is 2 to 6 times as large. Kinetic energy is
//! accounted for exactly. The stored energy is evaluated from positions, velocities and friction springs at the same
//! time (`Simulation::synchronised_energy`). The error that remains is of second order in Δt and comes from contacts
//! that open, close or turn within a step; it is therefore larger for a gas of colliding discs than for a packing. A
//! change of Δt during an audit adds an error of half that change times the power of the contact forces: choose the
//! step before [`EnergyAudit::new`].
//!
//! The work of affine motion ([`Simulation::affine`]: the grains are carried along with the deformation of the box) is
//! not counted here, so the audit does not close with it. A periodic box always moves its grains this way and cannot be
//! audited.

use crate::contacts::{PairList, WallContacts};
use crate::disc::Disc;
use crate::law::{damping_scale, pair_stiffness, wall_stiffness};
use crate::simulation::Simulation;
use crate::walls::Side;

/// Work and losses since [`EnergyAudit::new`] \[J\], and the energy stored then.
#[derive(Clone, Debug, PartialEq)]
pub struct EnergyAudit {
    /// Lost to the damping force (Table 1).
    pub damping: f64,
    /// Lost to [`Simulation::free_drag`].
    pub drag: f64,
    /// Lost in sliding contacts.
    pub friction: f64,
    /// Work of the walls on the grains.
    pub walls: f64,
    /// Work of changing radii.
    pub growth: f64,
    stored: f64,
    forces: BoundaryForces,
}

/// Forces against which radii and walls move.
#[derive(Clone, Debug, PartialEq)]
struct BoundaryForces {
    /// g of each disc [N].
    growth: Vec<f64>,
    /// As [`Simulation::wall_force`].
    walls: [[f64; 2]; 4],
}

/// The part of the state at the start of a step that the step overwrites.
struct StepStart {
    discs: Vec<Disc>,
    pairs: PairList,
    walls: [WallContacts; 4],
}

/// One candidate contact during a step.
struct Strained {
    i: Result<usize, Side>,
    j: usize,
    /// δ [m]; not positive when open.
    overlap: f64,
    /// s_n [N/m].
    stiffness: f64,
    /// ∂s_n/∂r_i and ∂s_n/∂r_j [N/m²].
    slope: [f64; 2],
    /// f_t [N] at the start and the end of the step.
    tangential: [f64; 2],
    /// u [m], of j relative to i along t.
    slip: f64,
    /// Velocity of j relative to i along n and t [m/s], that of walls left out.
    speed: [f64; 2],
}

impl Strained {
    /// ½ s_n δ² + ½ f_t²/s_t [J].
    fn energy(&self, stiffness_ratio: f64) -> f64 {
        let (overlap, tangential) = (self.overlap.max(0.0), self.tangential[1]);
        let normal = 0.5 * self.stiffness * overlap * overlap;
        // Without tangential stiffness there is no f_t to divide.
        if tangential == 0.0 {
            return normal;
        }
        normal + 0.5 * tangential * tangential / (stiffness_ratio * self.stiffness)
    }

    /// P_n − P_t [W], the difference of the powers of normal and tangential force, see
    /// `Simulation::synchronised_energy`.
    fn power(&self) -> f64 {
        let [along_n, along_t] = self.speed;
        self.stiffness * self.overlap.max(0.0) * along_n - self.tangential[1] * along_t
    }

    /// Energy lost to friction in the step [J]. Zero up to round-off when the contact sticks.
    fn friction(&self, stiffness_ratio: f64) -> f64 {
        let [before, after] = self.tangential;
        let mean = 0.5 * (before + after);
        if mean == 0.0 {
            return 0.0;
        }
        // A contact that opened has lost its f_t; its slip in this step does no work.
        let slip = if self.overlap > 0.0 { self.slip } else { 0.0 };
        -mean * (slip + (after - before) / (stiffness_ratio * self.stiffness))
    }
}

impl BoundaryForces {
    fn new(discs: usize) -> Self {
        Self { growth: vec![0.0; discs], walls: [[0.0; 2]; 4] }
    }

    fn add(&mut self, contact: &Strained, stiffness_ratio: f64) {
        let &Strained { i, j, overlap, stiffness, slope, tangential: [_, tangential], .. } = contact;
        if overlap <= 0.0 {
            return;
        }
        let normal = stiffness * overlap;
        let mut stiffening = 0.5 * overlap * overlap;
        if tangential != 0.0 {
            stiffening -= 0.5 * tangential * tangential / (stiffness_ratio * stiffness * stiffness);
        }
        self.growth[j] += normal + stiffening * slope[1];
        match i {
            Ok(i) => self.growth[i] += normal + stiffening * slope[0],
            Err(side) => {
                let [on_wall, along] = &mut self.walls[side as usize];
                *on_wall += normal;
                *along -= tangential;
            }
        }
    }
}

impl EnergyAudit {
    /// Starts the audit at the present state.
    ///
    /// # Panics
    /// For a periodic box: the work of its deformation is not counted.
    pub fn new(simulation: &Simulation) -> Self {
        assert!(simulation.periodic.is_none(), "no energy audit of periodic boxes");
        let stored = simulation.synchronised_energy();
        let mut forces = BoundaryForces::new(simulation.discs.len());
        let ratio = simulation.material.stiffness_ratio;
        simulation.for_each_strained(&simulation.start(), |contact| forces.add(&contact, ratio));
        Self { damping: 0.0, drag: 0.0, friction: 0.0, walls: 0.0, growth: 0.0, stored, forces }
    }

    /// Work done on the grains, less all losses, less the increase of the stored energy since the start \[J\]: 0 up to
    /// the error of the time integration.
    pub fn residual(&self, simulation: &Simulation) -> f64 {
        let gained = simulation.synchronised_energy() - self.stored;
        self.walls + self.growth - self.damping - self.drag - self.friction - gained
    }

    /// |residual| over the work done, |walls| + |growth| [-]; over the energy stored at the beginning when no work was
    /// done.
    pub fn imbalance(&self, simulation: &Simulation) -> f64 {
        let work = self.walls.abs() + self.growth.abs();
        self.residual(simulation).abs() / if work > 0.0 { work } else { self.stored }
    }

    /// Adds the losses of one disc, and the work on its spin: its moment of inertia in this step is that of the new
    /// radius.
    fn add_motion(&mut self, before: &Disc, after: &Disc, force: [f64; 2], damping: f64, dt: f64) {
        let grown = Disc { radius: after.radius, ..*before };
        self.growth += kinetic_energy(&grown) - kinetic_energy(before);
        let force2 = force[0] * force[0] + force[1] * force[1];
        if force2 > 0.0 {
            let scale = damping_scale(damping, force2, before.vx * before.vx + before.vy * before.vy);
            let along = before.vx * (before.vx + after.vx) + before.vy * (before.vy + after.vy);
            self.damping += 0.5 * dt * scale * along;
        } else {
            self.drag += kinetic_energy(&grown) - kinetic_energy(after);
        }
    }

    /// Adds the work of growth and walls, taken with the mean of the forces of the previous step and `forces`, which
    /// are then kept for the next step.
    fn add_boundaries(&mut self, start: &StepStart, simulation: &Simulation, forces: BoundaryForces) {
        for (k, (before, after)) in start.discs.iter().zip(&simulation.discs).enumerate() {
            let mean = 0.5 * (self.forces.growth[k] + forces.growth[k]);
            self.growth += mean * (after.radius - before.radius);
        }
        for side in Side::ALL {
            let ([nx, ny], [vx, vy]) = (side.normal(), simulation.walls.velocity(side));
            let (last, this) = (self.forces.walls[side as usize], forces.walls[side as usize]);
            let [outwards, along] = [0.5 * (last[0] + this[0]), 0.5 * (last[1] + this[1])];
            let power = outwards * (nx * vx + ny * vy) - along * (nx * vy - ny * vx);
            self.walls += power * simulation.time_step;
        }
        self.forces = forces;
    }
}

fn kinetic_energy(disc: &Disc) -> f64 {
    let spin = disc.radius * disc.angular_velocity;
    0.5 * disc.mass * (disc.vx * disc.vx + disc.vy * disc.vy + 0.5 * spin * spin)
}

impl Simulation {
    /// Σ ½ m v² + ¼ m r² ω² \[J\].
    pub fn kinetic_energy(&self) -> f64 {
        self.discs.iter().map(kinetic_energy).sum()
    }

    /// Σ ½ s_n δ² + ½ f_t²/s_t \[J\]. Between walls, a contact that opened in the last motion keeps its f_t, and is
    /// counted, until the next step; in a periodic box it is not.
    pub fn elastic_energy(&self) -> f64 {
        let mut sum = 0.0;
        let ratio = self.material.stiffness_ratio;
        if self.periodic.is_some() {
            self.for_each_contact(|contact| sum += contact.energy(ratio));
            return sum;
        }
        self.for_each_strained(&self.start(), |contact| sum += contact.energy(ratio));
        sum
    }

    /// Elastic and kinetic energy at one and the same time [J].
    ///
    /// Symplectic Euler is the leapfrog scheme: v is the velocity half a step before x, and f_t, the sum of v Δt, lags
    /// one step behind x. With the powers P_n = f_n n·v and P_t = f_t t·v of the contact forces, the kinetic energy at
    /// the time of x is larger by ½ Δt (P_n + P_t) than that of the stored velocities, and ½ f_t²/s_t is smaller by Δt
    /// P_t: a correction of ½ Δt (P_n − P_t) in all.
    fn synchronised_energy(&self) -> f64 {
        let mut power = 0.0;
        self.for_each_strained(&self.start(), |contact| power += contact.power());
        self.elastic_energy() + self.kinetic_energy() + 0.5 * self.time_step * power
    }

    /// Takes the same step as [`Simulation::step`], bit for bit, and adds its energies to `audit`. Takes several times
    /// as long.
    pub fn step_audited(&mut self, audit: &mut EnergyAudit) {
        let start = self.start();
        self.step();
        let (ratio, dt) = (self.material.stiffness_ratio, self.time_step);
        let mut forces = BoundaryForces::new(self.discs.len());
        self.for_each_strained(&start, |contact| {
            audit.friction += contact.friction(ratio);
            forces.add(&contact, ratio);
        });
        audit.add_boundaries(&start, self, forces);
        for ((before, after), load) in start.discs.iter().zip(&self.discs).zip(self.loads()) {
            audit.add_motion(before, after, [load.fx, load.fy], self.material.damping, dt);
        }
    }

    fn start(&self) -> StepStart {
        StepStart {
            discs: self.discs.clone(),
            pairs: self.neighbours.pairs.clone(),
            walls: self.neighbours.walls.clone(),
        }
    }

    /// Calls `visit` with every candidate contact as seen by the step that began at `start` and ended at `self`:
    /// centres and velocities of the start, radii and walls of the end.
    fn for_each_strained(&self, start: &StepStart, mut visit: impl FnMut(Strained)) {
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
            let apart = ((b.vx - a.vx) * dx + (b.vy - a.vy) * dy) / distance;
            let reach = ra + rb;
            visit(Strained {
                i: Ok(i as usize),
                j: j as usize,
                overlap,
                stiffness: pair_stiffness(young_modulus, ra, rb),
                slope: [rb / reach, ra / reach].map(|share| 2.0 * young_modulus * share * share),
                tangential: [start.pairs.tangential_of(i as usize, j), pairs.tangential[k]],
                slip: speed * dt,
                speed: [apart, speed],
            });
        }
        for side in Side::ALL {
            self.for_each_strained_at(side, start, &mut visit);
        }
    }

    fn for_each_strained_at(&self, side: Side, start: &StepStart, visit: &mut impl FnMut(Strained)) {
        let (young_modulus, factor) = (self.material.young_modulus, self.material.wall_stiffness_factor);
        let ([nx, ny], [wall_vx, wall_vy]) = (side.normal(), self.walls.velocity(side));
        let contacts = &self.neighbours.walls[side as usize];
        for (&i, &tangential) in contacts.disc.iter().zip(&contacts.tangential) {
            let (disc, radius) = (&start.discs[i as usize], self.discs[i as usize].radius);
            let distance = self.walls.distance(side, disc.x, disc.y);
            let speed =
                (disc.vy - wall_vy) * nx - (disc.vx - wall_vx) * ny - distance * disc.angular_velocity;
            visit(Strained {
                i: Err(side),
                j: i as usize,
                overlap: radius - distance,
                stiffness: wall_stiffness(young_modulus, factor, radius),
                slope: [0.0, factor * young_modulus],
                tangential: [start.walls[side as usize].tangential_of(i), tangential],
                slip: speed * self.time_step,
                speed: [
                    disc.vx * nx + disc.vy * ny,
                    disc.vy * nx - disc.vx * ny - distance * disc.angular_velocity,
                ],
            });
        }
    }
}
