//! Stress on the walls of the bed and heat through them, from the fields.

use super::run::Run;
use crate::error::CliError;
use msdd_case::mesh::dot;
use msdd_case::section::is_wall;
use msdd_draw::map::range_of;
use std::collections::BTreeMap;

/// A face of a wall. Stress is that of the cell at the wall.
#[derive(Clone, Copy, Debug)]
pub struct Face {
    /// Position along the wall \[m\].
    pub at: f64,
    /// \[m²\].
    pub area: f64,
    /// Stress across the wall, compression positive, and along it \[Pa\].
    pub normal: Option<f64>,
    pub shear: Option<f64>,
    /// Heat flux through the grains into the bed \[W/m²\]; none where T has no value on the wall.
    pub heat: Option<f64>,
}

/// A wall with its faces.
#[derive(Clone, Debug)]
pub struct Along {
    pub name: String,
    /// The axis along which positions are counted.
    pub axis: String,
    pub faces: Vec<Face>,
}

impl Along {
    /// Heat through the wall into the bed \[W\]; none where T has no value on it.
    pub fn heat(&self) -> Option<f64> {
        let known: Vec<f64> = self.faces.iter().filter_map(|face| Some(face.heat? * face.area)).collect();
        (!known.is_empty()).then(|| known.iter().sum())
    }

    /// A value over the position, means over the faces in each of `places` steps.
    pub fn curve(&self, places: usize, value: impl Fn(&Face) -> Option<f64>) -> Vec<(f64, f64)> {
        let (low, high) = range_of(self.faces.iter().map(|face| &face.at));
        let step = ((high - low) / places as f64).max(1e-300);
        let mut sums = BTreeMap::<i64, [f64; 3]>::new();
        for face in &self.faces {
            let Some(value) = value(face) else { continue };
            let sum = sums.entry(((face.at - low) / step * 0.999_999).floor() as i64).or_default();
            (0..3).for_each(|k| sum[k] += face.area * [face.at, value, 1.0][k]);
        }
        sums.values().map(|[x, value, n]| (x / n, value / n)).collect()
    }
}

type Vector = [f64; 3];

/// A symmetric tensor (xx, xy, xz, yy, yz, zz) times a vector.
fn times(t: &[f64], n: Vector) -> Vector {
    [[t[0], t[1], t[2]], [t[1], t[3], t[4]], [t[2], t[4], t[5]]].map(|row| dot(row, n))
}

/// The walls of the bed at a time, by its number.
pub fn read(run: &Run, time: usize) -> Result<Vec<Along>, CliError> {
    let mesh = &run.parts[0].mesh;
    let (t, k, stress) =
        (run.field(0, time, "T")?, run.field(0, time, "conductivity")?, run.field(0, time, "stress")?);
    let mut walls = Vec::new();
    for patch in mesh.patches.iter().filter(|patch| is_wall(&patch.kind) && patch.count > 0) {
        let own = t.as_ref().and_then(|t| t.patches.get(&patch.name));
        let place = |centre: Vector| match run.views.len() {
            1 => run.views[0].at(centre).to_vec(),
            _ => centre.to_vec(),
        };
        let places: Vec<Vec<f64>> = patch.faces().map(|face| place(mesh.face_centres[face])).collect();
        let long = |axis: usize| {
            let (low, high) = range_of(places.iter().map(|place| &place[axis]));
            high - low
        };
        let axes = if run.views.len() == 1 {
            run.views[0].axes().to_vec()
        } else {
            ["x", "y", "z"].map(str::to_string).to_vec()
        };
        // The later axis, the vertical, of two that are equal
        let axis = (0..axes.len()).max_by(|&a, &b| long(a).total_cmp(&(long(b) * (1.0 + 1e-9)))).unwrap_or(0);
        let faces = (0..patch.count).map(|index| {
            let face = patch.first + index;
            let cell = mesh.owner[face];
            let area = dot(mesh.areas[face], mesh.areas[face]).sqrt().max(1e-300);
            let n = mesh.areas[face].map(|x| x / area);
            let pressed = stress.as_ref().map(|s| times(s.cells.row(cell), n));
            let way: Vector = std::array::from_fn(|c| mesh.face_centres[face][c] - mesh.centres[cell][c]);
            let heat = own.zip(k.as_ref()).zip(t.as_ref()).map(|((own, k), t)| {
                dot(times(k.cells.row(cell), n), n) * (own.row(index)[0] - t.cells.row(cell)[0]) / dot(way, n)
            });
            Face {
                at: places[index][axis],
                area,
                normal: pressed.map(|s| -dot(s, n)),
                shear: pressed.map(|s| (dot(s, s) - dot(s, n).powi(2)).max(0.0).sqrt()),
                heat: heat.filter(|heat| heat.is_finite()),
            }
        });
        walls.push(Along { name: patch.name.clone(), axis: axes[axis].clone(), faces: faces.collect() });
    }
    Ok(walls)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_curve_along_a_wall_is_the_mean_by_area() {
        let face = |at, area, heat| Face { at, area, normal: None, shear: None, heat };
        let wall = Along {
            name: "side".into(),
            axis: "y".into(),
            faces: vec![
                face(0.0, 1.0, Some(1.0)),
                face(0.1, 3.0, Some(5.0)),
                face(1.0, 1.0, Some(2.0)),
                face(0.5, 1.0, None),
            ],
        };
        let curve = wall.curve(2, |face| face.heat);
        assert_eq!(curve.len(), 2);
        assert!((curve[0].0 - 0.075).abs() < 1e-12 && (curve[0].1 - 4.0).abs() < 1e-12, "{curve:?}");
        assert_eq!(curve[1], (1.0, 2.0));
        assert!(wall.curve(2, |face| face.normal).is_empty());
        assert_eq!(wall.heat(), Some(18.0));
    }
}
