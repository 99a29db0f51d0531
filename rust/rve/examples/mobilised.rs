//! How much friction do boxes of spheres mobilise that were packed with less friction than their own?
//!
//! `cargo run --release -p msdd-rve --example mobilised` packs boxes of 1000 spheres with shares of the friction 0.3, and prints the
//! mean of [`mobilisation`], and the standard deviation of one box: the numbers in `msdd_beds::mobilised`. Boxes under less than 1e-6 E*
//! are not among them: they were opened to get there, which mobilises friction, too. The last line is that of boxes that were shaken.

use msdd_beds::mobilised::mobilisation;
use msdd_rve::database::spheres::SphereCompression;
use msdd_rve::spheres::{Preparation, prepare};

const FRICTION: f64 = 0.3;
const PRESSURES: [f64; 2] = [2e-6, 1e-4];
const SHAPES: [SphereCompression; 3] =
    [SphereCompression::Isotropic, SphereCompression::Uniaxial, SphereCompression::Sheared];

fn main() -> Result<(), Box<dyn std::error::Error>> {
    println!("packed with   shaken   mobilisation   of one box");
    for (share, shaking) in
        [0.0, 1.0 / 6.0, 1.0 / 3.0, 2.0 / 3.0, 1.0].map(|s| (s, 0.0)).into_iter().chain([(1.0, 0.005)])
    {
        let mut found = Vec::new();
        for (seed, (pressure, rates)) in
            PRESSURES.iter().flat_map(|p| SHAPES.map(|shape| (*p, shape.rates()))).enumerate()
        {
            let prepared = prepare(&Preparation {
                spheres: 1000,
                sizes: None,
                seed: seed as u64,
                poisson_ratio: 0.25,
                restitution: 0.3,
                packing_friction: share * FRICTION,
                friction: FRICTION,
                rates,
                shaking,
                pressure,
            })?;
            found.push(mobilisation(&prepared.simulation, |_| true));
        }
        let count = found.len() as f64;
        let mean = found.iter().sum::<f64>() / count;
        let deviation = (found.iter().map(|x| (x - mean).powi(2)).sum::<f64>() / (count - 1.0)).sqrt();
        println!("{share:>11.3}   {shaking:>6}   {mean:>12.3}   {deviation:>10.3}");
    }
    Ok(())
}
