//! Checks that the walls hold a bed whose grains move, as far as the mesh of `system/blockMeshDict` says.

use super::domain::{Kind, Mesh, Side};
use super::finding::Findings;
use super::grains::FILE;
use super::keys;
use crate::dictionary::{Dictionary, Entry, Token};
use msdd_rve::message::number;
use std::collections::BTreeMap;

type Vector = [f64; 3];

/// Corners of the six sides of a block.
const SIDES: [[usize; 4]; 6] =
    [[0, 4, 7, 3], [1, 2, 6, 5], [0, 1, 5, 4], [3, 7, 6, 2], [0, 3, 2, 1], [4, 5, 6, 7]];
/// Sine of an angle below which directions are the same; the solver's bound is higher.
const PARALLEL: f64 = 1e-9;

/// The plane sides of all blocks that lie outside, with their patches; none where they cannot be told: for curved edges, merged patches or
/// faces that are given in another form.
pub fn sides(blocks: &Dictionary, corners: &[Vector]) -> Option<Vec<Side>> {
    let has = |key: &str| blocks.value(key).is_ok_and(|tokens| tokens.len() > 2);
    if ["edges", "faces", "mergePatchPairs"].into_iter().any(has) {
        return None;
    }
    let mut outside = BTreeMap::<Vec<usize>, bool>::new();
    for block in blocks.value("blocks").ok()?.split(|token| token.text == "hex").skip(1) {
        let block: [usize; 8] = lists(block).first()?.clone().try_into().ok()?;
        for side in SIDES {
            let once = outside.entry(sorted(&side.map(|k| block[k]))).or_insert(false);
            *once = !*once;
        }
    }
    outside.retain(|_, once| *once);
    let mut sides = Vec::new();
    for (name, faces) in patches(blocks.value("boundary").ok()?) {
        for face in faces {
            outside.remove(&sorted(&face))?;
            sides.push((Some(name.clone()), face));
        }
    }
    // What no patch names becomes a patch of type empty; the order of the corners is lost, but for a side that is plane it is enough
    sides.extend(outside.into_keys().map(|face| (None, face)));
    let points = |face: &[usize]| face.iter().map(|&k| corners.get(k).copied()).collect::<Option<Vec<_>>>();
    let mut result = Vec::new();
    for (patch, face) in sides {
        if let Some(normal) = normal(&points(&face)?) {
            result.push(Side { patch, normal });
        }
    }
    Some(result)
}

fn sorted(face: &[usize]) -> Vec<usize> {
    let mut face = face.to_vec();
    face.sort_unstable();
    face.dedup();
    face
}

/// The innermost lists of whole numbers.
fn lists(tokens: &[Token]) -> Vec<Vec<usize>> {
    let parts = tokens.split(|token| token.text == "(" || token.text == ")");
    parts
        .filter_map(|part| part.iter().map(|token| token.text.parse().ok()).collect::<Option<Vec<_>>>())
        .filter(|list| !list.is_empty())
        .collect()
}

/// Names and faces of the patches in `( name { type t; faces (...); } ... )`.
fn patches(tokens: &[Token]) -> Vec<(String, Vec<Vec<usize>>)> {
    let mut all = Vec::new();
    for (k, pair) in tokens.windows(2).enumerate() {
        if pair[1].text == "{" {
            let inside = tokens[k + 2..].split(|token| token.text == "}").next().unwrap_or_default();
            let faces = inside.iter().position(|token| token.text == "faces").unwrap_or(inside.len());
            let faces = inside[faces..].split(|token| token.text == ";").next().unwrap_or_default();
            all.push((pair[0].text.clone(), lists(faces)));
        }
    }
    all
}

/// Unit normal of a side; none if it has no area.
fn normal(points: &[Vector]) -> Option<Vector> {
    let [first, rest @ ..] = points else { return None };
    let to = |point: &Vector| -> Vector { std::array::from_fn(|k| point[k] - first[k]) };
    let crosses = rest.windows(2).map(|pair| cross(&to(&pair[0]), &to(&pair[1])));
    let longest = crosses.max_by(|a, b| length(a).total_cmp(&length(b)))?;
    let size = rest.iter().map(|point| length(&to(point))).fold(0.0, f64::max);
    (length(&longest) > 1e-9 * size * size).then(|| longest.map(|x| x / length(&longest)))
}

fn cross(a: &Vector, b: &Vector) -> Vector {
    std::array::from_fn(|k| {
        let (i, j) = ((k + 1) % 3, (k + 2) % 3);
        a[i] * b[j] - a[j] * b[i]
    })
}

fn length(v: &Vector) -> f64 {
    v.iter().map(|x| x * x).sum::<f64>().sqrt()
}

/// What a wall holds of the bed.
enum Hold {
    Nothing,
    /// Against motion along its normal.
    Normal,
    /// Against all, or not known.
    All,
}

/// Finds a bed that can move as a whole along a straight line, which the solver refuses. Whether it can turn is not looked at.
pub fn check(properties: &Dictionary, mesh: &Mesh, found: &mut Findings) {
    let Some(sides) = &mesh.sides else { return };
    if !properties.text("mechanics").is_ok_and(|kind| kind == "equilibrium") {
        return;
    }
    let settings = properties.dictionary_at("equilibriumCoeffs").ok();
    let elastic = settings.is_some_and(|own| own.text("law").is_ok_and(|law| law == "elastic"));
    let walls = settings.and_then(|own| own.dictionary_at("walls").ok());
    // Directions in which nothing is asked: that of one layer, and those that a wedge turns in
    let mut held: Vec<Vector> = match (mesh.kind(), mesh.axis) {
        (Kind::Plane, _) => vec![[0.0, 0.0, 1.0]],
        (Kind::Solid, _) => Vec::new(),
        (Kind::Wedge, Some([axis, _])) => (0..3)
            .filter(|&k| k != axis)
            .map(|k| std::array::from_fn(|i| f64::from(u8::from(i == k))))
            .collect(),
        _ => return,
    };
    for side in sides {
        let kind = match &side.patch {
            None => "empty",
            Some(patch) => match mesh.patches.iter().find(|[name, _]| name == patch) {
                Some([_, kind]) => kind.as_str(),
                None => return,
            },
        };
        let hold = match (kind, &side.patch) {
            ("wedge", _) => Hold::Nothing,
            ("empty" | "symmetry" | "symmetryPlane", _) => Hold::Normal,
            (_, Some(patch)) => match walls.and_then(|walls| walls.matching(patch)) {
                Some(Entry::Dictionary(wall)) => hold_of(wall, elastic),
                _ => Hold::All,
            },
            _ => Hold::All,
        };
        match hold {
            Hold::Nothing => {}
            Hold::Normal => add(&mut held, side.normal),
            Hold::All => return,
        }
    }
    if held.len() < 3 {
        let free = free_of(&held).map(|x| number((1e6 * x).round() / 1e6)).join(" ");
        let allowed = "a wall of type rigid, frictionless, symmetry, displacement or shell that holds it";
        let advice = "The bed can move as a whole that way, and the solver refuses it";
        found.error(
            [FILE, "equilibriumCoeffs/walls"],
            &format!("nothing against motion along ({free})"),
            allowed,
            advice,
        );
    }
}

fn hold_of(wall: &Dictionary, elastic: bool) -> Hold {
    let kind = wall.text("type").unwrap_or_else(|_| "rigid".to_string());
    // Friction of a model that knows it by itself holds, too
    let usual = if elastic { Some(0.0) } else { None };
    let friction = if wall.get("friction").is_some() { keys::number(wall, "friction", "") } else { usual };
    match kind.as_str() {
        "pressure" | "piston" => Hold::Nothing,
        "frictionless" | "symmetry" | "shell" => Hold::Normal,
        "rigid" if friction == Some(0.0) => Hold::Normal,
        _ => Hold::All,
    }
}

/// What is left of a vector at right angles to some that are at right angles to each other.
fn across(held: &[Vector], mut v: Vector) -> Vector {
    for n in held {
        let along: f64 = (0..3).map(|k| n[k] * v[k]).sum();
        (0..3).for_each(|k| v[k] -= along * n[k]);
    }
    v
}

fn add(held: &mut Vec<Vector>, normal: Vector) {
    let rest = across(held, normal);
    let size = length(&rest);
    if size > PARALLEL {
        held.push(rest.map(|x| x / size));
    }
}

/// A direction that none of these holds.
fn free_of(held: &[Vector]) -> Vector {
    let axes = [0, 1, 2].map(|k| across(held, std::array::from_fn(|i| f64::from(u8::from(i == k)))));
    let longest = axes.into_iter().rev().max_by(|a, b| length(a).total_cmp(&length(b))).unwrap_or_default();
    longest.map(|x| x / length(&longest))
}

#[cfg(test)]
#[path = "held_tests.rs"]
mod tests;
