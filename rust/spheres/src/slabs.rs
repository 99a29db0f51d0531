//! The sweep of a step: contact forces and motion of the spheres in one pass through memory. Loads are kept only as long
//! as they are being summed up.
//!
//! Row i of the pair list holds the partners j > i of sphere i only. So once the rows of a block of spheres have been
//! summed up, the loads of these spheres are complete and no later row reads them: they can be moved while they are
//! still in the cache. A small periodic box is one block, because its ghosts stand behind all spheres. In a large one the
//! pairs across the border stand apart: their forces are found first, and are what the loads of their spheres begin with.
//!
//! Assemblies of thousands of spheres are divided into slabs (consecutive rows), which threads sweep in parallel. The first
//! spheres of a slab also belong to pairs of the slab before it; they are moved at the end, when their loads from both slabs
//! are known. The slabs depend on the number of spheres alone, so results do not depend on the number of threads.

use crate::boundary::Wall;
use crate::contacts::{SlabPairs, WallPart};
use crate::forces::{self, Load};
use crate::kernel::{self, Motion};
use crate::law::ContactLaw;
use crate::neighbours::Neighbours;
use crate::space::plus;
use crate::sphere::Sphere;
use msdd_engine::kernel::SharedGrains;
use msdd_engine::rows::Slab;
use msdd_engine::vector::larger;
use msdd_engine::{Image, Simd, team};
use std::ops::Range;

/// The work to be done on every sphere.
#[derive(Clone, Copy)]
pub(crate) struct Sweep<'a> {
    pub simd: Simd,
    pub law: &'a ContactLaw,
    pub walls: &'a [Wall],
    pub motion: Motion,
}

/// Results of a sweep.
#[derive(Clone, Default)]
pub(crate) struct Swept {
    /// Square of the largest speed [m²/s²]; NaN when any speed is NaN.
    pub fastest2: f64,
    /// Force of the spheres on each wall [N].
    pub wall_force: Vec<[f64; 3]>,
}

impl Swept {
    fn add(&mut self, other: &Self) {
        self.fastest2 = larger(self.fastest2, other.fastest2);
        for (sum, part) in self.wall_force.iter_mut().zip(&other.wall_force) {
            *sum = plus(*sum, 1.0, *part);
        }
    }
}

/// Loads of a sweep.
#[derive(Clone, Debug, Default)]
pub(crate) struct SlabLoads {
    slabs: Vec<Window>,
    /// Of the pairs across the border that stand apart, for each sphere that has some.
    border: Vec<Load>,
    /// Whether the loads of all spheres are kept until the next sweep; else only those that are being summed up are.
    pub keep: bool,
}

/// Loads of consecutive rows, from `base` on: those whose sum is not complete, and as many before them as there is room for.
#[derive(Clone, Debug, Default)]
struct Window {
    base: usize,
    loads: Vec<Load>,
    /// Rows below have been set to zero, or to the loads of the border, at least.
    ready: usize,
    /// Those of the rows that earlier slabs refer to as well.
    shared: Vec<Load>,
}

impl Window {
    /// For the sweep over a slab.
    fn begin(&mut self, slab: &Slab, keep: bool) {
        (self.base, self.ready) = (slab.rows.start, slab.rows.start);
        let longest = slab.blocks.iter().map(|block| block.reach - block.rows.start).max().unwrap_or(0);
        let whole = slab.reach - slab.rows.start;
        self.loads.resize(if keep { whole } else { whole.min(2 * longest) }, Load::default());
        self.shared.clear();
    }

    /// Sets the rows up to `to` to zero, those that are not yet; rows below `from` are needed no more.
    fn reach(&mut self, from: usize, to: usize) {
        if to - self.base > self.loads.len() {
            self.loads.copy_within(from - self.base..self.ready - self.base, 0);
            self.base = from;
        }
        if to > self.ready {
            self.loads[self.ready - self.base..to - self.base].fill(Load::default());
            self.ready = to;
        }
    }

    /// From row `from` on.
    fn rows(&mut self, from: usize) -> &mut [Load] {
        &mut self.loads[from - self.base..]
    }
}

impl SlabLoads {
    /// Loads in the order of the spheres; of a sweep that kept them.
    pub fn iter(&self, neighbours: &Neighbours) -> impl Iterator<Item = &Load> {
        let slabs = neighbours.pairs.rows.slabs().iter();
        slabs.zip(&self.slabs).flat_map(|(slab, window)| &window.loads[..slab.rows.len()])
    }

    /// Sweeps over all spheres, in parallel when `parallel`. In a periodic box the ghosts stand behind the spheres, in
    /// place; they are not moved.
    pub fn sweep(
        &mut self,
        parallel: bool,
        sweep: Sweep,
        spheres: &mut [Sphere],
        neighbours: &mut Neighbours,
    ) -> Swept {
        let slabs = neighbours.pairs.rows.slabs().to_vec();
        self.slabs.resize_with(slabs.len(), Window::default);
        self.slabs.iter_mut().zip(&slabs).for_each(|(window, slab)| window.begin(slab, self.keep));
        let Neighbours { pairs, walls, ghosts, border, .. } = neighbours;
        self.border.clear();
        self.border.resize(border.owners.len(), Load::default());
        kernel::add_pairs(sweep.simd, sweep.law, spheres, pairs.across(border), &mut self.border);
        let ghosts: &[_] = if border.owners.is_empty() { ghosts } else { &[] };
        let mut walls: Vec<_> = walls.iter_mut().map(|contacts| contacts.parts(&slabs).into_iter()).collect();
        let views = SharedGrains::divide(spheres, &slabs);
        let tasks: Vec<Task> = pairs
            .parts()
            .into_iter()
            .zip(views)
            .zip(&mut self.slabs)
            .map(|((pairs, spheres), window)| {
                let walls = walls.iter_mut().filter_map(Iterator::next).collect();
                let place = |row: usize| border.owners.partition_point(|&owner| (owner as usize) < row);
                let own = place(pairs.slab.rows.start)..place(pairs.slab.rows.end);
                let border = (&border.owners[own.clone()], &self.border[own]);
                Task { pairs, spheres, walls, ghosts, border, window }
            })
            .collect();
        let swept = if parallel {
            team::share(tasks, |task| task.run(&sweep))
        } else {
            tasks.into_iter().map(|task| task.run(&sweep)).collect()
        };
        let mut result = Swept { fastest2: 0.0, wall_force: vec![[0.0; 3]; sweep.walls.len()] };
        swept.iter().for_each(|part| result.add(part));
        for (number, slab) in slabs.iter().enumerate().skip(1) {
            let rows = slab.rows.start..slab.shared;
            self.complete(number, &rows);
            let loads = &self.slabs[number].shared;
            let fastest2 = kernel::advance(sweep.simd, sweep.motion, &mut spheres[rows], loads);
            result.fastest2 = larger(result.fastest2, fastest2);
        }
        result
    }

    /// Adds the contributions of earlier slabs to the loads of `rows`, the first of a slab.
    fn complete(&mut self, number: usize, rows: &Range<usize>) {
        let (earlier, later) = self.slabs.split_at_mut(number);
        let own = &mut later[0];
        for from in earlier {
            let reached = from.loads.get(rows.start - from.base..from.ready - from.base).unwrap_or_default();
            for (load, part) in own.shared.iter_mut().zip(reached) {
                load.add(part);
            }
        }
        if self.keep {
            own.loads[..rows.len()].copy_from_slice(&own.shared);
        }
    }
}

/// The sweep over one slab.
struct Task<'a> {
    pairs: SlabPairs<'a>,
    spheres: SharedGrains<'a, Sphere>,
    walls: Vec<WallPart<'a>>,
    /// Ghosts of a periodic box that is one block: images behind the spheres, whose loads are added to those of their
    /// owners.
    ghosts: &'a [Image<3>],
    /// Spheres of these rows that have pairs across the border which stand apart, and the loads of these pairs.
    border: (&'a [u32], &'a [Load]),
    window: &'a mut Window,
}

impl Task<'_> {
    /// Begins the loads of the rows up to `to`.
    fn reach(&mut self, from: usize, to: usize) {
        self.window.reach(from, to);
        let (owners, loads) = self.border;
        let count = owners.iter().take_while(|&&owner| (owner as usize) < to).count();
        for (&owner, load) in owners[..count].iter().zip(loads) {
            self.window.rows(owner as usize)[0] = *load;
        }
        self.border = (&owners[count..], &loads[count..]);
    }

    fn run(mut self, sweep: &Sweep) -> Swept {
        let slab = self.pairs.slab;
        let mut swept = Swept { fastest2: 0.0, wall_force: vec![[0.0; 3]; self.walls.len()] };
        for (number, block) in slab.blocks.iter().enumerate() {
            let begin = block.rows.start;
            self.reach(begin, block.reach);
            if let Some(next) = slab.blocks.get(number + 1) {
                self.spheres.fetch(block.reach..next.reach);
            }
            let loads = self.window.rows(begin);
            let spheres = self.spheres.rows(begin..block.reach);
            kernel::add_pairs(sweep.simd, sweep.law, spheres, self.pairs.block(number), loads);
            for ((wall, contacts), force) in
                sweep.walls.iter().zip(&mut self.walls).zip(&mut swept.wall_force)
            {
                let contacts = contacts.take_below(block.rows.end);
                *force =
                    plus(*force, 1.0, forces::add_wall(sweep.law, wall, contacts, (begin, spheres), loads));
            }
            if !self.ghosts.is_empty() {
                let (own, of_ghosts) = loads.split_at_mut(block.rows.len());
                for (ghost, load) in self.ghosts.iter().zip(of_ghosts) {
                    own[ghost.owner as usize].add(load);
                }
            }
            let shared = slab.shared.clamp(begin, block.rows.end) - begin;
            let loads = &self.window.loads[begin - self.window.base..];
            self.window.shared.extend_from_slice(&loads[..shared]);
            let movable = begin + shared..block.rows.end;
            if !movable.is_empty() {
                let loads = &loads[shared..block.rows.len()];
                let spheres = self.spheres.rows_mut(movable);
                let fastest2 = kernel::advance(sweep.simd, sweep.motion, spheres, loads);
                swept.fastest2 = larger(swept.fastest2, fastest2);
            }
        }
        swept
    }
}

#[cfg(test)]
mod tests {
    use crate::space::{length, minus};
    use crate::{Boundary, Cell, Material, Simulation, Sphere, Stiffness, Wall};

    /// More spheres than a periodic box has that is one block, on a jittered lattice; they overlap and turn.
    fn many(boundary: Boundary) -> Simulation {
        let stiffness = Stiffness::HertzMindlin { young_modulus: 1e7, poisson_ratio: 0.3 };
        let material =
            Material { density: 2500.0, stiffness, friction: 0.3, wall_friction: 0.3, restitution: 1.0 };
        let spheres = (0..SIDE * SIDE * SIDE).map(|k| {
            let u = |a: f64| (a * (k + 1) as f64).fract() - 0.5;
            let place = [k % SIDE, k / SIDE % SIDE, k / SIDE / SIDE];
            let shift = [u(0.618_034), u(0.414_214), u(0.732_051)];
            let position = std::array::from_fn(|m| SPACING * (place[m] as f64 + 0.5 + 0.1 * shift[m]));
            let mut sphere = Sphere::at_rest(position, 1e-3, 2500.0);
            sphere.velocity = [0.01 * u(0.193_7), 0.01 * u(0.287_9), 0.01 * u(0.324_718)];
            sphere.angular_velocity = [u(0.154_3), 0.0, 1.0];
            sphere
        });
        Simulation::new(material, spheres.collect(), boundary).unwrap()
    }

    const SIDE: usize = 22;
    const SPACING: f64 = 1.94e-3;

    /// A sweep that keeps all loads moves the spheres as one that does not, to the last bit, and what it keeps are the contact
    /// forces and their torques.
    #[test]
    fn loads_that_are_kept_are_those_of_the_contacts() {
        let edge = SIDE as f64 * SPACING;
        let floor = vec![Wall::at_rest([0.0; 3], [0.0, 0.0, 1.0])];
        let boundaries = [
            Boundary::Walls(Wall::block([edge; 3])),
            Boundary::Periodic(Cell::block([edge; 3])),
            Boundary::Between(Cell::block([edge, edge, 2.0 * edge]), floor),
        ];
        for boundary in boundaries {
            let mut simulation = many(boundary);
            simulation.take_steps(20);
            // The forces are of the places before the motion: a short step hardly moves.
            simulation.time_step *= 1e-6;
            let mut keeping = simulation.clone();
            keeping.loads.keep = true;
            simulation.step();
            keeping.step();
            assert!(simulation.spheres == keeping.spheres);
            let loads = keeping.loads();
            let largest = loads.iter().map(|load| length(load.force)).fold(0.0, f64::max);
            let twist = loads.iter().map(|load| length(load.torque)).fold(0.0, f64::max);
            assert!(largest > 0.0 && twist > 0.0);
            let kept: Vec<_> = keeping.loads.iter(&keeping.neighbours).collect();
            assert_eq!(kept.len(), loads.len());
            for (kept, load) in kept.into_iter().zip(&loads) {
                assert!(length(minus(kept.force, load.force)) < 1e-4 * largest);
                assert!(length(minus(kept.torque, load.torque)) < 1e-4 * twist);
            }
        }
    }
}
