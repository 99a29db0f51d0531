//! Advance of the state: Δx = ε · g(x, ε).

use super::variables::{FABRIC_INDEX, Features, MAX_ODD, POROSITY, PRESSURE, RATE_INPUTS, Variables};
use crate::kernel::vector::Vector;
use crate::kernel::{Lanes, Task, all_layers, dispatch};
use crate::perceptron::{Neurons, Perceptron};
use crate::surrogate::{MAX_STATE, StateLanes};
use serde::{Deserialize, Serialize};

/// The rates' network and its scales.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Rates {
    /// Even features in; outputs: rates of η and p̃, then for each odd variable its rate's coefficients of the odd
    /// features, and one of its own feature times the strain's sign.
    pub network: Perceptron,
    /// Rate dx/dε of each state column [-] at output 0: nonzero for the even ones.
    pub offset: [f64; MAX_STATE],
    /// Rate dx/dε of each state column [-] for a unit of output.
    pub scale: [f64; MAX_STATE],
    /// η above which a state without stress stays without, however it is strained [-].
    pub unjamming_porosity: f64,
}

/// |f|, |f_K| and η stay below these whatever is composed: no state of grains has more.
const FABRIC_LIMIT: f64 = 0.9;
const POROSITY_LIMIT: f64 = 0.99;

/// Outputs of the network before the odd ones.
pub const EVEN_OUTPUTS: usize = 2;

/// Layer sizes of the rates' network.
pub fn sizes(variables: Variables, hidden: &[usize]) -> Vec<usize> {
    let odd = variables.odd_count();
    [&[RATE_INPUTS], hidden, &[EVEN_OUTPUTS + odd * (odd + 1)]].concat()
}

/// What a step starts from.
pub struct RateInputs<'a> {
    pub variables: Variables,
    pub state: &'a StateLanes,
    /// Thermal strain [-].
    pub strain: &'a Lanes,
    /// Share of it that is new to the grains [0 to 1], see [`direction`].
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
    /// Advances a block of states: [`Rates::advanced`]; leaves all neurons' values.
    pub fn advance(&self, from: RateInputs<'_>, neurons: &mut Neurons, next: &mut StateLanes) {
        dispatch(Advance { rates: self, from, neurons, next });
    }

    /// The state after a strain, in the model's columns of `next`; `outputs` are those of the network at the features.
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

    /// Keeps the state one that grains can have: 0 ≤ η < 1, p̃ ≥ 0, no tension, and no stress before the grains touch.
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
            // Without contacts there is no fabric to change.
            let (new, old) = (V::read(&next[column]), V::read(&state[column]));
            let value = pressure.where_greater(zero, new, old);
            value.within(V::all(-FABRIC_LIMIT), V::all(FABRIC_LIMIT)).write(&mut next[column]);
        }
        if let Some(column) = variables.deviator() {
            V::read(&next[column]).within(zero - pressure, pressure).write(&mut next[column]);
        }
    }
}

/// Sign of the strain, 0 for none. Sliding contacts do not slide back: measured, the deviator fades on contraction much
/// faster than it grows on expansion, whatever the size of the increments, so a rate that is smooth in ε cannot compose to
/// both. η and p̃ do not see the sign: they are reversible, small to and fro does not let them creep. That holds for virgin
/// strains. Strained back, and again as far as they have been, grains that slid have come to rest: without the sign the
/// error of K on the database's ramps back from +5 % falls by a third (`msdd score`), and cycles do not drift. The fit takes all
/// ramps for virgin: with the ways back as what they are it is no better (README).
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

/// Σ y_i b_i over the odd features.
#[inline(always)]
pub fn odd_sum<V: Vector>(coefficients: &[Lanes], odd: &[Lanes; MAX_ODD]) -> V {
    let mut sum = V::zero();
    for (y, b) in coefficients.iter().zip(odd) {
        sum = V::read(y).fused(V::read(b), sum);
    }
    sum
}
