//! Fully periodic boxes without walls: the cell repeats itself along x and along a second direction, which shear may
//! tilt.
//!
//! The cell is the box between the positions of [`crate::walls::Walls`]. The image of a disc by the shift (a, b) is the
//! disc moved by a (W, 0) + b (s, H), with the width W and height H of the box and the shear offset s. The cell deforms
//! by `walls.normal_velocity` and the shear rate and always carries the grains along: velocities of discs are relative
//! to [`crate::walls::Flow`]. Positions are never wrapped back into the cell, so that the shift between two discs stays
//! the same.

use crate::disc::Disc;
use crate::walls::Walls;
use msdd_engine::Lattice;

/// Shear of a periodic box, in addition to the positions and normal velocities of [`Walls`].
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Periodic {
    /// s \[m\]: displacement along x of the upper image relative to the lower.
    pub shear_offset: f64,
    /// ∂u_x/∂y [1/s].
    pub shear_rate: f64,
}

/// Numbers of cells along x and y between two images.
pub type Shift = msdd_engine::Shift<2>;

/// An image of a disc.
pub type Image = msdd_engine::Image<2>;

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
    /// Lower left corner \[m\].
    pub origin: [f64; 2],
    /// W and H \[m\].
    pub width: f64,
    pub height: f64,
    /// s \[m\].
    pub shear_offset: f64,
}

impl Cell {
    pub(crate) fn new(walls: &Walls, periodic: &Periodic) -> Self {
        let [left, _, bottom, _] = walls.position;
        let (width, height) = (walls.width(), walls.height());
        Self { origin: [left, bottom], width, height, shear_offset: periodic.shear_offset }
    }

    /// The cell by its edges, (W, 0) and (s, H).
    #[inline(always)]
    pub fn lattice(&self) -> Lattice<2> {
        let edges = [[self.width, 0.0], [self.shear_offset, self.height]];
        Lattice { origin: self.origin, edges }
    }

    /// a (W, 0) + b (s, H) \[m\].
    pub fn displacement(&self, shift: Shift) -> [f64; 2] {
        self.lattice().displacement(shift)
    }

    /// The image of the disc by a shift.
    pub fn image(&self, disc: &Disc, shift: Shift) -> Disc {
        self.lattice().image(disc, shift)
    }

    /// Coordinates of a point along the cell vectors; from 0 to 1 inside the cell.
    pub fn fraction(&self, x: f64, y: f64) -> [f64; 2] {
        self.lattice().fraction([x, y])
    }

    /// The point \[m\] of given [`Cell::fraction`].
    pub fn point(&self, fraction: [f64; 2]) -> [f64; 2] {
        self.lattice().point(fraction)
    }

    /// All images whose centres lie in the rectangle W × H enlarged by `margin` < H on each side. The images inside the
    /// rectangle itself come first, in the order of the discs.
    pub fn images(&self, discs: &[Disc], margin: f64) -> Vec<Image> {
        self.lattice().images(discs, margin)
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

/// Checks that no disc of radius `largest` can touch two images of the same disc.
pub(crate) fn check_size(walls: &Walls, largest: f64) -> Result<(), SmallCell> {
    for (side, length) in [("width", walls.width()), ("height", walls.height())] {
        if length <= SMALLEST_CELL * largest {
            return Err(SmallCell { side, length, radius: largest });
        }
    }
    Ok(())
}
