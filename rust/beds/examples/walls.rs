//! What a wall adds to the resistance of a bed of spheres: `walls [SPHERES] [SEEDS]`, or by radiation alone: `walls radiation [SPHERES]`.
//!
//! Spheres are poured into a box, a lid is pressed on, and heat is led from the lid to the floor through contacts and gas. A straight
//! line through the temperatures far from both gives the conductivity K and, prolonged to floor and lid, the difference of temperature
//! that each takes, over the heat flux: its resistance next to a bed that conducts equally up to its surface. It is printed in
//! diameters of the bed (times K/d), compared with what the law of walls gives ([`msdd_beds::wall`]), whose one number, the spheres at
//! the wall on d², is counted: those nearer than half a radius.
//!
//! By radiation alone the exchange is traced ([`msdd_beds::exchange`]); resistances are in units of 1/(4 σ T³), and F is that of the bed. The law
//! is fitted to these numbers.

#[path = "steady/mod.rs"]
mod steady;

use msdd_beds::effective::BedMaterial;
use msdd_beds::exchange::{Emissivities, Tracing, exchange};
use msdd_beds::named_gases::GasName;
use msdd_beds::network::{Beside, Conductances, Materials, Network, Plate, PlateLaw};
use msdd_beds::pour::{Container, Pouring, pour};
use msdd_beds::press::press;
use msdd_beds::property::Property;
use msdd_beds::rays::Enclosure;
use msdd_beds::solid::{Roughness, Solid};
use msdd_beds::wall::{Radiating, Wall};
use msdd_spheres::law::effective_modulus;
use msdd_spheres::{Material, Simulation, Stiffness};
use steady::{line, steady};

const DIAMETER: f64 = 2e-3;
const T: f64 = 293.15;
/// Length of the base, and distance from both ends that the straight line leaves out \[d\].
const BASE: f64 = 12.0;
const END: f64 = 4.0;
/// Numbers of floor and lid.
const WALLS: [usize; 2] = [0, 5];
/// ε of spheres and walls.
const EMISSIVITIES: [f64; 3] = [1.0, 0.6, 0.2];
const ROUGH: Roughness = Roughness { height_over_slope: 3.4e-7, hardness: 3e9 };

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mut arguments = std::env::args().skip(1).peekable();
    let radiates = arguments.next_if(|first| first == "radiation").is_some();
    let mut number = |default: u64| arguments.next().map_or(Ok(default), |text| text.parse());
    let (spheres, seeds) = (number(2500)? as usize, number(3)?);
    let stiffness = Stiffness::HertzMindlin { young_modulus: 5e9, poisson_ratio: 0.29 };
    let material =
        Material { density: 7750.0, stiffness, friction: 0.3, wall_friction: 0.3, restitution: 0.8 };
    let container = Container::Box { base: [BASE * DIAMETER; 2] };
    println!(
        "{}",
        if radiates {
            "spheres wall F floor lid law"
        } else {
            "pressure seed gas K[W/mK] wall n R/(d/K) law h[W/m2K] law"
        }
    );
    for seed in 1..=if radiates { 1 } else { seeds } {
        let (diameter, gravity, longest, threads) = (DIAMETER, 9.81, 10.0, 1);
        let material = material.clone();
        let pouring =
            Pouring { spheres, seed, diameter, sizes: None, material, container, gravity, longest, threads };
        let (mut bed, _) = pour(&pouring, |_| ())?;
        if radiates {
            press(&mut bed, WALLS[1], (2e4, container.area()), longest, |_| ())?;
            return radiation(&bed, container.area());
        }
        for pressure in [2e3, 2e4, 2e5] {
            press(&mut bed, WALLS[1], (pressure, container.area()), longest, |_| ())?;
            for gas in [GasName::Air, GasName::Helium, GasName::Vacuum] {
                report(&bed, pressure, seed, gas, container.area());
            }
        }
    }
    Ok(())
}

fn report(bed: &Simulation, pressure: f64, seed: u64, gas: GasName, area: f64) {
    let modulus = effective_modulus(200e9, 0.29);
    let materials = Materials {
        conductivity: Property::Constant(42.0),
        heat_capacity: Property::Constant(464.0),
        effective_modulus: modulus,
        roughness: Some(ROUGH),
        gas,
        gas_pressure: 1.013e5,
        accommodation: 0.9,
        solid_fraction: None,
    };
    let law =
        PlateLaw::Resisting { conductivity: None, effective_modulus: 2.0 * modulus, roughness: Some(ROUGH) };
    let network = Network::new(bed, materials, &WALLS.map(|wall| Plate { wall, law }));
    let count = bed.spheres.len();
    let found = network.conductances(&vec![T; count], &[T; 2]);
    let ends = ends(bed, &found, area);
    for (plate, wall) in WALLS.into_iter().enumerate() {
        let [conductivity, resistance] = ends[plate];
        let h: f64 =
            found.plates.iter().filter(|link| link.1 == plate).map(|link| link.2).sum::<f64>() / area;
        let near = |b: &&Beside| b.plate == plate && b.facing.gap < 0.5 * b.radius;
        let n = network.beside.iter().filter(near).count() as f64 * DIAMETER * DIAMETER / area;
        let force: f64 = bed.wall_force[wall].map(|f| f * f).iter().sum::<f64>().sqrt() / area;
        let solid = Solid { conductivity: 42.0, effective_modulus: modulus, roughness: Some(ROUGH) };
        let bed =
            BedMaterial { radius: 0.5 * DIAMETER, solid, gas, gas_pressure: 1.013e5, accommodation: 0.9 };
        let surface =
            Wall { conductivity: None, effective_modulus: 2.0 * modulus, roughness: Some(ROUGH), spheres: n };
        let said = surface.conductance(&bed, force, T);
        println!(
            "{pressure:.0e} {seed} {} {conductivity:.4} {} {n:.3} {:.3} {:.3} {h:.1} {said:.1}",
            gas,
            ["floor", "lid"][plate],
            resistance * conductivity / DIAMETER,
            surface.resistance(&bed, force, T, conductivity, &Radiating::NONE) * conductivity / DIAMETER,
        );
    }
}

/// K and the resistance that each plate adds, by the straight line through the temperatures far from both plates.
fn ends(bed: &Simulation, found: &Conductances, area: f64) -> [[f64; 2]; 2] {
    // From plates of 0 and 1 K
    let mut heat = vec![0.0; bed.spheres.len()];
    found.plates.iter().for_each(|&(k, plate, g)| heat[k] += g * plate as f64);
    let temperatures = steady(heat, &found.links, &found.plates);
    let top = bed.boundary.walls()[WALLS[1]].point[2];
    let inside: Vec<[f64; 2]> = (bed.spheres.iter().zip(&temperatures))
        .map(|(sphere, &t)| [sphere.position[2], t])
        .filter(|[z, t]| *z > END * DIAMETER && *z < top - END * DIAMETER && t.is_finite())
        .collect();
    let (at_zero, slope) = line(&inside);
    [0, 1].map(|plate| {
        let through = found.plates.iter().filter(|link| link.1 == plate);
        let heat: f64 = through.map(|&(k, p, g)| g * (temperatures[k] - p as f64)).sum();
        let flux = heat.abs() / area;
        let jump = if plate == 0 { at_zero } else { 1.0 - at_zero - slope * top };
        [flux / slope, jump / flux]
    })
}

/// Resistances by radiation, by the emissivities of spheres and walls.
fn radiation(bed: &Simulation, area: f64) -> Result<(), Box<dyn std::error::Error>> {
    let enclosure = Enclosure::new(bed);
    for spheres in EMISSIVITIES {
        for emissivity in EMISSIVITIES {
            let mut walls = vec![0.0; bed.boundary.walls().len()];
            WALLS.iter().for_each(|&wall| walls[wall] = emissivity);
            let tracing = Tracing { rays: 2000, seed: 1, threads: 2 };
            let traced = exchange(&enclosure, &Emissivities { spheres, walls }, &tracing)?;
            let of_wall = |plate: usize| {
                traced.at_wall(WALLS[plate]).into_iter().map(move |(k, size)| (k, plate, size))
            };
            let found = Conductances { links: traced.pairs(), plates: (0..2).flat_map(of_wall).collect() };
            let [[conductivity, floor], [_, lid]] = ends(bed, &found, area);
            let factor = conductivity / DIAMETER;
            let radiating = Radiating { emissivity, black: DIAMETER, bed: conductivity };
            let law = 1.0 / radiating.conductance(DIAMETER) - 0.5 / factor;
            println!("{spheres} {emissivity} {factor:.3} {floor:.3} {lid:.3} {law:.3}");
        }
    }
    Ok(())
}
