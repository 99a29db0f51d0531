//! What the side of a cylinder adds to the resistance of a bed of spheres: `cylinders [SPHERES] [SEEDS] [RADII...]` (radii in diameters).
//!
//! Spheres are poured into cylinders, a lid is pressed on, and each sphere releases heat, which leaves through the side alone, by contacts and gas. The
//! temperatures far from the side are a parabola, T₀ − b r²: it gives the conductivity K of the bed inside across the axis, with the solid
//! fraction there.
//! A bed of this solid fraction and conductivity that holds all spheres ends at the distance e before the side, because pores next to it are
//! wider; from where it ends, the side adds the resistance R. It is printed in d/K, next to the law of walls ([`msdd_beds::wall`]) and e.

#[path = "steady/mod.rs"]
mod steady;

use msdd_beds::effective::BedMaterial;
use msdd_beds::named_gases::GasName;
use msdd_beds::network::{Beside, Materials, Network, Plate, PlateLaw};
use msdd_beds::pour::{Container, Pouring, pour};
use msdd_beds::press::press;
use msdd_beds::profile::{Width, solid_fraction};
use msdd_beds::property::Property;
use msdd_beds::solid::{Roughness, Solid};
use msdd_beds::wall::{Radiating, Wall};
use msdd_spheres::law::effective_modulus;
use msdd_spheres::{Material, Partner, Simulation, Stiffness};
use std::f64::consts::PI;
use steady::{line, steady};

const DIAMETER: f64 = 2e-3;
const T: f64 = 293.15;
/// Distance from floor and lid, and from the side, that the averages leave out \[d\].
const ENDS: f64 = 2.0;
const MARGIN: f64 = 1.5;
/// Spheres at a wall on d², as the solver has it.
const SPHERES: f64 = 0.87;
/// Numbers of side and lid.
const SIDE: usize = 1;
const LID: usize = 2;
const ROUGH: Roughness = Roughness { height_over_slope: 3.4e-7, hardness: 3e9 };

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mut arguments = std::env::args().skip(1);
    let mut number = |default: f64| arguments.next().map_or(Ok(default), |text| text.parse::<f64>());
    let (spheres, seeds) = (number(1500.0)? as usize, number(2.0)? as u64);
    let mut radii: Vec<f64> = arguments.map(|text| text.parse()).collect::<Result<_, _>>()?;
    if radii.is_empty() {
        radii = vec![2.5, 5.0, 10.0];
    }
    println!("radius[d] pressure seed k[W/mK] gas phi e[d] K[W/mK] n h[W/m2K] law R/(d/K) law");
    for over in radii {
        for seed in 1..=seeds {
            bed(over, seed, spheres)?;
        }
    }
    Ok(())
}

fn bed(over: f64, seed: u64, spheres: usize) -> Result<(), Box<dyn std::error::Error>> {
    let stiffness = Stiffness::HertzMindlin { young_modulus: 5e9, poisson_ratio: 0.29 };
    let material =
        Material { density: 7750.0, stiffness, friction: 0.3, wall_friction: 0.0, restitution: 0.8 };
    let container = Container::Cylinder { radius: over * DIAMETER };
    let (diameter, gravity, longest, threads) = (DIAMETER, 9.81, 10.0, 1);
    let pouring =
        Pouring { spheres, seed, diameter, sizes: None, material, container, gravity, longest, threads };
    let (mut bed, _) = pour(&pouring, |_| ())?;
    for pressure in [2e3, 2e4, 2e5] {
        press(&mut bed, LID, (pressure, container.area()), longest, |_| ())?;
        for (solid, gas) in
            [(42.0, GasName::Air), (42.0, GasName::Helium), (390.0, GasName::Air), (1.1, GasName::Air)]
        {
            report(&bed, (over, pressure, seed), (solid, gas));
        }
    }
    Ok(())
}

/// A bed: radius \[d\], pressure of the lid \[Pa\], seed; and what it is made of: k \[W/(m K)\] of the spheres, gas.
fn report(bed: &Simulation, (over, pressure, seed): (f64, f64, u64), (solid, gas): (f64, GasName)) {
    let radius = over * DIAMETER;
    let top = bed.boundary.walls()[LID].point[2];
    let heights = [ENDS * DIAMETER, top - ENDS * DIAMETER];
    let floor = bed.boundary.walls()[0];
    let inner = (radius - MARGIN * DIAMETER).max(DIAMETER);
    let fraction = |r: f64| solid_fraction(bed, &floor, heights, Width::Ring([0.0, r]));
    let (inside, all) = (fraction(inner), fraction(radius));
    let conducting = Solid {
        conductivity: solid,
        effective_modulus: effective_modulus(200e9, 0.29),
        roughness: Some(ROUGH),
    };
    let network = network(bed, &conducting, gas, inside);
    let found = network.conductances(&vec![T; bed.spheres.len()], &[T]);
    let volume = PI / 6.0 * DIAMETER.powi(3);
    let temperatures = steady(vec![volume; bed.spheres.len()], &found.links, &found.plates);
    let between = |k: usize| (heights[0]..heights[1]).contains(&bed.spheres[k].position[2]);
    let points: Vec<[f64; 2]> = (0..bed.spheres.len())
        .map(|k| (k, bed.spheres[k].position[0].hypot(bed.spheres[k].position[1])))
        .filter(|&(k, r)| r < inner + 0.25 * DIAMETER && between(k) && temperatures[k].is_finite())
        .map(|(k, r)| [r * r, temperatures[k]])
        .collect();
    let (at_axis, slope) = line(&points);
    // Of 1 W/m³ of the spheres.
    let conductivity = inside / (-4.0 * slope);
    let end = radius * (all / inside).sqrt();
    let resistance = (at_axis + slope * end * end) / (0.5 * all * radius);
    let area = 2.0 * PI * radius * (heights[1] - heights[0]);
    let h = found.plates.iter().filter(|link| between(link.0)).map(|link| link.2).sum::<f64>() / area;
    let near = |b: &&Beside| b.facing.gap < 0.5 * b.radius && between(b.facing.sphere);
    let n = network.beside.iter().filter(near).count() as f64 * DIAMETER * DIAMETER / area;
    let stress = stress_on_side(bed, between) / area;
    let material = BedMaterial {
        radius: 0.5 * DIAMETER,
        solid: conducting,
        gas,
        gas_pressure: 1.013e5,
        accommodation: 0.9,
    };
    let wall = Wall {
        conductivity: None,
        effective_modulus: conducting.effective_modulus,
        roughness: Some(ROUGH),
        spheres: SPHERES,
    };
    let loose = (radius - end) / DIAMETER;
    let law = wall.resistance(&material, stress, T, conductivity, &Radiating::NONE) * conductivity / DIAMETER;
    println!(
        "{over} {pressure:.0e} {seed} {solid} {} {inside:.4} {loose:.3} {conductivity:.4} {n:.3} {h:.1} {:.1} {:.3} {:.3}",
        gas,
        wall.conductance(&material, stress, T),
        resistance * conductivity / DIAMETER,
        law + loose,
    );
}

fn network(bed: &Simulation, solid: &Solid, gas: GasName, fraction: f64) -> Network {
    let materials = Materials {
        conductivity: Property::Constant(solid.conductivity),
        heat_capacity: Property::Constant(464.0),
        effective_modulus: solid.effective_modulus,
        roughness: solid.roughness,
        gas,
        gas_pressure: 1.013e5,
        accommodation: 0.9,
        solid_fraction: Some(fraction),
    };
    let law = PlateLaw::Resisting {
        conductivity: None,
        effective_modulus: solid.effective_modulus,
        roughness: solid.roughness,
    };
    Network::new(bed, materials, &[Plate { wall: SIDE, law }])
}

/// Force of the spheres that count on the side \[N\].
fn stress_on_side(bed: &Simulation, counts: impl Fn(usize) -> bool) -> f64 {
    let mut sum = 0.0;
    bed.for_each_contact(|contact| {
        if contact.i == Partner::Wall(SIDE) && counts(contact.j) {
            sum += contact.normal_force;
        }
    });
    sum
}
