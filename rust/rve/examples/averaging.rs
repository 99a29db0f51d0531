//! Which averaging region makes RVEs agree with windows of a large assembly?
//!
//! `cargo run --release -p msdd-rve --example averaging -- SEEDS LARGE.json...` packs RVEs of 500 discs by horizontal
//! compression, and expands and contracts them and the large assemblies by 1 %. For each kind of region it fits the
//! averages of the RVEs linearly in the state, and compares the fits with windows of 43 mean radii (215 mm) of the
//! large assemblies.

use msdd_rve::region::{Polygon, region};
use msdd_rve::{
    Averages, Compression, Cut, Material, PackingSpec, Protocol, RegionKind, Simulation, Strains, follow,
    homogenise_in, pack, state, window,
};
use nalgebra::{DMatrix, DVector};

const STRAINS: [f64; 3] = [-0.01, 0.0, 0.01];
const TARGETS: [f64; 6] = [0.115, 0.12, 0.125, 0.13, 0.135, 0.14];
const WINDOW: f64 = 43.0;

/// A region of an RVE: a name, and the averages over it.
type Region = (&'static str, fn(&Simulation) -> Averages);

const REGIONS: [Region; 6] = [
    ("hull, clip", |s| homogenise_in(s, &region(s, RegionKind::Hull), Cut::Clip)),
    ("hull, whole", |s| homogenise_in(s, &region(s, RegionKind::Hull), Cut::Whole)),
    ("inset 0.8 r, clip", |s| homogenise_in(s, &region(s, RegionKind::Inset), Cut::Clip)),
    ("inset 0.8 r, whole", |s| homogenise_in(s, &region(s, RegionKind::Inset), Cut::Whole)),
    ("inset 2 r, clip", |s| homogenise_in(s, &inset(s, 2.0), Cut::Clip)),
    ("inset 4 r, clip", |s| homogenise_in(s, &inset(s, 4.0), Cut::Clip)),
];

/// A quantity that is compared: name, value, and the scale to which its errors are relative.
type Quantity = (&'static str, fn(&Averages) -> f64, fn(&Averages) -> f64);

const QUANTITIES: [Quantity; 7] = [
    ("K affine, mean", mean_affine, mean_affine),
    ("K affine, deviator", |a| 0.5 * (a.conductivity_xx - a.conductivity_yy), mean_affine),
    ("K network, mean", mean_network, mean_network),
    ("K network, deviator", |a| 0.5 * (a.conductivity_network_xx - a.conductivity_network_yy), mean_network),
    ("p", |a| a.pressure, |a| a.pressure),
    ("stress deviator", |a| 0.5 * (a.stress_xx - a.stress_yy), |a| a.pressure),
    ("coordination", |a| a.coordination, |a| a.coordination),
];

fn mean_affine(a: &Averages) -> f64 {
    0.5 * (a.conductivity_xx + a.conductivity_yy)
}

fn mean_network(a: &Averages) -> f64 {
    0.5 * (a.conductivity_network_xx + a.conductivity_network_yy)
}

fn inset(simulation: &Simulation, radii: f64) -> Polygon {
    let [left, right, bottom, top] = simulation.walls.position;
    let d = radii * simulation.mean_radius();
    Polygon::rectangle([left + d, bottom + d], [right - d, top - d])
}

/// The assembly at each of STRAINS, reached from the given state.
fn strained(start: &Simulation) -> Vec<Simulation> {
    let reached = STRAINS.map(|strain| {
        let mut simulation = start.clone();
        if strain != 0.0 {
            let ramp = follow(&mut simulation, &[Strains::thermal(strain)], Protocol::default(), |_, _| ());
            assert!(ramp.expect("allowed strain").failure.is_none(), "ramp to {strain} failed");
        }
        simulation
    });
    reached.into()
}

/// Windows that fill the inner part of the box; none touches a wall.
fn inner_windows(simulation: &Simulation) -> Vec<Averages> {
    let size = WINDOW * simulation.mean_radius();
    let walls = &simulation.walls;
    let counts = [walls.width(), walls.height()].map(|length| ((length / size - 0.1) as usize).max(1));
    let centre = [0, 2].map(|k| 0.5 * (walls.position[k] + walls.position[k + 1]));
    let low = |k: usize, axis: usize| centre[axis] + (k as f64 - 0.5 * counts[axis] as f64) * size;
    let places = (0..counts[1]).flat_map(|l| (0..counts[0]).map(move |k| [low(k, 0), low(l, 1)]));
    places.map(|[x, y]| window(simulation, [x, y], [x + size, y + size]).averages).collect()
}

fn rve(seed: u64, porosity: f64) -> Vec<Simulation> {
    let compression = Compression::Horizontal;
    let spec = PackingSpec { discs: 500, seed, porosity, compression, ..PackingSpec::default() };
    strained(&pack(&spec, &Material::default()).expect("RVE packs").simulation)
}

/// The variables in which a quantity is fitted: K in (η, f, √p), stress and coordination in (η, f).
fn features(name: &str, a: &Averages) -> Vec<f64> {
    let mut features = vec![1.0, a.porosity, a.fabric_index];
    if name.starts_with('K') {
        features.push(a.pressure.max(0.0).sqrt());
    }
    features
}

/// Coefficients of the least-squares fit of `values` by `rows` of features.
fn least_squares(rows: &[Vec<f64>], values: &[f64]) -> DVector<f64> {
    let matrix = DMatrix::from_fn(rows.len(), rows[0].len(), |r, c| rows[r][c]);
    let values = DVector::from_column_slice(values);
    matrix.svd(true, true).solve(&values, 1e-12).expect("both factors were computed")
}

fn mean_and_deviation(values: &[f64]) -> (f64, f64) {
    let mean = values.iter().sum::<f64>() / values.len() as f64;
    let square = values.iter().map(|v| (v - mean) * (v - mean)).sum::<f64>() / values.len() as f64;
    (mean, square.sqrt())
}

/// Fitted over true value less one [%] for each sample, with one fit per strain.
fn errors(quantity: Quantity, from: &[Vec<Averages>], at: &[Vec<Averages>]) -> Vec<f64> {
    let (name, value, scale) = quantity;
    let mut list = Vec::new();
    for (samples, points) in from.iter().zip(at) {
        let rows: Vec<Vec<f64>> = samples.iter().map(|a| features(name, a)).collect();
        let coefficients = least_squares(&rows, &samples.iter().map(value).collect::<Vec<f64>>());
        let expected = |a: &Averages| coefficients.dot(&DVector::from_vec(features(name, a)));
        list.extend(points.iter().map(|a| 100.0 * (expected(a) - value(a)) / scale(a)));
    }
    list
}

/// Normal force on the walls per length, mean of the two directions [Pa].
fn wall_pressure(simulation: &Simulation) -> f64 {
    let (mut sum, walls) = (0.0, &simulation.walls);
    simulation.for_each_contact(|contact| {
        if contact.i.is_err() {
            let length = if contact.normal[0] != 0.0 { walls.height() } else { walls.width() };
            sum += 0.25 * contact.normal_force() / length;
        }
    });
    sum
}

/// Scatter of the change of porosity about its linear fit in the state before the strain [% of the mean change].
fn increment_noise(before: &[Averages], after: &[Averages]) -> f64 {
    let change: Vec<f64> = before.iter().zip(after).map(|(a, b)| b.porosity - a.porosity).collect();
    let rows: Vec<Vec<f64>> = before.iter().map(|a| features("K", a)).collect();
    let coefficients = least_squares(&rows, &change);
    let residuals: Vec<f64> = rows
        .iter()
        .zip(&change)
        .map(|(row, value)| coefficients.dot(&DVector::from_vec(row.clone())) - value)
        .collect();
    100.0 * mean_and_deviation(&residuals).1 / mean_and_deviation(&change).0.abs()
}

fn describe(name: &str, samples: &[Vec<Averages>]) {
    for (strain, list) in STRAINS.iter().zip(samples) {
        let column = |field: fn(&Averages) -> f64| {
            let (mean, deviation) = mean_and_deviation(&list.iter().map(field).collect::<Vec<_>>());
            format!("{mean:.4} ({deviation:.4})")
        };
        println!(
            "{name:>20} {strain:+}: {} samples, porosity {}, f {}, p {}, K affine {}, network {}",
            list.len(),
            column(|a| a.porosity),
            column(|a| a.fabric_index),
            column(|a| a.pressure),
            column(mean_affine),
            column(mean_network),
        );
    }
}

fn main() {
    let mut arguments = std::env::args().skip(1);
    let seeds: u64 = arguments.next().and_then(|n| n.parse().ok()).expect("a number of seeds");
    let mut windows = vec![Vec::new(); STRAINS.len()];
    let mut beside_walls = Vec::new();
    for file in arguments {
        let large = state::from_json(&std::fs::read_to_string(file).expect("readable")).expect("a state");
        for (list, state) in windows.iter_mut().zip(strained(&large)) {
            let inner = inner_windows(&state);
            let (pressure, _) = mean_and_deviation(&inner.iter().map(|a| a.pressure).collect::<Vec<f64>>());
            beside_walls.push(100.0 * (pressure / wall_pressure(&state) - 1.0));
            list.extend(inner);
        }
    }
    assert!(!windows[0].is_empty(), "name state files of large assemblies");
    describe("windows", &windows);
    let (bias, scatter) = mean_and_deviation(&beside_walls);
    println!("windows: p less the force on the walls {bias:+.2} % ({scatter:.2} %)");
    let rves: Vec<Vec<Simulation>> =
        TARGETS.iter().flat_map(|&target| (1..=seeds).map(move |seed| rve(seed, target))).collect();
    println!("\n| region | quantity | bias % | scatter % | among RVEs % |\n|---|---|---|---|---|");
    for (name, average) in REGIONS {
        let of_strain = |k: usize| rves.iter().map(|states| average(&states[k])).collect();
        let samples: Vec<Vec<Averages>> = (0..STRAINS.len()).map(of_strain).collect();
        for quantity in QUANTITIES {
            let (bias, scatter) = mean_and_deviation(&errors(quantity, &samples, &windows));
            let (_, own) = mean_and_deviation(&errors(quantity, &samples, &samples));
            println!("| {name} | {} | {bias:+.2} | {scatter:.2} | {own:.2} |", quantity.0);
        }
        let at_walls = rves.iter().flatten().map(|s| 100.0 * (average(s).pressure / wall_pressure(s) - 1.0));
        let (bias, scatter) = mean_and_deviation(&at_walls.collect::<Vec<f64>>());
        println!("| {name} | p less the force on the walls | {bias:+.2} | {scatter:.2} | |");
        let increments = [1, 2].map(|k| increment_noise(&samples[k - 1], &samples[k]));
        println!(
            "| {name} | increments of porosity over 1 % | | | {:.2} {:.2} |",
            increments[0], increments[1]
        );
    }
}
