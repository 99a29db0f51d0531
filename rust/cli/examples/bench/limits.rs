//! `bench limits`: how slowly RVEs have to be packed and strained, and how well models follow them as contacts open.

use clap::Args;
use msdd_cli::shared::CliError;
use msdd_files::{read_text, write};
use msdd_rve::settle::{Outcome, UNBALANCED_LIMIT};
use msdd_rve::{
    Averages, Boundary, Compression, Material, Packed, PackingSpec, Preparation, Protocol, RegionKind, Stop,
    Strains, follow, pack_as,
};
use msdd_surrogate::models;
use msdd_surrogate::surrogate::{InitialData, Surrogate};
use serde_json::{Value, json};
use std::path::{Path, PathBuf};

#[derive(Args)]
#[command(
    after_help = "Periodic boxes of 500 discs, compressed along x to a porosity of 0.13. Strain rates, and limits of the \
unbalanced force at which a state counts as equilibrium: difference of the pressure from the same packing at the lowest \
rate and limit, mean and rms over the packings [%]. Wall speeds during packing: pressure and porosity in equilibrium, mean and \
standard deviation. Unjamming: states of a contraction until hardly any contact is left, compared with models that start from the \
packed state and take 200 increments to each of these states."
)]
pub struct Arguments {
    /// Packings to average over.
    #[arg(long, default_value_t = 8, value_parser = clap::value_parser!(u64).range(1..=1000))]
    packings: u64,
    /// Model file to compare with DEM while contacts open; may be given several times.
    #[arg(long, value_name = "FILE")]
    model: Vec<PathBuf>,
    /// JSON file to write. Default: the results are printed.
    #[arg(long, value_name = "FILE")]
    out: Option<PathBuf>,
}

const POROSITY: f64 = 0.13;
const STRAINS: [f64; 2] = [0.02, -0.02];
/// Strain rates [1/s], slowest first.
const RATES: [f64; 7] = [2e-3, 0.01, 0.02, 0.1, 0.5, 2.0, 10.0];
/// Limits of the unbalanced force at which a state counts as equilibrium: mean resultant force on a grain over mean
/// contact force [-], strictest first.
const BALANCES: [f64; 6] = [1e-6, 1e-5, UNBALANCED_LIMIT, 1e-3, 1e-2, 1e-1];
/// Wall speeds during packing [m/s].
const SPEEDS: [f64; 6] = [0.01, 0.03, 0.05, 0.2, 1.0, 3.0];
/// States of the contraction; at the last of them hardly any contact is left.
const STOPS: usize = 20;
const STOP: f64 = -0.005;
/// Increments that a model takes between two stops. A stop is a strain at which the grains come to equilibrium and are
/// averaged.
const INCREMENTS: usize = 200;

pub fn run(arguments: &Arguments) -> Result<(), CliError> {
    let models = arguments.model.iter().map(|file| read_model(file)).collect::<Result<Vec<_>, CliError>>()?;
    let count = arguments.packings;
    let (mut rates, mut balances, mut speeds, mut unjamming) = (vec![], vec![], vec![], vec![]);
    for seed in 1..=count {
        speeds.push(SPEEDS.map(|speed| packed(seed, Some(speed))));
        let packing = packed(seed, None)?;
        rates.push(by_rate(&packing)?);
        balances.push(by_balance(&packing)?);
        unjamming.push(unjammed(&packing, &models)?);
    }
    let names: Vec<&str> = models.iter().map(|model| model.name()).collect();
    let result = json!({
        "packings": count,
        "ramp_rate": against_first(&rates, &RATES, "rate"),
        "balance": against_first(&balances, &BALANCES, "unbalanced"),
        "wall_speed": speed_rows(&speeds),
        "unjamming": unjamming_rows(&unjamming, &names),
    });
    let text = serde_json::to_string_pretty(&result).map_err(|e| CliError::Message(e.to_string()))?;
    match &arguments.out {
        Some(file) => write(file, text.as_bytes())?,
        None => println!("{text}"),
    }
    Ok(())
}

fn read_model(file: &Path) -> Result<Box<dyn Surrogate>, CliError> {
    models::read(&read_text(file)?).map_err(|source| CliError::Model { file: file.to_path_buf(), source })
}

fn packed(seed: u64, wall_speed: Option<f64>) -> Result<Packed, CliError> {
    let spec = PackingSpec {
        seed,
        porosity: POROSITY,
        compression: Compression::Horizontal,
        boundary: Boundary::Periodic,
        ..PackingSpec::default()
    };
    let preparation = Preparation { wall_speed, ..Preparation::default() };
    Ok(pack_as(&spec, &preparation, &Material::default())?)
}

/// Strains a copy of a packing, and returns its state in equilibrium.
fn strained(packing: &Packed, strain: f64, protocol: Protocol) -> Result<Stop, CliError> {
    let mut simulation = packing.simulation.clone();
    let mut ramp = follow(&mut simulation, &[Strains::thermal(strain)], protocol, |_, _| ())?;
    match ramp.failure {
        Some(failure) => Err(failure.into()),
        None => ramp.stops.pop().ok_or_else(|| CliError::Message("a ramp without a stop".to_string())),
    }
}

/// Per strain and rate: pressure [Pa], and whether equilibrium was reached.
type Measured = Vec<Vec<(f64, bool)>>;

fn measured(
    packing: &Packed,
    values: &[f64],
    protocol: impl Fn(f64) -> Protocol,
) -> Result<Measured, CliError> {
    let one = |strain: f64, value: f64| {
        let stop = strained(packing, strain, protocol(value))?;
        Ok((stop.averages.pressure, stop.settled.outcome == Outcome::Settled))
    };
    STRAINS.iter().map(|&strain| values.iter().map(|&value| one(strain, value)).collect()).collect()
}

fn by_rate(packing: &Packed) -> Result<Measured, CliError> {
    let protocol = |rate| Protocol {
        expansion_rate: rate,
        contraction_rate: rate,
        unbalanced_limit: 1e-5,
        ..Protocol::default()
    };
    measured(packing, &RATES, protocol)
}

fn by_balance(packing: &Packed) -> Result<Measured, CliError> {
    measured(packing, &BALANCES, |limit| Protocol { unbalanced_limit: limit, ..Protocol::default() })
}

/// Relative differences from the first value: mean and rms over the packings [%].
fn against_first(packings: &[Measured], values: &[f64], key: &str) -> Vec<Value> {
    let mut rows = Vec::new();
    for (s, strain) in STRAINS.iter().enumerate() {
        for (v, value) in values.iter().enumerate() {
            let errors: Vec<f64> = packings.iter().map(|p| 100.0 * (p[s][v].0 / p[s][0].0 - 1.0)).collect();
            rows.push(json!({
                "strain": strain,
                key: value,
                "pressure_mean": mean(&errors),
                "pressure_rms": mean(&errors.iter().map(|e| e * e).collect::<Vec<_>>()).sqrt(),
                "not_settled": packings.iter().filter(|p| !p[s][v].1).count(),
            }));
        }
    }
    rows
}

fn mean(values: &[f64]) -> f64 {
    values.iter().sum::<f64>() / values.len() as f64
}

fn deviation(values: &[f64]) -> f64 {
    let middle = mean(values);
    mean(&values.iter().map(|v| (v - middle).powi(2)).collect::<Vec<_>>()).sqrt()
}

/// Results for each wall speed. A packing that fails at a speed is counted, and does not end the program.
fn speed_rows(packings: &[[Result<Packed, CliError>; SPEEDS.len()]]) -> Vec<Value> {
    let row = |(k, speed): (usize, &f64)| {
        let all: Vec<Averages> = packings.iter().filter_map(|p| p[k].as_ref().ok()).map(averages).collect();
        let column = |of: fn(&Averages) -> f64| all.iter().map(of).collect::<Vec<f64>>();
        let (pressures, porosities, fabrics) =
            (column(|a| a.pressure), column(|a| a.porosity), column(|a| a.fabric_index));
        json!({
            "speed": speed,
            "failed": packings.len() - all.len(),
            "pressure": [mean(&pressures), deviation(&pressures)],
            "porosity": [mean(&porosities), deviation(&porosities)],
            "fabric_index": [mean(&fabrics), deviation(&fabrics)],
        })
    };
    SPEEDS.iter().enumerate().map(row).collect()
}

fn averages(packing: &Packed) -> Averages {
    msdd_rve::homogenise(&packing.simulation, RegionKind::default())
}

/// K/k (mean of xx and yy, resistor network solved) and pressure [Pa], of DEM and of each model.
type Point = Vec<[f64; 2]>;

/// Contracts a packing from the packed state, stop by stop, by DEM and by the models.
fn unjammed(packing: &Packed, models: &[Box<dyn Surrogate>]) -> Result<Vec<Point>, CliError> {
    let start = averages(packing);
    let path: Vec<Strains> = (1..=STOPS).map(|k| Strains::thermal(STOP * k as f64)).collect();
    let mut simulation = packing.simulation.clone();
    let ramp = follow(&mut simulation, &path, Protocol::default(), |_, _| ())?;
    let mut points: Vec<Point> = vec![vec![of_elements(&start)]];
    points.extend(ramp.stops.iter().map(|stop| vec![of_elements(&stop.averages)]));
    for model in models {
        for (point, value) in points.iter_mut().zip(composed(model.as_ref(), &start)) {
            point.push(value);
        }
    }
    Ok(points)
}

fn of_elements(a: &Averages) -> [f64; 2] {
    [0.5 * (a.conductivity_network_xx + a.conductivity_network_yy), a.pressure]
}

/// Results of a model at the stops of the contraction, from the averages of the packed state on.
fn composed(model: &dyn Surrogate, start: &Averages) -> Vec<[f64; 2]> {
    let unit = |radius: f64| Material::default().young_modulus * radius;
    let reduced =
        [start.stress_xx, start.stress_yy, start.stress_xy].map(|stress| stress / unit(start.mean_radius));
    let known = InitialData {
        porosity: start.porosity,
        fabric_index: start.fabric_index,
        fabric_xy: start.fabric_xy,
        reduced_stress: Some(reduced),
        conductivity: None,
    };
    let mut state = model.initial_state(&known);
    let mut answer = model.evaluate(&state, 0.0);
    let mut points = Vec::new();
    for stop in 0..=STOPS {
        for step in 0..if stop == 0 { 0 } else { INCREMENTS } {
            let total = |step: usize| 1.0 + STOP * (stop as f64 - 1.0 + step as f64 / INCREMENTS as f64);
            answer = model.evaluate(&state, total(step + 1) / total(step) - 1.0);
            state = answer.state.map(|lanes| lanes[0]);
        }
        let radius = start.mean_radius * (1.0 + STOP * stop as f64);
        let half_sum = |[xx, yy, _]: [f64; 3]| 0.5 * (xx + yy);
        points.push([
            half_sum(answer.conductivity.map(|lanes| lanes[0])),
            unit(radius) * half_sum(answer.stress.map(|lanes| lanes[0])),
        ]);
    }
    points
}

fn unjamming_rows(packings: &[Vec<Point>], models: &[&str]) -> Vec<Value> {
    let names: Vec<&str> = [&["DEM"], models].concat();
    let reached = packings.iter().map(Vec::len).min().unwrap_or(0);
    let row = |stop: usize| {
        let of = |who: usize, what: usize| -> f64 {
            mean(&packings.iter().map(|points| points[stop][who][what]).collect::<Vec<f64>>())
        };
        let entry = |(who, name): (usize, &&str)| {
            (name.to_string(), json!({ "conductivity": of(who, 0), "pressure": of(who, 1) }))
        };
        let all: serde_json::Map<String, Value> = names.iter().enumerate().map(entry).collect();
        json!({ "strain": STOP * stop as f64, "by": all })
    };
    (0..reached).map(row).collect()
}
