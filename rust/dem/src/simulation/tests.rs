//! Single steps and short runs compared with closed forms.

use super::*;
use crate::heat::{Thermal, WallHeat};
use crate::kernel;
use crate::walls::Side;
use std::f64::consts::PI;

const R: f64 = 5e-3;

fn undamped() -> Material {
    Material { damping: 0.0, ..Material::default() }
}

fn far_walls() -> Walls {
    Walls { position: [-1.0, 1.0, -1.0, 1.0], ..Walls::around(1.0, 1.0) }
}

fn two_discs(material: Material, overlap: f64) -> Simulation {
    let density = material.density;
    let discs = vec![Disc::at_rest(0.0, 0.0, R, density), Disc::at_rest(2.0 * R - overlap, 0.0, R, density)];
    Simulation::new(material, discs, far_walls())
}

/// Two equal discs pressed together separate after a quarter period, π/2 √(m/2s_n), with speed δ₀ √(s_n/2m) each.
#[test]
fn two_discs_part_with_the_closed_form_speed() {
    let material = undamped();
    let mut simulation = two_discs(material.clone(), 1e-5);
    let mass = material.density * PI * R * R;
    let stiffness = material.young_modulus * R;
    let quarter = 0.5 * PI * (mass / (2.0 * stiffness)).sqrt();
    simulation.time_step = quarter / 2000.0;
    let mut open_at = 0.0;
    while simulation.discs[1].x - simulation.discs[0].x < 2.0 * R {
        simulation.step();
        open_at = simulation.steps as f64 * simulation.time_step;
    }
    let speed = 1e-5 * (stiffness / (2.0 * mass)).sqrt();
    assert!((open_at / quarter - 1.0).abs() < 2e-3, "{open_at} {quarter}");
    assert!((simulation.discs[1].vx / speed - 1.0).abs() < 1e-3);
    assert!((simulation.discs[0].vx + simulation.discs[1].vx).abs() < 1e-18);
}

/// A disc pressed on a wall at rest and dragged along it: f_t grows as −ν s_n u, then stays at f_n tan φ, and the
/// torque is that of f_t with the lever arm r − δ.
#[test]
fn disc_on_wall_sticks_then_slides() {
    let material = undamped();
    let overlap = 1e-5;
    let mut disc = Disc::at_rest(0.0, R - overlap, R, material.density);
    disc.mass *= 1e12; // so heavy that only the prescribed velocity moves it
    disc.vx = 1e-3;
    let walls = Walls { position: [-1.0, 1.0, 0.0, 1.0], ..Walls::around(1.0, 1.0) };
    let mut simulation = Simulation::new(material.clone(), vec![disc], walls);
    simulation.time_step = 1e-4;
    let normal = material.young_modulus * R * overlap;
    for step in 1..200 {
        simulation.step();
        let elastic = 0.8 * material.young_modulus * R * 1e-3 * 1e-4 * f64::from(step);
        let expected = elastic.min(normal * material.friction_angle.tan());
        let [on_wall_n, on_wall_t] = simulation.wall_force[Side::Bottom as usize];
        assert!((on_wall_n / normal - 1.0).abs() < 1e-6);
        // t of the bottom wall is (−1, 0): the disc drags the wall along +x, against t.
        assert!((on_wall_t + expected).abs() < 1e-6 * normal, "{step}: {on_wall_t} {expected}");
        let torque = simulation.loads()[0].torque;
        assert!((torque + (R - overlap) * expected).abs() < 1e-6 * normal * R, "{torque}");
    }
}

/// A wall that moves with the disc causes no slip.
#[test]
fn wall_motion_counts_in_slip() {
    let material = undamped();
    let mut disc = Disc::at_rest(0.0, R - 1e-5, R, material.density);
    disc.vx = 1e-3;
    let mut walls = Walls { position: [-1.0, 1.0, 0.0, 1.0], ..Walls::around(1.0, 1.0) };
    walls.tangential_velocity[Side::Bottom as usize] = 1e-3;
    let mut simulation = Simulation::new(material, vec![disc], walls);
    simulation.step();
    assert_eq!(simulation.wall_force[Side::Bottom as usize][1], 0.0);
}

/// An open contact forgets its friction history: when the discs touch again, f_t starts from zero.
#[test]
fn history_is_cleared_when_a_contact_opens() {
    let mut simulation = two_discs(undamped(), 1e-5);
    simulation.discs[1].vy = 1e-2;
    while simulation.discs[1].x - simulation.discs[0].x < 2.0 * R + 1e-6 {
        simulation.step();
    }
    simulation.step();
    let mut contacts = 0;
    simulation.for_each_contact(|_| contacts += 1);
    assert_eq!(contacts, 0);
    assert_eq!(simulation.neighbours.pairs.tangential, [0.0]);
}

/// Without walls and damping, linear and angular momentum are conserved. The force acts at the middle of the overlap;
/// f_n is central, and the two lever arms of f_t add up to the centre distance. So both hold to the round-off of a
/// step.
#[test]
fn momentum_is_conserved() {
    let material = undamped();
    let mut discs: Vec<Disc> = (0..6)
        .map(|k| {
            let angle = f64::from(k) * PI / 3.0;
            Disc::at_rest(1.9 * R * angle.cos(), 1.9 * R * angle.sin(), R, material.density)
        })
        .collect();
    for (k, disc) in discs.iter_mut().enumerate() {
        disc.angular_velocity = 20.0 * k as f64;
        disc.vx = 1e-2 * (k as f64 - 2.5);
    }
    let mut simulation = Simulation::new(material, discs, far_walls());
    let momentum = |s: &Simulation| {
        s.discs.iter().fold([0.0; 3], |sum, d| {
            let spin = 0.5 * d.mass * d.radius * d.radius * d.angular_velocity;
            let orbit = d.mass * (d.x * d.vy - d.y * d.vx);
            [sum[0] + d.mass * d.vx, sum[1] + d.mass * d.vy, sum[2] + spin + orbit]
        })
    };
    let before = momentum(&simulation);
    (0..500).for_each(|_| simulation.step());
    let after = momentum(&simulation);
    for k in 0..3 {
        assert!((after[k] - before[k]).abs() < 1e-13, "{before:?} {after:?}");
    }
}

/// Radii follow r = r_ref (1 + ε), not compounded; mass stays.
#[test]
fn radii_follow_the_strain_linearly() {
    let mut simulation = two_discs(Material::default(), -0.1 * R);
    let mass = simulation.discs[0].mass;
    simulation.time_step = 1e-3;
    simulation.set_strain_rate(0.1);
    (0..200).for_each(|_| simulation.step());
    assert!((simulation.strain() - 0.02).abs() < 1e-15);
    assert!((simulation.discs[0].radius / (R * 1.02) - 1.0).abs() < 1e-15);
    assert_eq!(simulation.discs[0].mass, mass);
}

/// An agitated heap of discs of all sizes between closing walls, so that every branch of the kernels is executed.
fn heap() -> Simulation {
    let material = Material::default();
    let discs = (0..211)
        .map(|k| {
            let u = |a: f64| (a * f64::from(k + 1)).fract();
            let (column, line) = (f64::from(k % 15), f64::from(k / 15));
            let radius = 3e-3 + 4e-3 * u(0.618_034);
            let mut disc =
                Disc::at_rest(0.012 * (column + 0.7), 0.012 * (line + 0.7), radius, material.density);
            disc.vx = 0.1 * (u(0.414_214) - 0.5);
            disc.vy = 0.1 * (u(0.732_051) - 0.5);
            disc.angular_velocity = 10.0 * (u(0.236_068) - 0.5);
            disc
        })
        .collect();
    let mut simulation = Simulation::new(material, discs, Walls::around(0.185, 0.185));
    simulation.walls.normal_velocity = [0.05, -0.05, 0.02, 0.0];
    simulation.walls.tangential_velocity = [0.01, 0.0, -0.01, 0.0];
    simulation.free_drag = 5.0;
    simulation.set_strain_rate(0.05);
    simulation
}

/// Scalar, AVX2 and AVX-512 give the same bits.
#[test]
fn instruction_sets_agree_bit_for_bit() {
    let run = |simd| {
        let mut simulation = heap();
        simulation.set_simd(simd);
        (0..1500).for_each(|_| simulation.step());
        simulation
    };
    let scalar = run(Simd::Scalar);
    let mut touching = 0;
    scalar.for_each_contact(|_| touching += 1);
    assert!(touching > 300, "{touching}");
    for simd in [Simd::Avx2, Simd::Avx512].into_iter().filter(|simd| simd.available()) {
        let vector = run(simd);
        assert_eq!(vector.discs, scalar.discs, "{simd:?}");
        assert_eq!(vector.neighbours.pairs, scalar.neighbours.pairs);
    }
}

/// A speed that is NaN is detected by every instruction set in every lane, and makes the bound on the motion invalid.
#[test]
fn a_speed_that_is_no_number_is_no_small_speed() {
    for simd in Simd::ALL.into_iter().filter(|simd| simd.available()) {
        for broken in 0..19 {
            let mut discs = vec![Disc { vx: 0.5, ..Disc::at_rest(0.0, 0.0, R, 3000.0) }; 19];
            let motion = Motion { damping: 0.1, keep_free: 1.0, dt: 1e-5 };
            let loads = vec![Load::default(); 19];
            assert_eq!(kernel::advance(simd, motion, &mut discs, &loads), 0.25, "{simd:?}");
            discs[broken].vy = f64::NAN;
            assert!(kernel::advance(simd, motion, &mut discs, &loads).is_nan(), "{simd:?} {broken}");
        }
    }
    for bad in [f64::NAN, f64::INFINITY] {
        let mut simulation = heap();
        simulation.discs[3].vx = bad;
        simulation.step();
        assert!(!simulation.largest_speed.is_finite());
        // After the next step the candidate list counts as stale, whatever the other discs have done.
        simulation.advance_boundaries();
        assert!(simulation.neighbours.skin.used_up(&simulation.discs, None), "{bad}");
        assert!(matches!(simulation.run(50), Err(crate::Failure::NonFinite { disc: 3, .. })), "{bad}");
    }
}

/// The neighbour list never misses a contact: after many steps, all overlaps found by comparing all pairs are
/// candidates.
#[test]
fn no_contact_is_missed() {
    let mut simulation = heap();
    for _ in 0..40 {
        (0..10).for_each(|_| simulation.step());
        let mut listed = 0;
        simulation.for_each_contact(|contact| listed += usize::from(contact.i.is_ok()));
        let discs = &simulation.discs;
        let touch = |a: &Disc, b: &Disc| {
            let reach = a.radius + b.radius;
            (b.x - a.x).powi(2) + (b.y - a.y).powi(2) < reach * reach
        };
        let found: usize =
            (0..discs.len()).map(|i| discs[i + 1..].iter().filter(|b| touch(&discs[i], b)).count()).sum();
        // A contact made by the last motion is found only in the next step.
        assert!(found.abs_diff(listed) <= 1, "{found} {listed}");
    }
    assert!(simulation.rebuilds() > 2);
}

/// An assembly large enough for several slabs gives the same bits on one thread and on three.
#[test]
fn threads_do_not_change_the_bits() {
    let run = |threads| {
        let material = Material::default();
        let discs = (0..4200)
            .map(|k| {
                let u = |a: f64| (a * f64::from(k + 1)).fract();
                let (column, line) = (f64::from(k % 70), f64::from(k / 70));
                let radius = 4.5e-3 + 1e-3 * u(0.618_034);
                let mut disc =
                    Disc::at_rest(0.01 * (column + 0.5), 0.01 * (line + 0.5), radius, material.density);
                disc.vx = 0.05 * (u(0.414_214) - 0.5);
                disc
            })
            .collect();
        let mut simulation = Simulation::new(material, discs, Walls::around(0.7, 0.6));
        simulation.set_strain_rate(0.2);
        simulation.set_threads(threads).unwrap();
        simulation.run(120).unwrap();
        simulation.enable_heat(Thermal::default(), [WallHeat::Temperature(20.0); 4]);
        simulation.run(60).unwrap();
        simulation
    };
    let (one, three) = (run(1), run(3));
    assert_eq!(one.discs, three.discs);
    assert!(one.discs.iter().any(|disc| disc.temperature > 0.0));
    assert_eq!(one.wall_force, three.wall_force);
    let mut contacts = 0;
    one.for_each_contact(|_| contacts += 1);
    assert!(contacts > 4000, "{contacts}");
}

/// With affine motion, grains keep their relative places in the box and feel no force as long as none touch. Grains
/// that touch feel the slip of the affine motion: f_t = −ν s_n (u_t of j − u_t of i) Δt.
#[test]
fn affine_motion_carries_the_grains() {
    let material = undamped();
    let apart = [Disc::at_rest(0.3, 0.2, R, 3000.0), Disc::at_rest(0.7, 0.6, R, 3000.0)];
    let mut simulation = Simulation::new(material.clone(), apart.to_vec(), Walls::around(1.0, 0.8));
    simulation.affine = true;
    simulation.walls.normal_velocity = [0.1, -0.1, 0.0, -0.04];
    (0..200).for_each(|_| simulation.step());
    let walls = &simulation.walls;
    for (disc, start) in simulation.discs.iter().zip(&apart) {
        let place = (disc.x - walls.position[0]) / walls.width();
        assert!((place - start.x).abs() < 1e-12 && (disc.y / walls.height() - start.y / 0.8).abs() < 1e-12);
        assert_eq!((disc.vx, disc.vy), (0.0, 0.0));
    }

    let d = (2.0 * R - 1e-4) / 2f64.sqrt();
    let touching = vec![Disc::at_rest(0.5, 0.4, R, 3000.0), Disc::at_rest(0.5 + d, 0.4 + d, R, 3000.0)];
    let mut simulation = Simulation::new(material, touching, Walls::around(1.0, 0.8));
    simulation.affine = true;
    simulation.walls.normal_velocity = [0.0, -0.01, 0.0, 0.0];
    simulation.step();
    let mut force = f64::NAN;
    simulation.for_each_contact(|contact| force = contact.tangential_force);
    // u_x = −0.01 x /s, t = (−1, 1)/√2: slip speed 0.01 d/√2.
    let expected = -0.8 * 1e7 * R * 0.01 * d / 2f64.sqrt() * simulation.time_step;
    assert!((force / expected - 1.0).abs() < 1e-4, "{force} {expected}");
}
