//! Motion of one and two discs compared with closed forms.

use msdd_dem::{Disc, Material, Simulation, Walls};

const R: f64 = 5e-3;
const E: f64 = 1e7;

fn undamped() -> Material {
    Material { damping: 0.0, ..Material::default() }
}

/// A disc pressed by `overlap` between bottom and top wall.
fn pinched(overlap: f64) -> Simulation {
    let material = undamped();
    let disc = Disc::at_rest(0.0, 0.0, R, material.density);
    let height = 2.0 * (R - overlap);
    let walls = Walls { position: [-1.0, 1.0, -0.5 * height, 0.5 * height], ..Walls::around(1.0, 1.0) };
    Simulation::new(material, vec![disc], walls)
}

/// Number of steps, interpolated, in which `value` makes `swings` full oscillations.
fn steps_of(simulation: &mut Simulation, swings: u32, value: impl Fn(&Disc) -> f64) -> f64 {
    let mut crossings = 0;
    let mut last = value(&simulation.discs[0]);
    let mut first = None;
    loop {
        simulation.step();
        let next = value(&simulation.discs[0]);
        if last < 0.0 && next >= 0.0 {
            // Linear interpolation of the zero crossing.
            let at = simulation.steps as f64 - next / (next - last);
            let start = *first.get_or_insert(at);
            if crossings == swings {
                return at - start;
            }
            crossings += 1;
        }
        last = next;
        assert!(simulation.steps < 1_000_000, "it does not swing");
    }
}

/// Pressed between two walls, a disc oscillates normal to them with ω² = 2 s_n/m, parallel to them with 2 s_t/m, and in
/// rotation with 2 s_t a²/I, where a = r − δ and I = m r²/2. Symplectic Euler shortens the period by sin(ω' Δt/2) = ω
/// Δt/2; with that correction the formulas are exact.
#[test]
fn pinched_disc_has_its_three_frequencies() {
    let overlap = 1e-4;
    let arm = R - overlap;
    let stiffness = E * R;
    let tangential = 0.8 * stiffness;
    let mass = pinched(overlap).discs[0].mass;
    type Push = fn(&mut Disc);
    type Value = fn(&Disc) -> f64;
    let across: (Push, Value, f64) = (|d| d.vy = 1e-4, |d| d.vy, 2.0 * stiffness / mass);
    let along: (Push, Value, f64) = (|d| d.vx = 1e-4, |d| d.vx, 2.0 * tangential / mass);
    let about: (Push, Value, f64) = (
        |d| d.angular_velocity = 0.02,
        |d| d.angular_velocity,
        2.0 * tangential * arm * arm / (0.5 * mass * R * R),
    );
    for (push, value, squared) in [across, along, about] {
        let mut simulation = pinched(overlap);
        push(&mut simulation.discs[0]);
        let swing = 0.5 * squared.sqrt() * simulation.time_step;
        let expected = 20.0 * std::f64::consts::PI / swing.asin();
        let steps = steps_of(&mut simulation, 20, value);
        assert!((steps / expected - 1.0).abs() < 2e-4, "{steps} {expected}");
    }
}

/// A disc thrown at a wall leaves it after half a period, π √(m/s_n), with the speed at which it came.
#[test]
fn disc_bounces_off_a_wall_in_half_a_period() {
    for factor in [1.0, 2.0] {
        let material = Material { wall_stiffness_factor: factor, ..undamped() };
        let mut disc = Disc::at_rest(0.0, R, R, material.density);
        disc.vy = -0.05;
        let half_period = std::f64::consts::PI * (disc.mass / (factor * E * R)).sqrt();
        let walls = Walls { position: [-1.0, 1.0, 0.0, 1.0], ..Walls::around(1.0, 1.0) };
        let mut simulation = Simulation::new(material, vec![disc], walls);
        simulation.time_step = half_period / 5000.0;
        simulation.step();
        let mut touching = 1u32;
        while simulation.discs[0].y < R {
            simulation.step();
            touching += 1;
        }
        assert!((f64::from(touching) / 5000.0 - 1.0).abs() < 1e-3, "{touching}");
        assert!((simulation.discs[0].vy / 0.05 - 1.0).abs() < 1e-3);
        assert_eq!(simulation.discs[0].vx, 0.0);
    }
}

/// Two discs so heavy that they hardly move, side by side, overlapping by `overlap`.
fn heavy_pair(overlap: f64) -> Simulation {
    let material = undamped();
    let mut discs = vec![
        Disc::at_rest(0.0, 0.0, R, material.density),
        Disc::at_rest(1.6 * R - overlap, 0.0, 0.6 * R, material.density),
    ];
    discs.iter_mut().for_each(|d| d.mass *= 1e8);
    let walls = Walls { position: [-1.0, 1.0, -1.0, 1.0], ..Walls::around(1.0, 1.0) };
    let mut simulation = Simulation::new(material, discs, walls);
    simulation.time_step = 1e-4;
    simulation
}

/// A spinning disc drags its neighbour. Both feel a torque of the same sense, −(r − δ/2) f_n tan φ each, so the spin of
/// the first falls linearly, and the neighbour is accelerated along the common tangent.
#[test]
fn sliding_discs_exchange_torque() {
    let overlap = 1e-4;
    let mut simulation = heavy_pair(overlap);
    // Fast enough to slide from the first step on.
    simulation.discs[0].angular_velocity = 200.0;
    (0..500).for_each(|_| simulation.step());
    let normal = 2.0 * E * R * 0.6 / 1.6 * overlap;
    let tangential = normal * 0.5f64.tan();
    for (disc, start) in simulation.discs.iter().zip([200.0, 0.0]) {
        let inertia = 0.5 * disc.mass * disc.radius * disc.radius;
        let lost = 500.0 * 1e-4 * (disc.radius - 0.5 * overlap) * tangential / inertia;
        let change = start - disc.angular_velocity;
        assert!((change / lost - 1.0).abs() < 1e-4, "{change} {lost}");
    }
    // On the neighbour f_t acts along +y, on the spinning disc along −y.
    let [a, b] = [0, 1].map(|k| simulation.loads()[k]);
    assert!((b.fy / tangential - 1.0).abs() < 1e-4 && (a.fy + b.fy).abs() < 1e-9, "{a:?} {b:?}");
}

/// Rolling without slip causes no friction: neither as two gears, ω₁ a₁ = −ω₂ a₂, nor when one disc rolls around the
/// other.
#[test]
fn rolling_discs_feel_no_friction() {
    let overlap = 1e-4;
    let [a, b] = [R - 0.5 * overlap, 0.6 * R - 0.5 * overlap];
    let mut gears = heavy_pair(overlap);
    (gears.discs[0].angular_velocity, gears.discs[1].angular_velocity) = (1.0 / a, -1.0 / b);
    let mut orbit = heavy_pair(overlap);
    (orbit.discs[1].vy, orbit.discs[1].angular_velocity) = (1.0, 1.0 / b);
    let mut slipping = heavy_pair(overlap);
    (slipping.discs[1].vy, slipping.discs[1].angular_velocity) = (1.0, -1.0 / b);
    let limit = 2.0 * E * R * 0.6 / 1.6 * overlap * 0.5f64.tan();
    for (simulation, share) in [(&mut gears, 0.0), (&mut orbit, 0.0), (&mut slipping, -1.0)] {
        simulation.step();
        let along = simulation.loads()[1].fy;
        assert!((along - share * limit).abs() < 1e-9 * limit, "{along} {limit}");
    }
}
