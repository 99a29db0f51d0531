//! The sweep of a step: radii, contact forces and motion of the discs in one pass through memory.
//!
//! Row i of the pair list holds the partners j > i of disc i only. So once the rows of a block of discs have been
//! summed up, the loads of these discs are complete and no later row reads them: they can be moved while they are still
//! in the cache.
//!
//! Assemblies of thousands of discs are divided into slabs (consecutive rows), which threads sweep in parallel. The
//! first discs of a slab also belong to pairs of the slab before it; they are moved at the end, when their loads from
//! both slabs are known. The slabs depend on the number of discs alone, so results do not depend on the number of
//! threads. Threads take over work from each other: when another job holds a core, the threads that do run do the
//! remaining work.

use crate::contacts::{SlabPairs, WallPart};
use crate::disc::Disc;
use crate::forces::{self, Load};
use crate::kernel::{self, Motion};
use crate::law::PairLaw;
use crate::neighbours::Neighbours;
use crate::periodic::Image;
use crate::walls::{Flow, Side, Walls};
use msdd_engine::Simd;
use msdd_engine::Stage;
use msdd_engine::kernel::SharedGrains;
use msdd_engine::team;
use msdd_engine::vector::larger;
use std::ops::Range;

/// The work to be done on every disc.
#[derive(Clone, Copy)]
pub(crate) struct Sweep<'a> {
    pub simd: Simd,
    pub law: PairLaw,
    pub walls: &'a Walls,
    pub flow: Flow,
    /// Whether the walls shrink and stretch with the flow.
    pub affine_walls: bool,
    pub motion: Motion,
    /// Factor and reference radii [m]: new radii are their product. None: the radii stay.
    pub radii: Option<(f64, &'a [f64])>,
}

/// Results of a sweep.
#[derive(Clone, Copy, Default)]
pub(crate) struct Swept {
    /// Square of the largest speed [m²/s²]; NaN when any speed is NaN.
    pub fastest2: f64,
    pub wall_force: [[f64; 2]; 4],
}

impl Swept {
    fn add(&mut self, other: &Self) {
        self.fastest2 = larger(self.fastest2, other.fastest2);
        for (sum, part) in self.wall_force.iter_mut().flatten().zip(other.wall_force.iter().flatten()) {
            *sum += part;
        }
    }
}

/// Loads of the last sweep: for each slab those of its own rows, and those of the rows of later slabs that its pairs
/// refer to.
#[derive(Clone, Debug, Default)]
pub(crate) struct SlabLoads(Vec<Vec<Load>>);

impl SlabLoads {
    /// Loads in the order of the discs.
    pub fn iter(&self, neighbours: &Neighbours) -> impl Iterator<Item = &Load> {
        let slabs = neighbours.pairs.slabs().iter();
        slabs.zip(&self.0).flat_map(|(slab, loads)| &loads[..slab.rows.len()])
    }

    /// Sweeps over all discs, in parallel when `parallel`. `mark` is called as the stages end, but not when `parallel`.
    /// In a periodic box the ghosts stand behind the discs, in place and with their radii; they are not moved.
    pub fn sweep(
        &mut self,
        parallel: bool,
        sweep: Sweep,
        discs: &mut [Disc],
        neighbours: &mut Neighbours,
        mut mark: impl FnMut(Stage),
    ) -> Swept {
        let slabs = neighbours.pairs.slabs().to_vec();
        self.0.resize_with(slabs.len(), Vec::new);
        for slab in &slabs {
            sweep.scale(&mut discs[slab.rows.start..slab.shared], slab.rows.start);
        }
        let Neighbours { pairs, walls, ghosts, .. } = neighbours;
        let mut walls = walls.each_mut().map(|contacts| contacts.parts(&slabs).into_iter());
        let views = SharedGrains::divide(discs, &slabs);
        let parts = pairs.parts(sweep.law.conductivity.is_some()).into_iter().zip(views).zip(&mut self.0);
        let tasks: Vec<Task> = parts
            .filter_map(|((pairs, discs), loads)| {
                let [left, right, bottom, top] = &mut walls;
                let walls = [left.next()?, right.next()?, bottom.next()?, top.next()?];
                Some(Task { pairs, discs, walls, ghosts, loads })
            })
            .collect();
        let swept = if parallel {
            team::share(tasks, |task| task.run(&sweep, |_| ()))
        } else {
            tasks.into_iter().map(|task| task.run(&sweep, &mut mark)).collect()
        };
        let mut result = Swept::default();
        swept.iter().for_each(|part| result.add(part));
        for (number, slab) in slabs.iter().enumerate().skip(1) {
            let rows = slab.rows.start..slab.shared;
            let loads = self.complete(number, rows.clone(), &slabs);
            let fastest2 = kernel::advance(sweep.simd, sweep.motion, &mut discs[rows], loads);
            result.fastest2 = larger(result.fastest2, fastest2);
        }
        result
    }

    /// The loads of `rows`, the first of a slab, with the contributions of earlier slabs added.
    fn complete(&mut self, number: usize, rows: Range<usize>, slabs: &[msdd_engine::rows::Slab]) -> &[Load] {
        let (earlier, later) = self.0.split_at_mut(number);
        let own = &mut later[0][..rows.len()];
        for (slab, from) in slabs.iter().zip(earlier) {
            let begin = rows.start - slab.rows.start;
            let reached = from.get(begin..).unwrap_or_default();
            for (load, part) in own.iter_mut().zip(reached) {
                load.add(part);
            }
        }
        own
    }
}

impl Sweep<'_> {
    /// Sets the radii of `discs`, the first of which is disc `first`.
    pub fn scale(&self, discs: &mut [Disc], first: usize) {
        if let Some((factor, reference)) = self.radii {
            for (disc, radius) in discs.iter_mut().zip(&reference[first..]) {
                disc.radius = radius * factor;
            }
        }
    }
}

/// The sweep over one slab.
struct Task<'a> {
    pairs: SlabPairs<'a>,
    discs: SharedGrains<'a, Disc>,
    walls: [WallPart<'a>; 4],
    /// Ghosts of a periodic box (which is always one block): images behind the discs, whose loads are added to those of
    /// their owners.
    ghosts: &'a [Image],
    loads: &'a mut Vec<Load>,
}

impl Task<'_> {
    fn run(mut self, sweep: &Sweep, mut mark: impl FnMut(Stage)) -> Swept {
        let slab = self.pairs.slab;
        let first = slab.rows.start;
        self.loads.resize(slab.reach - first, Load::default());
        let mut swept = Swept::default();
        // Discs below `ready` have their new radius, and loads that were set to zero.
        let mut ready = first;
        for (number, block) in slab.blocks.iter().enumerate() {
            let (from, to) = (ready, block.reach.max(ready));
            self.loads[from - first..to - first].fill(Load::default());
            let own = self.discs.own();
            let to_scale = from.max(own.start)..to.min(own.end);
            if !to_scale.is_empty() {
                sweep.scale(self.discs.rows_mut(to_scale.clone()), to_scale.start);
            }
            ready = to;
            let begin = block.rows.start;
            let loads = &mut self.loads[begin - first..];
            let discs = self.discs.rows(begin..block.reach);
            kernel::add_pairs(sweep.simd, sweep.law, discs, self.pairs.block(number), loads);
            mark(Stage::Pairs);
            for side in Side::ALL {
                let contacts = self.walls[side as usize].take_below(block.rows.end);
                let flow = if sweep.affine_walls { sweep.flow.normal_to(side) } else { sweep.flow };
                let walls = (sweep.walls, flow);
                let force = forces::add_wall(sweep.law, side, walls, contacts, (begin, discs), loads);
                let [normal, tangential] = &mut swept.wall_force[side as usize];
                *normal += force[0];
                *tangential += force[1];
            }
            if !self.ghosts.is_empty() {
                let (own, of_ghosts) = self.loads.split_at_mut(block.rows.end);
                for (ghost, load) in self.ghosts.iter().zip(of_ghosts) {
                    own[ghost.owner as usize].add(load);
                }
            }
            mark(Stage::Walls);
            let movable = begin.max(own.start)..block.rows.end;
            if !movable.is_empty() {
                let loads = &self.loads[movable.start - first..movable.end - first];
                let discs = self.discs.rows_mut(movable);
                let fastest2 = kernel::advance(sweep.simd, sweep.motion, discs, loads);
                swept.fastest2 = larger(swept.fastest2, fastest2);
            }
            mark(Stage::Motion);
        }
        swept
    }
}
