//! The state of one assembly, and one step of it.

mod boundaries;
mod heat;

use crate::contact::{Contact, Touching};
use crate::disc::Disc;
use crate::forces::Load;
use crate::heat::HeatPipes;
use crate::kernel::Motion;
use crate::law::PairLaw;
use crate::material::Material;
use crate::neighbours::Neighbours;
use crate::periodic::{Cell, Periodic, SmallCell, check_size};
use crate::slabs::{SlabLoads, Sweep};
use crate::time_step::{self, StepChoice};
use crate::walls::{Side, Walls};
use msdd_engine::run::{self, LastGood, Threads};
use msdd_engine::vector::larger;
use msdd_engine::{Simd, Stage};

/// Discs in a box. Build with [`Simulation::new`], drive by setting wall velocities and [`Simulation::set_strain_rate`].
#[derive(Clone, Debug)]
pub struct Simulation {
    pub material: Material,
    pub discs: Vec<Disc>,
    pub walls: Walls,
    /// None between walls. For a periodic box, `walls` are the borders of the cell. The constructor decides which of
    /// the two it is, and that stays so.
    pub periodic: Option<Periodic>,
    /// Δt \[s\] of the next step; [`Simulation::run`] sets it as chosen.
    pub time_step: f64,
    pub(crate) step_choice: StepChoice,
    /// Drag on discs without contact force [1/s]. 0 (off) as in the paper, whose damping, proportional to the contact
    /// force, does not slow down free discs.
    pub free_drag: f64,
    /// Whether moving walls carry the grains along (affine motion). The velocities of the discs are then relative to
    /// that motion. Off as in the paper; in a periodic box it is always on.
    pub affine: bool,
    /// Whether the walls shrink and stretch with the affine motion, so that grains carried along do not slip on them.
    /// Otherwise the friction of the long walls of a box would drag the grains to its ends.
    pub affine_walls: bool,
    /// Steps taken.
    pub steps: u64,
    /// t \[s\].
    pub time: f64,
    /// Force of the grains on each wall \[N\]: normal (outwards positive) and tangential (along t of the inward normal).
    pub wall_force: [[f64; 2]; 4],
    /// Radii at zero strain [m].
    pub(crate) reference_radius: Vec<f64>,
    largest_reference_radius: f64,
    /// ε [-]: radii are `reference_radius` (1 + ε), not compounded (Eq. 6).
    pub(crate) strain: f64,
    pub(crate) strain_rate: f64,
    pub(crate) largest_speed: f64,
    simd: Simd,
    pub(crate) neighbours: Neighbours,
    pub(crate) loads: SlabLoads,
    pipes: Option<Box<HeatPipes>>,
    pub(crate) threads: Threads,
    /// Whether the present step is shared among the threads of the pool.
    pub(crate) shared: bool,
    pub(crate) last_good: Option<LastGood<Simulation>>,
}

impl Simulation {
    /// An assembly of the given discs in the given walls, without friction history.
    pub fn new(material: Material, discs: Vec<Disc>, walls: Walls) -> Self {
        Self::with_boundary(material, discs, walls, None)
    }

    /// An assembly in a periodic box between the positions of `walls`, without friction history. Discs may lie
    /// anywhere: their images fill the cell.
    ///
    /// # Errors
    /// [`SmallCell`] when a disc could touch two images of the same disc.
    pub fn new_periodic(
        material: Material,
        discs: Vec<Disc>,
        walls: Walls,
        periodic: Periodic,
    ) -> Result<Self, SmallCell> {
        let largest = discs.iter().map(|d| d.radius).fold(0.0, f64::max);
        check_size(&walls, largest)?;
        Ok(Self::with_boundary(material, discs, walls, Some(periodic)))
    }

    fn with_boundary(material: Material, discs: Vec<Disc>, walls: Walls, periodic: Option<Periodic>) -> Self {
        let mut simulation = Self {
            material,
            reference_radius: discs.iter().map(|d| d.radius).collect(),
            largest_reference_radius: discs.iter().map(|d| d.radius).fold(0.0, f64::max),
            loads: SlabLoads::default(),
            discs,
            walls,
            periodic,
            time_step: 0.0,
            step_choice: StepChoice::Adaptive { safety: time_step::SAFETY },
            free_drag: 0.0,
            affine: false,
            affine_walls: false,
            steps: 0,
            time: 0.0,
            pipes: None,
            threads: Threads::default(),
            shared: false,
            last_good: None,
            wall_force: [[0.0; 2]; 4],
            strain: 0.0,
            strain_rate: 0.0,
            largest_speed: 0.0,
            simd: Simd::preferred(),
            neighbours: Neighbours::default(),
        };
        simulation.rebuild_neighbours();
        simulation.largest_speed = simulation.discs.iter().map(Disc::speed).fold(0.0, larger);
        simulation.time_step = time_step::SAFETY * simulation.stable_step();
        simulation
    }

    /// One step of Δt.
    pub fn step(&mut self) {
        self.step_marked(|_| ());
    }

    /// Takes `count` steps on the chosen number of threads, without checking the state in between.
    pub fn take_steps(&mut self, count: u64) {
        run::take_steps(self, count);
    }

    /// Chooses the number of threads for [`Simulation::take_steps`] and [`Simulation::run`]. Results do not depend on
    /// it. Periodic boxes and assemblies below a few thousand discs use one thread in any case: their steps are too
    /// short to share.
    ///
    /// # Errors
    /// The error of the operating system when it cannot start the threads.
    pub fn set_threads(&mut self, threads: usize) -> std::io::Result<()> {
        let slabs = self.neighbours.pairs.slabs().len();
        self.threads.set(threads.min(slabs))
    }

    /// As [`Simulation::step`], and calls `mark` when each stage ends, for timing. Pairs, walls and motion are worked
    /// through block by block of discs, so `mark` is called several times for each.
    pub fn step_marked(&mut self, mut mark: impl FnMut(Stage)) {
        self.advance_boundaries();
        mark(Stage::Boundaries);
        if self.neighbours.skin.used_up(&self.discs, self.cell().map(|cell| cell.lattice()).as_ref()) {
            self.find_neighbours();
        }
        mark(Stage::Neighbours);
        self.sweep(&mut mark);
        self.conduct_through(self.time_step, HeatPipes::follow);
        mark(Stage::Heat);
        self.steps += 1;
        self.time += self.time_step;
    }

    /// Instruction set of the kernels; all give the same bits.
    pub fn simd(&self) -> Simd {
        self.simd
    }

    /// Chooses the instruction set.
    ///
    /// # Panics
    /// When the machine does not have the set; see [`Simd::available`].
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
        self.set_reference_radii(self.discs.iter().map(|d| d.radius).collect());
        self.strain = 0.0;
        self.strain_rate = 0.0;
    }

    pub(crate) fn set_reference_radii(&mut self, radii: Vec<f64>) {
        self.largest_reference_radius = radii.iter().copied().fold(0.0, f64::max);
        self.reference_radius = radii;
    }

    /// Calls `visit` with every force-bearing contact: pairs row by row, then the walls.
    pub fn for_each_contact(&self, visit: impl FnMut(Contact)) {
        self.touching().for_each(visit);
    }

    /// The present contacts.
    pub(crate) fn touching(&self) -> Touching<'_> {
        Touching {
            material: &self.material,
            discs: &self.discs,
            walls: &self.walls,
            cell: self.cell(),
            neighbours: &self.neighbours,
        }
    }

    /// Bound on the stable time step at the present contacts \[s\], see [`crate::time_step`].
    pub fn stable_step(&self) -> f64 {
        time_step::stable_step(&self.touching())
    }

    /// The cell of a periodic box; none between walls.
    pub fn cell(&self) -> Option<Cell> {
        self.periodic.as_ref().map(|periodic| Cell::new(&self.walls, periodic))
    }

    /// Takes back the friction that the grains at a wall have mobilised there, as if the wall had come along with them.
    pub fn release_friction(&mut self, side: Side) {
        self.neighbours.walls[side as usize].tangential.fill(0.0);
    }

    /// Runs the neighbour search now, whether necessary or not. Results do not depend on when it runs.
    pub fn rebuild_neighbours(&mut self) {
        self.neighbours.rebuild(&self.discs, &self.walls, self.cell().as_ref());
    }

    /// How often the neighbour search has run.
    pub fn rebuilds(&self) -> u64 {
        self.neighbours.skin.searches
    }

    /// Candidate pairs of the neighbour search, touching or not.
    pub fn candidates(&self) -> usize {
        self.neighbours.pairs.len()
    }

    /// Resultants of the contact forces in the last step, one load per disc.
    pub fn loads(&self) -> Vec<Load> {
        self.loads.iter(&self.neighbours).copied().collect()
    }

    /// Mean disc radius \[m\].
    pub fn mean_radius(&self) -> f64 {
        self.discs.iter().map(|d| d.radius).sum::<f64>() / self.discs.len() as f64
    }

    fn find_neighbours(&mut self) {
        self.scale_radii();
        self.rebuild_neighbours();
    }

    /// Appends the ghosts to the discs, at their present places.
    fn place_ghosts(&mut self) {
        if let Some(cell) = self.cell() {
            let cell = cell.lattice();
            for ghost in &self.neighbours.ghosts {
                let image = cell.image(&self.discs[ghost.owner as usize], ghost.shift);
                self.discs.push(image);
            }
        }
    }

    /// Radii, contact forces and motion.
    fn sweep(&mut self, mark: impl FnMut(Stage)) {
        let count = self.discs.len();
        if self.periodic.is_some() {
            self.scale_radii();
            self.place_ghosts();
        }
        let (dt, flow) = (self.time_step, self.flow());
        let conductivity = self.pipes.as_ref().map(|pipes| pipes.thermal.conductivity);
        let sweep = Sweep {
            simd: self.simd,
            law: PairLaw::new(&self.material, dt, flow.gradient, conductivity),
            walls: &self.walls,
            flow,
            affine_walls: self.affine_walls,
            motion: Motion {
                damping: self.material.damping,
                keep_free: (1.0 - self.free_drag * dt).max(0.0),
                dt,
            },
            radii: self.radius_factor().map(|factor| (factor, self.reference_radius.as_slice())),
        };
        let swept = self.loads.sweep(self.shared, sweep, &mut self.discs, &mut self.neighbours, mark);
        self.discs.truncate(count);
        self.wall_force = swept.wall_force;
        self.largest_speed = swept.fastest2.sqrt();
    }
}

#[cfg(test)]
mod tests;
