//! Periodic boxes: what happens across the border is what happens anywhere else in the cell.

use msdd_dem::{Disc, Material, Periodic, Simd, Simulation, Thermal, WallHeat, Walls};

const WIDTH: f64 = 0.05;
const HEIGHT: f64 = 0.04;
const OFFSET: f64 = 0.013;

fn sheared_box(discs: Vec<Disc>, material: Material, shear_rate: f64) -> Simulation {
    let walls = Walls::around(WIDTH, HEIGHT);
    let periodic = Periodic { shear_offset: OFFSET, shear_rate };
    let mut simulation = Simulation::new_periodic(material, discs, walls, periodic).unwrap();
    simulation.walls.normal_velocity = [0.002, -0.001, -0.001, 0.003];
    simulation
}

/// Two discs that collide, rub, spin, and exchange heat, near the point `middle`; the second one is replaced by its
/// image by `shift`.
fn collision(middle: [f64; 2], shift: [i32; 2]) -> Simulation {
    let disc = |x: f64, y: f64, radius: f64| Disc::at_rest(middle[0] + x, middle[1] + y, radius, 3000.0);
    let mut a = Disc { vx: 0.05, vy: 0.08, angular_velocity: 3.0, ..disc(-0.004, -0.003, 4e-3) };
    let b = Disc { vx: -0.04, angular_velocity: -5.0, temperature: 50.0, ..disc(0.004, 0.003, 5.9e-3) };
    a.temperature = 10.0;
    let b = sheared_box(vec![], Material::default(), 0.0).cell().unwrap().image(&b, shift);
    let mut simulation = sheared_box(vec![a, b], Material::default(), 0.3);
    let thermal = Thermal::default();
    simulation.enable_heat(thermal, [WallHeat::Insulated; 4]);
    simulation
}

#[test]
fn a_collision_across_a_border_is_that_in_the_middle() {
    let mut reference = collision([0.025, 0.02], [0, 0]);
    let start = reference.discs.clone();
    let steps = (0.2 / reference.time_step) as u64;
    reference.take_steps(steps);
    assert!(reference.discs[0].temperature > start[0].temperature + 1.0, "no heat flowed");
    assert!((reference.discs[0].angular_velocity - start[0].angular_velocity).abs() > 0.5, "no friction");
    for (middle, shift) in
        [([0.0, 0.02], [1, 0]), ([0.02, 0.04], [0, -1]), ([0.05, 0.0], [-1, 1]), ([0.0, 0.0], [1, 1])]
    {
        let mut across = collision(middle, shift);
        across.take_steps(steps);
        for (a, b) in across.discs.iter().zip(&reference.discs) {
            let close = |what: &str, a: f64, b: f64| {
                assert!((a - b).abs() < 1e-10 * (1.0 + b.abs()), "{what} at {shift:?}: {a} {b}");
            };
            close("vx", a.vx, b.vx);
            close("vy", a.vy, b.vy);
            close("spin", a.angular_velocity, b.angular_velocity);
            close("temperature", a.temperature, b.temperature);
            close("radius", a.radius, b.radius);
        }
    }
}

/// Discs of two sizes on a grid, each with a velocity of its own; `spacing` [m].
fn crowd(spacing: f64, speed: f64) -> Vec<Disc> {
    let fraction = |k: u32, a: f64| (a * f64::from(k + 1)).fract() - 0.5;
    let place = |k: u32| (f64::from(k % 5) * spacing, f64::from(k / 5) * spacing);
    (0..20)
        .map(|k| {
            let (x, y) = place(k);
            let radius = if k % 3 == 0 { 5.2e-3 } else { 4.7e-3 };
            let mut disc = Disc::at_rest(x, y, radius, 3000.0);
            disc.vx = speed * fraction(k, 0.618_034);
            disc.vy = speed * fraction(k, 0.414_214);
            disc.angular_velocity = 100.0 * speed * fraction(k, 0.732_051);
            disc
        })
        .collect()
}

#[test]
fn momentum_is_conserved_without_damping() {
    let material = Material { damping: 0.0, ..Material::default() };
    let mut simulation = sheared_box(crowd(0.01, 0.3), material, 0.5);
    let momentum =
        |discs: &[Disc]| discs.iter().fold([0.0, 0.0], |[x, y], d| [x + d.mass * d.vx, y + d.mass * d.vy]);
    let scale: f64 = simulation.discs.iter().map(|d| d.mass * d.vx.hypot(d.vy)).sum();
    let start = momentum(&simulation.discs);
    let velocity = simulation.discs[7].vx;
    let mut across = 0;
    for _ in 0..100 {
        simulation.run(20).unwrap();
        simulation.for_each_contact(|contact| across += u32::from(contact.shift != [0, 0]));
    }
    assert!(across > 20 && (simulation.discs[7].vx - velocity).abs() > 1e-2, "{across} contacts across");
    for (now, before) in momentum(&simulation.discs).into_iter().zip(start) {
        assert!((now - before).abs() < 1e-12 * scale, "{now} {before}");
    }
}

#[test]
fn all_instruction_sets_give_the_same_bits() {
    let run = |simd: Simd| {
        let mut simulation = sheared_box(crowd(0.01, 0.2), Material::default(), 0.4);
        simulation.set_simd(simd);
        simulation.set_strain_rate(0.05);
        simulation.run(1500).unwrap();
        assert!(simulation.rebuilds() > 2, "no rebuild");
        simulation.discs
    };
    let scalar = run(Simd::Scalar);
    for simd in [Simd::Avx2, Simd::Avx512].into_iter().filter(|simd| simd.available()) {
        assert_eq!(run(simd), scalar, "{simd:?}");
    }
}

/// With a disc whose velocity is NaN, infinite or absurdly large the neighbour search still terminates, and the run ends
/// with an error.
#[test]
fn a_disc_without_a_velocity_ends_the_run() {
    for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY, 1e300] {
        let mut simulation = sheared_box(crowd(0.01, 0.2), Material::default(), 0.4);
        simulation.discs[5].vy = bad;
        assert!(simulation.run(200).is_err(), "{bad}");
        assert!(simulation.rebuilds() > 1, "{bad}");
    }
}

/// A sticking pair across the border, next to a disc that flies about when `fast` is not 0 and so causes rebuilds.
fn stuck(fast: f64) -> Simulation {
    let disc = |x: f64, y: f64| Disc::at_rest(x, y, 5e-3, 3000.0);
    let third = Disc { vx: 0.2 * fast, vy: fast, ..disc(0.025, 0.02) };
    let mut simulation =
        sheared_box(vec![disc(0.0455, 0.02), disc(0.005, 0.02), third], Material::default(), 0.0);
    simulation.walls.stop();
    simulation.discs[0].vy = 1e-3;
    simulation.discs[1].angular_velocity = 0.1;
    simulation
}

#[test]
fn friction_history_survives_rebuilds() {
    let mut simulations = [stuck(0.0), stuck(4.0)];
    let mut friction = [0.0; 2];
    for (simulation, friction) in simulations.iter_mut().zip(&mut friction) {
        // Fixed, because the fast disc must not change the time step; the sticking pair separates after about 2 ms.
        simulation.time_step = 1e-5;
        simulation.take_steps(80);
        simulation.for_each_contact(|contact| {
            assert_eq!((contact.i, contact.j, contact.shift), (Ok(0), 1, [1, 0]));
            *friction = contact.tangential_force;
        });
    }
    assert!(simulations[1].rebuilds() > simulations[0].rebuilds());
    assert!(friction[0] != 0.0);
    assert_eq!(friction[1], friction[0]);
    assert_eq!(simulations[1].discs[..2], simulations[0].discs[..2]);
}

/// The neighbour search must not lose any pair while the cell deforms and the list is rebuilt rarely.
#[test]
fn contacts_are_those_of_brute_force() {
    let mut simulation = sheared_box(crowd(0.01, 0.05), Material::default(), 2.0);
    for _ in 0..20 {
        simulation.run(40).unwrap();
        let cell = simulation.cell().unwrap();
        let mut expected = 0;
        for (i, a) in simulation.discs.iter().enumerate() {
            for b in &simulation.discs[i + 1..] {
                for shift in (-8..=8).flat_map(|x| (-3..=3).map(move |y| [x, y])) {
                    let b = cell.image(b, shift);
                    expected += u32::from((a.x - b.x).hypot(a.y - b.y) < a.radius + b.radius);
                }
            }
        }
        let mut found = 0;
        simulation.for_each_contact(|_| found += 1);
        assert_eq!(found, expected);
    }
    let offset = simulation.periodic.unwrap().shear_offset;
    assert!(offset > OFFSET + 0.1 * HEIGHT, "{offset}");
}

#[test]
fn cells_in_which_a_disc_meets_two_images_are_refused() {
    let discs = vec![Disc::at_rest(0.0, 0.0, 0.011, 3000.0)];
    let walls = Walls::around(WIDTH, HEIGHT);
    let refused = Simulation::new_periodic(Material::default(), discs, walls, Periodic::default());
    assert!(refused.unwrap_err().to_string().starts_with("periodic box: height = 0.04 m"));
    let mut growing = sheared_box(vec![Disc::at_rest(0.0, 0.0, 0.0099, 3000.0)], Material::default(), 0.0);
    growing.set_strain_rate(1.0);
    assert!(growing.run(1000).unwrap_err().to_string().contains("periodic box: height"));
}
