//! Materials and loops that several tests use.
#![allow(dead_code)] // each test uses its part

use msdd_spheres::law::effective_modulus;
use msdd_spheres::{Boundary, Excess, Material, Simulation, Sphere, StepChoice, Stiffness, Wall};

pub const YOUNG: f64 = 7e10;
pub const POISSON: f64 = 0.3;

/// Like glass; elastic, without friction.
pub fn glass() -> Material {
    Material {
        density: 2500.0,
        stiffness: Stiffness::HertzMindlin { young_modulus: YOUNG, poisson_ratio: POISSON },
        friction: 0.0,
        wall_friction: 0.0,
        restitution: 1.0,
    }
}

/// Of single spheres [m].
pub const RADIUS: f64 = 5e-3;

/// Deepest overlap [m] and duration [s] of an elastic collision at `speed` [m/s], with the effective mass [kg] and radius [m] of the
/// pair: δ_max = (15 m* v²/(16 E* √R*))^(2/5) and 2.943 δ_max/v (Johnson, Contact Mechanics, eqs. 11.23 and 24). Of [`glass`].
pub fn hertz(mass: f64, radius: f64, speed: f64) -> [f64; 2] {
    let spring = effective_modulus(YOUNG, POISSON) * radius.sqrt();
    let deepest = (15.0 * mass * speed * speed / (16.0 * spring)).powf(0.4);
    [deepest, 2.943_275 * deepest / speed]
}

/// A sphere of [`RADIUS`], `height` [m] above a floor.
pub fn over_floor(material: &Material, height: f64) -> Simulation {
    let floor = Wall::at_rest([0.0; 3], [0.0, 0.0, 1.0]);
    let sphere = Sphere::at_rest([0.0, 0.0, RADIUS + height], RADIUS, material.density);
    Simulation::new(material.clone(), vec![sphere], Boundary::Walls(vec![floor])).unwrap()
}

/// Spheres without a box.
pub fn free(material: Material, spheres: Vec<Sphere>) -> Simulation {
    Simulation::new(material, spheres, Boundary::Walls(Vec::new())).unwrap()
}

pub fn fixed_step(simulation: &mut Simulation, step: f64) {
    simulation.choose_time_step(StepChoice::Fixed { step, on_excess: Excess::Refuse }).unwrap();
}

/// Of the lattice of spheres of radius 1 mm [m]: they overlap.
pub const SPACING: f64 = 1.94e-3;

/// A jittered lattice of unequal spheres that partly overlap, moving and turning at random, in [0, side · SPACING]³ for the radius 1 mm.
pub fn shaken(side: usize, radius: f64, material: &Material) -> Vec<Sphere> {
    let spacing = SPACING / 1e-3 * radius;
    (0..side * side * side)
        .map(|k| {
            let u = |a: f64| (a * (k + 1) as f64).fract() - 0.5;
            let place = [k % side, k / side % side, k / side / side];
            let shift = [u(0.618_034), u(0.414_214), u(0.732_051)];
            let position = std::array::from_fn(|m| spacing * (place[m] as f64 + 0.5 + 0.1 * shift[m]));
            let mut sphere = Sphere::at_rest(position, radius * (1.0 + 0.1 * u(0.324_718)), material.density);
            sphere.velocity = shift.map(|s| 0.2 * s);
            sphere.angular_velocity = [u(0.236_068), u(0.645_751), u(0.872_983)].map(|s| 0.2 * s / radius);
            sphere
        })
        .collect()
}

/// The numbers of a state, as bits.
pub fn bits(simulation: &Simulation) -> Vec<u64> {
    let of = |s: &Sphere| {
        let numbers =
            s.position.into_iter().chain(s.velocity).chain(s.angular_velocity).chain([s.radius, s.mass]);
        numbers.map(f64::to_bits).collect::<Vec<_>>()
    };
    let mut bits: Vec<u64> = simulation.spheres.iter().flat_map(of).collect();
    bits.extend(simulation.state().friction.iter().flat_map(|friction| friction.history.map(f64::to_bits)));
    bits
}
