//! Heat in time against closed forms: a chain of spheres, and balances of random beds.

use msdd_beds::exchange::{Emissivities, Tracing, exchange};
use msdd_beds::named_gases::GasName;
use msdd_beds::network::{Beside, Joint, Materials, Network, Plate, PlateLaw, Surfaces};
use msdd_beds::plate_view_areas::Facing;
use msdd_beds::property::Property;
use msdd_beds::radiation::STEFAN_BOLTZMANN;
use msdd_beds::radiation::factor;
use msdd_beds::rays::Enclosure;
use msdd_beds::transient::Transient;
use msdd_spheres::{Boundary, Material, Simulation, Sphere, Stiffness, Wall};
use std::f64::consts::PI;

fn materials(gas: GasName) -> Materials {
    Materials {
        conductivity: Property::Constant(42.0),
        heat_capacity: Property::Constant(464.0),
        effective_modulus: 1.1e11,
        roughness: None,
        gas,
        gas_pressure: 101_325.0,
        accommodation: 0.9,
        solid_fraction: None,
    }
}

/// A chain of equal spheres between two plates, with contacts of equal size; G = 2 k a.
fn chain(count: usize) -> Network {
    let size = 1e-4;
    let beside = |sphere, plate| Beside {
        plate,
        // As to the middle of a neighbour: with k of the plate without bound, G = 2 k_s size.
        size: 0.5 * size,
        conductivity: None,
        radius: 1e-3,
        facing: Facing { sphere, gap: 0.0, rings: Vec::new() },
    };
    Network {
        materials: materials(GasName::Vacuum),
        mass: vec![1e-3; count],
        radii: vec![1e-3; count],
        source: 0.0,
        contacts: (1..count).map(|j| Joint { i: j - 1, j, size, radius: 1e-3 }).collect(),
        gaps: Vec::new(),
        beside: vec![beside(0, 0), beside(count - 1, 1)],
        held: vec![None; count],
        surfaces: None,
    }
}

/// One wave of the chain fades as exp(−λ t), λ = 4 G/(m c) sin²(π/(2 (n + 1))).
fn amplitude(steps: usize) -> f64 {
    let count = 9;
    let network = chain(count);
    let mut transient = Transient::new(&network, 300.0, vec![300.0, 300.0]);
    for (k, t) in transient.temperatures.iter_mut().enumerate() {
        *t += (PI * (k + 1) as f64 / (count + 1) as f64).sin();
    }
    let rate = 4.0 * 42.0 * 1e-4 / (1e-3 * 464.0) * (PI / 2.0 / (count + 1) as f64).sin().powi(2);
    let end = 1.0 / rate;
    (0..steps).for_each(|_| {
        transient.step(end / steps as f64).unwrap();
    });
    (transient.temperatures[count / 2] - 300.0) / (-1.0f64).exp()
}

#[test]
fn a_wave_fades_as_it_should_and_in_second_order() {
    let errors = [10, 20, 40].map(|steps| (amplitude(steps) - 1.0).abs());
    assert!(errors[2] < 1e-4, "{errors:?}");
    for pair in errors.windows(2) {
        assert!((3.5..4.5).contains(&(pair[0] / pair[1])), "{errors:?}");
    }
}

/// Long after the start, temperatures between two plates are straight, and each plate gives what the other takes.
#[test]
fn the_steady_state_is_straight() {
    let count = 9;
    let network = chain(count);
    let mut transient = Transient::new(&network, 300.0, vec![310.0, 300.0]);
    // 30 times the time of the slowest wave, in long steps.
    for _ in 0..60 {
        transient.step(2000.0).unwrap();
    }
    for (k, t) in transient.temperatures.iter().enumerate() {
        let expected = 310.0 - 10.0 * (k + 1) as f64 / (count + 1) as f64;
        assert!((t - expected).abs() < 1e-9, "{k}: {t} {expected}");
    }
    let given = transient.given.clone();
    transient.step(100.0).unwrap();
    let flux = 42.0 * 1e-4 * 10.0 / (count + 1) as f64;
    for (k, sign) in [(0, 1.0), (1, -1.0)] {
        let power = (transient.given[k] - given[k]) / 100.0;
        assert!((power / (sign * flux) - 1.0).abs() < 1e-8, "{power} {flux}");
    }
}

/// Spheres that release heat Q each have 300 K + Q k (n + 1 − k)/(2 G) at rest.
#[test]
fn heat_from_inside_is_a_parabola() {
    let (count, released) = (9, 1e-3);
    let network = Network { source: released / (4.0 / 3.0 * PI * 1e-9), ..chain(count) };
    let mut transient = Transient::new(&network, 300.0, vec![300.0, 300.0]);
    transient.run_to(1e7, 0.01, &mut 1.0).unwrap();
    for (k, t) in (1..).zip(&transient.temperatures) {
        let expected = 300.0 + released * f64::from(k * (10 - k)) / (2.0 * 42.0 * 1e-4);
        assert!((t - expected).abs() < 1e-6, "{k}: {t} {expected}");
    }
    assert!(
        transient.residual().abs() < 1e-9 * released * 1e7 && (network.released() / 9e-3 - 1.0).abs() < 1e-12
    );
}

/// A sphere between two plates that radiate equally ends at the mean of the fourth powers, and what passes is σ (T₁⁴ − T₂⁴) of half of the size.
#[test]
fn a_sphere_radiates_by_fourth_powers() {
    let size = 1e-5;
    let surfaces = Surfaces {
        emissivity: Property::Constant(1.0),
        traced: 1.0,
        spheres: Vec::new(),
        plates: vec![(0, 0, size), (0, 1, size)],
    };
    let network = Network { beside: Vec::new(), surfaces: Some(surfaces), ..chain(1) };
    let mut transient = Transient::new(&network, 500.0, vec![1000.0, 300.0]);
    let mut step = 1.0;
    transient.run_to(1e6, 0.01, &mut step).unwrap();
    let expected = (0.5 * (1e12 + 300f64.powi(4))).powf(0.25);
    assert!((transient.temperatures[0] / expected - 1.0).abs() < 1e-8, "{:?}", transient.temperatures);
    let given = transient.given[0];
    transient.step(100.0).unwrap();
    let flux = 0.5 * size * STEFAN_BOLTZMANN * (1e12 - 300f64.powi(4));
    assert!(((transient.given[0] - given) / 100.0 / flux - 1.0).abs() < 1e-8);
}

/// Radiation of a whole bed, of poor conductors: the balance closes, and it warms faster than without.
#[test]
fn a_bed_that_radiates_keeps_its_balance() {
    let simulation = bed();
    let enclosure = Enclosure::new(&simulation);
    let walls = simulation.boundary.walls().len();
    let mut emissivities = Emissivities { spheres: 0.8, walls: vec![0.0; walls] };
    emissivities.walls[4] = 0.8;
    let traced = exchange(&enclosure, &emissivities, &Tracing { rays: 200, seed: 1, threads: 1 }).unwrap();
    let materials = Materials {
        conductivity: Property::Constant(2.0),
        solid_fraction: Some(0.55),
        ..materials(GasName::Air)
    };
    let stored = |radiates: bool, law: PlateLaw| {
        let network = Network::new(&simulation, materials.clone(), &[Plate { wall: 4, law }]);
        let network = if radiates { network.radiating(Some(&traced), None, &[4]) } else { network };
        let mut transient = Transient::new(&network, 600.0, vec![1200.0]);
        transient.run_to(20.0, 0.05, &mut 0.1).unwrap();
        let (stored, residual) = (transient.stored(), transient.residual());
        assert!(residual.abs() < 1e-9 * stored, "{law:?} {residual} of {stored}");
        assert!(transient.temperatures.iter().all(|t| (600.0 - 1e-6..1200.0 + 1e-6).contains(t)));
        stored
    };
    for law in LAWS {
        let [dark, bright] = [false, true].map(|radiates| stored(radiates, law));
        assert!(bright > 1.2 * dark, "{law:?} {bright} {dark}");
    }
    // A table has what rays with its value have, as the law says.
    let table = Some(Property::Table(vec![[600.0, 0.8], [1200.0, 0.4]]));
    let radiating = |emissivity: Option<Property>, t: f64| {
        let network = Network::new(&simulation, Materials { solid_fraction: None, ..materials.clone() }, &[]);
        let network = network.radiating(Some(&traced), emissivity, &[]);
        network.conductances(&vec![t; simulation.spheres.len()], &[]).links.last().map_or(0.0, |link| link.2)
    };
    assert_eq!(radiating(table.clone(), 600.0), radiating(None, 600.0));
    let found = radiating(table, 1200.0) / radiating(None, 1200.0);
    assert!((found - factor(0.4, 0.6) / factor(0.8, 0.6)).abs() < 1e-12, "{found}");
}

/// Spheres on a lattice in a box whose floor is a plate; they press on each other and on the floor.
fn bed() -> Simulation {
    let (radius, side) = (3e-3, 4);
    let stiffness = Stiffness::HertzMindlin { young_modulus: 5e7, poisson_ratio: 0.29 };
    let material =
        Material { density: 7747.0, stiffness, friction: 0.3, wall_friction: 0.3, restitution: 0.3 };
    let spacing = 2.0 * radius * (1.0 - 1e-4);
    let spheres: Vec<Sphere> = (0..side * side * side)
        .map(|k| {
            let place = [k % side, k / side % side, k / side / side];
            Sphere::at_rest(place.map(|x| spacing * (x as f64 + 0.5)), radius, 7747.0)
        })
        .collect();
    let walls = Wall::block([spacing * side as f64; 3]);
    Simulation::new(material, spheres, Boundary::Walls(walls)).unwrap()
}

const LAWS: [PlateLaw; 2] = [
    PlateLaw::Held,
    PlateLaw::Resisting { conductivity: Some(250.0), effective_modulus: 6e10, roughness: None },
];

/// What the spheres store is what the plate gave, with properties that depend on temperature; no sphere gets hotter than
/// the plate or colder than the start.
#[test]
fn the_balance_of_heat_closes() {
    let simulation = bed();
    let materials = Materials {
        conductivity: Property::Table(vec![[280.0, 60.0], [400.0, 50.0]]),
        heat_capacity: Property::Table(vec![[280.0, 430.0], [300.0, 440.0], [400.0, 490.0]]),
        ..materials(GasName::Air)
    };
    for law in LAWS {
        let network = Network::new(&simulation, materials.clone(), &[Plate { wall: 4, law }]);
        let mut transient = Transient::new(&network, 293.15, vec![326.15]);
        let mut step = 0.1;
        transient.run_to(100.0, 0.05, &mut step).unwrap();
        let (stored, residual) = (transient.stored(), transient.residual());
        assert!(stored > 10.0, "{law:?} {stored}");
        assert!(residual.abs() < 1e-9 * stored, "{law:?} {residual} of {stored}");
        assert!(transient.temperatures.iter().all(|t| (293.15 - 1e-6..326.15 + 1e-6).contains(t)));
        assert_eq!(transient.time, 100.0);
    }
}

/// Smaller tolerances give smaller errors, and more steps.
#[test]
fn adaptive_steps_keep_their_tolerance() {
    let simulation = bed();
    let network = Network::new(&simulation, materials(GasName::Air), &[Plate { wall: 4, law: LAWS[1] }]);
    let run = |tolerance: f64| {
        let mut transient = Transient::new(&network, 293.15, vec![326.15]);
        let mut step = 1.0;
        transient.run_to(60.0, tolerance, &mut step).unwrap();
        (transient.temperatures[40], transient.steps)
    };
    let (fine, coarse, medium) = (run(1e-4), run(0.3), run(0.03));
    assert!(
        (coarse.0 - fine.0).abs() < 0.3 && (medium.0 - fine.0).abs() < 0.03,
        "{fine:?} {coarse:?} {medium:?}"
    );
    assert!(coarse.1 < medium.1 && medium.1 < fine.1);
}

/// Held spheres pass on more than a plate with a resistance of its own; a vacuum passes on less than air; a gas at low
/// pressure lies between.
#[test]
fn more_ways_pass_more_heat() {
    let simulation = bed();
    let stored = |gas: GasName, gas_pressure: f64, law: PlateLaw| {
        let materials = Materials { gas_pressure, ..materials(gas) };
        let network = Network::new(&simulation, materials, &[Plate { wall: 4, law }]);
        let mut transient = Transient::new(&network, 293.15, vec![326.15]);
        let mut step = 1.0;
        transient.run_to(30.0, 0.05, &mut step).unwrap();
        let held = network.held.iter().filter(|held| held.is_some()).count();
        (transient.stored(), held)
    };
    let [held, law] = LAWS.map(|law| stored(GasName::Air, 1e5, law));
    assert_eq!((held.1, law.1), (16, 0));
    let [vacuum, thin] =
        [(GasName::Vacuum, 1e5), (GasName::Air, 1e2)].map(|(gas, pressure)| stored(gas, pressure, LAWS[1]));
    assert!(vacuum.0 < thin.0 && thin.0 < law.0, "{vacuum:?} {thin:?} {law:?}");
}

/// Small grains follow their neighbours at once, and much more heat passes through them in a step than they hold: the steady state
/// is reached all the same, and the balance closes.
#[test]
fn grains_of_ten_micrometres_come_to_the_steady_state() {
    let (radius, count) = (5e-6, 9);
    let size = 1e-2 * radius;
    let mut network = chain(count);
    network.mass = vec![7747.0 * 4.0 / 3.0 * PI * radius * radius * radius; count];
    network.contacts.iter_mut().for_each(|contact| contact.size = size);
    network.beside.iter_mut().for_each(|beside| (beside.size, beside.radius) = (0.5 * size, radius));
    let mut transient = Transient::new(&network, 300.0, vec![310.0, 300.0]);
    let mut step = 1e-6;
    transient.run_to(1000.0, 0.05, &mut step).unwrap();
    for (k, t) in transient.temperatures.iter().enumerate() {
        let expected = 310.0 - 10.0 * (k + 1) as f64 / (count + 1) as f64;
        assert!((t - expected).abs() < 1e-6, "{k}: {t} {expected}");
    }
    let passed = transient.given[0];
    assert!(transient.residual().abs() < 1e-9 * passed, "{} of {passed}", transient.residual());
}
