//! Neighbour search: a cell grid fills the contact rows with all pairs closer than the skin.

use crate::contacts::{PairList, WallContacts};
use crate::disc::Disc;
use crate::kernel::larger;
use crate::periodic::{self, Cell, Image};
use crate::walls::{Side, Walls};

/// Surfaces closer than this times the mean radius become candidates. Chosen by speed: wider rows cost force
/// evaluations, narrower ones rebuilds.
const SKIN_OVER_MEAN_RADIUS: f64 = 0.25;

/// Rows of candidates, and how far things have moved since they were found.
#[derive(Clone, Debug, Default)]
pub struct Neighbours {
    pub pairs: PairList,
    pub walls: [WallContacts; 4],
    /// Images among the pairs of a periodic box, by owner and shift; numbered after the discs.
    pub ghosts: Vec<Image>,
    skin: f64,
    /// Bound on how much the gap of any pair has closed since the last rebuild [m].
    closed: f64,
    /// The part of it that growing radii and moving walls closed.
    closed_by_boundaries: f64,
    /// Largest distance at which a pair was taken [m].
    reach: f64,
    /// Centres at the last rebuild; in a periodic box as fractions of the cell, which the flow keeps.
    built_at: Vec<[f64; 2]>,
    /// Rebuilds so far.
    pub rebuilds: u64,
}

impl Neighbours {
    /// True when a pair that is no candidate may have come into contact.
    ///
    /// First by the bound on speeds, which costs nothing; when that is used up, by how far the discs have really
    /// come, which then replaces it: discs that tremble about a place do not force rebuilds.
    pub fn stale(&mut self, discs: &[Disc], cell: Option<&Cell>) -> bool {
        if self.closed < self.skin {
            return false;
        }
        self.closed = self.closed_by_boundaries + self.closed_by_motion(discs, cell);
        // The measure costs about as much as a step, so it should be good for a few.
        // A motion that is not a number keeps no pair apart.
        self.closed.is_nan() || self.closed > 0.8 * self.skin
    }

    /// Counts motion: `speed` [m/s] bounds that of every disc, `wall_speed` that of every wall, and `growth` [m/s]
    /// that of every radius.
    pub fn record_motion(&mut self, speed: f64, wall_speed: f64, growth: f64, dt: f64) {
        let boundaries = (2.0 * growth + wall_speed) * dt;
        self.closed_by_boundaries += boundaries;
        self.closed += 2.0 * speed * dt + boundaries;
    }

    /// Counts the deformation of a periodic cell: `rate` [1/s] bounds the velocity gradient. A pair that is no candidate
    /// is farther than its reach, and no part of its way counts before it has come that near.
    pub fn record_flow(&mut self, rate: f64, dt: f64) {
        self.closed += rate * self.reach * dt;
        self.closed_by_boundaries += rate * self.reach * dt;
    }

    /// Sum of the two largest displacements, relative to the flow of a periodic box, since the last rebuild [m].
    fn closed_by_motion(&self, discs: &[Disc], cell: Option<&Cell>) -> f64 {
        let (mut largest, mut second) = (0.0f64, 0.0f64);
        for (disc, &built_at) in discs.iter().zip(&self.built_at) {
            let [x, y] = cell.map_or(built_at, |cell| cell.point(built_at));
            let (dx, dy) = (disc.x - x, disc.y - y);
            let square = dx * dx + dy * dy;
            second = larger(second, square.min(largest));
            largest = larger(largest, square);
        }
        largest.sqrt() + second.sqrt()
    }

    /// Finds all candidates afresh and carries the friction history over.
    pub fn rebuild(&mut self, discs: &[Disc], walls: &Walls, cell: Option<&Cell>) {
        let mean_radius = discs.iter().map(|d| d.radius).sum::<f64>() / discs.len().max(1) as f64;
        self.skin = SKIN_OVER_MEAN_RADIUS * mean_radius;
        self.closed = 0.0;
        self.closed_by_boundaries = 0.0;
        // Radii grow by less than the skin until the next rebuild.
        self.reach = discs.iter().fold(0.0f64, |r, d| r.max(2.0 * d.radius)) + 2.0 * self.skin;
        let place = |d: &Disc| cell.map_or([d.x, d.y], |cell| cell.fraction(d.x, d.y));
        self.built_at = discs.iter().map(place).collect();
        self.rebuilds += 1;
        if let Some(cell) = cell {
            self.rebuild_periodic(discs, cell);
            return;
        }
        let old = std::mem::take(&mut self.pairs);
        self.pairs = pairs_within(discs, self.skin);
        self.pairs.inherit(&old);
        for side in Side::ALL {
            self.rebuild_wall(side, discs, walls);
        }
    }

    fn rebuild_periodic(&mut self, discs: &[Disc], cell: &Cell) {
        let (mut pairs, ghosts) = periodic::pairs_within(discs, self.skin, cell);
        let count = discs.len();
        let known = self.pairs.rows() == count;
        for k in 0..if known { pairs.len() } else { 0 } {
            let (i, j) = (pairs.i()[k], pairs.j()[k]);
            let old = match (j as usize).checked_sub(count) {
                None => Some(j),
                Some(ghost) => periodic::index_of(&ghosts[ghost], count, &self.ghosts),
            };
            pairs.tangential[k] = old.map_or(0.0, |old| self.pairs.tangential_of(i as usize, old));
        }
        (self.pairs, self.ghosts) = (pairs, ghosts);
    }

    fn rebuild_wall(&mut self, side: Side, discs: &[Disc], walls: &Walls) {
        let old = std::mem::take(&mut self.walls[side as usize]);
        let new = &mut self.walls[side as usize];
        for (i, disc) in (0u32..).zip(discs) {
            if walls.distance(side, disc.x, disc.y) - disc.radius < self.skin {
                new.disc.push(i);
                new.tangential.push(old.tangential_of(i));
            }
        }
    }
}

/// Uniform grid over the bounding box of the centres: `first[c]..first[c + 1]` of `disc` are the discs of cell c.
pub(crate) struct Grid {
    origin: [f64; 2],
    cell: f64,
    columns: usize,
    lines: usize,
    first: Vec<u32>,
    disc: Vec<u32>,
}

impl Grid {
    pub(crate) fn new(discs: &[Disc], cell: f64) -> Self {
        let (mut low, mut high) = ([f64::INFINITY; 2], [f64::NEG_INFINITY; 2]);
        for d in discs {
            low = [low[0].min(d.x), low[1].min(d.y)];
            high = [high[0].max(d.x), high[1].max(d.y)];
        }
        // A disc that has flown away must not blow up the grid: at most a few cells per disc.
        let extent = (high[0] - low[0]).max(high[1] - low[1]);
        let cell = cell.max(extent / (4.0 * discs.len() as f64).sqrt().max(1.0) / 4.0);
        let count = |k: usize| ((high[k] - low[k]) / cell) as usize + 1;
        let mut grid = Self {
            origin: low,
            cell,
            columns: count(0),
            lines: count(1),
            first: Vec::new(),
            disc: vec![0; discs.len()],
        };
        grid.fill(discs);
        grid
    }

    fn column_and_line(&self, disc: &Disc) -> (usize, usize) {
        let index = |x: f64, k: usize| ((x - self.origin[k]) / self.cell) as usize;
        (index(disc.x, 0), index(disc.y, 1))
    }

    /// Counting sort of the discs by cell.
    fn fill(&mut self, discs: &[Disc]) {
        let cell_of = |grid: &Self, disc: &Disc| {
            let (column, line) = grid.column_and_line(disc);
            line * grid.columns + column
        };
        let mut first = vec![0u32; self.columns * self.lines + 1];
        for disc in discs {
            first[cell_of(self, disc) + 1] += 1;
        }
        for c in 1..first.len() {
            first[c] += first[c - 1];
        }
        let mut next = first.clone();
        for (i, disc) in (0u32..).zip(discs) {
            let slot = &mut next[cell_of(self, disc)];
            self.disc[*slot as usize] = i;
            *slot += 1;
        }
        self.first = first;
    }

    /// Calls `visit` with every disc in the 3 × 3 cells around `disc`.
    pub(crate) fn around(&self, disc: &Disc, mut visit: impl FnMut(u32)) {
        let (column, line) = self.column_and_line(disc);
        let columns = column.saturating_sub(1)..=(column + 1).min(self.columns - 1);
        for l in line.saturating_sub(1)..=(line + 1).min(self.lines - 1) {
            // Cells of one line are adjacent in memory.
            let from = self.first[l * self.columns + columns.start()] as usize;
            let to = self.first[l * self.columns + columns.end() + 1] as usize;
            self.disc[from..to].iter().for_each(|&j| visit(j));
        }
    }
}

/// All pairs whose surfaces are closer than `skin`.
fn pairs_within(discs: &[Disc], skin: f64) -> PairList {
    if discs.is_empty() {
        return PairList::build(0, |_, _| ());
    }
    let largest = discs.iter().fold(0.0f64, |r, d| r.max(d.radius));
    let grid = Grid::new(discs, 2.0 * largest + skin);
    PairList::build(discs.len(), |i, row| {
        let a = &discs[i];
        grid.around(a, |j| {
            let b = &discs[j as usize];
            let reach = a.radius + b.radius + skin;
            let (dx, dy) = (b.x - a.x, b.y - a.y);
            if j as usize > i && dx * dx + dy * dy < reach * reach {
                row.push(j);
            }
        });
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn grid_finds_what_brute_force_finds() {
        // A scatter without structure: fractional parts of multiples of irrational numbers.
        let discs: Vec<Disc> = (1..=300)
            .map(|k| {
                let u = |a: f64| (a * f64::from(k)).fract();
                Disc::at_rest(u(0.618_034), u(0.414_214), 0.01 + 0.02 * u(0.732_051), 1.0)
            })
            .collect();
        let skin = 0.01;
        let found = pairs_within(&discs, skin);
        for i in 0..discs.len() {
            let expected: Vec<u32> = (i + 1..discs.len())
                .filter(|&j| {
                    let (a, b) = (&discs[i], &discs[j]);
                    (b.x - a.x).hypot(b.y - a.y) < a.radius + b.radius + skin
                })
                .map(|j| j as u32)
                .collect();
            assert_eq!(&found.j()[found.of_rows(i..i + 1)], &expected, "row {i}");
        }
    }

    #[test]
    fn history_survives_a_rebuild() {
        let discs = [
            Disc::at_rest(0.0, 0.0, 1.0, 1.0),
            Disc::at_rest(1.9, 0.0, 1.0, 1.0),
            Disc::at_rest(3.8, 0.0, 1.0, 1.0),
        ];
        let walls = Walls { position: [-0.9, 5.5, -5.0, 5.0], ..Walls::around(1.0, 1.0) };
        let mut neighbours = Neighbours::default();
        neighbours.rebuild(&discs, &walls, None);
        neighbours.pairs.tangential.copy_from_slice(&[3.0, -4.0]);
        neighbours.walls[0].tangential[0] = 7.0;
        neighbours.rebuild(&discs, &walls, None);
        assert_eq!(neighbours.pairs.tangential, [3.0, -4.0]);
        assert_eq!(neighbours.walls[0].tangential_of(0), 7.0);
        assert_eq!(neighbours.walls[1].disc, [] as [u32; 0]);
    }
}
