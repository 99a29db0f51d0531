//! Packs periodic boxes with several frictions and prints a table: `packings SPHERES SEEDS`. C is the conductivity of the
//! contacts over k_s (p/E*)^(1/3); the last three columns are that of the gas over k_g where ln(R/h) of touching spheres is
//! 8.5, 6 and 3.5. A second table has boxes that were shaken after that ([`shake`]), and beds that were poured, three diameters away from
//! floor and surface; it is left out by `packings --pressed SPHERES SEEDS [WIDTH]`. `packings --dump FILE FRICTION SEED` prints the row of a
//! box that LAMMPS has packed (scripts/compare-packings). With a WIDTH w above 0 diameters are uniform between 1 - w and 1 + w over their
//! Sauter mean, friction is 0.3, and two more columns have the mean stress after the edges have closed by 0.2 %, and the stress along z
//! after that edge has closed by 0.25 % more, both over E.

use msdd_beds::averages::stress;
use msdd_beds::conductances::{Link, contact_links, gas_links, near_pairs};
use msdd_beds::conductivity::{conductivity, mean};
use msdd_beds::pour::{Container, Pouring, pour};
use msdd_beds::profile::{Width, solid_fraction};
use msdd_beds::sizes::Sizes;
use msdd_beds::solid::Solid;
use msdd_beds::{Packing, averages, pack, shake};
use msdd_spheres::law::effective_modulus;
use msdd_spheres::{Boundary, Cell, Material, Simulation, Sphere, Stiffness};
use std::error::Error;
use std::time::Instant;

/// Pressure over E of the shaken boxes: 10 kPa on glass of 70 GPa.
const SHAKEN: f64 = 1.4e-7;

fn main() -> Result<(), Box<dyn Error>> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    if let [flag, file, friction, seed] = arguments.as_slice()
        && flag == "--dump"
    {
        println!("{COLUMNS}");
        println!("{friction} {seed} {}", row(&dumped(file, friction.parse()?)?));
        return Ok(());
    }
    let pressed_only = arguments.first().is_some_and(|flag| flag == "--pressed");
    let numbers = &arguments[usize::from(pressed_only)..];
    let number = |k: usize, default: u64| numbers.get(k).map_or(Ok(default), |text| text.parse());
    let (spheres, seeds) = (number(0, 1000)? as usize, number(1, 1)?);
    let width: f64 = numbers.get(2).map_or(Ok(0.0), |text| text.parse())?;
    if width > 0.0 {
        println!("{COLUMNS} p(closed) p_zz(pressed)");
        for seed in 1..=seeds {
            let sizes = Some(Sizes::Uniform([1.0 - width, 1.0 + width]));
            let mut packed = pack(&Packing { sizes, ..packing(spheres, seed, 0.3) })?.simulation;
            let row = row(&packed);
            let [closed, along] = strained(&mut packed)?;
            println!("0.3 {seed} {row} {closed:.4e} {along:.4e}");
        }
        return Ok(());
    }
    println!("{COLUMNS} settled steps searches candidates/contact seconds Msteps/s");
    for friction in [0.0, 0.1, 0.3, 0.5] {
        for seed in 1..=seeds {
            let begin = Instant::now();
            let packed = pack(&packing(spheres, seed, friction))?;
            let seconds = begin.elapsed().as_secs_f64();
            let (a, s) = (&packed.averages, &packed.simulation);
            println!(
                "{friction} {seed} {} {} {} {} {:.2} {seconds:.2} {:.1}",
                row(s),
                packed.settled,
                s.steps,
                s.searches(),
                2.0 * s.candidates() as f64 / (a.coordination * spheres as f64),
                s.steps as f64 * spheres as f64 / seconds / 1e6,
            );
        }
    }
    if pressed_only {
        return Ok(());
    }
    println!("\nkind friction-while-packing friction seed phi z z* rattlers");
    for seed in 1..=seeds {
        [0.0, 0.1, 0.3].into_iter().try_for_each(|friction| shaken(spheres, seed, friction))?;
        poured(spheres, seed)?;
    }
    Ok(())
}

fn packing(spheres: usize, seed: u64, friction: f64) -> Packing {
    let material = material(friction);
    Packing { spheres, seed, diameter: 1.0, sizes: None, material, pressure: 1e-5, steps: 400_000 }
}

/// Closes a box at the rate of tests/lammps/in.packing.
fn strained(simulation: &mut Simulation) -> Result<[f64; 2], Box<dyn Error>> {
    simulation.drag = 0.0076;
    let mut close = |strains: [f64; 3]| -> Result<[[f64; 3]; 3], Box<dyn Error>> {
        for (time, share) in [(6000.0, 1.0), (2000.0, 0.0)] {
            let [x, y, z] = strains.map(|strain| -share * strain / time);
            simulation.set_velocity_gradient([[x, 0.0, 0.0], [0.0, y, 0.0], [0.0, 0.0, z]]);
            let until = simulation.time + time;
            while simulation.time < until {
                simulation.run(50)?;
            }
        }
        Ok(stress(simulation))
    };
    let closed = close([0.002; 3])?;
    let pressed = close([0.0, 0.0, 0.0025])?;
    Ok([(closed[0][0] + closed[1][1] + closed[2][2]) / 3.0, pressed[2][2]])
}

const COLUMNS: &str = "friction seed phi z z* rattlers p overlap C kappa_g(8.5) kappa_g(6) kappa_g(3.5)";

/// Averages and conductivities of a periodic box.
fn row(simulation: &Simulation) -> String {
    let a = averages(simulation);
    let volume = simulation.cell().map_or(0.0, |cell| cell.volume());
    let solve = |links: &[Link]| {
        let found = conductivity(links, simulation.spheres.len(), volume);
        found.map_or(f64::NAN, |found| mean(&found.network))
    };
    let effective_modulus = effective_modulus(1.0, 0.25);
    let solid = Solid { conductivity: 1.0, effective_modulus, roughness: None };
    let contacts = solve(&contact_links(simulation, &solid)) / (a.pressure() / effective_modulus).cbrt();
    let gas = [8.5f64, 6.0, 3.5]
        .map(|log| solve(&gas_links(&near_pairs(simulation), 1.0, |radius| radius * (-log).exp())));
    format!(
        "{:.4} {:.3} {:.3} {:.3} {:.4e} {:.2e} {contacts:.4} {:.3} {:.3} {:.3}",
        a.solid_fraction,
        a.coordination,
        a.backbone_coordination,
        a.rattlers,
        a.pressure(),
        a.overlap,
        gas[0],
        gas[1],
        gas[2],
    )
}

/// A cubic periodic box of spheres that LAMMPS has written: number, centre and diameter of each in a line.
fn dumped(file: &str, friction: f64) -> Result<Simulation, Box<dyn Error>> {
    let text = std::fs::read_to_string(file)?;
    let numbers = |line: &str| -> Result<Vec<f64>, std::num::ParseFloatError> {
        line.split_whitespace().map(str::parse).collect()
    };
    let lines: Vec<&str> = text.lines().collect();
    let [bounds, atoms] = lines.get(5..8).zip(lines.get(9..)).map(|(a, b)| [a, b]).ok_or("a short file")?;
    let mut edges = [[0.0; 2]; 3];
    for (edge, line) in edges.iter_mut().zip(bounds) {
        *edge = numbers(line)?.try_into().map_err(|_| "two bounds of each axis")?;
    }
    let mut spheres = Vec::new();
    for line in atoms {
        let row: [f64; 5] =
            numbers(line)?.try_into().map_err(|_| "number, centre and diameter of each sphere")?;
        let centre = std::array::from_fn(|k| row[k + 1] - edges[k][0]);
        spheres.push(Sphere::at_rest(centre, 0.5 * row[4], 1.0));
    }
    let cell = Cell::block(edges.map(|[low, high]| high - low));
    Ok(Simulation::new(material(friction), spheres, Boundary::Periodic(cell))?)
}

fn material(friction: f64) -> Material {
    let stiffness = Stiffness::HertzMindlin { young_modulus: 1.0, poisson_ratio: 0.25 };
    Material { density: 1.0, stiffness, friction, wall_friction: 0.0, restitution: 0.3 }
}

/// Packed with a friction, opened by 0.5 %, mixed, and pressed again with a friction of 0.3.
fn shaken(spheres: usize, seed: u64, friction: f64) -> Result<(), Box<dyn Error>> {
    let mut packing = Packing { pressure: 1e-6, ..self::packing(spheres, seed, friction) };
    let mut simulation = pack(&packing)?.simulation;
    (packing.material, packing.pressure) = (self::material(0.3), SHAKEN);
    shake(&mut simulation, &packing, [1.0; 3], 0.005)?;
    let a = averages(&simulation);
    println!(
        "shaken {friction} 0.3 {seed} {:.4} {:.3} {:.3} {:.3}",
        a.solid_fraction, a.coordination, a.backbone_coordination, a.rattlers
    );
    Ok(())
}

/// Steel spheres of 2 mm that rain on a floor, without sides and into cylinders. The inside is three diameters away from floor and surface.
fn poured(spheres: usize, seed: u64) -> Result<(), Box<dyn Error>> {
    let diameter = 2e-3;
    let rain = |container| -> Result<(Simulation, [f64; 2]), Box<dyn Error>> {
        let stiffness = Stiffness::HertzMindlin { young_modulus: 5e9, poisson_ratio: 0.29 };
        let material =
            Material { density: 7750.0, stiffness, friction: 0.3, wall_friction: 0.3, restitution: 0.8 };
        let (gravity, longest, threads) = (9.81, 10.0, 1);
        let pouring =
            Pouring { spheres, seed, diameter, sizes: None, material, container, gravity, longest, threads };
        let (bed, _) = pour(&pouring, |_| ())?;
        let floor = bed.boundary.walls()[0];
        let mut heights: Vec<f64> = bed.spheres.iter().map(|s| floor.distance(s.position)).collect();
        heights.sort_by(f64::total_cmp);
        // The highest hundredth of the spheres is the surface.
        let inside = [3.0 * diameter, heights[heights.len() * 99 / 100] - 3.0 * diameter];
        Ok((bed, inside))
    };
    let container = Container::Endless { base: [12.0 * diameter; 2] };
    let (bed, between) = rain(container)?;
    let floor = bed.boundary.walls()[0];
    let inside = |k: usize| (between[0]..between[1]).contains(&floor.distance(bed.spheres[k].position));
    let mut ends = 0;
    bed.for_each_contact(|contact| ends += contact.spheres().filter(|&k| inside(k)).count());
    let count = (0..spheres).filter(|&k| inside(k)).count();
    let porosity = |range| 1.0 - solid_fraction(&bed, &floor, range, Width::Whole(container.area()));
    println!("poured - 0.3 {seed} {:.4} {:.3} - -", 1.0 - porosity(between), ends as f64 / count as f64);
    let layers = [0.5, 1.0, 2.0, 3.0].map(|n| porosity([0.0, n * diameter]));
    println!("porosity of the first 0.5, 1, 2 and 3 diameters on the floor: {layers:.4?}");
    for widths in [7.5, 12.0] {
        let radius = 0.5 * widths * diameter;
        let (bed, between) = rain(Container::Cylinder { radius })?;
        let floor = bed.boundary.walls()[0];
        // Between distances from the side, over the diameter
        let ring = |from: f64, to: f64| {
            let width = Width::Ring([(radius - to * diameter).max(0.0), radius - from * diameter]);
            1.0 - solid_fraction(&bed, &floor, between, width)
        };
        let layers = [0.5, 1.0, 2.0].map(|n| ring(0.0, n));
        println!(
            "cylinder of {widths} diameters: porosity {:.4}, of the first 0.5, 1 and 2 diameters at the side \
             {layers:.4?}, further inside {:.4}",
            ring(0.0, widths),
            ring(2.0, widths)
        );
    }
    Ok(())
}
