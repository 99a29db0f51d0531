//! A mesh in a plane, for pictures: its cells as polygons. Meshes of one layer of cells are drawn as they are, wedges mirrored to the
//! whole section, and meshes in space are cut in the middle.

use crate::mesh::{Mesh, Patch, cross, dot, minus};
use crate::numbers::{plain, rounded};
use crate::walls::is_constraint;
use std::collections::HashMap;

/// Cuts have at least this share of the cells of the one with the most.
const MIN_CUT: f64 = 0.25;
/// Holes of a wedge below this share of its radius are closed.
const THIN: f64 = 0.02;
const AXES: [&str; 3] = ["x", "y", "z"];

/// The planes in which a mesh is seen.
#[derive(Clone, Debug, PartialEq)]
pub enum View {
    /// The faces of the patches of type `empty`, seen against the axis `out`.
    Layer { right: usize, up: usize, out: usize },
    /// The faces of one patch of type `wedge`, and its mirror image; `axis` points upwards, `angle` is that of the mesh \[rad\].
    Wedge { axis: [f64; 3], angle: f64 },
    /// A cut across the axis `out`, at `at` \[m\].
    Cut { right: usize, up: usize, out: usize, at: f64 },
}

impl View {
    /// The views of a mesh: one, or two cuts that meet in the vertical line. `gravity` points downwards.
    pub fn of(mesh: &Mesh, gravity: Option<[f64; 3]>) -> Vec<Self> {
        let vertical = gravity.filter(|g| dot(*g, *g) > 0.0);
        if let Some((axis, angle)) = wedge(mesh) {
            let sign = vertical.map_or_else(|| axis.iter().sum::<f64>(), |g| -dot(g, axis)).signum();
            return vec![Self::Wedge { axis: axis.map(|x| sign * x), angle }];
        }
        let strongest = |[a, b]: [usize; 2]| vertical.is_some_and(|g| g[a].abs() > g[b].abs());
        let plane = |out: usize| {
            let [right, up] = [[1, 2], [0, 2], [0, 1]][out];
            if strongest([right, up]) { [up, right] } else { [right, up] }
        };
        let empty: Vec<usize> = faces_of(mesh, "empty").collect();
        let outward = |out: usize| empty.iter().any(|&face| along(mesh.areas[face], out));
        if let Some(out) = [2, 1, 0].into_iter().find(|&out| outward(out)) {
            let [right, up] = plane(out);
            return vec![Self::Layer { right, up, out }];
        }
        let cut = |out: usize| {
            let [right, up] = plane(out);
            let ends = mesh.points.iter().fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), p| {
                (low.min(p[out]), high.max(p[out]))
            });
            Self::Cut { right, up, out, at: 0.5 * (ends.0 + ends.1) }
        };
        let cells = |view: &Self| Section::new(&[mesh], view).cells.len();
        // Those that show the vertical first
        let up =
            vertical.map_or(2, |g| (0..3).max_by(|&a, &b| g[a].abs().total_cmp(&g[b].abs())).unwrap_or(2));
        let mut outs: Vec<usize> = [1, 0, 2].into_iter().filter(|&out| out != up).collect();
        outs.push(up);
        let cuts: Vec<(Self, usize)> =
            outs.into_iter().map(cut).map(|view| (view.clone(), cells(&view))).collect();
        let most = cuts.iter().map(|cut| cut.1).max().unwrap_or(0) as f64;
        cuts.into_iter().filter(|cut| cut.1 as f64 >= MIN_CUT * most).map(|cut| cut.0).take(2).collect()
    }

    /// A point of the mesh in the plane: to the right, and upwards.
    pub fn at(&self, p: [f64; 3]) -> [f64; 2] {
        match self {
            Self::Layer { right, up, .. } | Self::Cut { right, up, .. } => [p[*right], p[*up]],
            Self::Wedge { axis, .. } => {
                let along = dot(p, *axis);
                let across: [f64; 3] = std::array::from_fn(|k| p[k] - along * axis[k]);
                [dot(across, across).sqrt(), along]
            }
        }
    }

    /// Names of the two axes.
    pub fn axes(&self) -> [String; 2] {
        match self {
            Self::Layer { right, up, .. } | Self::Cut { right, up, .. } => {
                [*right, *up].map(|k| AXES[k].to_string())
            }
            Self::Wedge { axis, .. } => {
                let k = (0..3).max_by(|&a, &b| axis[a].abs().total_cmp(&axis[b].abs())).unwrap_or(0);
                ["r".to_string(), format!("{}{}", if axis[k] < 0.0 { "-" } else { "" }, AXES[k])]
            }
        }
    }

    /// Which plane it is, for a reader.
    pub fn name(&self) -> String {
        match self {
            Self::Layer { .. } => String::new(),
            Self::Wedge { .. } => "section through the axis".to_string(),
            Self::Cut { out, at, .. } => format!("{} = {} m", AXES[*out], plain(rounded(*at, 4))),
        }
    }
}

/// Polygons in a plane.
#[derive(Clone, Debug, Default)]
pub struct Section {
    pub points: Vec<[f64; 2]>,
    /// The points of each polygon.
    pub polygons: Vec<Vec<usize>>,
    /// Number of the mesh, and cell of each polygon.
    pub cells: Vec<(usize, usize)>,
    known: HashMap<[i64; 2], usize>,
    unit: f64,
}

impl Section {
    /// The cells of meshes that lie next to each other.
    pub fn new(meshes: &[&Mesh], view: &View) -> Self {
        let size =
            meshes.iter().flat_map(|mesh| &mesh.points).flatten().fold(0.0, |most: f64, x| most.max(x.abs()));
        // Points of two meshes that differ by less are one
        let mut section = Self { unit: (1e-7 * size).max(1e-300), ..Self::default() };
        for (number, mesh) in meshes.iter().enumerate() {
            match view {
                View::Layer { out, .. } => {
                    for face in faces_of(mesh, "empty").filter(|&face| along(mesh.areas[face], *out)) {
                        let corners = mesh.faces[face].iter().map(|&p| view.at(mesh.points[p]));
                        section.add(corners, (number, mesh.owner[face]));
                    }
                }
                View::Wedge { .. } => {
                    // Many wedges have a thin hole around their axis, so that no cell ends in an edge
                    let widest = mesh.points.iter().map(|&p| view.at(p)[0]).fold(0.0, f64::max);
                    let closed = |[r, z]: [f64; 2]| [if r < THIN * widest { 0.0 } else { r }, z];
                    let Some(patch) = mesh.patches.iter().find(|patch| patch.kind == "wedge") else {
                        continue;
                    };
                    for face in patch.faces() {
                        let corners = || mesh.faces[face].iter().map(|&p| closed(view.at(mesh.points[p])));
                        let cell = (number, mesh.owner[face]);
                        section.add(corners(), cell);
                        section.add(corners().map(|[r, z]| [-r, z]), cell);
                    }
                }
                View::Cut { out, at, .. } => {
                    let heights: Vec<f64> = mesh.points.iter().map(|p| p[*out] - at).collect();
                    for (cell, faces) in mesh.faces_of_cells().iter().enumerate() {
                        let corners = cut(mesh, faces, &heights);
                        section.add(corners.into_iter().map(|p| view.at(p)), (number, cell));
                    }
                }
            }
        }
        section
    }

    fn add(&mut self, corners: impl Iterator<Item = [f64; 2]>, cell: (usize, usize)) {
        let mut polygon: Vec<usize> = Vec::new();
        for corner in corners {
            let key = corner.map(|x| (x / self.unit).round() as i64);
            let next = self.points.len();
            let point = *self.known.entry(key).or_insert(next);
            if point == next {
                self.points.push(corner);
            }
            if polygon.last() != Some(&point) {
                polygon.push(point);
            }
        }
        while polygon.len() > 1 && polygon.first() == polygon.last() {
            polygon.pop();
        }
        if polygon.len() > 2 {
            self.polygons.push(polygon);
            self.cells.push(cell);
        }
    }
}

/// Whether a patch can be a wall.
pub fn is_wall(kind: &str) -> bool {
    !is_constraint(kind)
}

fn faces_of<'a>(mesh: &'a Mesh, kind: &'a str) -> impl Iterator<Item = usize> + 'a {
    mesh.patches.iter().filter(move |patch| patch.kind == kind).flat_map(Patch::faces)
}

/// Whether a face looks along an axis, in its sense.
fn along(area: [f64; 3], axis: usize) -> bool {
    area[axis] > 0.9 * dot(area, area).sqrt()
}

/// Axis and angle of a mesh that is a wedge.
fn wedge(mesh: &Mesh) -> Option<([f64; 3], f64)> {
    let flat = mesh.patches.iter().filter(|patch| patch.kind == "wedge" && patch.count > 0);
    let add = |sum: [f64; 3], face: usize| std::array::from_fn(|k| sum[k] + mesh.areas[face][k]);
    let normals: Vec<[f64; 3]> = flat.map(|patch| patch.faces().fold([0.0; 3], add)).collect();
    let [first, second, ..] = normals[..] else { return None };
    let axis = cross(first, second);
    let size = dot(axis, axis).sqrt();
    let angle = (size / (dot(first, first) * dot(second, second)).sqrt()).min(1.0).asin();
    (size > 0.0).then(|| (axis.map(|x| x / size), angle))
}

/// The corners, in their order, at which the edges of a convex cell cross the plane in which heights are 0.
fn cut(mesh: &Mesh, faces: &[usize], heights: &[f64]) -> Vec<[f64; 3]> {
    let mut segments: Vec<[(usize, usize); 2]> = Vec::new();
    for &face in faces {
        let corners = &mesh.faces[face];
        let crossed: Vec<(usize, usize)> = (0..corners.len())
            .map(|k| (corners[k], corners[(k + 1) % corners.len()]))
            .filter(|&(a, b)| (heights[a] < 0.0) != (heights[b] < 0.0))
            .map(|(a, b)| (a.min(b), a.max(b)))
            .collect();
        if let [from, to] = crossed[..] {
            segments.push([from, to]);
        }
    }
    let Some([first, mut at]) = segments.pop() else { return Vec::new() };
    let mut edges = vec![first];
    while at != first {
        edges.push(at);
        let Some(next) = segments.iter().position(|segment| segment.contains(&at)) else { return Vec::new() };
        let [from, to] = segments.swap_remove(next);
        at = if from == at { to } else { from };
    }
    let point = |(a, b): (usize, usize)| {
        let share = heights[a] / (heights[a] - heights[b]);
        let way = minus(mesh.points[b], mesh.points[a]);
        std::array::from_fn(|k| mesh.points[a][k] + share * way[k])
    };
    edges.into_iter().map(point).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::path::Path;

    /// A box of 2 x 1 x `layers` cells of 1 m, whose sides are of one patch but those across z.
    fn boxes(layers: usize, kind: &str) -> Mesh {
        let folder = tempfile::tempdir().unwrap();
        write(folder.path(), layers, kind);
        Mesh::read(folder.path(), "").unwrap()
    }

    fn write(case: &Path, layers: usize, kind: &str) {
        let point = |i: usize, j: usize, k: usize| i + 3 * j + 6 * k;
        let points: Vec<String> =
            (0..6 * (layers + 1)).map(|n| format!("({} {} {})", n % 3, n % 6 / 3, n / 6)).collect();
        let mut faces: Vec<(usize, Option<usize>, [usize; 4], bool)> = Vec::new();
        for k in 0..layers {
            let cell = |i: usize| i + 2 * k;
            faces.push((
                cell(0),
                Some(cell(1)),
                [point(1, 0, k), point(1, 1, k), point(1, 1, k + 1), point(1, 0, k + 1)],
                false,
            ));
            faces.push((
                cell(0),
                None,
                [point(0, 0, k), point(0, 0, k + 1), point(0, 1, k + 1), point(0, 1, k)],
                false,
            ));
            faces.push((
                cell(1),
                None,
                [point(2, 0, k), point(2, 1, k), point(2, 1, k + 1), point(2, 0, k + 1)],
                false,
            ));
            for i in 0..2 {
                let up =
                    [point(i, 0, k + 1), point(i + 1, 0, k + 1), point(i + 1, 1, k + 1), point(i, 1, k + 1)];
                if k + 1 < layers {
                    faces.push((cell(i), Some(cell(i) + 2), up, false));
                } else {
                    faces.push((cell(i), None, up, true));
                }
                if k == 0 {
                    faces.push((
                        cell(i),
                        None,
                        [point(i, 0, 0), point(i, 1, 0), point(i + 1, 1, 0), point(i + 1, 0, 0)],
                        true,
                    ));
                }
                faces.push((
                    cell(i),
                    None,
                    [point(i, 0, k), point(i + 1, 0, k), point(i + 1, 0, k + 1), point(i, 0, k + 1)],
                    false,
                ));
                faces.push((
                    cell(i),
                    None,
                    [point(i, 1, k), point(i, 1, k + 1), point(i + 1, 1, k + 1), point(i + 1, 1, k)],
                    false,
                ));
            }
        }
        faces.sort_by_key(|face| (face.1.is_none(), face.3));
        let inside = faces.iter().filter(|face| face.1.is_some()).count();
        let ends = faces.iter().filter(|face| face.3).count();
        let folder = case.join("constant/polyMesh");
        let file = |name: &str, rows: Vec<String>| {
            let text = format!("FoamFile {{ format ascii; }}\n{}\n(\n{}\n)\n", rows.len(), rows.join("\n"));
            msdd_files::write(&folder.join(name), text.as_bytes()).unwrap();
        };
        file("points", points);
        file(
            "faces",
            faces.iter().map(|(_, _, f, _)| format!("4({} {} {} {})", f[0], f[1], f[2], f[3])).collect(),
        );
        file("owner", faces.iter().map(|face| face.0.to_string()).collect());
        file("neighbour", faces.iter().filter_map(|face| Some(face.1?.to_string())).collect());
        let patch = |name: &str, kind: &str, first: usize, count: usize| {
            format!("{name}\n{{\n type {kind};\n nFaces {count};\n startFace {first};\n}}")
        };
        let sides = faces.len() - inside - ends;
        file(
            "boundary",
            vec![patch("sides", "wall", inside, sides), patch("ends", kind, inside + sides, ends)],
        );
    }

    #[test]
    fn a_mesh_is_read_with_its_volumes_and_patches() {
        let mesh = boxes(1, "empty");
        let found = mesh.centres[1].into_iter().chain([mesh.volumes[1]]).zip([1.5, 0.5, 0.5, 1.0]);
        assert!(
            found.into_iter().all(|(value, known)| (value - known).abs() < 1e-12),
            "{:?}",
            mesh.centres[1]
        );
        assert_eq!(mesh.patches[1], Patch { name: "ends".into(), kind: "empty".into(), first: 7, count: 4 });
        let folder = tempfile::tempdir().unwrap();
        write(folder.path(), 1, "empty");
        let points = folder.path().join("constant/polyMesh/points");
        std::fs::write(&points, b"FoamFile { format binary; }\n1\n(\n").unwrap();
        let error = Mesh::read(folder.path(), "").unwrap_err().to_string();
        assert!(
            error.contains("polyMesh/points: binary; allowed: ascii") && error.contains("foamFormatConvert"),
            "{error}"
        );
    }

    #[test]
    fn a_layer_is_seen_from_its_front_with_the_vertical_upwards() {
        let mesh = boxes(1, "empty");
        let views = View::of(&mesh, None);
        assert_eq!(views, [View::Layer { right: 0, up: 1, out: 2 }]);
        let section = Section::new(&[&mesh, &mesh], &views[0]);
        assert_eq!((section.points.len(), section.cells), (6, vec![(0, 0), (0, 1), (1, 0), (1, 1)]));
        assert_eq!(View::of(&mesh, Some([-9.81, 0.0, 0.0])), [View::Layer { right: 1, up: 0, out: 2 }]);
    }

    #[test]
    fn a_mesh_in_space_is_cut_in_the_middle() {
        let mesh = boxes(3, "wall");
        let views = View::of(&mesh, Some([0.0, 0.0, -9.81]));
        assert_eq!(views.iter().map(View::name).collect::<Vec<_>>(), ["y = 0.5 m", "x = 1 m"]);
        let section = Section::new(&[&mesh], &views[0]);
        assert_eq!((section.polygons.len(), section.points.len()), (6, 12));
        let area: f64 = section
            .polygons
            .iter()
            .map(|polygon| {
                {
                    let p = |k: usize| section.points[polygon[k % polygon.len()]];
                    0.5 * (0..polygon.len())
                        .map(|k| p(k)[0] * p(k + 1)[1] - p(k)[1] * p(k + 1)[0])
                        .sum::<f64>()
                }
                .abs()
            })
            .sum();
        assert!((area - 6.0).abs() < 1e-12, "{area}");
        // The cut lies on faces: each is drawn once
        assert_eq!(Section::new(&[&mesh], &views[1]).polygons.len(), 3);
    }

    #[test]
    fn a_wedge_is_mirrored() {
        let view = View::Wedge { axis: [1.0, 0.0, 0.0], angle: 0.1 };
        assert_eq!((view.at([3.0, 3.0, 4.0]), view.axes()), ([5.0, 3.0], ["r".to_string(), "x".to_string()]));
    }
}
