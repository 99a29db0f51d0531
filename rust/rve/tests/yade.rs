//! Comparison with YADE with moving walls: the same packed state, its walls closed along x or slid along the grains, in
//! both engines.
//!
//! States computed by YADE are in tests/engines/reference, or in the folder MSDD_YADE_STATES.
//! tests/engines/make-reference makes them, at the strain rate that is used here. tests/engines/run compares
//! expansions.

use msdd_dem::Side;
use msdd_rve::state::from_json;
use msdd_rve::{Protocol, RegionKind, Simulation, Strains, follow, homogenise, unbalanced_force};
use std::path::PathBuf;

/// Strain rate in both engines [1/s].
const RATE: f64 = 0.02;
/// Largest relative difference of stresses (to the pressure), of wall forces (to the mean normal one), and of the
/// fabric index. Measured: 1e-4 with closing walls, 2.1e-4 with sliding ones (the forces along the walls).
const ALLOWED: f64 = 5e-4;

fn read(folder: &str, name: &str) -> Simulation {
    let path = PathBuf::from(folder).join(name);
    let text = std::fs::read_to_string(&path).unwrap_or_else(|error| panic!("{}: {error}", path.display()));
    from_json(&text).unwrap_or_else(|error| panic!("{}: {error}", path.display()))
}

const REFERENCE: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../../tests/engines/reference");

fn yade(stop: &str) -> Simulation {
    let folder = std::env::var("MSDD_YADE_STATES").unwrap_or_else(|_| REFERENCE.to_string());
    read(&folder, &format!("yade_{stop}.json"))
}

/// Force of the grains on each wall [N], normal and tangential.
fn wall_forces(simulation: &Simulation) -> [[f64; 2]; 4] {
    let mut forces = [[0.0; 2]; 4];
    simulation.for_each_contact(|contact| {
        if let Err(side) = contact.i {
            forces[side as usize][0] += contact.normal_force();
            forces[side as usize][1] -= contact.tangential_force;
        }
    });
    forces
}

/// Panics when the averages or wall forces differ by more than `allowed`; returns the largest difference.
fn compare(stop: &str, ours: &Simulation, allowed: f64) -> f64 {
    let theirs = yade(stop);
    assert!(unbalanced_force(&theirs) < 2e-5, "YADE's state is out of balance here");
    let [a, b] = [ours, &theirs].map(|state| homogenise(state, RegionKind::Hull));
    let [on_ours, on_theirs] = [ours, &theirs].map(wall_forces);
    let mean_force = 0.25 * Side::ALL.iter().map(|&side| on_theirs[side as usize][0]).sum::<f64>();
    let mut differences = vec![
        ("stress_xx", (a.stress_xx - b.stress_xx) / b.pressure),
        ("stress_yy", (a.stress_yy - b.stress_yy) / b.pressure),
        ("stress_xy", (a.stress_xy - b.stress_xy) / b.pressure),
        ("fabric index", a.fabric_index - b.fabric_index),
        ("porosity", a.porosity - b.porosity),
        ("width", ours.walls.width() / theirs.walls.width() - 1.0),
    ];
    for (mine, other) in on_ours.iter().zip(&on_theirs) {
        differences.push(("normal force on a wall", (mine[0] - other[0]) / mean_force));
        differences.push(("tangential force on a wall", (mine[1] - other[1]) / mean_force));
    }
    println!("{stop}: p {:.1} Pa, walls {on_ours:.1?} N, differences {differences:?}", a.pressure);
    for (what, difference) in &differences {
        assert!(difference.abs() <= allowed, "{stop}: {what} differs by {difference:e}, allowed {allowed:e}");
    }
    differences.iter().fold(0.0, |largest, (_, difference)| largest.max(difference.abs()))
}

/// Both x walls close by 1 and 2 %.
#[test]
fn walls_closing_along_x_agree_with_yade() {
    let mut simulation = read(REFERENCE, "state.json");
    let path = [-0.01, -0.02].map(|xx| Strains { xx, ..Strains::default() });
    let protocol = Protocol { expansion_rate: RATE, contraction_rate: RATE, ..Protocol::default() };
    let start = homogenise(&simulation, RegionKind::Hull).pressure;
    let mut names = ["xx=-0.01", "xx=-0.02"].into_iter();
    follow(&mut simulation, &path, protocol, |stop, state| {
        assert!(stop.averages.pressure > 1.05 * start, "nothing to compare");
        compare(names.next().unwrap(), state, ALLOWED);
    })
    .unwrap();
    assert_eq!(names.next(), None);
}

/// Slides top and bottom by ± `way` [m] along x, then lets the forces balance.
fn slide(simulation: &mut Simulation, way: f64) {
    let speed = 0.5 * RATE * simulation.walls.height();
    let mut left = way;
    while left > 1e-12 {
        let steps = (left / (speed * simulation.time_step)).ceil();
        let speed = left / (steps * simulation.time_step);
        simulation.walls.tangential_velocity = [0.0, 0.0, -speed, speed];
        let (steps, time) = ((steps as u64).min(50), simulation.time);
        simulation.run(steps).unwrap();
        left -= speed * (simulation.time - time);
    }
    simulation.walls.stop();
    while unbalanced_force(simulation) > 1e-5 {
        simulation.run(500).unwrap();
    }
}

/// Top and bottom slide by ±2 mm, four tenths of a mean radius: friction acts on all walls.
#[test]
fn sliding_walls_agree_with_yade() {
    let mut simulation = read(REFERENCE, "state.json");
    slide(&mut simulation, 2e-3);
    let [.., top] = wall_forces(&simulation);
    assert!(top[1].abs() > 0.05 * top[0], "nothing to compare: {top:?}");
    compare("slide=2", &simulation, ALLOWED);
}
