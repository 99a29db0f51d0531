//! Lists of candidate contacts (pairs near enough to touch soon), one row per disc, with the tangential force of each
//! as its friction history.

use msdd_engine::rows::{Rows, Slab};

/// Candidate pairs with what is remembered of each.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct PairList {
    rows: Rows,
    /// f_t [N] of the last step, on j along t; 0 when the contact is open.
    pub(crate) tangential: Vec<f64>,
    /// k A/|d| [W/K] in the geometry of the last step; 0 when the contact is open. Empty without heat.
    pub(crate) conductance: Vec<f64>,
}

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
    /// Candidates without history.
    pub(crate) fn new(rows: Rows) -> Self {
        Self { tangential: vec![0.0; rows.len()], rows, conductance: Vec::new() }
    }

    pub(crate) fn slabs(&self) -> &[Slab] {
        self.rows.slabs()
    }

    /// The list divided into its slabs, which threads may work on in parallel; with room for conductances when heat is
    /// on.
    pub(crate) fn parts(&mut self, heat: bool) -> Vec<SlabPairs<'_>> {
        self.conductance.resize(if heat { self.rows.len() } else { 0 }, 0.0);
        let mut rest = self.tangential.as_mut_slice();
        let mut rest_of_conductance = self.conductance.as_mut_slice();
        let mut parts = Vec::with_capacity(self.rows.slabs().len());
        for slab in self.rows.slabs() {
            let (tangential, after) = rest.split_at_mut(slab.pairs.len());
            rest = after;
            let pairs = slab.pairs.clone();
            let (conductance, after) = rest_of_conductance.split_at_mut(if heat { pairs.len() } else { 0 });
            rest_of_conductance = after;
            let (i, j) = (&self.rows.i()[pairs.clone()], &self.rows.j()[pairs]);
            parts.push(SlabPairs { slab, i, j, tangential, conductance });
        }
        parts
    }

    /// Copies the friction history of the pairs that are in `old` too.
    pub(crate) fn inherit(&mut self, old: &Self) {
        if old.discs() == self.discs() {
            for k in 0..self.len() {
                self.tangential[k] = old.tangential_of(self.i()[k] as usize, self.j()[k]);
            }
        }
    }

    /// Number of rows; the discs after them are ghosts.
    pub(crate) fn rows(&self) -> usize {
        self.rows.rows()
    }

    /// Number of discs that the indices refer to.
    pub fn discs(&self) -> usize {
        self.rows.grains()
    }

    /// Number of candidate pairs.
    pub fn len(&self) -> usize {
        self.rows.len()
    }

    pub fn is_empty(&self) -> bool {
        self.rows.is_empty()
    }

    pub fn i(&self) -> &[u32] {
        self.rows.i()
    }

    pub fn j(&self) -> &[u32] {
        self.rows.j()
    }

    /// f_t of the pair (i, j), i < j; 0 if the pair is not in the list.
    pub fn tangential_of(&self, i: usize, j: u32) -> f64 {
        self.rows.find(i, j).map_or(0.0, |k| self.tangential[k])
    }

    /// Sets f_t of the pair (i, j), i < j. Returns false if the pair is not in the list.
    pub(crate) fn set_tangential(&mut self, i: usize, j: u32, force: f64) -> bool {
        self.rows.find(i, j).map(|k| self.tangential[k] = force).is_some()
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
