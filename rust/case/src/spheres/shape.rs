//! Shapes of beds of spheres: a box, or a cylinder as a wedge of 5 degrees. Directions are x, y, z of a box, z upwards, and radius
//! and axis of a cylinder.

use crate::numbers::{plain, rounded};
use std::f64::consts::PI;

/// Half of the angle of the wedge of a cylinder \[rad\].
pub const HALF_ANGLE: f64 = 2.5 * PI / 180.0;
/// Where the mesh of a cylinder begins over its radius: a narrow hole stands for the axis.
pub const INNER: f64 = 0.008;
/// Where points of the mesh can be, over the radius of a cylinder: next to the hole, and within its side, which is flat in the wedge.
const PROBED: [f64; 2] = [0.01, 0.999];
/// Least side of a proposed cell in diameters of a sphere.
const CELL: f64 = 1.5;
/// Most cells that are proposed along a direction, where one, two or three of them need cells.
const PROPOSED: [f64; 3] = [40.0, 24.0, 12.0];

/// Lengths in metres.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Shape {
    /// Along x, y and z.
    Box([f64; 3]),
    Cylinder {
        radius: f64,
        height: f64,
    },
}

impl Shape {
    pub fn name(&self) -> &'static str {
        match self {
            Self::Box(_) => "box",
            Self::Cylinder { .. } => "cylinder",
        }
    }

    /// Names of the walls that may be heated, as in the mesh: those at both ends of each direction of a box; side, bottom and top of
    /// a cylinder.
    pub fn walls(&self) -> &'static [&'static str] {
        match self {
            Self::Box(_) => &["left", "right", "front", "back", "bottom", "top"],
            Self::Cylinder { .. } => &["side", "bottom", "top"],
        }
    }

    /// Names of these walls in the description of a bed.
    pub fn bed_walls(&self) -> &'static [&'static str] {
        match self {
            Self::Box(_) => &["x_low", "x_high", "y_low", "y_high", "floor", "lid"],
            Self::Cylinder { .. } => &["side", "floor", "lid"],
        }
    }

    /// Lengths along the directions, with their names \[m\].
    pub fn lengths(&self) -> Vec<(&'static str, f64)> {
        match *self {
            Self::Box([x, y, z]) => {
                vec![("width of the box", x), ("depth of the box", y), ("height of the box", z)]
            }
            Self::Cylinder { radius, height } => {
                vec![("radius of the cylinder", radius), ("height of the cylinder", height)]
            }
        }
    }

    pub fn height(&self) -> f64 {
        match *self {
            Self::Box([_, _, z]) => z,
            Self::Cylinder { height, .. } => height,
        }
    }

    /// The least distance of two opposite sides \[m\].
    pub fn breadth(&self) -> f64 {
        match *self {
            Self::Box([x, y, _]) => x.min(y),
            Self::Cylinder { radius, .. } => 2.0 * radius,
        }
    }

    /// \[m³\]
    pub fn volume(&self) -> f64 {
        match *self {
            Self::Box([x, y, z]) => x * y * z,
            Self::Cylinder { radius, height } => PI * radius * radius * height,
        }
    }

    /// Lengths over which heat spreads from walls that have a temperature \[m\], by direction: infinite where none has.
    pub fn heat_ways(&self, warm: &[bool]) -> Vec<f64> {
        let between = |low: bool, high: bool, length: f64| match (low, high) {
            (true, true) => 0.5 * length,
            (false, false) => f64::INFINITY,
            _ => length,
        };
        let at = |k: usize| warm.get(k).copied().unwrap_or(false);
        match *self {
            Self::Box(lengths) => (0..3).map(|k| between(at(2 * k), at(2 * k + 1), lengths[k])).collect(),
            Self::Cylinder { radius, height } => {
                vec![if at(0) { radius } else { f64::INFINITY }, between(at(1), at(2), height)]
            }
        }
    }

    /// Proposed numbers of cells: one along directions in which nothing changes. `varies`: where something does; `diameter`: of a
    /// sphere \[m\].
    pub fn proposed_cells(&self, varies: &[bool], diameter: f64) -> Vec<usize> {
        let many = varies.iter().filter(|&&varies| varies).count().clamp(1, PROPOSED.len());
        let most = PROPOSED[many - 1];
        let number = |length: f64| (length / (CELL * diameter)).floor().clamp(1.0, most) as usize;
        let lengths = self.lengths().into_iter().zip(varies);
        lengths.map(|((_, length), &varies)| if varies { number(length) } else { 1 }).collect()
    }

    /// Three points on a line through the middle of the bed along a direction \[m\]: x, y, z, or radius and height.
    pub fn proposed_probes(&self, direction: usize) -> Vec<Vec<f64>> {
        let lengths: Vec<f64> = self.lengths().iter().map(|(_, length)| *length).collect();
        let point = |share: f64| {
            let at = |k: usize| if k == direction { share } else { 0.5 };
            lengths.iter().enumerate().map(|(k, length)| rounded(at(k) * length, 6)).collect()
        };
        [0.25, 0.5, 0.75].map(point).to_vec()
    }

    /// Whether a point is inside of the mesh.
    pub fn holds(&self, point: &[f64]) -> bool {
        match (*self, point) {
            (Self::Box(lengths), &[x, y, z]) => {
                [x, y, z].into_iter().zip(lengths).all(|(x, length)| (0.0..=length).contains(&x))
            }
            (Self::Cylinder { radius, height }, &[r, z]) => {
                (0.0..=PROBED[1] * radius).contains(&r) && (0.0..=height).contains(&z)
            }
            _ => false,
        }
    }

    /// What [`Self::holds`] takes, as text.
    pub fn points_allowed(&self) -> String {
        match *self {
            Self::Box(lengths) => {
                let [x, y, z] = lengths.map(plain);
                format!("x,y,z inside of the box, 0,0,0 to {x},{y},{z} m")
            }
            Self::Cylinder { radius, height } => {
                let most = plain(rounded(PROBED[1] * radius, 4));
                format!("radius,height: distance from the axis and height, 0,0 to {most},{} m", plain(height))
            }
        }
    }

    /// A point in the coordinates of the mesh: the axis of a cylinder is x there, and its radius y. A point on the axis stands next to
    /// the hole.
    pub fn point(&self, point: &[f64]) -> String {
        let mesh = match (*self, point) {
            (Self::Cylinder { radius, .. }, &[r, z]) => {
                vec![z, r.max(rounded(PROBED[0] * radius, 6)), 0.0]
            }
            _ => point.to_vec(),
        };
        format!("({})", mesh.into_iter().map(plain).collect::<Vec<_>>().join(" "))
    }

    /// A point in words.
    pub fn place(&self, point: &[f64]) -> String {
        let names = match self {
            Self::Box(_) => ["x", "y", "z"].as_slice(),
            Self::Cylinder { .. } => &["radius", "height"],
        };
        let parts: Vec<String> =
            names.iter().zip(point).map(|(name, value)| format!("{name} {} m", plain(*value))).collect();
        parts.join(", ")
    }

    /// A vector upwards.
    pub fn upwards(&self, value: f64) -> String {
        match self {
            Self::Box(_) => format!("(0 0 {})", plain(value)),
            Self::Cylinder { .. } => format!("({} 0 0)", plain(value)),
        }
    }

    /// A symmetric tensor of OpenFOAM that is equal in all horizontal directions.
    pub fn tensor(&self, horizontal: f64, vertical: f64) -> String {
        let (h, v) = (plain(horizontal), plain(vertical));
        match self {
            Self::Box(_) => format!("({h} 0 0 {h} 0 {v})"),
            Self::Cylinder { .. } => format!("({v} 0 0 {h} 0 {h})"),
        }
    }

    /// Numbers of parts of a parallel run along the axes of the mesh, for `system/decomposeParDict`: it is cut where most cells are.
    pub fn parts(&self, cells: &[usize]) -> String {
        let along: Vec<usize> = match self {
            Self::Box(_) => cells.to_vec(),
            Self::Cylinder { .. } => cells.iter().rev().copied().chain([1]).collect(),
        };
        let most = (0..along.len()).rev().max_by_key(|&k| along[k]);
        let part = |k: usize| if Some(k) == most { "$..numberOfSubdomains" } else { "1" };
        (0..along.len()).map(part).collect::<Vec<_>>().join(" ")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cells_and_points_lie_where_heat_flows() {
        let plates = Shape::Box([0.3, 0.1, 0.2]);
        assert_eq!(plates.heat_ways(&[true, true, false, false, false, true]), [0.15, f64::INFINITY, 0.2]);
        assert_eq!(plates.proposed_cells(&[true, false, false], 0.01), [20, 1, 1]);
        assert_eq!(plates.proposed_cells(&[true; 3], 1e-3), [12, 12, 12]);
        assert_eq!(plates.proposed_probes(0)[2], [0.225, 0.05, 0.1]);
        assert_eq!(plates.parts(&[20, 1, 30]), "1 1 $..numberOfSubdomains");
        assert_eq!(plates.point(&[0.1, 0.05, 0.2]), "(0.1 0.05 0.2)");
        let round = Shape::Cylinder { radius: 0.1, height: 0.4 };
        assert_eq!(round.heat_ways(&[true, false, true]), [0.1, 0.4]);
        assert_eq!(round.proposed_cells(&[true, true], 6.4e-3), [10, 24]);
        assert_eq!(round.point(&[0.05, 0.3]), "(0.3 0.05 0)");
        assert_eq!(round.point(&[0.0, 0.3]), "(0.3 0.001 0)");
        assert_eq!(round.parts(&[10, 24]), "$..numberOfSubdomains 1 1");
        assert!(round.holds(&[0.0, 0.4]) && !round.holds(&[0.1, 0.4]) && !round.holds(&[0.05, 0.4, 0.0]));
        assert!(plates.holds(&[0.3, 0.0, 0.2]) && !plates.holds(&[0.3, 0.0]));
    }
}
