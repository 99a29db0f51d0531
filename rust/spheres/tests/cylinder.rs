//! Spheres inside of a cylinder, against closed forms.

mod common;

use common::{fixed_step, glass, shaken};
use msdd_spheres::audit::EnergyAudit;
use msdd_spheres::{Boundary, Material, Simulation, Sphere, Wall};
use std::f64::consts::PI;

const RADIUS: f64 = 1e-3;
/// Of the cylinder [m].
const BORE: f64 = 1e-2;
const G: f64 = 9.81;

/// The time of `swings` swings of a sphere at the bottom of a lying cylinder, for a small amplitude [s].
fn period(material: Material, swings: usize) -> f64 {
    let wall = Wall::cylinder([0.0; 3], [0.0, 1.0, 0.0], BORE);
    let angle = 0.02f64;
    let orbit = BORE - RADIUS;
    let place = [orbit * angle.sin(), 0.0, -orbit * angle.cos()];
    let sphere = Sphere::at_rest(place, RADIUS, material.density);
    let mut simulation = Simulation::new(material, vec![sphere], Boundary::Walls(vec![wall])).unwrap();
    simulation.gravity = [0.0, 0.0, -G];
    let step = 0.2 * simulation.stable_step();
    fixed_step(&mut simulation, step);
    let (mut crossings, mut first, mut last) = (0, 0.0, place[0]);
    while crossings <= 2 * swings {
        simulation.step();
        let x = simulation.spheres[0].position[0];
        if x * last < 0.0 {
            let time = simulation.time - step * x / (x - last);
            if crossings == 0 {
                first = time;
            }
            if crossings == 2 * swings {
                return time - first;
            }
            crossings += 1;
        }
        last = x;
    }
    unreachable!()
}

/// Without friction a sphere at the bottom swings as a pendulum of the length R − r; if it rolls, its rotation makes it
/// slower by √(7/5).
#[test]
fn a_sphere_swings_as_a_pendulum() {
    let pendulum = 2.0 * PI * ((BORE - RADIUS) / G).sqrt();
    // Soft enough for long steps; the sphere sinks in by 1e-5 of its radius.
    let soft = |friction: f64| Material {
        stiffness: msdd_spheres::Stiffness::HertzMindlin { young_modulus: 1e8, poisson_ratio: 0.3 },
        wall_friction: friction,
        ..glass()
    };
    let slides = period(soft(0.0), 2) / 2.0 / pendulum;
    assert!((slides - 1.0).abs() < 5e-4, "{slides}");
    let rolls = period(soft(0.8), 2) / 2.0 / pendulum;
    assert!((rolls / (7.0f64 / 5.0).sqrt() - 1.0).abs() < 5e-4, "{rolls}");
}

/// A sphere that runs around in a cylinder without friction keeps its speed, and presses on the wall with m v²/(R − r).
#[test]
fn a_sphere_that_runs_around_presses_outwards() {
    let wall = Wall::cylinder([0.0; 3], [0.0, 0.0, 1.0], BORE);
    let mut sphere = Sphere::at_rest([BORE - RADIUS, 0.0, 0.0], RADIUS, 2500.0);
    let speed = 0.5;
    sphere.velocity = [0.0, speed, 0.0];
    let mut material = glass();
    // Only the normal damping acts; it ends the bouncing.
    material.restitution = 0.1;
    let mut simulation = Simulation::new(material, vec![sphere], Boundary::Walls(vec![wall])).unwrap();
    for _ in 0..100 {
        simulation.run(500).unwrap();
    }
    let s = simulation.spheres[0];
    let (v, orbit) = (s.velocity[0].hypot(s.velocity[1]), s.position[0].hypot(s.position[1]));
    assert!((v / speed - 1.0).abs() < 1e-3, "{v}");
    let force = simulation.wall_force[0];
    let expected = s.mass * v * v / orbit;
    assert!((force[0].hypot(force[1]) / expected - 1.0).abs() < 1e-3, "{force:?} {expected}");
}

/// The balance of energy closes next to a cylinder that moves.
#[test]
fn the_balance_of_energy_closes() {
    let material = Material { friction: 0.4, wall_friction: 0.3, restitution: 0.5, ..glass() };
    let mut spheres = shaken(4, RADIUS, &material);
    for sphere in &mut spheres {
        sphere.velocity = sphere.velocity.map(|v| 0.01 * v);
        sphere.angular_velocity = sphere.angular_velocity.map(|w| 0.01 * w);
    }
    let half = 2.0 * common::SPACING;
    // The corners of the lattice overlap with the wall.
    let bore = 1.3 * half;
    let wall = Wall::cylinder([half, half, 0.0], [0.0, 0.0, 1.0], bore);
    let floor = Wall::at_rest([0.0; 3], [0.0, 0.0, 1.0]);
    let lid = Wall::at_rest([0.0, 0.0, 2.0 * half], [0.0, 0.0, -1.0]);
    let mut simulation = Simulation::new(material, spheres, Boundary::Walls(vec![wall, floor, lid])).unwrap();
    simulation.gravity = [0.0, 0.0, -G];
    simulation.drag = 3000.0;
    simulation.run(4000).unwrap();
    simulation.drag = 0.0;
    let Boundary::Walls(walls) = &mut simulation.boundary else { unreachable!() };
    walls[0].velocity = [0.2, -0.1, 0.1];
    simulation.time_step = 0.1 * simulation.stable_step();
    let mut audit = EnergyAudit::new(&simulation);
    for _ in 0..3000 {
        simulation.step_audited(&mut audit);
    }
    assert!(audit.lost() > 0.0 && audit.walls != 0.0);
    let residual = audit.residual(&simulation).abs();
    assert!(residual < 1e-3 * audit.lost(), "{residual} of {audit:?}");
}
