//! Checks the mesh: that in `constant/polyMesh` when it is there, else the one that `system/blockMeshDict` describes.

use super::domain::{BLOCKS, Kind, Mesh, Patch, patches_in};
use super::finding::Findings;
use super::{blocks, made};
use crate::binary;
use crate::dictionary::{Dictionary, Entry};
use std::path::Path;

/// Checks the mesh and returns what is known of it; `constant` is the folder that holds `polyMesh`, `blocks` is
/// `system/blockMeshDict`; `is_plane`: whether the case's model knows the plane alone.
pub fn check(constant: &Path, blocks: Option<&Dictionary>, is_plane: bool, found: &mut Findings) -> Mesh {
    let mut mesh = Mesh::default();
    if let Some(blocks) = blocks {
        blocks::read(blocks, is_plane, &mut mesh, found);
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
            // It is another mesh, or was turned after blockMesh
            mesh.bounds = None;
            mesh.axis = None;
            mesh.sides = None;
        }
        mesh.extent = extent.or(mesh.extent);
        mesh.zones = zones_of_mesh(&folder);
        mesh.sets = Some(sets_of_mesh(&folder));
        match patches_of_mesh(&boundary, &text) {
            Some(patches) => mesh.take(patches),
            None => found.error(["constant/polyMesh/boundary", ""], "no list of patches", "", made::AGAIN),
        }
        let old = mesh.cells;
        mesh.cells = cells_of_mesh(&folder);
        if mesh.cells != old {
            mesh.shape = None;
            mesh.sides = None;
        }
        if let (Some(wanted), Some(made)) = (old, mesh.cells)
            && wanted != made
        {
            let advice = "The mesh in constant/polyMesh is that of the run. If blockMesh alone makes it, it is older than this file: \
                          Allrun makes it again, or run blockMesh; if snappyHexMesh or another program makes it, this may be meant";
            found.doubt([BLOCKS, "blocks"], &format!("{wanted} cells, but the mesh has {made}"), "", advice);
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
    let text = msdd_files::read_text(&file).ok().filter(|text| !binary::is_binary(text.as_bytes()))?;
    let zones = patches_of_mesh(&file, &text)?;
    Some(zones.into_iter().map(|zone| zone.name).collect())
}

/// Names of the sets of cells and faces, which may be packed.
fn sets_of_mesh(folder: &Path) -> Vec<String> {
    let files = std::fs::read_dir(folder.join("sets")).into_iter().flatten().flatten();
    let names = files.filter_map(|file| file.file_name().into_string().ok());
    names.map(|name| name.trim_end_matches(".gz").to_string()).collect()
}

/// Patches of `constant/polyMesh/boundary`, a list with its length in front and no key.
fn patches_of_mesh(file: &Path, text: &str) -> Option<Vec<Patch>> {
    let list = Dictionary::parse(file, &format!("list {};", made::list_of(text)?)).ok()?;
    let Some(Entry::Value(tokens)) = list.get("list") else { return None };
    let words: Vec<&str> = tokens.iter().map(|token| token.text.as_str()).collect();
    Some(patches_in(&words))
}

/// Number of cells, from `nCells:N` in the note of `owner`; without that note, from the largest number of a cell there and in
/// `neighbour`.
fn cells_of_mesh(folder: &Path) -> Option<usize> {
    let owner = binary::read(&folder.join("owner"))?;
    if let Some((_, rest)) = binary::head(&owner).split_once("nCells:") {
        return rest.trim_start().split(|c: char| !c.is_ascii_digit()).next()?.parse().ok();
    }
    let mut most = None;
    for file in [owner, binary::read(&folder.join("neighbour"))?] {
        let text = String::from_utf8(file).ok().filter(|text| !binary::is_binary(text.as_bytes()))?;
        let list = made::list_of(&text)?.trim_matches(['(', ')']);
        for word in list.split_whitespace() {
            most = most.max(Some(word.parse::<usize>().ok()?));
        }
    }
    most.map(|cell| cell + 1)
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
        let named =
            Dictionary::parse(Path::new(BLOCKS), &text.replace("(20 10 1)", "hexZone (20 10 1)")).unwrap();
        let named = check(Path::new("no such folder"), Some(&named), true, &mut found);
        assert!(found == Findings::default() && named.cells == Some(200), "{:?}", named.cells);
        check(Path::new("no such folder"), Some(&deep), true, &mut found);
        assert!(found.0[0].to_string().contains("( 20 10 3 ), allowed: one cell along z"), "{}", found.0[0]);
        check(Path::new("no such folder"), None, true, &mut found);
        assert!(found.0[1].to_string().starts_with("error: system/blockMeshDict: missing"), "{}", found.0[1]);
    }

    #[test]
    fn the_mesh_says_its_patches() {
        let text = "FoamFile { class polyBoundaryMesh; }\n2\n(\n left { type wall; inGroups 1(wall); nFaces 3; }\n back { type empty; }\n)\n// end";
        let patches = patches_of_mesh(Path::new("boundary"), text).unwrap();
        let mut mesh = Mesh::default();
        mesh.take(patches);
        assert_eq!(mesh.patches, [["left", "wall"], ["back", "empty"]].map(|pair| pair.map(str::to_string)));
        assert_eq!(mesh.kind(), Kind::Plane);
        // An axis of a body in three dimensions
        let bare = text.replace("type empty;", "type empty; nFaces 0;");
        mesh.take(patches_of_mesh(Path::new("boundary"), &bare).unwrap());
        assert_eq!(mesh.kind(), Kind::Solid);
    }

    #[test]
    fn conditions_are_given_by_name_then_by_group_then_by_pattern() {
        let text = "FoamFile { } 2 ( left { type wall; inGroups 2(hot wall); } right { type wall; inGroups 1(wall); } )";
        let mut mesh = Mesh::default();
        mesh.take(patches_of_mesh(Path::new("boundary"), text).unwrap());
        let of = |conditions: &str, patch: &str| {
            let field = Dictionary::parse(Path::new("0/T"), conditions).unwrap();
            match mesh.condition(&field, patch) {
                Some(Entry::Dictionary(one)) => one.text("k").unwrap(),
                _ => "none".to_string(),
            }
        };
        let all = "hot { k 1; } wall { k 2; } right { k 3; } \".*\" { k 4; }";
        assert_eq!([of(all, "left"), of(all, "right"), of(all, "top")], ["2", "3", "4"]);
        assert_eq!([of("hot { k 1; }", "left"), of("hot { k 1; }", "right")], ["1", "none"]);
    }

    #[test]
    fn cells_are_counted_where_no_note_says_their_number() {
        let folder = std::env::temp_dir().join(format!("msdd-cells-{}", std::process::id()));
        std::fs::create_dir_all(&folder).unwrap();
        let head = "FoamFile { format ascii; class labelList; }\n";
        std::fs::write(folder.join("owner"), format!("{head}4\n(\n0\n0\n1\n2\n)\n// ***")).unwrap();
        std::fs::write(folder.join("neighbour"), format!("{head}2(1 3)")).unwrap();
        assert_eq!(cells_of_mesh(&folder), Some(4));
        let noted = head.replace("class", "note \"nPoints:9  nCells:7 nFaces:2\"; class");
        std::fs::write(folder.join("owner"), format!("{noted}1(0)")).unwrap();
        assert_eq!(cells_of_mesh(&folder), Some(7));
        std::fs::remove_dir_all(&folder).unwrap();
    }
}
