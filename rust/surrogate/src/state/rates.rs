//! Advance of the state with the strain: Δx = ε · g(x, ε).

use super::variables::{FABRIC_INDEX, Features, MAX_ODD, POROSITY, PRESSURE, RATE_INPUTS, Variables};
use crate::kernel::vector::Vector;
use crate::kernel::{Lanes, Task, all_layers, dispatch};
use crate::perceptron::{Neurons, Perceptron};
use crate::surrogate::StateLanes;
use serde::{Deserialize, Serialize};

/// The rates' network and its scales.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Rates {
    /// Its inputs are the even features. Its outputs are the rates of η and p̃; then for each odd variable the
    /// coefficients of the odd features in its rate, and a coefficient of its own feature times the sign of the strain.
    pub network: Perceptron,
    /// Rate dx/dε of each state column [-] at output 0; not zero only for even variables.
    pub offset: [f64; STORED],
    /// Rate dx/dε of each state column [-] per unit of output.
    pub scale: [f64; STORED],
    /// η above which a state without stress remains without, whatever the strain [-].
    pub unjamming_porosity: f64,
}

/// Number of state columns in the files of models.
pub const STORED: usize = 6;
/// Upper limit of |f|, |f_K| and η in composed states; no state of grains has larger values.
const FABRIC_LIMIT: f64 = 0.9;
const POROSITY_LIMIT: f64 = 0.99;

/// Number of outputs of the network that belong to even variables; they come first.
pub const EVEN_OUTPUTS: usize = 2;

/// Layer sizes of the rates' network.
pub fn sizes(variables: Variables, hidden: &[usize]) -> Vec<usize> {
    let odd = variables.odd_count();
    [&[RATE_INPUTS], hidden, &[EVEN_OUTPUTS + odd * (odd + 1)]].concat()
}

/// State and strain at the start of a step.
pub struct RateInputs<'a> {
    pub variables: Variables,
    pub state: &'a StateLanes,
    /// Thermal strain [-].
    pub strain: &'a Lanes,
    /// Share of the strain that is virgin [0 to 1], see [`direction`].
    pub virgin: &'a Lanes,
    pub features: &'a Features,
}

struct Advance<'a> {
    rates: &'a Rates,
    from: RateInputs<'a>,
    neurons: &'a mut Neurons,
    next: &'a mut StateLanes,
}

impl Task for Advance<'_> {
    #[inline(always)]
    fn run<V: Vector>(self) {
        let Self { rates, from, neurons, next } = self;
        let Perceptron { sizes, weights } = &rates.network;
        neurons.layers[0][..from.features.even.len()].copy_from_slice(&from.features.even);
        all_layers::<V>(sizes, weights, &mut neurons.layers);
        rates.advanced::<V>(&from, &neurons.layers[sizes.len() - 1], next);
    }
}

impl Rates {
    /// Advances a block of states as [`Rates::advanced`] does; `neurons` then holds the values of all neurons.
    pub fn advance(&self, from: RateInputs<'_>, neurons: &mut Neurons, next: &mut StateLanes) {
        dispatch(Advance { rates: self, from, neurons, next });
    }

    /// The state after a strain, written to the model's columns of `next`; `outputs` are the network's outputs for the
    /// features.
    #[inline(always)]
    pub fn advanced<V: Vector>(&self, from: &RateInputs, outputs: &[Lanes], next: &mut StateLanes) {
        let RateInputs { variables, state, features, .. } = *from;
        let strain = V::read(from.strain);
        for (output, column) in [POROSITY, PRESSURE].into_iter().enumerate() {
            let (offset, scale) = (V::all(self.offset[column]), V::all(self.scale[column]));
            let rate = V::read(&outputs[output]).fused(scale, offset);
            strain.fused(rate, V::read(&state[column])).write(&mut next[column]);
        }
        let count = variables.odd_count();
        let direction = strain.where_greater(
            V::zero(),
            V::all(1.0),
            V::zero().where_greater(strain, V::all(-1.0), V::zero()),
        ) * V::read(from.virgin);
        for (k, column) in variables.odd().enumerate() {
            let own = &outputs[EVEN_OUTPUTS + k * (count + 1)..][..count + 1];
            let sum = odd_sum::<V>(&own[..count], &features.odd);
            let rate = (direction * V::read(&own[count])).fused(V::read(&features.odd[k]), sum);
            let rate = rate * V::all(self.scale[column]);
            strain.fused(rate, V::read(&state[column])).write(&mut next[column]);
        }
        self.limit::<V>(variables, state, next);
    }

    /// Limits the state to values that grains can have: 0 ≤ η < 1, p̃ ≥ 0, no tension, and no stress before the grains
    /// touch.
    #[inline(always)]
    fn limit<V: Vector>(&self, variables: Variables, state: &StateLanes, next: &mut StateLanes) {
        let zero = V::zero();
        let porosity = V::read(&next[POROSITY]).within(zero, V::all(POROSITY_LIMIT));
        porosity.write(&mut next[POROSITY]);
        let allowed = V::read(&next[PRESSURE]).at_least(zero);
        let touching = V::all(self.unjamming_porosity).where_greater(porosity, allowed, zero);
        let pressure = V::read(&state[PRESSURE]).where_greater(zero, allowed, touching);
        pressure.write(&mut next[PRESSURE]);
        for column in std::iter::once(FABRIC_INDEX).chain(variables.fabric_conductivity()) {
            // Without contacts the fabric does not change.
            let (new, old) = (V::read(&next[column]), V::read(&state[column]));
            let value = pressure.where_greater(zero, new, old);
            value.within(V::all(-FABRIC_LIMIT), V::all(FABRIC_LIMIT)).write(&mut next[column]);
        }
        if let Some(column) = variables.deviator() {
            V::read(&next[column]).within(zero - pressure, pressure).write(&mut next[column]);
        }
    }
}

/// Sign of the strain, 0 for zero strain. It is needed because sliding contacts do not slide back: in the data, the
/// deviator decreases on contraction much faster than it increases on expansion, whatever the size of the increments,
/// and a rate that is smooth in ε cannot give both. The rates of η and p̃ do not contain the sign: they are reversible,
/// and do not drift under small strains to and fro.
///
/// This holds for virgin strains, which lead beyond all strains that the grains have experienced before. When they are
/// strained back, or again as far as before, the contacts that slid have come to rest. Without the sign on such
/// strains, the error of K on the database's ramps back from +5 % is smaller by a third (`msdd score`), and cycles do
/// not drift. The fit treats all ramps as virgin; treating the ways back as not virgin in the fit gives no better model
/// (see the README).
#[inline(always)]
pub fn direction(strain: f64) -> f64 {
    if strain > 0.0 {
        1.0
    } else if strain < 0.0 {
        -1.0
    } else {
        0.0
    }
}

/// Σ y_i b_i over the odd features b_i.
#[inline(always)]
pub fn odd_sum<V: Vector>(coefficients: &[Lanes], odd: &[Lanes; MAX_ODD]) -> V {
    let mut sum = V::zero();
    for (y, b) in coefficients.iter().zip(odd) {
        sum = V::read(y).fused(V::read(b), sum);
    }
    sum
}
