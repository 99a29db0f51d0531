//! Neighbour search: which pairs of discs are so near each other that they may touch soon (candidates), and when that has to
//! be found out again. Candidates are all pairs whose surfaces are closer than a distance that is called the skin.

use crate::contacts::{PairList, WallContacts};
use crate::disc::Disc;
use crate::periodic::{Cell, Image};
use crate::walls::{Side, Walls};
use msdd_engine::Lattice;
use msdd_engine::grid::{pairs_within, pairs_within_cell};
use msdd_engine::lattice::index_of;
use msdd_engine::skin::Skin;

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
    pub skin: Skin<2>,
}

impl Neighbours {
    /// Finds all candidates afresh and carries the friction history over.
    pub fn rebuild(&mut self, discs: &[Disc], walls: &Walls, cell: Option<&Cell>) {
        let mean_radius = discs.iter().map(|d| d.radius).sum::<f64>() / discs.len().max(1) as f64;
        let lattice = cell.map(Cell::lattice);
        self.skin.begin(SKIN_OVER_MEAN_RADIUS * mean_radius, discs, lattice.as_ref());
        if let Some(lattice) = lattice {
            self.rebuild_periodic(discs, &lattice);
            return;
        }
        let old = std::mem::take(&mut self.pairs);
        self.pairs = PairList::new(pairs_within(discs, self.skin.width));
        self.pairs.inherit(&old);
        for side in Side::ALL {
            self.rebuild_wall(side, discs, walls);
        }
    }

    fn rebuild_periodic(&mut self, discs: &[Disc], cell: &Lattice<2>) {
        let (rows, ghosts) = pairs_within_cell(discs, self.skin.width, cell, false);
        let mut pairs = PairList::new(rows);
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
            if walls.distance(side, disc.x, disc.y) - disc.radius < self.skin.width {
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
