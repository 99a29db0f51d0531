//! Neighbour search: which pairs of discs are so near each other that they may touch soon (candidates), and when that has to
//! be found out again. Candidates are all pairs whose surfaces are closer than a distance that is called the skin.

use crate::contacts::{PairList, WallContacts};
use crate::disc::Disc;
use crate::grid::{pairs_within, pairs_within_cell};
use crate::periodic::{Cell, Image, index_of};
use crate::vector::larger;
use crate::walls::{Side, Walls};

/// The skin over the mean radius. A wider skin makes each step look at more pairs that do not touch; a narrower one
/// makes the search run more often. Runs are fastest at this value.
const SKIN_OVER_MEAN_RADIUS: f64 = 0.25;

/// Rows of candidates, and a bound on how far the discs have moved since the search.
#[derive(Clone, Debug, Default)]
pub struct Neighbours {
    pub pairs: PairList,
    pub walls: [WallContacts; 4],
    /// Images (owner and shift) that occur in the pairs of a periodic box; numbered after the discs.
    pub ghosts: Vec<Image>,
    skin: f64,
    /// Upper bound on how much nearer the surfaces of any two discs have come since the last rebuild [m].
    closed: f64,
    /// The part of `closed` that is due to growing radii and moving walls [m].
    closed_by_boundaries: f64,
    /// Largest centre distance of a pair in the list [m].
    reach: f64,
    /// Centres at the last rebuild [m]; in a periodic box as fractions of the cell, which the affine flow does not
    /// change.
    built_at: Vec<[f64; 2]>,
    /// Rebuilds so far.
    pub rebuilds: u64,
}

impl Neighbours {
    /// True when a pair that is no candidate may touch now, so that the search has to run.
    ///
    /// The bound from the largest speeds costs nothing and is tested first. Once it has used up the skin, the actual
    /// displacements of the discs are measured and replace it: discs that vibrate about a place have high speeds but
    /// small displacements, and cause no new search.
    pub fn stale(&mut self, discs: &[Disc], cell: Option<&Cell>) -> bool {
        if self.closed < self.skin {
            return false;
        }
        self.closed = self.closed_by_boundaries + self.closed_by_motion(discs, cell);
        // Measuring costs about as much as a step. When less than a fifth of the skin is left, a search now is cheaper
        // than measuring again soon. When a velocity is NaN, no bound on the gaps is known, so the search has to run.
        self.closed.is_nan() || self.closed > 0.8 * self.skin
    }

    /// Adds the motion of one step of `dt` [s] to the bound: `speed` [m/s] is at least that of every disc, `wall_speed`
    /// that of every wall, and `growth` [m/s] that of every radius.
    pub fn record_motion(&mut self, speed: f64, wall_speed: f64, growth: f64, dt: f64) {
        let boundaries = (2.0 * growth + wall_speed) * dt;
        self.closed_by_boundaries += boundaries;
        self.closed += 2.0 * speed * dt + boundaries;
    }

    /// Adds the deformation of a periodic cell during `dt` [s] to the bound: `rate` [1/s] is at least the velocity
    /// gradient. Two discs at most `reach` apart approach each other at no more than `rate` · `reach`; while they are
    /// farther apart they cannot touch, so that motion does not count.
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
        // Twice the skin, because the radii may grow until the next rebuild, by less than the skin.
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
        let (mut pairs, ghosts) = pairs_within_cell(discs, self.skin, cell);
        let count = discs.len();
        let known = self.pairs.rows() == count;
        for k in 0..if known { pairs.len() } else { 0 } {
            let (i, j) = (pairs.i()[k], pairs.j()[k]);
            let old = match (j as usize).checked_sub(count) {
                None => Some(j),
                Some(ghost) => index_of(&ghosts[ghost], count, &self.ghosts),
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

#[cfg(test)]
mod tests {
    use super::*;

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
