//! Tests of the parameters of a new case of spheres: what is refused, what is proposed.

use super::*;
use crate::scene::parse_wall;
use crate::spheres::material::MATERIALS;
use msdd_beds::named_gases::GasName;

fn scene() -> Scene {
    Scene {
        shape: Shape::Cylinder { radius: 0.1, height: 0.4 },
        cells: vec![10, 24],
        walls: ["400", "293", "insulated"].map(|text| parse_wall(text).unwrap()).to_vec(),
        initial_temperature: 293.0,
        material: "steel".to_string(),
        spheres: MATERIALS[0].spheres(),
        gas: Gas { name: GasName::Helium, pressure: 1e5 },
        porosity: 0.4,
        pressure: 2e4,
        mechanics: Mechanics::Equilibrium,
        lid: Lid::Presses,
        shell: None,
        give: 0.0,
        wall_friction: 0.0,
        gravity: 0.0,
        heat_source: None,
        end_time: 1e4,
        tolerance: None,
        probes: vec![vec![0.05, 0.2]],
    }
}

#[test]
fn each_wish_out_of_range_is_refused_with_key_value_and_range() {
    scene().check().unwrap();
    type Change = fn(&mut Scene);
    let wrong: [(Change, &str); 19] = [
        (|s| s.shape = Shape::Box([0.3, 0.01, 0.3]), "depth of the box = 0.01, allowed: 0.0256 to 1e6 m"),
        (
            |s| s.shape = Shape::Cylinder { radius: 3e-3, height: 1.0 },
            "radius of the cylinder = 0.003, allowed: 0.0128",
        ),
        (|s| s.cells[1] = 0, "cells = 0, allowed: 1 to 4000000"),
        (
            |s| s.probes.push(vec![0.2, 0.1]),
            "probe = 0.2,0.1, allowed: radius,height: distance from the axis and height, 0,0 to 0.0999,0.4 m",
        ),
        (
            |s| s.walls[0] = parse_wall("2000").unwrap(),
            "side = 2000, allowed: 273 to 1800 K, for which helium is known",
        ),
        (|s| s.initial_temperature = 20.0, "initial temperature = 20, allowed: 273 to 1800 K"),
        (|s| s.gas.pressure = 0.0, "gas pressure = 0, allowed: 1e-3 to 1e9 Pa"),
        (
            |s| s.spheres.grains.thermal_conductivity = 0.17,
            "thermalConductivity = 0.17, allowed: at least that of the gas (helium), which is 0.189 W/(m K) at 400 K",
        ),
        (|s| s.pressure = 0.0, "pressure = 0, allowed: "),
        (|s| s.porosity = 0.25, "porosity = 0.25, allowed: 0.35"),
        (|s| s.porosity = 40.0, "porosity = 40, allowed: 0.35"),
        (|s| s.gravity = -9.81, "gravity = -9.81, allowed: 0 to 1000 m/s2 downwards"),
        (|s| s.wall_friction = -0.1, "wall friction = -0.1, allowed: >= 0"),
        (
            |s| {
                s.mechanics = Mechanics::None;
                s.wall_friction = 0.3;
            },
            "wall friction = 0.3, allowed: 0 with mechanics none",
        ),
        (|s| s.give = -1.0, "give = -1, allowed: 0 to 1000 diameters"),
        (
            |s| s.shell = Some(Shell { young_modulus: 2e11, thickness: 0.0, thermal_expansion: 0.0 }),
            "thickness of the shell = 0, allowed: more than 0, at most a fifth of the radius, 0.02 m",
        ),
        (
            |s| {
                s.mechanics = Mechanics::None;
                s.gravity = 9.81;
            },
            "gravity = 9.81, allowed: 0 with mechanics none",
        ),
        (|s| s.end_time = 0.0, "end time = 0, allowed: 1e-9 to 1e12 s"),
        (|s| s.tolerance = Some(0.0), "tolerance = 0, allowed: 1e-12 to 1e6 K"),
    ];
    for (change, message) in wrong {
        let mut changed = scene();
        change(&mut changed);
        let error = changed.check().unwrap_err().to_string();
        assert!(error.starts_with(message), "{error}");
    }
}

#[test]
fn proposals_follow_spheres_walls_and_diffusion() {
    let mut scene = scene();
    assert_eq!((scene.varies(), scene.steepest(), scene.heat_way()), (vec![true, true], 0, 0.1));
    // 0.6 pi 0.1^2 0.4 m3 over 4/3 pi 0.0032^3 m3
    assert!((scene.number() / 54_932.0 - 1.0).abs() < 1e-4, "{}", scene.number());
    // L^2 rho c (1 - eta)/K with the conductivity of the start
    let conductivity = scene.start().unwrap().conductivity;
    let end = 0.01 * 7800.0 * 475.0 * 0.6 / conductivity;
    assert!((scene.proposed_end().unwrap() / end - 1.0).abs() < 0.05);
    let first = scene.first_step().unwrap();
    assert!(first > 0.0 && first <= 0.01 * scene.end_time, "{first}");
    // 7800 0.6 9.81 0.4 Pa are not small beside 20 kPa
    assert!(scene.notes()[0].contains("up to 18000 Pa at the bottom"));
    assert!(scene.notes()[1].starts_with("the sides are smooth"));
    scene.gravity = GRAVITY;
    scene.wall_friction = wall::OF_SPHERE;
    assert!(scene.notes().is_empty());
    scene.shell = Some(Shell { young_modulus: 2e11, thickness: 1e-3, thermal_expansion: 0.0 });
    let notes = scene.notes();
    assert!(notes.len() == 1 && notes[0].contains("in a bed 2 vessel diameters high"), "{notes:?}");
    scene.shell = None;
    // Janssen's stress at the bottom: less than the pressure on the top, if that is more than the walls leave of the weight
    let length = 0.05 / (wall::of_bed(wall::OF_SPHERE) * LATERAL);
    let deep = 7800.0 * 0.6 * GRAVITY * length;
    let bottom = deep + (2e4 - deep) * f64::exp(-0.4 / length);
    assert!(bottom < 2e4 && (scene.stress_at_start().unwrap() / bottom - 1.0).abs() < 0.01, "{bottom}");
    assert_eq!(Scene { pressure: 1e3, ..scene.clone() }.stress_at_start().unwrap(), 1e3);
    assert_eq!(Scene { lid: Lid::Stays, ..scene.clone() }.stress_at_start().unwrap(), 2e4);
    scene.wall_friction = 0.0;
    scene.walls = vec![parse_wall("insulated").unwrap(); 3];
    assert_eq!((scene.varies(), scene.heat_way()), (vec![false, true], 0.4));
    scene.wall_friction = 0.3;
    assert_eq!(scene.varies(), [true, true]);
}
