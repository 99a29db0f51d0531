//! Exchange by radiation against closed forms, and in packings.

#[path = "../examples/direct/ray_links.rs"]
mod ray_links;

use msdd_beds::conductivity::{conductivity, mean};
use msdd_beds::exchange::{Emissivities, Exchange, Share, Tracing, exchange};
use msdd_beds::radiation::factor;
use msdd_beds::random::Random;
use msdd_beds::rays::{Body, Enclosure, Spot};
use msdd_beds::{Packing, pack};
use msdd_engine::Lattice;
use msdd_spheres::{Boundary, Cell, Material, Simulation, Sphere, Stiffness, Wall};
use ray_links::ray_links;
use std::f64::consts::PI;

fn material() -> Material {
    let stiffness = Stiffness::HertzMindlin { young_modulus: 1.0, poisson_ratio: 0.25 };
    Material { density: 1.0, stiffness, friction: 0.3, wall_friction: 0.0, restitution: 0.3 }
}

fn share(shares: &[Share], body: Body) -> f64 {
    shares.iter().filter(|share| share.body == body).map(|share| share.share).sum()
}

fn trace(enclosure: &Enclosure, spheres: f64, walls: &[f64], rays: usize) -> Exchange {
    let emissivities = Emissivities { spheres, walls: walls.to_vec() };
    exchange(enclosure, &emissivities, &Tracing { rays, seed: 1, threads: 2 }).expect("a room")
}

/// Two plates at z = 0 and 1 next to a cell of edge 1 that repeats itself, with these spheres between them.
fn between(spheres: &[([f64; 3], f64)]) -> Enclosure {
    let lattice = Lattice { origin: [0.0; 3], edges: [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]] };
    let walls =
        vec![Wall::at_rest([0.0; 3], [0.0, 0.0, 1.0]), Wall::at_rest([0.0, 0.0, 1.0], [0.0, 0.0, -1.0])];
    Enclosure::of(spheres, lattice, [true, true, false], walls)
}

/// Shares of what the lower (0) or upper (1) plate emits that are absorbed by these bodies.
fn of_plate<const N: usize>(
    enclosure: &Enclosure,
    (spheres, walls): (f64, [f64; 2]),
    (plate, rays, seed): (u32, u32, u64),
    bodies: [Body; N],
) -> [f64; N] {
    let emissivities = Emissivities { spheres, walls: walls.to_vec() };
    let mut random = Random::stream(seed, 1000 + u64::from(plate));
    let mut counts = [0u32; N];
    for _ in 0..rays {
        let [x, y] = [(); 2].map(|()| random.uniform(0.0, 1.0));
        let (point, normal) = ([x, y, f64::from(plate)], [0.0, 0.0, 1.0 - 2.0 * f64::from(plate)]);
        let start = Spot { body: Body::Wall(plate), shift: [0; 3], point, normal };
        let end = enclosure.follow(start, |body| emissivities.absorbed(body), &mut random);
        bodies.iter().zip(&mut counts).for_each(|(body, count)| *count += u32::from(end.body == *body));
    }
    counts.map(|count| f64::from(count) / f64::from(rays))
}

/// Two grey plates exchange 1/(1/ε₁ + 1/ε₂ − 1) of what black ones do.
#[test]
fn plates_exchange_as_two_resistances_say() {
    let room = between(&[]);
    let [share] = of_plate(&room, (1.0, [0.7, 0.4]), (0, 1_000_000, 1), [Body::Wall(1)]);
    let found = 0.7 * share;
    assert!((found * (1.0 / 0.7 + 1.0 / 0.4 - 1.0) - 1.0).abs() < 2e-3, "{found}");
    assert_eq!(of_plate(&room, (1.0, [1.0; 2]), (0, 1000, 1), [Body::Wall(1)]), [1.0]);
}

/// Share of the diffuse rays from a plate that a layer of spheres takes, in a square lattice of edge 1: those that come nearer than a
/// radius to a centre. The mean over places in the plane of the layer and over directions, by points that fill the cube evenly
/// (H. Niederreiter, Random Number Generation and Quasi-Monte Carlo Methods, 1992, section 3.1: multiples of roots of the generalised golden
/// ratio); nothing is traced.
fn shaded(radius: f64) -> f64 {
    let golden = 1.165_303_978_267_774_5_f64; // x⁵ = x + 1
    let steps: [f64; 4] = std::array::from_fn(|k| golden.powi(-1 - k as i32));
    let points = 2_000_000;
    let taken = (0..points).filter(|&n| {
        let [x, y, square, turn] = steps.map(|step| (0.5 + f64::from(n) * step).fract());
        let (across, up) = (square.sqrt(), (1.0 - square).sqrt());
        let angle = 2.0 * PI * turn;
        let (u, v) = (across * angle.cos(), across * angle.sin());
        let far = (radius / up).min(50.0).ceil() as i32 + 1;
        (-far..=far).any(|i| {
            (-far..=far).any(|j| {
                let (a, b) = (x - f64::from(i), y - f64::from(j));
                a * a + b * b - (a * u + b * v).powi(2) < radius * radius
            })
        })
    });
    taken.count() as f64 / f64::from(points)
}

/// Two black plates with one layer of black spheres between them: a plate gives to the layer what the layer shades, the rest to the other
/// plate; a sphere gives each plate, by reciprocity, A/(π d²) of that. Sixteen million rays from each, which leave a standard deviation of
/// at most 4e-4 of each share.
#[test]
fn a_layer_of_black_spheres_shades_two_plates() {
    let radius = 0.3;
    let (enclosure, seeds) = (between(&[([0.5; 3], radius)]), 16);
    let mut found = [0.0; 6];
    for seed in 1..=seeds {
        let emissivities = Emissivities { spheres: 1.0, walls: vec![1.0; 2] };
        let traced = exchange(&enclosure, &emissivities, &Tracing { rays: 1_000_000, seed, threads: 2 });
        let traced = traced.expect("a layer");
        for wall in 0..2 {
            let bodies = [Body::Sphere(0), Body::Wall(1 - wall as u32)];
            let others = of_plate(&enclosure, (1.0, [1.0; 2]), (wall as u32, 1_000_000, seed), bodies);
            let to_wall = share(&traced.spheres[0], Body::Wall(wall as u32));
            [to_wall, others[0], others[1]]
                .iter()
                .enumerate()
                .for_each(|(k, s)| found[3 * wall + k] += s / seeds as f64);
        }
    }
    let taken = shaded(radius);
    let expected = [taken / (4.0 * PI * radius * radius), taken, 1.0 - taken];
    for (k, found) in found.iter().enumerate() {
        assert!((found / expected[k % 3] - 1.0).abs() < 1e-3, "{k}: {found} {}", expected[k % 3]);
    }
}

/// A sphere anywhere in a block gives each wall the solid angle at which its centre sees it, over 4π: of the four rectangles of a
/// wall with a corner at the foot of the centre, atan(a b/(h √(a² + b² + h²))) each.
#[test]
fn a_sphere_in_a_block_sees_solid_angles() {
    let (size, centre) = ([3.0, 2.0, 1.5], [1.1, 0.7, 0.6]);
    let walls = Wall::block(size);
    let spheres = vec![Sphere::at_rest(centre, 0.4, 1.0)];
    let room = Simulation::new(material(), spheres, Boundary::Walls(walls)).expect("a room");
    let traced = trace(&Enclosure::new(&room), 1.0, &[1.0; 6], 1_000_000);
    for wall in 0..6 {
        let axis = wall / 2;
        let height = if wall % 2 == 0 { centre[axis] } else { size[axis] - centre[axis] };
        let sides = |k: usize| [centre[k], size[k] - centre[k]];
        let (mut angle, [u, v]) = (0.0, [(axis + 1) % 3, (axis + 2) % 3]);
        for a in sides(u) {
            for b in sides(v) {
                angle += (a * b / (height * (a * a + b * b + height * height).sqrt())).atan();
            }
        }
        let found = share(&traced.spheres[0], Body::Wall(wall as u32));
        assert!((found - angle / (4.0 * PI)).abs() < 1.2e-3, "{wall}: {found} {}", angle / (4.0 * PI));
    }
}

/// In a cylinder without a lid what nothing absorbs leaves: a sphere on the axis sees the solid angles of disc, side and opening.
#[test]
fn rays_leave_an_open_cylinder() {
    let walls =
        vec![Wall::at_rest([0.0; 3], [0.0, 0.0, 1.0]), Wall::cylinder([0.0; 3], [0.0, 0.0, 1.0], 1.0)];
    let spheres = vec![Sphere::at_rest([0.0, 0.0, 0.8], 0.3, 1.0)];
    let room = Simulation::new(material(), spheres, Boundary::Walls(walls)).expect("a room");
    let traced = trace(&Enclosure::new(&room), 1.0, &[1.0; 2], 400_000);
    let disc = 0.5 * (1.0 - 0.8 / (1.0f64 + 0.64).sqrt());
    let found = [Body::Wall(0), Body::Wall(1), Body::Open].map(|body| share(&traced.spheres[0], body));
    // The side has no end, and takes all that goes up.
    assert!((found[0] - disc).abs() < 2e-3 && (found[1] - 1.0 + disc).abs() < 2e-3, "{found:?} {disc}");
}

fn packing() -> (Simulation, f64) {
    let packing = Packing {
        spheres: 200,
        seed: 1,
        diameter: 1.0,
        sizes: None,
        material: material(),
        pressure: 1e-5,
        steps: 400_000,
    };
    let packed = pack(&packing).expect("a packing");
    (packed.simulation, packed.averages.solid_fraction)
}

/// Sums, reciprocity, threads, and F as of two packings of 4000 spheres with φ = 0.5895 and 0.6034 that were traced apart from this program,
/// on a straight line over φ.
#[test]
fn a_packing_exchanges_what_others_have() {
    let (simulation, phi) = packing();
    let enclosure = Enclosure::new(&simulation);
    let volume = simulation.cell().expect("periodic").volume();
    for (emissivity, [loose, dense]) in [(1.0, [1.058, 1.033]), (0.6, [0.609, 0.590]), (0.2, [0.274, 0.259])]
    {
        let expected = loose + (dense - loose) * (phi - 0.5895) / (0.6034 - 0.5895);
        let rays = 1000;
        let traced = trace(&enclosure, emissivity, &[], rays);
        let (mut most, mut off, mut pairs) = (0.0f64, 0.0, 0.0);
        for (i, shares) in traced.spheres.iter().enumerate() {
            let sum: f64 = shares.iter().map(|share| share.share).sum();
            most = most.max((sum - 1.0).abs());
            for j in i + 1..traced.spheres.len() {
                let there = share(shares, Body::Sphere(j as u32));
                let back = share(&traced.spheres[j], Body::Sphere(i as u32));
                // Each count has the variance of its mean.
                if there + back > 0.0 {
                    off += (there - back).powi(2) / ((there + back) / rays as f64);
                    pairs += 1.0;
                }
            }
        }
        assert!(most < 1e-12, "{most}");
        assert!(off / pairs < 1.1, "{off} {pairs}");
        let links = ray_links(&traced, &enclosure);
        let found = conductivity(&links, 200, volume).expect("a network");
        let (affine, network) = (mean(&found.affine), mean(&found.network));
        assert!((affine / expected - 1.0).abs() < 0.02, "{emissivity}: {affine} at {phi}");
        assert!((affine / factor(emissivity, phi) - 1.0).abs() < 0.03);
        assert!(network < affine && network > 0.98 * affine, "{network} {affine}");
    }
    let emissivities = Emissivities { spheres: 0.5, walls: Vec::new() };
    let by = |threads| exchange(&enclosure, &emissivities, &Tracing { rays: 20, seed: 3, threads });
    let one = by(1).expect("a trace");
    assert_eq!(one, by(3).expect("a trace"));
    let told = one.warning().expect("few rays");
    assert!(told.starts_with("radiation: rays = 20:") && told.contains("11 %"), "{told}");
}

#[test]
fn what_cannot_be_is_refused() {
    let enclosure = between(&[]);
    let refused = |spheres: f64, walls: &[f64], rays: usize| {
        let emissivities = Emissivities { spheres, walls: walls.to_vec() };
        let found = exchange(&enclosure, &emissivities, &Tracing { rays, seed: 1, threads: 1 });
        found.map(|_| ()).unwrap_err().to_string()
    };
    assert_eq!(refused(1.2, &[1.0; 2], 100), "radiation: emissivity = 1.2, allowed: 0.01 to 1");
    let allowed = "radiation: emissivity of a wall = -0.1, allowed: 0 (reflects everything), or 0.01 to 1";
    assert_eq!(refused(1.0, &[1.0, -0.1], 100), allowed);
    assert_eq!(refused(0.0, &[1.0; 2], 100), "radiation: emissivity = 0, allowed: 0.01 to 1");
    // Rays would be reflected a million times.
    assert_eq!(refused(1e-6, &[1.0; 2], 100), "radiation: emissivity = 0.000001, allowed: 0.01 to 1");
    assert_eq!(refused(1.0, &[1e-6, 0.0], 100), allowed.replace("-0.1", "0.000001"));
    assert_eq!(refused(1.0, &[1.0; 2], 0), "radiation: rays = 0, allowed: 1 to 1000000");
    assert!(refused(1.0, &[1.0], 100).contains("as many as the bed has"));
}

/// A sheared cell is the same packing: F does not change when the third edge is replaced by its sum with the first.
#[test]
fn another_cell_of_the_same_packing_is_the_same() {
    let (simulation, _) = packing();
    let Some(cell) = simulation.cell() else { panic!("periodic") };
    let sheared = |by: f64| {
        let [a, b, mut c] = cell.lattice.edges;
        c[0] += by * a[0];
        Cell { lattice: Lattice { origin: cell.lattice.origin, edges: [a, b, c] }, ..*cell }
    };
    let found = [0.0, 1.0].map(|by| {
        let spheres = simulation.spheres.clone();
        let same = Simulation::new(material(), spheres, Boundary::Periodic(sheared(by))).expect("a cell");
        let enclosure = Enclosure::new(&same);
        let links = ray_links(&trace(&enclosure, 1.0, &[], 500), &enclosure);
        mean(&conductivity(&links, 200, cell.volume()).expect("a network").affine)
    });
    assert!((found[0] / found[1] - 1.0).abs() < 1e-2, "{found:?}");
}

/// Scaling what was traced with another emissivity, as a network does for an emissivity that depends on the temperature, has the conductivity
/// of rays with each emissivity within 2 %.
#[test]
fn exchanges_are_scaled_to_other_emissivities() {
    let (simulation, phi) = packing();
    let enclosure = Enclosure::new(&simulation);
    let volume = simulation.cell().expect("periodic").volume();
    let [low, middle, high] = [0.3, 0.55, 0.8].map(|emissivity| {
        let links = ray_links(&trace(&enclosure, emissivity, &[], 1000), &enclosure);
        mean(&conductivity(&links, 200, volume).expect("a network").network) / factor(emissivity, phi)
    });
    for found in [low, high] {
        assert!((found / middle - 1.0).abs() < 0.02, "{low} {middle} {high}");
    }
}
