//! Advance of the state: Δx = ε · g(x, ε).

use super::variables::{FABRIC_INDEX, Features, MAX_ODD, POROSITY, PRESSURE, RATE_INPUTS, Variables};
use crate::kernel::{LANES, Lanes};
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

impl Rates {
    /// The state after a strain.
    #[inline(always)]
    pub fn advanced(
        &self,
        variables: Variables,
        state: &StateLanes,
        strain: &Lanes,
        features: &Features,
        neurons: &mut Neurons,
    ) -> StateLanes {
        neurons.layers[0][..RATE_INPUTS].copy_from_slice(&features.even);
        let last = self.network.run_inlined(neurons);
        let outputs = &neurons.layers[last];
        let mut next = *state;
        for (output, column) in [POROSITY, PRESSURE].into_iter().enumerate() {
            for lane in 0..LANES {
                let rate = self.offset[column] + self.scale[column] * outputs[output][lane];
                next[column][lane] += strain[lane] * rate;
            }
        }
        let count = variables.odd_count();
        let signs = strain.map(direction);
        for (k, column) in variables.odd().enumerate() {
            let first = EVEN_OUTPUTS + k * (count + 1);
            let sum = odd_sum(&outputs[first..first + count], &features.odd);
            let (own, odd) = (&outputs[first + count], &features.odd[k]);
            for lane in 0..LANES {
                let rate = sum[lane] + signs[lane] * own[lane] * odd[lane];
                next[column][lane] += strain[lane] * (self.scale[column] * rate);
            }
        }
        self.limit(variables, state, &mut next);
        next
    }

    /// Keeps the state one that grains can have: 0 ≤ η < 1, p̃ ≥ 0, no tension, and no stress before the grains touch.
    #[inline(always)]
    fn limit(&self, variables: Variables, state: &StateLanes, next: &mut StateLanes) {
        let mut pressure = [0.0; LANES];
        for lane in 0..LANES {
            next[POROSITY][lane] = next[POROSITY][lane].clamp(0.0, POROSITY_LIMIT);
            let apart = (state[PRESSURE][lane] <= 0.0) & (next[POROSITY][lane] >= self.unjamming_porosity);
            let allowed = next[PRESSURE][lane].max(0.0);
            pressure[lane] = if apart { 0.0 } else { allowed };
        }
        next[PRESSURE] = pressure;
        for column in std::iter::once(FABRIC_INDEX).chain(variables.fabric_conductivity()) {
            for lane in 0..LANES {
                // Without contacts there is no fabric to change.
                let (new, old) = (next[column][lane], state[column][lane]);
                let value = if pressure[lane] > 0.0 { new } else { old };
                next[column][lane] = value.clamp(-FABRIC_LIMIT, FABRIC_LIMIT);
            }
        }
        if let Some(column) = variables.deviator() {
            for lane in 0..LANES {
                next[column][lane] = next[column][lane].max(-pressure[lane]).min(pressure[lane]);
            }
        }
    }
}

/// Sign of the strain, 0 for none. Sliding contacts do not slide back: measured, the deviator fades on contraction much
/// faster than it grows on expansion, whatever the size of the increments, so a rate that is smooth in ε cannot compose to
/// both. η and p̃ do not see the sign: they are reversible, small to and fro does not let them creep.
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
pub fn odd_sum(coefficients: &[Lanes], odd: &[Lanes; MAX_ODD]) -> Lanes {
    let mut sum = [0.0; LANES];
    for (y, b) in coefficients.iter().zip(odd) {
        for lane in 0..LANES {
            sum[lane] += y[lane] * b[lane];
        }
    }
    sum
}
