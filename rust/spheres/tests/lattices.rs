//! Stiffness of crystals of equal spheres against closed forms.
//!
//! A crystal with one sphere in its primitive cell deforms affinely, so C_ijkl = l²/V Σ_c (k_n n_i n_j n_k n_l + k_t (δ_ik − n_i
//! n_k) n_j n_l) over the contacts of one sphere, with the distance l of neighbours: simple cubic C11 = k_n/l, C12 = 0;
//! face-centred cubic C11 = √2 (k_n + k_t)/l, C12 = (k_n − k_t)/(√2 l) (Duffy & Mindlin, J. Appl. Mech. 24, 585, 1957).
//! k_n = 2 E* a, k_t = 8 G* a. Prestress adds terms of the relative size of the overlap.

mod common;

use common::{POISSON, YOUNG, glass};
use msdd_spheres::law::{effective_modulus, effective_shear_modulus};
use msdd_spheres::{Boundary, Cell, Material, Simulation, Sphere};

const RADIUS: f64 = 1e-3;
/// Overlap over the diameter.
const OVERLAP: f64 = 3e-7;

/// A crystal of cubic cells of the given edge over l, with `basis` in units of the edge.
fn crystal(edge: f64, basis: &[[f64; 3]]) -> Simulation {
    let (cells, edge) = (3, edge * 2.0 * RADIUS * (1.0 - OVERLAP));
    let material = Material { friction: 1e6, ..glass() };
    let mut spheres = Vec::new();
    for k in 0..cells * cells * cells {
        let corner = [k % cells, k / cells % cells, k / cells / cells];
        for place in basis {
            let position = std::array::from_fn(|m| edge * (corner[m] as f64 + place[m]));
            spheres.push(Sphere::at_rest(position, RADIUS, material.density));
        }
    }
    let cell = Cell::block([edge * cells as f64; 3]);
    Simulation::new(material, spheres, Boundary::Periodic(cell)).unwrap()
}

/// σ_xx, σ_yy [Pa], compression positive.
fn stress(simulation: &Simulation) -> [f64; 2] {
    let mut sums = [0.0; 2];
    simulation.for_each_contact(|contact| {
        let force = contact.force();
        for (k, sum) in sums.iter_mut().enumerate() {
            *sum += force[k] * contact.branch[k];
        }
    });
    sums.map(|sum| sum / simulation.cell().unwrap().volume())
}

/// C11 and C12 [Pa], by a small compression along x.
fn moduli(mut simulation: Simulation) -> [f64; 2] {
    simulation.take_steps(1);
    assert!(stress(&simulation)[0] > 0.0);
    let strain = 1e-2 * OVERLAP;
    // Each from the same state in one step, so that nothing depends on the path.
    let stresses = [-2.0, -1.0, 1.0, 2.0].map(|compression| {
        let mut strained = simulation.clone();
        let rate = -compression * strain / strained.time_step;
        strained.set_velocity_gradient([[rate, 0.0, 0.0], [0.0; 3], [0.0; 3]]);
        strained.take_steps(1);
        stress(&strained)
    });
    // Central differences over two lengths, which together cancel the third derivative of Hertz's law.
    [0, 1].map(|k| {
        let narrow = (stresses[2][k] - stresses[1][k]) / (2.0 * strain);
        let wide = (stresses[3][k] - stresses[0][k]) / (4.0 * strain);
        (4.0 * narrow - wide) / 3.0
    })
}

fn contact_stiffness() -> [f64; 2] {
    let size = (0.5 * RADIUS * 2.0 * RADIUS * OVERLAP).sqrt();
    [2.0 * effective_modulus(YOUNG, POISSON) * size, 8.0 * effective_shear_modulus(YOUNG, POISSON) * size]
}

#[test]
fn simple_cubic() {
    let [normal, _] = contact_stiffness();
    let [c11, c12] = moduli(crystal(1.0, &[[0.0; 3]]));
    let distance = 2.0 * RADIUS * (1.0 - OVERLAP);
    assert!((c11 * distance / normal - 1.0).abs() < 1e-6, "{}", c11 * distance / normal - 1.0);
    assert!(c12.abs() < 1e-6 * c11, "{c12} {c11}");
}

#[test]
fn face_centred_cubic() {
    let [normal, tangential] = contact_stiffness();
    let basis = [[0.0; 3], [0.0, 0.5, 0.5], [0.5, 0.0, 0.5], [0.5, 0.5, 0.0]];
    let [c11, c12] = moduli(crystal(2.0f64.sqrt(), &basis));
    let distance = 2.0 * RADIUS * (1.0 - OVERLAP);
    let expected = [2.0f64.sqrt() * (normal + tangential), (normal - tangential) / 2.0f64.sqrt()];
    for (found, expected) in [c11, c12].into_iter().zip(expected) {
        // Prestress counts against C11, of which C12 is a twentieth.
        let error = (found * distance - expected) / (c11 * distance);
        assert!(error.abs() < 1e-6, "{error:e}, {}", expected / (c11 * distance));
    }
}

/// In the first step of a simple shear no sphere has turned yet: contacts across the flow slip by the shear, those along it
/// do not, and the stress is k_t/l times the shear on one side of the diagonal. Once the spheres turn with half of it, the
/// stress is symmetric.
#[test]
fn simple_cubic_sheared() {
    let [_, tangential] = contact_stiffness();
    let mut simulation = crystal(1.0, &[[0.0; 3]]);
    simulation.take_steps(1);
    let shear = 1e-2 * OVERLAP;
    let mut stresses = [[0.0; 2]; 2];
    for (sign, stress) in [1.0, -1.0].into_iter().zip(&mut stresses) {
        let mut sheared = simulation.clone();
        let rate = sign * shear / sheared.time_step;
        sheared.set_velocity_gradient([[0.0, rate, 0.0], [0.0; 3], [0.0; 3]]);
        sheared.take_steps(1);
        sheared.for_each_contact(|contact| {
            let (force, branch) = (contact.force(), contact.branch);
            stress[0] += force[0] * branch[1];
            stress[1] += force[1] * branch[0];
        });
        *stress = stress.map(|sum| sum / sheared.cell().unwrap().volume());
    }
    let distance = 2.0 * RADIUS * (1.0 - OVERLAP);
    let [across, along] = [0, 1].map(|k| (stresses[1][k] - stresses[0][k]) / (2.0 * shear));
    assert!((across * distance / tangential - 1.0).abs() < 1e-6, "{}", across * distance / tangential - 1.0);
    assert!(along.abs() < 1e-6 * across, "{along} {across}");

    // Half the shear as rotation of the spheres, about −z: slip and spin in one step.
    let rate = shear / simulation.time_step;
    for sphere in &mut simulation.spheres {
        sphere.angular_velocity = [0.0, 0.0, -0.5 * rate];
    }
    simulation.set_velocity_gradient([[0.0, rate, 0.0], [0.0; 3], [0.0; 3]]);
    simulation.take_steps(1);
    let mut sums = [0.0; 2];
    simulation.for_each_contact(|contact| {
        let (force, branch) = (contact.tangential_force(), contact.branch);
        sums[0] -= force[0] * branch[1];
        sums[1] -= force[1] * branch[0];
    });
    let expected = 0.5 * shear * tangential / distance * simulation.cell().unwrap().volume();
    for sum in sums {
        assert!((sum / expected - 1.0).abs() < 1e-5, "{}", sum / expected - 1.0);
    }
}
