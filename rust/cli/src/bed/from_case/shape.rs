//! The bed that a mesh of `blockMeshDict` stands for: a box, or a cylinder as a wedge about x.

use crate::bed::geometry::{HELD, INSULATED};
use crate::error::CliError;
use msdd_beds::case::Heated;
use msdd_case::case::corners;
use msdd_case::dictionary::{Dictionary, Token, joined};
use msdd_case::spheres::shape::Shape;
use std::collections::BTreeMap;

/// Walls in meshes of 'msdd bed case', whose box has no sides that count.
const OF_WEDGE: [&str; 3] = ["side", "floor", "lid"];
/// Significant digits of what is read: foamDictionary prints six.
pub const DIGITS: i32 = 5;
/// Relative distance within which two coordinates are one.
const SAME: f64 = 1e-6;

/// The mesh. Lengths in metres; the axis is z of a box and x of a wedge.
pub struct Mesh {
    /// Low and high corner of a box along x and y; the wedge's radii otherwise.
    pub sides: [[f64; 2]; 2],
    pub is_wedge: bool,
    /// Levels along the axis, rising.
    pub levels: Vec<f64>,
    /// Radii of the corners of a wedge, rising; empty in a box.
    pub radii: Vec<f64>,
    /// Whether 'msdd bed case' made it: its ends are the centres of the first layers.
    pub is_of_elements: bool,
    /// Patches and walls of the bed, in the order of the patches.
    pub walls: Vec<(&'static str, &'static str)>,
    /// Whether opposite sides of the box are cyclic.
    pub is_endless: bool,
}

/// The bed behind the mesh.
pub struct Extent {
    /// Between floor and lid, and where the floor is along the axis [m].
    pub depth: f64,
    pub floor: f64,
    /// Of a cylinder [m].
    pub radius: Option<f64>,
}

/// Names and types of the patches of `boundary`.
fn patches(tokens: &[Token]) -> BTreeMap<String, String> {
    let word = |k: usize| tokens.get(k).map_or("", |token| token.text.as_str());
    let names = (1..tokens.len()).filter(|&k| word(k) == "{").map(|k| {
        let kind = (k..tokens.len()).take_while(|&at| word(at) != "}").find(|&at| word(at) == "type");
        (word(k - 1).to_string(), kind.map_or("", |at| word(at + 1)).to_string())
    });
    names.collect()
}

/// Values without those that are the same.
fn distinct(mut values: Vec<f64>) -> Vec<f64> {
    values.sort_by(f64::total_cmp);
    let whole = values.last().zip(values.first()).map_or(0.0, |(high, low)| high - low);
    values.dedup_by(|a, b| (*a - *b).abs() <= SAME * whole);
    values
}

impl Mesh {
    /// # Errors
    /// A mesh that is neither a box along the axes nor a wedge about x, and patches with other names.
    pub fn read(file: &Dictionary) -> Result<Self, CliError> {
        let wrong = |key: &str, value: String, allowed: &str| Err(file.refuse(key, &value, allowed).into());
        let tokens = file.value("boundary")?;
        let patches = patches(tokens);
        let is_wedge = patches.values().any(|kind| kind == "wedge");
        let is_of_elements = patches.contains_key("floor") && patches.contains_key("lid");
        let shape = match is_wedge {
            true => Shape::Cylinder { radius: 0.0, height: 0.0 },
            false => Shape::Box([0.0; 3]),
        };
        let own: &'static [&'static str] = if is_wedge { &OF_WEDGE } else { &OF_WEDGE[1..] };
        let (names, walls) = if is_of_elements { (own, own) } else { (shape.walls(), shape.bed_walls()) };
        let names: Vec<(&'static str, &'static str)> =
            names.iter().copied().zip(walls.iter().copied()).collect();
        if let Some((missing, _)) = names.iter().find(|(patch, _)| !patches.contains_key(*patch)) {
            let value = format!("{} (no {missing})", patches.into_keys().collect::<Vec<_>>().join(" "));
            let allowed = "the walls of 'msdd case new --spheres' (left right front back bottom top; side bottom top) or of 'msdd bed case'";
            return wrong("boundary", value, allowed);
        }
        let allowed = "corners of a box along the axes, or of a wedge about the x axis";
        let Some(corners) = corners(file).filter(|corners| corners.len() >= 8) else {
            return wrong("vertices", joined(file.value("vertices")?), allowed);
        };
        let along = |k: usize| distinct(corners.iter().map(|corner| corner[k]).collect());
        let radii = match is_wedge {
            true => distinct(corners.iter().map(|[_, y, z]| y.hypot(*z)).collect()),
            false => Vec::new(),
        };
        let [x, y, z] = [along(0), along(1), along(2)];
        let ends = |values: &[f64]| [values[0], values[values.len() - 1]];
        let is_box = is_wedge || (x.len() == 2 && y.len() == 2);
        let levels = if is_wedge { x.clone() } else { z };
        if !is_box || levels.len() < 2 || (is_wedge && radii.len() < 2) {
            return wrong("vertices", format!("{} corners", corners.len()), allowed);
        }
        let cyclic = |name: &str| patches.get(name).is_some_and(|kind| kind.starts_with("cyclic"));
        let is_endless =
            !is_wedge && (is_of_elements || ["left", "right", "front", "back"].into_iter().all(cyclic));
        let sides = [ends(&x), ends(&y)];
        let walls = names.iter().copied().filter(|(patch, _)| !cyclic(patch)).collect();
        Ok(Self { sides, is_wedge, levels, radii, is_of_elements, walls, is_endless })
    }

    /// Component of a vector, and of a symmetric tensor of OpenFOAM, along the axis.
    pub fn axis(&self) -> (usize, usize) {
        if self.is_wedge { (0, 0) } else { (2, 5) }
    }

    /// Between the ends of the mesh [m].
    pub fn depth(&self) -> f64 {
        self.levels[self.levels.len() - 1] - self.levels[0]
    }

    /// The bed of spheres of a diameter [m]; `walls`: those that are heated.
    pub fn extent(&self, diameter: f64, walls: &[Heated]) -> Extent {
        let outer = self.radii.last().copied();
        if !self.is_of_elements {
            return Extent { depth: self.depth(), floor: self.levels[0], radius: outer };
        }
        let resists = |name: &str| walls.iter().find(|one| one.wall == name).map(|one| one.resists);
        let (floor, lid) = (resists("floor"), resists("lid"));
        // As Geometry of 'msdd bed case' ends its mesh.
        let before_lid = match lid {
            Some(true) => INSULATED,
            None if floor.is_some() => INSULATED,
            _ => HELD,
        };
        let before_side = if resists("side") == Some(true) { INSULATED } else { HELD };
        Extent {
            depth: self.levels[self.levels.len() - 1] + before_lid * diameter,
            floor: 0.0,
            radius: outer.map(|radius| radius + before_side * diameter),
        }
    }
}
