//! What the gas between the pairs of periodic packings conducts, over k_g, for any distance h at a contact: `pairs [SPHERES] [SEEDS]`.
//!
//! Packings with four frictions; h/R as touching spheres of k_s/k_g = 2 to 60 have it without a jump of temperature, and larger. Beside it
//! the closed form of [`msdd_beds::effective::pairs`], and the largest error of that.

use msdd_beds::conductances::{gas_links, near_pairs};
use msdd_beds::conductivity::{conductivity, mean};
use msdd_beds::effective::pairs;
use msdd_beds::{Packing, pack};
use msdd_spheres::{Material, Stiffness};

const RATIOS: [f64; 11] = [1.0, 2.0, 3.0, 5.0, 7.0, 10.0, 14.0, 20.0, 30.0, 43.0, 60.0];

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mut arguments = std::env::args().skip(1);
    let mut number = |default: u64| arguments.next().map_or(Ok(default), |text| text.parse());
    let (spheres, seeds) = (number(1000)? as usize, number(2)?);
    println!("friction,seed,solid_fraction,ratio,h_over_R,pairs,closed_form");
    let mut worst = 0.0f64;
    for friction in [0.0, 0.1, 0.3, 0.5] {
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
            let packed = pack(&packing)?;
            let (s, phi) = (&packed.simulation, packed.averages.solid_fraction);
            let volume = s.cell().map_or(0.0, |cell| cell.volume());
            for ratio in RATIOS {
                let distance = 50.0 / (ratio * ratio);
                let links = gas_links(&near_pairs(s), 1.0, |radius| radius * distance);
                let found = conductivity(&links, spheres, volume).map_or(f64::NAN, |k| mean(&k.network));
                println!(
                    "{friction},{seed},{phi:.5},{ratio},{distance:.6},{found:.6},{:.6}",
                    pairs(phi, distance, 1.0)
                );
                worst = worst.max((pairs(phi, distance, 1.0) / found - 1.0).abs());
            }
        }
    }
    println!("# closed form: largest error {:.1} %", 100.0 * worst);
    Ok(())
}
