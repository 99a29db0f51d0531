//! Packings: at rest under the pressure that was asked for, the same for the same seed.

use msdd_beds::{Packing, pack};
use msdd_spheres::space::length;
use msdd_spheres::{Material, Stiffness};

fn packing(friction: f64) -> Packing {
    Packing {
        spheres: 250,
        seed: 4,
        diameter: 2e-3,
        material: Material {
            density: 2500.0,
            stiffness: Stiffness::HertzMindlin { young_modulus: 1e9, poisson_ratio: 0.25 },
            friction,
            wall_friction: 0.0,
            restitution: 0.3,
        },
        pressure: 1e4,
        steps: 300_000,
    }
}

#[test]
fn a_packing_is_at_rest_under_its_pressure() {
    let packed = pack(&packing(0.3)).unwrap();
    assert!(packed.settled);
    let averages = &packed.averages;
    assert!((averages.pressure() / 1e4 - 1.0).abs() < 1e-4, "{averages:?}");
    assert!((0.56..0.61).contains(&averages.solid_fraction), "{averages:?}");
    assert!((4.2..4.9).contains(&averages.coordination), "{averages:?}");
    // The forces on each sphere balance each other.
    let (mut mean, mut contacts) = (0.0, 0.0);
    packed.simulation.for_each_contact(|contact| {
        mean += contact.normal_force;
        contacts += 1.0;
    });
    let largest = packed.simulation.loads().iter().map(|load| length(load.force)).fold(0.0, f64::max);
    assert!(largest < 1e-2 * mean / contacts, "{largest} {}", mean / contacts);
    let again = pack(&packing(0.3)).unwrap();
    assert_eq!(again.simulation.state(), packed.simulation.state());
}

/// Without friction a packing needs six contacts per sphere to be rigid, and a stressed one has little more (Moukarzel,
/// Phys. Rev. Lett. 81, 1634, 1998). Friction makes packings looser.
#[test]
fn frictionless_packings_are_isostatic_and_denser() {
    let averages = pack(&packing(0.0)).unwrap().averages;
    let rough = pack(&packing(1.0)).unwrap().averages;
    assert!((5.9..6.5).contains(&averages.backbone_coordination), "{averages:?}");
    assert!(averages.solid_fraction > rough.solid_fraction + 0.04, "{averages:?} {rough:?}");
    assert!(rough.backbone_coordination < 4.8, "{rough:?}");
}

#[test]
fn bad_input_names_key_value_and_range() {
    let refused = |change: fn(&mut Packing)| {
        let mut bad = packing(0.3);
        change(&mut bad);
        pack(&bad).unwrap_err().to_string()
    };
    assert_eq!(refused(|p| p.spheres = 10), "packing: spheres = 10, allowed: 50 to 10000000");
    assert_eq!(refused(|p| p.diameter = -1.0), "packing: diameter = -1, allowed: above 0 m");
    assert_eq!(refused(|p| p.pressure = 1e9), "packing: pressure = 1000000000, allowed: below 0.01 E");
    assert_eq!(
        refused(|p| p.material.friction = -0.1),
        "material: friction = -0.1, allowed: 0, or 1e-30 to 1e30"
    );
}
