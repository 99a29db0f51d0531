//! Conductivity of crystals against closed forms, and of a packing against what must hold for any network.

use msdd_beds::conductances::{Link, contact_links, gas_links, near_pairs};
use msdd_beds::conductivity::{Conductivity, conductivity, mean};
use msdd_beds::effective::{closure_error, pair_factor, poor_spheres};
use msdd_beds::gas::{Gas, gas_conductance};
use msdd_beds::solid::Solid;
use msdd_beds::{Packing, pack};
use msdd_spheres::law::effective_modulus;
use msdd_spheres::{Boundary, Cell, Material, Simulation, Sphere, Stiffness};

const RADIUS: f64 = 3.2e-3;
const OVERLAP: f64 = 1e-5;
const STEEL: Solid = Solid { conductivity: 42.0, effective_modulus: 1.1e11, roughness: None };
const AIR: Gas = Gas {
    conductivity: 0.026,
    mean_free_path: 68e-9,
    prandtl: 0.71,
    heat_capacity_ratio: 1.4,
    accommodation: 0.9,
};

fn material(young_modulus: f64) -> Material {
    Material {
        density: 7850.0,
        stiffness: Stiffness::HertzMindlin { young_modulus, poisson_ratio: 0.29 },
        friction: 0.3,
        wall_friction: 0.0,
        restitution: 0.3,
    }
}

/// A crystal of cubic cells of the given edge over the distance l of neighbours.
fn crystal(edge: f64, basis: &[[f64; 3]]) -> Simulation {
    let (cells, edge) = (3, edge * distance());
    let mut spheres = Vec::new();
    for k in 0..cells * cells * cells {
        let corner = [k % cells, k / cells % cells, k / cells / cells];
        for place in basis {
            let position = std::array::from_fn(|m| edge * (corner[m] as f64 + place[m]));
            spheres.push(Sphere::at_rest(position, RADIUS, 7850.0));
        }
    }
    let cell = Cell::block([edge * cells as f64; 3]);
    Simulation::new(material(5e9), spheres, Boundary::Periodic(cell)).unwrap()
}

/// l \[m\].
fn distance() -> f64 {
    2.0 * RADIUS * (1.0 - OVERLAP)
}

fn solve(simulation: &Simulation, links: &[Link]) -> Conductivity {
    conductivity(links, simulation.spheres.len(), simulation.cell().unwrap().volume()).unwrap()
}

/// Checks K = factor G/l along all axes, with contacts and with gas, where G is the conductance of one pair.
fn check(simulation: &Simulation, factor: f64) {
    // The spheres of the simulation are softer than steel: the contact of steel under the same force is smaller.
    let soft = effective_modulus(5e9, 0.29);
    let size = (0.5 * RADIUS * 2.0 * RADIUS * OVERLAP).sqrt() * (soft / STEEL.effective_modulus).cbrt();
    let least = |radius: f64| AIR.least_distance(radius, STEEL.conductivity);
    let by_gas = gas_conductance(AIR.conductivity, RADIUS, least(RADIUS));
    let contacts = solve(simulation, &contact_links(simulation, &STEEL));
    let gas = solve(simulation, &gas_links(&near_pairs(simulation), AIR.conductivity, least));
    for (found, pair) in [(contacts, 2.0 * STEEL.conductivity * size), (gas, by_gas)] {
        for row in 0..3 {
            for column in 0..3 {
                let expected = if row == column { factor * pair / distance() } else { 0.0 };
                let error = (found.network[row][column] - expected) / (factor * pair / distance());
                assert!(error.abs() < 1e-9, "{row} {column}: {error:e}");
            }
        }
    }
}

#[test]
fn simple_cubic() {
    check(&crystal(1.0, &[[0.0; 3]]), 1.0);
}

/// Twelve neighbours, of which eight have a part of their distance along each axis: K = 2 √2 G/l.
#[test]
fn face_centred_cubic() {
    let basis = [[0.0; 3], [0.0, 0.5, 0.5], [0.5, 0.0, 0.5], [0.5, 0.5, 0.0]];
    check(&crystal(2.0f64.sqrt(), &basis), 8.0f64.sqrt());
}

/// Spheres of two sizes in the crystal of caesium chloride, which touch those of the other size alone: eight contacts in a cell of the
/// edge a, each with a part of a/2 along an axis, K = 2 G/a with G = 2 k a_c, a_c = (3 F R*/(4 E*))^(1/3).
#[test]
fn unequal_spheres_conduct_by_their_effective_radius() {
    let (cells, radii) = (3, [RADIUS, 1.3 * RADIUS]);
    let apart = (radii[0] + radii[1]) * (1.0 - OVERLAP);
    let edge = 2.0 / 3f64.sqrt() * apart;
    let spheres = (0..2 * cells * cells * cells).map(|k| {
        let (kind, cell) = (k % 2, k / 2);
        let corner = [cell % cells, cell / cells % cells, cell / cells / cells];
        Sphere::at_rest(corner.map(|c| edge * (c as f64 + 0.5 * kind as f64)), radii[kind], 7850.0)
    });
    let boundary = Boundary::Periodic(Cell::block([edge * cells as f64; 3]));
    let simulation = Simulation::new(material(5e9), spheres.collect(), boundary).unwrap();
    let reduced = radii[0] * radii[1] / (radii[0] + radii[1]);
    let overlap = OVERLAP * (radii[0] + radii[1]);
    let force = 4.0 / 3.0 * effective_modulus(5e9, 0.29) * reduced.sqrt() * overlap.powf(1.5);
    let contact = (0.75 * force * reduced / STEEL.effective_modulus).cbrt();
    let expected = 2.0 * 2.0 * STEEL.conductivity * contact / edge;
    let found = solve(&simulation, &contact_links(&simulation, &STEEL)).network;
    for (row, numbers) in found.iter().enumerate() {
        for (column, number) in numbers.iter().enumerate() {
            let wanted = if row == column { expected } else { 0.0 };
            assert!(((number - wanted) / expected).abs() < 1e-9, "{row} {column}: {number} {expected}");
        }
    }
}

/// The network conducts less than the affine estimate; contacts and gas in one network conduct at least the sum of both,
/// and little more; a stiffer material conducts less, as E^(-1/3).
#[test]
fn random_packing() {
    let packing = Packing {
        spheres: 250,
        seed: 2,
        diameter: 2.0 * RADIUS,
        sizes: None,
        material: material(5e9),
        pressure: 5e4,
        steps: 100_000,
    };
    let simulation = pack(&packing).unwrap().simulation;
    let mut both = contact_links(&simulation, &STEEL);
    let contacts = solve(&simulation, &both);
    let gas = gas_links(&near_pairs(&simulation), AIR.conductivity, |radius| {
        AIR.least_distance(radius, STEEL.conductivity)
    });
    both.extend_from_slice(&gas);
    assert!(gas.len() as f64 > 1.5 * (both.len() - gas.len()) as f64);
    let (gas, both) = (solve(&simulation, &gas), solve(&simulation, &both));
    for found in [contacts, gas, both] {
        let ratio = mean(&found.network) / mean(&found.affine);
        assert!((0.85..1.0).contains(&ratio), "{ratio}");
        for row in 0..3 {
            for column in 0..3 {
                let difference = found.network[row][column] - found.network[column][row];
                assert!(difference.abs() < 1e-8 * mean(&found.network));
            }
        }
    }
    let excess = mean(&both.network) / (mean(&contacts.network) + mean(&gas.network)) - 1.0;
    assert!((0.0..0.03).contains(&excess), "{excess}");
    let stiff = Solid { effective_modulus: 8.0 * STEEL.effective_modulus, ..STEEL };
    let stiff = solve(&simulation, &contact_links(&simulation, &stiff));
    assert!((2.0 * mean(&stiff.network) / mean(&contacts.network) - 1.0).abs() < 1e-9);
}

/// A vacuum, and spheres that do not touch, conduct nothing; a conductance that is no number is told.
#[test]
fn nothing_conducts_nothing() {
    let none = conductivity(&[], 5, 1.0).unwrap();
    assert_eq!(none.network, [[0.0; 3]; 3]);
    let bad = Link { i: 0, j: 1, branch: [1.0, 0.0, 0.0], conductance: f64::NAN };
    assert_eq!(conductivity(&[bad], 5, 1.0), None);
}

/// Spheres that conduct poorly: the pairs of a packing with the factor of the closure conduct what the closed form for its solid fraction
/// says, within the error of the closure.
#[test]
fn pairs_of_poor_spheres_conduct_as_the_closure_says() {
    for (friction, seed) in [(0.0, 3), (0.5, 4)] {
        let material = Material { density: 1.0, friction, ..material(1.0) };
        let packing = Packing {
            spheres: 500,
            seed,
            diameter: 1.0,
            sizes: None,
            material,
            pressure: 1e-6,
            steps: 400_000,
        };
        let packed = pack(&packing).unwrap();
        let phi = packed.averages.solid_fraction;
        for ratio in [2.0, 5.0, 10.0, 20.0] {
            let gas = Gas { conductivity: 1.0, mean_free_path: 0.0, ..AIR };
            let factor = pair_factor(&gas, ratio, 0.5, phi);
            let links = gas_links(&near_pairs(&packed.simulation), factor, |radius| {
                gas.least_distance(radius, ratio)
            });
            let found = mean(&solve(&packed.simulation, &links).network);
            let expected = poor_spheres(phi, ratio);
            let error = closure_error(ratio).max(0.02);
            assert!((found / expected - 1.0).abs() < error, "{friction} {ratio}: {found} {expected}");
        }
        // No closure for good conductors, and no step between both.
        assert_eq!(pair_factor(&AIR, 60.0 * AIR.conductivity, 0.5, phi), 1.0);
        let near = pair_factor(&AIR, 59.9 * AIR.conductivity, 0.5, phi);
        assert!((near - 1.0).abs() < 1e-2, "{near}");
    }
}
