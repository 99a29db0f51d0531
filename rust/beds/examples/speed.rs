//! Steps of a jammed periodic box: `speed SPHERES [STEPS [TILES [THREADS [FILE]]]]` prints millions of sphere-steps per second, by the
//! best of forty parts of the run, and the memory of the process (Linux) over the number of spheres: now, and the most so far.
//! The box is repeated TILES times in each direction, and with 2 or more run with the best instruction set only. It is written to FILE as
//! a data file of LAMMPS (atom_style sphere), for comparison.

use msdd_beds::{Packing, pack};
use msdd_spheres::{Boundary, Material, Simd, Simulation, Sphere, Stiffness};
use std::fmt::Write;
use std::time::Instant;

/// The spheres at rest and without friction history, as LAMMPS reads them.
fn data_file(simulation: &Simulation) -> Result<String, std::fmt::Error> {
    let mut text = format!("spheres\n\n{} atoms\n1 atom types\n", simulation.spheres.len());
    let edges = simulation.cell().map_or([[0.0; 3]; 3], |cell| cell.lattice.edges);
    for (k, axis) in ["x", "y", "z"].into_iter().enumerate() {
        writeln!(text, "0 {} {axis}lo {axis}hi", edges[k][k])?;
    }
    text += "\nAtoms\n\n";
    for (number, sphere) in simulation.spheres.iter().enumerate() {
        let [x, y, z] = [0, 1, 2].map(|k| sphere.position[k].rem_euclid(edges[k][k]));
        let (diameter, density) = (2.0 * sphere.radius, simulation.material.density);
        writeln!(text, "{} 1 {diameter} {density} {x} {y} {z}", number + 1)?;
    }
    Ok(text)
}

/// `tiles`³ copies of a periodic box in one.
fn repeated(simulation: &Simulation, tiles: usize) -> Result<Simulation, Box<dyn std::error::Error>> {
    if tiles <= 1 {
        return Ok(simulation.clone());
    }
    let mut cell = *simulation.cell().ok_or("a periodic box")?;
    let mut spheres = Vec::new();
    for tile in 0..tiles.pow(3) {
        let shift = [tile % tiles, tile / tiles % tiles, tile / tiles / tiles].map(|number| number as i32);
        spheres.extend(simulation.spheres.iter().map(|sphere| cell.lattice.image(sphere, shift)));
    }
    cell.lattice.edges = cell.lattice.edges.map(|edge| edge.map(|x| tiles as f64 * x));
    // In the box, and in the order of their places, as in a box of this size that is packed.
    let edge = cell.lattice.edges[0][0];
    for sphere in &mut spheres {
        sphere.position = sphere.position.map(|x| x.rem_euclid(edge));
    }
    spheres.sort_by_key(|sphere: &Sphere| {
        let [x, y, z] = sphere.position.map(|x| x as u32);
        [z, y, x]
    });
    Ok(Simulation::new(simulation.material.clone(), spheres, Boundary::Periodic(cell))?)
}

/// Bytes in the main memory that the process has now, and the most that it had; none elsewhere than on Linux.
fn memory() -> Option<[f64; 2]> {
    let status = std::fs::read_to_string("/proc/self/status").ok()?;
    let of = |key: &str| {
        let line = status.lines().find_map(|line| line.strip_prefix(key))?;
        Some(1024.0 * line.split_whitespace().next()?.parse::<f64>().ok()?)
    };
    Some([of("VmRSS:")?, of("VmHWM:")?])
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mut arguments = std::env::args().skip(1);
    let mut number = |default: u64| arguments.next().map_or(Ok(default), |text| text.parse());
    let (spheres, steps) = (number(1000)? as usize, number(10_000)?);
    let tiles = number(1)? as usize;
    let threads = number(1)? as usize;
    let file = std::env::args().nth(5);
    let packing = Packing {
        spheres,
        seed: 1,
        diameter: 1.0,
        sizes: None,
        material: Material {
            density: 1.0,
            stiffness: Stiffness::HertzMindlin { young_modulus: 1.0, poisson_ratio: 0.25 },
            friction: 0.3,
            wall_friction: 0.0,
            restitution: 0.3,
        },
        pressure: 1e-5,
        steps: 30_000,
    };
    let packed = pack(&packing)?;
    println!("settled {}, {:?}", packed.settled, packed.averages);
    let start = repeated(&packed.simulation, tiles)?;
    let spheres = start.spheres.len();
    if let Some(file) = file {
        std::fs::write(file, data_file(&start)?)?;
    }
    let all = if tiles == 1 { Simd::ALL.to_vec() } else { vec![Simd::best()] };
    let mut start = Some(start);
    for (left, simd) in (0..all.len()).rev().zip(all).filter(|(_, simd)| simd.available()) {
        let copy = if left == 0 { start.take() } else { start.clone() };
        let Some(mut simulation) = copy else { break };
        simulation.set_simd(simd);
        simulation.set_threads(threads)?;
        simulation.take_steps(steps / 10);
        let searches = simulation.searches();
        let best = (0..40)
            .map(|_| {
                let begin = Instant::now();
                simulation.take_steps(steps / 40);
                begin.elapsed().as_secs_f64()
            })
            .fold(f64::INFINITY, f64::min);
        if let Some([now, most]) = memory().filter(|_| tiles > 1) {
            let each = |bytes: f64| bytes / spheres as f64;
            println!("memory: {:.0} B a sphere, at most {:.0}", each(now), each(most));
        }
        let rate = (steps / 40) as f64 * spheres as f64 / best / 1e6;
        let (searches, candidates) = (simulation.searches() - searches, simulation.candidates());
        let search = (0..10)
            .map(|_| {
                let begin = Instant::now();
                simulation.rebuild_neighbours();
                begin.elapsed().as_secs_f64()
            })
            .fold(f64::INFINITY, f64::min);
        println!(
            "a search takes the time of {:.1} steps of {} s",
            search / best * (steps / 40) as f64,
            simulation.time_step
        );
        println!(
            "{simd:?}: {rate:.2} M sphere-steps/s, {searches} searches, {:.2} candidates per sphere, {:e}",
            candidates as f64 / spheres as f64,
            simulation.kinetic_energy()
        );
    }
    Ok(())
}
