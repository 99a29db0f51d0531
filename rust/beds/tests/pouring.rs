//! Beds that were poured: at rest, their weight borne, the same for the same seed whatever the threads; the walls of a
//! cylinder and a lid carry what balances and Janssen say.

use msdd_beds::BedError;
use msdd_beds::pour::{Container, Pouring, pour};
use msdd_beds::press::press;
use msdd_beds::settle::{Rest, settle, turn};
use msdd_beds::sizes::Sizes;
use msdd_spheres::{Boundary, Material, Simulation, Sphere, Stiffness};

const G: f64 = 9.81;

fn pouring(container: Container, spheres: usize) -> Pouring {
    Pouring {
        spheres,
        seed: 3,
        diameter: 4e-3,
        sizes: None,
        material: Material {
            density: 2500.0,
            stiffness: Stiffness::HertzMindlin { young_modulus: 2e7, poisson_ratio: 0.25 },
            friction: 0.3,
            wall_friction: 0.3,
            restitution: 0.5,
        },
        container,
        gravity: G,
        longest: 3.0,
        threads: 1,
    }
}

fn weight(simulation: &Simulation) -> f64 {
    G * simulation.spheres.iter().map(|sphere| sphere.mass).sum::<f64>()
}

/// All walls together carry the weight, and nothing along the other axes.
fn check_balance(simulation: &Simulation, rest: &Rest, up: usize) {
    assert!(rest.at_rest, "{rest:?}");
    let weight = weight(simulation);
    for axis in 0..3 {
        let borne: f64 = simulation.wall_force.iter().map(|force| force[axis]).sum();
        let expected = if axis == up { -weight } else { 0.0 };
        assert!((borne - expected).abs() < 2e-3 * weight, "axis {axis}: {borne} {expected}");
    }
}

#[test]
fn a_box_bears_the_weight_of_its_grains() {
    let (simulation, rest) = pour(&pouring(Container::Box { base: [0.03, 0.04] }, 250), |_| ()).unwrap();
    check_balance(&simulation, &rest, 2);
    assert_eq!(simulation.spheres.len(), 250);
    let inside = |p: [f64; 3]| (0.0..0.03).contains(&p[0]) && (0.0..0.04).contains(&p[1]) && p[2] > 0.0;
    assert!(simulation.spheres.iter().all(|sphere| inside(sphere.position)));
}

#[test]
fn unequal_grains_come_to_rest_and_weigh_what_their_sizes_say() {
    let sizes = Sizes::LogNormal(0.3);
    let mut bed = pouring(Container::Box { base: [0.03, 0.04] }, 250);
    bed.sizes = Some(sizes.clone());
    let (simulation, rest) = pour(&bed, |_| ()).unwrap();
    check_balance(&simulation, &rest, 2);
    let volume: f64 =
        sizes.diameters(250).iter().map(|d| std::f64::consts::PI / 6.0 * (4e-3 * d).powi(3)).sum();
    assert!((weight(&simulation) / (G * 2500.0 * volume) - 1.0).abs() < 1e-12);
    bed.threads = 2;
    assert_eq!(pour(&bed, |_| ()).unwrap().0.state(), simulation.state());
}

/// Janssen's experiment: the floor of a tall cylinder sinks a little, so that the grains slide down along the side, whose
/// friction then carries what his formula says with a ratio of the stresses between 0.4 and 1.
#[test]
fn the_side_of_a_cylinder_bears_a_part() {
    let radius = 0.012;
    let (mut simulation, rest) = pour(&pouring(Container::Cylinder { radius }, 400), |_| ()).unwrap();
    check_balance(&simulation, &rest, 2);
    let Boundary::Walls(walls) = &mut simulation.boundary else { unreachable!() };
    walls[0].velocity[2] = -0.01;
    simulation.drag = 10.0;
    let (mut floor, mut looks) = (0.0, 0.0);
    let end = simulation.time + 0.3;
    while simulation.time < end {
        simulation.run(20).unwrap();
        if simulation.time > end - 0.15 {
            (floor, looks) = (floor - simulation.wall_force[0][2], looks + 1.0);
        }
    }
    let share = 1.0 - floor / looks / weight(&simulation);
    let top = simulation.spheres.iter().map(|s| s.position[2] + s.radius).fold(0.0, f64::max);
    let height = top - simulation.boundary.walls()[0].point[2];
    let janssen = |ratio: f64| {
        let depth = radius / (2.0 * 0.3 * ratio);
        1.0 - depth / height * (1.0 - (-height / depth).exp())
    };
    assert!(share > janssen(0.4) && share < janssen(1.0), "{share} {} {}", janssen(0.4), janssen(1.0));
    let off = simulation.spheres.iter().map(|s| s.position[0].hypot(s.position[1])).fold(0.0, f64::max);
    assert!(off < radius - 2e-3 + 5e-5, "{off}");
}

#[test]
fn a_lid_bears_its_pressure_and_a_turned_bed_its_weight() {
    let base = [0.03, 0.04];
    let (mut simulation, _) = pour(&pouring(Container::Box { base }, 250), |_| ()).unwrap();
    let (pressure, area) = (500.0, base[0] * base[1]);
    let rest = press(&mut simulation, 5, (pressure, area), 3.0, |_| ()).unwrap();
    assert!(rest.at_rest, "{rest:?}");
    assert!((simulation.wall_force[5][2] / (pressure * area) - 1.0).abs() < 5e-3);
    turn(&mut simulation, [0.0, -1.0, 0.0], 0.1, |_| ()).unwrap();
    let rest = settle(&mut simulation, 3.0, |_| ()).unwrap();
    check_balance(&simulation, &rest, 1);
}

/// A lid with a twentieth of the weight of a layer comes to rest, on grains whose tops are level, so that it meets all of them.
#[test]
fn a_light_lid_comes_to_rest() {
    let base = [0.016, 0.016];
    let Pouring { material, gravity, diameter: d, .. } = pouring(Container::Box { base }, 48);
    let place = |k: usize| [k % 4, k / 4 % 4, k / 16].map(|n| d * (n as f64 + 0.5));
    let spheres = (0..48).map(|k| Sphere::at_rest(place(k), 0.5 * d, material.density)).collect();
    let walls = Container::Box { base }.walls(0.02).into_iter().map(|(_, wall)| wall).collect();
    let mut simulation = Simulation::new(material, spheres, Boundary::Walls(walls)).unwrap();
    simulation.gravity = [0.0, 0.0, -gravity];
    assert!(settle(&mut simulation, 3.0, |_| ()).unwrap().at_rest);
    let (pressure, area) = (0.05 * simulation.spheres[0].mass * gravity / (d * d), base[0] * base[1]);
    let rest = press(&mut simulation, 5, (pressure, area), 3.0, |_| ()).unwrap();
    assert!(rest.at_rest, "{rest:?}");
    assert!((simulation.wall_force[5][2] / (pressure * area) - 1.0).abs() < 5e-3);
}

/// More than 4 000 grains are shared between threads.
#[test]
fn the_same_seed_gives_the_same_bytes() {
    let run = |threads: usize, seed: u64| {
        let container = Container::Box { base: [0.06, 0.06] };
        let pouring = Pouring { threads, seed, longest: 0.01, ..pouring(container, 5000) };
        pour(&pouring, |_| ()).unwrap().0.state()
    };
    let alone = run(1, 3);
    assert!(run(2, 3) == alone);
    assert!(run(1, 4) != alone);
}

#[test]
fn bad_parameters_are_refused_with_their_names() {
    let refused = |pouring: Pouring| pour(&pouring, |_| ()).unwrap_err().to_string();
    let good = pouring(Container::Box { base: [0.03, 0.04] }, 100);
    assert_eq!(
        refused(Pouring { diameter: -1.0, ..good.clone() }),
        "pouring: diameter = -1, allowed: above 0 m"
    );
    let narrow = Container::Cylinder { radius: 3e-3 };
    assert!(refused(Pouring { container: narrow, ..good.clone() }).contains("size"));
    let wide = Container::Cylinder { radius: 20.0 };
    assert!(refused(Pouring { container: wide, ..good.clone() }).contains("10 squares of the diameter"));
    assert!(refused(Pouring { spheres: 0, ..good.clone() }).contains("spheres"));
    let (mut simulation, _) =
        pour(&Pouring { longest: 1e-3, ..pouring(Container::Cylinder { radius: 0.02 }, 10) }, |_| ())
            .unwrap();
    assert_eq!(press(&mut simulation, 1, (1.0, 1.0), 1.0, |_| ()).unwrap_err(), BedError::NotFlat);
}
