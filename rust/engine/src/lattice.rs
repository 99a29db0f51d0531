//! Periodic cells: the cell repeats itself along its edges.
//!
//! The first edge lies along x, the second in the plane of x and y, the third anywhere. The image of a grain by the
//! shift (a, b, …) is the grain moved by a times the first edge, b times the second, …
//!
//! A pair across the border is an ordinary pair of a list whose second grain is a ghost: an image of a grain, stored
//! behind the real grains and moved to its place in each step. The first grain of the pair is the one from which the
//! shift is positive (its first number that is not 0), so each pair occurs once. Ghosts are numbered by owner and
//! shift, hence the order of all sums does not depend on when the list was found.

use crate::grain::Grain;

/// Numbers of cells along each edge between two images.
pub type Shift<const D: usize> = [i32; D];

/// The periodic cell at one moment.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Lattice<const D: usize> {
    /// The corner from which the edges go out \[m\].
    pub origin: [f64; D],
    /// Edge m is `edges\[m\]` \[m\]; its coordinates after the m-th are 0.
    pub edges: [[f64; D]; D],
}

/// An image of a grain: grain number `owner`, moved by [`Lattice::displacement`] of `shift`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Image<const D: usize> {
    pub owner: u32,
    /// All 0 is the grain itself.
    pub shift: Shift<D>,
}

impl<const D: usize> Lattice<D> {
    /// `start` plus the sum over edges m of coefficient m times coordinate k, m from k on.
    #[inline(always)]
    fn sum(&self, k: usize, start: Option<f64>, coefficient: impl Fn(usize) -> f64) -> f64 {
        let first = coefficient(k) * self.edges[k][k];
        let first = start.map_or(first, |start| start + first);
        (k + 1..D).fold(first, |sum, m| sum + coefficient(m) * self.edges[m][k])
    }

    /// Sum of `shift` times the edges \[m\].
    #[inline]
    pub fn displacement(&self, shift: Shift<D>) -> [f64; D] {
        std::array::from_fn(|k| self.sum(k, None, |m| f64::from(shift[m])))
    }

    /// The image of the grain by a shift.
    #[inline]
    pub fn image<G: Grain<D>>(&self, grain: &G, shift: Shift<D>) -> G {
        let (centre, by) = (grain.centre(), self.displacement(shift));
        grain.at(std::array::from_fn(|k| centre[k] + by[k]))
    }

    /// Coordinates of a point along the edges; from 0 to 1 inside the cell.
    pub fn fraction(&self, point: [f64; D]) -> [f64; D] {
        let mut fraction = [0.0; D];
        for k in (0..D).rev() {
            let left =
                (k + 1..D).fold(point[k] - self.origin[k], |left, m| left - fraction[m] * self.edges[m][k]);
            fraction[k] = left / self.edges[k][k];
        }
        fraction
    }

    /// The point \[m\] of given [`Lattice::fraction`].
    pub fn point(&self, fraction: [f64; D]) -> [f64; D] {
        std::array::from_fn(|k| self.sum(k, Some(self.origin[k]), |m| fraction[m]))
    }

    /// The shift that brings a point into the block spanned by the diagonal of the edges; the block, like the cell,
    /// contains exactly one image of each grain.
    fn home(&self, point: [f64; D]) -> Shift<D> {
        let mut shift = [0.0f64; D];
        for k in (0..D).rev() {
            let moved = (k + 1..D).fold(point[k], |x, m| x + shift[m] * self.edges[m][k]);
            shift[k] = -((moved - self.origin[k]) / self.edges[k][k]).floor();
        }
        shift.map(|number| number as i32)
    }

    /// All images whose centres lie in the block enlarged by `margin` on each side; `margin` is less than the length of
    /// the block along all axes but x. The images inside the block itself come first, in the order of the grains.
    pub fn images(&self, grains: &[impl Grain<D>], margin: f64) -> Vec<Image<D>> {
        let homes: Vec<Image<D>> = (0u32..)
            .zip(grains)
            .map(|(owner, grain)| Image { owner, shift: self.home(grain.centre()) })
            .collect();
        let mut images = homes.clone();
        for (grain, home) in grains.iter().zip(&homes) {
            self.add_copies(grain.centre(), home, margin, (D, [0; D]), &mut images);
        }
        images
    }

    /// Adds the images of one grain whose shifts along the edges from `known.0` on are those of `known.1`.
    fn add_copies(
        &self,
        centre: [f64; D],
        home: &Image<D>,
        margin: f64,
        (from, shift): (usize, Shift<D>),
        images: &mut Vec<Image<D>>,
    ) {
        if from == 0 {
            if shift != home.shift {
                images.push(Image { owner: home.owner, shift });
            }
            return;
        }
        let k = from - 1;
        let by = (from..D).fold(0.0, |sum, m| sum + f64::from(shift[m]) * self.edges[m][k]);
        let (x, length) = (centre[k] + by - self.origin[k], self.edges[k][k]);
        let first = ((-margin - x) / length).ceil() as i32;
        let last = ((length + margin - x) / length).floor() as i32;
        for number in first..=last {
            let mut shift = shift;
            shift[k] = number;
            self.add_copies(centre, home, margin, (k, shift), images);
        }
    }
}

/// Whether (i, j, shift) is the orientation of a pair in which its shift is positive.
pub fn forward<const D: usize>(i: u32, j: u32, shift: Shift<D>) -> bool {
    if shift == [0; D] { i < j } else { shift > [0; D] }
}

/// The number by which a list of pairs refers to an image: below `count` for the grain itself, else by its place in
/// `ghosts`; none when the image is not in `ghosts`.
pub fn index_of<const D: usize>(image: &Image<D>, count: usize, ghosts: &[Image<D>]) -> Option<u32> {
    if image.shift == [0; D] {
        return Some(image.owner);
    }
    ghosts.binary_search(image).ok().map(|k| (count + k) as u32)
}
