//! Hashes of the states that the engine computes, compared with stored ones: the states must be the same on every
//! instruction set, any number of threads, and every platform.

use msdd_dem::{Disc, Simd, Thermal, WallHeat, Walls};
use msdd_rve::state::to_json;
use msdd_rve::{Compression, Material, PackingSpec, Protocol, Simulation, Strains, follow, pack};
use sha2::{Digest, Sha256};

/// 60 discs packed, expanded through two stops, heated.
const SMALL: &str = "ae64bdbe2a5168f7330aad957c6b61b703f92bb6ae20ed956a596fbccbabcb8a";
/// 4200 discs squeezed, sheared, grown and heated for 300 steps.
const LARGE: &str = "31d8e211c6b06c37446fb5a2e1793707ee9383968e41b96f82ff356823554487";

fn sha256(simulation: &Simulation) -> String {
    let digest = Sha256::digest(to_json(simulation).unwrap().as_bytes());
    digest.iter().map(|byte| format!("{byte:02x}")).collect()
}

fn assert_golden(name: &str, simulation: &Simulation, golden: &str, how: &str) {
    let found = sha256(simulation);
    assert_eq!(
        found, golden,
        "{how}: the engine gives other numbers than before. If this is on purpose, raise `ENGINE_VERSION` in \
         rust/rve/src/database/mod.rs and put {name} = \"{found}\""
    );
}

fn available() -> impl Iterator<Item = Simd> {
    Simd::ALL.into_iter().filter(|simd| simd.available())
}

/// The left wall is 20 K above the grains, the radii grow by 2 %; the right wall is cold, the bottom insulated, and 100
/// W come in through the top.
fn heat(simulation: &mut Simulation, steps: u64) {
    let walls =
        [WallHeat::Temperature(20.0), WallHeat::Temperature(0.0), WallHeat::Insulated, WallHeat::Flux(100.0)];
    simulation.enable_heat(Thermal::default(), walls);
    simulation.run(steps).unwrap();
    assert!(simulation.discs.iter().any(|d| d.temperature > 1.0), "no heat");
}

#[test]
fn a_small_rve_has_the_stored_bytes() {
    let compression = Compression::Horizontal;
    let spec = PackingSpec { discs: 60, seed: 5, porosity: 0.13, compression, ..PackingSpec::default() };
    for simd in available() {
        simd.prefer();
        let mut simulation = pack(&spec, &Material::default()).unwrap().simulation;
        assert_eq!(simulation.simd(), simd);
        let path = [0.01, 0.02].map(Strains::thermal);
        let ramp = follow(&mut simulation, &path, Protocol::default(), |_, _| ()).unwrap();
        assert_eq!((ramp.stops.len(), ramp.failure), (2, None));
        heat(&mut simulation, 300);
        assert_golden("SMALL", &simulation, SMALL, &format!("{simd:?}"));
    }
}

/// A jammed, jittered lattice with five contacts per disc, large enough to be divided into slabs.
fn large() -> Simulation {
    let material = Material::default();
    let discs = (0..4200)
        .map(|k| {
            let u = |a: f64| (a * f64::from(k + 1)).fract();
            let (x, y) = (f64::from(k % 70) + 0.5 + 0.2 * u(0.618_034), f64::from(k / 70) + 0.5);
            Disc::at_rest(0.0098 * x, 0.0098 * y, 4.5e-3 + 1e-3 * u(0.414_214), material.density)
        })
        .collect();
    let mut simulation = Simulation::new(material, discs, Walls::around(0.688, 0.588));
    simulation.walls.normal_velocity = [0.02, -0.02, 0.0, -0.01];
    simulation.walls.tangential_velocity = [0.0, 0.0, 0.02, 0.0];
    simulation.set_strain_rate(0.02);
    simulation.run(200).unwrap();
    simulation
}

#[test]
fn a_large_box_has_the_stored_bytes_on_any_number_of_threads() {
    for simd in available() {
        for threads in [1, 2] {
            let mut simulation = large();
            simulation.set_simd(simd);
            simulation.set_threads(threads).unwrap();
            heat(&mut simulation, 300);
            assert_golden("LARGE", &simulation, LARGE, &format!("{simd:?}, {threads} threads"));
        }
    }
}
