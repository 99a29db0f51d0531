//! What is read from the state: the conductivity, and odd quantities that the state does not carry.

use super::rates::odd_sum;
use super::variables::{ConductivityKind, Features, PRESSURE, READOUT_INPUTS, Variables};
use crate::kernel::{LANES, Lanes};
use crate::perceptron::{Neurons, Perceptron};
use crate::surrogate::StateLanes;
use serde::{Deserialize, Serialize};

/// Readout of one kind of conductivity.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Readout {
    pub kind: ConductivityKind,
    /// Even features in; outputs: h, then the coefficients of f_K and of q̃/p̃ unless they are carried.
    pub network: Perceptron,
    /// √(K/(k √p̃)) at output 0, and for a unit of output.
    pub offset: f64,
    pub scale: f64,
    /// Whether f_K is the state's, because that is of this kind of conductivity.
    pub carried: bool,
}

/// K/k of a state without stress: far below any jammed one (0.05 at least), above zero for the heat equation's sake.
pub const CONDUCTIVITY_FLOOR: f64 = 1e-4;
/// Largest |f_K| that is read out, and the largest |q̃/p̃|: both components stay positive.
const RATIO_LIMIT: f64 = 0.9;

impl Readout {
    /// Layer sizes of the network.
    pub fn sizes(variables: Variables, carried: bool, hidden: &[usize]) -> Vec<usize> {
        let missing = usize::from(!carried) + usize::from(!variables.stress_deviator);
        [&[READOUT_INPUTS], hidden, &[1 + missing * variables.odd_count()]].concat()
    }

    /// K_xx/k, K_yy/k and reduced σ_xx, σ_yy of a state.
    ///
    /// Mean K = floor + √p̃ h², so K tends to the floor with the stress and never falls below it.
    #[inline(always)]
    pub fn answer(
        &self,
        variables: Variables,
        state: &StateLanes,
        features: &Features,
        neurons: &mut Neurons,
    ) -> ([Lanes; 2], [Lanes; 2]) {
        neurons.layers[0][..READOUT_INPUTS].copy_from_slice(&features.even[..READOUT_INPUTS]);
        let last = self.network.run_inlined(neurons);
        let outputs = &neurons.layers[last];
        let (mut conductivity, mut stress) = ([[0.0; LANES]; 2], [[0.0; LANES]; 2]);
        let count = variables.odd_count();
        let read = |first: usize| {
            let sum = odd_sum(&outputs[first..first + count], &features.odd);
            sum.map(|value| value.clamp(-RATIO_LIMIT, RATIO_LIMIT))
        };
        let after_fabric = if self.carried { 1 } else { 1 + count };
        let fabric = match variables.fabric_conductivity() {
            Some(column) if self.carried => state[column].map(|v| v.clamp(-RATIO_LIMIT, RATIO_LIMIT)),
            _ => read(1),
        };
        let pressure = &state[PRESSURE];
        let deviator = match variables.deviator() {
            Some(column) => state[column],
            None => {
                let ratio = read(after_fabric);
                std::array::from_fn(|lane| pressure[lane] * ratio[lane])
            }
        };
        for lane in 0..LANES {
            let h = self.offset + self.scale * outputs[0][lane];
            let mean = CONDUCTIVITY_FLOOR + features.root_pressure[lane] * (h * h);
            conductivity[0][lane] = mean * (1.0 + fabric[lane]);
            conductivity[1][lane] = mean * (1.0 - fabric[lane]);
            stress[0][lane] = pressure[lane] + deviator[lane];
            stress[1][lane] = pressure[lane] - deviator[lane];
        }
        (conductivity, stress)
    }
}
