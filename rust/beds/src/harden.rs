//! From grains that were poured soft, so that steps are long, to grains of their true stiffness.
//!
//! Young's modulus grows evenly in its logarithm under a lid that keeps its pressure. The energy that this sets free is that of the
//! contacts, which is small compared with m g r, so hardly a grain changes its place.

use crate::BedError;
use crate::settle::Rest;
use crate::wall_control::{Moving, WallControl, drag, steered};
use msdd_spheres::{Simulation, Sphere, Stiffness};

/// Blocks of steps, in each of which the modulus changes once, while it doubles.
const BLOCKS: f64 = 20.0;
/// Blocks after which a bed that is not at rest is given up.
const MOST: u64 = 10_000;
/// Relative error of the pressure, and kinetic energy over p V, at which the bed counts as at rest.
const BALANCED: [f64; 2] = [2e-3, 1e-8];

/// Gives the grains the modulus `young_modulus` \[Pa\] under wall `lid`, which presses with `pressure` \[Pa\] on an area \[m²\]; the bed is
/// `depth` \[m\] deep. `watch` receives how far it has come, from 0 to 1.
///
/// # Errors
/// Those of [`Simulation::run`].
pub fn harden(
    simulation: &mut Simulation,
    young_modulus: f64,
    lid: usize,
    (pressure, area): (f64, f64),
    depth: f64,
    mut watch: impl FnMut(f64),
) -> Result<Rest, BedError> {
    let (start, first) = (simulation.time, simulation.steps);
    let Stiffness::HertzMindlin { young_modulus: soft, poisson_ratio } = simulation.material.stiffness else {
        return Ok(Rest { at_rest: true, kinetic: 0.0, time: 0.0, steps: 0 });
    };
    let hard = (BLOCKS * libm::log2(young_modulus / soft)).ceil().max(1.0) as u64;
    let mut lid = Moving::new(lid, WallControl::Pressure { pressure });
    let mut block = 0;
    loop {
        block += 1;
        let share = (block as f64 / hard as f64).min(1.0);
        let modulus =
            if block >= hard { young_modulus } else { soft * libm::pow(young_modulus / soft, share) };
        simulation.material.stiffness = Stiffness::HertzMindlin { young_modulus: modulus, poisson_ratio };
        simulation.drag = drag(simulation, depth);
        steered(simulation, |simulation, dt, left| {
            let borne = simulation.wall_load(lid.wall) / area;
            lid.steer(simulation, borne, dt, left);
        })?;
        watch(share);
        let borne = simulation.wall_load(lid.wall) / area;
        let kinetic =
            simulation.spheres.iter().map(Sphere::kinetic_energy).sum::<f64>() / (pressure * area * depth);
        let at_rest = block >= hard && (borne / pressure - 1.0).abs() < BALANCED[0] && kinetic < BALANCED[1];
        if at_rest || block >= hard + MOST {
            simulation.drag = 0.0;
            lid.stop(simulation);
            let (time, steps) = (simulation.time - start, simulation.steps - first);
            return Ok(Rest { at_rest, kinetic, time, steps });
        }
    }
}
