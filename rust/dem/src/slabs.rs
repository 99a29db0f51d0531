//! Contact forces and motion slab by slab, side by side when there are threads.
//!
//! Each slab sums the forces of its rows into loads of its own, which reach into the rows of later slabs; a disc then
//! adds up what the slabs have for it in slab order. Slabs depend on the number of discs alone, so results do not depend
//! on the number of threads. Threads come from rayon, which steals work: when another job holds a core, the threads that
//! do run take over what is left.

use crate::disc::Disc;
use crate::forces::{self, Load};
use crate::kernel::{self, Motion, Simd};
use crate::law::PairLaw;
use crate::neighbours::Neighbours;
use crate::periodic::Image;
use crate::walls::{Flow, Side, Walls};
use rayon::prelude::*;

/// Discs that one thread takes at a time where they do not depend on each other.
const CHUNK: usize = 2048;

/// r = r_ref · `factor` for all discs.
pub(crate) fn scale_radii(parallel: bool, factor: f64, discs: &mut [Disc], reference: &[f64]) {
    let scale = |(discs, reference): (&mut [Disc], &[f64])| {
        for (disc, radius) in discs.iter_mut().zip(reference) {
            disc.radius = radius * factor;
        }
    };
    if parallel {
        discs.par_chunks_mut(CHUNK).zip(reference.par_chunks(CHUNK)).for_each(scale);
    } else {
        scale((discs, reference));
    }
}

/// Loads of each slab, kept to save their allocation.
#[derive(Clone, Debug, Default)]
pub(crate) struct SlabLoads(Vec<Vec<Load>>);

impl SlabLoads {
    /// Pair forces of all slabs.
    pub fn sum_pairs(
        &mut self,
        parallel: bool,
        (simd, law): (Simd, PairLaw),
        discs: &[Disc],
        neighbours: &mut Neighbours,
    ) {
        let parts = neighbours.pairs.parts();
        self.0.resize_with(parts.len(), Vec::new);
        let sum = |(part, loads): (crate::contacts::PairSlab, &mut Vec<Load>)| {
            loads.clear();
            loads.resize(part.reach - part.first, Load::default());
            kernel::add_pairs(simd, law, discs, part, loads);
        };
        if parallel {
            parts.into_par_iter().zip(&mut self.0).for_each(sum);
        } else {
            parts.into_iter().zip(&mut self.0).for_each(sum);
        }
    }

    /// Adds the loads of the ghosts of a periodic box, which come after `discs` discs, to those of their owners.
    pub fn fold(&mut self, discs: usize, ghosts: &[Image]) {
        if ghosts.is_empty() {
            return;
        }
        // The list of a periodic box is one slab.
        let (own, of_ghosts) = self.0[0].split_at_mut(discs);
        for (ghost, load) in ghosts.iter().zip(of_ghosts) {
            own[ghost.owner as usize].add(load);
        }
    }

    /// Adds the forces of one wall, and returns the force on it.
    pub fn add_wall(
        &mut self,
        law: PairLaw,
        side: Side,
        (walls, flow): (&Walls, Flow),
        discs: &[Disc],
        neighbours: &mut Neighbours,
    ) -> [f64; 2] {
        let slabs = neighbours.pairs.slabs();
        let contacts = &mut neighbours.walls[side as usize];
        let mut slab = 0;
        forces::add_wall(law, side, (walls, flow), discs, contacts, |disc, load| {
            // Discs of a wall come in growing order.
            while slabs[slab].rows.end <= disc {
                slab += 1;
            }
            self.0[slab][disc - slabs[slab].rows.start].add(&load);
        })
    }

    /// Adds up the loads of each disc into `loads`, and moves the discs. Returns the square of the largest speed.
    pub fn move_discs(
        &self,
        parallel: bool,
        (simd, motion): (Simd, Motion),
        neighbours: &Neighbours,
        discs: &mut [Disc],
        loads: &mut [Load],
    ) -> f64 {
        let slabs = neighbours.pairs.slabs();
        let mut tasks = Vec::with_capacity(slabs.len());
        let (mut discs, mut loads) = (discs, loads);
        for (number, slab) in slabs.iter().enumerate() {
            let (own_discs, later_discs) = discs.split_at_mut(slab.rows.len());
            let (own_loads, later_loads) = loads.split_at_mut(slab.rows.len());
            (discs, loads) = (later_discs, later_loads);
            tasks.push((number, own_discs, own_loads));
        }
        let work = |(number, discs, loads): (usize, &mut [Disc], &mut [Load])| {
            let first = slabs[number].rows.start;
            loads.copy_from_slice(&self.0[number][..loads.len()]);
            for (earlier, from) in slabs[..number].iter().zip(&self.0) {
                let reached = earlier.reach.saturating_sub(first).min(loads.len());
                if reached > 0 {
                    let offset = first - earlier.rows.start;
                    for (load, part) in loads[..reached].iter_mut().zip(&from[offset..]) {
                        load.add(part);
                    }
                }
            }
            kernel::advance(simd, motion, discs, loads)
        };
        if parallel {
            tasks.into_par_iter().map(work).reduce(|| 0.0, f64::max)
        } else {
            tasks.into_iter().map(work).fold(0.0, f64::max)
        }
    }
}
