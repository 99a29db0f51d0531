//! Single contacts against closed forms.

mod common;

use common::{POISSON, RADIUS, YOUNG, fixed_step, free, glass, hertz, over_floor};
use msdd_spheres::law::{damping_ratio, effective_modulus, effective_shear_modulus};
use msdd_spheres::space::{length, minus};
use msdd_spheres::{Boundary, Material, Simulation, Sphere, Stiffness};

/// Two spheres that touch and approach each other at `speed`.
fn head_on(material: &Material, speed: f64) -> Simulation {
    let mut a = Sphere::at_rest([-RADIUS, 0.0, 0.0], RADIUS, material.density);
    let mut b = Sphere::at_rest([RADIUS, 0.0, 0.0], RADIUS, material.density);
    (a.velocity[0], b.velocity[0]) = (0.5 * speed, -0.5 * speed);
    free(material.clone(), vec![a, b])
}

/// Largest overlap, duration and final relative speed of a collision in steps of `step` [s].
fn collide(simulation: &mut Simulation, step: f64) -> [f64; 3] {
    fixed_step(simulation, step);
    let reach: f64 = simulation.spheres.iter().map(|sphere| sphere.radius).sum();
    let gap = |s: &Simulation| {
        let [a, b] = [0, 1].map(|k| s.spheres[k].position);
        length(minus(b, a)) - reach
    };
    let mut deepest = 0.0f64;
    loop {
        simulation.step();
        deepest = deepest.max(-gap(simulation));
        if gap(simulation) >= 0.0 {
            let apart = simulation.spheres[1].velocity[0] - simulation.spheres[0].velocity[0];
            return [deepest, simulation.time - gap(simulation) / apart, apart];
        }
    }
}

/// Deepest overlap [m] and duration [s] of a collision of two equal spheres at `speed` [m/s].
fn hertz_pair(speed: f64) -> [f64; 2] {
    hertz(0.5 * Sphere::at_rest([0.0; 3], RADIUS, glass().density).mass, 0.5 * RADIUS, speed)
}

#[test]
fn hertz_collision_without_damping() {
    for speed in [0.01, 1.0] {
        let [deepest, duration] = hertz_pair(speed);
        let found = collide(&mut head_on(&glass(), speed), duration / 2000.0);
        assert!((found[0] / deepest - 1.0).abs() < 1e-5, "{found:?} {deepest}");
        assert!((found[1] / duration - 1.0).abs() < 1e-4, "{found:?} {duration}");
        assert!((found[2] / speed - 1.0).abs() < 1e-5, "{found:?}");
    }
}

/// Spheres of 1:3: Hertz with m* = m₁m₂/(m₁ + m₂) and R* = r₁r₂/(r₁ + r₂), and momentum is kept. A sphere that slides on a larger one gets
/// the same impulse J on its surface, so Δω = 5/2 J/(m r) of each.
#[test]
fn unequal_spheres_collide_as_their_effective_mass_and_radius() {
    let speed = 0.1;
    let pair = |friction: f64, across: f64| {
        let material = Material { friction, ..glass() };
        let radii = [RADIUS, 3.0 * RADIUS];
        let mut a = Sphere::at_rest([-radii[0], 0.0, 0.0], radii[0], material.density);
        let b = Sphere::at_rest([radii[1], 0.0, 0.0], radii[1], material.density);
        a.velocity = [speed, across, 0.0];
        free(material, vec![a, b])
    };
    let mut simulation = pair(0.0, 0.0);
    let [small, large] = [0, 1].map(|k| simulation.spheres[k].mass);
    let mass = small * large / (small + large);
    let [deepest, duration] = hertz(mass, 0.75 * RADIUS, speed);
    // The bound on the step counts on a collision of this pair at twice the speed.
    let faster = hertz(mass, 0.75 * RADIUS, 2.0 * speed)[0];
    let (modulus, shear) = (effective_modulus(YOUNG, POISSON), effective_shear_modulus(YOUNG, POISSON));
    let stiffness = (4.0 * modulus + 40.0 * shear) * (0.75 * RADIUS * faster).sqrt();
    let bound = 2.0 / (4.0 * stiffness / small).sqrt();
    assert!((simulation.stable_step() / bound - 1.0).abs() < 1e-9, "{bound}");
    let found = collide(&mut simulation, duration / 2000.0);
    assert!((found[0] / deepest - 1.0).abs() < 1e-5, "{found:?} {deepest}");
    assert!((found[1] / duration - 1.0).abs() < 1e-4, "{found:?} {duration}");
    assert!((simulation.momentum()[0] / (small * speed) - 1.0).abs() < 1e-12);

    let friction = 0.05;
    let mut sliding = pair(friction, speed);
    collide(&mut sliding, duration / 2000.0);
    let impulse = friction * 2.0 * mass * speed;
    for (sphere, mass) in sliding.spheres.iter().zip([small, large]) {
        let turned = sphere.angular_velocity[2] * mass * sphere.radius / (2.5 * impulse);
        // Overlaps shorten the lever arms by 1e-4 of the radius.
        assert!((turned.abs() - 1.0).abs() < 1e-3, "{turned}");
    }
}

/// The restitution is the same at any speed.
#[test]
fn hertz_collision_with_damping() {
    for restitution in [0.9, 0.5, 0.2] {
        for speed in [0.01, 1.0] {
            let material = Material { restitution, ..glass() };
            let [_, duration] = hertz_pair(speed);
            let found = collide(&mut head_on(&material, speed), duration / 4000.0);
            assert!((found[2] / speed - restitution).abs() < 2e-3, "{restitution} {speed} {found:?}");
        }
    }
}

/// Damped oscillator: duration π/(ω √(1 − β²)), restitution exp(−πβ/√(1 − β²)).
#[test]
fn linear_collision() {
    let (normal, restitution) = (1e6, 0.6);
    let material =
        Material { stiffness: Stiffness::Linear { normal, tangential: 0.0 }, restitution, ..glass() };
    let mut simulation = head_on(&material, 0.1);
    let beta = damping_ratio(restitution);
    let frequency = (2.0 * normal / simulation.spheres[0].mass).sqrt() * (1.0 - beta * beta).sqrt();
    let duration = std::f64::consts::PI / frequency;
    let found = collide(&mut simulation, duration / 4000.0);
    assert!((found[1] / duration - 1.0).abs() < 1e-3, "{found:?} {duration}");
    assert!((found[2] / 0.1 - restitution).abs() < 1e-3, "{found:?}");
}

/// Oblique impact in which the contact slides from beginning to end: by the impulses, Δv_t = 2 μ v_n and Δω =
/// 5/2 Δv_t/r (Foerster et al., Phys. Fluids 6, 1108, 1994). Overlaps shorten the lever arm by 1e-5. (With damping the
/// normal force attracts at the end, where friction is 0, so 1 + e instead of 2 would be too little.)
#[test]
fn oblique_impact_that_slides() {
    let material = Material { wall_friction: 0.2, ..glass() };
    let mut simulation = over_floor(&material, 1e-9);
    let down = 1e-3;
    simulation.spheres[0].velocity = [3e-3, 4e-3, -down];
    let [_, duration] = hertz_pair(down);
    fixed_step(&mut simulation, duration / 8000.0);
    while simulation.spheres[0].velocity[2] < 0.0 || simulation.spheres[0].position[2] < RADIUS {
        simulation.step();
    }
    let sphere = &simulation.spheres[0];
    let lost = material.wall_friction * (down + sphere.velocity[2]);
    let speed = 5e-3;
    let along = [0.6, 0.8];
    for (velocity, part) in sphere.velocity.iter().zip(along) {
        assert!((velocity / (part * (speed - lost)) - 1.0).abs() < 1e-9, "{sphere:?}");
    }
    let spin = 2.5 * lost / RADIUS;
    // ω = 5/(2 r) n × Δv.
    assert!((sphere.angular_velocity[0] / (-along[1] * spin) - 1.0).abs() < 1e-4, "{sphere:?}");
    assert!((sphere.angular_velocity[1] / (along[0] * spin) - 1.0).abs() < 1e-4, "{sphere:?}");
    assert!((sphere.velocity[2] / down - 1.0).abs() < 1e-5, "{sphere:?}");
}

/// A sphere that starts sliding on a floor slides for 2 v/(7 μ g) and then rolls at 5/7 v (MFiX verification case
/// DEM-04).
#[test]
fn sliding_turns_into_rolling() {
    let (friction, gravity, speed) = (0.3, 9.81, 0.2);
    let stiffness = Stiffness::Linear { normal: 1e5, tangential: 8e4 };
    let material = Material { stiffness, wall_friction: friction, restitution: 0.5, ..glass() };
    let mut simulation = over_floor(&material, 0.0);
    simulation.gravity = [0.0, 0.0, -gravity];
    let overlap = simulation.spheres[0].mass * gravity / 1e5;
    simulation.spheres[0].position[2] -= overlap;
    simulation.spheres[0].velocity[0] = speed;
    let step = 2e-6;
    fixed_step(&mut simulation, step);
    let ends = 2.0 * speed / (7.0 * friction * gravity);
    simulation.take_steps((0.5 * ends / step) as u64);
    let slowed = speed - friction * gravity * simulation.time;
    assert!((simulation.spheres[0].velocity[0] / slowed - 1.0).abs() < 1e-4, "{:?}", simulation.spheres[0]);
    simulation.take_steps((ends / step) as u64);
    let sphere = &simulation.spheres[0];
    assert!((sphere.velocity[0] / (5.0 / 7.0 * speed) - 1.0).abs() < 1e-3, "{sphere:?}");
    assert!((sphere.angular_velocity[1] * RADIUS / sphere.velocity[0] - 1.0).abs() < 1e-3, "{sphere:?}");
}

/// A moving wall pushes and drags what it touches; forces on the wall and on the sphere are opposite.
#[test]
fn wall_force_is_what_accelerates_the_sphere() {
    let material = Material { wall_friction: 0.4, restitution: 0.7, ..glass() };
    let mut simulation = over_floor(&material, -1e-8);
    let Boundary::Walls(walls) = &mut simulation.boundary else { unreachable!() };
    walls[0].velocity = [0.01, -0.02, 0.005];
    fixed_step(&mut simulation, 1e-7);
    for _ in 0..20 {
        let before = simulation.momentum();
        simulation.step();
        for ((after, before), on_wall) in
            simulation.momentum().iter().zip(before).zip(simulation.wall_force[0])
        {
            let pushed = (after - before) / 1e-7;
            assert!((pushed + on_wall).abs() < 1e-9 * pushed.abs().max(1e-3));
        }
    }
    assert!(simulation.momentum().iter().all(|p| p.abs() > 0.0));
}
