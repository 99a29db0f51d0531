//! The fit of the network to samples as a least-squares problem. JᵀJ is summed up batch by batch; the whole Jacobian J
//! is never stored.

use crate::dataset::Sample;
use crate::kernel::{LANES, Lanes, add_outer_products};
use crate::levenberg_marquardt::{LeastSquares, NormalEquations};
use crate::network::{HIDDEN, HIDDEN_WEIGHTS, INPUTS, Network, OUTPUTS, WEIGHTS, padded};
use crate::scaling::{OutputScales, TrainedRange};
use nalgebra::{DMatrix, DVector};

/// Scaled samples of a block. Weight 0 marks lanes that only fill the block.
struct Block {
    inputs: [Lanes; INPUTS],
    targets: [Lanes; OUTPUTS],
    weights: [Lanes; OUTPUTS],
}

/// Residuals weight · (y − target) over samples and outputs.
pub struct NetworkFit {
    blocks: Vec<Block>,
    residuals: f64,
    threads: usize,
}

/// Sums are formed separately for this many parts and added in order, so that the number of threads does not change the
/// bits.
const PARTS: usize = 8;
/// Number of blocks whose rows of J are stored at a time.
const BATCH: usize = 2;

impl NetworkFit {
    pub fn new(samples: &[Sample], range: &TrainedRange, scales: &OutputScales, threads: usize) -> Self {
        let strain = range.thermal_strain;
        let largest_strain = strain.max.abs().max(strain.min.abs());
        let block = |chunk: &[Sample]| {
            let targets: Vec<_> = chunk.iter().map(|s| scales.targets(s, largest_strain)).collect();
            let last = chunk.len() - 1;
            let inputs = std::array::from_fn(|k| padded(chunk.len(), |lane| chunk[lane].inputs[k]));
            let weight = |lane: usize, o: usize| if lane <= last { targets[lane][o].1 } else { 0.0 };
            Block {
                inputs: range.scaled(&range.clamp(&inputs).0),
                targets: std::array::from_fn(|o| padded(chunk.len(), |lane| targets[lane][o].0)),
                weights: std::array::from_fn(|o| std::array::from_fn(|lane| weight(lane, o))),
            }
        };
        Self {
            blocks: samples.chunks(LANES).map(block).collect(),
            residuals: (samples.len() * OUTPUTS) as f64,
            threads: threads.clamp(1, PARTS),
        }
    }

    /// Does `work` on each part; returns the results in order.
    fn by_part<T: Send>(&self, work: impl Fn(&[Block]) -> T + Sync) -> Vec<T> {
        let length = self.blocks.len().div_ceil(PARTS).max(1);
        let parts: Vec<&[Block]> = self.blocks.chunks(length).collect();
        let share = parts.len().div_ceil(self.threads).max(1);
        let work = &work;
        std::thread::scope(|scope| {
            let start = |parts: &'_ [&'_ [Block]]| parts.iter().map(|part| work(part)).collect::<Vec<T>>();
            let workers: Vec<_> =
                parts.chunks(share).map(|share| scope.spawn(move || start(share))).collect();
            let results = workers.into_iter().map(|worker| worker.join());
            results.flat_map(|part| part.unwrap_or_else(|panic| std::panic::resume_unwind(panic))).collect()
        })
    }
}

impl LeastSquares for NetworkFit {
    fn mean_square(&self, parameters: &DVector<f64>) -> f64 {
        let network = Network::from_slice(parameters.as_slice());
        let sums =
            self.by_part(|blocks| blocks.iter().map(|block| block.sum_of_squares(&network)).sum::<f64>());
        sums.iter().sum::<f64>() / self.residuals
    }

    fn normal_equations(&self, parameters: &DVector<f64>) -> NormalEquations {
        let network = Network::from_slice(parameters.as_slice());
        let mut parts = self.by_part(|blocks| part_equations(&network, blocks)).into_iter();
        let zero = || (DMatrix::zeros(WEIGHTS, WEIGHTS), DVector::zeros(WEIGHTS));
        let (mut matrix, mut gradient) = parts.next().unwrap_or_else(zero);
        for (part_matrix, part_gradient) in parts {
            matrix += part_matrix;
            gradient += part_gradient;
        }
        NormalEquations { matrix: matrix / self.residuals, gradient: gradient / self.residuals }
    }
}

impl Block {
    fn sum_of_squares(&self, network: &Network) -> f64 {
        let outputs = network.activations(&self.inputs).outputs;
        let residual =
            |o: usize, lane: usize| self.weights[o][lane] * (outputs[o][lane] - self.targets[o][lane]);
        (0..OUTPUTS).map(|o| (0..LANES).map(|lane| residual(o, lane).powi(2)).sum::<f64>()).sum()
    }
}

/// Number of weights of an output neuron, bias included.
const OWN: usize = HIDDEN + 1;
/// Width of a row of J for one output: the derivatives that are not zero, which are those with respect to the hidden
/// layers' weights and to the output's own weights; then the residual; then padding for the kernel.
const WIDTH: usize = (HIDDEN_WEIGHTS + OWN + 1).next_multiple_of(LANES);
/// Position of the residual in a row.
const RESIDUAL: usize = HIDDEN_WEIGHTS + OWN;

/// JᵀJ and Jᵀr of some blocks.
fn part_equations(network: &Network, blocks: &[Block]) -> (DMatrix<f64>, DVector<f64>) {
    let mut products: [Vec<f64>; OUTPUTS] = std::array::from_fn(|_| vec![0.0; WIDTH * WIDTH]);
    let mut rows = vec![0.0; BATCH * LANES * WIDTH];
    for batch in blocks.chunks(BATCH) {
        for (output, products) in products.iter_mut().enumerate() {
            let rows = &mut rows[..batch.len() * LANES * WIDTH];
            fill_rows(network, batch, output, rows);
            add_outer_products(rows, WIDTH, products);
        }
    }
    let (mut matrix, mut gradient) = (DMatrix::zeros(WEIGHTS, WEIGHTS), DVector::zeros(WEIGHTS));
    for (output, products) in products.iter().enumerate() {
        let own = HIDDEN_WEIGHTS + output * OWN;
        let weight = |k: usize| if k < HIDDEN_WEIGHTS { k } else { own + k - HIDDEN_WEIGHTS };
        for i in 0..RESIDUAL {
            gradient[weight(i)] += products[RESIDUAL * WIDTH + i];
            for j in 0..RESIDUAL {
                matrix[(weight(i), weight(j))] += products[i.max(j) * WIDTH + i.min(j)];
            }
        }
    }
    (matrix, gradient)
}

/// One output's rows of (J | r).
fn fill_rows(network: &Network, batch: &[Block], output: usize, rows: &mut [f64]) {
    for (block, rows) in batch.iter().zip(rows.chunks_exact_mut(LANES * WIDTH)) {
        let neurons = network.activations(&block.inputs);
        for (lane, row) in rows.chunks_exact_mut(WIDTH).enumerate() {
            let weight = block.weights[output][lane];
            network.gradient(&block.inputs, &neurons, lane, output, &mut row[..HIDDEN_WEIGHTS]);
            for (own, hidden) in row[HIDDEN_WEIGHTS..].iter_mut().zip(&neurons.hidden_2) {
                *own = hidden[lane];
            }
            row[HIDDEN_WEIGHTS + HIDDEN] = 1.0;
            row[..RESIDUAL].iter_mut().for_each(|entry| *entry *= weight);
            row[RESIDUAL] = weight * (neurons.outputs[output][lane] - block.targets[output][lane]);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{dataset, scaling, synthetic};

    fn problem(threads: usize) -> NetworkFit {
        let ramps = dataset::ramps(&synthetic::rows(3, 4)).expect("good rows");
        let samples: Vec<Sample> = ramps.iter().flat_map(|ramp| ramp.samples()).take(83).collect();
        let (range, scales) = scaling::measure(&samples).expect("varied");
        NetworkFit::new(&samples, &range, &scales, threads)
    }

    fn start() -> DVector<f64> {
        DVector::from_column_slice(Network::initial(1, 0).weights.as_slice())
    }

    #[test]
    fn gradient_is_that_of_the_mean_square() {
        let (fit, start, step) = (problem(1), start(), 1e-6);
        let equations = fit.normal_equations(&start);
        for index in [0, 3, 40, 63, 64, 80, 200, 335, 336, 352, 353, 400, 437] {
            let at = |by: f64| {
                let mut moved = start.clone();
                moved[index] += by;
                fit.mean_square(&moved)
            };
            let numeric = (at(step) - at(-step)) / (2.0 * step) / 2.0;
            assert!((equations.gradient[index] - numeric).abs() < 1e-8, "{index}: {numeric}");
        }
    }

    #[test]
    fn matrix_is_the_gauss_newton_curvature() {
        // Along a direction d: dᵀ JᵀJ d / n = mean of (J d)², with J d by central differences of the residuals.
        let (fit, start, step) = (problem(1), start(), 1e-5);
        let direction = DVector::from_fn(WEIGHTS, |i, _| ((i * 29 % 17) as f64 - 8.0) * 0.01);
        let lower = fit.normal_equations(&start).matrix.lower_triangle();
        let full = &lower + lower.transpose() - DMatrix::from_diagonal(&lower.diagonal());
        let curvature = direction.dot(&(full * &direction));
        let [ahead, behind] =
            [1.0, -1.0].map(|s| Network::from_slice((&start + &direction * (s * step)).as_slice()));
        let mut expected = 0.0;
        for block in &fit.blocks {
            let (a, b) = (ahead.activations(&block.inputs), behind.activations(&block.inputs));
            for (o, weights) in block.weights.iter().enumerate() {
                for (lane, weight) in weights.iter().enumerate() {
                    expected += (weight * (a.outputs[o][lane] - b.outputs[o][lane]) / (2.0 * step)).powi(2);
                }
            }
        }
        expected /= fit.residuals;
        assert!((curvature / expected - 1.0).abs() < 1e-6, "{curvature} against {expected}");
    }

    #[test]
    fn threads_do_not_change_the_bits() {
        let (one, three) = (problem(1), problem(3));
        assert_eq!(one.mean_square(&start()).to_bits(), three.mean_square(&start()).to_bits());
        let (a, b) = (one.normal_equations(&start()), three.normal_equations(&start()));
        assert!(a.matrix == b.matrix && a.gradient == b.gradient);
    }
}
