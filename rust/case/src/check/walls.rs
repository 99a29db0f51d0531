//! Checks what walls against which grains move can be given, and the meshes in which they move.

use super::control::Times;
use super::domain::{BLOCKS, Kind, Mesh};
use super::finding::Findings;
use super::grains::FILE;
use super::{keys, tables};
use crate::dictionary::{Dictionary, Entry, joined};
use msdd_rve::message::number;

/// Types of patches that need no entry in `walls`.
pub const NO_WALLS: [&str; 6] = ["empty", "wedge", "symmetry", "symmetryPlane", "processor", "cyclic"];
/// Keys that concern friction, which walls of type rigid have.
const FRICTION: [&str; 4] = ["friction", "slip", "layer", "layerStrength"];

/// Checks a bed whose grains move.
pub fn check(properties: &Dictionary, mesh: &Mesh, found: &mut Findings) {
    if !properties.text("mechanics").is_ok_and(|kind| kind == "equilibrium") {
        return;
    }
    if let (Kind::Wedge, Some([axis, normal])) = (mesh.kind(), mesh.axis)
        && (axis == 2 || normal != 2)
    {
        let value = format!("wedges about the axis {}, normal {}", name(axis), name(normal));
        let advice = "Turn the mesh, by transformPoints for example";
        found.error(
            [BLOCKS, "boundary"],
            &value,
            "axis x or y, normal z, with mechanics equilibrium",
            advice,
        );
    }
    let coupled: Vec<&str> = mesh
        .patches
        .iter()
        .filter(|[_, kind]| kind.starts_with("cyclic"))
        .map(|[name, _]| name.as_str())
        .collect();
    if !coupled.is_empty() {
        let allowed = format!("none with patches of type cyclic, here {}", coupled.join(", "));
        found.error([FILE, "mechanics"], "equilibrium", &allowed, "");
    }
    let settings = properties.dictionary_at("equilibriumCoeffs").ok();
    let elastic = settings.is_some_and(|own| own.text("law").is_ok_and(|law| law == "elastic"));
    let walls = settings.and_then(|own| own.dictionary_at("walls").ok());
    for [patch, _] in mesh.patches.iter().filter(|[_, kind]| !NO_WALLS.contains(&kind.as_str())) {
        let place = format!("equilibriumCoeffs/walls/{patch}");
        match walls.and_then(|walls| walls.matching(patch)) {
            Some(Entry::Dictionary(wall)) => {
                check_friction(wall, elastic, found);
            }
            None if elastic => {
                let allowed = "a dictionary with the wall's type";
                found.error([FILE, &place], "missing", allowed, "Law elastic needs a rule for each wall");
            }
            _ => {}
        }
    }
}

/// Doubts walls that pull: grains bear no tension.
pub fn check_pressures(properties: &Dictionary, times: Option<Times>, found: &mut Findings) {
    let walls = properties.dictionary_at("equilibriumCoeffs").and_then(|own| own.dictionary_at("walls"));
    let Ok(walls) = walls else { return };
    let times = times.map(|times| [times.start, times.start + times.end]);
    for key in walls.keys() {
        let Some(Entry::Dictionary(wall)) = walls.get_any(&key.text) else { continue };
        if !wall.text("type").is_ok_and(|kind| ["pressure", "piston"].contains(&kind.as_str())) {
            continue;
        }
        let values = tables::values(wall, "pressure", times).unwrap_or_default();
        if let Some(value) = values.into_iter().find(|&value| value < 0.0) {
            let advice = "A wall that pulls: grains bear no tension";
            let value = format!("{} Pa", number(value));
            found.doubt([FILE, &wall.path_of("pressure")], &value, "0 Pa and more", advice);
        }
    }
}

fn name(axis: usize) -> &'static str {
    ["x", "y", "z"][axis]
}

fn check_friction(wall: &Dictionary, elastic: bool, found: &mut Findings) {
    let kind = wall.text("type").unwrap_or_else(|_| "rigid".to_string());
    if kind != "rigid" {
        for key in FRICTION.iter().filter(|key| wall.get(key).is_some()) {
            let value = wall.value(key).map(joined).unwrap_or_default();
            let advice = format!("The wall is of type {kind}");
            once([FILE, &wall.path_of(key)], &value, &advice, found);
        }
        return;
    }
    let place = wall.path_of("slip");
    if elastic
        && keys::number(wall, "friction", "").is_some()
        && wall.get("slip").is_none()
        && !found.0.iter().any(|finding| finding.key == place)
    {
        found.error([FILE, &place], "missing", "a way [m], beside friction", "");
    }
}

/// A pattern may stand for several patches, and is reported once.
fn once(place: [&str; 2], value: &str, advice: &str, found: &mut Findings) {
    if !found.0.iter().any(|finding| finding.key == place[1] && finding.advice == advice) {
        found.error(place, value, "in walls of type rigid", advice);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::path::Path;

    fn lines(walls: &str, sides: &str, axis: Option<[usize; 2]>) -> Vec<String> {
        let text = format!("mechanics equilibrium; equilibriumCoeffs {{ {walls} }}");
        let properties = Dictionary::parse(Path::new(FILE), &text).unwrap();
        let patches = [["left", "wall"], ["right", "wall"], ["sides", sides]];
        let patches = patches.map(|pair| pair.map(str::to_string)).to_vec();
        let mut found = Findings::default();
        check(&properties, &Mesh { patches, axis, ..Mesh::default() }, &mut found);
        found.0.iter().map(ToString::to_string).collect()
    }

    #[test]
    fn friction_that_the_solver_refuses_is_found() {
        let rigid = "walls { \".*\" { friction 0.3; slip 1e-6; } }";
        for sides in ["empty", "wall"] {
            assert_eq!(lines(rigid, sides, None), Vec::<String>::new());
        }
        assert_eq!(
            lines("walls { \"l.*|right\" { type frictionless; friction 0.3; } }", "empty", None),
            [
                "error: constant/granularProperties: equilibriumCoeffs/walls/l.*|right/friction = 0.3, allowed: in walls of type rigid. The wall is of type frictionless"
            ]
        );
        let elastic = lines("law elastic; walls { left { friction 0.3; } }", "empty", None);
        assert!(
            elastic[0].contains("walls/left/slip = missing") && elastic[1].contains("walls/right = missing")
        );
    }

    #[test]
    fn friction_without_slip_is_one_error_in_the_plane_and_in_space() {
        for (sides, friction) in [("empty", "0.3"), ("wall", "0.3"), ("wall", "0")] {
            let walls = |slip| format!("law elastic; walls {{ \".*\" {{ friction {friction}; {slip} }} }}");
            let found = lines(&walls(""), sides, None);
            assert!(found.len() == 1 && found[0].contains("slip = missing"), "{found:?}");
            assert_eq!(lines(&walls("slip 1e-6;"), sides, None), Vec::<String>::new());
        }
    }

    #[test]
    fn grains_do_not_move_through_cyclic_patches() {
        assert_eq!(
            lines("", "cyclic", None),
            [
                "error: constant/granularProperties: mechanics = equilibrium, allowed: none with patches of type cyclic, here sides"
            ]
        );
    }

    #[test]
    fn walls_that_pull_are_doubted() {
        let lines = |kind: &str, pressure: &str| {
            let text = format!(
                "equilibriumCoeffs {{ walls {{ \"t.*\" {{ type {kind}; pressure {pressure}; }} }} }}"
            );
            let mut found = Findings::default();
            check_pressures(&Dictionary::parse(Path::new(FILE), &text).unwrap(), None, &mut found);
            found.0.iter().map(ToString::to_string).collect::<Vec<_>>()
        };
        assert_eq!(lines("pressure", "constant 0"), Vec::<String>::new());
        for (kind, pulls) in
            [("pressure", "constant -5"), ("pressure", "table ((0 100) (10 -5))"), ("piston", "constant -5")]
        {
            assert_eq!(
                lines(kind, pulls),
                [
                    "doubt: constant/granularProperties: equilibriumCoeffs/walls/t.*/pressure = -5 Pa, allowed: 0 Pa and more. A wall \
                     that pulls: grains bear no tension"
                ]
            );
        }
    }

    #[test]
    fn wedges_lie_about_x_or_y() {
        assert_eq!(lines("", "wedge", Some([1, 2])), Vec::<String>::new());
        assert!(lines("", "wedge", Some([2, 1]))[0].starts_with(
            "error: system/blockMeshDict: boundary = wedges about the axis z, normal y, allowed: axis x or y, normal z"
        ));
    }
}
