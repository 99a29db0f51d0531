//! Tests of the parameters of a new case: how they are written, what is refused, what is proposed.

use super::*;
use crate::grains::PRESETS;

fn scene() -> Scene {
    let size = [0.645, 0.215];
    Scene {
        size,
        cells: proposed_cells(size, 5e-3),
        walls: ["100", "50", "insulated", "insulated"].map(|text| parse_wall(text).unwrap()),
        initial_temperature: 50.0,
        material: "paper".to_string(),
        grains: PRESETS[0].grains,
        model: DiscModel::shipped().unwrap(),
        start: Start::Porosity(0.125),
        compression: Compression::Horizontal,
        mechanics: Mechanics::default(),
        heat_source: None,
        end_time: 8.0,
        tolerance: None,
        probes: proposed_probes(size),
    }
}

#[test]
fn each_wish_out_of_range_is_refused_with_key_value_and_range() {
    assert!(scene().check().is_ok());
    type Change = fn(&mut Scene);
    let wrong: [(Change, &str); 10] = [
        (|s| s.size[0] = 0.01, "width of the box = 0.01, allowed: 0.04 to 1e6 m"),
        (|s| s.size[1] = f64::NAN, "height of the box = NaN"),
        (|s| s.cells = [0, 3], "cells = 0, allowed: 1 to 4000000"),
        (|s| s.initial_temperature = -1.0, "initial temperature = -1, allowed: 0 to 1e5 K"),
        (|s| s.walls[3] = parse_wall("0:300,5:-3").unwrap(), "top = -3, allowed: 0 to 1e5 K"),
        (|s| s.end_time = 0.0, "end time = 0, allowed: 1e-9 to 1e12 s"),
        (|s| s.tolerance = Some(0.0), "tolerance = 0, allowed: 1e-12 to 1e6 K"),
        (|s| s.heat_source = Some(f64::INFINITY), "heat source = inf"),
        (|s| s.probes.push([0.7, 0.1]), "probe = 0.7,0.1, allowed: inside of the box"),
        (|s| s.grains.density = 0.0, "density = 0, allowed: 1e-12 to 1e15 kg/m3"),
    ];
    for (change, message) in wrong {
        let mut changed = scene();
        change(&mut changed);
        let error = changed.check().unwrap_err().to_string();
        assert!(error.starts_with(message), "{error}");
    }
}

#[test]
fn walls_boxes_and_points_are_read_as_they_are_written() {
    assert_eq!(parse_wall("350").unwrap(), WallOverTime::Steady(WallHeat::Temperature(350.0)));
    assert_eq!(parse_wall(" insulated ").unwrap(), WallOverTime::Steady(WallHeat::Insulated));
    assert_eq!(parse_wall("0:300, 60:350").unwrap(), WallOverTime::Table(vec![[0.0, 300.0], [60.0, 350.0]]));
    for wrong in ["", "warm", "0:300", "5:300,6:310", "0:300,0:310", "0:300;60:350", "1,2"] {
        assert!(parse_wall(wrong).unwrap_err().starts_with("insulated, a temperature in Kelvin"), "{wrong}");
    }
    assert_eq!(parse_sides::<f64>("0.6 x 0.2").unwrap(), Numbers(vec![0.6, 0.2]));
    assert_eq!(parse_sides::<usize>("30x10x5").unwrap(), Numbers(vec![30, 10, 5]));
    assert!(parse_sides::<usize>("30").is_err() && parse_sides::<f64>("1x2x3x4").is_err());
    assert_eq!(parse_point("0.1, 0.05").unwrap(), Numbers(vec![0.1, 0.05]));
    assert!(parse_point("0.1").is_err());
    let three = parse_sides::<f64>("1x2x3").unwrap();
    assert_eq!(three.exactly::<3>("box", "").unwrap(), [1.0, 2.0, 3.0]);
    let error = three.exactly::<2>("box", "two lengths").unwrap_err().to_string();
    assert_eq!(error, "box = 1, 2, 3, allowed: two lengths");
}

#[test]
fn proposals_follow_grains_walls_and_diffusion() {
    let mut scene = scene();
    assert_eq!(scene.cells, [30, 10]);
    assert_eq!(proposed_cells([2.15, 0.645], 1e-3), [100, 30]);
    // Left and right wall have a temperature: half the width. D = 0.30 100/(3000 0.9) m2/s.
    assert_eq!(scene.heat_way(), 0.3225);
    let end = scene.proposed_end();
    assert!((end / (0.3225 * 0.3225 / 0.0111) - 1.0).abs() < 0.15, "{end}");
    scene.walls[1] = parse_wall("insulated").unwrap();
    assert_eq!(scene.heat_way(), 0.645);
    let first = scene.first_step();
    assert!(first > 0.0 && first < 0.01 * scene.end_time, "{first}");
    assert_eq!(scene.temperatures(), [50.0, 100.0]);
    assert_eq!(rounded(0.012_345, 2), 0.012);
}
