//! Checks beds that bear their own weight: where the solver knows gravity, and the stress at the start.

use super::domain::{Kind, Mesh};
use super::fields::Values;
use super::finding::Findings;
use super::{gravity, keys};
use crate::dictionary::{Dictionary, Entry};
use crate::numbers::rounded;
use msdd_rve::message::number;

/// Share of the weight of the bed below which no stress at the start is meant: friction at walls bears a part of it, but hardly more.
const LEAST: f64 = 0.01;
/// Share of gravity that may point to where nothing moves, as in the solver.
const ROUND_OFF: f64 = 1e-9;
/// The same of what is inclined beyond doubt.
const INCLINED: f64 = 1e-3;

/// Checks beds whose grains move; others do not know gravity. `fields`: porosity and stress at the start.
pub fn check(
    properties: &Dictionary,
    gravity: &Dictionary,
    mesh: &Mesh,
    [porosity, stress]: [Option<&Values>; 2],
    found: &mut Findings,
) {
    let moves = properties.text("mechanics").is_ok_and(|kind| kind == "equilibrium");
    let Some(g) = vector(gravity).filter(|g| moves && length(g) > 0.0) else { return };
    check_direction(&g, mesh, found);
    check_upright(&g, properties, mesh, found);
    let elastic = properties
        .dictionary_at("equilibriumCoeffs")
        .is_ok_and(|own| own.text("law").is_ok_and(|law| law == "elastic"));
    let (Some(porosity), Some(stress), false) = (porosity, stress, elastic) else { return };
    let (Some(density), Some([low, high])) = (keys::number(properties, "density", DENSITY), mesh.extent)
    else {
        return;
    };
    // rho g h
    let weight =
        (0..3).map(|k| g[k].abs() * (high[k] - low[k])).sum::<f64>() * density * (1.0 - porosity.mean(0));
    let most = stress.numbers.iter().flat_map(|s| [s[0], s[3], s[5]]).map(f64::abs).fold(0.0, f64::max);
    if most < LEAST * weight {
        let value = format!("at most {} Pa", number(rounded(most, 3)));
        let allowed =
            format!("about the weight of the bed, {} Pa at its lowest point", number(rounded(weight, 3)));
        let advice = "Grains that hardly touch have to be pressed together first, in thousands of short steps. Is the stress in \
                      Pa, not in kPa? restStress in constant/granularProperties finds it from the weight, without what friction at \
                      walls bears; a tall bed between rough walls should begin with a few hundredths of its weight";
        found.doubt(["0/stress", "internalField"], &value, &allowed, advice);
    }
}

const DENSITY: &str = "[ 1 -3 0 0 0 0 0 ]";

fn check_direction(g: &[f64; 3], mesh: &Mesh, found: &mut Findings) {
    let (free, allowed) = match mesh.kind() {
        Kind::Plane => ([true, true, false], "in the plane: along x and y"),
        Kind::Wedge => match mesh.axis {
            Some([axis, _]) => (std::array::from_fn(|k| k == axis), "in a wedge: along its axis"),
            None => return,
        },
        Kind::Solid | Kind::Unknown => return,
    };
    let across: [f64; 3] = std::array::from_fn(|k| if free[k] { 0.0 } else { g[k] });
    if length(&across) > ROUND_OFF * length(g) {
        let value = g.map(number).join(" ");
        found.error(
            [gravity::FILE, "value"],
            &format!("({value})"),
            allowed,
            "Nothing can move the other way",
        );
    }
}

/// Doubts gravity across the walls of a bed that stands upright, and away from its floor.
fn check_upright(g: &[f64; 3], properties: &Dictionary, mesh: &Mesh, found: &mut Findings) {
    let mut doubt = |allowed: &str, advice: &str| {
        let value = format!("({})", g.map(number).join(" "));
        found.doubt([gravity::FILE, "value"], &value, allowed, advice);
    };
    let share = |k: usize| g[k].abs() / length(g);
    // A slope without ends may be inclined
    let endless = mesh.patches.iter().any(|[_, kind]| kind.starts_with("cyclic"));
    if !endless && (0..3).filter(|&k| share(k) > INCLINED).count() > 1 {
        doubt("along one axis of the mesh", "It presses the bed sideways onto its walls, too");
        return;
    }
    let walls = properties.dictionary_at("equilibriumCoeffs").and_then(|own| own.dictionary_at("walls"));
    let is_lid = |patch: &str| {
        let wall = walls.as_ref().ok().and_then(|walls| walls.matching(patch));
        matches!(wall, Some(Entry::Dictionary(wall)) if wall.text("type").is_ok_and(|kind| ["pressure", "piston"].contains(&kind.as_str())))
    };
    let lids = mesh.sides.iter().flatten().filter(|side| side.patch.as_deref().is_some_and(is_lid));
    if let [lid] = lids.collect::<Vec<_>>()[..] {
        let along = (0..3).map(|k| g[k] * lid.normal[k]).sum::<f64>() / length(g);
        if along > -INCLINED {
            let patch = lid.patch.as_deref().unwrap_or_default();
            let allowed = format!("away from patch {patch}, which presses on the bed");
            doubt(&allowed, "The wall that presses is taken as the top of the bed");
        }
    }
}

fn vector(file: &Dictionary) -> Option<[f64; 3]> {
    let tokens = file.value("value").ok()?;
    let numbers: Vec<f64> = tokens.iter().filter_map(|token| token.text.parse().ok()).collect();
    numbers.try_into().ok()
}

fn length(v: &[f64; 3]) -> f64 {
    v.iter().map(|x| x * x).sum::<f64>().sqrt()
}

#[cfg(test)]
mod tests {
    use super::super::domain::Side;
    use super::*;
    use std::path::Path;

    fn lines(mechanics: &str, g: &str, side: &str, stress: f64) -> Vec<String> {
        let read = |name: &str, text: &str| Dictionary::parse(Path::new(name), text).unwrap();
        let properties =
            read("constant/granularProperties", &format!("density 2500; mechanics {mechanics};"));
        let gravity = read(gravity::FILE, &format!("dimensions [0 1 -2 0 0 0 0]; value {g};"));
        let patches = [["floor", "wall"], ["side", side]].map(|pair| pair.map(str::to_string)).to_vec();
        let extent = Some([[0.0; 3], [1.0, 2.0, 0.01]]);
        let sides = Some(vec![Side { patch: Some("floor".to_string()), normal: [0.0, 1.0, 0.0] }]);
        let mesh = Mesh { patches, extent, axis: Some([1, 2]), sides, ..Mesh::default() };
        let values = |numbers: Vec<f64>| Values { numbers: vec![numbers], uniform: true };
        let (porosity, stress) = (values(vec![0.4]), values(vec![stress, 0.0, 0.0, stress, 0.0, stress]));
        let mut found = Findings::default();
        check(&properties, &gravity, &mesh, [Some(&porosity), Some(&stress)], &mut found);
        found.0.iter().map(ToString::to_string).collect()
    }

    #[test]
    fn a_stress_in_another_unit_is_doubted_with_both_numbers() {
        assert!(lines("equilibrium", "(0 -9.81 0)", "empty", -3e4).is_empty());
        let found = lines("equilibrium", "(0 -9.81 0)", "empty", -30.0);
        let wanted = "doubt: 0/stress: internalField = at most 30 Pa, allowed: about the weight of the bed, 29400 Pa at its lowest";
        assert!(found.len() == 1 && found[0].starts_with(wanted), "{found:?}");
        assert!(
            found[0]
                .ends_with("a tall bed between rough walls should begin with a few hundredths of its weight")
        );
        assert!(lines("none", "(0 -9.81 0)", "empty", -30.0).is_empty());
        let elastic = "equilibrium; equilibriumCoeffs { law elastic; } more 1";
        assert!(lines(elastic, "(0 -9.81 0)", "empty", -30.0).is_empty());
    }

    #[test]
    fn gravity_across_a_bed_that_stands_upright_is_doubted() {
        let inclined = lines("equilibrium", "(-5 -8 0)", "empty", -3e4);
        let wanted = "doubt: constant/g: value = (-5 -8 0), allowed: along one axis of the mesh. It presses the bed sideways";
        assert!(inclined.len() == 1 && inclined[0].starts_with(wanted), "{inclined:?}");
        assert!(lines("equilibrium", "(-5 -8 0)", "cyclic", -3e4).is_empty());
        for kind in ["pressure", "piston"] {
            let lid = format!(
                "equilibrium; equilibriumCoeffs {{ walls {{ floor {{ type {kind}; pressure 1; }} }} }} more 1"
            );
            assert!(lines(&lid, "(0 -9.81 0)", "wall", -3e4).is_empty());
            for wrong in ["(0 9.81 0)", "(-9.81 0 0)"] {
                let found = lines(&lid, wrong, "wall", -3e4);
                assert!(found.len() == 1 && found[0].contains("away from patch floor"), "{found:?}");
            }
        }
    }

    #[test]
    fn gravity_points_to_where_grains_can_move() {
        let found = lines("equilibrium", "(0 0 -9.81)", "empty", -3e4);
        assert_eq!(
            found,
            [
                "error: constant/g: value = (0 0 -9.81), allowed: in the plane: along x and y. Nothing can move the other way"
            ]
        );
        assert!(lines("equilibrium", "(0 0 -9.81)", "wall", -3e4).is_empty());
        assert!(lines("equilibrium", "(0 -9.81 0)", "wedge", -3e4).is_empty());
        assert!(lines("equilibrium", "(-9.81 0 0)", "wedge", -3e4)[0].contains("in a wedge: along its axis"));
        assert!(lines("none", "(0 0 -9.81)", "empty", -3e4).is_empty());
    }
}
