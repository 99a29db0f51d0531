//! Packs periodic boxes with several frictions and prints a table: `packings SPHERES SEEDS`. C is the conductivity of the
//! contacts over k_s (p/E*)^(1/3); the last three columns are that of the gas over k_g where ln(R/h) of touching spheres is
//! 8.5, 6 and 3.5.

use msdd_beds::conductivity::{conductivity, mean};
use msdd_beds::links::{Link, contact_links, gas_links};
use msdd_beds::solid::Solid;
use msdd_beds::{Packing, pack};
use msdd_spheres::law::effective_modulus;
use msdd_spheres::{Material, Stiffness};
use std::time::Instant;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mut arguments = std::env::args().skip(1);
    let mut number = |default: u64| arguments.next().map_or(Ok(default), |text| text.parse());
    let (spheres, seeds) = (number(1000)? as usize, number(1)?);
    println!(
        "friction seed phi z z* rattlers p overlap settled steps searches candidates/contact seconds Msteps/s"
    );
    for friction in [0.0, 0.1, 0.3, 0.5] {
        for seed in 1..=seeds {
            let packing = Packing {
                spheres,
                seed,
                diameter: 1.0,
                material: Material {
                    density: 1.0,
                    stiffness: Stiffness::HertzMindlin { young_modulus: 1.0, poisson_ratio: 0.25 },
                    friction,
                    wall_friction: 0.0,
                    restitution: 0.3,
                },
                pressure: 1e-5,
                steps: 400_000,
            };
            let begin = Instant::now();
            let packed = pack(&packing)?;
            let seconds = begin.elapsed().as_secs_f64();
            let (a, s) = (&packed.averages, &packed.simulation);
            let volume = s.cell().map_or(0.0, |cell| cell.volume());
            let solve = |links: &[Link]| {
                let found = conductivity(links, spheres, volume);
                found.map_or(f64::NAN, |found| mean(&found.network))
            };
            let solid =
                Solid { conductivity: 1.0, effective_modulus: effective_modulus(1.0, 0.25), roughness: None };
            let contacts = solve(&contact_links(s, &solid));
            let contacts = contacts / (a.pressure() / solid.effective_modulus).cbrt();
            let gas = [8.5f64, 6.0, 3.5].map(|log| solve(&gas_links(s, 1.0, |radius| radius * (-log).exp())));
            println!(
                "{friction} {seed} {:.4} {:.3} {:.3} {:.3} {:.4e} {:.2e} {} {} {} {:.2} {seconds:.2} {:.1} {contacts:.4} {gas:.3?}",
                a.solid_fraction,
                a.coordination,
                a.backbone_coordination,
                a.rattlers,
                a.pressure(),
                a.overlap,
                packed.settled,
                s.steps,
                s.searches(),
                2.0 * s.candidates() as f64 / (a.coordination * spheres as f64),
                s.steps as f64 * spheres as f64 / seconds / 1e6,
            );
        }
    }
    Ok(())
}
