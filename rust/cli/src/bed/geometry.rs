//! The bed of a `bed.toml` as the solver's mesh: a column of cells between plates, a wedge of a cylinder.

use crate::error::CliError;
use msdd_beds::case::BedCase;
use msdd_case::numbers::plain;
use msdd_case::spheres::blocks::{Across, Blocks};
use msdd_case::spheres::shape::INNER;
use msdd_rve::message::number;
use msdd_training::dem_start::FirstRow;
use std::path::Path;

/// Cells along a direction in which heat flows.
const CELLS: f64 = 40.0;
/// Cells along the axis between rough walls, along which the stress changes, where no heat flows there.
const ROUGH_CELLS: f64 = 12.0;
/// Width of the column of a box, in diameters.
const WIDTH: f64 = 3.0;
/// Where the mesh ends before a plate, in diameters. A plate that is heated holds the first layer of grains at its temperature: the mesh
/// ends at their centres. On a floor, where these lie flat and the next layer lies in their hollows, the temperatures of the grains
/// reach that of the floor a little higher. Before the other plate, if it is not heated, the mesh ends where a bed without the wider pores
/// next to plates would hold all grains, and so their heat; also before a wall with a resistance, of which the rest of the way is a part.
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
    /// Whether the column stands for a bed without sides, whose sides are planes of symmetry.
    pub endless: bool,
    /// Up to where DEM counts the spheres outside of the averages, over where the mesh ends: to a side that resists.
    counted: f64,
    /// Cells between the levels, and between the radii.
    cells: ([usize; 3], [usize; 2]),
    diameter: f64,
}

impl Geometry {
    /// Of a bed of this depth [m].
    ///
    /// # Errors
    /// What the solver's mesh cannot have: sides of a box that are heated, averages and temperatures beyond its ends.
    pub fn new(file: &Path, scene: &BedCase, depth: f64) -> Result<Self, CliError> {
        let wrong = |key: &str, value: String, allowed: &str| {
            CliError::Message(format!("{}: {key} = {value}, allowed: {allowed}", file.display()))
        };
        let heated = |name: &str| scene.heated.iter().any(|heated| heated.wall == name);
        if let Some(side) = ["x_low", "x_high", "y_low", "y_high"].into_iter().find(|name| heated(name)) {
            let allowed =
                "floor, lid, and the side of a cylinder, where the solver's case is a column of cells";
            return Err(wrong("heated.wall", side.to_string(), allowed));
        }
        let diameter = scene.grains.diameter;
        let half = diameter * if scene.resists("side") { INSULATED } else { HELD };
        let flows_along = heated("floor") || heated("lid");
        let insulated = if flows_along { INSULATED } else { HELD };
        let end = |wall: &str, held: f64, other: f64| match (scene.resists(wall), heated(wall)) {
            (true, _) => INSULATED * diameter,
            (false, true) => held * diameter,
            (false, false) => other * diameter,
        };
        let first = end("floor", HELD_BY_FLOOR, insulated);
        let last = depth - end("lid", HELD, insulated);
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
        let axial = match scene.grains.wall_friction > 0.0 {
            _ if flows_along => share(&along, CELLS),
            true => share(&along, ROUGH_CELLS),
            false => vec![1; 3],
        };
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
        let counted = if scene.resists("side") { widening } else { 1.0 };
        let cells = ([axial[0], axial[1], axial[2]], [radial[0], radial[1]]);
        Ok(Self {
            levels,
            radii,
            widening,
            endless: scene.container.endless,
            cells,
            diameter,
            plates: depth,
            counted,
        })
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
                let (share, all) = ((inner / radius).powi(2), self.counted.powi(2));
                1.0 - share * (1.0 - start.porosity) - (all - share) * (1.0 - outside)
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
        let width = WIDTH * self.diameter;
        let (across, patches, order): (_, _, &[usize]) = match self.radii {
            None => (
                Across::Box([width; 2], [1; 2]),
                ["side", "side", "side", "side", "floor", "lid"],
                &[4, 5, 0],
            ),
            Some(radii) => (
                Across::Wedge(radii.to_vec(), radial.to_vec()),
                ["inner", "side", "floor", "lid", "front", "back"],
                &[2, 3, 0, 1, 4, 5],
            ),
        };
        let zone = Some(("bulk", [1, 0]));
        let (levels, cells) = (self.levels.to_vec(), axial.to_vec());
        Blocks { across, levels, cells, patches, order, zone, digits: 13, symmetric: self.endless }.text()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A mesh that ends before a side that resists has the volume of all spheres up to the side.
    #[test]
    fn a_mesh_before_a_side_that_resists_holds_all_spheres() {
        let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../cases/beds/round-shell");
        let mut scene = BedCase::read(&folder).unwrap();
        scene.heated[0].resists = true;
        let start = FirstRow::read(&folder.join("dem-1.csv")).unwrap();
        let geometry = Geometry::new(&folder, &scene, start.depth).unwrap();
        let (side, inner) = (scene.container.radius.unwrap(), scene.record.radius.unwrap());
        let end = geometry.radii.unwrap()[2];
        assert!((end - (side - 0.125 * scene.grains.diameter)).abs() < 1e-12, "{end}");
        let spheres = (1.0 - start.porosity) * inner * inner
            + (1.0 - start.porosity_outside.unwrap()) * (side * side - inner * inner);
        let meshed = (1.0 - geometry.porosity(&start)) * end * end;
        assert!((meshed / spheres - 1.0).abs() < 1e-12, "{meshed} {spheres}");
    }
}
