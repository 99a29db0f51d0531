//! The state of one assembly, and one step of it.

use crate::disc::Disc;
use crate::forces::{self, Load};
use crate::kernel::{self, Motion, Simd};
use crate::law::{PairLaw, pair_stiffness, wall_stiffness};
use crate::material::Material;
use crate::neighbours::Neighbours;
use crate::time_step;
use crate::walls::{Side, Walls};

/// Discs in a box. Build with [`Simulation::new`], drive by setting wall velocities and [`Simulation::set_strain_rate`].
#[derive(Clone, Debug)]
pub struct Simulation {
    pub material: Material,
    pub discs: Vec<Disc>,
    pub walls: Walls,
    /// Δt [s]; see [`Simulation::adapt_time_step`].
    pub time_step: f64,
    /// Drag on discs without contact force [1/s]; 0 (off) as in the paper, whose damping lets them fly for ever.
    pub free_drag: f64,
    /// Steps taken.
    pub steps: u64,
    /// Force of the grains on each wall [N]: normal (outwards positive) and tangential (along t of the inward normal).
    pub wall_force: [[f64; 2]; 4],
    /// Radii at zero strain [m].
    reference_radius: Vec<f64>,
    largest_reference_radius: f64,
    /// ε [-]: radii are `reference_radius` (1 + ε), not compounded (Eq. 6).
    strain: f64,
    strain_rate: f64,
    largest_speed: f64,
    simd: Simd,
    neighbours: Neighbours,
    loads: Vec<Load>,
}

/// A force-bearing contact. n points from i to j (from the wall inwards), t = (−n_y, n_x).
#[derive(Clone, Copy, Debug)]
pub struct Contact {
    /// First partner, or the wall.
    pub i: Result<usize, Side>,
    /// Second partner.
    pub j: usize,
    /// Unit normal.
    pub normal: [f64; 2],
    /// Centre to centre; of a wall contact, the foot of the centre on the wall to the centre [m].
    pub branch: [f64; 2],
    /// δ [m].
    pub overlap: f64,
    /// s_n [N/m].
    pub stiffness: f64,
    /// f_t [N], on j along t.
    pub tangential_force: f64,
}

impl Contact {
    /// f_n = s_n δ [N], repulsive.
    pub fn normal_force(&self) -> f64 {
        self.stiffness * self.overlap
    }

    /// Force on j [N].
    pub fn force(&self) -> [f64; 2] {
        let ([nx, ny], normal, tangential) = (self.normal, self.normal_force(), self.tangential_force);
        [normal * nx - tangential * ny, normal * ny + tangential * nx]
    }

    /// The one or two discs of the contact.
    pub fn discs(&self) -> impl Iterator<Item = usize> + use<> {
        self.i.ok().into_iter().chain(std::iter::once(self.j))
    }
}

impl Simulation {
    /// An assembly with given discs in given walls; the friction history is empty.
    pub fn new(material: Material, discs: Vec<Disc>, walls: Walls) -> Self {
        let mut simulation = Self {
            material,
            reference_radius: discs.iter().map(|d| d.radius).collect(),
            largest_reference_radius: discs.iter().map(|d| d.radius).fold(0.0, f64::max),
            loads: vec![Load::default(); discs.len()],
            discs,
            walls,
            time_step: 0.0,
            free_drag: 0.0,
            steps: 0,
            wall_force: [[0.0; 2]; 4],
            strain: 0.0,
            strain_rate: 0.0,
            largest_speed: 0.0,
            simd: Simd::best(),
            neighbours: Neighbours::default(),
        };
        simulation.neighbours.rebuild(&simulation.discs, &simulation.walls);
        simulation.largest_speed = simulation.discs.iter().map(|d| d.vx.hypot(d.vy)).fold(0.0, f64::max);
        simulation.adapt_time_step();
        simulation
    }

    /// One step of Δt.
    pub fn step(&mut self) {
        self.advance_boundaries();
        if self.neighbours.stale(&self.discs) {
            self.neighbours.rebuild(&self.discs, &self.walls);
        }
        self.sum_contact_forces();
        self.move_discs();
        self.steps += 1;
    }

    /// Sets Δt to [`time_step::SAFETY`] times the stable step of the present contacts.
    pub fn adapt_time_step(&mut self) {
        self.time_step = time_step::SAFETY * time_step::stable_step(self);
    }

    /// Instruction set of the kernels; all give the same bits.
    pub fn simd(&self) -> Simd {
        self.simd
    }

    /// Chooses the instruction set.
    ///
    /// # Panics
    /// When the machine does not have it; ask [`Simd::available`].
    pub fn set_simd(&mut self, simd: Simd) {
        assert!(simd.available(), "{simd:?} is not available on this machine");
        self.simd = simd;
    }

    /// ε [-], relative to the radii at the last [`Simulation::reset_strain`].
    pub fn strain(&self) -> f64 {
        self.strain
    }

    /// Prescribes dε/dt [1/s] for all discs.
    pub fn set_strain_rate(&mut self, rate: f64) {
        self.strain_rate = rate;
    }

    /// Makes the present radii the reference: ε = 0.
    pub fn reset_strain(&mut self) {
        self.reference_radius = self.discs.iter().map(|d| d.radius).collect();
        self.largest_reference_radius = self.reference_radius.iter().copied().fold(0.0, f64::max);
        self.strain = 0.0;
        self.strain_rate = 0.0;
    }

    /// How often the neighbour search has run.
    pub fn rebuilds(&self) -> u64 {
        self.neighbours.rebuilds
    }

    /// Candidate pairs of the neighbour search, touching or not.
    pub fn candidates(&self) -> usize {
        self.neighbours.pairs.len()
    }

    /// Resultants of the contact forces in the last step, one a disc.
    pub fn loads(&self) -> &[Load] {
        &self.loads
    }

    /// Mean disc radius [m].
    pub fn mean_radius(&self) -> f64 {
        self.discs.iter().map(|d| d.radius).sum::<f64>() / self.discs.len() as f64
    }

    /// Calls `visit` with every force-bearing contact: pairs row by row, then the walls.
    pub fn for_each_contact(&self, mut visit: impl FnMut(Contact)) {
        let pairs = &self.neighbours.pairs;
        for (k, (&i, &j)) in pairs.i().iter().zip(pairs.j()).enumerate() {
            if let Some(contact) = self.pair_contact(i as usize, j as usize, pairs.tangential[k]) {
                visit(contact);
            }
        }
        for side in Side::ALL {
            let contacts = &self.neighbours.walls[side as usize];
            for (&j, &tangential) in contacts.disc.iter().zip(&contacts.tangential) {
                if let Some(contact) = self.wall_contact(side, j as usize, tangential) {
                    visit(contact);
                }
            }
        }
    }

    fn pair_contact(&self, i: usize, j: usize, tangential_force: f64) -> Option<Contact> {
        let (a, b) = (&self.discs[i], &self.discs[j]);
        let branch = [b.x - a.x, b.y - a.y];
        let distance = (branch[0] * branch[0] + branch[1] * branch[1]).sqrt();
        let overlap = a.radius + b.radius - distance;
        (overlap > 0.0).then(|| Contact {
            i: Ok(i),
            j,
            normal: [branch[0] / distance, branch[1] / distance],
            branch,
            overlap,
            stiffness: pair_stiffness(self.material.young_modulus, a.radius, b.radius),
            tangential_force,
        })
    }

    fn wall_contact(&self, side: Side, j: usize, tangential_force: f64) -> Option<Contact> {
        let disc = &self.discs[j];
        let distance = self.walls.distance(side, disc.x, disc.y);
        let normal = side.normal();
        let overlap = disc.radius - distance;
        let (young_modulus, factor) = (self.material.young_modulus, self.material.wall_stiffness_factor);
        (overlap > 0.0).then(|| Contact {
            i: Err(side),
            j,
            normal,
            branch: [distance * normal[0], distance * normal[1]],
            overlap,
            stiffness: wall_stiffness(young_modulus, factor, disc.radius),
            tangential_force,
        })
    }

    /// Radii and walls at the end of the step.
    fn advance_boundaries(&mut self) {
        let dt = self.time_step;
        if self.strain_rate != 0.0 {
            self.strain += self.strain_rate * dt;
            let factor = 1.0 + self.strain;
            for (disc, reference) in self.discs.iter_mut().zip(&self.reference_radius) {
                disc.radius = reference * factor;
            }
        }
        self.walls.advance(dt);
        let growth = (self.strain_rate * self.largest_reference_radius).max(0.0);
        self.neighbours.record_motion(self.largest_speed, self.walls.largest_speed(), growth, dt);
    }

    fn sum_contact_forces(&mut self) {
        let law = PairLaw::new(&self.material, self.time_step);
        self.loads.fill(Load::default());
        let pairs = &mut self.neighbours.pairs;
        let all = 0..pairs.len();
        kernel::add_pairs(self.simd, law, &self.discs, pairs, all, &mut self.loads);
        for side in Side::ALL {
            let contacts = &mut self.neighbours.walls[side as usize];
            self.wall_force[side as usize] =
                forces::add_wall(law, side, &self.walls, &self.discs, contacts, &mut self.loads);
        }
    }

    fn move_discs(&mut self) {
        let motion = Motion {
            damping: self.material.damping,
            keep_free: (1.0 - self.free_drag * self.time_step).max(0.0),
            dt: self.time_step,
        };
        self.largest_speed = kernel::advance(self.simd, motion, &mut self.discs, &self.loads).sqrt();
    }
}

#[cfg(test)]
#[path = "simulation_tests.rs"]
mod tests;
