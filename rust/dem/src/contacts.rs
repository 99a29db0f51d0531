//! Candidate contacts in rows, with the friction history of each.

use std::ops::Range;

/// Pairs within the search distance, ordered by i, then j; i < j.
///
/// The order makes sums over contacts independent of when the list was last rebuilt: a candidate that bears no force
/// adds nothing. Every index is below [`PairList::discs`], checked when the list is built: the kernels rely on it.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct PairList {
    /// Discs, ghosts included.
    discs: usize,
    /// Row i is `start[i]..start[i + 1]`.
    start: Vec<u32>,
    i: Vec<u32>,
    j: Vec<u32>,
    /// f_t [N] of the last step, on j along t; 0 when the contact is open.
    pub(crate) tangential: Vec<f64>,
    slabs: Vec<Slab>,
}

/// Rows in a run that are summed up as one, and the order of these sums is fixed: it depends on the number of discs,
/// never on threads.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Slab {
    pub rows: Range<usize>,
    pub pairs: Range<usize>,
    /// All discs of its pairs are in `rows.start..reach`.
    pub reach: usize,
}

/// Slabs of a list. One for RVEs; the cost of more is that discs between two slabs are added up twice.
fn slab_count(discs: usize) -> usize {
    if discs < 4000 { 1 } else { 4 }
}

/// The part of a list that one thread works on.
pub(crate) struct PairSlab<'a> {
    pub i: &'a [u32],
    pub j: &'a [u32],
    pub tangential: &'a mut [f64],
    pub first: usize,
    pub reach: usize,
}

impl PairList {
    /// A list over `discs` discs. `partners(i, row)` puts the partners j > i of disc i into `row`, in any order.
    pub(crate) fn build(discs: usize, partners: impl FnMut(usize, &mut Vec<u32>)) -> Self {
        Self::build_over(discs, discs, slab_count(discs), partners)
    }

    /// As [`PairList::build`], with a row for each of the first `rows` of `discs` discs, in a given number of slabs.
    pub(crate) fn build_over(
        rows: usize,
        discs: usize,
        slabs: usize,
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
        list.slabs = list.divide(slabs);
        list
    }

    fn divide(&self, count: usize) -> Vec<Slab> {
        let edge = |s: usize| self.rows() * s / count;
        let slab = |s: usize| {
            let rows = edge(s)..edge(s + 1);
            let pairs = self.of_rows(rows.clone());
            let last = self.j[pairs.clone()].iter().max().map_or(0, |&j| j as usize + 1);
            Slab { reach: last.max(rows.end), rows, pairs }
        };
        (0..count).map(slab).collect()
    }

    pub(crate) fn slabs(&self) -> &[Slab] {
        &self.slabs
    }

    /// The list in its slabs, to be worked on side by side. Every index of a part is in `first..reach`, and `reach` is
    /// at most [`PairList::discs`].
    pub(crate) fn parts(&mut self) -> Vec<PairSlab<'_>> {
        let mut rest = self.tangential.as_mut_slice();
        let mut parts = Vec::with_capacity(self.slabs.len());
        for slab in &self.slabs {
            let (tangential, after) = rest.split_at_mut(slab.pairs.len());
            rest = after;
            parts.push(PairSlab {
                i: &self.i[slab.pairs.clone()],
                j: &self.j[slab.pairs.clone()],
                tangential,
                first: slab.rows.start,
                reach: slab.reach,
            });
        }
        parts
    }

    /// Takes over the friction history of the pairs that are in `old` too.
    pub(crate) fn inherit(&mut self, old: &Self) {
        if old.discs == self.discs {
            for k in 0..self.len() {
                self.tangential[k] = old.tangential_of(self.i[k] as usize, self.j[k]);
            }
        }
    }

    /// Number of rows; discs behind them are ghosts.
    pub(crate) fn rows(&self) -> usize {
        self.start.len().saturating_sub(1)
    }

    /// Number of discs that the indices refer to.
    pub fn discs(&self) -> usize {
        self.discs
    }

    /// Number of candidates.
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

    /// The candidates of the rows `rows`.
    pub fn of_rows(&self, rows: Range<usize>) -> Range<usize> {
        self.start[rows.start] as usize..self.start[rows.end] as usize
    }

    /// f_t of the pair (i, j), i < j, or 0 if it is no candidate.
    pub fn tangential_of(&self, i: usize, j: u32) -> f64 {
        let row = self.of_rows(i..i + 1);
        match self.j[row.clone()].binary_search(&j) {
            Ok(k) => self.tangential[row.start + k],
            Err(_) => 0.0,
        }
    }
}

impl PairList {
    /// Sets f_t of the pair (i, j), i < j. Returns false if it is no candidate.
    pub(crate) fn set_tangential(&mut self, i: usize, j: u32, force: f64) -> bool {
        let row = self.of_rows(i..i + 1);
        let found = self.j[row.clone()].binary_search(&j);
        found.map(|k| self.tangential[row.start + k] = force).is_ok()
    }
}

/// Discs within the search distance of one wall, in growing order.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct WallContacts {
    pub(crate) disc: Vec<u32>,
    /// f_t [N] on the disc along t; 0 when the contact is open.
    pub(crate) tangential: Vec<f64>,
}

impl WallContacts {
    /// Sets f_t of the disc. Returns false if it is no candidate.
    pub(crate) fn set_tangential(&mut self, disc: u32, force: f64) -> bool {
        self.disc.binary_search(&disc).map(|k| self.tangential[k] = force).is_ok()
    }

    /// f_t of the disc, or 0 if it is no candidate.
    pub fn tangential_of(&self, disc: u32) -> f64 {
        self.disc.binary_search(&disc).map_or(0.0, |k| self.tangential[k])
    }
}
