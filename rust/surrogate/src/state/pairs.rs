//! Samples for the fits: pairs of stops for the rates, single states for the readout, and whole ramps for the composed
//! error.

use super::fit::{Residual, Sample, TERMS, residual};
use super::rates::{self, EVEN_OUTPUTS, Rates, direction};
use super::readout::CONDUCTIVITY_FLOOR;
use super::variables::{FABRIC_INDEX, FeatureRanges, POROSITY, PRESSURE, Point, READOUT_INPUTS, Variables};
use crate::composition::increment;
use crate::dataset::{ConductivityKind, Ramp, strain_between};
use crate::kernel::LANES;
use crate::perceptron::Perceptron;
use crate::surrogate::MAX_STATE;

/// Two stops of a ramp, and the strain from the first to the second.
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

/// All states of the ramps in the variables of the model.
pub fn points(variables: Variables, kind: ConductivityKind, ramps: &[Ramp]) -> Vec<Point> {
    let states = ramps.iter().flat_map(|ramp| &ramp.states);
    states.filter_map(|row| Point::new(variables, kind, row)).collect()
}

/// The packed states, each only once.
pub fn packed_points(variables: Variables, kind: ConductivityKind, ramps: &[Ramp]) -> Vec<Point> {
    let packed = ramps.iter().filter(|ramp| ramp.name == "up").flat_map(|ramp| &ramp.states);
    packed.filter(|row| row.stop == 0).filter_map(|row| Point::new(variables, kind, row)).collect()
}

/// Every pair of stops of a ramp, in its order, whose strains differ.
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
/// Added to p̃ in relative errors, so that for much smaller pressures the error counts absolutely. It is about p̃ of
/// the loosest packings.
const PRESSURE_SCALE: f64 = 0.01;

/// Rates whose network is not trained yet, with scales from the data.
pub fn blank_rates(variables: Variables, hidden: &[usize], pairs: &[Pair], ramps: &[Ramp]) -> Rates {
    let sizes = rates::sizes(variables, hidden);
    let network = Perceptron { weights: vec![0.0; crate::perceptron::weight_count(&sizes)], sizes };
    let (mut offset, mut scale) = ([0.0; rates::STORED], [1.0; rates::STORED]);
    let jammed = || pairs.iter().filter(|pair| pair.jammed());
    for column in 0..variables.names().len() {
        let rate = |pair: &Pair| (pair.to.state[column] - pair.from.state[column]) / pair.strain;
        // Weighted with the strain, since small strains have much noise.
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

/// Mean porosity at which contraction removes the last stress, extrapolated from the last jammed stops; 1 when no ramp
/// reaches that.
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
    // The error is divided by √|ε|: between the error of the increment, in which large strains would dominate, and the
    // error of the rate, in which the noise of small strains would dominate.
    let share = (largest_strain / pair.strain.abs()).sqrt();
    let relative = share / (pair.to.state[PRESSURE] + PRESSURE_SCALE);
    let even = |output: usize, column: usize, weight: f64| {
        let (by_strain, mean) = (pair.strain * rates.scale[column], pair.strain * rates.offset[column]);
        residual(output, [weight * by_strain, 0.0, 0.0, 0.0], weight * (delta(column) - mean))
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
            let by_output = weight * pair.strain * rates.scale[column];
            let mut c = [0.0; TERMS];
            (0..count).for_each(|i| c[i] = by_output * features.odd[i][0]);
            c[count] = by_output * direction(pair.strain) * features.odd[k][0];
            residuals.push(residual(EVEN_OUTPUTS + k * (count + 1), c, weight * delta(column)));
        }
    }
    Sample { inputs, residuals }
}

/// Offset and scale of h = √(K/(k √p̃)), the output of the readout, which lies between 1 and 1.3.
pub const READOUT_SCALES: (f64, f64) = (1.1, 0.2);

/// Samples of the readout's fit: jammed states, with relative errors of K.
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
    let mut residuals = vec![residual(0, [2.0 * scale / h, 0.0, 0.0, 0.0], 2.0 * (h - offset) / h)];
    let odd = [features.odd[0][0], features.odd[1][0], features.odd[2][0], 0.0];
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

/// A ramp as a solver would follow it: a start, and stops one after the other.
#[derive(Clone, Debug)]
pub struct Track {
    pub start: [f64; MAX_STATE],
    pub stops: Vec<Stop>,
}

/// A stop of a track and the strain from the stop before.
#[derive(Clone, Copy, Debug)]
pub struct Stop {
    pub to: Point,
    pub strain: f64,
}

/// Largest increment on a track; smaller ones would not change the composed error.
const LARGEST_INCREMENT: f64 = 0.0025;

impl Stop {
    /// Increments that compose to the strain.
    pub fn increments(&self) -> impl Iterator<Item = f64> {
        let (strain, count) = (self.strain, (self.strain.abs() / LARGEST_INCREMENT).ceil().max(1.0) as u32);
        (0..count).map(move |k| increment(strain, k, count))
    }
}

/// Tracks along each ramp, both from its start and from its middle, up to the first stop without stress.
pub fn tracks(variables: Variables, kind: ConductivityKind, ramps: &[Ramp]) -> Vec<Track> {
    let track = |ramp: &Ramp, first: usize| {
        let start = Point::new(variables, kind, ramp.states.get(first)?)?;
        let mut stops = Vec::new();
        for pair in ramp.states[first..].windows(2) {
            let to = Point::new(variables, kind, &pair[1])?;
            stops.push(Stop { to, strain: strain_between(&pair[0], &pair[1]) });
            if !to.jammed {
                break;
            }
        }
        (start.jammed && !stops.is_empty()).then_some(Track { start: start.state, stops })
    };
    let firsts = |ramp: &'_ Ramp| [0, ramp.states.len() / 2];
    ramps.iter().flat_map(|ramp| firsts(ramp).into_iter().filter_map(move |f| track(ramp, f))).collect()
}

/// Weight of the error of a state column at the end of a path.
pub fn end_weight(variables: Variables, column: usize, end: &Point) -> f64 {
    let relative = 1.0 / (end.state[PRESSURE] + PRESSURE_SCALE);
    match column {
        POROSITY => WEIGHT_POROSITY,
        FABRIC_INDEX => WEIGHT_FABRIC_INDEX,
        PRESSURE => relative,
        column if Some(column) == variables.deviator() => relative,
        _ => 1.0,
    }
}
