use super::super::blocks;
use super::*;
use std::path::Path;

const BOX: &str = "vertices ((0 0 0) (2 0 0) (2 1 0) (0 1 0) (0 0 1) (2 0 1) (2 1 1) (0 1 1));
    blocks (hex (0 1 2 3 4 5 6 7) (4 3 1) simpleGrading (1 1 1));
    boundary (left { type wall; faces ((0 4 7 3)); } right { type wall; faces ((1 2 6 5)); }
        bottom { type wall; faces ((0 1 5 4)); } top { type wall; faces ((3 7 6 2)); }
        front { type empty; faces ((0 3 2 1)); } back { type empty; faces ((4 5 6 7)); });";

fn mesh_of(text: &str) -> Mesh {
    let blocks = Dictionary::parse(Path::new("system/blockMeshDict"), text).unwrap();
    let mut mesh = Mesh::default();
    blocks::read(&blocks, false, &mut mesh, &mut Findings::default());
    mesh
}

fn lines(mesh: &str, walls: &str) -> Vec<String> {
    let text = format!("mechanics equilibrium; equilibriumCoeffs {{ law elastic; walls {{ {walls} }} }}");
    let properties = Dictionary::parse(Path::new(FILE), &text).unwrap();
    let mut found = Findings::default();
    check(&properties, &mesh_of(mesh), &mut found);
    found.0.iter().map(ToString::to_string).collect()
}

fn along(mesh: &str, walls: &str, direction: &str) {
    let wanted = format!(
        "error: constant/granularProperties: equilibriumCoeffs/walls = nothing against motion along ({direction}), allowed: a wall of type \
         rigid, frictionless, symmetry, displacement or shell that holds it. The bed can move as a whole that way, and the solver refuses it"
    );
    assert_eq!(lines(mesh, walls), [wanted], "{walls}");
}

const PRESSED: &str = "\".*\" { type pressure; pressure 10; }";

#[test]
fn a_bed_that_nothing_holds_is_found() {
    along(BOX, PRESSED, "1 0 0");
    along(BOX, &format!("{PRESSED} \"left|right\" {{ type frictionless; }}"), "0 1 0");
    along(BOX, &format!("{PRESSED} bottom {{ type rigid; }}"), "1 0 0");
    for good in [
        "\".*\" { type frictionless; }".to_string(),
        format!("{PRESSED} bottom {{ type rigid; friction 0.3; }}"),
        format!("{PRESSED} bottom {{ type displacement; displacement (0 0 0); }}"),
        format!("{PRESSED} bottom {{ type symmetry; }} left {{ type shell; }}"),
        "left { type pressure; }".to_string(),
        "left { type piston; }".to_string(),
    ] {
        assert_eq!(lines(BOX, &good), Vec::<String>::new(), "{good}");
    }
    let stays = Dictionary::parse(Path::new(FILE), &format!("equilibriumCoeffs {{ walls {{ {PRESSED} }} }}"))
        .unwrap();
    let mut found = Findings::default();
    check(&stays, &mesh_of(BOX), &mut found);
    assert!(found.0.is_empty());
}

#[test]
fn patches_that_are_no_walls_hold_along_their_normals() {
    // A bed that changes along x alone: its sides are empty, named or not
    let one = BOX
        .replace("(4 3 1)", "(4 1 1)")
        .replace("type wall; faces ((0 1", "type empty; faces ((0 1")
        .replace("type wall; faces ((3 7", "type empty; faces ((3 7");
    along(&one, PRESSED, "1 0 0");
    assert_eq!(lines(&one, &format!("{PRESSED} left {{ type frictionless; }}")), Vec::<String>::new());
    let bare = BOX.replace("top { type wall; faces ((3 7 6 2)); }", "");
    along(&bare, PRESSED, "1 0 0");
    assert_eq!(lines(&bare, &format!("{PRESSED} left {{ type frictionless; }}")), Vec::<String>::new());
    let mirrored = BOX.replace("top { type wall", "top { type symmetryPlane");
    along(&mirrored, PRESSED, "1 0 0");
    let solid = BOX.replace("type empty", "type wall");
    along(&solid, &format!("{PRESSED} \"left|top\" {{ type frictionless; }}"), "0 0 1");
}

#[test]
fn of_several_blocks_the_sides_between_them_do_not_count() {
    let two = "vertices ((0 0 0) (1 0 0) (1 1 0) (0 1 0) (0 0 1) (1 0 1) (1 1 1) (0 1 1) (0 0 3) (1 0 3) (1 1 3) (0 1 3));
        blocks (hex (0 1 2 3 4 5 6 7) (1 1 6) simpleGrading (1 1 1) hex (4 5 6 7 8 9 10 11) bulk (1 1 2) simpleGrading (1 1 1));
        boundary (floor { type wall; faces ((0 3 2 1)); } lid { type wall; faces ((8 9 10 11)); }
            sides { type wall; faces ((0 1 5 4) (1 2 6 5) (2 3 7 6) (3 0 4 7) (4 5 9 8) (5 6 10 9) (6 7 11 10) (7 4 8 11)); });";
    assert_eq!(mesh_of(two).sides.map(|sides| sides.len()), Some(10));
    let walls = "sides { type frictionless; } lid { type piston; }";
    along(two, &format!("{walls} floor {{ type pressure; }}"), "0 0 1");
    assert_eq!(lines(two, &format!("{walls} floor {{ type frictionless; }}")), Vec::<String>::new());
}

#[test]
fn a_wedge_is_held_along_its_axis_alone() {
    let wedge = "vertices ((0 0 0) (1 0 -0.1) (1 2 -0.1) (0 2 0) (1 0 0.1) (1 2 0.1));
        blocks (hex (0 1 2 3 0 4 5 3) (4 3 1) simpleGrading (1 1 1));
        boundary (axis { type empty; faces ((0 3 3 0)); } outer { type wall; faces ((1 2 5 4)); }
            floor { type wall; faces ((0 1 4 0)); } lid { type wall; faces ((3 3 5 2)); }
            front { type wedge; faces ((0 3 2 1)); } back { type wedge; faces ((0 4 5 3)); });";
    along(wedge, PRESSED, "0 1 0");
    along(wedge, &format!("{PRESSED} outer {{ type frictionless; }}"), "0 1 0");
    assert_eq!(lines(wedge, &format!("{PRESSED} floor {{ type frictionless; }}")), Vec::<String>::new());
}

#[test]
fn what_cannot_be_told_is_not_looked_at() {
    for more in ["edges (arc 0 1 (1 -0.1 0));", "mergePatchPairs ((left right));"] {
        assert_eq!(mesh_of(&format!("{BOX} {more}")).sides, None, "{more}");
    }
    assert_eq!(mesh_of(&BOX.replace("(0 4 7 3)", "(0 0)")).sides, None);
    assert!(mesh_of(&format!("{BOX} edges ();")).sides.is_some());
}
