//! How long a list of pairs stays valid. The list holds all pairs whose surfaces are closer than a distance that is
//! called the skin; it has to be found afresh once two grains may have come nearer to each other by the skin.

use crate::grain::{Grain, difference, largest_radius, square};
use crate::lattice::Lattice;
use crate::vector::larger;

/// A bound on how far the grains have moved since the search.
#[derive(Clone, Debug)]
pub struct Skin<const D: usize> {
    /// \[m\]
    pub width: f64,
    /// Upper bound on how much nearer the surfaces of any two grains have come since the last search [m].
    closed: f64,
    /// The part of `closed` that is due to growing radii and moving walls [m].
    closed_by_boundaries: f64,
    /// Largest centre distance of a pair in the list [m].
    reach: f64,
    /// Centres at the last search [m]; in a periodic box as fractions of the cell, which the affine flow does not
    /// change.
    found_at: Vec<[f64; D]>,
    /// Searches so far.
    pub searches: u64,
}

impl<const D: usize> Default for Skin<D> {
    fn default() -> Self {
        Self {
            width: 0.0,
            closed: 0.0,
            closed_by_boundaries: 0.0,
            reach: 0.0,
            found_at: Vec::new(),
            searches: 0,
        }
    }
}

impl<const D: usize> Skin<D> {
    /// Begins anew: the list that is found now holds all pairs closer than `width` \[m\].
    pub fn begin(&mut self, width: f64, grains: &[impl Grain<D>], cell: Option<&Lattice<D>>) {
        self.width = width;
        self.closed = 0.0;
        self.closed_by_boundaries = 0.0;
        // Twice the skin, because the radii may grow until the next search, by less than the skin.
        self.reach = 2.0 * largest_radius(grains) + 2.0 * width;
        let place = |centre| cell.map_or(centre, |cell| cell.fraction(centre));
        self.found_at = grains.iter().map(|grain| place(grain.centre())).collect();
        self.searches += 1;
    }

    /// True when a pair that is not in the list may touch now, so that the search has to run.
    ///
    /// The bound from the largest speeds costs nothing and is tested first. Once it has used up the skin, the actual
    /// displacements of the grains are measured and replace it: grains that vibrate about a place have high speeds but
    /// small displacements, and cause no new search.
    pub fn used_up(&mut self, grains: &[impl Grain<D>], cell: Option<&Lattice<D>>) -> bool {
        if self.closed < self.width {
            return false;
        }
        self.closed = self.closed_by_boundaries + self.closed_by_motion(grains, cell);
        // Measuring costs about as much as a step. When less than a fifth of the skin is left, a search now is cheaper
        // than measuring again soon. When a velocity is NaN, no bound on the gaps is known, so the search has to run.
        self.closed.is_nan() || self.closed > 0.8 * self.width
    }

    /// Adds the motion of one step of `dt` \[s\] to the bound: `speed` [m/s] is at least that of every grain, `wall_speed`
    /// that of every wall, and `growth` [m/s] that of every radius.
    pub fn record_motion(&mut self, speed: f64, wall_speed: f64, growth: f64, dt: f64) {
        let boundaries = (2.0 * growth + wall_speed) * dt;
        self.closed_by_boundaries += boundaries;
        self.closed += 2.0 * speed * dt + boundaries;
    }

    /// Adds the deformation of a periodic cell during `dt` \[s\] to the bound: `rate` [1/s] is at least the velocity
    /// gradient. Two grains at most `reach` apart approach each other at no more than `rate` · `reach`; while they are
    /// farther apart they cannot touch, so that motion does not count.
    pub fn record_flow(&mut self, rate: f64, dt: f64) {
        self.closed += rate * self.reach * dt;
        self.closed_by_boundaries += rate * self.reach * dt;
    }

    /// Sum of the two largest displacements, relative to the flow of a periodic box, since the last search [m].
    fn closed_by_motion(&self, grains: &[impl Grain<D>], cell: Option<&Lattice<D>>) -> f64 {
        let (mut largest, mut second) = (0.0f64, 0.0f64);
        for (grain, &found_at) in grains.iter().zip(&self.found_at) {
            let before = cell.map_or(found_at, |cell| cell.point(found_at));
            let square = square(difference(grain.centre(), before));
            second = larger(second, square.min(largest));
            largest = larger(largest, square);
        }
        largest.sqrt() + second.sqrt()
    }
}
