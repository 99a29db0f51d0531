//! Lists of candidate contacts (pairs near enough to touch soon), with the friction history of each.

use crate::law::History;
use msdd_engine::rows::{Rows, Slab};

/// Blocks of a slab from which it is larger than the second-level cache of common processors.
const FAR_FROM: usize = 16;

/// Candidate pairs with their histories, stored by columns.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct PairList {
    pub(crate) rows: Rows,
    history: [Vec<f64>; 4],
}

/// A run of consecutive pairs that the kernels work through in one call.
pub(crate) struct Pairs<'a> {
    pub i: &'a [u32],
    pub j: &'a [u32],
    pub history: [&'a mut [f64]; 4],
    /// All indices of the pairs are in `first..reach`.
    pub first: usize,
    pub reach: usize,
    /// To which loads the forces on i and on j are added; all are in `first..loads_reach`.
    pub loads: [&'a [u32]; 2],
    pub loads_reach: usize,
    /// Whether spheres and pairs are so many that they are not in the caches.
    pub far: bool,
}

/// The part of a pair list that one thread works on: a slab and the friction history of its pairs.
pub(crate) struct SlabPairs<'a> {
    pub slab: &'a Slab,
    i: &'a [u32],
    j: &'a [u32],
    history: [&'a mut [f64]; 4],
}

impl SlabPairs<'_> {
    /// The pairs of the block of the given number.
    pub fn block(&mut self, number: usize) -> Pairs<'_> {
        let block = &self.slab.blocks[number];
        let own = block.pairs.start - self.slab.pairs.start..block.pairs.end - self.slab.pairs.start;
        Pairs {
            i: &self.i[own.clone()],
            j: &self.j[own.clone()],
            history: self.history.each_mut().map(|column| &mut column[own.clone()]),
            first: block.rows.start,
            reach: block.reach,
            loads: [&self.i[own.clone()], &self.j[own]],
            loads_reach: block.reach,
            far: self.slab.blocks.len() > FAR_FROM,
        }
    }
}

impl PairList {
    /// Candidates without history.
    pub(crate) fn new(rows: Rows) -> Self {
        let count = rows.len();
        Self { rows, history: std::array::from_fn(|_| vec![0.0; count]) }
    }

    /// The pairs across the border that stand apart; `border` says to which loads their forces are added.
    pub(crate) fn across<'a>(&'a mut self, border: &'a Border) -> Pairs<'a> {
        let across = self.rows.across();
        Pairs {
            i: &self.rows.i()[across.clone()],
            j: &self.rows.j()[across.clone()],
            history: self.history.each_mut().map(|column| &mut column[across.clone()]),
            first: 0,
            reach: self.rows.grains(),
            loads: border.loads.each_ref().map(Vec::as_slice),
            loads_reach: border.owners.len(),
            far: true,
        }
    }

    /// The list divided into its slabs, which threads may work on in parallel.
    pub(crate) fn parts(&mut self) -> Vec<SlabPairs<'_>> {
        let mut rest = self.history.each_mut().map(Vec::as_mut_slice);
        let mut parts = Vec::with_capacity(self.rows.slabs().len());
        for slab in self.rows.slabs() {
            let history = rest.each_mut().map(|column| {
                let (own, after) = std::mem::take(column).split_at_mut(slab.pairs.len());
                *column = after;
                own
            });
            let (i, j) = (&self.rows.i()[slab.pairs.clone()], &self.rows.j()[slab.pairs.clone()]);
            parts.push(SlabPairs { slab, i, j, history });
        }
        parts
    }

    /// History of pair number k.
    pub fn history(&self, k: usize) -> History {
        std::array::from_fn(|column| self.history[column][k])
    }

    pub(crate) fn set_history(&mut self, k: usize, history: History) {
        for (column, value) in self.history.iter_mut().zip(history) {
            column[k] = value;
        }
    }
}

/// The spheres that have pairs across the border of a periodic box, where these stand apart.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Border {
    /// Their numbers, increasing.
    pub(crate) owners: Vec<u32>,
    /// For i and j of each of these pairs, which of `owners` it is, or is an image of.
    loads: [Vec<u32>; 2],
}

impl Border {
    /// `ghosts` are the owners of the images that are numbered behind the spheres.
    pub(crate) fn new(rows: &Rows, ghosts: impl Fn(usize) -> u32) -> Self {
        let across = rows.across();
        let of_j = rows.j()[across.clone()].iter().map(|&j| ghosts(j as usize - rows.rows()));
        let pairs = [rows.i()[across].to_vec(), of_j.collect()];
        let mut owners = pairs.concat();
        owners.sort_unstable();
        owners.dedup();
        let place = |sphere: &u32| owners.binary_search(sphere).map_or(u32::MAX, |place| place as u32);
        let loads = pairs.map(|spheres| spheres.iter().map(place).collect());
        Self { owners, loads }
    }
}

/// Spheres within the search distance of one wall, by increasing number, with their histories (force on the sphere).
#[derive(Clone, Debug, Default, PartialEq)]
pub struct WallContacts {
    pub(crate) sphere: Vec<u32>,
    pub(crate) history: Vec<History>,
}

/// The contacts of one wall that the sweep over the spheres has not reached yet.
pub(crate) struct WallPart<'a> {
    pub sphere: &'a [u32],
    pub history: &'a mut [History],
}

impl<'a> WallPart<'a> {
    /// Removes the contacts of spheres below `end` from the front and returns them.
    pub fn take_below(&mut self, end: usize) -> WallPart<'a> {
        let count = self.sphere.iter().take_while(|&&sphere| (sphere as usize) < end).count();
        let (sphere, later) = self.sphere.split_at(count);
        let (history, later_histories) = std::mem::take(&mut self.history).split_at_mut(count);
        (self.sphere, self.history) = (later, later_histories);
        WallPart { sphere, history }
    }
}

impl WallContacts {
    /// The contacts divided by slabs: those of the spheres of each slab's rows.
    pub(crate) fn parts(&mut self, slabs: &[Slab]) -> Vec<WallPart<'_>> {
        let mut rest = WallPart { sphere: &self.sphere, history: &mut self.history };
        slabs.iter().map(|slab| rest.take_below(slab.rows.end)).collect()
    }

    /// History of the sphere; 0 if it is not in the list.
    pub fn history_of(&self, sphere: u32) -> History {
        self.sphere.binary_search(&sphere).map_or([0.0; 4], |k| self.history[k])
    }

    /// Returns false if the sphere is not in the list.
    pub(crate) fn set_history(&mut self, sphere: u32, history: History) -> bool {
        self.sphere.binary_search(&sphere).map(|k| self.history[k] = history).is_ok()
    }
}
