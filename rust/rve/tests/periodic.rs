//! Periodic RVEs: lattices in closed form, invariance of the averages, straining, state files.

use msdd_dem::{Disc, Periodic, Walls};
use msdd_rve::state::{from_json, to_json};
use msdd_rve::{
    Averages, Boundary, Compression, Material, PackingSpec, Protocol, RegionKind, Simulation, Strains,
    follow, homogenise, pack,
};
use std::f64::consts::PI;

const RADIUS: f64 = 5e-3;
/// Spacing of the lattices: the overlap is 1 % of it.
const SPACING: f64 = 2.0 * RADIUS / 1.01;

fn close(what: &str, found: f64, expected: f64, tolerance: f64) {
    assert!((found - expected).abs() <= tolerance, "{what}: {found}, expected {expected}");
}

/// `lines` lines of `columns` discs each; the distance between lines is `rise`, and each is displaced by `slip` to the
/// right of the one below.
fn lattice(columns: u32, lines: u32, rise: f64, slip: f64) -> Simulation {
    let discs = (0..columns * lines)
        .map(|k| {
            let (column, line) = (f64::from(k % columns), f64::from(k / columns));
            Disc::at_rest(column * SPACING + line * slip, line * rise, RADIUS, 3000.0)
        })
        .collect();
    let walls = Walls::around(f64::from(columns) * SPACING, f64::from(lines) * rise);
    let periodic = Periodic { shear_offset: f64::from(lines) * slip, shear_rate: 0.0 };
    Simulation::new_periodic(Material::default(), discs, walls, periodic).unwrap()
}

/// For two discs at the distance `a`: normal force [N], chord [m], and the part of the area of a disc that one of its
/// contacts covers.
fn contact(a: f64) -> (f64, f64, f64) {
    let stiffness = Material::default().young_modulus * RADIUS;
    let chord = (4.0 * RADIUS * RADIUS - a * a).sqrt();
    let hidden = RADIUS * RADIUS * (0.5 * a / RADIUS).acos() - 0.25 * a * chord;
    (stiffness * (2.0 * RADIUS - a), chord, hidden)
}

#[test]
fn square_lattice_in_closed_form() {
    let (force, chord, hidden) = contact(SPACING);
    let averages = homogenise(&lattice(5, 4, SPACING, 0.0), RegionKind::Cell);
    close("sxx", averages.stress_xx, force / SPACING, 1e-9 * force / SPACING);
    close("syy", averages.stress_yy, force / SPACING, 1e-9 * force / SPACING);
    close("kxx", averages.conductivity_xx, chord / SPACING, 1e-12);
    close("kyy", averages.conductivity_yy, chord / SPACING, 1e-12);
    close("kxy", averages.conductivity_xy, 0.0, 1e-12);
    // Straight lines of resistors: the affine estimate is exact.
    close("network kxx", averages.conductivity_network_xx, chord / SPACING, 1e-12);
    close("network kyy", averages.conductivity_network_yy, chord / SPACING, 1e-12);
    close("f", averages.fabric_index, 0.0, 1e-12);
    close("z", averages.coordination, 4.0, 0.0);
    let solid = (PI * RADIUS * RADIUS - 4.0 * hidden) / (SPACING * SPACING);
    close("porosity", averages.porosity, 1.0 - solid, 1e-12);
    close("overlap", averages.overlap_fraction, 4.0 * hidden / (SPACING * SPACING), 1e-12);
}

/// An odd number of lines is periodic only with the shear offset.
#[test]
fn hexagonal_lattice_in_an_oblique_cell_in_closed_form() {
    let (force, chord, hidden) = contact(SPACING);
    let root = 3f64.sqrt();
    for (lines, columns) in [(5, 4), (3, 7)] {
        let simulation = lattice(columns, lines, 0.5 * root * SPACING, 0.5 * SPACING);
        let averages = homogenise(&simulation, RegionKind::default());
        let pressure = root * force / SPACING;
        for (what, stress) in [("sxx", averages.stress_xx), ("syy", averages.stress_yy)] {
            close(what, stress, pressure, 1e-9 * pressure);
        }
        close("sxy", averages.stress_xy, 0.0, 1e-9 * pressure);
        close("kxx", averages.conductivity_xx, root * chord / SPACING, 1e-12);
        close("kyy", averages.conductivity_yy, root * chord / SPACING, 1e-12);
        close("f", averages.fabric_index, 0.0, 1e-12);
        close("F_xy", averages.fabric_xy, 0.0, 1e-12);
        close("z", averages.coordination, 6.0, 0.0);
        let solid = (PI * RADIUS * RADIUS - 6.0 * hidden) / (0.5 * root * SPACING * SPACING);
        close("porosity", averages.porosity, 1.0 - solid, 1e-12);
    }
}

/// Only horizontal contacts carry σ_xx = s_n δ_x / a_y, and f = 0 as long as all four neighbours touch.
#[test]
fn stretched_square_lattice_in_closed_form() {
    let mut simulation = lattice(5, 4, SPACING, 0.0);
    let target = Strains { xx: -0.004, yy: 0.003, ..Strains::default() };
    let ramp = follow(&mut simulation, &[target], Protocol::default(), |_, _| ()).unwrap();
    let averages = ramp.stops[0].averages;
    let (ax, ay) = (SPACING * 0.996, SPACING * 1.003);
    close("sxx", averages.stress_xx, contact(ax).0 / ay, 1e-6 * averages.stress_xx);
    close("syy", averages.stress_yy, contact(ay).0 / ax, 1e-6 * averages.stress_yy);
    close("kxx", averages.conductivity_xx, contact(ax).1 / ay, 1e-8);
    close("f", averages.fabric_index, 0.0, 1e-9);
}

/// Grains of a sheared square lattice rotate by −γ/2, so horizontal and vertical contacts slip by ±γ a/2 and σ_xy =
/// −s_t γ/2; the normal force in the tilted vertical branches adds p γ.
#[test]
fn sheared_square_lattice_in_closed_form() {
    let mut simulation = lattice(5, 4, SPACING, 0.0);
    let rate = 1e-3;
    simulation.periodic.as_mut().unwrap().shear_rate = rate;
    for disc in &mut simulation.discs {
        disc.angular_velocity = -0.5 * rate;
    }
    simulation.run(400).unwrap();
    let shear = simulation.periodic.unwrap().shear_offset / simulation.walls.height();
    close("time", simulation.time * rate, shear, 1e-9 * shear);
    let averages = homogenise(&simulation, RegionKind::Cell);
    let material = Material::default();
    let stiffness = material.stiffness_ratio * material.young_modulus * RADIUS;
    let expected = shear * (contact(SPACING).0 / SPACING - 0.5 * stiffness);
    close("sxy", averages.stress_xy, expected, 1e-3 * expected.abs());
    close("syx", averages.stress_yx, expected, 1e-3 * expected.abs());
    close("sxx", averages.stress_xx, contact(SPACING).0 / SPACING, 1e-5 * averages.stress_xx);
}

fn spec(discs: usize) -> PackingSpec {
    PackingSpec {
        discs,
        seed: 5,
        porosity: 0.13,
        compression: Compression::Isotropic,
        boundary: Boundary::Periodic,
        ..PackingSpec::default()
    }
}

fn packed(discs: usize) -> Simulation {
    let packed = pack(&spec(discs), &Material::default()).unwrap();
    assert_eq!(packed.settled.outcome.to_string(), "settled");
    packed.simulation
}

fn sheared(simulation: &Simulation, xy: f64) -> Simulation {
    let mut simulation = simulation.clone();
    let target = Strains { xy, ..Strains::default() };
    let ramp = follow(&mut simulation, &[target], Protocol::default(), |_, _| ()).unwrap();
    assert!(ramp.failure.is_none());
    simulation
}

/// The same assembly, displaced by fractions of the cell. Every disc is then wrapped into the cell, so nearly all
/// shifts change.
fn moved(simulation: &Simulation, fraction: [f64; 2]) -> Simulation {
    let cell = simulation.cell().unwrap();
    let mut discs = simulation.discs.clone();
    for disc in &mut discs {
        let [along, up] = cell.fraction(disc.x, disc.y);
        [disc.x, disc.y] = cell.point([along + fraction[0], up + fraction[1]]);
    }
    let homes: Vec<[i32; 2]> = cell.images(&discs, 0.0)[..discs.len()].iter().map(|h| h.shift).collect();
    let wrapped = discs.iter().zip(&homes).map(|(disc, &home)| cell.image(disc, home)).collect();
    let (material, walls) = (simulation.material.clone(), simulation.walls.clone());
    let mut image = Simulation::new_periodic(material, wrapped, walls, simulation.periodic.unwrap()).unwrap();
    simulation.for_each_contact(|contact| {
        let i = contact.i.unwrap();
        let shift = [0, 1].map(|k| contact.shift[k] + homes[i][k] - homes[contact.j][k]);
        assert!(image.set_tangential_force_across(i, contact.j, shift, contact.tangential_force));
    });
    image
}

#[test]
fn averages_do_not_depend_on_where_the_cell_begins() {
    let simulation = sheared(&packed(120), 0.03);
    let reference = homogenise(&simulation, RegionKind::Cell);
    for fraction in [[0.37, 0.0], [0.0, 0.61], [-0.8, 2.3]] {
        let averages = homogenise(&moved(&simulation, fraction), RegionKind::Cell);
        let columns = |a: &Averages| {
            let stress = [a.stress_xx, a.stress_yy, a.stress_xy, a.stress_yx, a.pressure];
            let network = [a.conductivity_network_xx, a.conductivity_network_yy, a.conductivity_network_xy];
            let conductivity = [a.conductivity_xx, a.conductivity_yy, a.conductivity_xy];
            let rest = [a.porosity, a.fabric_index, a.coordination, a.overlap_fraction, a.contacts as f64];
            [stress.map(|s| s / a.pressure).to_vec(), conductivity.to_vec(), network.to_vec(), rest.to_vec()]
                .concat()
        };
        for (found, expected) in columns(&averages).into_iter().zip(columns(&reference)) {
            close("moved by a part of the cell", found, expected, 1e-9);
        }
    }
}

/// Expansion does not depend on where the cell begins either: the same history at another place.
#[test]
fn expansion_does_not_depend_on_where_the_cell_begins() {
    let start = packed(120);
    let after = |mut simulation: Simulation| {
        let target = Strains { thermal: 0.004, xy: 0.004, ..Strains::default() };
        let ramp = follow(&mut simulation, &[target], Protocol::default(), |_, _| ()).unwrap();
        ramp.stops[0].averages
    };
    let at_rest = |simulation: &Simulation, fraction| {
        let mut image = moved(simulation, fraction);
        image.discs.iter_mut().for_each(|d| (d.vx, d.vy, d.angular_velocity) = (0.0, 0.0, 0.0));
        image.free_drag = simulation.free_drag;
        image
    };
    let reference = after(at_rest(&start, [0.0, 0.0]));
    let averages = after(at_rest(&start, [0.43, 0.29]));
    close("pressure", averages.pressure / reference.pressure, 1.0, 1e-6);
    close(
        "shear stress",
        averages.stress_xy / reference.pressure,
        reference.stress_xy / reference.pressure,
        1e-6,
    );
    close("K", averages.conductivity_xx, reference.conductivity_xx, 1e-6);
}

/// Radii grown by 1 + ε in a fixed cell and a cell shrunk by the same factor are equal up to size, on which p̃ = p/(E
/// r̄) does not depend.
#[test]
fn isotropic_cell_strain_is_thermal_strain() {
    let start = packed(200);
    let reduced = |a: &Averages| a.pressure / (1e7 * a.mean_radius);
    let after = |strains: Strains| {
        let mut simulation = start.clone();
        let ramp = follow(&mut simulation, &[strains], Protocol::default(), |_, _| ()).unwrap();
        ramp.stops[0].averages
    };
    for strain in [0.01, -0.005f64] {
        let cell = 1.0 / (1.0 + strain) - 1.0;
        let thermal = after(Strains::thermal(strain));
        let shrunk = after(Strains { xx: cell, yy: cell, ..Strains::default() });
        let before = homogenise(&start, RegionKind::Cell);
        let [rise, other] = [&thermal, &shrunk].map(|a| reduced(a) - reduced(&before));
        assert!(rise * strain > 0.0);
        close("rise of reduced pressure", other / rise, 1.0, 0.03);
        close("porosity", shrunk.porosity, thermal.porosity, 2e-4);
    }
}

/// A cell that is sheared, then strained and sheared back, reaches exactly the shape that was asked for.
#[test]
fn straining_ends_at_the_cell_asked_for() {
    let start = packed(60);
    let [width, height] = [start.walls.width(), start.walls.height()];
    let mut simulation = sheared(&start, 0.02);
    close("offset", simulation.periodic.unwrap().shear_offset, 0.02 * height, 1e-11 * height);
    let path = [
        Strains { xx: -0.01, yy: 0.01, xy: 0.01, thermal: 0.002 },
        Strains { xx: 0.0, yy: 0.0, xy: -0.02, thermal: 0.0 },
    ];
    let ramp = follow(&mut simulation, &path, Protocol::default(), |stop, simulation| {
        let s = stop.strains;
        let expected = (1.0 + s.xx) * 0.02 * height + s.xy * height;
        close("width", simulation.walls.width(), (1.0 + s.xx) * width, 1e-11 * width);
        close("offset", simulation.periodic.unwrap().shear_offset, expected, 1e-11 * height);
        close("rate", simulation.periodic.unwrap().shear_rate, 0.0, 0.0);
    });
    assert_eq!(ramp.unwrap().stops.len(), 2);
    let walls = PackingSpec { boundary: Boundary::Walls, ..spec(60) };
    let mut between_walls = pack(&walls, &Material::default()).unwrap().simulation;
    let target = Strains { xy: 0.01, ..Strains::default() };
    let refused = follow(&mut between_walls, &[target], Protocol::default(), |_, _| ());
    assert!(refused.unwrap_err().to_string().starts_with("xy = 0.01, allowed: 0 between walls"));
}

fn mid_shear() -> Simulation {
    let mut simulation = packed(80);
    simulation.set_strain_rate(0.05);
    simulation.walls.normal_velocity = [0.01, 0.0, 0.0, -0.01];
    simulation.periodic.as_mut().unwrap().shear_rate = 0.2;
    simulation.run(230).unwrap();
    simulation
}

#[test]
fn a_state_read_back_in_the_middle_of_a_shear_continues_bit_for_bit() {
    let mut original = mid_shear();
    let mut copy = from_json(&to_json(&original).unwrap()).unwrap();
    let rebuilds = original.rebuilds();
    for simulation in [&mut original, &mut copy] {
        simulation.run(1500).unwrap();
    }
    assert!(original.rebuilds() > rebuilds);
    assert_eq!(original.discs, copy.discs);
    assert_eq!(to_json(&original).unwrap(), to_json(&copy).unwrap());
}

#[test]
fn nonsense_in_a_periodic_state_is_refused() {
    let good: serde_json::Value = serde_json::from_str(&to_json(&mid_shear()).unwrap()).unwrap();
    let message = |change: &dyn Fn(&mut serde_json::Value)| {
        let mut json = good.clone();
        change(&mut json);
        from_json(&json.to_string()).expect_err("refused").to_string()
    };
    assert!(message(&|j| j["contacts"]["i"][0] = (-1).into()).contains("i = -1"));
    assert!(message(&|j| j["contacts"]["shift_x"][0] = 7.into()).contains("not near each other"));
    assert!(
        message(&|j| j["contacts"]["shift_x"][0] = 1_000_000_000.into()).contains("shift_x = 1000000000")
    );
    assert!(message(&|j| j["particles"]["x"][0] = 1e4.into()).starts_with("particle 0: x = 10000"));
    assert!(message(&|j| j["box"]["periodic"] = false.into()).starts_with("box: shear_offset"));
    assert!(message(&|j| j["box"]["x_max"] = 0.01.into()).starts_with("box: "));
    assert!(message(&|j| j["run"]["shear_rate"] = "fast".into()).contains("not a state"));
    assert!(
        message(&|j| {
            j["contacts"]["shift_y"].as_array_mut().unwrap().pop();
        })
        .starts_with("contacts.shift_y has ")
    );
    let walls = PackingSpec { boundary: Boundary::Walls, ..spec(60) };
    let walls = to_json(&pack(&walls, &Material::default()).unwrap().simulation).unwrap();
    assert!(!walls.contains("shear") && !walls.contains("shift") && !walls.contains("periodic"));
    let mut json: serde_json::Value = serde_json::from_str(&walls).unwrap();
    json["run"]["shear_rate"] = 0.1.into();
    assert!(from_json(&json.to_string()).err().unwrap().to_string().starts_with("run: shear_rate = 0.1"));
}

/// The state after one increment; friction forces are multiplied by `friction` before it.
fn strained(start: &Simulation, step: Strains, friction: f64) -> Averages {
    let mut simulation = start.clone();
    start.for_each_contact(|contact| {
        let (i, force) = (contact.i.unwrap(), friction * contact.tangential_force);
        assert!(simulation.set_tangential_force_across(i, contact.j, contact.shift, force));
    });
    let protocol = Protocol::usual(&simulation);
    let ramp = follow(&mut simulation, &[step], protocol, |_, _| ()).unwrap();
    assert!(ramp.failure.is_none());
    ramp.stops[0].averages
}

/// Growth of the grains by λ and shrinking of the box by λ around them give the same packing up to its scale, but for the
/// friction forces that stand before: at the larger scale they would be λ² times as large, and the law keeps them as they
/// are. The difference goes away when the twin begins with forces that are smaller by λ².
#[test]
fn twins_differ_by_the_friction_forces_that_stand_before() {
    let start = packed(500);
    for strain in [-0.01, 0.01] {
        let scale: f64 = 1.0 + strain;
        let twin = Strains { xx: 1.0 / scale - 1.0, yy: 1.0 / scale - 1.0, ..Strains::default() };
        let thermal = strained(&start, Strains::thermal(strain), 1.0);
        let reduced = |a: &Averages| a.pressure / a.mean_radius;
        let off = |friction| {
            let twin = strained(&start, twin, friction);
            close("solid", twin.porosity_sum_of_areas, thermal.porosity_sum_of_areas, 1e-12);
            [(reduced(&twin) / reduced(&thermal) - 1.0).abs(), (twin.porosity - thermal.porosity).abs()]
        };
        let (as_they_are, scaled) = (off(1.0), off(scale.powi(-2)));
        println!("relative stress and porosity at {strain}: off by {as_they_are:?}, scaled {scaled:?}");
        // Measured: 7e-4 to 1.1e-3 and 3e-5 to 4e-5, scaled an eighth to an eleventh of it.
        for (off, scaled) in as_they_are.into_iter().zip(scaled) {
            assert!(scaled < 0.3 * off, "{off} {scaled}");
        }
    }
}
