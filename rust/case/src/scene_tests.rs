//! Tests of the parameters of a new case: how they are written, what is refused, what is proposed.

use super::*;
use crate::scenes_for_tests::disc;
use crate::scenes_for_tests::{discs, each_is_refused, walls};

#[test]
fn wishes_out_of_range_are_refused_with_key_value_and_range() {
    each_is_refused(
        &discs(),
        DiscCase::check,
        &[
            (|s| s.size[1] = f64::NAN, "height of the box = NaN"),
            (|s| s.walls[3] = parse_wall("0:300,5:-3").unwrap(), "top = -3, allowed: 0 to 1e5 K"),
            (|s| s.heat_source = Some(f64::INFINITY), "heat source = inf"),
            (|s| s.start = InitialPacking::Porosity(f64::NAN), "porosity = NaN, allowed: 0.06 to 0.19"),
        ],
    );
}

#[test]
fn walls_are_read_as_they_are_written() {
    use WallOverTime::{Steady, Table};
    let read = [" insulated ", "350", "0:300, 60:350"].map(|text| parse_wall(text).unwrap());
    let table = Table(vec![[0.0, 300.0], [60.0, 350.0]]);
    assert_eq!(read, [Steady(WallHeat::Insulated), Steady(WallHeat::Temperature(350.0)), table]);
    let (h, q) = (parse_wall("h=200, T=300").unwrap(), parse_wall("q=-500").unwrap());
    assert_eq!(h, WallOverTime::Coefficient { coefficient: 200.0, outside: 300.0 });
    assert_eq!(
        (q.clone(), h.temperatures(), q.temperatures()),
        (WallOverTime::Flux(-500.0), vec![300.0], vec![])
    );
    assert!(h.conducts() && q.conducts() && q.at(0.0).is_none());
    for wrong in [
        "h=200",
        "T=300,h=200",
        "q=500,T=300",
        "q=",
        "h=200,T=x",
        "",
        "warm",
        "0:300",
        "5:300,6:310",
        "0:300,0:310",
        "0:300;60:350",
        "1,2",
    ] {
        assert!(parse_wall(wrong).unwrap_err().starts_with("insulated, a temperature in kelvin"), "{wrong}");
    }
    assert!(parse_sides::<f64>("1x2x3x4").is_err() && parse_point("0.1").is_err());
}

#[test]
fn proposals_follow_grains_walls_and_diffusion() {
    let (size, grains) = ([0.645, 0.215], disc(0));
    assert_eq!([proposed_cells(size, 5e-3), proposed_cells([2.15, 0.645], 1e-3)], [[30, 10], [100, 30]]);
    let walls = walls(["100", "50", "insulated", "insulated"]);
    let mut scene = DiscCase { size, grains, walls, initial_temperature: 50.0, cells: [30, 10], ..discs() };
    // Left and right wall have a temperature: half the width. D = 0.30 100/(3000 0.9) m2/s.
    assert_eq!(scene.heat_way(), 0.3225);
    let end = scene.proposed_end();
    assert!((end / (0.3225 * 0.3225 / 0.0111) - 1.0).abs() < 0.15, "{end}");
    assert_eq!(scene.temperatures(), [50.0, 100.0]);
    scene.walls[1] = parse_wall("insulated").unwrap();
    assert_eq!(scene.heat_way(), 0.645);
    let first = scene.first_step();
    assert!(first > 0.0 && first < 0.01 * scene.end_time, "{first}");
    assert_eq!(rounded(0.012_345, 2), 0.012);
}
