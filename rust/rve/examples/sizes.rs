//! How do periodic packings of unequal spheres differ from those of equal ones?
//!
//! `sizes states [SPHERES] [SEEDS] [FRICTION]` prints a line a packing at p/E* = 1e-5: moments of the diameters (over their Sauter mean),
//! φ, z, C = κ_c/(p/E*)^(1/3), κ_g with the h of a sphere of the mean and of the Sauter diameter at three gas numbers, and F = K_rad/(4 σ T³ d) at the
//! emissivity 0.8 by ray tracing, d the Sauter mean. The numbers in `msdd_beds::sizes` follow from these.
//!
//! `sizes gas [SPHERES] [WALKS]` prints the conductivity of the gas between isothermal spheres whose radii are 5 and 10 % smaller, by random
//! walks ([`direct::walk_on_spheres`]) and by the law of pairs, as affine sums over the inner spheres of a packing.

#[path = "../../beds/examples/direct/mod.rs"]
mod direct;

use direct::ray_links::ray_links;
use direct::voxels::Ball;
use direct::walk_on_spheres::Room;
use msdd_beds::conductances::{NEAR, gas_links, near_pairs};
use msdd_beds::conductivity::{conductivity, mean};
use msdd_beds::exchange::{Emissivities, Tracing, exchange};
use msdd_beds::gas::{gas_conductance, unequal_conductance};
use msdd_beds::random::Random;
use msdd_beds::rays::Enclosure;
use msdd_beds::sizes::{Moments, Sizes};
use msdd_rve::spheres::{GAS_NUMBERS, Preparation, averages, prepare};
use msdd_spheres::{Cell, Simulation};
use std::error::Error;

const PRESSURE: f64 = 1e-5;
const EMISSIVITY: f64 = 0.8;
const RAYS: usize = 100;

fn uniform(width: f64) -> Option<Sizes> {
    Some(Sizes::Uniform([1.0 - width, 1.0 + width]))
}

/// A share of the mass in small spheres, and the ratio of the diameters.
fn mixture(ratio: f64, small: f64) -> Option<Sizes> {
    Some(Sizes::Sieve(vec![[1.0, 0.0], [1.0, small], [ratio, small], [ratio, 1.0]]))
}

fn distributions() -> Vec<(String, Option<Sizes>)> {
    let mut all = vec![("equal".to_string(), None)];
    all.extend([0.1, 0.2, 0.3, 0.4, 0.5, 0.6].map(|width| (format!("uniform {width}"), uniform(width))));
    all.extend([0.2, 0.35].map(|spread| (format!("log-normal {spread}"), Some(Sizes::LogNormal(spread)))));
    for ratio in [2.0, 3.0] {
        all.extend([0.2, 0.5, 0.8].map(|small| (format!("1:{ratio} {small}"), mixture(ratio, small))));
    }
    all
}

fn packed(
    spheres: usize,
    seed: u64,
    friction: f64,
    sizes: &Option<Sizes>,
) -> Result<Simulation, Box<dyn Error>> {
    let preparation = Preparation {
        spheres,
        seed,
        sizes: sizes.clone(),
        poisson_ratio: 0.25,
        restitution: 0.3,
        packing_friction: friction,
        friction,
        rates: [1.0; 3],
        shaking: 0.0,
        pressure: PRESSURE,
    };
    Ok(prepare(&preparation)?.simulation)
}

fn main() -> Result<(), Box<dyn Error>> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let number = |k: usize, default: f64| arguments.get(k).map_or(Ok(default), |text| text.parse::<f64>());
    let spheres = number(1, 1000.0)? as usize;
    match arguments.first().map(String::as_str) {
        Some("states") => states(spheres, number(2, 2.0)? as u64, number(3, 0.3)?),
        Some("gas") => gas(spheres, number(2, 2000.0)? as usize),
        _ => Err("sizes states [SPHERES] [SEEDS] [FRICTION], or gas [SPHERES] [WALKS]".into()),
    }
}

fn states(spheres: usize, seeds: u64, friction: f64) -> Result<(), Box<dyn Error>> {
    println!(
        "sizes,friction,seed,mean,spread,phi,z,backbone,p,C,mean35,mean60,mean85,sauter35,sauter60,sauter85,F"
    );
    for (name, sizes) in distributions() {
        let m = Moments::new(sizes.as_ref(), spheres);
        for seed in 1..=seeds {
            let simulation = packed(spheres, seed, friction, &sizes)?;
            let a = averages(&simulation).ok_or("no averages")?;
            let volume = simulation.cell().map_or(0.0, Cell::volume);
            let p = a.pressure();
            let contacts = a.contact_conductivity[..3].iter().sum::<f64>() / 3.0;
            print!(
                "{name},{friction},{seed},{:.4},{:.4},{:.5},{:.4},{:.4},{p:.4e},{:.4}",
                m.mean,
                m.spread,
                a.solid_fraction,
                a.coordination,
                a.backbone_coordination,
                contacts / libm::cbrt(p)
            );
            for diameter in [m.mean, 1.0] {
                for number in GAS_NUMBERS {
                    let links =
                        gas_links(&near_pairs(&simulation), 1.0, |_| 0.5 * diameter * libm::exp(-number));
                    print!(
                        ",{:.4}",
                        mean(&conductivity(&links, spheres, volume).ok_or("no solution")?.network)
                    );
                }
            }
            let enclosure = Enclosure::new(&simulation);
            let surfaces = Emissivities { spheres: EMISSIVITY, walls: Vec::new() };
            let traced = exchange(&enclosure, &surfaces, &Tracing { rays: RAYS, seed: 1, threads: 1 })?;
            let found =
                conductivity(&ray_links(&traced, &enclosure), spheres, volume).ok_or("no solution")?;
            println!(",{:.4}", mean(&found.affine));
        }
    }
    Ok(())
}

fn gas(spheres: usize, walks: usize) -> Result<(), Box<dyn Error>> {
    println!("sizes,radii,walks,pairs of equal spheres over walks,pairs over walks");
    for (name, sizes) in [("equal", None), ("uniform 0.4", uniform(0.4)), ("1:2 0.5", mixture(2.0, 0.5))] {
        let simulation = packed(spheres, 1, 0.3, &sizes)?;
        let edges = simulation.cell().ok_or("no box")?.lattice.edges;
        let [x, y, z] = [0, 1, 2].map(|k| edges[k][k]);
        let origin = simulation.cell().ok_or("no box")?.lattice.origin;
        for smaller in [0.95, 0.9] {
            let balls: Vec<Ball> = (simulation.spheres.iter())
                .map(|s| {
                    let place = |k: usize, edge: f64| (s.position[k] - origin[k]).rem_euclid(edge);
                    Ball { centre: [place(0, x), place(1, y), place(2, z)], radius: smaller * s.radius }
                })
                .filter(|ball| ball.centre[2] > ball.radius && z - ball.centre[2] > ball.radius)
                .collect();
            let room = Room::new([x, y], z, balls.clone());
            let largest = balls.iter().fold(0.0f64, |r, ball| r.max(ball.radius));
            let [mut walked, mut equal, mut pairs] = [0.0; 3];
            for (i, a) in balls.iter().enumerate() {
                if a.centre[2] < 4.5 * largest || z - a.centre[2] < 4.5 * largest {
                    continue;
                }
                let Some(found) = room.exchange_of_ball(i, walks, &mut Random::stream(7, i as u64)) else {
                    continue;
                };
                for (j, b) in balls.iter().enumerate() {
                    let mut away: [f64; 3] = std::array::from_fn(|k| b.centre[k] - a.centre[k]);
                    away[0] -= x * (away[0] / x).round();
                    away[1] -= y * (away[1] / y).round();
                    let square = away.iter().map(|d| d * d).sum::<f64>();
                    walked += found.balls[j] * square;
                    let reach = a.radius + b.radius;
                    if i != j && square.sqrt() < NEAR * reach / smaller {
                        let gap = square.sqrt() - reach;
                        let radius = 2.0 * a.radius * b.radius / reach;
                        equal += square * gas_conductance(1.0, radius, gap);
                        pairs +=
                            square * unequal_conductance(1.0, radius, a.radius.min(b.radius) / radius, gap);
                    }
                }
            }
            println!("{name},{smaller},{walked:.3},{:.3},{:.3}", equal / walked, pairs / walked);
        }
    }
    Ok(())
}
