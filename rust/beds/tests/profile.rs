//! Averages over a slab of a simple cubic crystal between walls, against closed forms.

use msdd_beds::named_gases::GasName;
use msdd_beds::network::{Materials, Network};
use msdd_beds::profile::{Probe, Width, slab};
use msdd_beds::property::Property;
use msdd_beds::solid::Solid;
use msdd_spheres::law::effective_modulus;
use msdd_spheres::{Boundary, Material, Simulation, Sphere, Stiffness, Wall};
use std::f64::consts::PI;

const RADIUS: f64 = 3.2e-3;
const OVERLAP: f64 = 1e-4;
const SIDE: usize = 5;
const LAYERS: usize = 12;

/// A crystal that touches all walls.
fn crystal() -> (Simulation, f64) {
    let spacing = 2.0 * RADIUS * (1.0 - OVERLAP);
    let spheres = (0..SIDE * SIDE * LAYERS)
        .map(|k| {
            let place = [k % SIDE, k / SIDE % SIDE, k / SIDE / SIDE];
            Sphere::at_rest(place.map(|x| spacing * (x as f64 + 0.5)), RADIUS, 7747.0)
        })
        .collect();
    let stiffness = Stiffness::HertzMindlin { young_modulus: 5e7, poisson_ratio: 0.29 };
    let material =
        Material { density: 7747.0, stiffness, friction: 0.3, wall_friction: 0.3, restitution: 0.3 };
    let size = [SIDE, SIDE, LAYERS].map(|n| spacing * n as f64);
    (Simulation::new(material, spheres, Boundary::Walls(Wall::block(size))).unwrap(), spacing)
}

/// E* of the material \[Pa\], of which the simulated one is a softer picture.
fn real_modulus() -> f64 {
    effective_modulus(2e11, 0.29)
}

/// Of steel in a gas.
fn network(simulation: &Simulation, gas: GasName) -> Network {
    let materials = Materials {
        conductivity: Property::Constant(42.0),
        heat_capacity: Property::Constant(464.0),
        effective_modulus: real_modulus(),
        roughness: None,
        gas,
        gas_pressure: 1e5,
        accommodation: 0.9,
        solid_fraction: None,
    };
    Network::new(simulation, materials, &[])
}

#[test]
fn a_slab_of_a_crystal_is_as_dense_stressed_and_conducting_as_the_crystal() {
    let (simulation, spacing) = crystal();
    let network = network(&simulation, GasName::Vacuum);
    let floor = Wall::at_rest([0.0; 3], [0.0, 0.0, 1.0]);
    let between = [2.0 * spacing, 9.0 * spacing];
    let area = (SIDE as f64 * spacing).powi(2);
    let found = slab(&simulation, &network, &floor, between, Width::Whole(area), 300.0).unwrap();
    assert!((found.coordination - 6.0).abs() < 1e-12, "{found:?}");
    let expected = PI / 6.0 / (1.0 - OVERLAP).powi(3);
    // The plane in the middle of a contact cuts off two thin caps.
    assert!((found.solid_fraction / expected - 1.0).abs() < 1e-6, "{found:?}");
    let force =
        4.0 / 3.0 * effective_modulus(5e7, 0.29) * (0.5 * RADIUS).sqrt() * (2.0 * RADIUS * OVERLAP).powf(1.5);
    // Links along the sides lie at the slab's height, those across at half heights; walls at the sides do not count: of each
    // row of five spheres along x and y four links are there.
    let across = (SIDE - 1) as f64 / SIDE as f64;
    let pressure = force / (spacing * spacing) * (1.0 + 2.0 * across) / 3.0;
    assert!((found.pressure / pressure - 1.0).abs() < 1e-9, "{found:?} {pressure}");
    let solid = Solid { conductivity: 42.0, effective_modulus: real_modulus(), roughness: None };
    let conductivity = 42.0 * solid.contact_size(force, 0.5 * RADIUS) / spacing;
    assert!((found.contact_conductivity / conductivity - 1.0).abs() < 1e-9, "{found:?} {conductivity}");
    assert_eq!(found.gas_conductivity, 0.0);
}

/// Rings share the solid, the heat and the spheres of the whole.
#[test]
fn rings_add_up_to_the_whole() {
    let (simulation, spacing) = crystal();
    let network = network(&simulation, GasName::Air);
    let floor = Wall::at_rest([0.0; 3], [0.0, 0.0, 1.0]);
    let between = [2.0 * spacing, 9.0 * spacing];
    let of = |width: Width| {
        let found = slab(&simulation, &network, &floor, between, width, 300.0).unwrap();
        let heat = found.contact_conductivity + found.gas_conductivity;
        [found.solid_fraction, heat, found.pressure].map(|mean| mean * width.area())
    };
    let whole = of(Width::Whole((SIDE as f64 * spacing).powi(2)));
    // The axis is an edge of the crystal, so rings beyond its other edge hold all of it.
    let far = 2.0 * SIDE as f64 * spacing;
    let rings = [[0.0, 2.2 * spacing], [2.2 * spacing, far], [0.0, far]].map(|ring| of(Width::Ring(ring)));
    for k in 0..3 {
        assert!((rings[0][k] + rings[1][k] - rings[2][k]).abs() < 1e-12 * whole[k], "{rings:?}");
        assert!((rings[2][k] - whole[k]).abs() < 1e-12 * whole[k], "{rings:?} {whole:?}");
        assert!(rings[0][k] > 0.05 * whole[k] && rings[0][k] < 0.3 * whole[k], "{rings:?} {whole:?}");
    }
}

/// A probe finds the temperature of a straight profile at any distance.
#[test]
fn a_probe_is_exact_for_straight_profiles() {
    let (simulation, _) = crystal();
    let floor = Wall::at_rest([0.0; 3], [0.0, 0.0, 1.0]);
    let temperatures: Vec<f64> = simulation.spheres.iter().map(|s| 300.0 + 400.0 * s.position[2]).collect();
    for distance in [0.02, 0.0305] {
        let probe = Probe::new(&simulation, &floor, [0.0, 0.0, 1.0], distance).unwrap();
        assert!((probe.temperature(&temperatures) - 300.0 - 400.0 * distance).abs() < 1e-9);
    }
    assert!(Probe::new(&simulation, &floor, [0.0, 0.0, 1.0], 0.2).is_none());
}
