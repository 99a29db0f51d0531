//! `system/blockMeshDict` of a bed: a box, or a cylinder as a wedge about x, divided at levels along its axis and in a wedge at radii.

use super::shape::HALF_ANGLE;
use crate::numbers::{plain, rounded};
use std::fmt::Write;

/// Where the blocks end across the axis.
pub enum Across {
    /// Of a box: width and depth \[m\], and cells along them.
    Box([f64; 2], [usize; 2]),
    /// Of a wedge: rising radii \[m\], and cells between them.
    Wedge(Vec<f64>, Vec<usize>),
}

/// Blocks of a mesh. Lengths in metres.
pub struct Blocks {
    pub across: Across,
    /// Rising levels along the axis, z of a box and x of a wedge, and cells between them.
    pub levels: Vec<f64>,
    pub cells: Vec<usize>,
    /// Names of the patches at both ends of each direction; equal names are one patch. Of a box x, y, z; of a wedge radius and axis,
    /// and the flat sides.
    pub patches: [&'static str; 6],
    /// Order of the patches in the file: their numbers.
    pub order: &'static [usize],
    /// Name of the cells of a block: its level, its place between the radii.
    pub zone: Option<(&'static str, [usize; 2])>,
    /// Significant digits of the coordinates of a wedge.
    pub digits: i32,
    /// Whether the sides of a box are planes of symmetry.
    pub symmetric: bool,
}

impl Blocks {
    /// The text, without the head of OpenFOAM.
    pub fn text(&self) -> String {
        let rings = match &self.across {
            Across::Box(..) => 1,
            Across::Wedge(radii, _) => radii.len() - 1,
        };
        let (mut blocks, mut faces) = (String::new(), [const { String::new() }; 6]);
        for j in 0..rings {
            for k in 0..self.cells.len() {
                let [a, b, c, d, e, f, g, h] = self.corners(j, k);
                let zone = self
                    .zone
                    .filter(|(_, block)| *block == [k, j])
                    .map_or(String::new(), |(name, _)| format!("{name} "));
                let cells = self.counts(j, k);
                let _ = writeln!(
                    blocks,
                    "    hex ({a} {b} {c} {d} {e} {f} {g} {h}) {zone}({cells}) simpleGrading (1 1 1)"
                );
                let last = k + 1 == self.cells.len();
                // Faces of a box at x, y, z; of a wedge, whose hexahedra lie along axis, radius, angle, at radius, axis, angle.
                let all = match self.across {
                    Across::Box(..) => [
                        ([a, e, h, d], true),
                        ([b, c, g, f], true),
                        ([a, b, f, e], true),
                        ([d, h, g, c], true),
                        ([a, d, c, b], k == 0),
                        ([e, f, g, h], last),
                    ],
                    Across::Wedge(..) => [
                        ([a, b, f, e], j == 0),
                        ([d, h, g, c], j + 1 == rings),
                        ([a, e, h, d], k == 0),
                        ([b, c, g, f], last),
                        ([a, d, c, b], true),
                        ([e, f, g, h], true),
                    ],
                };
                for (face, ([a, b, c, d], _)) in faces.iter_mut().zip(all).filter(|(_, (_, there))| *there) {
                    let _ = write!(face, " ({a} {b} {c} {d})");
                }
            }
        }
        format!(
            "vertices\n(\n{});\n\nblocks\n(\n{blocks});\n\nboundary\n(\n{});\n",
            self.vertices(),
            self.boundary(&faces)
        )
    }

    fn vertices(&self) -> String {
        let mut text = String::new();
        let mut point = |[x, y, z]: [f64; 3]| {
            let _ = writeln!(text, "    ({} {} {})", plain(x), plain(y), plain(z));
        };
        match &self.across {
            Across::Box([width, depth], _) => {
                for z in &self.levels {
                    for [x, y] in [[0.0, 0.0], [*width, 0.0], [*width, *depth], [0.0, *depth]] {
                        point([x, y, *z]);
                    }
                }
            }
            Across::Wedge(radii, _) => {
                for sign in [-1.0, 1.0] {
                    for r in radii {
                        let [y, z] = [r * HALF_ANGLE.cos(), sign * r * HALF_ANGLE.sin()];
                        let [y, z] = [y, z].map(|length| rounded(length, self.digits));
                        self.levels.iter().for_each(|x| point([*x, y, z]));
                    }
                }
            }
        }
        text
    }

    /// Numbers of the corners of the block between two radii and two levels.
    fn corners(&self, j: usize, k: usize) -> [usize; 8] {
        match &self.across {
            Across::Box(..) => [0, 1, 2, 3, 4, 5, 6, 7].map(|corner| 4 * k + corner),
            Across::Wedge(radii, _) => {
                let n = |half: usize, radius: usize, level: usize| {
                    self.levels.len() * (radii.len() * half + radius) + level
                };
                let side =
                    |half| [n(half, j, k), n(half, j, k + 1), n(half, j + 1, k + 1), n(half, j + 1, k)];
                let ([a, b, c, d], [e, f, g, h]) = (side(0), side(1));
                [a, b, c, d, e, f, g, h]
            }
        }
    }

    fn counts(&self, j: usize, k: usize) -> String {
        match &self.across {
            Across::Box(_, [x, y]) => format!("{x} {y} {}", self.cells[k]),
            Across::Wedge(_, radial) => format!("{} {} 1", self.cells[k], radial[j]),
        }
    }

    fn boundary(&self, faces: &[String; 6]) -> String {
        let mut text = String::new();
        for &k in self.order {
            let name = &self.patches[k];
            let flat = matches!(self.across, Across::Wedge(..)) && k > 3;
            let kind = match self.symmetric && k < 4 {
                true => "symmetry",
                false if flat => "wedge",
                false => "wall",
            };
            let own = self.patches.iter().zip(faces).filter(|(other, _)| *other == name);
            let own: String = own.map(|(_, faces)| faces.as_str()).collect();
            let _ =
                write!(text, "    {name}\n    {{\n        type {kind};\n        faces ({own} );\n    }}\n");
        }
        text
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Each face of the surface lies in one patch: blocks have six faces, of which neighbours share one.
    #[test]
    fn patches_have_all_faces_of_the_surface() {
        let column = Blocks {
            across: Across::Box([1.0, 2.0], [1, 1]),
            levels: vec![0.0, 1.0, 2.0, 3.0],
            cells: vec![4, 5, 6],
            patches: ["side", "side", "side", "side", "floor", "lid"],
            order: &[4, 5, 0],
            zone: Some(("bulk", [1, 0])),
            digits: 10,
            symmetric: false,
        };
        let wedge = Blocks {
            across: Across::Wedge(vec![0.1, 0.5, 1.0], vec![2, 3]),
            patches: ["inner", "side", "floor", "lid", "front", "back"],
            order: &[2, 3, 0, 1, 4, 5],
            levels: column.levels.clone(),
            cells: column.cells.clone(),
            ..column
        };
        let count = |text: &str, patch: &str| {
            let (_, after) = text.split_once(&format!("    {patch}\n")).unwrap();
            after.lines().nth(2).unwrap().matches('(').count() - 1
        };
        let text = wedge.text();
        let found = wedge.patches.map(|patch| count(&text, patch));
        assert_eq!(found, [3, 3, 2, 2, 6, 6]);
        assert!(text.contains("hex (1 2 6 5 13 14 18 17) bulk (5 2 1)"), "{text}");
        let text = column.text();
        assert_eq!(["side", "floor", "lid"].map(|patch| count(&text, patch)), [12, 1, 1]);
        assert!(text.contains("hex (4 5 6 7 8 9 10 11) bulk (1 1 5)"), "{text}");
    }
}
