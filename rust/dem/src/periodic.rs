//! Fully periodic boxes without walls: the cell repeats itself along x and along a second direction, which shear may
//! tilt.
//!
//! The cell is the box between the positions of [`crate::walls::Walls`]. The image of a disc by the shift (a, b) is the
//! disc moved by a (W, 0) + b (s, H), with the width W and height H of the box and the shear offset s. The cell deforms
//! by `walls.normal_velocity` and the shear rate and always carries the grains along: velocities of discs are relative
//! to [`crate::walls::Flow`]. Positions are never wrapped back into the cell, so that the shift between two discs stays
//! the same.
//!
//! A pair across the border is an ordinary pair of the list whose second disc is a ghost: an image of a disc, stored
//! behind the real discs and moved to its place in each step. The first disc of the pair is the one from which the
//! shift is positive (a > 0, or a = 0 and b > 0), so each pair occurs once. Ghosts are numbered by owner and shift,
//! hence the order of all sums does not depend on when the list was rebuilt.

use crate::disc::Disc;
use crate::walls::Walls;

/// Shear of a periodic box, beside the positions and normal velocities of [`Walls`].
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Periodic {
    /// s [m]: displacement along x of the upper image relative to the lower.
    pub shear_offset: f64,
    /// ∂u_x/∂y [1/s].
    pub shear_rate: f64,
}

/// Numbers of cells along x and y between two images.
pub type Shift = [i32; 2];

/// Width and height are at least this times the largest radius: a disc must not meet two images of another.
pub const SMALLEST_CELL: f64 = 4.0;

/// A periodic box that is too small for its discs.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[error(
    "periodic box: {side} = {length} m, allowed: above {SMALLEST_CELL} times the largest radius, {radius} m"
)]
pub struct SmallCell {
    /// "width" or "height".
    pub side: &'static str,
    pub length: f64,
    pub radius: f64,
}

/// The periodic cell at one moment.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cell {
    /// Lower left corner [m].
    pub origin: [f64; 2],
    /// W and H [m].
    pub width: f64,
    pub height: f64,
    /// s [m].
    pub shear_offset: f64,
}

/// An image of a disc: disc number `owner`, moved by [`Cell::displacement`] of `shift`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Image {
    pub owner: u32,
    /// [0, 0] is the disc itself.
    pub shift: Shift,
}

impl Cell {
    pub(crate) fn new(walls: &Walls, periodic: &Periodic) -> Self {
        let [left, _, bottom, _] = walls.position;
        let (width, height) = (walls.width(), walls.height());
        Self { origin: [left, bottom], width, height, shear_offset: periodic.shear_offset }
    }

    /// a (W, 0) + b (s, H) [m].
    pub fn displacement(&self, [a, b]: Shift) -> [f64; 2] {
        let (a, b) = (f64::from(a), f64::from(b));
        [a * self.width + b * self.shear_offset, b * self.height]
    }

    /// The image of the disc by a shift.
    pub fn image(&self, disc: &Disc, shift: Shift) -> Disc {
        let [dx, dy] = self.displacement(shift);
        Disc { x: disc.x + dx, y: disc.y + dy, ..*disc }
    }

    /// Coordinates of a point along the cell vectors; from 0 to 1 inside the cell.
    pub fn fraction(&self, x: f64, y: f64) -> [f64; 2] {
        let up = (y - self.origin[1]) / self.height;
        [(x - self.origin[0] - up * self.shear_offset) / self.width, up]
    }

    /// The point [m] of given [`Cell::fraction`].
    pub fn point(&self, [along, up]: [f64; 2]) -> [f64; 2] {
        [self.origin[0] + along * self.width + up * self.shear_offset, self.origin[1] + up * self.height]
    }

    /// The shift that brings a point into the rectangle W × H; the rectangle, like the cell, contains exactly one image
    /// of each disc.
    fn home(&self, x: f64, y: f64) -> Shift {
        let b = -((y - self.origin[1]) / self.height).floor();
        let a = -((x + b * self.shear_offset - self.origin[0]) / self.width).floor();
        [a as i32, b as i32]
    }

    /// All images whose centres lie in the rectangle W × H enlarged by `margin` < H on each side. The images inside the
    /// rectangle itself come first, in the order of the discs.
    pub fn images(&self, discs: &[Disc], margin: f64) -> Vec<Image> {
        let discs = (0u32..).zip(discs);
        let homes: Vec<Image> =
            discs.clone().map(|(owner, d)| Image { owner, shift: self.home(d.x, d.y) }).collect();
        let mut images = homes.clone();
        for ((owner, disc), home) in discs.zip(&homes) {
            for b in home.shift[1].saturating_sub(1)..=home.shift[1].saturating_add(1) {
                let [dx, dy] = self.displacement([0, b]);
                let (x, y) = (disc.x + dx - self.origin[0], disc.y + dy - self.origin[1]);
                if y < -margin || y > self.height + margin {
                    continue;
                }
                let first = ((-margin - x) / self.width).ceil() as i32;
                let last = ((self.width + margin - x) / self.width).floor() as i32;
                let copies = (first..=last).map(|a| [a, b]).filter(|&shift| shift != home.shift);
                images.extend(copies.map(|shift| Image { owner, shift }));
            }
        }
        images
    }
}

impl Periodic {
    /// Shears the box for the time `dt` [s]; `walls` are those at the beginning of the step. The cell vector (s, H)
    /// moves with the flow.
    pub(crate) fn advance(&mut self, walls: &Walls, dt: f64) {
        let stretching = walls.flow().gradient[0];
        self.shear_offset += dt * (stretching * self.shear_offset + self.shear_rate * walls.height());
    }
}

/// Whether (i, j, shift) is the orientation of a pair in which its shift is positive.
pub(crate) fn forward(i: u32, j: u32, shift: Shift) -> bool {
    if shift == [0, 0] { i < j } else { shift > [0, 0] }
}

/// The number by which the pair list refers to an image: below `count` for the disc itself, else by its place in
/// `ghosts`; none when the image is not in `ghosts`.
pub(crate) fn index_of(image: &Image, count: usize, ghosts: &[Image]) -> Option<u32> {
    if image.shift == [0, 0] {
        return Some(image.owner);
    }
    ghosts.binary_search(image).ok().map(|k| (count + k) as u32)
}

/// Checks that no disc of radius `largest` can touch two images of the same disc.
pub(crate) fn check_size(walls: &Walls, largest: f64) -> Result<(), SmallCell> {
    for (side, length) in [("width", walls.width()), ("height", walls.height())] {
        if length <= SMALLEST_CELL * largest {
            return Err(SmallCell { side, length, radius: largest });
        }
    }
    Ok(())
}
