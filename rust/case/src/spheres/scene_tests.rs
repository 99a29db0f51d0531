//! Tests of the parameters of a new case of spheres: what is refused, what is proposed.

use super::*;
use crate::material::{OF_SPHERES, Values};
use crate::scene::parse_wall;
use crate::scenes_for_tests::{each_is_refused, spheres};
use crate::spheres::material::Spheres;
use msdd_beds::case::End;

#[test]
fn wishes_out_of_range_are_refused_with_key_value_and_range() {
    for material in OF_SPHERES.iter() {
        Spheres::of(material, material.grains(&Values::default()).unwrap()).unwrap().check().unwrap();
    }
    let no_shell = Some(Shell { young_modulus: 2e11, thickness: 0.0, thermal_expansion: 0.0 });
    let error = SphereCase { shell: no_shell, ..spheres() }.check().unwrap_err().to_string();
    assert!(error.starts_with("thickness of the shell = 0, allowed: more than 0"), "{error}");
    each_is_refused(
        &spheres(),
        SphereCase::check,
        &[
            (|s| s.spheres.poisson_ratio = 0.6, "poissonRatio = 0.6, allowed: -0.99 to 0.5"),
            (|s| s.spheres.roughness = 1e-3, "roughness = 0.001, allowed: 0 (smooth) to a hundredth"),
            (|s| s.spheres.hardness = 0.0, "hardness = 0, allowed: 1 to 1e15 Pa"),
            (|s| s.shape = Shape::Box([0.3, 0.01, 0.3]), "depth of the box = 0.01, allowed: 0.0256 to 1e6"),
            (|s| s.spheres.grains.density = -1.0, "density = -1, allowed: "),
            (|s| s.cells[1] = 0, "cells = 0, allowed: 1 to 4000000"),
            (|s| s.initial_temperature = 20.0, "initial temperature = 20, allowed: 273 to 1800 K"),
            (|s| s.gas.pressure = 0.0, "gas pressure = 0, allowed: 1e-3 to 1e9 Pa"),
            (|s| s.gravity = -9.81, "gravity = -9.81, allowed: 0 to 1000 m/s2 downwards"),
            (|s| (s.mechanics, s.wall_friction) = (Mechanics::None, 0.3), "wall friction = 0.3, allowed: 0"),
            (|s| s.slack_layer = -1.0, "slackLayer = -1, allowed: 0 to 1000 diameters"),
            (|s| s.end_time = 0.0, "end time = 0, allowed: 1e-9 to 1e12 s"),
            (|s| s.tolerance = Some(0.0), "tolerance = 0, allowed: 1e-12 to 1e6 K"),
        ],
    );
}

#[test]
fn a_flow_needs_a_gas_and_open_ends() {
    let flow = Flow { mass: 0.004, temperature: 813.0, from: End::Top };
    let walls = vec![parse_wall("insulated").unwrap(); 3];
    let scene = SphereCase { flow: Some(flow), walls, ..spheres() };
    each_is_refused(
        &scene,
        SphereCase::check,
        &[
            (|s| s.flow.as_mut().unwrap().mass = -1.0, "flow = -1, allowed: more than 0"),
            (|s| s.flow.as_mut().unwrap().temperature = 100.0, "flow temperature = 100, allowed: 273 to"),
            (|s| s.gas.name = GasName::Vacuum, "gas = vacuum, allowed: with a flow"),
            (|s| s.walls[2] = parse_wall("400").unwrap(), "top = not insulated, allowed: insulated"),
        ],
    );
    // The gas heats the bed from 293 to 813 K along its axis, with its heat in the time that is proposed
    assert_eq!(
        (scene.temperatures(), scene.varies(), scene.steepest()),
        ([293.0, 813.0], vec![false, true], 1)
    );
    let stored = 7800.0 * 475.0 * 0.6 * PI * 0.1 * 0.1 * 0.4;
    let end = stored / (0.004 * GasName::Helium.flowing(813.0).unwrap().heat_capacity);
    assert!((scene.proposed_end().unwrap() / end - 1.0).abs() < 0.05, "{end}");
}

#[test]
fn proposals_follow_spheres_walls_and_diffusion() {
    let scene = spheres();
    assert_eq!((scene.varies(), scene.steepest(), scene.heat_way()), (vec![true, true], 0, 0.1));
    // 0.6 pi 0.1^2 0.4 m3 over 4/3 pi 0.0032^3 m3
    assert!((scene.number() / 54_932.0 - 1.0).abs() < 1e-4, "{}", scene.number());
    // L^2 rho c (1 - eta)/K with the conductivity of the start
    let end = 0.01 * 7800.0 * 475.0 * 0.6 / scene.start().unwrap().conductivity;
    assert!((scene.proposed_end().unwrap() / end - 1.0).abs() < 0.05);
    let first = scene.first_step().unwrap();
    assert!(first > 0.0 && first <= 0.01 * scene.end_time, "{first}");
    let insulated = SphereCase { walls: vec![parse_wall("insulated").unwrap(); 3], ..scene.clone() };
    assert_eq!((insulated.varies(), insulated.heat_way()), (vec![false, false], 0.4));
    assert_eq!(SphereCase { gravity: GRAVITY, ..insulated.clone() }.varies(), [false, true]);
    assert_eq!(SphereCase { wall_friction: 0.3, ..insulated }.varies(), [true, true]);
    // 210e9/(2 (1 - 0.09))
    assert!((scene.spheres.contact_modulus() / 115.385e9 - 1.0).abs() < 1e-5);
}

#[test]
fn weight_and_friction_that_are_left_out_are_noted() {
    let begins = |scene: &SphereCase, notes: &[&str]| {
        let found = scene.notes();
        let fit = found.iter().zip(notes).all(|(note, begin)| note.starts_with(begin));
        assert!(fit && found.len() == notes.len(), "{found:?}");
    };
    // 7800 0.6 9.81 0.4 Pa are not small compared with 20 kPa
    begins(&spheres(), &["the weight of the bed, up to 18000 Pa at the bottom", "the sides are smooth"]);
    let rough = SphereCase { gravity: GRAVITY, wall_friction: wall::OF_SPHERE, ..spheres() };
    begins(&rough, &[]);
}

/// One file for DEM and for the solver.
const BED: &str = r#"
heat_source = 5000
[grains]
diameter = 6.4e-3
density = 7800
young_modulus = 210e9
poisson_ratio = 0.3
conductivity = 46
heat_capacity = 475
thermal_expansion = 1.2e-5
wall_friction = 0.2
[container]
radius = 0.1
height = 0.4
porosity = 0.4
[lid]
pressure = 2e4
pressing = 2e4
[gas]
name = "helium"
[[heated]]
wall = "side"
temperature = [[0, 300], [60, 400]]
[[heated]]
wall = "lid"
coefficient = 50
outside = 293
[time]
initial_temperature = 293.15
end = 1e4
[solver]
cells = [10, 24]
"#;

fn bed(text: &str) -> BedCase {
    toml::from_str::<BedCase>(text).unwrap().filled()
}

#[test]
fn a_description_is_a_case_of_the_solver_and_a_run_of_discrete_elements() {
    let of_dem = bed(BED);
    of_dem.checked(std::path::Path::new("bed.toml")).unwrap_err();
    let hot = "coefficient = 50\noutside = 293";
    bed(&BED.replace(hot, "temperature = 293")).checked(std::path::Path::new("bed.toml")).unwrap();
    let scene = SphereCase::new(&of_dem, "steel").unwrap();
    assert_eq!(scene.shape, Shape::Cylinder { radius: 0.1, height: 0.4 });
    let walls = ["0:300,60:400", "insulated", "h=50,T=293"].map(|wall| parse_wall(wall).unwrap());
    assert_eq!(scene.walls, walls);
    assert_eq!((scene.heat_source, scene.lid, scene.slack_layer), (Some(3000.0), Lid::Presses, 0.0));
    assert_eq!(
        (scene.wall_friction, scene.gravity, scene.cells.as_slice()),
        (0.2, 9.81, [10, 24].as_slice())
    );
    assert!((of_dem.grains.number as f64 / scene.number() - 1.0).abs() < 1e-4, "{}", of_dem.grains.number);
    // The options of 'case new' fill the same description.
    let keys = scene.spheres.keys(0.2);
    assert_eq!(Spheres::of_bed(&keys, 293.15), scene.spheres);
    for (from, to, message) in [
        ("pressing = 2e4", "pressing = 3e4", "lid.pressing = another pressure"),
        ("pressing = 2e4", "strain = 1e-3", "lid.strain = given, allowed: only by 'msdd bed run'"),
        ("height = 0.4\n", "", "container.height = not given"),
        ("outside = 293\n", "", "heated = lid, allowed: one of temperature, flux"),
        ("\"lid\"", "\"x_low\"", "heated.wall = x_low, allowed: side, floor, lid"),
        ("[10, 24]", "[10]", "cells = [10], allowed: 2 numbers"),
    ] {
        assert!(BED.contains(from), "{from}");
        let error = SphereCase::new(&bed(&BED.replacen(from, to, 1)), "steel").unwrap_err().to_string();
        assert!(error.starts_with(message), "{error}");
    }
}
