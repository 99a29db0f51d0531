//! Steps of a jammed periodic box: `speed SPHERES [STEPS [TILES [FILE]]]` prints millions of sphere-steps per second, by the
//! best of forty parts of the run; a large box with the best instruction set only. The box is repeated TILES times in each direction. It is written to FILE as a data file
//! of LAMMPS (atom_style sphere), for comparison.

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
    // In the order of their places, as a box of this size is packed.
    let edge = cell.lattice.edges[0][0];
    let place = |sphere: &Sphere| {
        let [x, y, z] = sphere.position.map(|x| x.rem_euclid(edge) as u32);
        [z, y, x]
    };
    spheres.sort_by_key(place);
    Ok(Simulation::new(simulation.material.clone(), spheres, Boundary::Periodic(cell))?)
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mut arguments = std::env::args().skip(1);
    let mut number = |default: u64| arguments.next().map_or(Ok(default), |text| text.parse());
    let (spheres, steps) = (number(1000)? as usize, number(10_000)?);
    let tiles = number(1)? as usize;
    let file = std::env::args().nth(4);
    let packing = Packing {
        spheres,
        seed: 1,
        diameter: 1.0,
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
    let start = repeated(&packed.simulation, tiles)?;
    let spheres = start.spheres.len();
    println!("settled {}, {:?}", packed.settled, packed.averages);
    if let Some(file) = file {
        std::fs::write(file, data_file(&start)?)?;
    }
    for simd in Simd::ALL.into_iter().filter(|&simd| simd.available() && (tiles == 1 || simd == Simd::best()))
    {
        let mut simulation = start.clone();
        simulation.set_simd(simd);
        simulation.take_steps(steps / 10);
        let searches = simulation.searches();
        let best = (0..40)
            .map(|_| {
                let begin = Instant::now();
                simulation.take_steps(steps / 40);
                begin.elapsed().as_secs_f64()
            })
            .fold(f64::INFINITY, f64::min);
        println!("time step {}", simulation.time_step);
        let rate = (steps / 40) as f64 * spheres as f64 / best / 1e6;
        let (searches, candidates) = (simulation.searches() - searches, simulation.candidates());
        let search = (0..10)
            .map(|_| {
                let begin = Instant::now();
                simulation.rebuild_neighbours();
                begin.elapsed().as_secs_f64()
            })
            .fold(f64::INFINITY, f64::min);
        println!("a search takes the time of {:.1} steps", search / best * (steps / 40) as f64);
        println!(
            "{simd:?}: {rate:.2} M sphere-steps/s, {searches} searches, {:.2} candidates per sphere, {:e}",
            candidates as f64 / spheres as f64,
            simulation.kinetic_energy()
        );
    }
    Ok(())
}
