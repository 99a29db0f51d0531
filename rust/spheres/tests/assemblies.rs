//! Many spheres: what is conserved, what does not depend on how it is computed.

mod common;

use common::{SPACING, bits, free, glass, shaken};
use msdd_spheres::space::length;
use msdd_spheres::{Boundary, Cell, Material, Simd, Simulation, Sphere, State, Stiffness, Wall};

fn rough() -> Material {
    Material { friction: 0.4, wall_friction: 0.2, restitution: 0.7, ..glass() }
}

/// Friction and damping act along equal and opposite forces in one point: they change neither momentum nor angular
/// momentum.
#[test]
fn momentum_and_angular_momentum_are_conserved() {
    let mut simulation = free(rough(), shaken(5, 1e-3, &rough()));
    let (linear, angular) = (simulation.momentum(), simulation.angular_momentum());
    simulation.run(2000).unwrap();
    let (after, angular_after) = (simulation.momentum(), simulation.angular_momentum());
    let sum = |of: fn(&Sphere) -> f64| simulation.spheres.iter().map(of).sum::<f64>();
    let scale = sum(|s| s.mass * length(s.velocity));
    let angular_scale = sum(|s| s.mass * length(s.velocity) * length(s.position));
    for k in 0..3 {
        assert!((after[k] - linear[k]).abs() < 1e-13 * scale, "{linear:?} {after:?}");
        assert!(
            (angular_after[k] - angular[k]).abs() < 1e-13 * angular_scale,
            "{angular:?} {angular_after:?}"
        );
    }
    assert!(sum(|s| length(s.angular_velocity)) > 0.0);
}

/// An elastic system without friction keeps its energy up to the error of the time step, which is of second order.
#[test]
fn an_elastic_system_keeps_its_energy() {
    let drift = |safety: f64| {
        let side = 5;
        let cell = Cell::block([side as f64 * SPACING; 3]);
        let spheres = shaken(side, 1e-3, &glass());
        let mut simulation = Simulation::new(glass(), spheres, Boundary::Periodic(cell)).unwrap();
        simulation.time_step = safety * simulation.stable_step();
        let step = simulation.time_step;
        let before = simulation.energy().total();
        simulation.take_steps((2e-4 / step) as u64);
        (simulation.energy().total() / before - 1.0).abs()
    };
    let (coarse, fine) = (drift(0.2), drift(0.05));
    assert!(coarse < 1e-2 && fine < 1.5e-3, "{coarse} {fine}");
}

/// With friction and damping the stored energy never grows beyond what the integrator's error makes.
#[test]
fn friction_and_damping_take_energy_away() {
    let cell = Cell::block([5.0 * SPACING; 3]);
    let mut simulation =
        Simulation::new(rough(), shaken(5, 1e-3, &rough()), Boundary::Periodic(cell)).unwrap();
    let begin = simulation.energy().total();
    let mut last = begin;
    for _ in 0..40 {
        simulation.run(100).unwrap();
        let energy = simulation.energy().total();
        assert!(energy < last + 1e-3 * begin, "{energy} after {last}");
        last = energy;
    }
    assert!(last < 0.7 * begin, "{last} of {begin}");
}

fn boxes(side: usize) -> [Simulation; 2] {
    let size = [side as f64 * SPACING; 3];
    let mut cell = Cell::block(size);
    cell.lattice.edges[1][0] = 0.3e-3;
    cell.lattice.edges[2][1] = -0.2e-3;
    cell.velocity_gradient = [[-3.0, 5.0, 0.0], [0.0, 2.0, 1.0], [0.0, 0.0, -4.0]];
    let mut walls = Wall::block(size);
    walls[5].velocity = [0.02, 0.0, -0.01];
    [Boundary::Periodic(cell), Boundary::Walls(walls)].map(|boundary| {
        let mut simulation = Simulation::new(rough(), shaken(side, 1e-3, &rough()), boundary).unwrap();
        simulation.gravity = [0.0, 1.0, -9.81];
        simulation.set_strain_rate(0.5);
        simulation
    })
}

#[test]
fn instruction_sets_give_the_same_bits() {
    for start in boxes(6) {
        let run = |simd| {
            let mut simulation = start.clone();
            simulation.set_simd(simd);
            simulation.run(300).unwrap();
            bits(&simulation)
        };
        let scalar = run(Simd::Scalar);
        for simd in Simd::ALL.into_iter().filter(|simd| simd.available()) {
            assert_eq!(run(simd), scalar, "{simd:?}");
        }
    }
}

/// Spheres along an edge of a periodic box that is divided into slabs: 10 648 in all. Between walls 4 000 are enough.
const DIVIDED: usize = 22;

#[test]
fn threads_give_the_same_bits() {
    for start in boxes(DIVIDED) {
        let run = |threads| {
            let mut simulation = start.clone();
            simulation.set_threads(threads).unwrap();
            simulation.run(100).unwrap();
            bits(&simulation)
        };
        let alone = run(1);
        assert!(run(2) == alone && run(3) == alone);
    }
}

/// A run that is stopped, stored and continued gives the same bits as one that is not; and so does one whose pairs are
/// searched at other times.
#[test]
fn a_restart_gives_the_same_bits() {
    let [divided, _] = boxes(DIVIDED);
    for start in boxes(6).into_iter().chain([divided]) {
        let mut whole = start.clone();
        whole.run(400).unwrap();
        let mut first = start.clone();
        first.run(200).unwrap();
        let state: State = first.state();
        let mut second = Simulation::from_state(state).unwrap();
        second.run(150).unwrap();
        second.rebuild_neighbours();
        second.run(50).unwrap();
        assert_eq!(bits(&second), bits(&whole));
        assert!(second.state().friction.len() > 100);
    }
}

/// What happens across the border of a periodic box is what happens anywhere else in it.
#[test]
fn a_periodic_box_has_no_border() {
    has_no_border(5);
    has_no_border(DIVIDED);
}

fn has_no_border(side: usize) {
    let size = side as f64 * SPACING;
    let moved = |by: [f64; 3]| {
        let mut spheres = shaken(side, 1e-3, &rough());
        for sphere in &mut spheres {
            sphere.position = std::array::from_fn(|k| (sphere.position[k] + by[k]).rem_euclid(size));
        }
        let mut simulation =
            Simulation::new(rough(), spheres, Boundary::Periodic(Cell::block([size; 3]))).unwrap();
        simulation.take_steps(100);
        simulation.energy()
    };
    let (a, b) = (moved([0.0; 3]), moved([3e-3, -1e-3, 4.5e-3]));
    assert!((a.total() / b.total() - 1.0).abs() < 1e-9, "{a:?} {b:?}");
    assert!(a.tangential > 0.0);
}

/// Spheres that fall into a box come to rest there, and the floor and the friction of the sides carry their weight.
#[test]
fn poured_spheres_rest_on_the_floor() {
    let stiffness = Stiffness::HertzMindlin { young_modulus: 1e7, poisson_ratio: 0.3 };
    let material = Material { stiffness, restitution: 0.3, ..rough() };
    let (side, loose) = (5, 1.3);
    let mut spheres = shaken(side, 1e-3, &material);
    for sphere in &mut spheres {
        sphere.position[2] = loose * sphere.position[2] + 1e-3;
        sphere.velocity = sphere.velocity.map(|v| 0.3 * v);
    }
    let size = side as f64 * SPACING + 1e-3;
    let walls = Wall::block([size; 3])[..5].to_vec();
    let mut simulation = Simulation::new(material, spheres, Boundary::Walls(walls)).unwrap();
    simulation.gravity = [0.0, 0.0, -9.81];
    let fallen = simulation.energy().potential;
    while simulation.time < 0.5 {
        // Nothing but drag stops spheres that roll.
        simulation.drag = if simulation.time < 0.3 { 0.0 } else { 30.0 };
        simulation.run(500).unwrap();
    }
    let weight = 9.81 * simulation.spheres.iter().map(|s| s.mass).sum::<f64>();
    let borne: f64 = simulation.wall_force.iter().map(|force| force[2]).sum();
    assert!((borne / -weight - 1.0).abs() < 1e-3, "{borne} {weight}");
    assert!(simulation.wall_force[4][2] < -0.5 * weight, "{:?}", simulation.wall_force);
    let energy = simulation.energy();
    assert!(energy.kinetic < 1e-6 * (fallen - energy.potential), "{energy:?} {fallen}");
    assert!(simulation.spheres.iter().all(|s| s.position.iter().all(|x| (0.0..2.0 * size).contains(x))));
}

/// A sphere that is let go from rest high above the floor bounces back to where it came from: the steps on the way are
/// short enough for the speed of the impact.
#[test]
fn a_sphere_that_is_let_go_bounces_back() {
    let height = 0.2;
    let sphere = Sphere::at_rest([0.0, 0.0, height], 1e-3, 2500.0);
    let floor = Wall::at_rest([0.0; 3], [0.0, 0.0, 1.0]);
    let stiffness = Stiffness::HertzMindlin { young_modulus: 1e7, poisson_ratio: 0.3 };
    let material = Material { stiffness, ..glass() };
    let mut simulation = Simulation::new(material, vec![sphere], Boundary::Walls(vec![floor])).unwrap();
    simulation.gravity = [0.0, 0.0, -9.81];
    let mut highest = 0.0f64;
    while simulation.time < 0.5 {
        simulation.run(50).unwrap();
        if simulation.time > 0.25 {
            highest = highest.max(simulation.spheres[0].position[2]);
        }
    }
    assert!((highest / height - 1.0).abs() < 0.02, "{highest}");
}
