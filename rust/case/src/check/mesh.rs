//! Checks the mesh: that in `constant/polyMesh` when it is there, else the one that `system/blockMeshDict` describes.

use super::finding::Findings;
use super::made;
use crate::binary::is_binary;
use crate::dictionary::{Dictionary, Entry, joined};
use std::path::Path;

/// Path in the case folder.
pub const BLOCKS: &str = "system/blockMeshDict";

/// Properties of the mesh that other checks need.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Mesh {
    /// Names of the patches with their types; empty when they are not known.
    pub patches: Vec<[String; 2]>,
    /// Number of cells.
    pub cells: Option<usize>,
    /// Number of cells along x and y, if the mesh is a single block.
    pub shape: Option<[usize; 2]>,
    /// Lower left and upper right corner of the box [m].
    pub bounds: Option<[[f64; 2]; 2]>,
    /// Least and greatest coordinates of its points [m].
    pub extent: Option<[[f64; 3]; 2]>,
    /// Of a wedge, the directions of its axis and of the normal of its middle plane, 0 for x.
    pub axis: Option<[usize; 2]>,
    /// Names of the zones of cells; none when they are not known.
    pub zones: Option<Vec<String>>,
}

/// What a cell is, which the types of the patches say.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// One layer in the plane of x and y.
    Plane,
    /// A body of revolution.
    Wedge,
    Solid,
    Unknown,
}

impl Mesh {
    /// Names of the patches.
    pub fn names(&self) -> Vec<String> {
        self.patches.iter().map(|[name, _]| name.clone()).collect()
    }

    pub fn kind(&self) -> Kind {
        let has = |kind: &str| self.patches.iter().any(|[_, other]| other == kind);
        match (has("wedge"), has("empty")) {
            (true, _) => Kind::Wedge,
            (false, true) => Kind::Plane,
            (false, false) if self.patches.is_empty() => Kind::Unknown,
            (false, false) => Kind::Solid,
        }
    }

    /// Whether it may have one layer of cells along z; that it has more is said apart.
    fn is_one_layer(&self) -> bool {
        self.shape.is_some() || self.cells.is_none() || self.bounds.is_none()
    }

    /// Sides of a cell [m], if all cells are equal.
    pub fn cell(&self) -> Option<[f64; 2]> {
        let ([low, high], [nx, ny]) = (self.bounds?, self.shape?);
        Some([(high[0] - low[0]) / nx as f64, (high[1] - low[1]) / ny as f64])
    }
}

/// Checks the mesh and returns what is known of it; `constant` is the folder that holds `polyMesh`, `blocks` is
/// `system/blockMeshDict`; `is_plane`: whether the case's model knows the plane alone.
pub fn check(constant: &Path, blocks: Option<&Dictionary>, is_plane: bool, found: &mut Findings) -> Mesh {
    let mut mesh = Mesh::default();
    if let Some(blocks) = blocks {
        read_blocks(blocks, is_plane, &mut mesh, found);
    }
    // The solver reads the mesh in constant/polyMesh; blockMeshDict may have been changed after that was made.
    let boundary = constant.join("polyMesh/boundary");
    let mut made = false;
    if let Ok(text) = msdd_files::read_text(&boundary) {
        made = true;
        let folder = constant.join("polyMesh");
        made::check(&folder, found);
        let extent = made::extent(&folder);
        if extent.is_none() || !mesh.extent.is_some_and(|wanted| is_near(extent, wanted)) {
            // It may have been turned after blockMesh
            mesh.axis = None;
        }
        mesh.extent = extent.or(mesh.extent);
        mesh.zones = zones_of_mesh(&folder);
        match patches_of_mesh(&boundary, &text) {
            Some(patches) => mesh.patches = patches,
            None => found.error(["constant/polyMesh/boundary", ""], "no list of patches", "", made::AGAIN),
        }
        let old = mesh.cells;
        mesh.cells = cells_of_mesh(constant).or(old);
        if old.is_some() && mesh.cells != old {
            let (made, wanted) = (mesh.cells.unwrap_or(0), old.unwrap_or(0));
            let advice = "The mesh in constant/polyMesh is that of the run. If blockMesh alone makes it, it is older than this file: \
                          Allrun makes it again, or run blockMesh; if snappyHexMesh or another program makes it, this may be meant";
            found.doubt([BLOCKS, "blocks"], &format!("{wanted} cells, but the mesh has {made}"), "", advice);
            mesh.shape = None;
        }
    } else if blocks.is_none() {
        let advice = "Neither a mesh in constant/polyMesh nor a description for blockMesh is there; 'msdd case new' writes one";
        found.error([BLOCKS, ""], "missing", "", advice);
    }
    // Faces that blockMeshDict does not name become a patch of type empty
    if made && is_plane && (mesh.kind() == Kind::Wedge || mesh.kind() == Kind::Solid) && mesh.is_one_layer() {
        let advice = "This model is made from discs and knows no third direction; the surrogate types spheres and constant take any mesh";
        found.error(
            [BLOCKS, "boundary"],
            "no patch of type empty",
            "patches of type empty in front and behind",
            advice,
        );
    }
    mesh
}

/// Whether a mesh has the size of another, but for the digits of its file.
fn is_near(extent: Option<[[f64; 3]; 2]>, [low, high]: [[f64; 3]; 2]) -> bool {
    let size = (0..3).map(|k| high[k] - low[k]).fold(0.0, f64::max);
    let near = |a: [f64; 3], b: [f64; 3]| (0..3).all(|k| (a[k] - b[k]).abs() <= 1e-4 * size);
    extent.is_some_and(|[a, b]| near(a, low) && near(b, high))
}

/// Names of the zones of cells; none where their file cannot be read, because it is packed or binary.
fn zones_of_mesh(folder: &Path) -> Option<Vec<String>> {
    let file = folder.join("cellZones");
    if !file.exists() {
        return (!folder.join("cellZones.gz").exists()).then(Vec::new);
    }
    let text = msdd_files::read_text(&file).ok().filter(|text| !is_binary(text.as_bytes()))?;
    let zones = patches_of_mesh(&file, &text)?;
    Some(zones.into_iter().map(|[name, _]| name).collect())
}

fn read_blocks(blocks: &Dictionary, is_plane: bool, mesh: &mut Mesh, found: &mut Findings) {
    mesh.bounds = crate::case::bounds(blocks).ok().map(|(low, high)| [low, high]);
    if let Some(corners) = crate::case::corners(blocks) {
        mesh.extent = Some(made::extent_of(&corners));
        mesh.axis = axis_of_wedge(blocks, &corners);
    }
    match blocks.value("blocks").map(joined) {
        Ok(text) => {
            let numbers = cells_in(&text);
            mesh.cells = (!numbers.is_empty()).then(|| numbers.iter().map(|[x, y, z]| x * y * z).sum());
            if let [[nx, ny, nz]] = numbers[..] {
                mesh.shape = (nz == 1).then_some([nx, ny]);
                if nz != 1 && is_plane {
                    let advice = "This model is two-dimensional: one cell in z, with patches of type empty in front and behind; the surrogate types spheres and constant take any mesh";
                    found.error(
                        [BLOCKS, "blocks"],
                        &format!("( {nx} {ny} {nz} )"),
                        "one cell along z",
                        advice,
                    );
                }
            }
        }
        Err(error) => found.refused(BLOCKS, error, ""),
    }
    mesh.patches = patches_of_blocks(blocks);
}

/// The numbers of cells in each `hex ( ... ) ( nx ny nz )`, also with the name of a zone in between.
fn cells_in(text: &str) -> Vec<[usize; 3]> {
    let after = |part: &str| {
        let (_, rest) = part.split_once(')')?;
        let (_, rest) = rest.split_once('(')?;
        let (numbers, _) = rest.split_once(')')?;
        let numbers: Option<Vec<usize>> = numbers.split_whitespace().map(|word| word.parse().ok()).collect();
        <[usize; 3]>::try_from(numbers?).ok()
    };
    text.split("hex").skip(1).filter_map(after).collect()
}

/// Names and types of the patches in `boundary ( name { type t; faces (...); } ... )`.
fn patches_of_blocks(blocks: &Dictionary) -> Vec<[String; 2]> {
    let Ok(tokens) = blocks.value("boundary") else { return Vec::new() };
    let words: Vec<&str> = tokens.iter().map(|token| token.text.as_str()).collect();
    patches_in(&words)
}

fn patches_in(words: &[&str]) -> Vec<[String; 2]> {
    let mut patches = Vec::new();
    for (k, pair) in words.windows(2).enumerate() {
        if pair[1] != "{" {
            continue;
        }
        let inside = &words[k + 2..];
        let end = inside.iter().position(|&word| word == "}").unwrap_or(inside.len());
        let kind = inside[..end].windows(2).find(|pair| pair[0] == "type").map_or("", |pair| pair[1]);
        patches.push([pair[0].to_string(), kind.to_string()]);
    }
    patches
}

/// Axis and normal of the first patch of type wedge, as OpenFOAM finds them: the middle plane is normal to the coordinate that is nearest
/// to the patch's normal, and the axis is at right angles to both.
fn axis_of_wedge(blocks: &Dictionary, corners: &[[f64; 3]]) -> Option<[usize; 2]> {
    let tokens = blocks.value("boundary").ok()?;
    let words: Vec<&str> = tokens.iter().map(|token| token.text.as_str()).collect();
    let wedge = words.windows(2).position(|pair| pair == ["type", "wedge"])?;
    let open = words[..wedge].iter().rposition(|&word| word == "{")?;
    let inside = &words[open..];
    let inside = &inside[..inside.iter().position(|&word| word == "}")?];
    let faces = inside.iter().position(|&word| word == "faces")?;
    let face = inside[faces..].iter().skip_while(|word| word.parse::<usize>().is_err());
    let face: Vec<[f64; 3]> =
        face.map_while(|word| word.parse::<usize>().ok()).map_while(|k| corners.get(k).copied()).collect();
    let mut normal = [0.0; 3];
    for (k, a) in face.iter().enumerate() {
        let b = face[(k + 1) % face.len()];
        for (i, part) in normal.iter_mut().enumerate() {
            let (j, l) = ((i + 1) % 3, (i + 2) % 3);
            *part += a[j] * b[l] - a[l] * b[j];
        }
    }
    let size = |k: &usize| normal[*k].abs();
    let mut order = [0, 1, 2];
    order.sort_by(|a, b| size(a).total_cmp(&size(b)));
    let [axis, side, across] = order;
    (size(&side) > 0.0 && size(&axis) <= 1e-6 * size(&side)).then_some([axis, across])
}

/// Patches of `constant/polyMesh/boundary`, a list with its length in front and no key.
fn patches_of_mesh(file: &Path, text: &str) -> Option<Vec<[String; 2]>> {
    let list = Dictionary::parse(file, &format!("list {};", made::list_of(text)?)).ok()?;
    let Some(Entry::Value(tokens)) = list.get("list") else { return None };
    let words: Vec<&str> = tokens.iter().map(|token| token.text.as_str()).collect();
    Some(patches_in(&words))
}

/// Number of cells, from `nCells:N` in the note of `constant/polyMesh/owner`.
fn cells_of_mesh(constant: &Path) -> Option<usize> {
    let text = msdd_files::read_text(&constant.join("polyMesh/owner")).ok()?;
    let (_, rest) = text.split_once("nCells:")?;
    rest.trim_start().split(|c: char| !c.is_ascii_digit()).next()?.parse().ok()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn blocks_and_patches_are_read() {
        let text = "vertices ( (0 0 0) (2 0 0) (2 1 0) (0 1 0) (0 0 1) (2 0 1) (2 1 1) (0 1 1) ); scale 0.1;
            blocks ( hex (0 1 2 3 4 5 6 7) (20 10 1) simpleGrading (1 1 1) );
            boundary ( left { type wall; faces ((0 4 7 3)); } front { type empty; faces ((0 3 2 1)); } );";
        let blocks = Dictionary::parse(Path::new(BLOCKS), text).unwrap();
        let mut found = Findings::default();
        let mesh = check(Path::new("no such folder"), Some(&blocks), true, &mut found);
        assert_eq!(found, Findings::default());
        assert_eq!(
            (mesh.cells, mesh.shape, mesh.names()),
            (Some(200), Some([20, 10]), vec!["left".into(), "front".into()])
        );
        assert_eq!(mesh.patches[1][1], "empty");
        let [x, y] = mesh.cell().unwrap();
        assert!((x - 0.01).abs() < 1e-12 && (y - 0.01).abs() < 1e-12);
        let deep =
            Dictionary::parse(Path::new(BLOCKS), &text.replace("(20 10 1)", "zone (20 10 3)")).unwrap();
        let any = check(Path::new("no such folder"), Some(&deep), false, &mut found);
        assert!(found == Findings::default() && any.cells == Some(600) && any.shape.is_none());
        check(Path::new("no such folder"), Some(&deep), true, &mut found);
        assert!(found.0[0].to_string().contains("( 20 10 3 ), allowed: one cell along z"), "{}", found.0[0]);
        check(Path::new("no such folder"), None, true, &mut found);
        assert!(found.0[1].to_string().starts_with("error: system/blockMeshDict: missing"), "{}", found.0[1]);
    }

    #[test]
    fn the_mesh_says_its_patches() {
        let text = "FoamFile { class polyBoundaryMesh; }\n2\n(\n left { type wall; inGroups 1(wall); nFaces 3; }\n back { type empty; }\n)\n// end";
        let patches = patches_of_mesh(Path::new("boundary"), text).unwrap();
        assert_eq!(patches, [["left", "wall"], ["back", "empty"]].map(|pair| pair.map(str::to_string)));
    }
}
