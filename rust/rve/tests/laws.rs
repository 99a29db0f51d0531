//! Laws of symmetry, size and balance on packed RVEs.

use msdd_dem::{Disc, Side, Walls};
use msdd_rve::{
    Averages, Compression, Material, Outcome, Packed, PackingSpec, Protocol, Ramp, RegionKind, Simulation,
    Strains, follow, homogenise, pack,
};

const KINDS: [RegionKind; 2] = [RegionKind::Hull, RegionKind::Inset];

fn packed(compression: Compression, material: &Material) -> Packed {
    let spec = PackingSpec { discs: 200, seed: 3, porosity: 0.12, compression, ..PackingSpec::default() };
    let packed = pack(&spec, material).unwrap();
    assert_eq!(packed.settled.outcome, Outcome::Settled);
    packed
}

/// The same state after a map of discs, walls and sides; friction forces are multiplied by `force`.
fn mapped(
    simulation: &Simulation,
    material: Material,
    walls: Walls,
    disc: impl Fn(&Disc) -> Disc,
    side: impl Fn(Side) -> Side,
    force: f64,
) -> Simulation {
    let mut image = Simulation::new(material, simulation.discs.iter().map(disc).collect(), walls);
    image.time_step = simulation.time_step;
    image.free_drag = simulation.free_drag;
    simulation.for_each_contact(|contact| {
        let i = contact.i.map_err(&side);
        assert!(image.set_tangential_force(i, contact.j, force * contact.tangential_force));
    });
    image
}

/// A quarter turn: (x, y) becomes (−y, x), and left, right, bottom, top become bottom, top, right, left.
fn turned(simulation: &Simulation) -> Simulation {
    let [left, right, bottom, top] = simulation.walls.position;
    let walls = Walls { position: [-top, -bottom, left, right], ..simulation.walls.clone() };
    let disc = |d: &Disc| Disc { x: -d.y, y: d.x, vx: -d.vy, vy: d.vx, ..*d };
    let side = |side| match side {
        Side::Left => Side::Bottom,
        Side::Right => Side::Top,
        Side::Bottom => Side::Right,
        Side::Top => Side::Left,
    };
    mapped(simulation, simulation.material.clone(), walls, disc, side, 1.0)
}

fn close(name: &str, value: f64, expected: f64, scale: f64) {
    assert!((value - expected).abs() <= 1e-12 * scale, "{name}: {value} {expected}");
}

/// A quarter turn permutes the averages, to the last bit: contacts keep their order, and the area of the region does
/// not depend on which of its corners comes first. Porosity agrees only to round-off: the free arcs of a disc are given
/// by angles from the x axis, so an angle near 0 becomes one near 3π/2.
#[test]
fn quarter_turn_permutes_the_averages() {
    let state = packed(Compression::Horizontal, &Material::default()).simulation;
    let image = turned(&state);
    for kind in KINDS {
        let (a, b) = (homogenise(&state, kind), homogenise(&image, kind));
        assert!(a.conductivity_xx > 1.05 * a.conductivity_yy, "nothing to permute: {a:?}");
        close("porosity", b.porosity, a.porosity, 1.0);
        close("overlap", b.overlap_fraction, a.overlap_fraction, 1.0);
        close("network K_xx", b.conductivity_network_xx, a.conductivity_network_yy, 1.0);
        close("network K_yy", b.conductivity_network_yy, a.conductivity_network_xx, 1.0);
        close("network K_xy", b.conductivity_network_xy, -a.conductivity_network_xy, 1.0);
        let mut expected = a;
        (expected.porosity, expected.overlap_fraction) = (b.porosity, b.overlap_fraction);
        // These result from the solution of a linear system, so they agree only to its round-off.
        expected.conductivity_network_xx = b.conductivity_network_xx;
        expected.conductivity_network_yy = b.conductivity_network_yy;
        expected.conductivity_network_xy = b.conductivity_network_xy;
        expected.fabric_index = -a.fabric_index;
        (expected.fabric_xx, expected.fabric_yy) = (a.fabric_yy, a.fabric_xx);
        expected.fabric_xy = -a.fabric_xy;
        expected.fabric_conductivity = -a.fabric_conductivity;
        (expected.conductivity_xx, expected.conductivity_yy) = (a.conductivity_yy, a.conductivity_xx);
        expected.conductivity_xy = -a.conductivity_xy;
        (expected.stress_xx, expected.stress_yy) = (a.stress_yy, a.stress_xx);
        (expected.stress_xy, expected.stress_yx) = (-a.stress_yx, -a.stress_xy);
        assert_eq!(b, expected);
    }
}

/// The mirror image x → −x has the opposite F_xy and K_xy, to the last bit: contacts keep their order. Friction forces
/// turn the other way.
#[test]
fn a_mirror_turns_the_sign_of_what_leans() {
    let state = packed(Compression::Horizontal, &Material::default()).simulation;
    let [left, right, bottom, top] = state.walls.position;
    let walls = Walls { position: [-right, -left, bottom, top], ..state.walls.clone() };
    let disc = |d: &Disc| Disc { x: -d.x, vx: -d.vx, angular_velocity: -d.angular_velocity, ..*d };
    let side = |side| match side {
        Side::Left => Side::Right,
        Side::Right => Side::Left,
        other => other,
    };
    let image = mapped(&state, state.material.clone(), walls, disc, side, -1.0);
    for kind in KINDS {
        let (a, b) = (homogenise(&state, kind), homogenise(&image, kind));
        assert!(a.fabric_xy != 0.0 && a.fabric_xy.abs() < 0.5, "{a:?}");
        assert_eq!((b.fabric_xy, b.contacts), (-a.fabric_xy, a.contacts));
        assert_eq!((b.fabric_xx, b.fabric_yy, b.fabric_index), (a.fabric_xx, a.fabric_yy, a.fabric_index));
        close("K_xy", b.conductivity_xy, -a.conductivity_xy, 1.0);
    }
}

#[test]
fn four_quarter_turns_are_none() {
    let state = packed(Compression::Horizontal, &Material::default()).simulation;
    let image = turned(&turned(&turned(&turned(&state))));
    assert_eq!(image.discs, state.discs);
    assert_eq!(image.walls, state.walls);
    let contacts = |s: &Simulation| {
        let mut list = Vec::new();
        s.for_each_contact(|c| list.push((c.i, c.j, c.tangential_force)));
        list
    };
    assert_eq!(contacts(&image), contacts(&state));
}

/// The assembly enlarged by `size` and with `density` times the density. Stiffnesses grow with `size`, forces with its
/// square, masses with density · size², so times grow with √(density · size) and strain rates with its inverse.
fn scaled(simulation: &Simulation, size: f64, density: f64) -> Simulation {
    let material = Material { density: density * simulation.material.density, ..simulation.material.clone() };
    let time = (density * size).sqrt();
    let speed = size / time;
    let walls = Walls {
        position: simulation.walls.position.map(|x| size * x),
        normal_velocity: simulation.walls.normal_velocity.map(|v| speed * v),
        tangential_velocity: simulation.walls.tangential_velocity.map(|v| speed * v),
    };
    let disc = |d: &Disc| Disc {
        x: size * d.x,
        y: size * d.y,
        radius: size * d.radius,
        vx: speed * d.vx,
        vy: speed * d.vy,
        angular_velocity: d.angular_velocity / time,
        mass: density * size * size * d.mass,
        ..*d
    };
    let mut image = mapped(simulation, material, walls, disc, |side| side, size * size);
    image.time_step *= time;
    image.free_drag /= time;
    image
}

/// Twice the size at half the density: the time step stays the same, and every number of a run is multiplied by a power
/// of two.
fn doubled(simulation: &Simulation) -> Simulation {
    scaled(simulation, 2.0, 0.5)
}

/// [`Averages`] of an assembly enlarged by `size`: K/k, η and f stay the same, σ/E and r̄ grow in proportion.
fn enlarged(averages: &Averages, size: f64) -> Averages {
    let mut large = *averages;
    for stress in [
        &mut large.stress_xx,
        &mut large.stress_yy,
        &mut large.stress_xy,
        &mut large.stress_yx,
        &mut large.pressure,
        &mut large.mean_radius,
    ] {
        *stress *= size;
    }
    large
}

/// K/k, η and f stay the same and σ/E doubles, to the last bit.
fn assert_doubled(small: &Averages, large: &Averages) {
    assert_eq!(*large, enlarged(small, 2.0));
}

/// Stops of a packing strained at `rate` times the default rates.
fn stops_at(start: &Simulation, strains: [f64; 2], rate: f64) -> Vec<Averages> {
    let standard = Protocol::default();
    let protocol = Protocol {
        expansion_rate: rate * standard.expansion_rate,
        contraction_rate: rate * standard.contraction_rate,
        ..standard
    };
    let path = strains.map(Strains::thermal);
    let ramp = follow(&mut start.clone(), &path, protocol, |_, _| ()).unwrap();
    assert!(ramp.failure.is_none());
    ramp.stops.iter().map(|stop| stop.averages).collect()
}

/// Four times the size at equal density: times double and rates halve, so all factors are powers of two again and the
/// agreement is exact.
#[test]
fn four_times_the_size_at_equal_density_is_exact() {
    let small = packed(Compression::Horizontal, &Material::default()).simulation;
    let large = scaled(&small, 4.0, 1.0);
    for strains in [[0.005, 0.02], [-0.005, -0.01]] {
        let expected = stops_at(&small, strains, 1.0).iter().map(|a| enlarged(a, 4.0)).collect::<Vec<_>>();
        assert_eq!(stops_at(&large, strains, 0.5), expected);
    }
}

/// Twice the size at equal density: times grow by √2, which causes round-off. Measured differences are below 2e-14. The
/// tolerance 1e-9 leaves room for the growth of round-off in sliding and opening contacts, and is far below the effect
/// of a single additional contact.
#[test]
fn twice_the_size_at_equal_density_doubles_stress_alone() {
    let small = packed(Compression::Horizontal, &Material::default()).simulation;
    let large = scaled(&small, 2.0, 1.0);
    for strains in [[0.005, 0.02], [-0.005, -0.01]] {
        let expected = stops_at(&small, strains, 1.0);
        let found = stops_at(&large, strains, std::f64::consts::FRAC_1_SQRT_2);
        for (a, b) in expected.iter().map(|a| enlarged(a, 2.0)).zip(&found) {
            for (value, expected, scale) in [
                (b.stress_xx, a.stress_xx, a.pressure),
                (b.stress_yy, a.stress_yy, a.pressure),
                (b.stress_xy, a.stress_xy, a.pressure),
                (b.conductivity_xx, a.conductivity_xx, a.conductivity_xx),
                (b.conductivity_yy, a.conductivity_yy, a.conductivity_yy),
                (b.porosity, a.porosity, 1.0),
                (b.mean_radius, a.mean_radius, a.mean_radius),
            ] {
                assert!((value - expected).abs() <= 1e-9 * scale, "{b:?} {a:?}");
            }
            assert!((b.fabric_index - a.fabric_index).abs() < 1e-9, "{b:?} {a:?}");
        }
    }
}

/// Compression from loose to jammed and relaxation, with explicit wall speeds, because [`pack`] chooses its own.
fn compressed(mut simulation: Simulation) -> Simulation {
    for _ in 0..60 {
        simulation.run(50).unwrap();
    }
    simulation.walls.stop();
    for _ in 0..100 {
        simulation.run(50).unwrap();
    }
    simulation
}

#[test]
fn twice_the_size_doubles_stress_alone_after_packing() {
    let material = Material::default();
    let discs = (0..196)
        .map(|k| {
            let u = |a: f64| (a * f64::from(k + 1)).fract();
            let radius = 3e-3 + 3.5e-3 * u(0.618_034);
            Disc::at_rest(0.0132 * (f64::from(k % 14) + 0.5), 0.0132 * (f64::from(k / 14) + 0.5), radius, 3e3)
        })
        .collect();
    let mut start = Simulation::new(material, discs, Walls::around(0.1848, 0.1848));
    start.free_drag = 20.0;
    start.walls.normal_velocity = [0.02, -0.02, 0.02, -0.02];
    let large = compressed(doubled(&start));
    let small = compressed(start);
    for kind in KINDS {
        let averages = homogenise(&small, kind);
        assert!(averages.coordination > 3.0 && averages.porosity < 0.2, "{averages:?}");
        assert_doubled(&averages, &homogenise(&large, kind));
    }
}

/// One ramp of thermal strain from the packed state through `stops`.
fn expand(packed: &Packed, stops: &[f64]) -> Ramp {
    let path: Vec<Strains> = stops.iter().copied().map(Strains::thermal).collect();
    let protocol = Protocol::usual(&packed.simulation);
    follow(&mut packed.simulation.clone(), &path, protocol, |_, _| ()).unwrap()
}

#[test]
fn twice_the_size_doubles_stress_alone_after_expansion() {
    let small = packed(Compression::Horizontal, &Material::default());
    let large = Packed { simulation: doubled(&small.simulation), settled: small.settled };
    assert_doubled(
        &homogenise(&small.simulation, RegionKind::Hull),
        &homogenise(&large.simulation, RegionKind::Hull),
    );
    for strains in [[0.005, 0.02], [-0.005, -0.01]] {
        let [a, b] = [&small, &large].map(|packed| expand(packed, &strains));
        assert!(a.failure.is_none() && b.failure.is_none());
        for (a, b) in a.stops.iter().zip(&b.stops) {
            assert_eq!(a.settled, b.settled);
            assert_doubled(&a.averages, &b.averages);
        }
    }
}

/// Σ branch ⊗ force over all contacts, walls included, in x and y: Love's stress times the area of the box [N m].
fn love(simulation: &Simulation) -> [f64; 2] {
    let mut sum = [0.0; 2];
    simulation.for_each_contact(|contact| {
        let force = contact.force();
        (0..2).for_each(|k| sum[k] += contact.branch[k] * force[k]);
    });
    sum
}

/// The same from the wall forces: forces of opposite walls times their distance, less the moment of the friction on the
/// other two walls about the middle of the box. Equal to Love's when every disc is in equilibrium, since then Σ x_i F_i
/// = 0.
fn from_walls(simulation: &Simulation) -> [f64; 2] {
    let [left, right, bottom, top] = simulation.walls.position;
    let middle = [0.5 * (left + right), 0.5 * (bottom + top)];
    let half = [0.5 * (right - left), 0.5 * (top - bottom)];
    let normal = simulation.wall_force.map(|force| force[0]);
    let mut sum = [half[0] * (normal[0] + normal[1]), half[1] * (normal[2] + normal[3])];
    simulation.for_each_contact(|contact| {
        let along = match contact.i {
            Err(Side::Left | Side::Right) => 1,
            Err(_) => 0,
            Ok(_) => return,
        };
        let disc = &simulation.discs[contact.j];
        sum[along] -= ([disc.x, disc.y][along] - middle[along]) * contact.force()[along];
    });
    sum
}

/// A tenth of Σ |x_i| |F_i|, the largest possible effect of the remaining unbalanced forces, which point in random
/// directions. It is 6e-5 of the stress; measured differences are 2e-5 at most.
fn tolerance(simulation: &Simulation) -> f64 {
    let reach = 0.5 * simulation.walls.width().max(simulation.walls.height());
    0.1 * reach * simulation.loads().iter().map(|load| load.fx.hypot(load.fy)).sum::<f64>()
}

#[test]
fn love_stress_agrees_with_wall_forces() {
    for compression in [Compression::Isotropic, Compression::Horizontal] {
        let state = packed(compression, &Material::default()).simulation;
        let (stress, walls, allowed) = (love(&state), from_walls(&state), tolerance(&state));
        for k in 0..2 {
            println!("{compression:?} {} {} {}", stress[k], walls[k] / stress[k] - 1.0, allowed / stress[k]);
            assert!(allowed < 1e-4 * stress[k], "{allowed} {stress:?}");
            assert!((stress[k] - walls[k]).abs() < allowed, "{stress:?} {walls:?} {allowed}");
        }
    }
}

/// Without friction, Love's stress times the area is wall force times width alone.
#[test]
fn love_stress_of_smooth_discs_is_wall_force_times_width() {
    let state =
        packed(Compression::Isotropic, &Material { friction_angle: 0.0, ..Material::default() }).simulation;
    let (stress, allowed) = (love(&state), tolerance(&state));
    let [left, right, bottom, top] = state.wall_force.map(|force| force[0]);
    let expected = [0.5 * (left + right) * state.walls.width(), 0.5 * (bottom + top) * state.walls.height()];
    for k in 0..2 {
        assert!(allowed < 1e-4 * stress[k], "{allowed} {stress:?}");
        assert!((stress[k] - expected[k]).abs() < allowed, "{stress:?} {expected:?} {allowed}");
    }
}
