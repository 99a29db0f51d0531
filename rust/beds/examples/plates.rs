//! A plate next to a bed of spheres: direct solutions by random walks, compared with the law of plates and the network:
//! `plates [SPHERES] [SEED] [WALKS]`.
//!
//! Spheres are poured on a floor that repeats itself along x and y; then a lid is pressed on. A plate is laid at floor, free surface and lid,
//! a little off the nearest sphere. First table: the conductance per area h between the plate and spheres of one temperature, and its
//! parts by the gap of the spheres. Second table: spheres with 0.95 and 0.99 of their radii between this plate and another one three
//! diameters farther, which cuts them: spheres that it cuts have its temperature, and those farther are left out. The heat through
//! this slab by the network of all conductances that walks find, over that of the network that `msdd bed run` makes.

#[path = "direct/mod.rs"]
mod direct;

use direct::voxels::Ball;
use direct::walk_on_spheres::Room;
use msdd_beds::gas::plate_conductance;
use msdd_beds::named_gases::GasName;
use msdd_beds::network::{Materials, Network, Plate, PlateLaw};
use msdd_beds::plate_view_areas::facing;
use msdd_beds::pour::{Container, Pouring, pour};
use msdd_beds::press::press;
use msdd_beds::property::Property;
use msdd_beds::random::Random;
use msdd_spheres::{Boundary, Cell, Material, Simulation, Sphere, Stiffness, Wall};
use std::error::Error;

const DIAMETER: f64 = 2e-3;
const T: f64 = 293.15;
/// Of the floor, and depth of the slab \[d\].
const SIDE: f64 = 9.0;
const DEPTH: f64 = 3.0;
/// k_s/k_g.
const RATIO: f64 = 1500.0;
/// Gaps over the radius at which the table of the plate begins anew.
const GAPS: [f64; 4] = [0.0, 0.1, 0.5, 1.0];

type Any<T> = Result<T, Box<dyn Error>>;
type Links = Vec<(usize, usize, f64)>;

fn main() -> Any<()> {
    let mut arguments = std::env::args().skip(1);
    let mut number = |default: u64| arguments.next().map_or(Ok(default), |text| text.parse());
    let (spheres, seed, walks) = (number(700)? as usize, number(1)?, number(500_000)? as usize);
    let container = Container::Endless { base: [SIDE * DIAMETER; 2] };
    let (diameter, gravity, longest, threads) = (DIAMETER, 9.81, 10.0, 1);
    let pouring = Pouring {
        spheres,
        seed,
        diameter,
        sizes: None,
        material: material(),
        container,
        gravity,
        longest,
        threads,
    };
    let (mut bed, _) = pour(&pouring, |_| ())?;
    let mut surfaces = vec![("floor", places(&bed, 0)), ("free surface", places(&bed, 1))];
    for (name, pressure) in [("lid, 1 kPa", 1e3), ("lid, 10 kPa", 1e4)] {
        press(&mut bed, 1, (pressure, container.area()), longest, |_| ())?;
        surfaces.push((name, places(&bed, 1)));
    }
    println!("plate off[d] h[k/d]: walks law gaps-below-R/2-alone; by gap/R from 0, 0.1, 0.5, 1: walks law");
    for (name, places) in &surfaces {
        for off in [0.005, 0.025, 0.1] {
            beside(name, places, off, (walks as f64).sqrt() as usize)?;
        }
    }
    println!("\nplate radii slab[k/d]: walks network network/walks");
    for (name, places) in &surfaces {
        for shrunk in [0.95, 0.99] {
            slab(name, places, shrunk, walks / 25)?;
        }
    }
    Ok(())
}

fn material() -> Material {
    let stiffness = Stiffness::HertzMindlin { young_modulus: 5e9, poisson_ratio: 0.29 };
    Material { density: 7750.0, stiffness, friction: 0.3, wall_friction: 0.3, restitution: 0.8 }
}

/// Places along a wall and distance from it \[d\]. The nearest sphere touches the wall.
fn places(bed: &Simulation, wall: usize) -> Vec<[f64; 3]> {
    let wall = bed.boundary.walls()[wall];
    let distance = |sphere: &Sphere| wall.distance(sphere.position);
    let least = bed.spheres.iter().map(distance).fold(f64::INFINITY, f64::min);
    let place = |sphere: &Sphere| {
        let [x, y, _] = sphere.position.map(|x| x / DIAMETER);
        // Spheres that are pressed into the wall touch it.
        [x.rem_euclid(SIDE), y.rem_euclid(SIDE), (distance(sphere) - least.max(0.5 * DIAMETER)) / DIAMETER]
    };
    bed.spheres.iter().map(place).map(|[x, y, z]| [x, y, z.max(0.0) + 0.5]).collect()
}

/// Spheres of unit diameter times `shrunk` between two walls.
fn between(places: &[[f64; 3]], shrunk: f64, depth: f64) -> Any<Simulation> {
    let spheres = places.iter().map(|&place| Sphere::at_rest(place, 0.5 * shrunk, 1.0)).collect();
    let walls =
        vec![Wall::at_rest([0.0; 3], [0.0, 0.0, 1.0]), Wall::at_rest([0.0, 0.0, depth], [0.0, 0.0, -1.0])];
    let boundary = Boundary::Between(Cell::block([SIDE, SIDE, 2.0 * depth]), walls);
    Ok(Simulation::new(material(), spheres, boundary)?)
}

fn room(places: &[[f64; 3]], radius: f64, depth: f64) -> Room {
    Room::new([SIDE; 2], depth, places.iter().map(|&centre| Ball { centre, radius }).collect())
}

fn beside(name: &str, places: &[[f64; 3]], off: f64, side: usize) -> Any<()> {
    let places: Vec<[f64; 3]> =
        places.iter().map(|&[x, y, z]| [x, y, z + off]).filter(|place| place[2] < 6.0).collect();
    let found = room(&places, 0.5, 8.0).exchange_of_plate([SIDE; 2], side, &mut Random::new(1)).balls;
    let mut law = vec![0.0; places.len()];
    for facing in facing(&between(&places, 1.0, 8.0)?, 0) {
        law[facing.sphere] = facing.size(0.0);
    }
    let gap = |k: usize| 2.0 * places[k][2] - 1.0;
    let former = (0..places.len()).filter(|&k| gap(k) < 0.5);
    let former: f64 = former.map(|k| plate_conductance(1.0, 0.5, 0.5 * gap(k), 0.0)).sum();
    let sum = |of: &[f64], from: f64, to: f64| {
        let inside = (0..places.len()).filter(|&k| (from..to).contains(&gap(k)));
        inside.map(|k| of[k]).sum::<f64>() / (SIDE * SIDE)
    };
    let mut line = format!("{name}, {off}: {:.2}", sum(&found, -1.0, 99.0));
    line += &format!(" {:.2} {:.2};", sum(&law, -1.0, 99.0), former / (SIDE * SIDE));
    for (k, &from) in GAPS.iter().enumerate() {
        let to = GAPS.get(k + 1).copied().unwrap_or(99.0);
        line += &format!(" {:.2} {:.2}", sum(&found, from, to), sum(&law, from, to));
    }
    println!("{line}");
    Ok(())
}

fn slab(name: &str, places: &[[f64; 3]], shrunk: f64, walks: usize) -> Any<()> {
    let radius = 0.5 * shrunk;
    let places: Vec<[f64; 3]> = places
        .iter()
        .map(|&[x, y, z]| [x, y, z - 0.5 + radius + 0.025])
        .filter(|place| place[2] < DEPTH)
        .collect();
    let held: Vec<bool> = places.iter().map(|place| place[2] > DEPTH - radius).collect();
    let air = GasName::Air.at(T, 1e12, 1.0).ok_or("air")?.conductivity;
    let materials = Materials {
        conductivity: Property::Constant(RATIO * air),
        heat_capacity: Property::Constant(1.0),
        effective_modulus: 1e30,
        roughness: None,
        gas: GasName::Air,
        // So that no temperature jumps.
        gas_pressure: 1e12,
        accommodation: 1.0,
        solid_fraction: None,
    };
    let law = PlateLaw::Resisting { conductivity: None, effective_modulus: 1e30, roughness: None };
    let mut network =
        Network::new(&between(&places, shrunk, DEPTH)?, materials, &[0, 1].map(|wall| Plate { wall, law }));
    network.contacts.clear();
    let by_law = network.conductances(&vec![T; places.len()], &[T; 2]);
    let room = room(&places, radius, DEPTH);
    let (mut links, mut plates) = (Links::new(), Links::new());
    for k in (0..places.len()).filter(|&k| !held[k]) {
        let found =
            room.exchange_of_ball(k, walks, &mut Random::new(k as u64)).ok_or("spheres that touch")?;
        plates.extend([0, 1].map(|plate| (k, plate, found.plates[plate])));
        // Between two free spheres the mean of both ways.
        let others = found.balls.iter().enumerate().filter(|(_, g)| **g > 0.0);
        links.extend(others.map(|(other, g)| (k, other, if held[other] { *g } else { 0.5 * g })));
    }
    let direct = through(&held, &links, &plates) / (SIDE * SIDE);
    let network = through(&held, &by_law.links, &by_law.plates) / (SIDE * SIDE * air);
    println!("{name}, {shrunk}: {direct:.3} {network:.3} {:.3}", network / direct);
    Ok(())
}

/// Heat into plate 0 of 0 K; plate 1 and spheres that are held have 1 K. Each sphere gets the mean of its neighbours, again and again.
fn through(held: &[bool], links: &Links, plates: &Links) -> f64 {
    let mut near = vec![Vec::new(); held.len()];
    for &(i, j, g) in links {
        near[i].push((j, g));
        near[j].push((i, g));
    }
    let mut at = vec![[0.0; 2]; held.len()];
    plates.iter().for_each(|&(k, plate, g)| at[k][plate] += g);
    let mut t = vec![1.0; held.len()];
    for _ in 0..3000 {
        for k in (0..held.len()).filter(|&k| !held[k]) {
            let (mut heat, mut sum) = (at[k][1], at[k][0] + at[k][1]);
            for &(j, g) in &near[k] {
                heat += g * t[j];
                sum += g;
            }
            t[k] = if sum > 0.0 { heat / sum } else { 1.0 };
        }
    }
    (0..held.len()).map(|k| at[k][0] * t[k]).sum()
}
