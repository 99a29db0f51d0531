//! Neighbour search: which pairs of spheres may touch soon (candidates), and when that has to be found out again.

use crate::boundary::Boundary;
use crate::contacts::{Border, PairList, WallContacts};
use crate::sphere::Sphere;
use msdd_engine::grid::{pairs_within, pairs_within_cell};
use msdd_engine::lattice::{Image, index_of};
use msdd_engine::skin::Skin;

/// Least, first and largest skin over the mean radius. A wide skin makes each step look at more pairs that do not touch,
/// a narrow one makes the search run more often; what is best depends on how fast the spheres move.
const WIDTHS: [f64; 3] = [0.01, 0.2, 0.4];
/// Steps that a list should serve times its skin over the mean radius. In packings of 1 000 and 10 000 spheres a skin of w
/// was measured to lengthen a step by 2.4 w of it, and a search to take as long as 17 steps. Both together are least where
/// the list serves 7/w steps.
const BALANCE: f64 = 7.0;
/// The skin is changed by [`STEP`] when that product is off by more than [`TOLERANCE`].
const STEP: f64 = 1.4;
const TOLERANCE: f64 = 2.0;

/// Number of spheres from which a periodic box is divided into slabs and blocks, so that it is swept once through the memory and
/// on several threads. Below, its pairs across the border are a good part of all, and it fits into the caches.
const DIVIDED_FROM: usize = 10_000;

/// Rows of candidates, and a bound on how far the spheres have moved since the search.
#[derive(Clone, Debug, Default)]
pub struct Neighbours {
    pub pairs: PairList,
    /// In the order of the walls.
    pub walls: Vec<WallContacts>,
    /// Images (owner and shift) that occur in the pairs of a periodic box; numbered after the spheres.
    pub ghosts: Vec<Image<3>>,
    /// Of a large periodic box.
    pub border: Border,
    pub skin: Skin<3>,
    /// Skin over the mean radius, and the step of the last search.
    width: Option<f64>,
    searched_at: u64,
}

impl Neighbours {
    /// Steps that the list has served times its skin over the mean radius.
    fn product(&self, steps: u64) -> f64 {
        steps.saturating_sub(self.searched_at) as f64 * self.width.unwrap_or(0.0)
    }

    /// Whether the list has served so long that a narrower one is worth a search.
    pub fn too_wide(&self, steps: u64) -> bool {
        self.width.is_some_and(|width| width > WIDTHS[0]) && self.product(steps) > BALANCE * TOLERANCE
    }

    /// Finds all candidates afresh and carries the friction history over; `steps` have been taken so far. Results do not
    /// depend on when the search runs.
    pub fn rebuild(&mut self, spheres: &[Sphere], boundary: &Boundary, steps: u64) {
        let mean_radius = spheres.iter().map(|s| s.radius).sum::<f64>() / spheres.len().max(1) as f64;
        let product = self.product(steps);
        let factor = if product > BALANCE * TOLERANCE {
            1.0 / STEP
        } else if product < BALANCE / TOLERANCE {
            STEP
        } else {
            1.0
        };
        self.searched_at = steps;
        let [least, first, largest] = WIDTHS;
        let width = self.width.map_or(first, |width| (width * factor).clamp(least, largest));
        self.width = Some(width);
        let lattice = boundary.cell().map(|cell| cell.lattice);
        self.skin.begin(width * mean_radius, spheres, lattice.as_ref());
        let (rows, ghosts) = match &lattice {
            None => (pairs_within(spheres, self.skin.width), Vec::new()),
            Some(lattice) => {
                pairs_within_cell(spheres, self.skin.width, lattice, spheres.len() >= DIVIDED_FROM)
            }
        };
        self.border = Border::new(&rows, |ghost| ghosts[ghost].owner);
        let old = std::mem::replace(&mut self.pairs, PairList::new(rows));
        let old_ghosts = std::mem::replace(&mut self.ghosts, ghosts);
        self.inherit(spheres.len(), &old, &old_ghosts);
        self.find_at_walls(spheres, boundary);
    }

    /// Copies the history of pairs that were in the old list, too.
    fn inherit(&mut self, count: usize, old: &PairList, old_ghosts: &[Image<3>]) {
        if old.rows.rows() != count {
            return;
        }
        for k in 0..self.pairs.rows.len() {
            let (i, j) = (self.pairs.rows.i()[k], self.pairs.rows.j()[k]);
            let index = match (j as usize).checked_sub(count) {
                None => Some(j),
                Some(ghost) => index_of(&self.ghosts[ghost], count, old_ghosts),
            };
            if let Some(known) = index.and_then(|index| old.rows.find(i as usize, index)) {
                self.pairs.set_history(k, old.history(known));
            }
        }
    }

    fn find_at_walls(&mut self, spheres: &[Sphere], boundary: &Boundary) {
        let old = std::mem::take(&mut self.walls);
        for (number, wall) in boundary.walls().iter().enumerate() {
            let near = |s: &Sphere| wall.distance(s.position) - s.radius < self.skin.width;
            let sphere: Vec<u32> = (0u32..).zip(spheres).filter(|(_, s)| near(s)).map(|(i, _)| i).collect();
            let known = |&i: &u32| old.get(number).map_or([0.0; 4], |contacts| contacts.history_of(i));
            let history = sphere.iter().map(known).collect();
            self.walls.push(WallContacts { sphere, history });
        }
    }
}
