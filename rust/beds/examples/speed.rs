//! Steps of a jammed periodic box: `speed SPHERES [STEPS]` prints millions of sphere-steps per second.

use msdd_beds::{Packing, pack};
use msdd_spheres::{Material, Simd, Stiffness};
use std::time::Instant;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mut arguments = std::env::args().skip(1);
    let mut number = |default: u64| arguments.next().map_or(Ok(default), |text| text.parse());
    let (spheres, steps) = (number(1000)? as usize, number(10_000)?);
    let packing = Packing {
        spheres,
        seed: 1,
        diameter: 1.0,
        material: Material {
            density: 1.0,
            stiffness: Stiffness::HertzMindlin { young_modulus: 1.0, poisson_ratio: 0.25 },
            friction: 0.3,
            wall_friction: 0.0,
            restitution: 0.3,
        },
        pressure: 1e-5,
        steps: 60_000,
    };
    let packed = pack(&packing)?;
    println!("settled {}, {:?}", packed.settled, packed.averages);
    for simd in Simd::ALL.into_iter().filter(|simd| simd.available()) {
        let mut simulation = packed.simulation.clone();
        simulation.set_simd(simd);
        simulation.take_steps(steps / 10);
        let searches = simulation.searches();
        let best = (0..5)
            .map(|_| {
                let begin = Instant::now();
                simulation.take_steps(steps / 5);
                begin.elapsed().as_secs_f64()
            })
            .fold(f64::INFINITY, f64::min);
        let rate = (steps / 5) as f64 * spheres as f64 / best / 1e6;
        let searches = simulation.searches() - searches;
        println!(
            "{simd:?}: {rate:.2} M sphere-steps/s, {searches} searches, {:.2} candidates per sphere, {:e}",
            simulation.candidates() as f64 / spheres as f64,
            simulation.kinetic_energy()
        );
    }
    Ok(())
}
