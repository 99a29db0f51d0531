//! The benchmarks that the field uses for the mechanics of single spheres: tests 2 and 4 to 8 of Chung & Ooi (Granular Matter 13,
//! 643, 2011; their 1 and 3 are in `collisions.rs`) and the verification cases DEM-02, DEM-03 and DEM-05 of MFiX (Garg et al.,
//! Powder Technol. 220, 122, 2012; DEM-04 is in `collisions.rs`; DEM-05 asks the same as tests 4 and 5; DEM-01 and DEM-06 ask
//! for the way of a single sphere in free fall and in a fluid).

mod common;

use common::{POISSON, RADIUS, fixed_step, free, glass, hertz, over_floor};
use msdd_spheres::law::damping_ratio;
use msdd_spheres::{Boundary, Material, Simulation, Sphere, Stiffness, Wall};

/// Normal speed of the impacts [m/s]: small, so that overlaps and turns of the contact during an impact are below 1e-4.
const SPEED: f64 = 1e-3;

/// The sphere after its impact on the floor, with the deepest overlap and the duration.
fn impact(friction: f64, along: f64, spin: f64) -> (Sphere, [f64; 2]) {
    let mut simulation = over_floor(&Material { wall_friction: friction, ..glass() }, 0.0);
    simulation.spheres[0].velocity = [along, 0.0, -SPEED];
    simulation.spheres[0].angular_velocity[1] = spin;
    let [_, duration] = hertz(simulation.spheres[0].mass, RADIUS, SPEED);
    fixed_step(&mut simulation, duration / 4000.0);
    let mut deepest = 0.0f64;
    loop {
        simulation.step();
        let sphere = simulation.spheres[0];
        deepest = deepest.max(RADIUS - sphere.position[2]);
        if sphere.position[2] >= RADIUS {
            let since = (sphere.position[2] - RADIUS) / sphere.velocity[2];
            return (sphere, [deepest, simulation.time - since]);
        }
    }
}

/// Test 2: a sphere hits a wall of its own material without damping.
#[test]
fn elastic_impact_on_a_wall() {
    let (sphere, found) = impact(0.0, 0.0, 0.0);
    let expected = hertz(sphere.mass, RADIUS, SPEED);
    assert!((found[0] / expected[0] - 1.0).abs() < 1e-5, "{found:?} {expected:?}");
    assert!((found[1] / expected[1] - 1.0).abs() < 1e-4, "{found:?} {expected:?}");
    assert!((sphere.velocity[2] / SPEED - 1.0).abs() < 1e-5, "{sphere:?}");
}

/// Tests 4 and 5: oblique impacts. At any angle the angular momentum about the point of contact stays, m r v_t + I ω, and no energy
/// is made. The contact slides from beginning to end for v_t > μ (7 − 2/(3 κ)) v_n, κ = 2 (1 − ν)/(2 − ν) being the ratio of the
/// tangential to the normal stiffness; then the impulse of friction is 2 μ m v_n, else it is less. (Beyond 7 μ v_n it never turns
/// around. Below, it slips back in the end as long as k_t |v_t| is less than what the bound μ f_n falls by; a third of that fall, the
/// scaling of f_t with a, is no slip. Without the scaling it would be 1/κ: Maw, Barber & Fawcett, Wear 38, 101, 1976.)
#[test]
fn oblique_impacts() {
    let friction = 0.1;
    let stiffness_ratio = 2.0 * (1.0 - POISSON) / (2.0 - POISSON);
    let sliding = friction * (7.0 - 2.0 / (3.0 * stiffness_ratio));
    for ratio in [0.05, 0.2, 0.5, 0.97 * sliding, 1.03 * sliding, 0.9, 1.5, 4.0] {
        let along = ratio * SPEED;
        let (sphere, _) = impact(friction, along, 0.0);
        let [after, surface] = [sphere.velocity[0], RADIUS * sphere.angular_velocity[1]];
        assert!(((after + 0.4 * surface) / along - 1.0).abs() < 1e-4, "{ratio}: {sphere:?}");
        let mut before = Sphere::at_rest([0.0; 3], RADIUS, glass().density);
        before.velocity = [along, 0.0, -SPEED];
        assert!(sphere.kinetic_energy() < (1.0 + 1e-6) * before.kinetic_energy(), "{ratio}: {sphere:?}");
        let slides = after - (along - 2.0 * friction * SPEED);
        if ratio > sliding {
            assert!(slides.abs() < 1e-4 * SPEED, "{ratio}: {sphere:?}");
        } else {
            assert!(slides > 1e-4 * SPEED, "{ratio}: {sphere:?}");
        }
    }
}

/// Test 6: a sphere that spins while it falls is thrown aside, by 2 μ v_n if the contact slides to its end.
#[test]
fn impact_with_spin() {
    let friction = 0.3;
    for ratio in [3.0, -6.0f64] {
        let (sphere, _) = impact(friction, 0.0, ratio * SPEED / RADIUS);
        let thrown = 2.0 * friction * SPEED * ratio.signum();
        assert!((sphere.velocity[0] / thrown - 1.0).abs() < 1e-4, "{ratio}: {sphere:?}");
        let surface = ratio * SPEED - 2.5 * thrown;
        assert!((RADIUS * sphere.angular_velocity[1] / surface - 1.0).abs() < 1e-4, "{ratio}: {sphere:?}");
    }
}

/// Tests 7 and 8: two spinning spheres of the same and of different size collide head-on; friction slides to the end and gives
/// both the same impulse 2 μ m* v_n.
#[test]
fn spinning_spheres_collide() {
    let friction = 0.25;
    let material = Material { friction, ..glass() };
    for (other, spins) in [(RADIUS, [1.0, 1.0]), (RADIUS, [2.0, 0.0]), (3.0 * RADIUS, [2.0, 0.5])] {
        let radii = [RADIUS, other];
        let mut spheres = radii.map(|radius| Sphere::at_rest([0.0; 3], radius, material.density));
        let masses = spheres.map(|sphere| sphere.mass);
        let effective = masses[0] * masses[1] / (masses[0] + masses[1]);
        for (k, side) in [-1.0, 1.0].into_iter().enumerate() {
            spheres[k].position[0] = side * radii[k];
            spheres[k].velocity[0] = -side * SPEED * effective / masses[k];
            spheres[k].angular_velocity[2] = 2.0 * spins[k] * SPEED / radii[k];
        }
        let before = spheres;
        let mut simulation = free(material.clone(), spheres.to_vec());
        let [_, duration] = hertz(effective, radii[0] * radii[1] / (radii[0] + radii[1]), SPEED);
        fixed_step(&mut simulation, duration / 4000.0);
        let gap = |s: &[Sphere]| s[1].position[0] - s[0].position[0] - radii[0] - radii[1];
        simulation.step();
        while gap(&simulation.spheres) < 0.0 {
            simulation.step();
        }
        let impulse = 2.0 * friction * effective * SPEED;
        for (k, side) in [-1.0, 1.0].into_iter().enumerate() {
            let [sphere, before] = [simulation.spheres[k], before[k]];
            assert!((sphere.velocity[0] / before.velocity[0] + 1.0).abs() < 1e-4, "{sphere:?}");
            assert!((sphere.velocity[1] * sphere.mass / (side * impulse) - 1.0).abs() < 1e-3, "{sphere:?}");
            let turned = (before.angular_velocity[2] - sphere.angular_velocity[2]) * sphere.inertia();
            assert!((turned / (impulse * sphere.radius) - 1.0).abs() < 1e-3, "{sphere:?}");
        }
    }
}

/// DEM-02: a sphere that is dropped on a floor rises to e^(2 k) of its height after k impacts, up to what gravity does during an impact
/// and the damping of the step in which the contact ends: together below a thousandth of the height at each rebound.
#[test]
fn a_dropped_sphere_rises_to_less_and_less() {
    let (gravity, height, restitution) = (9.81, 0.01, 0.8);
    let stiffness = Stiffness::Linear { normal: 1e8, tangential: 0.0 };
    let mut simulation = over_floor(&Material { stiffness, restitution, ..glass() }, height);
    simulation.gravity = [0.0, 0.0, -gravity];
    fixed_step(&mut simulation, 2e-8);
    let mut rebounds = 0;
    let mut before = 0.0;
    while rebounds < 2 {
        simulation.step();
        let [at, speed] = [simulation.spheres[0].position[2] - RADIUS, simulation.spheres[0].velocity[2]];
        if before > 0.0 && speed <= 0.0 && at > 0.0 {
            rebounds += 1;
            let expected = height * restitution.powi(2 * rebounds);
            assert!((at / expected - 1.0).abs() < 2e-3, "{rebounds}: {at} {expected}");
        }
        before = speed;
    }
}

/// DEM-03: two spheres, the upper one twice as heavy, are squeezed between floor and ceiling and move under their springs, dampers and
/// weight: the same as the two equations of motion, integrated by a Runge-Kutta method.
#[test]
fn stacked_spheres_between_plates() {
    let (normal, gravity, restitution) = (1e5, 9.81, 0.7);
    let stiffness = Stiffness::Linear { normal, tangential: 0.0 };
    let material = Material { stiffness, restitution, ..glass() };
    let ceiling = 3.6 * RADIUS;
    let walls =
        vec![Wall::at_rest([0.0; 3], [0.0, 0.0, 1.0]), Wall::at_rest([0.0, 0.0, ceiling], [0.0, 0.0, -1.0])];
    let spheres = [(0.5, 1.0), (1.5, 2.0)].map(|(at, factor)| {
        Sphere::at_rest([0.0, 0.0, at * 0.5 * ceiling], RADIUS, factor * material.density)
    });
    let masses = spheres.map(|sphere| sphere.mass);
    let mut state = [spheres[0].position[2], spheres[1].position[2], 0.0, 0.0];
    let mut simulation = Simulation::new(material, spheres.to_vec(), Boundary::Walls(walls)).unwrap();
    simulation.gravity = [0.0, 0.0, -gravity];
    let step = 5e-8;
    fixed_step(&mut simulation, step);

    // Force of a contact of `overlap` and its rate, with the effective mass of the pair; a wall has an infinite mass.
    let beta = damping_ratio(restitution);
    let push = |overlap: f64, rate: f64, mass: f64| match overlap > 0.0 {
        true => normal * overlap + 2.0 * beta * (normal * mass).sqrt() * rate,
        false => 0.0,
    };
    let pair = masses[0] * masses[1] / (masses[0] + masses[1]);
    let rate = |[z1, z2, v1, v2]: [f64; 4]| {
        let below = push(RADIUS - z1, -v1, masses[0]);
        let between = push(2.0 * RADIUS - (z2 - z1), v1 - v2, pair);
        let above = push(z2 + RADIUS - ceiling, v2, masses[1]);
        [v1, v2, (below - between) / masses[0] - gravity, (between - above) / masses[1] - gravity]
    };
    let moved = |y: [f64; 4], k: [f64; 4], h: f64| std::array::from_fn(|n| y[n] + h * k[n]);
    let (chunks, per_chunk) = (40, 500);
    let [mut largest, mut travelled] = [0.0f64; 2];
    for _ in 0..chunks {
        simulation.take_steps(per_chunk);
        for _ in 0..per_chunk {
            let k1 = rate(state);
            let k2 = rate(moved(state, k1, 0.5 * step));
            let k3 = rate(moved(state, k2, 0.5 * step));
            let k4 = rate(moved(state, k3, step));
            state =
                std::array::from_fn(|n| state[n] + step / 6.0 * (k1[n] + 2.0 * k2[n] + 2.0 * k3[n] + k4[n]));
        }
        for (sphere, expected) in simulation.spheres.iter().zip(state) {
            largest = largest.max((sphere.position[2] - expected).abs());
        }
        travelled = travelled.max((state[0] - 0.25 * ceiling).abs());
    }
    assert!(largest < 1e-3 * travelled, "{largest} of {travelled}");
    assert!(travelled > 0.03 * RADIUS, "the spheres have hardly moved: {travelled}");
}
