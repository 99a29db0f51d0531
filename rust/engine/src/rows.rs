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
    /// Row i is `start[i]..start[i + 1]`; pairs across the border may stand behind the last row.
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
    ///
    /// # Panics
    /// When a partner is not below `grains`.
    pub fn build(grains: usize, partners: impl FnMut(usize, &mut Vec<u32>)) -> Self {
        let mut list = Self::collect([grains, grains, 0], (slab_count(grains), BLOCK_ROWS), false, partners);
        list.i.shrink_to_fit();
        list.j.shrink_to_fit();
        list
    }

    /// As [`Rows::build`], of a periodic box: `pairs` in all, with a row for each of the first `rows` of `grains` grains, the
    /// others being ghosts. `apart` tells whether the pairs with ghosts stand behind the rows ([`Rows::across`]), so that the rows can be
    /// divided; else all rows are one block.
    ///
    /// # Panics
    /// When a partner is not below `grains`.
    pub fn build_periodic(
        [rows, grains, pairs]: [usize; 3],
        apart: bool,
        partners: impl FnMut(usize, &mut Vec<u32>),
    ) -> Self {
        let division = if apart { (slab_count(rows), BLOCK_ROWS) } else { (1, rows.max(1)) };
        Self::collect([rows, grains, pairs], division, apart, partners)
    }

    fn collect(
        [rows, grains, pairs]: [usize; 3],
        (slabs, block_rows): (usize, usize),
        apart: bool,
        mut partners: impl FnMut(usize, &mut Vec<u32>),
    ) -> Self {
        let mut list = Self { grains, start: vec![0], ..Self::default() };
        list.start.reserve_exact(rows);
        list.i.reserve_exact(pairs);
        list.j.reserve_exact(pairs);
        let (mut row, mut across) = (Vec::new(), Vec::new());
        for i in 0..rows {
            row.clear();
            partners(i, &mut row);
            row.sort_unstable();
            assert!(row.last().is_none_or(|&last| (last as usize) < grains));
            let own = if apart { row.partition_point(|&j| (j as usize) < rows) } else { row.len() };
            list.i.extend(row[..own].iter().map(|_| i as u32));
            list.j.extend_from_slice(&row[..own]);
            list.start.push(list.j.len() as u32);
            across.extend(row[own..].iter().map(|&j| (i as u32, j)));
        }
        list.i.extend(across.iter().map(|(i, _)| i));
        list.j.extend(across.iter().map(|(_, j)| j));
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

    /// Candidates across the border of a periodic box that stand behind all rows, ordered by i, then j.
    pub fn across(&self) -> Range<usize> {
        self.start.last().map_or(0, |&end| end as usize)..self.len()
    }

    /// The number of the pair (i, j), i < j; none when it is not in the list.
    pub fn find(&self, i: usize, j: u32) -> Option<usize> {
        let find_in =
            |pairs: Range<usize>| self.j[pairs.clone()].binary_search(&j).ok().map(|k| pairs.start + k);
        find_in(self.of_rows(i..i + 1)).or_else(|| {
            let across = self.across();
            let from =
                |i: usize| across.start + self.i[across.clone()].partition_point(|&k| (k as usize) < i);
            find_in(from(i)..from(i + 1))
        })
    }
}
