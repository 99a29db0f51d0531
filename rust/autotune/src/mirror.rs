//! Boxes that are their own mirror images about a middle plane: of these, one half is enough.

use msdd_case::dictionary::{Dictionary, Entry, Token, joined};
use std::fmt::Write as _;
use std::path::Path;

/// Patches of the middle planes.
const MIDDLE: [&str; 2] = ["msddMiddleX", "msddMiddleY"];
/// Corners of each side of a block whose corners are numbered as in OpenFOAM's user guide: left and right, bottom and top.
const SIDES: [[[usize; 4]; 2]; 2] = [[[0, 3, 4, 7], [1, 2, 5, 6]], [[0, 1, 4, 5], [2, 3, 6, 7]]];
/// Fields whose images are themselves if they are uniform and have no xy component.
const FIELDS: [&str; 5] = ["T", "porosity", "fabricIndex", "stress", "conductivity"];
/// Conditions that are the same along a wall.
const CONDITIONS: [&str; 6] =
    ["fixedValue", "uniformFixedValue", "zeroGradient", "fixedGradient", "calculated", "granularWall"];
/// Function objects that say the same of a half as of the whole, once their points are those of the half.
const FUNCTIONS: [&str; 5] = ["probes", "spaceProbes", "wallPressure", "heatAudit", "massAudit"];
/// Fields with components that change their sign in a mirror.
const TURNED: [&str; 7] =
    ["D", "U", "nodeDisplacement", "nodeVelocity", "nodeVelocityBefore", "stress", "conductivity"];
/// A point on a middle plane is moved into the half by this share of the box, so that it lies in a cell.
const INSIDE: f64 = 1e-6;

/// A box that is its own mirror image about the middle plane along x, along y, or both.
#[derive(Clone, Debug, PartialEq)]
pub struct Mirror {
    pub along: [bool; 2],
    /// Highest corner of the box in `system/blockMeshDict`, and its entries `vertices` and `boundary`.
    corners: Vec<[f64; 3]>,
    boundary: Vec<String>,
    /// Function objects with points [m].
    probes: Vec<(String, Vec<[f64; 3]>)>,
}

/// Files of a case.
pub struct Files<'a> {
    pub mesh: &'a Dictionary,
    pub control: &'a Dictionary,
    pub grains: &'a Dictionary,
}

/// Whether a case has `fvOptions`, in either place where the solver looks for them.
fn sources(folder: &Path) -> bool {
    ["constant", "system"].iter().any(|part| folder.join(part).join("fvOptions").exists())
}

/// Gravity \[m/s²\] of the file `constant/g`; none without it. None if it cannot be read.
fn gravity(folder: &Path) -> Option<[f64; 3]> {
    let file = folder.join("constant/g");
    if !file.exists() {
        return Some([0.0; 3]);
    }
    vector(&Dictionary::expanded(&file).ok()?)
}

/// The entry `value` of a file of three numbers.
fn vector(file: &Dictionary) -> Option<[f64; 3]> {
    let tokens = file.value("value").ok()?;
    let numbers: Vec<f64> = tokens.iter().filter_map(|token| token.text.parse().ok()).collect();
    numbers.try_into().ok()
}

impl Mirror {
    /// Reads a case of one block; `start`: folder of its initial fields; `count`: its cells. None if nothing is known to mirror.
    pub fn read(folder: &Path, start: &str, count: [usize; 3], files: &Files) -> Option<Self> {
        let Files { mesh, control, grains } = files;
        // A bed at rest has its stress from the highest point of the mesh
        if sources(folder) || grains.get("restStress").is_some() {
            return None;
        }
        let gravity = gravity(folder)?;
        let (corners, boundary) = (corners(mesh)?, texts(mesh.value("boundary").ok()?));
        let probes = probes(control)?;
        let fields: Option<Vec<Dictionary>> =
            msdd_files::list(&folder.join(start)).ok()?.iter().map(|file| uniform(file)).collect();
        let fields = fields?;
        let mirrors = |k: usize| {
            let [Some(low), Some(high)] = SIDES[k].map(|side| patch(&boundary, side)) else { return false };
            let same = |field: &Dictionary| matches!(conditions(field, &low, &high), Some([a, b]) if a == b);
            count[k] > 1
                && gravity[k] == 0.0
                && count[k].is_multiple_of(2)
                && fields.iter().all(same)
                && walls(grains, &low, &high)
        };
        let along = [mirrors(0), mirrors(1)];
        // A wall that changes along its length is no image of itself.
        let even = SIDES.iter().flatten().all(|&side| {
            let of =
                |field| patch(&boundary, side).and_then(|name| conditions(field, &name, &name)).is_some();
            fields.iter().all(of)
        });
        (even && along.contains(&true)).then_some(Self { along, corners, boundary, probes })
    }

    /// Entries of `system/blockMeshDict` for the half that holds the lowest corner.
    pub fn mesh(&self, halved: [bool; 2]) -> String {
        let mut text = "vertices\n(\n".to_string();
        for corner in &self.corners {
            let mut corner = *corner;
            for k in (0..2).filter(|&k| halved[k]) {
                if corner[k] > self.corners[0][k] {
                    corner[k] = f64::midpoint(corner[k], self.corners[0][k]);
                }
            }
            let [x, y, z] = corner;
            let _ = writeln!(text, "    ({x} {y} {z})");
        }
        let mut boundary = self.boundary.clone();
        let mut middle = String::new();
        for k in (0..2).filter(|&k| halved[k]) {
            if let Some(at) = face(&boundary, SIDES[k][1]) {
                let corners = boundary[at + 1..at + 5].join(" ");
                boundary.drain(at..at + 6);
                let _ = writeln!(middle, "    {} {{ type symmetryPlane; faces (({corners})); }}", MIDDLE[k]);
            }
        }
        boundary.pop();
        let _ = write!(text, ");\nboundary\n{}\n{middle});\n", boundary.join(" "));
        text
    }

    /// Entries of an initial field for the half.
    pub fn field(halved: [bool; 2]) -> String {
        let planes = (0..2).filter(|&k| halved[k]);
        let entries: String =
            planes.map(|k| format!("    {} {{ type symmetryPlane; }}\n", MIDDLE[k])).collect();
        format!("boundaryField\n{{\n{entries}}}\n")
    }

    /// Entries of `system/controlDict` that move the points of function objects into the half. `bounds`: of the box \[m\].
    pub fn functions(&self, halved: [bool; 2], bounds: [[f64; 3]; 2]) -> String {
        let mut text = "functions\n{\n".to_string();
        for (name, points) in &self.probes {
            let points: Vec<String> = points
                .iter()
                .map(|&point| {
                    let [x, y, z] = inside(point, halved, bounds);
                    format!("({x} {y} {z})")
                })
                .collect();
            let _ = writeln!(text, "    {name} {{ probeLocations ({}); }}", points.join(" "));
        }
        text + "}\n"
    }
}

/// Whether a point lies in the half that is not run, along x and y. `bounds`: of the whole box.
pub fn beyond(point: [f64; 3], halved: [bool; 2], bounds: [[f64; 3]; 2]) -> [bool; 2] {
    [0, 1].map(|k| halved[k] && point[k] > f64::midpoint(bounds[0][k], bounds[1][k]))
}

/// The point, or its image, in the half that is run.
pub fn inside(mut point: [f64; 3], halved: [bool; 2], bounds: [[f64; 3]; 2]) -> [f64; 3] {
    for (k, beyond) in beyond(point, halved, bounds).into_iter().enumerate() {
        if beyond {
            point[k] = bounds[0][k] + bounds[1][k] - point[k];
        }
        if halved[k] {
            let middle = f64::midpoint(bounds[0][k], bounds[1][k]);
            point[k] = point[k].min(middle - INSIDE * (bounds[1][k] - bounds[0][k]));
        }
    }
    point
}

fn texts(tokens: &[Token]) -> Vec<String> {
    tokens.iter().map(|token| token.text.clone()).collect()
}

fn numbers(tokens: &[Token]) -> Vec<f64> {
    tokens.iter().filter_map(|token| token.text.parse().ok()).collect()
}

fn triples(tokens: &[Token]) -> Vec<[f64; 3]> {
    numbers(tokens).chunks_exact(3).map(|part| [part[0], part[1], part[2]]).collect()
}

/// The corners of a rectangular block with cells of one size, numbered as usual.
pub fn corners(mesh: &Dictionary) -> Option<Vec<[f64; 3]>> {
    let all = triples(mesh.value("vertices").ok()?);
    let block = texts(mesh.value("blocks").ok()?);
    let block: Vec<&str> = block.iter().map(String::as_str).filter(|word| !"()".contains(word)).collect();
    let usual = block.starts_with(&["hex", "0", "1", "2", "3", "4", "5", "6", "7"])
        && block.ends_with(&["simpleGrading", "1", "1", "1"]);
    let straight = ["edges", "mergePatchPairs", "defaultPatch", "faces"].iter().all(|key| {
        mesh.get(key).is_none() || mesh.value(key).is_ok_and(|tokens| joined(tokens).replace(' ', "") == "()")
    });
    if all.len() != 8 || !usual || !straight {
        return None;
    }
    let high = |k: usize, corner: usize| match k {
        0 => [1, 2, 5, 6].contains(&corner),
        1 => [2, 3, 6, 7].contains(&corner),
        _ => corner >= 4,
    };
    let (low, top) = (all[0], all[6]);
    let at = |corner: usize, k: usize| if high(k, corner) { top[k] } else { low[k] };
    let box_like = (0..8).all(|corner| (0..3).all(|k| all[corner][k] == at(corner, k)));
    (box_like && (0..3).all(|k| top[k] > low[k])).then_some(all)
}

/// Where in the entry `boundary` the face with these corners begins.
fn face(boundary: &[String], side: [usize; 4]) -> Option<usize> {
    let is = |words: &[String]| {
        let corners: Option<Vec<usize>> = words[1..5].iter().map(|word| word.parse().ok()).collect();
        let mut corners = corners.unwrap_or_default();
        corners.sort_unstable();
        words[0] == "(" && words[5] == ")" && corners == side
    };
    boundary.windows(6).position(is)
}

/// Name of the patch with this side: the word before the last brace that is opened before its face.
fn patch(boundary: &[String], side: [usize; 4]) -> Option<String> {
    let before = &boundary[..face(boundary, side)?];
    let open = before.iter().rposition(|word| word == "{")?;
    Some(before[open.checked_sub(1)?].clone())
}

/// Function objects with their points, if all are of kinds that say the same of a half.
fn probes(control: &Dictionary) -> Option<Vec<(String, Vec<[f64; 3]>)>> {
    let Ok(functions) = control.dictionary_at("functions") else { return Some(Vec::new()) };
    let mut all = Vec::new();
    for key in functions.keys() {
        let own = functions.dictionary_at(&key.text).ok()?;
        let kind = own.text("type").ok()?;
        let fields = ["fields", "field"].map(|key| own.value(key).map(texts).unwrap_or_default()).concat();
        if !FUNCTIONS.contains(&kind.as_str()) || fields.iter().any(|name| TURNED.contains(&name.as_str())) {
            return None;
        }
        if let Ok(points) = own.value("probeLocations") {
            all.push((key.text.clone(), triples(points)));
        }
    }
    Some(all)
}

/// A field, if it is uniform and its own image.
fn uniform(file: &Path) -> Option<Dictionary> {
    let name = file.file_name()?.to_str()?;
    let field = Dictionary::expanded(file).ok()?;
    let value = field.value("internalField").ok()?;
    let numbers = numbers(value);
    let no_xy = numbers.len() == 1 || (numbers.len() == 6 && numbers[1] == 0.0);
    (FIELDS.contains(&name) && value.first()?.text == "uniform" && no_xy).then_some(field)
}

/// The conditions of a field at two patches, as text, if they are the same along each.
fn conditions(field: &Dictionary, low: &str, high: &str) -> Option<[String; 2]> {
    let boundary = field.dictionary_at("boundaryField").ok()?;
    let of = |name: &str| {
        let Entry::Dictionary(own) = boundary.matching(name)? else { return None };
        let text = text(own);
        let known = CONDITIONS.contains(&own.text("type").ok()?.as_str());
        (known && !text.contains("nonuniform")).then_some(text)
    };
    Some([of(low)?, of(high)?])
}

/// Whether two walls hold the grains equally; walls that move are left out.
fn walls(grains: &Dictionary, low: &str, high: &str) -> bool {
    let Ok(equilibrium) = grains.dictionary_at("equilibriumCoeffs") else { return true };
    let Ok(walls) = equilibrium.dictionary_at("walls") else { return true };
    let of = |name: &str| match walls.matching(name) {
        Some(Entry::Dictionary(own)) => text(own),
        _ => String::new(),
    };
    of(low) == of(high) && !text(walls).contains("displacement")
}

/// A dictionary as text.
fn text(dictionary: &Dictionary) -> String {
    let mut all = String::new();
    for key in dictionary.keys() {
        let value = match dictionary.get_any(&key.text) {
            Some(Entry::Value(tokens)) => joined(tokens),
            Some(Entry::Dictionary(own)) => format!("{{{}}}", text(own)),
            None => String::new(),
        };
        let _ = write!(all, "{} {value}; ", key.text);
    }
    all
}

#[cfg(test)]
mod tests {
    use super::*;

    const MESH: &str = "vertices ((0 0 0) (2 0 0) (2 1 0) (0 1 0) (0 0 1) (2 0 1) (2 1 1) (0 1 1));
        blocks (hex (0 1 2 3 4 5 6 7) (20 10 1) simpleGrading (1 1 1));
        boundary (ends { type wall; faces ((0 4 7 3) (1 2 6 5)); } bottom { type wall; faces ((0 1 5 4)); }
            top { type wall; faces ((3 7 6 2)); } sides { type empty; faces ((0 3 2 1) (4 5 6 7)); });";

    fn parse(text: &str) -> Dictionary {
        Dictionary::parse(Path::new("x"), text).unwrap()
    }

    fn mirror() -> Mirror {
        let mesh = parse(MESH);
        let boundary = texts(mesh.value("boundary").unwrap());
        let probes = vec![("probes".to_string(), vec![[1.75, 0.25, 0.5], [1.0, 0.5, 0.5]])];
        Mirror { along: [true; 2], corners: corners(&mesh).unwrap(), boundary, probes }
    }

    #[test]
    fn sources_are_found_in_both_places() {
        let folder = std::env::temp_dir().join(format!("msdd-autotune-sources-{}", std::process::id()));
        for part in ["constant", "system"] {
            std::fs::create_dir_all(folder.join(part)).unwrap();
            assert!(!sources(&folder));
            std::fs::write(folder.join(part).join("fvOptions"), "").unwrap();
            assert!(sources(&folder), "{part}");
            std::fs::remove_file(folder.join(part).join("fvOptions")).unwrap();
        }
        std::fs::remove_dir_all(&folder).unwrap();
    }

    #[test]
    fn gravity_is_read() {
        let file = parse("dimensions [0 1 -2 0 0 0 0]; value (0 -9.81 0);");
        assert_eq!(vector(&file), Some([0.0, -9.81, 0.0]));
        assert_eq!(vector(&parse("value (down);")), None);
        assert_eq!(gravity(Path::new("no such folder")), Some([0.0; 3]));
    }

    #[test]
    fn the_half_has_half_the_box_and_a_plane_of_symmetry() {
        let quarter = parse(&mirror().mesh([true, true]));
        assert_eq!(triples(quarter.value("vertices").unwrap())[6], [1.0, 0.5, 1.0]);
        let boundary = texts(quarter.value("boundary").unwrap());
        let patches = SIDES.map(|sides| sides.map(|side| patch(&boundary, side).unwrap()));
        assert_eq!(patches, [["ends", "msddMiddleX"], ["bottom", "msddMiddleY"]]);
        let half = texts(parse(&mirror().mesh([false, true])).value("boundary").unwrap());
        assert_eq!(patch(&half, SIDES[0][1]).unwrap(), "ends");
        assert_eq!(patch(&half, SIDES[1][1]).unwrap(), "msddMiddleY");
    }

    #[test]
    fn points_are_moved_into_the_half() {
        let bounds = [[0.0; 3], [2.0, 1.0, 1.0]];
        assert_eq!(inside([1.75, 0.25, 0.5], [true, false], bounds), [0.25, 0.25, 0.5]);
        assert_eq!(beyond([1.75, 0.75, 0.5], [true, false], bounds), [true, false]);
        let [x, y, _] = inside([1.0, 0.5, 0.5], [true, false], bounds);
        assert!(x < 1.0 && x > 0.999 && y == 0.5);
        assert!(mirror().functions([true, false], bounds).contains("(0.25 0.25 0.5)"));
    }

    #[test]
    fn other_boxes_do_not_mirror() {
        let changed = |from: &str, to: &str| corners(&parse(&MESH.replace(from, to)));
        assert!(changed("", "").is_some());
        assert!(changed("simpleGrading (1 1 1)", "simpleGrading (2 1 1)").is_none());
        assert!(changed("(2 1 0)", "(2.1 1 0)").is_none());
        assert!(changed("0 1 2 3 4 5 6 7", "1 2 3 0 5 6 7 4").is_none());
    }

    #[test]
    fn walls_and_function_objects_that_do_not_mirror() {
        let field = parse(
            "boundaryField { \"left|right\" { type fixedValue; value uniform 3; } top { type zeroGradient; } }",
        );
        let same = |a: &str, b: &str| matches!(conditions(&field, a, b), Some([one, other]) if one == other);
        assert!(same("left", "right") && !same("left", "top") && !same("left", "bottom"));
        let held =
            |text: &str| walls(&parse(&format!("equilibriumCoeffs {{ walls {{ {text} }} }}")), "a", "b");
        assert!(held("") && held("c { type rigid; }") && held("\"a|b\" { type frictionless; }"));
        assert!(
            !held("a { type frictionless; }")
                && !held("\"a|b\" { type rigid; displacement constant (1 0 0); }")
        );
        let seen = |text: &str| probes(&parse(&format!("functions {{ {text} }}"))).is_some();
        assert!(seen("") && seen("p { type probes; fields (T); probeLocations ((0 0 0)); }"));
        assert!(!seen("p { type probes; fields (T D); }") && !seen("s { type surfaces; }"));
    }
}
