//! Quantities computed from the state: the conductivity, and odd quantities that the state does not contain.

use super::rates::odd_sum;
use super::variables::{Features, PRESSURE, READOUT_INPUTS, Variables};
use crate::dataset::ConductivityKind;
use crate::kernel::vector::Vector;
use crate::kernel::{self, Buffers};
use crate::perceptron::Perceptron;
use crate::surrogate::Answer;
use serde::{Deserialize, Serialize};

/// The readout for one kind of conductivity.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Readout {
    pub kind: ConductivityKind,
    /// Its inputs are the even features. Its outputs are h, then the coefficients of f_K and of q̃/p̃ unless the state
    /// contains these.
    pub network: Perceptron,
    /// √(K/(k √p̃)) at output 0; below, per unit of output.
    pub offset: f64,
    pub scale: f64,
    /// Whether f_K is taken from the state, because the f_K in the state is of this kind of conductivity.
    pub carried: bool,
}

/// K/k of a state without stress: far below that of any jammed state (at least 0.05), but positive, as the heat
/// equation needs.
pub const CONDUCTIVITY_FLOOR: f64 = 1e-4;
/// Largest |f_K| and |q̃/p̃| in an answer, so that both components of K and σ stay positive.
const RATIO_LIMIT: f64 = 0.9;

impl Readout {
    /// Layer sizes of the network.
    pub fn sizes(variables: Variables, carried: bool, hidden: &[usize]) -> Vec<usize> {
        let missing = usize::from(!carried) + usize::from(!variables.stress_deviator);
        [&[READOUT_INPUTS], hidden, &[1 + missing * variables.odd_count()]].concat()
    }

    /// Conductivity and stress of the state in `answer`.
    ///
    /// The mean K is floor + √p̃ h², so that K tends to the floor as the stress vanishes, and never falls below it.
    #[inline(always)]
    pub fn answer<V: Vector>(
        &self,
        variables: Variables,
        features: &Features,
        buffers: &mut Buffers,
        answer: &mut Answer,
    ) {
        let outputs =
            kernel::outputs::<V>(&self.network.sizes, &self.network.weights, &features.even, buffers);
        let count = variables.odd_count();
        let after_fabric = if self.carried { 1 } else { 1 + count };
        let limits = [V::all(-RATIO_LIMIT), V::all(RATIO_LIMIT)];
        let fabric = match variables.fabric_conductivity() {
            Some(column) if self.carried => V::read(&answer.state[column]),
            _ => odd_sum::<V>(&outputs[1..1 + count], &features.odd),
        };
        let fabric = fabric.within(limits[0], limits[1]);
        let pressure = V::read(&answer.state[PRESSURE]);
        let deviator = match variables.deviator() {
            Some(column) => V::read(&answer.state[column]),
            None => {
                let ratio = odd_sum::<V>(&outputs[after_fabric..after_fabric + count], &features.odd);
                ratio.within(limits[0], limits[1]) * pressure
            }
        };
        let h = V::read(&outputs[0]).fused(V::all(self.scale), V::all(self.offset));
        let mean = V::read(&features.root_pressure).fused(h * h, V::all(CONDUCTIVITY_FLOOR));
        (mean * (V::all(1.0) + fabric)).write(&mut answer.conductivity[0]);
        (mean * (V::all(1.0) - fabric)).write(&mut answer.conductivity[1]);
        (pressure + deviator).write(&mut answer.stress[0]);
        (pressure - deviator).write(&mut answer.stress[1]);
    }
}
