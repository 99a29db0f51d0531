//! A small tanh network of any shape up to [`WIDTH`]: one or two hidden layers, linear outputs. The networks of the
//! state model are of this type.

use crate::kernel::{self, LANES, LayerValues};
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::{Rng, SeedableRng};
use serde::{Deserialize, Serialize};

pub use crate::kernel::{MAX_LAYERS, WIDTH};

/// Layer sizes and weights. The weights stand layer by layer and neuron by neuron: the weights of a neuron, then its
/// bias.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Perceptron {
    /// Inputs, neurons of each hidden layer, outputs.
    pub sizes: Vec<usize>,
    pub weights: Vec<f64>,
}

/// Values of all neurons of a block of cells, layer by layer; the inputs are layer 0.
pub struct Neurons {
    pub layers: LayerValues,
}

impl Neurons {
    pub fn new() -> Self {
        Self { layers: [[[0.0; LANES]; WIDTH]; MAX_LAYERS] }
    }
}

impl Default for Neurons {
    fn default() -> Self {
        Self::new()
    }
}

/// Number of weights and biases of a network of these layer sizes.
pub fn weight_count(sizes: &[usize]) -> usize {
    sizes.windows(2).map(|pair| (pair[0] + 1) * pair[1]).sum()
}

impl Perceptron {
    /// Random starting weights: directions are uniform, and lengths such that the intervals in which the neurons are
    /// not saturated cover the inputs, which lie in [-1, 1] (after Nguyen and Widrow 1990). Outputs are small at the
    /// start.
    ///
    /// # Panics
    /// When the shape exceeds [`WIDTH`] or [`MAX_LAYERS`].
    pub fn initial(sizes: &[usize], seed: u64, stream: u64) -> Self {
        assert!(shape_is_sound(sizes), "network shape {sizes:?}");
        let mut random = ChaCha8Rng::seed_from_u64(seed);
        random.set_stream(stream);
        let mut weights = Vec::with_capacity(weight_count(sizes));
        let hidden = &sizes[..sizes.len() - 1];
        for pair in hidden.windows(2) {
            for _ in 0..pair[1] {
                let direction: Vec<f64> = (0..pair[0]).map(|_| symmetric_unit(&mut random)).collect();
                let norm = direction.iter().map(|w| w * w).sum::<f64>().sqrt().max(f64::MIN_POSITIVE);
                weights.extend(direction.iter().map(|w| w / norm));
                weights.push(symmetric_unit(&mut random));
            }
        }
        let last = (sizes[sizes.len() - 2] + 1) * sizes[sizes.len() - 1];
        weights.extend((0..last).map(|_| 0.3 * symmetric_unit(&mut random)));
        Self { sizes: sizes.to_vec(), weights }
    }

    /// Makes the outputs independent of an input.
    pub(crate) fn forget(&mut self, input: usize) {
        let width = self.sizes[0] + 1;
        self.weights[..width * self.sizes[1]].chunks_exact_mut(width).for_each(|row| row[input] = 0.0);
    }

    pub fn outputs(&self) -> usize {
        self.sizes[self.sizes.len() - 1]
    }

    /// Evaluates a block whose inputs are in `neurons.layers[0]`; returns the index of the layer that holds the
    /// outputs.
    pub fn run(&self, neurons: &mut Neurons) -> usize {
        kernel::forward(&self.sizes, &self.weights, &mut neurons.layers);
        self.sizes.len() - 1
    }

    /// Gradient with respect to the weights of Σ_o c_o y_o of one lane; `neurons` must be as [`Perceptron::run`] left
    /// them.
    pub fn gradient(&self, neurons: &Neurons, lane: usize, c: &[f64], gradient: &mut [f64]) {
        let mut delta = [0.0; WIDTH];
        delta[..c.len()].copy_from_slice(c);
        let mut end = self.weights.len();
        for layer in (1..self.sizes.len()).rev() {
            let (inputs, count) = (self.sizes[layer - 1], self.sizes[layer]);
            let start = end - (inputs + 1) * count;
            let before = &neurons.layers[layer - 1];
            let mut back = [0.0; WIDTH];
            for (j, part) in gradient[start..end].chunks_exact_mut(inputs + 1).enumerate() {
                for k in 0..inputs {
                    part[k] = delta[j] * before[k][lane];
                    back[k] += delta[j] * self.weights[start + j * (inputs + 1) + k];
                }
                part[inputs] = delta[j];
            }
            for (k, sum) in back[..inputs].iter().enumerate() {
                delta[k] = sum * (1.0 - before[k][lane] * before[k][lane]); // d tanh; unused for the inputs
            }
            end = start;
        }
    }
}

/// One or two hidden layers, none wider than [`WIDTH`], none empty.
pub fn shape_is_sound(sizes: &[usize]) -> bool {
    (3..=MAX_LAYERS).contains(&sizes.len()) && sizes.iter().all(|size| (1..=WIDTH).contains(size))
}

/// Uniform in [-1, 1).
fn symmetric_unit(random: &mut ChaCha8Rng) -> f64 {
    (random.next_u64() >> 11) as f64 / (1u64 << 52) as f64 - 1.0
}

#[cfg(test)]
mod tests {
    use super::*;

    fn filled(network: &Perceptron) -> Neurons {
        let mut neurons = Neurons::new();
        for k in 0..network.sizes[0] {
            neurons.layers[0][k] = std::array::from_fn(|lane| (1.3 * k as f64 + 0.7 * lane as f64).sin());
        }
        neurons
    }

    #[test]
    fn gradient_agrees_with_central_differences() {
        for sizes in [vec![3, 5, 4], vec![4, 6, 7, 3]] {
            let network = Perceptron::initial(&sizes, 3, 0);
            let c: Vec<f64> = (0..network.outputs()).map(|o| 0.4 - 0.3 * o as f64).collect();
            let value = |network: &Perceptron| {
                let mut neurons = filled(network);
                let last = network.run(&mut neurons);
                c.iter().zip(&neurons.layers[last]).map(|(c, y)| c * y[5]).sum::<f64>()
            };
            let mut neurons = filled(&network);
            network.run(&mut neurons);
            let mut gradient = vec![0.0; network.weights.len()];
            network.gradient(&neurons, 5, &c, &mut gradient);
            for (index, analytic) in gradient.iter().enumerate() {
                let moved = |by: f64| {
                    let mut moved = network.clone();
                    moved.weights[index] += by;
                    value(&moved)
                };
                let numeric = (moved(1e-6) - moved(-1e-6)) / 2e-6;
                assert!(
                    (analytic - numeric).abs() < 1e-8,
                    "{sizes:?} weight {index}: {analytic} against {numeric}"
                );
            }
        }
    }

    #[test]
    fn lanes_do_not_see_each_other() {
        let network = Perceptron::initial(&[4, 8, 6], 7, 1);
        let mut all = filled(&network);
        let last = network.run(&mut all);
        for lane in 0..LANES {
            let mut one = Neurons::new();
            for k in 0..4 {
                one.layers[0][k] = [filled(&network).layers[0][k][lane]; LANES];
            }
            network.run(&mut one);
            for o in 0..6 {
                assert_eq!(one.layers[last][o][0].to_bits(), all.layers[last][o][lane].to_bits());
            }
        }
    }
}
