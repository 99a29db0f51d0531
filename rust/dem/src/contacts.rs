//! Lists of candidate contacts (pairs near enough to touch soon), one row per disc, with the tangential force of each
//! as its friction history.

use std::ops::Range;

/// Pairs within the search distance, ordered by i, then j; i < j.
///
/// The order makes sums over contacts independent of when the list was last rebuilt, because a candidate that does not
/// touch adds nothing. Every index is below [`PairList::discs`]. This is checked when the list is built, and the
/// kernels rely on it.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct PairList {
    /// Number of discs, ghosts (images across a periodic border) included.
    discs: usize,
    /// Row i is `start[i]..start[i + 1]`.
    start: Vec<u32>,
    i: Vec<u32>,
    j: Vec<u32>,
    /// f_t [N] of the last step, on j along t; 0 when the contact is open.
    pub(crate) tangential: Vec<f64>,
    /// k A/|d| [W/K] in the geometry of the last step; 0 when the contact is open. Empty without heat.
    pub(crate) conductance: Vec<f64>,
    slabs: Vec<Slab>,
}

/// Consecutive rows that one thread works through. The division into slabs depends on the number of discs and not on
/// the number of threads, so results do not depend on the number of threads.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Slab {
    pub rows: Range<usize>,
    pub pairs: Range<usize>,
    /// All discs of the slab's pairs are in `rows.start..reach`; `reach` is at least `rows.end`.
    pub reach: usize,
    /// Pairs of earlier slabs may refer to rows below this one.
    pub shared: usize,
    pub blocks: Vec<Block>,
}

/// Consecutive rows that are worked through together because their discs fit into the cache.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Block {
    pub rows: Range<usize>,
    pub pairs: Range<usize>,
    /// The rows of the block and all discs of its pairs are in `rows.start..reach`.
    pub reach: usize,
}

/// Number of slabs of a list. Assemblies as small as RVEs have one, because pairs across two slabs take extra work.
fn slab_count(discs: usize) -> usize {
    if discs < 4000 { 1 } else { 4 }
}

/// Rows of a block: its discs, loads and pairs stay in the caches next to the core.
const BLOCK_ROWS: usize = 256;

/// A run of consecutive pairs that the kernels work through in one call.
pub(crate) struct Pairs<'a> {
    pub i: &'a [u32],
    pub j: &'a [u32],
    pub tangential: &'a mut [f64],
    /// One value per pair, or empty without heat.
    pub conductance: &'a mut [f64],
    /// All indices of the pairs are in `first..reach`.
    pub first: usize,
    pub reach: usize,
}

/// The part of a pair list that one thread works on: a slab and the friction history of its pairs.
pub(crate) struct SlabPairs<'a> {
    pub slab: &'a Slab,
    i: &'a [u32],
    j: &'a [u32],
    tangential: &'a mut [f64],
    conductance: &'a mut [f64],
}

impl SlabPairs<'_> {
    /// The pairs of the block of the given number.
    pub fn block(&mut self, number: usize) -> Pairs<'_> {
        let block = &self.slab.blocks[number];
        let own = block.pairs.start - self.slab.pairs.start..block.pairs.end - self.slab.pairs.start;
        let conductance = match self.conductance.is_empty() {
            true => &mut [],
            false => &mut self.conductance[own.clone()],
        };
        Pairs {
            i: &self.i[own.clone()],
            j: &self.j[own.clone()],
            tangential: &mut self.tangential[own],
            conductance,
            first: block.rows.start,
            reach: block.reach,
        }
    }
}

impl PairList {
    /// A list over `discs` discs. `partners(i, row)` puts the partners j > i of disc i into `row`, in any order.
    pub(crate) fn build(discs: usize, partners: impl FnMut(usize, &mut Vec<u32>)) -> Self {
        Self::build_over(discs, discs, (slab_count(discs), BLOCK_ROWS), partners)
    }

    /// As [`PairList::build`], with a row for each of the first `rows` of `discs` discs, divided into a given number of
    /// slabs with blocks of `block_rows` rows.
    pub(crate) fn build_over(
        rows: usize,
        discs: usize,
        (slabs, block_rows): (usize, usize),
        mut partners: impl FnMut(usize, &mut Vec<u32>),
    ) -> Self {
        let mut list = Self { discs, start: vec![0], ..Self::default() };
        let mut row = Vec::new();
        for i in 0..rows {
            row.clear();
            partners(i, &mut row);
            row.sort_unstable();
            assert!(row.last().is_none_or(|&last| (last as usize) < discs));
            list.i.extend(row.iter().map(|_| i as u32));
            list.j.extend_from_slice(&row);
            list.start.push(list.j.len() as u32);
        }
        list.tangential = vec![0.0; list.j.len()];
        list.slabs = list.divide(slabs, block_rows);
        list
    }

    fn divide(&self, count: usize, block_rows: usize) -> Vec<Slab> {
        let edge = |s: usize| self.rows() * s / count;
        let mut slabs: Vec<Slab> = Vec::with_capacity(count);
        for s in 0..count {
            let rows = edge(s)..edge(s + 1);
            let begins = rows.clone().step_by(block_rows);
            let block = |begin: usize| self.block(begin..rows.end.min(begin + block_rows));
            let blocks: Vec<Block> = begins.map(block).collect();
            let reach = blocks.iter().map(|block| block.reach).max().unwrap_or(rows.end);
            let earlier = slabs.iter().map(|slab| slab.reach).max().unwrap_or(0);
            let shared = earlier.clamp(rows.start, rows.end);
            slabs.push(Slab { pairs: self.of_rows(rows.clone()), rows, reach, shared, blocks });
        }
        slabs
    }

    fn block(&self, rows: Range<usize>) -> Block {
        let pairs = self.of_rows(rows.clone());
        let last = self.j[pairs.clone()].iter().max().map_or(0, |&j| j as usize + 1);
        Block { reach: last.max(rows.end), rows, pairs }
    }

    pub(crate) fn slabs(&self) -> &[Slab] {
        &self.slabs
    }

    /// The list divided into its slabs, which threads may work on in parallel; with room for conductances when heat is
    /// on.
    pub(crate) fn parts(&mut self, heat: bool) -> Vec<SlabPairs<'_>> {
        self.conductance.resize(if heat { self.j.len() } else { 0 }, 0.0);
        let mut rest = self.tangential.as_mut_slice();
        let mut rest_of_conductance = self.conductance.as_mut_slice();
        let mut parts = Vec::with_capacity(self.slabs.len());
        for slab in &self.slabs {
            let (tangential, after) = rest.split_at_mut(slab.pairs.len());
            rest = after;
            let pairs = slab.pairs.clone();
            let (conductance, after) = rest_of_conductance.split_at_mut(if heat { pairs.len() } else { 0 });
            rest_of_conductance = after;
            let (i, j) = (&self.i[pairs.clone()], &self.j[pairs]);
            parts.push(SlabPairs { slab, i, j, tangential, conductance });
        }
        parts
    }

    /// Copies the friction history of the pairs that are in `old` too.
    pub(crate) fn inherit(&mut self, old: &Self) {
        if old.discs == self.discs {
            for k in 0..self.len() {
                self.tangential[k] = old.tangential_of(self.i[k] as usize, self.j[k]);
            }
        }
    }

    /// Number of rows; the discs after them are ghosts.
    pub(crate) fn rows(&self) -> usize {
        self.start.len().saturating_sub(1)
    }

    /// Number of discs that the indices refer to.
    pub fn discs(&self) -> usize {
        self.discs
    }

    /// Number of candidate pairs.
    pub fn len(&self) -> usize {
        self.j.len()
    }

    pub fn is_empty(&self) -> bool {
        self.j.is_empty()
    }

    pub fn i(&self) -> &[u32] {
        &self.i
    }

    pub fn j(&self) -> &[u32] {
        &self.j
    }

    /// The range of candidates that belong to the rows `rows`.
    pub fn of_rows(&self, rows: Range<usize>) -> Range<usize> {
        self.start[rows.start] as usize..self.start[rows.end] as usize
    }

    /// f_t of the pair (i, j), i < j; 0 if the pair is not in the list.
    pub fn tangential_of(&self, i: usize, j: u32) -> f64 {
        let row = self.of_rows(i..i + 1);
        match self.j[row.clone()].binary_search(&j) {
            Ok(k) => self.tangential[row.start + k],
            Err(_) => 0.0,
        }
    }
}

impl PairList {
    /// Sets f_t of the pair (i, j), i < j. Returns false if the pair is not in the list.
    pub(crate) fn set_tangential(&mut self, i: usize, j: u32, force: f64) -> bool {
        let row = self.of_rows(i..i + 1);
        let found = self.j[row.clone()].binary_search(&j);
        found.map(|k| self.tangential[row.start + k] = force).is_ok()
    }
}

/// Discs within the search distance of one wall, by increasing number.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct WallContacts {
    pub(crate) disc: Vec<u32>,
    /// f_t [N] on the disc along t; 0 when the contact is open.
    pub(crate) tangential: Vec<f64>,
}

/// The contacts of one wall that the sweep over the discs has not reached yet.
pub(crate) struct WallPart<'a> {
    pub disc: &'a [u32],
    pub tangential: &'a mut [f64],
}

impl<'a> WallPart<'a> {
    /// Removes the contacts of discs below `end` from the front and returns them.
    pub fn take_below(&mut self, end: usize) -> WallPart<'a> {
        let count = self.disc.iter().take_while(|&&disc| (disc as usize) < end).count();
        let (disc, later) = self.disc.split_at(count);
        let (tangential, later_histories) = std::mem::take(&mut self.tangential).split_at_mut(count);
        (self.disc, self.tangential) = (later, later_histories);
        WallPart { disc, tangential }
    }
}

impl WallContacts {
    /// Sets f_t of the disc. Returns false if the disc is not in the list.
    pub(crate) fn set_tangential(&mut self, disc: u32, force: f64) -> bool {
        self.disc.binary_search(&disc).map(|k| self.tangential[k] = force).is_ok()
    }

    /// The contacts divided by slabs: those of the discs of each slab's rows.
    pub(crate) fn parts(&mut self, slabs: &[Slab]) -> Vec<WallPart<'_>> {
        let (mut discs, mut histories) = (self.disc.as_slice(), self.tangential.as_mut_slice());
        let mut parts = Vec::with_capacity(slabs.len());
        for slab in slabs {
            let count = discs.partition_point(|&disc| (disc as usize) < slab.rows.end);
            let (own, later) = discs.split_at(count);
            let (tangential, later_histories) = std::mem::take(&mut histories).split_at_mut(count);
            (discs, histories) = (later, later_histories);
            parts.push(WallPart { disc: own, tangential });
        }
        parts
    }

    /// f_t of the disc; 0 if the disc is not in the list.
    pub fn tangential_of(&self, disc: u32) -> f64 {
        self.disc.binary_search(&disc).map_or(0.0, |k| self.tangential[k])
    }
}
