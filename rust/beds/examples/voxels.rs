//! Conductivity of packings of spheres by solutions of the heat equation, compared with the network and the closed forms:
//! `voxels SPHERES SEEDS VOXELS`. Each packing is solved with VOXELS along an edge and with
//! 2/3 and 4/9 of that, and extrapolated as a geometric series (Aitken): where spheres touch, the error falls with a power of the
//! voxels that is 1 for poor conductors and less for good ones.

#[path = "direct/mod.rs"]
mod direct;

use direct::correlation::zehner_bauer_schluender;
use direct::voxels::{Ball, Voxels};
use msdd_beds::conductances::{gas_links, near_pairs};
use msdd_beds::conductivity::{conductivity, mean};
use msdd_beds::gas::Gas;
use msdd_beds::{Packing, pack};
use msdd_spheres::{Material, Stiffness};

const RATIOS: [f64; 4] = [2.0, 5.0, 10.0, 20.0];
/// Friction while packing.
const FRICTIONS: [f64; 3] = [0.0, 0.1, 0.5];

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mut arguments = std::env::args().skip(1);
    let mut number = |default: u64| arguments.next().map_or(Ok(default), |text| text.parse());
    let (spheres, seeds, count) = (number(100)? as usize, number(1)?, number(96)? as usize);
    println!(
        "friction,seed,solid_fraction,ratio,coarse,middle,fine,extrapolated,network,zehner_bauer_schluender"
    );
    for friction in FRICTIONS {
        for seed in 1..=seeds {
            let stiffness = Stiffness::HertzMindlin { young_modulus: 1.0, poisson_ratio: 0.25 };
            let material =
                Material { density: 1.0, stiffness, friction, wall_friction: 0.0, restitution: 0.3 };
            let packing = Packing {
                spheres,
                seed,
                diameter: 1.0,
                sizes: None,
                material,
                pressure: 1e-6,
                steps: 400_000,
            };
            let simulation = pack(&packing)?.simulation;
            let volume = simulation.cell().map_or(0.0, |cell| cell.volume());
            let edge = volume.cbrt();
            let balls: Vec<Ball> = (simulation.spheres.iter())
                .map(|s| Ball { centre: s.position.map(|c| c / edge), radius: s.radius / edge })
                .collect();
            let solved = [count * 4 / 9, count * 2 / 3, count].map(|count| Voxels::new(&balls, count));
            for ratio in RATIOS {
                let mut found = [f64::NAN; 3];
                for (found, voxels) in found.iter_mut().zip(&solved) {
                    let along: Option<Vec<f64>> =
                        (0..3).map(|axis| voxels.conductivity(ratio, axis)).collect();
                    *found = along.map_or(f64::NAN, |along| along.iter().sum::<f64>() / 3.0);
                }
                let [coarse, middle, fine] = found;
                let (first, second) = (coarse - middle, middle - fine);
                let gas = Gas {
                    conductivity: 1.0,
                    mean_free_path: 0.0,
                    prandtl: 0.7,
                    heat_capacity_ratio: 1.4,
                    accommodation: 1.0,
                };
                let links =
                    gas_links(&near_pairs(&simulation), 1.0, |radius| gas.least_distance(radius, ratio));
                let network = conductivity(&links, spheres, volume).map_or(f64::NAN, |k| mean(&k.network));
                let phi = solved[2].solid_fraction;
                println!(
                    "{friction},{seed},{phi:.4},{ratio},{coarse:.4},{middle:.4},{fine:.4},{:.4},{network:.4},{:.4}",
                    fine - second * remaining(first, second),
                    zehner_bauer_schluender(1.0 - phi, ratio, 0.0, 1.0)
                );
            }
        }
    }
    Ok(())
}

/// What is left of a series of grids that are finer by 3/2 each, over its last difference.
fn remaining(first: f64, second: f64) -> f64 {
    let [half, one] = [0.5, 1.0].map(|power: f64| 1.5f64.powf(-power));
    let ratio = (second / first).clamp(one, half);
    ratio / (1.0 - ratio)
}
