//! Checks what the law of spheres needs of a case, before the solver refuses it or answers as well as it can.

use super::domain::Mesh;
use super::fields::Values;
use super::finding::Findings;
use super::grains::FILE;
use super::keys;
use super::walls::NO_WALLS;
use crate::dictionary::{Dictionary, Entry, joined};
use crate::numbers::rounded;
use msdd_rve::message::number;
use msdd_surrogate::spheres::model::SphereModel;
use msdd_surrogate::spheres::state::Known;
use std::path::Path;

/// Solid fractions that the solver takes.
const SOLID: [f64; 2] = [0.3, 0.8];
/// By how much the trace of a fabric may differ from 1.
const UNIT_TRACE: f64 = 0.01;
/// Porosities in hundredths, and parts of the range of pressures, that are tried to find what the law knows.
const TRIED: std::ops::Range<u32> = 20..70;
const PRESSURES: u32 = 20;
/// Roughness over the radius above which it is hardly meant.
const MOST_ROUGH: f64 = 0.01;

/// Whether the properties are those of spheres.
pub fn are_meant(properties: &Dictionary) -> bool {
    let surrogate = properties.dictionary_at("surrogate");
    surrogate.is_ok_and(|own| own.text("type").is_ok_and(|kind| kind == "spheres"))
}

/// `properties` with the surrogate type spheres; nothing is done for others. `fields`: porosity and stress at the start.
pub fn check(
    folder: &Path,
    properties: &Dictionary,
    mesh: &Mesh,
    fields: [Option<&Values>; 2],
    found: &mut Findings,
) {
    if !are_meant(properties) {
        return;
    }
    let Ok(surrogate) = properties.dictionary_at("surrogate") else { return };
    let Ok(own) = surrogate.dictionary_at("spheresCoeffs") else {
        let allowed = "a dictionary with poissonRatio and gas";
        found.error([FILE, "surrogate/spheresCoeffs"], "missing", allowed, "");
        return;
    };
    let radius = keys::size(properties, "meanRadius");
    for surface in [Some(own), own.dictionary_at("wall").ok()].into_iter().flatten() {
        check_roughness(surface, radius, found);
    }
    check_fabric(own, found);
    check_walls(properties, mesh, found);
    if let (Some(radius), Some([along, across])) = (radius, mesh.cell()) {
        let least = along.min(across);
        if 2.0 * radius > least {
            let value = format!("cells of {} m", number(rounded(least, 3)));
            let allowed = format!("at least a sphere's diameter, {} m", number(rounded(2.0 * radius, 3)));
            let advice = "A cell smaller than a sphere has no mean over spheres; is meanRadius in metres?";
            found.doubt(["system/blockMeshDict", "blocks"], &value, &allowed, advice);
        }
    }
    let [porosity, stress] = fields;
    let model = load(folder, own, found);
    match (porosity, stress) {
        (Some(porosity), Some(stress)) => {
            check_start(properties, own, model.as_ref(), porosity, stress, found);
        }
        (Some(porosity), None) => check_porosity(model.as_ref(), porosity, found),
        _ => {}
    }
}

fn check_roughness(surface: &Dictionary, radius: Option<f64>, found: &mut Findings) {
    let Some(roughness) = keys::number(surface, "roughness", "") else { return };
    if roughness > 0.0 && surface.get("hardness").is_none() {
        found.error(
            [FILE, &surface.path_of("hardness")],
            "missing",
            "1 to 1e15 Pa, with roughness above 0",
            "",
        );
    }
    if radius.is_some_and(|radius| roughness > MOST_ROUGH * radius) {
        let value = number(roughness);
        let advice = "That is no roughness of spheres of this size; is it in metres?";
        found.doubt(
            [FILE, &surface.path_of("roughness")],
            &value,
            "at most a hundredth of meanRadius [m]",
            advice,
        );
    }
}

fn check_fabric(own: &Dictionary, found: &mut Findings) {
    let Ok(tokens) = own.value("fabric") else { return };
    let words = tokens.iter().map(|token| token.text.as_str()).filter(|word| !["(", ")"].contains(word));
    let numbers: Option<Vec<f64>> = words.map(|word| word.parse().ok()).collect();
    let tensor: Option<[f64; 6]> = numbers.and_then(|numbers| numbers.try_into().ok());
    let possible = tensor.is_some_and(|[xx, xy, xz, yy, yz, zz]| {
        let minors = [xx * yy - xy * xy, xx * zz - xz * xz, yy * zz - yz * yz];
        let all = xx * minors[2] - xy * (xy * zz - yz * xz) + xz * (xy * yz - yy * xz);
        [xx, yy, zz].into_iter().chain(minors).all(|part| part >= 0.0)
            && all >= -1e-15
            && (xx + yy + zz - 1.0).abs() <= UNIT_TRACE
    });
    if !possible {
        let allowed = "the mean of n n over the contacts, (xx xy xz yy yz zz) with xx + yy + zz = 1, and along no direction negative";
        found.error([FILE, &own.path_of("fabric")], &joined(tokens), allowed, "");
    }
}

/// Spheres have no friction at walls that they know by themselves.
fn check_walls(properties: &Dictionary, mesh: &Mesh, found: &mut Findings) {
    let Ok(settings) = properties.dictionary_at("equilibriumCoeffs") else { return };
    let moves = properties.text("mechanics").is_ok_and(|kind| kind == "equilibrium");
    if !moves || settings.text("law").is_ok_and(|law| law == "elastic") {
        return;
    }
    let walls = settings.dictionary_at("walls").ok();
    for [patch, kind] in &mesh.patches {
        if NO_WALLS.contains(&kind.as_str()) {
            continue;
        }
        let place = format!("equilibriumCoeffs/walls/{patch}");
        let wall = walls.and_then(|walls| walls.matching(patch));
        let Some(Entry::Dictionary(wall)) = wall else {
            if wall.is_none() {
                let allowed = "a dictionary with the wall's type";
                found.error(
                    [FILE, &place],
                    "missing",
                    allowed,
                    "Spheres need a rule for each of their walls",
                );
            }
            continue;
        };
        let rigid = wall.text("type").map_or(true, |kind| kind == "rigid");
        if rigid && wall.get("friction").is_some() && wall.get("slip").is_none() {
            let allowed =
                "both friction and slip in a wall of type rigid, or neither: then it has no friction";
            let advice = "Spheres know no slip at walls by themselves";
            found.error([FILE, &format!("{place}/slip")], "missing", allowed, advice);
        }
    }
}

fn load(folder: &Path, own: &Dictionary, found: &mut Findings) -> Option<SphereModel> {
    let name = own.value("model").map_or("builtin".to_string(), joined);
    let name = name.trim_matches('"');
    let model = if name == "builtin" {
        SphereModel::builtin().map_err(|error| error.to_string())
    } else if name.contains('$') || name.contains('<') {
        return None;
    } else {
        let text = msdd_files::read_text(&folder.join(name)).map_err(|error| error.to_string());
        text.and_then(|text| SphereModel::read(&text).map_err(|error| error.to_string()))
    };
    model
        .map_err(|problem| {
            let allowed = "builtin, or a readable model file of spheres, relative to the case folder";
            found.error([FILE, &own.path_of("model")], name, allowed, &problem);
        })
        .ok()
}

/// Checks stress and porosity at the start, and how many cells the law knows.
fn check_start(
    properties: &Dictionary,
    own: &Dictionary,
    model: Option<&SphereModel>,
    porosity: &Values,
    stress: &Values,
    found: &mut Findings,
) {
    let cells = porosity.numbers.len().max(stress.numbers.len());
    // xx xy xz yy yz zz
    let pressure = |cell: usize| {
        let stress = stress.at(cell);
        -(stress[0] + stress[3] + stress[5]) / 3.0
    };
    if (0..cells).any(|cell| pressure(cell) < 0.0) {
        let advice = "OpenFOAM's stress is positive in tension, which grains cannot bear: that of a bed under load is negative";
        let allowed = "a mean of xx, yy and zz of 0 and below";
        found.error(["0/stress", "internalField"], "tension in some cells", allowed, advice);
        return;
    }
    if refuse_porosity(porosity, found) {
        return;
    }
    let (Some(model), Some(young)) = (model, keys::size(properties, "youngModulus")) else { return };
    let ratio = keys::number(own, "poissonRatio", "").unwrap_or(0.3);
    let modulus = 0.5 * young / (1.0 - ratio * ratio);
    let outside = (0..cells)
        .filter(|&cell| {
            let [xx, xy, xz, yy, yz, zz]: [f64; 6] = std::array::from_fn(|k| -stress.at(cell)[k] / modulus);
            let state =
                model.initial_state(1.0 - porosity.at(cell)[0], [xx, yy, zz, xy, xz, yz], &Known::default());
            model.advance(&state, &Default::default(), 6.0, false).outside > 0
        })
        .count();
    if outside > 0 {
        let who =
            if outside == cells { "all cells".to_string() } else { format!("{outside} of {cells} cells") };
        let advice = "The solver answers as well as it can there, and marks them by inRegion = 0";
        let value = format!("{who} have a porosity and stress outside of those of the training");
        found.doubt(
            ["0/porosity", "internalField"],
            &value,
            "packings of spheres that the law was trained with",
            advice,
        );
    }
}

/// Reports a porosity that the solver refuses; returns whether there is one.
fn refuse_porosity(porosity: &Values, found: &mut Findings) -> bool {
    let mut solids = porosity.numbers.iter().map(|value| 1.0 - value[0]);
    let wrong = solids.find(|solid| !(SOLID[0]..=SOLID[1]).contains(solid));
    if let Some(solid) = wrong {
        let allowed =
            format!("{} to {} with spheres", number(rounded(1.0 - SOLID[1], 3)), number(1.0 - SOLID[0]));
        found.error(["0/porosity", "internalField"], &number(rounded(1.0 - solid, 4)), &allowed, "");
    }
    wrong.is_some()
}

/// Checks the porosity at the start of a bed whose stress follows from its weight: doubts one that the law knows under no stress.
fn check_porosity(model: Option<&SphereModel>, porosity: &Values, found: &mut Findings) {
    if refuse_porosity(porosity, found) {
        return;
    }
    let Some(model) = model else { return };
    let pressures = model.file.ranges.pressure;
    let knows = |porosity: f64| {
        (0..=PRESSURES).any(|k| {
            let share = f64::from(k) / f64::from(PRESSURES);
            let pressure = pressures.min * (pressures.max / pressures.min).powf(share);
            let stress = [pressure, pressure, pressure, 0.0, 0.0, 0.0];
            let state = model.initial_state(1.0 - porosity, stress, &Known::default());
            model.advance(&state, &Default::default(), 6.0, false).outside == 0
        })
    };
    let all = || porosity.numbers.iter().map(|value| value[0]);
    let ends = [all().fold(1.0, f64::min), all().fold(0.0, f64::max)];
    let Some(wrong) = ends.into_iter().find(|&porosity| !knows(porosity)) else { return };
    let mut known = TRIED.map(|k| f64::from(k) / 100.0).filter(|&porosity| knows(porosity));
    let Some(least) = known.next() else { return };
    let most = known.next_back().unwrap_or(least);
    let allowed = format!("about {} to {}", number(least), number(most));
    let advice = "The law was trained with no packings of spheres of this porosity; the solver answers as well as it can there, and \
                  marks such cells by inRegion = 0";
    found.doubt(["0/porosity", "internalField"], &number(rounded(wrong, 4)), &allowed, advice);
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Findings of a bed with these entries beside its properties, its porosity, and its stress xx = yy = zz [Pa].
    fn lines(coefficients: &str, more: &str, porosity: f64, stress: f64) -> Vec<String> {
        let text = format!(
            "youngModulus 200e9; meanRadius 1e-3; surrogate {{ type spheres; spheresCoeffs {{ poissonRatio 0.3; {coefficients} }} }} {more}"
        );
        let properties = Dictionary::parse(Path::new(FILE), &text).unwrap();
        let patches = [["left", "wall"], ["right", "wall"], ["back", "empty"]];
        let mesh = Mesh { patches: patches.map(|pair| pair.map(str::to_string)).to_vec(), ..Mesh::default() };
        let values = |numbers: Vec<f64>| Values { numbers: vec![numbers], uniform: true };
        let (porosity, stress) =
            (values(vec![porosity]), values(vec![stress, 0.0, 0.0, stress, 0.0, stress]));
        let mut found = Findings::default();
        check(Path::new(""), &properties, &mesh, [Some(&porosity), Some(&stress)], &mut found);
        found.0.iter().map(ToString::to_string).collect()
    }

    #[track_caller]
    fn finds(lines: &[String], part: &str) {
        assert!(lines.len() == 1 && lines[0].contains(part), "{lines:?}");
    }

    #[test]
    fn a_good_bed_has_no_findings() {
        let walls = "mechanics equilibrium; equilibriumCoeffs { walls { left { friction 0.3; slip 1e-6; } \".*\" { type frictionless; } } }";
        let good = "fabric (0.32 0 0 0.32 0 0.36); roughness 1e-7; hardness 3e9;";
        assert_eq!(lines(good, walls, 0.4, -1e4), Vec::<String>::new());
    }

    #[test]
    fn what_the_solver_refuses_is_found() {
        finds(&lines("roughness 1e-7;", "", 0.4, -1e4), "hardness");
        finds(&lines("fabric (0.3 0.5 0.4 0.3 0.4 0.4);", "", 0.4, -1e4), "along no direction negative");
        finds(&lines("fabric (0.4 0 0 0.4 0 0.4);", "", 0.4, -1e4), "xx + yy + zz = 1");
        finds(&lines("model \"none.json\";", "", 0.4, -1e4), "model file of spheres");
        finds(&lines("", "", 0.4, 1e4), "tension in some cells");
        finds(&lines("", "", 0.9, -1e4), "0.2 to 0.7");
        let moves = "mechanics equilibrium; equilibriumCoeffs";
        let one = format!("{moves} {{ walls {{ left {{ type frictionless; }} }} }}");
        finds(&lines("", &one, 0.4, -1e4), "walls/right = missing");
        let rigid =
            format!("{moves} {{ walls {{ left {{ friction 0.3; }} right {{ type frictionless; }} }} }}");
        finds(&lines("", &rigid, 0.4, -1e4), "friction and slip");
    }

    #[test]
    fn rigid_walls_without_friction_are_taken() {
        let walls = "mechanics equilibrium; equilibriumCoeffs { walls { left { type rigid; } right { slip 1e-6; } } }";
        assert_eq!(lines("", walls, 0.4, -1e4), Vec::<String>::new());
    }

    #[test]
    fn what_nobody_means_is_doubted() {
        finds(&lines("roughness 1e-3; hardness 3e9;", "", 0.4, -1e4), "a hundredth of meanRadius");
        finds(&lines("", "", 0.25, -1e4), "all cells have a porosity and stress outside");
    }

    #[test]
    fn porosities_that_the_law_does_not_know_are_doubted_without_stress() {
        let lines = |porosities: &[f64]| {
            let properties =
                "youngModulus 200e9; meanRadius 1e-3; surrogate { type spheres; spheresCoeffs { } }";
            let properties = Dictionary::parse(Path::new(FILE), properties).unwrap();
            let porosity =
                Values { numbers: porosities.iter().map(|&one| vec![one]).collect(), uniform: false };
            let mut found = Findings::default();
            check(Path::new(""), &properties, &Mesh::default(), [Some(&porosity), None], &mut found);
            found.0.iter().map(ToString::to_string).collect::<Vec<_>>()
        };
        assert_eq!(lines(&[0.38, 0.4]), Vec::<String>::new());
        finds(&lines(&[0.38, 0.55]), "doubt: 0/porosity: internalField = 0.55, allowed: about 0.26 to 0.42");
        finds(&lines(&[0.22, 0.4]), "doubt: 0/porosity: internalField = 0.22, allowed: about 0.26 to 0.42");
        finds(
            &lines(&[0.4, 0.9]),
            "error: 0/porosity: internalField = 0.9, allowed: 0.2 to 0.7 with spheres",
        );
    }
}
