//! Lists of candidate pairs (near enough to touch soon), one row per grain.

use std::ops::Range;

/// Pairs within the search distance, ordered by i, then j; i < j.
///
/// The order makes sums over contacts independent of when the list was last rebuilt, because a candidate that does not
/// touch adds nothing. Every index is below [`Rows::grains`]. This is checked when the list is built, and the kernels
/// rely on it.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Rows {
    /// Number of grains, ghosts (images across a periodic border) included.
    grains: usize,
    /// Row i is `start[i]..start[i + 1]`.
    start: Vec<u32>,
    i: Vec<u32>,
    j: Vec<u32>,
    slabs: Vec<Slab>,
}

/// Consecutive rows that one thread works through. The division into slabs depends on the number of grains and not on
/// the number of threads, so results do not depend on the number of threads.
#[derive(Clone, Debug, PartialEq)]
pub struct Slab {
    pub rows: Range<usize>,
    pub pairs: Range<usize>,
    /// All grains of the slab's pairs are in `rows.start..reach`; `reach` is at least `rows.end`.
    pub reach: usize,
    /// Pairs of earlier slabs may refer to rows below this one.
    pub shared: usize,
    pub blocks: Vec<Block>,
}

/// Consecutive rows that are worked through together because their grains fit into the cache.
#[derive(Clone, Debug, PartialEq)]
pub struct Block {
    pub rows: Range<usize>,
    pub pairs: Range<usize>,
    /// The rows of the block and all grains of its pairs are in `rows.start..reach`.
    pub reach: usize,
}

/// Number of slabs of a list. Assemblies as small as RVEs have one, because pairs across two slabs take extra work.
fn slab_count(grains: usize) -> usize {
    if grains < 4000 { 1 } else { 4 }
}

/// Rows of a block: its grains, loads and pairs stay in the caches next to the core.
const BLOCK_ROWS: usize = 256;

impl Rows {
    /// A list over `grains` grains. `partners(i, row)` puts the partners j > i of grain i into `row`, in any order.
    pub fn build(grains: usize, partners: impl FnMut(usize, &mut Vec<u32>)) -> Self {
        Self::build_over(grains, grains, (slab_count(grains), BLOCK_ROWS), partners)
    }

    /// As [`Rows::build`], with a row for each of the first `rows` of `grains` grains, divided into a given number of
    /// slabs with blocks of `block_rows` rows.
    ///
    /// # Panics
    /// When a partner is not below `grains`.
    pub fn build_over(
        rows: usize,
        grains: usize,
        (slabs, block_rows): (usize, usize),
        mut partners: impl FnMut(usize, &mut Vec<u32>),
    ) -> Self {
        let mut list = Self { grains, start: vec![0], ..Self::default() };
        let mut row = Vec::new();
        for i in 0..rows {
            row.clear();
            partners(i, &mut row);
            row.sort_unstable();
            assert!(row.last().is_none_or(|&last| (last as usize) < grains));
            list.i.extend(row.iter().map(|_| i as u32));
            list.j.extend_from_slice(&row);
            list.start.push(list.j.len() as u32);
        }
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

    pub fn slabs(&self) -> &[Slab] {
        &self.slabs
    }

    /// Number of rows; the grains after them are ghosts.
    pub fn rows(&self) -> usize {
        self.start.len().saturating_sub(1)
    }

    /// Number of grains that the indices refer to.
    pub fn grains(&self) -> usize {
        self.grains
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

    /// The number of the pair (i, j), i < j; none when it is not in the list.
    pub fn find(&self, i: usize, j: u32) -> Option<usize> {
        let row = self.of_rows(i..i + 1);
        self.j[row.clone()].binary_search(&j).ok().map(|k| row.start + k)
    }
}
