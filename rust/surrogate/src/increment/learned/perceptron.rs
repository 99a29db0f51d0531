//! A small perceptron with two hidden layers of tanh, and its derivatives.

use crate::network::symmetric_unit;
use rand_chacha::ChaCha8Rng;

pub const INPUTS: usize = 11;
pub const HIDDEN: usize = 12;
pub const OUTPUTS: usize = 11;

/// Of each layer, a row for each neuron: weights, then the bias.
const FIRST: usize = HIDDEN * (INPUTS + 1);
const SECOND: usize = HIDDEN * (HIDDEN + 1);
const LAST: usize = OUTPUTS * (HIDDEN + 1);
/// Number of weights and biases.
pub const WEIGHTS: usize = FIRST + SECOND + LAST;

/// What the layers answered.
#[derive(Clone, Copy)]
pub struct Activations {
    inputs: [f64; INPUTS],
    first: [f64; HIDDEN],
    second: [f64; HIDDEN],
    pub outputs: [f64; OUTPUTS],
}

/// Random starting weights; those of the last layer are small, so that the outputs are near 0.
pub fn initial(random: &mut ChaCha8Rng) -> Vec<f64> {
    let mut weights = Vec::with_capacity(WEIGHTS);
    for (inputs, neurons, size, bias) in
        [(INPUTS, HIDDEN, 0.4, 0.4), (HIDDEN, HIDDEN, 0.4, 0.0), (HIDDEN, OUTPUTS, 0.02, 0.02)]
    {
        for _ in 0..neurons {
            weights.extend((0..inputs).map(|_| size * symmetric_unit(random)));
            weights.push(bias * symmetric_unit(random));
        }
    }
    weights
}

pub fn forward(weights: &[f64], inputs: [f64; INPUTS]) -> Activations {
    let (first, rest) = weights.split_at(FIRST);
    let (second, last) = rest.split_at(SECOND);
    let first = layer::<INPUTS, HIDDEN>(first, &inputs).map(tanh);
    let second = layer::<HIDDEN, HIDDEN>(second, &first).map(tanh);
    Activations { inputs, first, second, outputs: layer::<HIDDEN, OUTPUTS>(&last[..LAST], &second) }
}

/// Adds the derivatives by the weights to `gradient`, for an error with these derivatives by the outputs. Returns those by the
/// inputs.
pub fn backward(
    weights: &[f64],
    answered: &Activations,
    outputs: &[f64; OUTPUTS],
    gradient: &mut [f64],
) -> [f64; INPUTS] {
    let Activations { inputs, first, second, .. } = answered;
    let at = FIRST + SECOND;
    let by_second =
        layer_back::<HIDDEN, OUTPUTS>(&weights[at..], second, outputs, &mut gradient[at..at + LAST]);
    let sums = std::array::from_fn(|k| by_second[k] * (1.0 - second[k] * second[k]));
    let by_first = layer_back::<HIDDEN, HIDDEN>(&weights[FIRST..at], first, &sums, &mut gradient[FIRST..at]);
    let sums = std::array::from_fn(|k| by_first[k] * (1.0 - first[k] * first[k]));
    layer_back::<INPUTS, HIDDEN>(&weights[..FIRST], inputs, &sums, &mut gradient[..FIRST])
}

fn tanh(x: f64) -> f64 {
    let e = (2.0 * x.clamp(-20.0, 20.0)).exp();
    (e - 1.0) / (e + 1.0)
}

fn layer<const N: usize, const M: usize>(weights: &[f64], inputs: &[f64; N]) -> [f64; M] {
    let mut sums = [0.0; M];
    for (sum, row) in sums.iter_mut().zip(weights.chunks_exact(N + 1)) {
        *sum = row[N] + row.iter().zip(inputs).map(|(w, x)| w * x).sum::<f64>();
    }
    sums
}

fn layer_back<const N: usize, const M: usize>(
    weights: &[f64],
    inputs: &[f64; N],
    sums: &[f64; M],
    gradient: &mut [f64],
) -> [f64; N] {
    let mut by_inputs = [0.0; N];
    for ((&sum, row), by_row) in
        sums.iter().zip(weights.chunks_exact(N + 1)).zip(gradient.chunks_exact_mut(N + 1))
    {
        for k in 0..N {
            by_row[k] += sum * inputs[k];
            by_inputs[k] += sum * row[k];
        }
        by_row[N] += sum;
    }
    by_inputs
}
