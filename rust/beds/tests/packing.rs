//! Packings: at rest under the pressure that was asked for, the same for the same seed.

use msdd_beds::sizes::{Sizes, sauter};
use msdd_beds::{Packing, pack};
use msdd_spheres::space::length;
use msdd_spheres::{Material, Simulation, Stiffness};

fn packing(friction: f64) -> Packing {
    Packing {
        spheres: 250,
        seed: 4,
        diameter: 2e-3,
        sizes: None,
        material: Material {
            density: 2500.0,
            stiffness: Stiffness::HertzMindlin { young_modulus: 1e9, poisson_ratio: 0.25 },
            friction,
            wall_friction: 0.0,
            restitution: 0.3,
        },
        pressure: 1e4,
        steps: 300_000,
    }
}

/// The largest resultant on a sphere over the mean normal force.
fn imbalance(simulation: &Simulation) -> f64 {
    let (mut sum, mut contacts) = (0.0, 0.0);
    simulation.for_each_contact(|contact| {
        sum += contact.normal_force;
        contacts += 1.0;
    });
    let largest = simulation.loads().iter().map(|load| length(load.force)).fold(0.0, f64::max);
    largest * contacts / sum
}

#[test]
fn a_packing_is_at_rest_under_its_pressure() {
    let packed = pack(&packing(0.3)).unwrap();
    assert!(packed.settled);
    let averages = &packed.averages;
    assert!((averages.pressure() / 1e4 - 1.0).abs() < 1e-4, "{averages:?}");
    assert!((0.56..0.61).contains(&averages.solid_fraction), "{averages:?}");
    assert!((4.2..4.9).contains(&averages.coordination), "{averages:?}");
    let imbalance = imbalance(&packed.simulation);
    assert!(imbalance < 1e-2, "{imbalance}");
    let again = pack(&packing(0.3)).unwrap();
    assert_eq!(again.simulation.state(), packed.simulation.state());
}

/// The spheres are those of the distribution, at rest under the pressure; a box too small for the largest ones is refused.
#[test]
fn a_packing_of_unequal_spheres_has_its_sizes() {
    let sizes = Sizes::Uniform([0.5, 1.5]);
    let unequal = Packing { sizes: Some(sizes.clone()), ..packing(0.3) };
    let packed = pack(&unequal).unwrap();
    assert!(packed.settled && (packed.averages.pressure() / 1e4 - 1.0).abs() < 1e-4, "{:?}", packed.averages);
    let mut found: Vec<f64> = packed.simulation.spheres.iter().map(|sphere| 2.0 * sphere.radius).collect();
    found.sort_unstable_by(|a, b| b.total_cmp(a));
    let wanted = sizes.diameters(250).into_iter().map(|d| 2e-3 * d);
    assert!(found.iter().zip(wanted).all(|(a, b)| (a / b - 1.0).abs() < 1e-12));
    assert!((sauter(&found) / 2e-3 - 1.0).abs() < 1e-12);
    assert!(imbalance(&packed.simulation) < 1e-2);
    let mixture = Sizes::Sieve(vec![[1.0, 0.0], [1.0, 0.5], [4.0, 0.5], [4.0, 1.0]]);
    let small = pack(&Packing { spheres: 60, sizes: Some(mixture), ..packing(0.3) }).unwrap_err();
    assert!(small.to_string().contains("edge over the largest diameter"), "{small}");
}

/// Without friction a packing needs six contacts per sphere to be rigid, and a stressed one has little more (Moukarzel,
/// Phys. Rev. Lett. 81, 1634, 1998). Friction makes packings looser.
#[test]
fn frictionless_packings_are_isostatic_and_denser() {
    let averages = pack(&packing(0.0)).unwrap().averages;
    let rough = pack(&packing(1.0)).unwrap().averages;
    assert!((5.9..6.5).contains(&averages.backbone_coordination), "{averages:?}");
    assert!(averages.solid_fraction > rough.solid_fraction + 0.04, "{averages:?} {rough:?}");
    assert!(rough.backbone_coordination < 4.8, "{rough:?}");
}

#[test]
fn bad_input_names_key_value_and_range() {
    let refused = |change: fn(&mut Packing)| {
        let mut bad = packing(0.3);
        change(&mut bad);
        pack(&bad).unwrap_err().to_string()
    };
    assert_eq!(refused(|p| p.spheres = 10), "packing: spheres = 10, allowed: 50 to 10000000");
    assert_eq!(refused(|p| p.diameter = -1.0), "packing: diameter = -1, allowed: above 0 m");
    assert_eq!(refused(|p| p.pressure = 1e9), "packing: pressure = 1000000000, allowed: below 0.01 E");
    assert_eq!(
        refused(|p| p.material.friction = -0.1),
        "material: friction = -0.1, allowed: 0, or 1e-30 to 1e30"
    );
}

/// The work of a slow deformation, −V σ : L dt, is what the contacts of an elastic packing without friction store. The
/// path compresses, stretches and shears, little enough that no contacts yield.
#[test]
fn work_of_a_deformation_is_stored() {
    let mut simulation = pack(&packing(0.0)).unwrap().simulation;
    let time = 2e-3 / (1e4f64 / 2500.0).sqrt();
    let strain = 2e-6;
    let rate = strain / (2.0 * time);
    let gradient = [[-rate, 0.7 * rate, 0.2 * rate], [0.0, 0.5 * rate, -0.4 * rate], [0.0, 0.0, -0.8 * rate]];
    let power = |simulation: &Simulation| {
        let stress = msdd_beds::averages::stress(simulation);
        let product: f64 = stress.iter().flatten().zip(gradient.iter().flatten()).map(|(s, l)| s * l).sum();
        -simulation.cell().unwrap().volume() * product
    };
    let begin = (simulation.energy(), simulation.time);
    simulation.set_velocity_gradient(gradient);
    let mut work = 0.0;
    while simulation.time < begin.1 + 2.0 * time {
        let before = power(&simulation);
        simulation.take_steps(1);
        work += 0.5 * (before + power(&simulation)) * simulation.time_step;
    }
    let energy = simulation.energy();
    let stored = energy.normal - begin.0.normal;
    let excess = (work - stored - (energy.kinetic - begin.0.kinetic)) / work;
    assert!((-1e-3..1e-2).contains(&excess), "{excess}");
    assert_eq!(energy.tangential, 0.0);
}

/// FIRE finds the equilibrium of a box that was compressed at once, keeps masses, time and volume, and leaves all at rest.
#[test]
fn relaxation_balances_the_forces() {
    let mut simulation = pack(&packing(0.3)).unwrap().simulation;
    let (start, pressure) = (simulation.clone(), msdd_beds::averages(&simulation).pressure());
    let factor = 1.0 - 2e-4;
    simulation.scale_cell(factor);
    simulation.take_steps(1);
    assert!(imbalance(&simulation) > 1e-2);
    assert!(simulation.relax(20_000, |simulation| imbalance(simulation) < 1e-5).unwrap());
    let averages = msdd_beds::averages(&simulation);
    assert!(averages.pressure() > 1.1 * pressure, "{averages:?} {pressure}");
    assert_eq!(simulation.kinetic_energy(), 0.0);
    let volumes = [&simulation, &start].map(|simulation| simulation.cell().unwrap().volume());
    assert!((volumes[0] / volumes[1] / factor.powi(3) - 1.0).abs() < 1e-12);
    assert!(simulation.spheres.iter().zip(&start.spheres).all(|(a, b)| a.mass == b.mass));
}
