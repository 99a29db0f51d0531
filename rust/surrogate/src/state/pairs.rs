//! Pairs of stops as samples of the rates' fit, states as samples of the readout's, and the composed error.

use super::fit::{Residual, Sample};
use super::rates::{self, EVEN_OUTPUTS, Rates};
use super::readout::CONDUCTIVITY_FLOOR;
use super::training::residual;
use super::variables::{
    ConductivityKind, FABRIC_INDEX, FeatureRanges, POROSITY, PRESSURE, Point, READOUT_INPUTS, Variables,
};
use crate::composition::increment;
use crate::dataset::{Ramp, strain_between};
use crate::kernel::LANES;
use crate::perceptron::{Neurons, Perceptron};
use crate::surrogate::{MAX_STATE, StateLanes};

/// Two stops of a ramp, the later one after the strain.
#[derive(Clone, Copy, Debug)]
pub struct Pair {
    pub from: Point,
    pub to: Point,
    pub strain: f64,
}

impl Pair {
    pub fn jammed(&self) -> bool {
        self.from.jammed && self.to.jammed
    }
}

/// All states of some ramps.
pub fn points(variables: Variables, kind: ConductivityKind, ramps: &[Ramp]) -> Vec<Point> {
    let states = ramps.iter().flat_map(|ramp| &ramp.states);
    states.filter_map(|row| Point::new(variables, kind, row)).collect()
}

/// The packed states, each once.
pub fn packed_points(variables: Variables, kind: ConductivityKind, ramps: &[Ramp]) -> Vec<Point> {
    let packed = ramps.iter().filter(|ramp| ramp.name == "up").flat_map(|ramp| &ramp.states);
    packed.filter(|row| row.stop == 0).filter_map(|row| Point::new(variables, kind, row)).collect()
}

/// Every pair of stops in the order of the ramp whose strains differ.
pub fn pairs(variables: Variables, kind: ConductivityKind, ramps: &[Ramp]) -> Vec<Pair> {
    let mut pairs = Vec::new();
    for ramp in ramps {
        for (i, from) in ramp.states.iter().enumerate() {
            for to in &ramp.states[i + 1..] {
                let strain = strain_between(from, to);
                let ends = (Point::new(variables, kind, from), Point::new(variables, kind, to));
                if let (true, (Some(from), Some(to))) = (strain != 0.0, ends) {
                    pairs.push(Pair { from, to, strain });
                }
            }
        }
    }
    pairs
}

/// Weights of the residuals, all of them errors at the end of a pair: p̃ and q̃ relative to p̃, the others absolute.
/// Relative weights, or Δσ survives while p → 0.
const WEIGHT_POROSITY: f64 = 10.0;
const WEIGHT_FABRIC_INDEX: f64 = 0.5;
/// Added to p̃ in relative errors: below it, the error counts absolutely. That of the loosest packings' p̃.
const PRESSURE_SCALE: f64 = 0.01;

/// Rates without a trained network: scales from the data.
pub fn blank_rates(variables: Variables, hidden: &[usize], pairs: &[Pair], ramps: &[Ramp]) -> Rates {
    let sizes = rates::sizes(variables, hidden);
    let network = Perceptron { weights: vec![0.0; crate::perceptron::weight_count(&sizes)], sizes };
    let (mut offset, mut scale) = ([0.0; MAX_STATE], [1.0; MAX_STATE]);
    let jammed = || pairs.iter().filter(|pair| pair.jammed());
    for column in 0..variables.names().len() {
        let rate = |pair: &Pair| (pair.to.state[column] - pair.from.state[column]) / pair.strain;
        // Weighted with the strain, since small strains are full of noise.
        let mean = |value: &dyn Fn(&Pair) -> f64| {
            let sum = jammed().map(|p| p.strain.abs() * value(p)).fold(0.0, |a, b| a + b);
            sum / jammed().map(|p| p.strain.abs()).fold(f64::MIN_POSITIVE, |a, b| a + b)
        };
        if column == POROSITY || column == PRESSURE {
            offset[column] = mean(&rate);
        }
        let square = |pair: &Pair| (rate(pair) - offset[column]).powi(2);
        scale[column] = mean(&square).sqrt().max(1e-6);
    }
    Rates { network, offset, scale, unjamming_porosity: unjamming_porosity(ramps) }
}

/// Mean porosity at which contraction takes the last stress away, extrapolated from the last jammed stops; 1 when no
/// ramp gets that far.
fn unjamming_porosity(ramps: &[Ramp]) -> f64 {
    let (mut sum, mut count) = (0.0, 0.0);
    for ramp in ramps {
        for three in ramp.states.windows(3) {
            let pressure = |k: usize| three[k].stress_xx + three[k].stress_yy;
            let jammed = three[0].load_bearing && three[1].load_bearing && !three[2].load_bearing;
            if jammed && pressure(0) > pressure(1) {
                let slope = (three[1].porosity - three[0].porosity) / (pressure(0) - pressure(1));
                sum += (three[1].porosity + pressure(1) * slope).min(three[2].porosity);
                count += 1.0;
            }
        }
    }
    if count > 0.0 { sum / count } else { 1.0 }
}

/// Samples of the rates' fit.
pub fn rate_samples(
    variables: Variables,
    ranges: &FeatureRanges,
    rates: &Rates,
    pairs: &[Pair],
) -> Vec<Sample> {
    let strain = ranges.thermal_strain;
    let largest = strain.max.abs().max(strain.min.abs());
    pairs.iter().map(|pair| rate_sample(variables, ranges, rates, pair, largest)).collect()
}

fn rate_sample(
    variables: Variables,
    ranges: &FeatureRanges,
    rates: &Rates,
    pair: &Pair,
    largest_strain: f64,
) -> Sample {
    let state = pair.from.state.map(|value| [value; LANES]);
    let features = ranges.features(variables, &state, &[pair.strain; LANES]);
    let inputs = features.even.map(|lanes| lanes[0]).to_vec();
    let delta = |column: usize| pair.to.state[column] - pair.from.state[column];
    // The error per √|ε|: between the error of the increment, in which large strains rule, and that of the rate, in
    // which the noise of small ones does.
    let share = (largest_strain / pair.strain.abs()).sqrt();
    let relative = share / (pair.to.state[PRESSURE] + PRESSURE_SCALE);
    let even = |output: usize, column: usize, weight: f64| {
        let (by_strain, mean) = (pair.strain * rates.scale[column], pair.strain * rates.offset[column]);
        residual(output, [weight * by_strain, 0.0, 0.0], weight * (delta(column) - mean))
    };
    let mut residuals = vec![even(0, POROSITY, share * WEIGHT_POROSITY)];
    if pair.from.jammed {
        let lowest = -pair.from.state[PRESSURE] - pair.strain * rates.offset[PRESSURE];
        residuals.push(Residual { floor: relative * lowest, ..even(1, PRESSURE, relative) });
    }
    if pair.jammed() {
        let count = variables.odd_count();
        for (k, column) in variables.odd().enumerate() {
            let weight = match column {
                FABRIC_INDEX => share * WEIGHT_FABRIC_INDEX,
                column if Some(column) == variables.deviator() => relative,
                _ => share,
            };
            let c = features.odd.map(|odd| weight * pair.strain * rates.scale[column] * odd[0]);
            residuals.push(residual(EVEN_OUTPUTS + k * count, c, weight * delta(column)));
        }
    }
    Sample { inputs, residuals }
}

/// Offset and scale of the readout's h = √(K/(k √p̃)), which lies between 1 and 1.3.
pub const READOUT_SCALES: (f64, f64) = (1.1, 0.2);

/// Samples of the readout's fit: jammed states, errors of K relative.
pub fn readout_samples(
    variables: Variables,
    carried: bool,
    ranges: &FeatureRanges,
    points: &[Point],
) -> Vec<Sample> {
    let jammed = points.iter().filter(|p| p.jammed && p.conductivity > CONDUCTIVITY_FLOOR);
    jammed.map(|point| readout_sample(variables, carried, ranges, point)).collect()
}

fn readout_sample(variables: Variables, carried: bool, ranges: &FeatureRanges, point: &Point) -> Sample {
    let state = point.state.map(|value| [value; LANES]);
    let features = ranges.features(variables, &state, &[0.0; LANES]);
    let inputs = features.even[..READOUT_INPUTS].iter().map(|lanes| lanes[0]).collect();
    let (offset, scale) = READOUT_SCALES;
    let h = ((point.conductivity - CONDUCTIVITY_FLOOR) / features.root_pressure[0]).sqrt();
    // δK/K = 2 δh/h
    let mut residuals = vec![residual(0, [2.0 * scale / h, 0.0, 0.0], 2.0 * (h - offset) / h)];
    let odd = features.odd.map(|lanes| lanes[0]);
    let mut first = 1;
    if !carried {
        residuals.push(residual(first, odd, point.fabric_conductivity));
        first += variables.odd_count();
    }
    if !variables.stress_deviator {
        residuals.push(residual(first, odd, point.stress_ratio));
    }
    Sample { inputs, residuals }
}

/// A packed state and where its ramp ends, jammed.
pub struct Paths {
    from: Vec<StateLanes>,
    to: Vec<Vec<(Point, f64)>>,
}

/// Paths from the first stop of each ramp to its last jammed one, in blocks.
pub fn paths(variables: Variables, kind: ConductivityKind, ramps: &[Ramp]) -> Paths {
    let path = |ramp: &Ramp| {
        let first = ramp.states.first()?;
        let last = ramp.states.iter().rfind(|row| row.load_bearing && row.stop != first.stop)?;
        let (from, to) = (Point::new(variables, kind, first)?, Point::new(variables, kind, last)?);
        (from.jammed && to.jammed).then_some((from, to, strain_between(first, last)))
    };
    let all: Vec<_> = ramps.iter().filter_map(path).collect();
    let mut paths = Paths { from: Vec::new(), to: Vec::new() };
    for chunk in all.chunks(LANES) {
        let lane_of = |lane: usize| &chunk[lane.min(chunk.len() - 1)].0.state;
        paths.from.push(std::array::from_fn(|k| std::array::from_fn(|lane| lane_of(lane)[k])));
        paths.to.push(chunk.iter().map(|(_, to, strain)| (*to, *strain)).collect());
    }
    paths
}

/// Increments of the composed error: enough that more do not change it.
const INCREMENTS: u32 = 20;

/// Mean square of the weighted errors at the end of the paths, composed.
pub fn composed_error(variables: Variables, ranges: &FeatureRanges, rates: &Rates, paths: &Paths) -> f64 {
    let (mut sum, mut count) = (0.0, 0.0);
    let mut neurons = Neurons::new();
    for (from, ends) in paths.from.iter().zip(&paths.to) {
        let mut state = *from;
        for k in 0..INCREMENTS {
            let strain =
                std::array::from_fn(|lane| ends.get(lane).map_or(0.0, |e| increment(e.1, k, INCREMENTS)));
            let features = ranges.features(variables, &state, &strain);
            state = rates.advanced(variables, &state, &strain, &features, &mut neurons);
        }
        for (lane, (end, _)) in ends.iter().enumerate() {
            let relative = 1.0 / (end.state[PRESSURE] + PRESSURE_SCALE);
            for column in 0..variables.names().len() {
                let weight = match column {
                    POROSITY => WEIGHT_POROSITY,
                    FABRIC_INDEX => WEIGHT_FABRIC_INDEX,
                    PRESSURE => relative,
                    column if Some(column) == variables.deviator() => relative,
                    _ => 1.0,
                };
                sum += (weight * (state[column][lane] - end.state[column])).powi(2);
                count += 1.0;
            }
        }
    }
    if count > 0.0 { sum / count } else { 0.0 }
}
