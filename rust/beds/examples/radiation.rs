//! Radiation in periodic packings of equal spheres.
//!
//! `radiation factors [SPHERES] [SEEDS] [RAYS]` prints F of K_rad = 4 σ T³ d F by ray tracing ([`msdd_beds::exchange`]): the affine sum, the
//! network's own solution, and the closed form of [`msdd_beds::radiation`]; then F if the surfaces have the temperature of the mean gradient at
//! their centres, at their points, and the product of both, by which the closed form takes the resistance of the solid. Packings with
//! four frictions, and one that was compressed along z.
//!
//! `radiation sheared [SPHERES] [RAYS]` prints the same of packings that were sheared at constant volume, as they are and opened to φ = 0.55.
//!
//! `radiation direct [SPHERES] [SEED] [VOXELS] [PERCENT]` prints K/k_g by solutions of the heat equation in spheres and gas with surfaces that
//! radiate ([`direct::voxels`]), along z, with VOXELS along an edge and with 2/3 of that, extrapolated by the power 1, without
//! radiation and with it; and the closed form with the conductivity without radiation of the direct solution. Where spheres touch, voxels
//! conduct too well between good conductors; PERCENT makes the radii smaller, so that they do not touch.

#[path = "direct/mod.rs"]
mod direct;

use direct::ray_links::ray_links;
use direct::voxels::{Ball, Sight, Voxels};
use msdd_beds::conductivity::{conductivity, mean};
use msdd_beds::exchange::{Emissivities, Tracing, exchange};
use msdd_beds::radiation::{Dark, factor};
use msdd_beds::random::Random;
use msdd_beds::rays::{Body, Enclosure};
use msdd_beds::{Packing, pack, pack_along};
use msdd_spheres::space::{dot, minus};
use msdd_spheres::{Cell, Material, Simulation, Stiffness};
use std::error::Error;

const HEADER: &str =
    "kind,friction,seed,solid_fraction,emissivity,affine,network,closed_form,xx,yy,zz,centres,mixed,points";
const EMISSIVITIES: [f64; 6] = [1.0, 0.8, 0.6, 0.4, 0.2, 0.1];
const FRICTIONS: [f64; 4] = [0.0, 0.1, 0.3, 0.5];
/// Logarithmic strain of sheared packings along both axes, and the solid fraction to which they are opened.
const SHEAR: f64 = 0.3;
const LOOSEST: f64 = 0.55;
/// Of the direct solutions: ε, κ, Λ.
const SURFACES: [f64; 3] = [1.0, 0.6, 0.2];
const RATIOS: [f64; 4] = [5.0, 20.0, 100.0, 1000.0];
const SOLIDS: [f64; 5] = [0.3, 1.0, 3.0, 10.0, 100.0];
/// Rays of a direct solution.
const RAYS: usize = 300_000;

fn main() -> Result<(), Box<dyn Error>> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let number = |k: usize, default: u64| arguments.get(k).map_or(Ok(default), |text| text.parse::<u64>());
    match arguments.first().map(String::as_str) {
        Some("factors") => factors(number(1, 1000)? as usize, number(2, 1)?, number(3, 450)? as usize),
        Some("sheared") => sheared(number(1, 500)? as usize, number(2, 450)? as usize),
        Some("direct") => {
            let smaller = 1.0 - 0.01 * number(4, 0)? as f64;
            direct(number(1, 50)? as usize, number(2, 1)?, number(3, 72)? as usize, smaller)
        }
        _ => Err("radiation factors [SPHERES] [SEEDS] [RAYS], sheared [SPHERES] [RAYS], or direct [SPHERES] [SEED] [VOXELS] [PERCENT]"
            .into()),
    }
}

fn packing(spheres: usize, seed: u64, friction: f64) -> Packing {
    let stiffness = Stiffness::HertzMindlin { young_modulus: 1.0, poisson_ratio: 0.25 };
    let material = Material { density: 1.0, stiffness, friction, wall_friction: 0.0, restitution: 0.3 };
    Packing { spheres, seed, diameter: 1.0, sizes: None, material, pressure: 1e-6, steps: 400_000 }
}

fn factors(spheres: usize, seeds: u64, rays: usize) -> Result<(), Box<dyn Error>> {
    println!("{HEADER}");
    for friction in FRICTIONS {
        for seed in 1..=seeds {
            let packed = pack(&packing(spheres, seed, friction))?;
            rows(
                &format!("isotropic,{friction},{seed}"),
                &packed.simulation,
                packed.averages.solid_fraction,
                rays,
            )?;
        }
    }
    let packed = pack_along(&packing(spheres, 1, 0.3), [0.0, 0.0, 1.0])?;
    rows("along_z,0.3,1", &packed.simulation, packed.averages.solid_fraction, rays)
}

fn sheared(spheres: usize, rays: usize) -> Result<(), Box<dyn Error>> {
    println!("{HEADER}");
    for friction in [FRICTIONS[0], FRICTIONS[3]] {
        let mut simulation = pack(&packing(spheres, 1, friction))?.simulation;
        // Opens along x and closes along y, as slowly as the packing was made.
        let rate = 1e-5;
        let until = simulation.time + SHEAR / rate;
        simulation.set_velocity_gradient([[rate, 0.0, 0.0], [0.0, -rate, 0.0], [0.0; 3]]);
        while simulation.time < until {
            simulation.run(1000)?;
        }
        let fraction = |simulation: &Simulation| {
            spheres as f64 * std::f64::consts::PI / 6.0 / simulation.cell().map_or(f64::NAN, Cell::volume)
        };
        rows(&format!("sheared,{friction},1"), &simulation, fraction(&simulation), rays)?;
        simulation.scale_cell((fraction(&simulation) / LOOSEST).cbrt());
        rows(&format!("opened,{friction},1"), &simulation, fraction(&simulation), rays)?;
    }
    Ok(())
}

fn rows(name: &str, simulation: &Simulation, phi: f64, rays: usize) -> Result<(), Box<dyn Error>> {
    let enclosure = Enclosure::new(simulation);
    let volume = simulation.cell().map_or(0.0, |cell| cell.volume());
    for emissivity in EMISSIVITIES {
        let surfaces = Emissivities { spheres: emissivity, walls: Vec::new() };
        let traced = exchange(&enclosure, &surfaces, &Tracing { rays, seed: 1, threads: 2 })?;
        let links = ray_links(&traced, &enclosure);
        let found = conductivity(&links, simulation.spheres.len(), volume).ok_or("no solution")?;
        let [xx, yy, zz] = [0, 1, 2].map(|k| found.affine[k][k]);
        let [centres, mixed, points] = spread(&enclosure, emissivity, rays, volume);
        println!(
            "{name},{phi:.4},{emissivity},{:.4},{:.4},{:.4},{xx:.4},{yy:.4},{zz:.4},{centres:.4},{mixed:.4},{points:.4}",
            mean(&found.affine),
            mean(&found.network),
            factor(emissivity, phi),
        );
    }
    Ok(())
}

/// F if surfaces have the temperature of the mean gradient at their centres, at their points, and the product of both.
fn spread(enclosure: &Enclosure, emissivity: f64, rays: usize, volume: f64) -> [f64; 3] {
    let mut sums = [0.0; 3];
    let spheres = enclosure.radii().len();
    let area: f64 = enclosure.radii().iter().map(|r| 4.0 * std::f64::consts::PI * r * r).sum();
    for sphere in 0..spheres {
        let mut random = Random::stream(7, sphere as u64);
        for _ in 0..rays {
            let start = enclosure.on_sphere(sphere, &mut random);
            let end = enclosure.follow(start, |_| emissivity, &mut random);
            let Body::Sphere(j) = end.body else { continue };
            let centres = enclosure.branch(sphere, j as usize, end.shift);
            let points = minus(end.point, start.point);
            let products = [dot(centres, centres), dot(centres, points), dot(points, points)];
            (0..3).for_each(|k| sums[k] += products[k]);
        }
    }
    sums.map(|sum| sum * emissivity * area / (6.0 * (spheres * rays) as f64 * volume))
}

fn direct(spheres: usize, seed: u64, count: usize, smaller: f64) -> Result<(), Box<dyn Error>> {
    println!(
        "friction,solid_fraction,emissivity,ratio,solid,dark_coarse,dark_fine,coarse,fine,dark,direct,closed_form"
    );
    for friction in [0.0, 0.5] {
        let packed = pack(&packing(spheres, seed, friction))?;
        let edge = packed.simulation.cell().map_or(0.0, |cell| cell.volume()).cbrt();
        let solid_fraction = packed.averages.solid_fraction * smaller.powi(3);
        let balls: Vec<Ball> = (packed.simulation.spheres.iter())
            .map(|s| Ball { centre: s.position.map(|c| c / edge), radius: smaller * s.radius / edge })
            .collect();
        let grids = [count * 2 / 3, count].map(|count| Voxels::new(&balls, count));
        let solve = |ratio: f64, rays: [&[Sight]; 2], each: f64| {
            [0, 1].map(|k| grids[k].radiating(ratio, 2, (rays[k], each)).unwrap_or(f64::NAN))
        };
        let extrapolated = |[coarse, fine]: [f64; 2]| 3.0 * fine - 2.0 * coarse;
        let diameter = smaller / edge;
        let area = spheres as f64 * std::f64::consts::PI * diameter * diameter;
        for emissivity in SURFACES {
            let [coarse, fine] = sights(&balls, &grids, emissivity, seed);
            // ε A/2 of a ray, over the edge of the cube.
            let each = 0.5 * emissivity * area / RAYS as f64;
            for ratio in RATIOS {
                let dark = solve(ratio, [&[], &[]], 0.0);
                let bed = Dark { conductivity: extrapolated(dark), solid: ratio, gas: 1.0, solid_fraction };
                for solid in SOLIDS {
                    let black = ratio / solid;
                    let bright = solve(ratio, [&coarse, &fine], each * black / diameter);
                    let numbers =
                        [dark[0], dark[1], bright[0], bright[1], bed.conductivity, extrapolated(bright)];
                    println!(
                        "{friction},{solid_fraction:.4},{emissivity},{ratio},{solid},{},{:.4}",
                        numbers.map(|x| format!("{x:.4}")).join(","),
                        bed.conductivity + bed.radiation(black, emissivity),
                    );
                }
            }
        }
    }
    Ok(())
}

/// Rays from all balls in turn, on both grids.
fn sights(balls: &[Ball], grids: &[Voxels; 2], emissivity: f64, seed: u64) -> [Vec<Sight>; 2] {
    let spheres: Vec<_> = balls.iter().map(|ball| (ball.centre, ball.radius)).collect();
    let enclosure = Enclosure::of(&spheres, Cell::block([1.0; 3]).lattice, [true; 3], Vec::new());
    let mut random = Random::new(seed);
    let mut sights: [Vec<Sight>; 2] = Default::default();
    for ray in 0..RAYS {
        let start = enclosure.on_sphere(ray % spheres.len(), &mut random);
        let end = enclosure.follow(start, |_| emissivity, &mut random);
        for (sights, grid) in sights.iter_mut().zip(grids) {
            sights.push(grid.sight(&start, &end));
        }
    }
    sights
}
