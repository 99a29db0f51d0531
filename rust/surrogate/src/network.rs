//! The paper's network: 3 inputs, two hidden layers of 16 tanh neurons, 6 linear outputs (Fig. 3).

use crate::kernel::vector::Vector;
use crate::kernel::{LANES, Lanes, Task, dispatch, layer};
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::{Rng, SeedableRng};

/// Porosity, fabric index, thermal strain.
pub const INPUTS: usize = 3;
/// Neurons of each of the two hidden layers.
pub const HIDDEN: usize = 16;
/// Increments of porosity and fabric index, Kxx, Kyy, σxx, σyy.
pub const OUTPUTS: usize = 6;
/// Number of weights of the hidden layers, biases included; these weights come first.
pub const HIDDEN_WEIGHTS: usize = HIDDEN * (INPUTS + 1) + HIDDEN * (HIDDEN + 1);
/// Number of all weights and biases: 438.
pub const WEIGHTS: usize = HIDDEN_WEIGHTS + OUTPUTS * (HIDDEN + 1);
/// Upper limit for the magnitude of weights, far above those of any trained network; it keeps every sum far from
/// overflow.
pub const WEIGHT_LIMIT: f64 = 1e9;

/// Values of all neurons of the paper's network for a block of cells.
pub struct Activations {
    pub hidden_1: [Lanes; HIDDEN],
    pub hidden_2: [Lanes; HIDDEN],
    pub outputs: [Lanes; OUTPUTS],
}

/// Weights layer by layer and neuron by neuron: the weights of a neuron, then its bias.
#[derive(Clone, Debug, PartialEq)]
pub struct Network {
    pub weights: Box<[f64; WEIGHTS]>,
}

impl Network {
    /// Random starting weights of a training (Nguyen and Widrow 1990): directions are random, and lengths such that the
    /// intervals in which the neurons are not saturated cover the input range.
    pub fn initial(seed: u64, restart: u64) -> Self {
        let mut random = ChaCha8Rng::seed_from_u64(seed);
        random.set_stream(restart + 1); // stream 0 belongs to the split
        let mut weights = Vec::with_capacity(WEIGHTS);
        // 0.7 neurons^(1/inputs) as numbers, because powers differ in the last bit between mathematical libraries.
        for (inputs, neurons, length) in [(INPUTS, HIDDEN, 1.763_889_4), (HIDDEN, HIDDEN, 0.832_444_8)] {
            for _ in 0..neurons {
                let direction: Vec<f64> = (0..inputs).map(|_| symmetric_unit(&mut random)).collect();
                let norm = direction.iter().map(|w| w * w).sum::<f64>().sqrt().max(f64::MIN_POSITIVE);
                weights.extend(direction.iter().map(|w| w * length / norm));
                weights.push(length * symmetric_unit(&mut random));
            }
        }
        weights.extend((0..OUTPUTS * (HIDDEN + 1)).map(|_| 0.5 * symmetric_unit(&mut random)));
        Self::from_slice(&weights)
    }

    /// # Panics
    /// When the slice does not hold [`WEIGHTS`] numbers.
    pub fn from_slice(weights: &[f64]) -> Self {
        let mut network = Self { weights: Box::new([0.0; WEIGHTS]) };
        network.weights.copy_from_slice(weights);
        network
    }

    /// Values of all neurons for a block of scaled inputs.
    pub fn activations(&self, inputs: &[Lanes; INPUTS]) -> Activations {
        let zero = [0.0; LANES];
        let mut all =
            Activations { hidden_1: [zero; HIDDEN], hidden_2: [zero; HIDDEN], outputs: [zero; OUTPUTS] };
        dispatch(Activate { weights: &self.weights, inputs, all: &mut all });
        all
    }

    /// ∂(output)/∂(weights) of one lane. The derivatives with respect to the hidden layers' weights are written to
    /// `column`. Those with respect to the output's own weights are (hidden_2, 1), and those with respect to the other
    /// outputs' weights are zero.
    pub fn gradient(
        &self,
        inputs: &[Lanes; INPUTS],
        neurons: &Activations,
        lane: usize,
        output: usize,
        column: &mut [f64],
    ) {
        let second = &self.weights[HIDDEN * (INPUTS + 1)..HIDDEN_WEIGHTS];
        let third = &self.weights[HIDDEN_WEIGHTS + output * (HIDDEN + 1)..][..HIDDEN];
        let slope = |value: f64| 1.0 - value * value; // d tanh
        let delta_2: [f64; HIDDEN] = std::array::from_fn(|j| third[j] * slope(neurons.hidden_2[j][lane]));
        let mut delta_1 = [0.0; HIDDEN];
        for (row, delta) in second.chunks_exact(HIDDEN + 1).zip(delta_2) {
            for (sum, weight) in delta_1.iter_mut().zip(row) {
                *sum += weight * delta;
            }
        }
        let (column_1, column_2) = column.split_at_mut(HIDDEN * (INPUTS + 1));
        for (i, part) in column_1.chunks_exact_mut(INPUTS + 1).enumerate() {
            fill(part, delta_1[i] * slope(neurons.hidden_1[i][lane]), |k| inputs[k][lane]);
        }
        for (j, part) in column_2.chunks_exact_mut(HIDDEN + 1).enumerate() {
            fill(part, delta_2[j], |k| neurons.hidden_1[k][lane]);
        }
    }
}

struct Activate<'a> {
    weights: &'a [f64; WEIGHTS],
    inputs: &'a [Lanes; INPUTS],
    all: &'a mut Activations,
}

impl Task for Activate<'_> {
    #[inline(always)]
    fn run<V: Vector>(self) {
        let Self { weights, inputs, all } = self;
        let (first, rest) = weights.split_at(HIDDEN * (INPUTS + 1));
        let (second, third) = rest.split_at(HIDDEN * (HIDDEN + 1));
        layer::<V>(first, inputs, &mut all.hidden_1, true);
        layer::<V>(second, &all.hidden_1, &mut all.hidden_2, true);
        layer::<V>(third, &all.hidden_2, &mut all.outputs, false);
    }
}

/// Derivatives with respect to a neuron's weights (delta · input), then to its bias (delta).
fn fill(part: &mut [f64], delta: f64, input: impl Fn(usize) -> f64) {
    let bias = part.len() - 1;
    for (k, derivative) in part[..bias].iter_mut().enumerate() {
        *derivative = delta * input(k);
    }
    part[bias] = delta;
}

/// Uniform in [-1, 1).
pub(crate) fn symmetric_unit(random: &mut ChaCha8Rng) -> f64 {
    (random.next_u64() >> 11) as f64 / (1u64 << 52) as f64 - 1.0
}

/// A block of lanes from `count` values, at least one. The last value fills the remaining lanes, so that all lanes hold
/// valid numbers.
pub fn padded(count: usize, value: impl Fn(usize) -> f64) -> Lanes {
    std::array::from_fn(|lane| value(lane.min(count.clamp(1, LANES) - 1)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::kernel::with_every_set;

    #[test]
    fn every_instruction_set_gives_the_same_bits() {
        let weights: [f64; WEIGHTS] = std::array::from_fn(|i| ((i * 37 % 101) as f64 - 50.0) * 0.03);
        let inputs: [Lanes; INPUTS] =
            std::array::from_fn(|k| std::array::from_fn(|lane| ((k * 8 + lane) as f64 * 0.71).sin()));
        let network = Network { weights: Box::new(weights) };
        let bits = || network.activations(&inputs).outputs.map(|lanes| lanes.map(f64::to_bits));
        let expected = bits();
        with_every_set(|set| assert_eq!(bits(), expected, "{set}"));
    }

    #[test]
    fn counts_of_the_paper() {
        assert_eq!((HIDDEN_WEIGHTS, WEIGHTS), (336, 438));
    }

    #[test]
    fn gradient_agrees_with_central_differences() {
        let network = Network::initial(3, 0);
        let inputs: [Lanes; INPUTS] =
            std::array::from_fn(|k| std::array::from_fn(|lane| (1.3 * k as f64 + 0.7 * lane as f64).sin()));
        let neurons = network.activations(&inputs);
        let (lane, output, step) = (5, 4, 1e-6);
        let mut column = [0.0; HIDDEN_WEIGHTS];
        network.gradient(&inputs, &neurons, lane, output, &mut column);
        for (index, analytic) in column.iter().enumerate() {
            let shifted = |by: f64| {
                let mut moved = network.clone();
                moved.weights[index] += by;
                moved.activations(&inputs).outputs[output][lane]
            };
            let numeric = (shifted(step) - shifted(-step)) / (2.0 * step);
            assert!((analytic - numeric).abs() < 1e-8, "weight {index}: {analytic} against {numeric}");
        }
    }

    #[test]
    fn start_depends_on_seed_and_restart_alone() {
        assert_eq!(Network::initial(1, 0), Network::initial(1, 0));
        assert_ne!(Network::initial(1, 0), Network::initial(1, 1));
        assert_ne!(Network::initial(1, 0), Network::initial(2, 0));
    }
}
