//! How much of the friction of its contacts a packing has mobilised.
//!
//! A contact slides when its tangential force reaches the friction coefficient times its normal force. How near to that the contacts
//! of a packing are depends on how it was made, and says how soft it is: see `mobilised` in the law of spheres.

use msdd_spheres::space::length;
use msdd_spheres::{Partner, Simulation};

/// Periodic boxes of 1000 spheres with the friction 0.3: the share of it with which they were packed, and their [`mobilisation`] \[-\].
/// Means of isotropic, uniaxial and sheared boxes under 2e-6 and 1e-4 E*; two such boxes differ by 0.01 (0.03 in the last row). Made by
/// `cargo run --release -p msdd-rve --example mobilised`.
const BOXES: [[f64; 2]; 5] =
    [[0.0, 0.0], [1.0 / 6.0, 0.127], [1.0 / 3.0, 0.246], [2.0 / 3.0, 0.431], [1.0, 0.570]];

/// Σ|f_t|/(μ Σ f_n) \[-\] over the contacts between spheres whose middle is held: 0 where no tangential force acts, 1 where all of them
/// slide. 0 without contacts or without friction.
pub fn mobilisation(simulation: &Simulation, holds: impl Fn([f64; 3]) -> bool) -> f64 {
    let (mut tangential, mut normal) = (0.0, 0.0);
    simulation.for_each_contact(|contact| {
        let Partner::Sphere(i) = contact.i else { return };
        let position = simulation.spheres[i].position;
        if holds(std::array::from_fn(|axis| position[axis] + 0.5 * contact.branch[axis])) {
            tangential += length(contact.tangential_force());
            normal += contact.normal_force;
        }
    });
    let most = simulation.material.friction * normal;
    if most > 0.0 { tangential / most } else { 0.0 }
}

/// The mobilised part of the friction in the law of spheres \[-\], 0 to 1, of a packing with this [`mobilisation`]: the share of their
/// friction with which boxes are packed that have as much.
pub fn mobilised(mobilisation: f64) -> f64 {
    let pairs = BOXES.iter().zip(&BOXES[1..]);
    let inside = pairs.into_iter().find(|(_, [_, upper])| mobilisation < *upper);
    inside.map_or(1.0, |([a, below], [b, above])| {
        let share = (mobilisation - below) / (above - below);
        (a + share * (b - a)).max(0.0)
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Packing, pack};
    use msdd_spheres::{Material, Stiffness};

    #[test]
    fn boxes_have_the_share_of_friction_that_they_were_packed_with() {
        for [share, measured] in BOXES {
            assert!((mobilised(measured) - share).abs() < 1e-12, "{share}");
        }
        assert!((mobilised(0.0635) - 1.0 / 12.0).abs() < 1e-3);
        assert_eq!([mobilised(-1e-9), mobilised(0.6), mobilised(1.0)], [0.0, 1.0, 1.0]);
    }

    #[test]
    fn friction_is_mobilised_by_packing_with_friction() {
        let packed = |friction: f64| {
            let material = Material {
                density: 1.0,
                stiffness: Stiffness::HertzMindlin { young_modulus: 2.0, poisson_ratio: 0.25 },
                friction,
                wall_friction: 0.0,
                restitution: 0.3,
            };
            let packing = Packing {
                spheres: 100,
                seed: 5,
                diameter: 1.0,
                sizes: None,
                material,
                pressure: 1e-4,
                steps: 200_000,
            };
            pack(&packing).unwrap().simulation
        };
        let (mut smooth, rough) = (packed(0.0), packed(0.3));
        assert_eq!(mobilisation(&smooth, |_| true), 0.0);
        smooth.material.friction = 0.3;
        assert!(mobilisation(&smooth, |_| true) < 1e-9);
        let found = mobilisation(&rough, |_| true);
        assert!((0.4..0.7).contains(&found), "{found}");
        assert_eq!(mobilisation(&rough, |_| false), 0.0);
        // Half of the box is equal.
        let half = mobilisation(&rough, |[x, ..]| x < 0.5 * rough.cell().unwrap().volume().cbrt());
        assert!((half - found).abs() < 0.15, "{half} {found}");
    }
}
