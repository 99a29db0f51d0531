//! The state of one assembly, and one step of it.

use crate::boundary::{Boundary, SmallCell};
use crate::contact::{Contact, Partner, Touching};
use crate::forces::Load;
use crate::kernel::Motion;
use crate::law::ContactLaw;
use crate::material::Material;
use crate::neighbours::Neighbours;
use crate::slabs::{SlabLoads, Sweep};
use crate::space::{Matrix, cross, dot, length, plus, scaled};
use crate::sphere::Sphere;
use crate::time_step::{self, StepChoice};
use msdd_engine::Simd;
use msdd_engine::grain::largest_radius;
use msdd_engine::run::{self, LastGood, Threads};
use msdd_engine::vector::larger;

/// Spheres in a box. Build with [`Simulation::new`]; drive by the velocities of the walls or the velocity gradient of the
/// cell, by gravity and by [`Simulation::set_strain_rate`].
#[derive(Clone, Debug)]
pub struct Simulation {
    pub material: Material,
    pub spheres: Vec<Sphere>,
    /// Walls or a cell. The constructor decides which, and that stays so.
    pub boundary: Boundary,
    /// g [m/s²].
    pub gravity: [f64; 3],
    /// Drag on all spheres [1/s]: velocities and angular velocities fade at this rate, relative to the flow of a cell.
    pub drag: f64,
    /// Δt \[s\] of the next step; [`Simulation::run`] sets it as chosen.
    pub time_step: f64,
    pub(crate) step_choice: StepChoice,
    /// Steps taken.
    pub steps: u64,
    /// t \[s\].
    pub time: f64,
    /// Force of the spheres on each wall \[N\].
    pub wall_force: Vec<[f64; 3]>,
    /// ε [-]: radii are the reference radii times 1 + ε.
    pub(crate) strain: f64,
    pub(crate) strain_rate: f64,
    pub(crate) largest_speed: f64,
    simd: Simd,
    pub(crate) neighbours: Neighbours,
    pub(crate) loads: SlabLoads,
    pub(crate) threads: Threads,
    pub(crate) last_good: Option<LastGood<Simulation>>,
}

impl Simulation {
    /// An assembly without friction history. In a periodic box spheres may lie anywhere: their images fill the cell.
    ///
    /// # Errors
    /// [`SmallCell`] when a sphere could touch two images of another one.
    pub fn new(material: Material, spheres: Vec<Sphere>, boundary: Boundary) -> Result<Self, SmallCell> {
        if let Some(cell) = boundary.cell() {
            cell.check(largest_radius(&spheres))?;
        }
        let mut simulation = Self {
            material,
            spheres,
            wall_force: vec![[0.0; 3]; boundary.walls().len()],
            boundary,
            gravity: [0.0; 3],
            drag: 0.0,
            time_step: 0.0,
            step_choice: StepChoice::Adaptive { safety: time_step::SAFETY },
            steps: 0,
            time: 0.0,
            strain: 0.0,
            strain_rate: 0.0,
            largest_speed: 0.0,
            simd: Simd::preferred(),
            neighbours: Neighbours::default(),
            loads: SlabLoads::default(),
            threads: Threads::default(),
            last_good: None,
        };
        simulation.restart();
        Ok(simulation)
    }

    /// What follows from positions and velocities: neighbours, largest speed, time step.
    pub(crate) fn restart(&mut self) {
        self.rebuild_neighbours();
        let speed2 = |s: &Sphere| dot(s.velocity, s.velocity);
        self.largest_speed = self.spheres.iter().map(speed2).fold(0.0, larger).sqrt();
        self.time_step = time_step::SAFETY * self.stable_step();
    }

    /// One step of Δt.
    pub fn step(&mut self) {
        self.step_shared(false);
    }

    pub(crate) fn step_shared(&mut self, shared: bool) {
        self.advance_boundary();
        let lattice = self.boundary.cell().map(|cell| cell.lattice);
        let neighbours = &mut self.neighbours;
        if neighbours.too_wide(self.steps) || neighbours.skin.used_up(&self.spheres, lattice.as_ref()) {
            self.rebuild_neighbours();
        }
        self.sweep(shared);
        self.steps += 1;
        self.time += self.time_step;
    }

    /// Takes `count` steps on the chosen number of threads, without checking the state in between.
    pub fn take_steps(&mut self, count: u64) {
        run::take_steps(self, count);
    }

    /// Chooses the number of threads for [`Simulation::take_steps`] and [`Simulation::run`]. Results do not depend on
    /// it. Periodic boxes below 10 000 spheres, and others below 4 000, use one thread in any case.
    ///
    /// # Errors
    /// The error of the operating system when it cannot start the threads.
    pub fn set_threads(&mut self, threads: usize) -> std::io::Result<()> {
        self.threads.set(threads.min(self.neighbours.pairs.rows.slabs().len()))
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

    /// ε [-] of the radii, relative to the reference radii.
    pub fn strain(&self) -> f64 {
        self.strain
    }

    /// Prescribes dε/dt [1/s] for all spheres.
    pub fn set_strain_rate(&mut self, rate: f64) {
        self.strain_rate = rate;
    }

    /// Velocity gradient of a periodic box [1/s]; 0 between walls.
    pub fn velocity_gradient(&self) -> Matrix {
        self.boundary.cell().map_or([[0.0; 3]; 3], |cell| cell.velocity_gradient)
    }

    /// Sets the velocity gradient of a periodic box [1/s], whose entries below the diagonal must be 0; does nothing
    /// between walls.
    pub fn set_velocity_gradient(&mut self, gradient: Matrix) {
        if let Some(cell) = self.boundary.cell_mut() {
            cell.velocity_gradient = gradient;
        }
    }

    /// Multiplies all lengths of a periodic box, and the places of the spheres in it, by `factor` at once; radii and
    /// velocities stay. Does nothing between walls.
    pub fn scale_cell(&mut self, factor: f64) {
        if let Boundary::Periodic(cell) = &mut self.boundary {
            cell.scale(factor);
            let origin = cell.lattice.origin;
            for sphere in &mut self.spheres {
                for (x, o) in sphere.position.iter_mut().zip(origin) {
                    *x = o + factor * (*x - o);
                }
            }
            // Pairs at most `reach` apart have come nearer by at most this.
            self.neighbours.skin.record_flow((1.0 - factor).max(0.0), 1.0);
        }
    }

    /// The law at the present time step.
    pub fn law(&self) -> ContactLaw {
        ContactLaw::new(&self.material, self.time_step, self.velocity_gradient())
    }

    /// Calls `visit` with every contact: pairs row by row, then the walls.
    pub fn for_each_contact(&self, visit: impl FnMut(Contact)) {
        self.touching().for_each(visit);
    }

    /// Sum of the normal forces of the spheres on a wall, by its number, without damping \[N\].
    pub fn wall_load(&self, wall: usize) -> f64 {
        let mut sum = 0.0;
        self.touching().for_each_candidate_at(wall, |contact| sum += contact.normal_force);
        sum
    }

    /// The present contacts.
    pub(crate) fn touching(&self) -> Touching<'_> {
        Touching {
            law: self.law(),
            spheres: &self.spheres,
            boundary: &self.boundary,
            neighbours: &self.neighbours,
        }
    }

    /// Bound on the stable time step at the present contacts \[s\], see [`crate::time_step`].
    pub fn stable_step(&self) -> f64 {
        time_step::stable_step(&self.touching(), self.largest_speed, length(self.gravity))
    }

    /// Runs the neighbour search now, whether necessary or not. Results do not depend on when it runs.
    pub fn rebuild_neighbours(&mut self) {
        self.neighbours.rebuild(&self.spheres, &self.boundary, self.steps);
        self.spheres.reserve_exact(self.neighbours.ghosts.len());
    }

    /// How often the neighbour search has run.
    pub fn searches(&self) -> u64 {
        self.neighbours.skin.searches
    }

    /// Candidate pairs of the neighbour search, touching or not.
    pub fn candidates(&self) -> usize {
        self.neighbours.pairs.rows.len()
    }

    /// Resultants of the present contact forces, without damping, one load per sphere.
    pub fn loads(&self) -> Vec<Load> {
        let mut loads = vec![Load::default(); self.spheres.len()];
        self.for_each_contact(|contact| {
            let (force, friction) = (contact.force(), contact.tangential_force());
            // The force acts in the middle of the overlap, and at a wall on it.
            let arm = |sphere: usize| match contact.i {
                Partner::Sphere(_) => self.spheres[sphere].radius - 0.5 * contact.overlap,
                Partner::Wall(_) => self.spheres[sphere].radius - contact.overlap,
            };
            let turning = cross(friction, contact.normal);
            let on_j = scaled(arm(contact.j), turning);
            loads[contact.j].add(&Load { force, torque: on_j, ..Load::default() });
            if let Partner::Sphere(i) = contact.i {
                let (force, torque) = (scaled(-1.0, force), scaled(arm(i), turning));
                loads[i].add(&Load { force, torque, ..Load::default() });
            }
        });
        loads
    }

    /// Mean radius \[m\].
    pub fn mean_radius(&self) -> f64 {
        self.spheres.iter().map(|s| s.radius).sum::<f64>() / self.spheres.len() as f64
    }

    /// Moves walls or cell and the spheres with it, and sets the radii, to their values at the end of the step.
    fn advance_boundary(&mut self) {
        let dt = self.time_step;
        self.strain += self.strain_rate * dt;
        let growth = self.set_radii();
        let skin = &mut self.neighbours.skin;
        let mut fastest = 0.0f64;
        for wall in self.boundary.walls_mut() {
            fastest = fastest.max(wall.advance(dt));
        }
        if let Some(cell) = self.boundary.cell_mut() {
            let rate2 = cell.velocity_gradient.iter().flatten().fold(0.0, |sum, x| sum + x * x);
            if rate2 > 0.0 {
                for sphere in &mut self.spheres {
                    sphere.position = plus(sphere.position, dt, cell.flow(sphere.position));
                }
                cell.advance(dt);
                skin.record_flow(rate2.sqrt(), dt);
            }
        }
        skin.record_motion(self.largest_speed, fastest, growth / dt, dt);
    }

    /// Gives each sphere its radius \[m\] at once; masses stay. They are its radii at the present strain.
    ///
    /// # Panics
    /// When there are not as many radii as spheres.
    pub fn resize(&mut self, radii: &[f64]) {
        assert_eq!(radii.len(), self.spheres.len());
        let mut growth = 0.0f64;
        for (sphere, &radius) in self.spheres.iter_mut().zip(radii) {
            growth = growth.max(radius - sphere.radius);
            sphere.radius = radius;
            sphere.reference_radius = radius / (1.0 + self.strain);
        }
        self.neighbours.skin.record_motion(0.0, 0.0, growth, 1.0);
    }

    /// Sets the radii by the strain while it changes; returns the largest growth [m].
    fn set_radii(&mut self) -> f64 {
        if self.strain_rate == 0.0 {
            return 0.0;
        }
        let mut growth = 0.0f64;
        for sphere in &mut self.spheres {
            let radius = sphere.reference_radius * (1.0 + self.strain);
            growth = growth.max(radius - sphere.radius);
            sphere.radius = radius;
        }
        growth
    }

    /// Appends the ghosts to the spheres, at their present places.
    fn place_ghosts(&mut self) {
        if let Some(cell) = self.boundary.cell() {
            for ghost in &self.neighbours.ghosts {
                let image = cell.lattice.image(&self.spheres[ghost.owner as usize], ghost.shift);
                self.spheres.push(image);
            }
        }
    }

    /// Contact forces and motion.
    fn sweep(&mut self, shared: bool) {
        let count = self.spheres.len();
        self.place_ghosts();
        let sweep = Sweep {
            simd: self.simd,
            law: &self.law(),
            walls: self.boundary.walls(),
            motion: Motion {
                gravity: self.gravity,
                keep: (1.0 - self.drag * self.time_step).max(0.0),
                dt: self.time_step,
            },
        };
        let swept = self.loads.sweep(shared, sweep, &mut self.spheres, &mut self.neighbours);
        self.spheres.truncate(count);
        self.wall_force = swept.wall_force;
        self.largest_speed = swept.fastest2.sqrt();
    }

    /// Total momentum [kg m/s], without that of the flow.
    pub fn momentum(&self) -> [f64; 3] {
        self.spheres.iter().fold([0.0; 3], |sum, s| plus(sum, s.mass, s.velocity))
    }

    /// Total angular momentum about the origin [kg m²/s].
    pub fn angular_momentum(&self) -> [f64; 3] {
        self.spheres.iter().fold([0.0; 3], |sum, s| {
            let orbit = cross(s.position, scaled(s.mass, s.velocity));
            plus(plus(sum, 1.0, orbit), s.inertia(), s.angular_velocity)
        })
    }
}
