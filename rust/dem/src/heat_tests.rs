//! Heat conduction compared with closed forms.

use super::*;
use crate::{Material, Simulation, Walls};

const R: f64 = 5e-3;
const OVERLAP: f64 = 2e-4;

/// A row of `count` discs along x, pressed together so that all overlaps are equal, and held in place.
fn chain(count: usize, walls: [WallHeat; 4]) -> Simulation {
    let spacing = 2.0 * R - OVERLAP;
    let discs = (0..count).map(|k| Disc::at_rest(spacing * k as f64, 0.0, R, 3000.0)).collect();
    let reach = R - 0.5 * OVERLAP;
    let box_walls = Walls {
        position: [-reach, spacing * (count - 1) as f64 + reach, -1.0, 1.0],
        ..Walls::around(1.0, 1.0)
    };
    let mut simulation = Simulation::new(Material::default(), discs, box_walls);
    simulation.enable_heat(Thermal { expansion: 0.0, ..Thermal::default() }, walls);
    simulation
}

fn pair_conductance() -> f64 {
    let d = 2.0 * R - OVERLAP;
    100.0 * 2.0 * (R * R - 0.25 * d * d).sqrt() / d
}

const INSULATED: [WallHeat; 4] = [WallHeat::Insulated; 4];

/// Two discs relax as exp(−2 h t/(m c)).
#[test]
fn two_discs_equalise_exponentially() {
    let mut simulation = chain(2, INSULATED);
    simulation.discs[0].temperature = 100.0;
    let rate = 2.0 * pair_conductance() / simulation.discs[0].mass;
    let dt = 1e-4 / rate;
    (0..10_000).for_each(|_| simulation.conduct(dt));
    let difference = simulation.discs[0].temperature - simulation.discs[1].temperature;
    let expected = 100.0 * (-1.0f64).exp();
    assert!((difference / expected - 1.0).abs() < 1e-4, "{difference} {expected}");
}

/// Between walls of fixed temperature the chain reaches the linear profile of resistances in series, and the heat that
/// came in through the walls is m c ΔT to round-off.
#[test]
fn chain_between_two_temperatures() {
    let count = 8;
    let mut walls = INSULATED;
    (walls[0], walls[1]) = (WallHeat::Temperature(100.0), WallHeat::Temperature(20.0));
    let mut simulation = chain(count, walls);
    (0..4000).for_each(|_| simulation.conduct(0.01));
    let pair = pair_conductance();
    // A wall's conductance is twice that of a pair: the wall lies in the plane of symmetry, so the chord is the same
    // and the length is half.
    let wall = 2.0 * pair;
    let flow = 80.0 / ((count - 1) as f64 / pair + 2.0 / wall);
    for (k, disc) in simulation.discs.iter().enumerate() {
        let expected = 100.0 - flow * (1.0 / wall + k as f64 / pair);
        assert!((disc.temperature - expected).abs() < 1e-9, "{k}: {} {expected}", disc.temperature);
    }
    audit(&simulation);
}

/// Σ wall heat = Σ m c T (all started at 0 K).
fn audit(simulation: &Simulation) {
    let stored: f64 = simulation.discs.iter().map(|d| d.mass * d.temperature).sum();
    let [a, b, c, d] = simulation.heat().unwrap().wall_heat;
    let gross = a.abs() + b.abs() + c.abs() + d.abs();
    assert!((a + b + c + d - stored).abs() < 1e-12 * gross, "{} {stored}", a + b + c + d);
}

/// A fixed flux heats the insulated chain as a whole: mean T = q t / Σ m c.
#[test]
fn flux_heats_as_prescribed() {
    let mut walls = INSULATED;
    walls[0] = WallHeat::Flux(3.0);
    let mut simulation = chain(5, walls);
    (0..100).for_each(|_| simulation.conduct(0.01));
    let mass: f64 = simulation.discs.iter().map(|d| d.mass).sum();
    let mean = simulation.discs.iter().map(|d| d.mass * d.temperature).sum::<f64>() / mass;
    assert!((mean * mass / 3.0 - 1.0).abs() < 1e-12);
    assert!(simulation.discs[0].temperature > simulation.discs[4].temperature);
    audit(&simulation);
}

/// The bound from the power iteration agrees with the largest eigenvalue of a chain: λ = 2h/(mc) (1 + cos(π/n)).
#[test]
fn stable_step_of_a_chain_is_exact() {
    let count = 6;
    let mut simulation = chain(count, INSULATED);
    (0..200).for_each(|_| simulation.conduct(1e-6));
    let mass = simulation.discs[0].mass;
    let angle = std::f64::consts::PI / count as f64;
    let largest = 2.0 * pair_conductance() / mass * (1.0 + angle.cos());
    let step = simulation.heat().unwrap().stable_step();
    assert!((step * largest / 2.0 - 1.0).abs() < 1e-3, "{step} {}", 2.0 / largest);
}

/// Heated discs grow by r_ref α ΔT, and the sub-steps remain stable however long the mechanical step is.
#[test]
fn long_steps_stay_bounded_and_discs_grow() {
    let mut walls = INSULATED;
    walls[1] = WallHeat::Temperature(50.0);
    let mut simulation = chain(3, walls);
    simulation.enable_heat(Thermal::default(), walls);
    simulation.material.damping = 0.5;
    simulation.run(20_000).unwrap();
    for disc in &simulation.discs {
        assert!((0.0..=50.0 + 1e-9).contains(&disc.temperature));
        assert!((disc.radius - R * (1.0 + 1e-3 * disc.temperature)).abs() < 1e-6 * R);
    }
    assert!(simulation.discs[0].temperature > 40.0);
    simulation.conduct(10.0);
    assert!(simulation.discs.iter().all(|d| (0.0..=50.0 + 1e-9).contains(&d.temperature)));
    audit(&simulation);
}
