//! A case's mesh, from the text files in `constant/polyMesh`. Centres and volumes are computed as in OpenFOAM: a cell is divided into
//! pyramids on its faces, and its centre is the mean of the pyramids' centres, weighted by volume.

use crate::CaseError;
use crate::binary;
use crate::dictionary::{Dictionary, Token};
use std::path::{Path, PathBuf};

/// A part of the boundary.
#[derive(Clone, Debug, PartialEq)]
pub struct Patch {
    pub name: String,
    /// Its type, such as `wall`.
    pub kind: String,
    /// Its first face, and the number of faces.
    pub first: usize,
    pub count: usize,
}

impl Patch {
    /// The numbers of its faces.
    pub fn faces(&self) -> std::ops::Range<usize> {
        self.first..self.first + self.count
    }
}

/// Points, faces and cells of a mesh.
#[derive(Clone, Debug)]
pub struct Mesh {
    /// Its folder `polyMesh`.
    pub folder: PathBuf,
    /// \[m\].
    pub points: Vec<[f64; 3]>,
    /// The points of each face.
    pub faces: Vec<Vec<usize>>,
    /// Centre \[m\] of each face, and its area vector \[m²\], which points out of the owner.
    pub face_centres: Vec<[f64; 3]>,
    pub areas: Vec<[f64; 3]>,
    /// The cell of each face, and the second cell of the faces inside.
    pub owner: Vec<usize>,
    pub neighbour: Vec<usize>,
    pub patches: Vec<Patch>,
    /// Centre \[m\] and volume \[m³\] of each cell.
    pub centres: Vec<[f64; 3]>,
    pub volumes: Vec<f64>,
}

impl Mesh {
    /// Reads the mesh of a case, or that of a `region` if this is not empty. Files may be packed (`.gz`).
    ///
    /// # Errors
    /// [`CaseError::Read`] for a file that is missing or binary, [`CaseError::Key`] for one that is no list of the right size.
    pub fn read(case: &Path, region: &str) -> Result<Self, CaseError> {
        let folder = case.join("constant").join(region).join("polyMesh");
        let numbers: Vec<f64> = list(&folder.join("points"))?;
        let points: Vec<[f64; 3]> = numbers.chunks(3).map(|p| [p[0], p[1], p[2]]).collect();
        let faces = lists(&folder.join("faces"))?;
        let owner: Vec<usize> = list(&folder.join("owner"))?;
        let neighbour: Vec<usize> = list(&folder.join("neighbour"))?;
        let patches = patches(&folder.join("boundary"))?;
        let bad = |file: &str, value: String, allowed| refused_list(&folder.join(file), value, allowed);
        if owner.len() != faces.len() || neighbour.len() > faces.len() {
            let value = format!("{} owners, {} neighbours", owner.len(), neighbour.len());
            return Err(bad("owner", value, format!("one owner for each of {} faces", faces.len())));
        }
        if let Some(point) = faces.iter().flatten().find(|&&point| point >= points.len()) {
            return Err(bad("faces", point.to_string(), format!("points below {}", points.len())));
        }
        if let Some(patch) = patches.iter().find(|patch| patch.faces().end > faces.len()) {
            let value = format!("{} to {} of {}", patch.first, patch.faces().end, patch.name);
            return Err(bad("boundary", value, format!("faces up to {}", faces.len())));
        }
        let computed: Vec<Face> = faces.iter().map(|face| Face::new(face, &points)).collect();
        let sides = owner.iter().enumerate().chain(neighbour.iter().enumerate());
        let sides: Vec<(usize, usize)> = sides.map(|(face, &cell)| (face, cell)).collect();
        let (centres, volumes) = centres(&computed, &sides).into_iter().unzip();
        let (face_centres, areas) = computed.into_iter().map(|face| (face.centre, face.area)).unzip();
        Ok(Self { folder, points, faces, face_centres, areas, owner, neighbour, patches, centres, volumes })
    }

    /// The faces of each cell.
    pub fn faces_of_cells(&self) -> Vec<Vec<usize>> {
        let mut faces = vec![Vec::new(); self.volumes.len()];
        for (face, &cell) in self.owner.iter().enumerate().chain(self.neighbour.iter().enumerate()) {
            faces[cell].push(face);
        }
        faces
    }
}

/// Centre and area vector of a face.
struct Face {
    centre: [f64; 3],
    area: [f64; 3],
}

pub(crate) fn minus(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

pub fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

pub(crate) fn cross(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

fn mean(points: impl Iterator<Item = [f64; 3]>) -> [f64; 3] {
    let (mut sum, mut count) = ([0.0; 3], 0.0f64);
    for point in points {
        (0..3).for_each(|k| sum[k] += point[k]);
        count += 1.0;
    }
    sum.map(|x| x / count.max(1.0))
}

impl Face {
    /// Computed from the triangles between the mean of the corners and each edge.
    fn new(corners: &[usize], points: &[[f64; 3]]) -> Self {
        let middle = mean(corners.iter().map(|&k| points[k]));
        let (mut area, mut weighted, mut sum) = ([0.0; 3], [0.0; 3], 0.0);
        for (k, &corner) in corners.iter().enumerate() {
            let (a, b) = (points[corner], points[corners[(k + 1) % corners.len()]]);
            let part = cross(minus(a, middle), minus(b, middle)).map(|x| 0.5 * x);
            let size = dot(part, part).sqrt();
            for k in 0..3 {
                area[k] += part[k];
                weighted[k] += size * (a[k] + b[k] + middle[k]) / 3.0;
            }
            sum += size;
        }
        Self { centre: if sum > 0.0 { weighted.map(|x| x / sum) } else { middle }, area }
    }
}

/// Centre and volume of each cell. `sides` are pairs of a face and a cell that it bounds.
fn centres(faces: &[Face], sides: &[(usize, usize)]) -> Vec<([f64; 3], f64)> {
    let count = sides.iter().map(|side| side.1 + 1).max().unwrap_or(0);
    let mut middle = vec![([0.0; 3], 0.0f64); count];
    for &(face, cell) in sides {
        (0..3).for_each(|k| middle[cell].0[k] += faces[face].centre[k]);
        middle[cell].1 += 1.0;
    }
    let middle: Vec<[f64; 3]> = middle.into_iter().map(|(sum, n)| sum.map(|x| x / n.max(1.0))).collect();
    let mut pyramids = vec![([0.0; 3], 0.0); count];
    for &(face, cell) in sides {
        let Face { centre, area } = &faces[face];
        // The absolute value, because the area vector may point into the cell or out of it.
        let volume = dot(*area, minus(*centre, middle[cell])).abs() / 3.0;
        for k in 0..3 {
            pyramids[cell].0[k] += volume * (0.75 * centre[k] + 0.25 * middle[cell][k]);
        }
        pyramids[cell].1 += volume;
    }
    pyramids.into_iter().map(|(sum, volume)| (sum.map(|x| x / volume), volume)).collect()
}

const BINARY: &str = "binary; allowed: ascii. Set 'writeFormat ascii' in system/controlDict and run 'foamFormatConvert -constant'";

/// The list of a file, as the text between its outermost parentheses.
fn content(file: &Path) -> Result<String, CaseError> {
    let failed = |problem: &str| CaseError::Read { file: file.to_path_buf(), problem: problem.to_string() };
    let bytes =
        binary::read(file).ok_or_else(|| failed("there is no such file (blockMesh makes the mesh)"))?;
    if binary::is_binary(&bytes) {
        return Err(failed(BINARY));
    }
    let text = String::from_utf8(bytes).map_err(|_| failed("no text"))?;
    // The head of the file ends with the first closing brace.
    let body = text.find('}').map_or(text.as_str(), |end| &text[end + 1..]);
    let (open, close) = (body.find('('), body.rfind(')'));
    match (open, close) {
        (Some(open), Some(close)) if open < close => Ok(body[open + 1..close].to_string()),
        _ => Err(failed("no list")),
    }
}

/// The patches of the file `boundary`.
fn patches(file: &Path) -> Result<Vec<Patch>, CaseError> {
    let all = Dictionary::parse(file, &content(file)?)?;
    let patch = |name: &Token| {
        let own = all.dictionary_at(&name.text)?;
        let count = |key: &str| {
            let good = |value: f64| value >= 0.0 && value.fract() == 0.0;
            own.number(key, good, "a whole number").map(|value| value as usize)
        };
        let kind = own.text("type").unwrap_or_default();
        Ok(Patch { name: name.text.clone(), kind, first: count("startFace")?, count: count("nFaces")? })
    };
    all.keys().map(patch).collect()
}

fn refused_list(file: &Path, value: String, allowed: String) -> CaseError {
    CaseError::Key { file: file.to_path_buf(), key: "list".to_string(), value, allowed }
}

fn parsed<T: std::str::FromStr>(file: &Path, text: &str) -> Result<Vec<T>, CaseError> {
    let words =
        text.split(|c: char| c.is_whitespace() || c == '(' || c == ')').filter(|word| !word.is_empty());
    let wrong = |word: &str| refused_list(file, word.to_string(), "numbers".to_string());
    let parse = |word: &str| word.parse().map_err(|_| wrong(word));
    words.map(parse).collect()
}

fn list<T: std::str::FromStr>(file: &Path) -> Result<Vec<T>, CaseError> {
    parsed(file, &content(file)?)
}

/// Reads a list with one entry such as `4(0 1 2 3)` on each line.
fn lists(file: &Path) -> Result<Vec<Vec<usize>>, CaseError> {
    let text = content(file)?;
    let inner = text.split(')').filter_map(|part| Some(part.split_once('(')?.1));
    inner.map(|list| parsed(file, list)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The centre of a prism on a triangle is that of the triangle, not that of the box around its corners.
    #[test]
    fn centre_of_a_prism() {
        let corner = |k: usize| [[0.0, 0.0], [3.0, 0.0], [0.0, 3.0]][k % 3];
        let points: Vec<[f64; 3]> = (0..6).map(|k| [corner(k)[0], corner(k)[1], (k / 3) as f64]).collect();
        let faces: [&[usize]; 5] = [&[0, 2, 1], &[3, 4, 5], &[0, 1, 4, 3], &[1, 2, 5, 4], &[2, 0, 3, 5]];
        let (centre, volume) =
            centres(&faces.map(|face| Face::new(face, &points)), &[0, 1, 2, 3, 4].map(|face| (face, 0)))[0];
        assert!(centre.iter().zip([1.0, 1.0, 0.5]).all(|(x, y)| (x - y).abs() < 1e-12), "{centre:?}");
        assert!((volume - 4.5).abs() < 1e-12);
    }
}
