//! Fit of a network whose residuals are linear in its outputs. JᵀJ is summed up batch by batch; the whole Jacobian J is
//! never stored.

use crate::kernel::{LANES, Lanes, add_outer_products};
use crate::levenberg_marquardt::{LeastSquares, NormalEquations};
use crate::perceptron::{Neurons, Perceptron, WIDTH};
use nalgebra::{DMatrix, DVector};

/// Largest number of coefficients of a residual.
pub const TERMS: usize = 4;

/// One residual: max(Σ c_o y_o, floor) − target, where o counts from `first`. Its weight is a factor in c, floor and
/// target.
#[derive(Clone, Copy, Debug)]
pub struct Residual {
    pub first: usize,
    pub coefficients: [f64; TERMS],
    /// Lower limit of the prediction, as p̃ has at zero.
    pub floor: f64,
    pub target: f64,
}

/// Scaled inputs of a sample, and its residuals.
#[derive(Clone, Debug)]
pub struct Sample {
    pub inputs: Vec<f64>,
    pub residuals: Vec<Residual>,
}

/// Samples of a block: scaled inputs, and the residuals with the lane each belongs to.
struct Block {
    inputs: Vec<Lanes>,
    residuals: Vec<(usize, Residual)>,
}

/// The fit of one network to samples as a least-squares problem.
pub struct PerceptronFit {
    sizes: Vec<usize>,
    blocks: Vec<Block>,
    residuals: f64,
    threads: usize,
}

/// Sums are formed separately for this many parts and added in order, so that the number of threads does not change the
/// bits.
const PARTS: usize = 8;
/// Number of rows of J that are stored at a time.
const BATCH: usize = 128;

impl PerceptronFit {
    pub fn new(sizes: Vec<usize>, samples: &[Sample], threads: usize) -> Self {
        let block = |chunk: &[Sample]| {
            let lane_of = |lane: usize| &chunk[lane.min(chunk.len() - 1)];
            let inputs = (0..sizes[0]).map(|k| std::array::from_fn(|lane| lane_of(lane).inputs[k])).collect();
            let residuals = chunk.iter().enumerate();
            let residuals = residuals.flat_map(|(lane, s)| s.residuals.iter().map(move |r| (lane, *r)));
            Block { inputs, residuals: residuals.collect() }
        };
        let residuals = samples.iter().map(|sample| sample.residuals.len()).sum::<usize>().max(1) as f64;
        let blocks = samples.chunks(LANES).map(block).collect();
        Self { sizes, blocks, residuals, threads: threads.clamp(1, PARTS) }
    }

    fn network(&self, parameters: &DVector<f64>) -> Perceptron {
        Perceptron { sizes: self.sizes.clone(), weights: parameters.as_slice().to_vec() }
    }

    /// Width of a row of J followed by its residual, padded for the kernel.
    pub(super) fn width(weights: usize) -> usize {
        (weights + 1).next_multiple_of(LANES)
    }

    /// Number of residuals.
    pub(super) fn count(&self) -> f64 {
        self.residuals
    }

    /// Lower triangle of (J | r)ᵀ (J | r).
    pub(super) fn summed_products(&self, network: &Perceptron) -> Vec<f64> {
        let width = Self::width(network.weights.len());
        let mut sum = vec![0.0; width * width];
        for part in self.by_part(|blocks| Self::products(network, blocks)) {
            sum.iter_mut().zip(&part).for_each(|(sum, part)| *sum += part);
        }
        sum
    }

    /// Normal equations as means over `count` residuals, from the summed products.
    pub(super) fn equations(products: &[f64], weights: usize, count: f64) -> NormalEquations {
        let width = Self::width(weights);
        let entry = |i: usize, j: usize| products[i * width + j] / count;
        NormalEquations {
            matrix: DMatrix::from_fn(weights, weights, |i, j| entry(i.max(j), i.min(j))),
            gradient: DVector::from_fn(weights, |j, _| entry(weights, j)),
        }
    }

    /// Σ r² of some blocks.
    fn sum_of_squares(network: &Perceptron, blocks: &[Block]) -> f64 {
        let mut neurons = Neurons::new();
        let mut sum = 0.0;
        for Block { inputs, residuals } in blocks {
            neurons.layers[0][..inputs.len()].copy_from_slice(inputs);
            let last = network.run(&mut neurons);
            for (lane, residual) in residuals {
                let value = residual.value(&neurons.layers[last], *lane);
                sum += (value.max(residual.floor) - residual.target).powi(2);
            }
        }
        sum
    }

    /// Lower triangle of (J | r)ᵀ (J | r) of some blocks.
    fn products(network: &Perceptron, blocks: &[Block]) -> Vec<f64> {
        let weights = network.weights.len();
        let width = Self::width(weights);
        let mut matrix = vec![0.0; width * width];
        let mut rows = vec![0.0; BATCH * width];
        let (mut neurons, mut filled) = (Neurons::new(), 0);
        for Block { inputs, residuals } in blocks {
            neurons.layers[0][..inputs.len()].copy_from_slice(inputs);
            let last = network.run(&mut neurons);
            for (lane, residual) in residuals {
                let value = residual.value(&neurons.layers[last], *lane);
                let row = &mut rows[filled * width..][..width];
                row.fill(0.0);
                if value > residual.floor {
                    let mut c = [0.0; WIDTH];
                    c.iter_mut().skip(residual.first).zip(residual.coefficients).for_each(|(c, r)| *c = r);
                    network.gradient(&neurons, *lane, &c[..network.outputs()], &mut row[..weights]);
                }
                row[weights] = value.max(residual.floor) - residual.target;
                filled += 1;
                if filled == BATCH {
                    add_outer_products(&rows, width, &mut matrix);
                    filled = 0;
                }
            }
        }
        add_outer_products(&rows[..filled * width], width, &mut matrix);
        matrix
    }

    /// Does `work` on each part; returns the results in order.
    fn by_part<T: Send>(&self, work: impl Fn(&[Block]) -> T + Sync) -> Vec<T> {
        let length = self.blocks.len().div_ceil(PARTS).max(1);
        let parts: Vec<_> = self.blocks.chunks(length).collect();
        let share = parts.len().div_ceil(self.threads).max(1);
        if self.threads == 1 {
            return parts.into_iter().map(work).collect();
        }
        let work = &work;
        std::thread::scope(|scope| {
            let workers: Vec<_> = parts
                .chunks(share)
                .map(|share| scope.spawn(move || share.iter().map(|part| work(part)).collect::<Vec<T>>()))
                .collect();
            let results = workers.into_iter().map(|worker| worker.join());
            results.flat_map(|part| part.unwrap_or_else(|panic| std::panic::resume_unwind(panic))).collect()
        })
    }
}

impl Residual {
    fn value(&self, outputs: &[Lanes; WIDTH], lane: usize) -> f64 {
        let terms = self.coefficients.iter().zip(&outputs[self.first..]);
        terms.map(|(c, y)| if *c == 0.0 { 0.0 } else { c * y[lane] }).fold(0.0, |sum, term| sum + term)
    }
}

impl LeastSquares for PerceptronFit {
    fn mean_square(&self, parameters: &DVector<f64>) -> f64 {
        let network = self.network(parameters);
        let sums = self.by_part(|blocks| Self::sum_of_squares(&network, blocks));
        sums.iter().fold(0.0, |sum, part| sum + part) / self.residuals
    }

    fn normal_equations(&self, parameters: &DVector<f64>) -> NormalEquations {
        let sum = self.summed_products(&self.network(parameters));
        Self::equations(&sum, parameters.len(), self.residuals)
    }
}

/// A residual without a lower limit of the prediction.
pub fn residual(first: usize, coefficients: [f64; TERMS], target: f64) -> Residual {
    Residual { first, coefficients, floor: f64::NEG_INFINITY, target }
}
