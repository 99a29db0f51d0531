//! Lattices, for which the sums of Eqs. 8–10 have closed forms.

use super::*;
use msdd_dem::{Disc, Material, Walls};
use std::f64::consts::PI;

const R: f64 = 5e-3;
const SPACING: f64 = 1.96 * R;

/// 12 × 12 discs at a·k + b·l, far from any wall, after a single step that computes the forces: all overlaps are equal.
fn lattice(a: [f64; 2], b: [f64; 2]) -> Simulation {
    let discs = (0..12)
        .flat_map(|k| (0..12).map(move |l| (f64::from(k), f64::from(l))))
        .map(|(k, l)| Disc::at_rest(k * a[0] + l * b[0], k * a[1] + l * b[1], R, 3000.0))
        .collect();
    let walls = Walls { position: [-1.0, 1.0, -1.0, 1.0], ..Walls::around(1.0, 1.0) };
    Simulation::new(Material::default(), discs, walls)
}

fn close(value: f64, expected: f64) {
    assert!((value - expected).abs() < 1e-12 * expected.abs().max(1e-6), "{value} {expected}");
}

#[test]
fn square_lattice_is_exact() {
    let d = SPACING;
    let simulation = lattice([d, 0.0], [0.0, d]);
    // A region whose border cuts contacts: 4 × 4 lattice cells, shifted by a third.
    let region = Polygon::rectangle([3.3 * d, 3.3 * d], [7.3 * d, 7.3 * d]);
    let averages = homogenise_in(&simulation, &region, Cut::Clip);
    let chord = 2.0 * (R * R - 0.25 * d * d).sqrt();
    let pressure = 1e7 * R * (2.0 * R - d) / d;
    close(averages.conductivity_xx, chord / d);
    close(averages.conductivity_yy, chord / d);
    close(averages.stress_xx, pressure);
    close(averages.stress_yy, pressure);
    assert_eq!(averages.stress_xy, 0.0);
    assert_eq!(averages.fabric_index, 0.0);
    let half_angle = (0.5 * d / R).acos();
    let lens = R * R * (2.0 * half_angle - (2.0 * half_angle).sin());
    close(averages.porosity, 1.0 - (PI * R * R - 2.0 * lens) / (d * d));
}

#[test]
fn hexagonal_lattice_is_isotropic() {
    let d = SPACING;
    let row = 0.75f64.sqrt() * d;
    let simulation = lattice([d, 0.0], [-0.5 * d, row]);
    let region = Polygon::rectangle([2.1 * d, 3.3 * row], [5.1 * d, 7.3 * row]);
    let averages = homogenise_in(&simulation, &region, Cut::Clip);
    let chord = 2.0 * (R * R - 0.25 * d * d).sqrt();
    let pressure = 3f64.sqrt() * 1e7 * R * (2.0 * R - d) / d;
    for (value, expected) in [
        (averages.conductivity_xx, 3f64.sqrt() * chord / d),
        (averages.conductivity_yy, 3f64.sqrt() * chord / d),
        (averages.stress_xx, pressure),
        (averages.stress_yy, pressure),
    ] {
        close(value, expected);
    }
    assert!(averages.conductivity_xy.abs() < 1e-12 && averages.stress_xy.abs() < 1e-9 * pressure);
    assert!((averages.stress_xy - averages.stress_yx).abs() < 1e-9 * pressure);
}

/// Chains along x only: F = diag(1, 0), and K, σ have no yy part.
#[test]
fn chains_along_x() {
    let d = SPACING;
    let simulation = lattice([d, 0.0], [0.0, 2.5 * R]);
    let region = Polygon::rectangle([2.5 * d, 6.0 * R], [6.5 * d, 13.5 * R]);
    let averages = homogenise_in(&simulation, &region, Cut::Clip);
    let chord = 2.0 * (R * R - 0.25 * d * d).sqrt();
    assert_eq!(averages.fabric_index, 1.0);
    assert_eq!(averages.conductivity_yy, 0.0);
    close(averages.conductivity_xx, chord / (2.5 * R));
    close(averages.stress_xx, 1e7 * R * (2.0 * R - d) / (2.5 * R));
    assert_eq!(averages.stress_yy, 0.0);
}

/// Chains along the direction (cos α, sin α): F_xy = cos α sin α.
#[test]
fn slanting_chains_have_the_fabric_of_their_direction() {
    for (x, y) in [(0.8, 0.6), (0.8, -0.6), (-0.6, 0.8)] {
        let (a, b) = ([SPACING * x, SPACING * y], [-2.5 * R * y, 2.5 * R * x]);
        let averages =
            homogenise_in(&lattice(a, b), &Polygon::rectangle([-1.0, -1.0], [1.0, 1.0]), Cut::Clip);
        assert!(averages.contacts > 100);
        close(averages.fabric_xy, x * y);
        close(averages.fabric_index, x * x - y * y);
    }
}
