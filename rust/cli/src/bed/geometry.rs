//! The bed of an `dem.toml` as the solver's mesh: a column of cells between plates, a wedge of a cylinder.

use super::start::FirstRow;
use crate::error::CliError;
use msdd_beds::dem_case::DemCase;
use msdd_case::numbers::plain;
use msdd_rve::message::number;
use std::fmt::Write;
use std::path::Path;

/// Cells along a direction in which heat flows, and half of the angle of the wedge of a cylinder [rad].
const CELLS: f64 = 40.0;
const HALF_ANGLE: f64 = 2.5 * std::f64::consts::PI / 180.0;
/// Where the mesh of a cylinder ends before the axis, over its radius, and the width of the column of a box, in diameters.
const INNER: f64 = 0.008;
const WIDTH: f64 = 3.0;
/// Where the mesh ends before a plate, in diameters. A plate that is heated holds the first layer of grains at its temperature: the mesh
/// ends at their centres. On a floor, where these lie flat and the next layer lies in their hollows, the temperatures of the grains
/// reach that of the floor a little higher. Before the other plate, if it is not heated, the mesh ends where a bed without the wider pores
/// beside plates would hold all grains, and so their heat.
pub(super) const HELD: f64 = 0.5;
const HELD_BY_FLOOR: f64 = 0.66;
pub(super) const INSULATED: f64 = 0.125;

/// The bed as the solver's mesh has it: lengths in metres.
pub struct Geometry {
    /// Levels along the axis: floor, the two heights of the averages, lid.
    pub levels: [f64; 4],
    /// Of the lid above the floor.
    pub plates: f64,
    /// In a cylinder: where the mesh begins, the radius of the averages, where it ends.
    pub radii: Option<[f64; 3]>,
    /// Of the cylinder over that of the mesh.
    pub widening: f64,
    /// Cells between the levels, and between the radii.
    cells: ([usize; 3], [usize; 2]),
    diameter: f64,
}

impl Geometry {
    /// Of a bed of this depth [m].
    ///
    /// # Errors
    /// What the solver's mesh cannot have: sides of a box that are heated, averages and temperatures beyond its ends.
    pub fn new(file: &Path, scene: &DemCase, depth: f64) -> Result<Self, CliError> {
        let wrong = |key: &str, value: String, allowed: &str| {
            CliError::Message(format!("{}: {key} = {value}, allowed: {allowed}", file.display()))
        };
        let heated = |name: &str| scene.heated.iter().any(|heated| heated.wall == name);
        if let Some(side) = ["x_low", "x_high", "y_low", "y_high"].into_iter().find(|name| heated(name)) {
            return Err(wrong(
                "heated.wall",
                side.to_string(),
                "floor, lid, and the side of a cylinder, where the solver's case is a column of cells",
            ));
        }
        let diameter = scene.grains.diameter;
        let half = HELD * diameter;
        let flows_along = heated("floor") || heated("lid");
        let insulated = if flows_along { INSULATED } else { HELD };
        let first = diameter * if heated("floor") { HELD_BY_FLOOR } else { insulated };
        let last = depth - diameter * if heated("lid") { HELD } else { insulated };
        let [low, high] = scene.record.heights;
        if low <= first || high >= last {
            let allowed =
                format!("{} to {} m, between the ends of the solver's mesh", number(first), number(last));
            return Err(wrong("record.heights", format!("{} to {}", number(low), number(high)), &allowed));
        }
        let (least, most) = match scene.record.wall.as_str() {
            "side" => (half, (1.0 - INNER) * scene.container.radius.unwrap_or(0.0)),
            "lid" => (depth - last, depth - first),
            _ => (first, last),
        };
        if let Some(distance) =
            scene.record.distances.iter().find(|&&distance| distance < least || distance > most)
        {
            let allowed = format!("{} to {} m, within the solver's mesh", number(least), number(most));
            return Err(wrong("record.distances", number(*distance), &allowed));
        }
        let levels = [first, low, high, last];
        let share = |lengths: &[f64], all: f64| -> Vec<usize> {
            let whole: f64 = lengths.iter().sum();
            lengths.iter().map(|length| ((all * length / whole).round() as usize).max(1)).collect()
        };
        let along = [1, 2, 3].map(|k| levels[k] - levels[k - 1]);
        let axial = if flows_along { share(&along, CELLS) } else { vec![1; 3] };
        let radii = match (scene.container.radius, scene.record.radius) {
            (Some(radius), Some(inner)) if inner < radius - half => {
                Some([INNER * radius, inner, radius - half])
            }
            (Some(radius), Some(inner)) => {
                let allowed =
                    format!("less than {} m, the centres of the first layer", number(radius - half));
                return Err(wrong("record.radius", number(inner), &allowed));
            }
            _ => None,
        };
        let radial = radii
            .map_or(vec![1; 2], |[a, b, c]| share(&[b - a, c - b], if heated("side") { 20.0 } else { 4.0 }));
        let widening = scene.container.radius.map_or(1.0, |radius| radius / (radius - half));
        let cells = ([axial[0], axial[1], axial[2]], [radial[0], radial[1]]);
        Ok(Self { levels, radii, widening, cells, diameter, plates: depth })
    }

    /// Of the mesh along the axis [m].
    pub fn depth(&self) -> f64 {
        self.levels[3] - self.levels[0]
    }

    /// A point at a height and, in a cylinder, a distance from the axis [m].
    pub fn point(&self, height: f64, radius: f64) -> [f64; 3] {
        match self.radii {
            Some(_) => [height, radius, 0.0],
            None => [0.5 * WIDTH * self.diameter, 0.5 * WIDTH * self.diameter, height],
        }
    }

    /// Values along radius, around the axis and along it, or along x, y, z, as a symmetric tensor of OpenFOAM.
    pub fn tensor(&self, [first, second, third]: [f64; 3]) -> String {
        let [x, y, z] = if self.radii.is_some() { [third, first, second] } else { [first, second, third] };
        format!("({} 0 0 {} 0 {})", plain(x), plain(y), plain(z))
    }

    /// Of the whole mesh: in a cylinder by the areas.
    pub fn porosity(&self, start: &FirstRow) -> f64 {
        match (self.radii, start.porosity_outside) {
            (Some([_, inner, radius]), Some(outside)) => {
                let share = (inner / radius).powi(2);
                share * start.porosity + (1.0 - share) * outside
            }
            _ => start.porosity,
        }
    }

    /// A vector along the axis.
    pub fn along(&self, value: f64) -> String {
        let value = plain(value);
        if self.radii.is_some() { format!("({value} 0 0)") } else { format!("(0 0 {value})") }
    }

    /// How a parallel run is divided: along the direction with the most cells.
    pub fn parts(&self) -> String {
        let (axial, radial) = self.cells;
        let many = "$..numberOfSubdomains";
        let parts = match self.radii {
            None => format!("1 1 {many}"),
            Some(_) if radial.iter().sum::<usize>() > axial.iter().sum() => format!("1 {many} 1"),
            Some(_) => format!("{many} 1 1"),
        };
        format!(
            "// './Allrun -parallel N' sets their number\nnumberOfSubdomains 2;\nmethod          simple;\nsimpleCoeffs\n{{\n    n           ({parts});\n    delta       0.001;\n}}\n"
        )
    }

    pub fn mesh(&self) -> String {
        let (axial, radial) = self.cells;
        let mut vertices = String::new();
        let mut blocks = String::new();
        let mut patches = [const { String::new() }; 6];
        let [floor, lid, inner, side, front, back] = &mut patches;
        match self.radii {
            None => {
                let width = WIDTH * self.diameter;
                for z in self.levels {
                    for [x, y] in [[0.0, 0.0], [width, 0.0], [width, width], [0.0, width]] {
                        let _ = writeln!(vertices, "    ({} {} {})", plain(x), plain(y), plain(z));
                    }
                }
                for (k, cells) in axial.iter().enumerate() {
                    let n = |corner: usize| 4 * k + corner;
                    let name = if k == 1 { "bulk " } else { "" };
                    let _ = writeln!(
                        blocks,
                        "    hex ({} {} {} {} {} {} {} {}) {name}(1 1 {cells}) simpleGrading (1 1 1)",
                        n(0),
                        n(1),
                        n(2),
                        n(3),
                        n(4),
                        n(5),
                        n(6),
                        n(7)
                    );
                    for [a, b] in [[0, 1], [1, 2], [2, 3], [3, 0]] {
                        let _ = write!(side, " ({} {} {} {})", n(a), n(b), n(b + 4), n(a + 4));
                    }
                }
                *floor = " (0 3 2 1)".to_string();
                *lid = " (12 13 14 15)".to_string();
            }
            Some(radii) => {
                for sign in [-1.0, 1.0] {
                    for r in radii {
                        for x in self.levels {
                            let (y, z) = (r * HALF_ANGLE.cos(), sign * r * HALF_ANGLE.sin());
                            let _ = writeln!(vertices, "    ({} {y:.12e} {z:.12e})", plain(x));
                        }
                    }
                }
                // Corner at a level, a radius and a side of the wedge.
                let n = |level: usize, radius: usize, half: usize| 12 * half + 4 * radius + level;
                for (j, across) in radial.iter().enumerate() {
                    for (k, along) in axial.iter().enumerate() {
                        let name = if (k, j) == (1, 0) { "bulk " } else { "" };
                        let face = |half: usize| {
                            [n(k, j, half), n(k + 1, j, half), n(k + 1, j + 1, half), n(k, j + 1, half)]
                        };
                        let [a, b, c, d] = face(0);
                        let [e, f, g, h] = face(1);
                        let _ = writeln!(
                            blocks,
                            "    hex ({a} {b} {c} {d} {e} {f} {g} {h}) {name}({along} {across} 1) simpleGrading (1 1 1)"
                        );
                        let _ = write!(front, " ({a} {d} {c} {b})");
                        let _ = write!(back, " ({e} {f} {g} {h})");
                        if k == 0 {
                            let _ = write!(floor, " ({a} {e} {h} {d})");
                        }
                        if k == 2 {
                            let _ = write!(lid, " ({b} {c} {g} {f})");
                        }
                        if j == 0 {
                            let _ = write!(inner, " ({a} {b} {f} {e})");
                        } else {
                            let _ = write!(side, " ({d} {h} {g} {c})");
                        }
                    }
                }
            }
        }
        let patch = |name: &str, kind: &str, faces: &str| match faces {
            "" => String::new(),
            _ => format!("    {name}\n    {{\n        type {kind};\n        faces ({} );\n    }}\n", faces),
        };
        let [floor, lid, inner, side, front, back] = patches;
        let boundary: String = [
            ("floor", "wall", floor),
            ("lid", "wall", lid),
            ("inner", "wall", inner),
            ("side", "wall", side),
            ("front", "wedge", front),
            ("back", "wedge", back),
        ]
        .iter()
        .map(|(name, kind, faces)| patch(name, kind, faces))
        .collect();
        format!("vertices\n(\n{vertices});\n\nblocks\n(\n{blocks});\n\nboundary\n(\n{boundary});\n")
    }
}
