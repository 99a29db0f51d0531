//! The energy audit closes.

use msdd_dem::audit::EnergyAudit;
use msdd_dem::{Disc, Material, Side, Simulation, StepChoice, Walls, time_step};

const R: f64 = 5e-3;

/// 150 loose discs of all sizes between walls that close on them and slide, while the radii grow.
fn heap() -> Simulation {
    let material = Material::default();
    let discs = (0..150)
        .map(|k| {
            let u = |a: f64| (a * f64::from(k + 1)).fract();
            let (column, line) = (f64::from(k % 15), f64::from(k / 15));
            let radius = 3e-3 + 3e-3 * u(0.618_034);
            Disc::at_rest(0.012 * (column + 0.6), 0.012 * (line + 0.6), radius, material.density)
        })
        .collect();
    let mut simulation = Simulation::new(material, discs, Walls::around(0.182, 0.122));
    simulation.walls.normal_velocity = [0.02, -0.02, 0.01, -0.01];
    simulation.walls.tangential_velocity = [0.01, 0.0, -0.01, 0.0];
    simulation.free_drag = 5.0;
    simulation.set_strain_rate(0.05);
    simulation
}

/// Runs the heap for 0.6 s at `fraction` of the default step.
fn audited_heap(fraction: f64, t_end: f64) -> (Simulation, EnergyAudit) {
    let mut simulation = heap();
    let mut audit = EnergyAudit::new(&simulation);
    while simulation.time < t_end {
        simulation.choose_time_step(StepChoice::Adaptive { safety: fraction * time_step::SAFETY }).unwrap();
        (0..20).for_each(|_| simulation.step_audited(&mut audit));
    }
    simulation.check().unwrap();
    (simulation, audit)
}

#[test]
fn probe() {
    for t_end in [1.1, 1.2, 1.3] {
    for fraction in [2.0, 1.0, 0.5, 0.25, 0.125] {
        let (simulation, audit) = audited_heap(fraction, t_end);
        let mut n = 0;
        simulation.for_each_contact(|_| n += 1);
        println!(
            "{t_end} {fraction} steps {} contacts {n} d {:.3e} drag {:.3e} fr {:.3e} w {:.3e} g {:.3e} el {:.3e} kin {:.3e} imbalance {:.3e} signed {:.3e}",
            simulation.steps, audit.damping, audit.drag, audit.friction, audit.walls, audit.growth,
            simulation.elastic_energy(),
            simulation.kinetic_energy(),
            audit.imbalance(&simulation),
            audit.residual(&simulation)
        );
    }}
}
