//! Heat pipes between discs, slab by slab as the contact forces are (see `slabs`): same bits on any number of threads.

use crate::contacts::PairList;
use crate::disc::Disc;
use rayon::prelude::*;
use std::ops::Range;

/// All pipes between discs.
#[derive(Clone, Debug, Default)]
pub(crate) struct Pipes(Vec<Part>);

/// The pipes whose first disc is in one slab.
#[derive(Clone, Debug, Default)]
struct Part {
    rows: Range<usize>,
    /// Touching pairs and their conductance k A/|d| [W/K]: the first `count`, the rest has no meaning.
    pairs: Vec<(u32, u32, f64)>,
    count: usize,
    /// Heat flow [W] into the discs from `rows.start` on as far as the pipes reach.
    flow: Vec<f64>,
}

impl Part {
    fn pairs(&self) -> &[(u32, u32, f64)] {
        &self.pairs[..self.count]
    }

    /// Takes the touching ones of the candidates `i`, `j`. Every candidate is worked out and written; only a touching one
    /// moves on to the next place: no branch that the processor would guess wrong.
    fn fill(&mut self, i: &[u32], j: &[u32], discs: &[Disc], conductivity: f64) {
        self.pairs.resize(i.len(), (0, 0, 0.0));
        let mut count = 0;
        for (&i, &j) in i.iter().zip(j) {
            let (a, b) = (&discs[i as usize], &discs[j as usize]);
            let (dx, dy, reach) = (b.x - a.x, b.y - a.y, a.radius + b.radius);
            let square = dx * dx + dy * dy;
            // |d| times the way from the first centre to the chord is `along`/2, and chord²·d² is this difference.
            let along = square + (a.radius - b.radius) * reach;
            let chord_distance = (4.0 * a.radius * a.radius * square - along * along).max(0.0).sqrt();
            self.pairs[count] = (i, j, conductivity * chord_distance / square);
            count += usize::from(square < reach * reach);
        }
        self.count = count;
    }

    fn sum_flow(&mut self, temperature: &[f64]) {
        let first = self.rows.start;
        self.flow.fill(0.0);
        for &(i, j, value) in &self.pairs[..self.count] {
            let (i, j) = (i as usize, j as usize);
            let flow = value * (temperature[j] - temperature[i]);
            self.flow[i - first] += flow;
            self.flow[j - first] -= flow;
        }
    }
}

impl Pipes {
    /// Takes the conductances of all touching pairs.
    pub fn connect(&mut self, parallel: bool, list: &PairList, discs: &[Disc], conductivity: f64) {
        let slabs = list.slabs();
        self.0.resize_with(slabs.len(), Part::default);
        for (part, slab) in self.0.iter_mut().zip(slabs) {
            part.rows = slab.rows.clone();
            part.flow.resize(slab.reach - slab.rows.start, 0.0);
        }
        let fill = |(part, slab): (&mut Part, &crate::contacts::Slab)| {
            let pairs = slab.pairs.clone();
            part.fill(&list.i()[pairs.clone()], &list.j()[pairs], discs, conductivity);
        };
        if parallel {
            self.0.par_iter_mut().zip(slabs).for_each(fill);
        } else {
            self.0.iter_mut().zip(slabs).for_each(fill);
        }
    }

    /// Flow into each disc at the given temperatures [K].
    pub fn sum_flow(&mut self, parallel: bool, temperature: &[f64]) {
        if parallel {
            self.0.par_iter_mut().for_each(|part| part.sum_flow(temperature));
        } else {
            self.0.iter_mut().for_each(|part| part.sum_flow(temperature));
        }
    }

    /// Adds flows [W] into discs, which come in growing order.
    pub fn add(&mut self, flows: impl Iterator<Item = (usize, f64)>) {
        let mut slab = 0;
        for (disc, flow) in flows {
            while self.0[slab].rows.end <= disc {
                slab += 1;
            }
            let part = &mut self.0[slab];
            part.flow[disc - part.rows.start] += flow;
        }
    }

    /// T += Δt q/(m c), q the sum of what the parts have for the disc, in their order (Eq. 5).
    pub fn warm(&self, parallel: bool, dt: f64, over_capacity: &[f64], temperature: &mut [f64]) {
        let mut tasks = Vec::with_capacity(self.0.len());
        let mut rest = temperature;
        for (number, part) in self.0.iter().enumerate() {
            let (own, later) = rest.split_at_mut(part.rows.len());
            rest = later;
            tasks.push((number, own));
        }
        let warm = |(number, temperature): (usize, &mut [f64])| {
            let rows = self.0[number].rows.clone();
            for part in &self.0[..=number] {
                let offset = (rows.start - part.rows.start).min(part.flow.len());
                let flow = &part.flow[offset..];
                for ((t, flow), o) in temperature.iter_mut().zip(flow).zip(&over_capacity[rows.clone()]) {
                    *t += dt * flow * o;
                }
            }
        };
        if parallel {
            tasks.into_par_iter().for_each(warm);
        } else {
            tasks.into_iter().for_each(warm);
        }
    }

    /// Adds each conductance to the diagonal entries of its two discs [W/K].
    pub fn add_diagonal(&self, diagonal: &mut [f64]) {
        for &(i, j, value) in self.0.iter().flat_map(Part::pairs) {
            diagonal[i as usize] += value;
            diagonal[j as usize] += value;
        }
    }

    /// Subtracts from `image` the off-diagonal part of the conductance matrix times `vector`.
    pub fn subtract_off_diagonal(&self, vector: &[f64], image: &mut [f64]) {
        for &(i, j, value) in self.0.iter().flat_map(Part::pairs) {
            image[i as usize] -= value * vector[j as usize];
            image[j as usize] -= value * vector[i as usize];
        }
    }
}
