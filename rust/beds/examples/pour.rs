//! Pours the steel bed of `cases/beaulieu` and prints how long it takes: `pour YOUNG_MODULUS [THREADS [SPHERES]]`.

use msdd_beds::pour::{Container, Pouring, pour};
use msdd_beds::press::press;
use msdd_beds::settle::turn;
use msdd_spheres::{Material, Stiffness};
use std::time::Instant;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let arguments: Vec<f64> = std::env::args().skip(1).map(|text| text.parse()).collect::<Result<_, _>>()?;
    let [young_modulus, threads, spheres] =
        [(0, 5e7), (1, 1.0), (2, 8849.0)].map(|(k, default)| arguments.get(k).copied().unwrap_or(default));
    let base = [0.1, 0.2];
    let pouring = Pouring {
        spheres: spheres as usize,
        seed: 1,
        diameter: 6.4e-3,
        material: Material {
            density: 7747.0,
            stiffness: Stiffness::HertzMindlin { young_modulus, poisson_ratio: 0.29 },
            friction: 0.3,
            wall_friction: 0.3,
            restitution: 0.8,
        },
        container: Container::Box { base },
        gravity: 9.81,
        longest: 3.0,
        threads: threads as usize,
    };
    let begin = Instant::now();
    let tell = |what: &str, simulation: &msdd_spheres::Simulation, rest: &msdd_beds::settle::Rest| {
        let seconds = begin.elapsed().as_secs_f64();
        let walls = simulation.boundary.walls();
        let mut contacts = 0;
        simulation.for_each_contact(|_| contacts += 1);
        println!(
            "{what}: {rest:?}, {seconds:.1} s so far, z about {:.2}, lid {:.5}, plate {:.5}, {:?}",
            2.0 * f64::from(contacts) / spheres,
            walls[5].point[2],
            walls[4].point[1],
            simulation.wall_force.iter().map(|f| msdd_spheres::space::length(*f)).collect::<Vec<_>>()
        );
    };
    let (mut simulation, rest) = pour(&pouring, |_| ())?;
    tell("poured", &simulation, &rest);
    let rest = press(&mut simulation, 5, (1000.0, 0.02), 1.0, |_| ())?;
    tell("lid", &simulation, &rest);
    turn(&mut simulation, [0.0, -1.0, 0.0], 0.2, |_| ())?;
    tell("turned", &simulation, &rest);
    let lid = simulation.boundary.walls()[5].point[2];
    let rest = press(&mut simulation, 4, (1000.0, 0.1 * lid), 1.0, |_| ())?;
    tell("plate", &simulation, &rest);
    Ok(())
}
