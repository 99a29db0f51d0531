//! Heat conduction, alone and with motion, compared with closed forms.

use msdd_dem::{Disc, Material, Side, Simulation, Thermal, WallHeat, Walls};
use std::f64::consts::PI;

const R: f64 = 5e-3;
const COUNT: usize = 12;

/// Equal discs in a row along x that overlap each other by `overlap` and the two walls by half of it.
fn chain(overlap: f64, thermal: Thermal, heat: [WallHeat; 4]) -> Simulation {
    let spacing = 2.0 * R - overlap;
    let material = Material { damping: 0.5, ..Material::default() };
    let discs =
        (0..COUNT).map(|k| Disc::at_rest(spacing * (k as f64 + 0.5), 0.0, R, material.density)).collect();
    let walls = Walls { position: [0.0, spacing * COUNT as f64, -1.0, 1.0], ..Walls::around(1.0, 1.0) };
    let mut simulation = Simulation::new(material, discs, walls);
    simulation.enable_heat(thermal, heat);
    simulation
}

fn hot_ends(temperature: f64) -> [WallHeat; 4] {
    let wall = WallHeat::Temperature(temperature);
    [wall, wall, WallHeat::Insulated, WallHeat::Insulated]
}

/// h/(m c) of a pair of the chain [1/s]. A wall's conductance is twice that of a pair: the same chord at half the
/// length.
fn pair_rate(overlap: f64) -> f64 {
    let length = 2.0 * R - overlap;
    let chord = 2.0 * (R * R - 0.25 * length * length).sqrt();
    100.0 * chord / length / (3000.0 * PI * R * R)
}

/// Walls that turn hot heat a resting chain as T_k = T_w (1 − Σ_p b_p sin(pπ(k+½)/n) exp(−λ_p t)), with λ_p = 2h/(mc)
/// (1 − cos(pπ/n)) and b_p from the uniform start. Explicit Euler replaces exp(−λ_p t) by (1 − λ_p Δt)^N; with that
/// factor the temperatures must agree to round-off.
#[test]
fn chain_heats_up_as_its_eigenmodes_say() {
    let overlap = 2e-4;
    let n = COUNT as f64;
    let mut simulation = chain(overlap, Thermal { expansion: 0.0, ..Thermal::default() }, hot_ends(100.0));
    let slowest = 2.0 * pair_rate(overlap) * (1.0 - (PI / n).cos());
    let (steps, dt) = (2000, 0.5e-3 / slowest);
    (0..steps).for_each(|_| simulation.conduct(dt));
    assert_eq!(simulation.heat().unwrap().substeps, steps);
    let mode = |p: usize, k: usize| (p as f64 * PI * (k as f64 + 0.5) / n).sin();
    let series = |k: usize, decay: &dyn Fn(f64) -> f64| {
        let sum: f64 = (1..=COUNT)
            .map(|p| {
                let (one, norm) =
                    (0..COUNT).fold((0.0, 0.0), |(a, b), l| (a + mode(p, l), b + mode(p, l).powi(2)));
                let rate = 2.0 * pair_rate(overlap) * (1.0 - (p as f64 * PI / n).cos());
                one / norm * mode(p, k) * decay(rate)
            })
            .sum();
        100.0 * (1.0 - sum)
    };
    for (k, disc) in simulation.discs.iter().enumerate() {
        let euler = series(k, &|rate| (1.0 - rate * dt).powi(steps as i32));
        let exact = series(k, &|rate| (-rate * dt * steps as f64).exp());
        assert!((disc.temperature - euler).abs() < 1e-9, "{k}: {} {euler}", disc.temperature);
        assert!((disc.temperature - exact).abs() < 0.05, "{k}: {} {exact}", disc.temperature);
    }
    // The chain is in the middle of its heating: the ends are warm, the middle is not.
    assert!(simulation.discs[0].temperature > 80.0 && simulation.discs[COUNT / 2].temperature < 70.0);
}

/// A chain heated to T through its walls cannot expand and is compressed: 2 n r' − L = F ((n−1)/s_n + 2/s_w), r' = r (1
/// + α T), s_n = E r', s_w = a E r' with the wall factor a; so F = E r' (2 n r' − L)/(n − 1 + 2/a).
#[test]
fn heated_chain_presses_on_its_walls() {
    for factor in [1.0, 2.0] {
        let overlap = 2e-5;
        let mut simulation = chain(overlap, Thermal::default(), hot_ends(20.0));
        simulation.material.wall_stiffness_factor = factor;
        simulation.run(40_000).unwrap();
        assert!(simulation.discs.iter().all(|d| (d.temperature - 20.0).abs() < 1e-9 && d.y == 0.0));
        let (n, radius) = (COUNT as f64, R * 1.02);
        let squeeze = 2.0 * n * radius - n * (2.0 * R - overlap);
        let expected = 1e7 * radius * squeeze / (n - 1.0 + 2.0 / factor);
        for side in [Side::Left, Side::Right] {
            let [normal, tangential] = simulation.wall_force[side as usize];
            assert!((normal / expected - 1.0).abs() < 1e-6, "{normal} {expected}");
            assert_eq!(tangential, 0.0);
        }
    }
}

/// In a heap that moves, slides, expands and makes and breaks contacts, the heat that came in through the walls equals
/// the heat stored in the discs to round-off.
#[test]
fn wall_heat_is_stored_in_a_moving_heap() {
    let material = Material::default();
    let discs: Vec<Disc> = (0..120)
        .map(|k| {
            let u = |a: f64| (a * f64::from(k + 1)).fract();
            let (column, line) = (f64::from(k % 12), f64::from(k / 12));
            let radius = 3.5e-3 + 3e-3 * u(0.618_034);
            let mut disc =
                Disc::at_rest(0.0105 * (column + 0.6), 0.0105 * (line + 0.6), radius, material.density);
            disc.vx = 0.1 * (u(0.414_214) - 0.5);
            disc.temperature = 10.0 * u(0.732_051);
            disc
        })
        .collect();
    let mut simulation = Simulation::new(material, discs, Walls::around(0.128, 0.107));
    let content = |s: &Simulation| s.discs.iter().map(|d| d.mass * d.temperature).sum::<f64>();
    let start = content(&simulation);
    let heat =
        [WallHeat::Temperature(60.0), WallHeat::Temperature(-20.0), WallHeat::Flux(5.0), WallHeat::Insulated];
    simulation.enable_heat(Thermal::default(), heat);
    simulation.walls.normal_velocity = [0.005, -0.005, 0.002, -0.002];
    let rebuilds = simulation.rebuilds();
    for _ in 0..10 {
        simulation.run(400).unwrap();
        let wall = simulation.heat().unwrap().wall_heat;
        let gross = start + wall.iter().map(|q| q.abs()).sum::<f64>();
        let error = wall.iter().sum::<f64>() - (content(&simulation) - start);
        assert!(error.abs() < 1e-12 * gross, "{error} of {gross}");
    }
    let [left, right, bottom, top] = simulation.heat().unwrap().wall_heat;
    assert!(left > 1.0 && right < -1.0 && top == 0.0, "{left} {right}");
    // The prescribed flux enters only while a disc touches the bottom.
    let most = 5.0 * simulation.time;
    assert!(bottom > 0.5 * most && bottom < most * (1.0 + 1e-9), "{bottom} {most}");
    assert!(simulation.rebuilds() > rebuilds);
}
