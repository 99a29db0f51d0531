//! Tests of the files of a new case of spheres.

use super::*;
use crate::dictionary::Dictionary;
use crate::scene::parse_wall;
use crate::spheres::material::MATERIALS;
use crate::spheres::scene::Shell;
use crate::spheres::start::Gas;
use msdd_beds::named_gases::GasName;

fn scene(shape: Shape) -> Scene {
    let varies = vec![true; shape.lengths().len()];
    let spheres = MATERIALS[0].spheres();
    let mut walls = vec![parse_wall("insulated").unwrap(); shape.walls().len()];
    walls[0] = parse_wall("350").unwrap();
    Scene {
        shape,
        cells: shape.proposed_cells(&varies, 2.0 * spheres.radius()),
        walls,
        initial_temperature: 293.15,
        material: "steel".to_string(),
        spheres,
        gas: Gas { name: GasName::Helium, pressure: 1e5 },
        porosity: 0.4,
        pressure: 2e4,
        mechanics: Mechanics::Equilibrium,
        lid: Lid::Presses,
        shell: None,
        give: 0.0,
        wall_friction: 0.0,
        gravity: 0.0,
        heat_source: Some(3000.0),
        end_time: 1e4,
        tolerance: None,
        probes: shape.proposed_probes(0),
    }
}

const ROUND: Shape = Shape::Cylinder { radius: 0.1, height: 0.4 };

fn made(scene: &Scene) -> Vec<File> {
    files(scene, "bed", Path::new("/checkout")).unwrap()
}

fn read(files: &[File], path: &str) -> Dictionary {
    let text = &files.iter().find(|file| file.path == path).unwrap().text;
    let text = text.replace("    #includeEtc \"caseDicts/setConstraintTypes\"\n", "");
    Dictionary::parse(Path::new(path), &text).unwrap()
}

#[test]
fn every_place_of_every_template_is_filled_and_every_dictionary_is_read() {
    let place = regex::Regex::new("@[A-Za-z]+@").unwrap();
    for shape in [ROUND, Shape::Box([0.3, 0.1, 0.2])] {
        for gravity in [0.0, 9.81] {
            let files = made(&Scene { gravity, ..scene(shape) });
            // With gravity its file stands in place of that of the stress.
            assert_eq!(files.len(), 14);
            for File { path, text, program } in &files {
                assert!(!place.is_match(text), "{path}: {text}");
                assert_eq!(*program, path.starts_with("All"));
                if path.contains('/') {
                    read(&files, path).dictionary_at("FoamFile").unwrap();
                }
            }
        }
    }
}

#[test]
fn the_same_wishes_give_the_same_bytes() {
    let texts = || made(&scene(ROUND)).into_iter().map(|file| file.text).collect::<Vec<_>>();
    assert_eq!(texts(), texts());
}

#[test]
fn walls_and_stress_stand_where_the_solver_looks_for_them() {
    let wall = |files: &[File], name: &str| {
        let properties = read(files, "constant/granularProperties");
        let coefficients = properties.dictionary_at("equilibriumCoeffs").unwrap();
        let walls = coefficients.dictionary_at("walls").unwrap();
        walls.dictionary_at(name).unwrap().clone()
    };
    let round = made(&scene(ROUND));
    assert_eq!(
        read(&round, "0/stress").text("internalField").unwrap(),
        "uniform ( -20000 0 0 -16000 0 -16000 )"
    );
    assert_eq!(wall(&round, "top").text("pressure").unwrap(), "constant 20000");
    assert_eq!(wall(&round, "inner").text("type").unwrap(), "frictionless");
    let vessel = Scene {
        lid: Lid::Stays,
        give: 1.0,
        gravity: 9.81,
        shell: Some(Shell { young_modulus: 2e11, thickness: 0.002, thermal_expansion: 1.2e-5 }),
        ..scene(ROUND)
    };
    let vessel = made(&vessel);
    assert_eq!(wall(&vessel, "top").text("give").unwrap(), "1");
    assert_eq!(wall(&vessel, "side").text("radius").unwrap(), "0.1");
    assert_eq!(wall(&vessel, "side").text("thermalExpansion").unwrap(), "1.2e-5");
    assert_eq!(read(&vessel, "constant/g").text("value").unwrap(), "( -9.81 0 0 )");
    assert!(vessel.iter().all(|file| file.path != "0/stress"));
    let rough = Scene { wall_friction: 0.3, gravity: 9.81, lid: Lid::Stays, give: 1.0, ..scene(ROUND) };
    let rough = made(&rough);
    for name in ["side", "bottom", "top"] {
        assert_eq!(wall(&rough, name).text("friction").unwrap(), "0.154", "{name}");
    }
    assert_eq!(wall(&rough, "bottom").text("give").unwrap(), "1");
    assert_eq!(wall(&rough, "inner").text("type").unwrap(), "frictionless");
    // Walls bear a part of the weight, so the bed does not begin at rest.
    assert!(read(&rough, "constant/granularProperties").get("restStress").is_none());
    assert!(
        rough.iter().any(|file| file.path == "0/stress")
            && rough.iter().any(|file| file.path == "constant/g")
    );
    let still = made(&Scene { mechanics: Mechanics::None, ..scene(ROUND) });
    assert!(read(&still, "constant/granularProperties").get("equilibriumCoeffs").is_none());
}
