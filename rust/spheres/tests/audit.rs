//! The balance of energy closes, and better with shorter steps.

mod common;

use common::{SPACING, bits, glass, shaken};
use msdd_spheres::audit::EnergyAudit;
use msdd_spheres::{Boundary, Material, Simulation, Wall};

/// A heap in a box whose lid comes down and moves sideways, under gravity, with friction, damping and drag.
fn heap() -> Simulation {
    let side = 4;
    let material = Material { friction: 0.4, wall_friction: 0.3, restitution: 0.5, ..glass() };
    let size = side as f64 * SPACING;
    let mut spheres = shaken(side, 1e-3, &material);
    // Slowly: what is audited are lasting contacts.
    for sphere in &mut spheres {
        sphere.velocity = sphere.velocity.map(|v| 0.01 * v);
        sphere.angular_velocity = sphere.angular_velocity.map(|w| 0.01 * w);
    }
    let mut simulation = Simulation::new(material, spheres, Boundary::Walls(Wall::block([size; 3]))).unwrap();
    simulation.drag = 3000.0;
    simulation.run(4000).unwrap();
    simulation.drag = 50.0;
    simulation.gravity = [0.0, 0.0, -9.81];
    let Boundary::Walls(walls) = &mut simulation.boundary else { unreachable!() };
    walls[5].velocity = [0.3, 0.1, -0.2];
    simulation
}

#[test]
fn the_balance_closes() {
    let imbalance = |safety: f64| {
        let mut simulation = heap();
        simulation.time_step = safety * simulation.stable_step();
        let mut audit = EnergyAudit::new(&simulation);
        let end = simulation.time + 4e-5;
        while simulation.time < end {
            simulation.step_audited(&mut audit);
        }
        assert!(
            [audit.damping, audit.drag, audit.sliding, audit.resizing, audit.walls].iter().all(|&e| e > 0.0)
        );
        let residual = audit.residual(&simulation).abs();
        [residual / audit.walls, residual / audit.lost()]
    };
    let (coarse, fine) = (imbalance(0.4), imbalance(0.1));
    assert!(coarse[0] < 2e-4 && fine[0] < 5e-5, "of the work: {coarse:?} {fine:?}");
    assert!(coarse[1] < 2e-2 && fine[1] < 5e-3, "of the losses: {coarse:?} {fine:?}");
}

#[test]
fn an_audited_step_is_a_step() {
    let (mut plain, mut audited) = (heap(), heap());
    let mut audit = EnergyAudit::new(&audited);
    plain.take_steps(50);
    (0..50).for_each(|_| audited.step_audited(&mut audit));
    assert_eq!(bits(&plain), bits(&audited));
}
