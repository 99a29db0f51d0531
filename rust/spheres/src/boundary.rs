//! What surrounds the spheres: walls, or a periodic cell.

use crate::space::{Matrix, dot, length, minus, plus, scaled, times};
use msdd_engine::Lattice;
use msdd_engine::message::number;
use serde::{Deserialize, Serialize};

/// The form of a wall.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum Surface {
    /// A plane of infinite extent.
    Flat {
        /// Unit normal pointing to the side of the spheres.
        normal: [f64; 3],
    },
    /// The inner side of a circular cylinder of infinite length; the wall's point lies on its axis.
    Cylinder {
        /// Unit vector along the axis.
        axis: [f64; 3],
        /// \[m\]
        radius: f64,
        /// Rate at which the radius grows [m/s].
        #[serde(default)]
        growth: f64,
        /// Rate of strain along the axis, from the wall's point on \[1/s\]. It counts as slip.
        #[serde(default)]
        stretch: f64,
    },
}

/// A rigid wall, which moves without turning; the radius of a cylinder may change.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Wall {
    /// A point of the plane, or of the cylinder's axis \[m\].
    pub point: [f64; 3],
    pub surface: Surface,
    /// [m/s]; its component along the wall counts as slip.
    pub velocity: [f64; 3],
}

impl Wall {
    /// A flat wall at rest.
    pub fn at_rest(point: [f64; 3], normal: [f64; 3]) -> Self {
        Self { point, surface: Surface::Flat { normal }, velocity: [0.0; 3] }
    }

    /// The inner side of a cylinder at rest; `axis` is a unit vector.
    pub fn cylinder(point: [f64; 3], axis: [f64; 3], radius: f64) -> Self {
        Self {
            point,
            surface: Surface::Cylinder { axis, radius, growth: 0.0, stretch: 0.0 },
            velocity: [0.0; 3],
        }
    }

    /// Distance of a point from the wall, positive on the side of the spheres \[m\], and the unit normal of the wall at the
    /// foot of the point, towards the spheres. On the axis of a cylinder the normal is 0.
    #[inline]
    pub fn foot(&self, point: [f64; 3]) -> (f64, [f64; 3]) {
        let from = minus(point, self.point);
        match self.surface {
            Surface::Flat { normal } => (dot(from, normal), normal),
            Surface::Cylinder { axis, radius, .. } => {
                let out = plus(from, -dot(from, axis), axis);
                let off = length(out);
                (radius - off, scaled(if off > 0.0 { -1.0 / off } else { 0.0 }, out))
            }
        }
    }

    /// Velocity [m/s] of the wall next to a point, where its normal is `normal`.
    #[inline]
    pub fn velocity_at(&self, point: [f64; 3], normal: [f64; 3]) -> [f64; 3] {
        match self.surface {
            Surface::Flat { .. } => self.velocity,
            Surface::Cylinder { axis, growth, stretch, .. } => {
                let along = stretch * dot(minus(point, self.point), axis);
                plus(plus(self.velocity, -growth, normal), along, axis)
            }
        }
    }

    /// Moves it for the time `dt` [s]; returns its largest speed [m/s].
    pub(crate) fn advance(&mut self, dt: f64) -> f64 {
        self.point = plus(self.point, dt, self.velocity);
        let speed = length(self.velocity);
        match &mut self.surface {
            Surface::Flat { .. } => speed,
            Surface::Cylinder { radius, growth, .. } => {
                *radius += *growth * dt;
                speed + growth.abs()
            }
        }
    }

    /// Distance of a point from the wall, positive on the side of the spheres \[m\].
    pub fn distance(&self, point: [f64; 3]) -> f64 {
        self.foot(point).0
    }

    /// The six walls of the block from the origin to `size` \[m\], at rest.
    pub fn block(size: [f64; 3]) -> Vec<Self> {
        let along = |k: usize, sign: f64| std::array::from_fn(|m| if m == k { sign } else { 0.0 });
        (0..3)
            .flat_map(|k| [Self::at_rest([0.0; 3], along(k, 1.0)), Self::at_rest(size, along(k, -1.0))])
            .collect()
    }
}

/// A periodic cell, which deforms with a homogeneous flow u = L (x − origin) and carries the spheres along: their
/// velocities are relative to the flow.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cell {
    /// Its edges; see [`Lattice`].
    pub lattice: Lattice<3>,
    /// L [1/s], L\[k\]\[m\] = ∂u_k/∂x_m. It is 0 below the diagonal, so that the first edge stays along x and the second
    /// in the plane of x and y; any strain and shear can be had in this way, up to a rotation of the box.
    pub velocity_gradient: Matrix,
}

/// A periodic cell that is too small for its spheres.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[error("periodic box: height over face {face} = {} m, allowed: above {SMALLEST_CELL} times the largest radius, {} m",
    number(*height), number(*radius))]
pub struct SmallCell {
    /// 0, 1, 2: the face that edge 0, 1, 2 does not lie in.
    pub face: usize,
    pub height: f64,
    pub radius: f64,
}

/// Each height of the cell is at least this times the largest radius: a sphere must not meet two images of another.
pub const SMALLEST_CELL: f64 = 4.0;

impl Cell {
    /// A block at rest with a corner at the origin.
    pub fn block([x, y, z]: [f64; 3]) -> Self {
        let edges = [[x, 0.0, 0.0], [0.0, y, 0.0], [0.0, 0.0, z]];
        Self { lattice: Lattice { origin: [0.0; 3], edges }, velocity_gradient: [[0.0; 3]; 3] }
    }

    /// \[m³\]
    pub fn volume(&self) -> f64 {
        let [a, b, c] = self.lattice.edges;
        a[0] * b[1] * c[2]
    }

    /// u [m/s] at a point.
    #[inline(always)]
    pub fn flow(&self, point: [f64; 3]) -> [f64; 3] {
        times(&self.velocity_gradient, minus(point, self.lattice.origin))
    }

    /// Deforms the cell for the time `dt` [s].
    pub(crate) fn advance(&mut self, dt: f64) {
        let gradient = self.velocity_gradient;
        for edge in &mut self.lattice.edges {
            *edge = plus(*edge, dt, times(&gradient, *edge));
        }
    }

    /// Multiplies all lengths of the cell by `factor`.
    pub(crate) fn scale(&mut self, factor: f64) {
        self.lattice.edges = self.lattice.edges.map(|edge| edge.map(|x| factor * x));
    }

    /// Checks that no sphere of radius `largest` [m] can touch two images of another.
    pub(crate) fn check(&self, largest: f64) -> Result<(), SmallCell> {
        let edges = self.lattice.edges;
        for face in 0..3 {
            let area = crate::space::cross(edges[(face + 1) % 3], edges[(face + 2) % 3]);
            let height = self.volume() / length(area);
            if height.is_nan() || height <= SMALLEST_CELL * largest {
                return Err(SmallCell { face, height, radius: largest });
            }
        }
        Ok(())
    }
}

/// What surrounds the spheres.
#[derive(Clone, Debug, PartialEq)]
pub enum Boundary {
    Walls(Vec<Wall>),
    Periodic(Cell),
    /// A cell at whose sides the assembly repeats itself, with walls above and below. Its third edge is so long that nothing above
    /// the upper wall meets what is below the lower one.
    Between(Cell, Vec<Wall>),
}

impl Boundary {
    /// The cell of a periodic box; none between walls.
    pub fn cell(&self) -> Option<&Cell> {
        match self {
            Self::Walls(_) => None,
            Self::Periodic(cell) | Self::Between(cell, _) => Some(cell),
        }
    }

    pub(crate) fn cell_mut(&mut self) -> Option<&mut Cell> {
        match self {
            Self::Walls(_) => None,
            Self::Periodic(cell) | Self::Between(cell, _) => Some(cell),
        }
    }

    /// The walls; none in a periodic box.
    pub fn walls(&self) -> &[Wall] {
        match self {
            Self::Walls(walls) | Self::Between(_, walls) => walls,
            Self::Periodic(_) => &[],
        }
    }

    /// The walls, to set their velocities.
    pub fn walls_mut(&mut self) -> &mut [Wall] {
        match self {
            Self::Walls(walls) | Self::Between(_, walls) => walls,
            Self::Periodic(_) => &mut [],
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_sheared_cell_keeps_its_volume_and_an_expanding_one_its_shape() {
        let mut cell = Cell::block([1.0, 2.0, 3.0]);
        cell.velocity_gradient = [[0.0, 0.5, -0.2], [0.0, 0.0, 0.3], [0.0; 3]];
        (0..100).for_each(|_| cell.advance(1e-2));
        assert!((cell.volume() - 6.0).abs() < 1e-12);
        assert!((cell.lattice.edges[1][0] - 1.0).abs() < 1e-12);
        let mut cell = Cell::block([1.0, 2.0, 3.0]);
        cell.velocity_gradient = [[0.1, 0.0, 0.0], [0.0, 0.1, 0.0], [0.0, 0.0, 0.1]];
        cell.advance(1.0);
        assert!((cell.volume() - 6.0 * 1.1f64.powi(3)).abs() < 1e-12);
    }

    #[test]
    fn a_cylinder_is_as_far_as_its_radius_says() {
        let wall = Wall::cylinder([1.0, 2.0, 3.0], [0.0, 0.0, 1.0], 0.5);
        let (distance, normal) = wall.foot([1.3, 1.6, -7.0]);
        assert!(distance.abs() < 1e-15, "{distance}");
        assert!(length(minus(normal, [-0.6, 0.8, 0.0])) < 1e-15, "{normal:?}");
        assert_eq!(wall.foot([1.0, 2.0, 9.0]), (0.5, [0.0; 3]));
    }

    #[test]
    fn a_cylinder_stretches_from_its_point_on() {
        let mut wall = Wall::cylinder([0.0, 0.0, 1.0], [0.0, 0.0, 1.0], 0.5);
        wall.surface = Surface::Cylinder { axis: [0.0, 0.0, 1.0], radius: 0.5, growth: 0.2, stretch: 0.1 };
        assert_eq!(wall.velocity_at([0.4, 0.0, 3.0], [-1.0, 0.0, 0.0]), [0.2, 0.0, 0.2]);
        assert_eq!(wall.velocity_at([0.4, 0.0, 1.0], [-1.0, 0.0, 0.0]), [0.2, 0.0, 0.0]);
    }

    #[test]
    fn a_flat_cell_is_refused() {
        let flat = Cell::block([1.0, 1.0, 0.3]);
        let problem = flat.check(0.1).unwrap_err();
        assert_eq!((problem.face, problem.height), (2, 0.3));
    }
}
