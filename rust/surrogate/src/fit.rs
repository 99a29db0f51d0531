//! The network's fit to samples as a least-squares problem. JᵀJ grows batch by batch; J as a whole never exists.

use crate::dataset::Sample;
use crate::kernel::{LANES, Lanes};
use crate::levenberg_marquardt::{LeastSquares, NormalEquations};
use crate::network::{HIDDEN, HIDDEN_WEIGHTS, INPUTS, Network, OUTPUTS, WEIGHTS, padded};
use crate::scaling::{OutputScales, TrainedRange};
use nalgebra::{DMatrix, DVector, DVectorView};

/// Eight samples, scaled. Weight 0 marks padding.
struct Octet {
    inputs: [Lanes; INPUTS],
    targets: [Lanes; OUTPUTS],
    weights: [Lanes; OUTPUTS],
}

/// Residuals weight · (y − target) over samples and outputs.
pub struct NetworkFit {
    octets: Vec<Octet>,
    residuals: f64,
    threads: usize,
}

/// Sums are formed per part and added in order, so that the thread count does not change the bits.
const PARTS: usize = 8;
/// Octets whose rows of J are held at a time.
const BATCH: usize = 32;
/// Rows of the lower triangle of JᵀJ computed at a time.
const TILE: usize = HIDDEN_WEIGHTS / 3;

impl NetworkFit {
    pub fn new(samples: &[Sample], range: &TrainedRange, scales: &OutputScales, threads: usize) -> Self {
        let strain = range.thermal_strain;
        let largest_strain = strain.max.abs().max(strain.min.abs());
        let octet = |chunk: &[Sample]| {
            let targets: Vec<_> = chunk.iter().map(|s| scales.targets(s, largest_strain)).collect();
            let last = chunk.len() - 1;
            let inputs = std::array::from_fn(|k| padded(chunk.len(), |lane| chunk[lane].inputs[k]));
            let weight = |lane: usize, o: usize| if lane <= last { targets[lane][o].1 } else { 0.0 };
            Octet {
                inputs: range.scaled(&range.clamp(&inputs).0),
                targets: std::array::from_fn(|o| padded(chunk.len(), |lane| targets[lane][o].0)),
                weights: std::array::from_fn(|o| std::array::from_fn(|lane| weight(lane, o))),
            }
        };
        Self {
            octets: samples.chunks(LANES).map(octet).collect(),
            residuals: (samples.len() * OUTPUTS) as f64,
            threads: threads.clamp(1, PARTS),
        }
    }

    /// The parts' results, in order.
    fn by_part<T: Send>(&self, work: impl Fn(&[Octet]) -> T + Sync) -> Vec<T> {
        let length = self.octets.len().div_ceil(PARTS).max(1);
        let parts: Vec<&[Octet]> = self.octets.chunks(length).collect();
        let share = parts.len().div_ceil(self.threads).max(1);
        let work = &work;
        std::thread::scope(|scope| {
            let start = |parts: &'_ [&'_ [Octet]]| parts.iter().map(|part| work(part)).collect::<Vec<T>>();
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
            self.by_part(|octets| octets.iter().map(|octet| octet.sum_of_squares(&network)).sum::<f64>());
        sums.iter().sum::<f64>() / self.residuals
    }

    fn normal_equations(&self, parameters: &DVector<f64>) -> NormalEquations {
        let network = Network::from_slice(parameters.as_slice());
        let mut parts = self.by_part(|octets| part_equations(&network, octets)).into_iter();
        let zero = || (DMatrix::zeros(WEIGHTS, WEIGHTS), DVector::zeros(WEIGHTS));
        let (mut matrix, mut gradient) = parts.next().unwrap_or_else(zero);
        for (part_matrix, part_gradient) in parts {
            matrix += part_matrix;
            gradient += part_gradient;
        }
        NormalEquations { matrix: matrix / self.residuals, gradient: gradient / self.residuals }
    }
}

impl Octet {
    fn sum_of_squares(&self, network: &Network) -> f64 {
        let outputs = network.activations(&self.inputs).outputs;
        let residual =
            |o: usize, lane: usize| self.weights[o][lane] * (outputs[o][lane] - self.targets[o][lane]);
        (0..OUTPUTS).map(|o| (0..LANES).map(|lane| residual(o, lane).powi(2)).sum::<f64>()).sum()
    }
}

/// JᵀJ (lower triangle) and Jᵀr of some octets.
fn part_equations(network: &Network, octets: &[Octet]) -> (DMatrix<f64>, DVector<f64>) {
    let mut matrix = DMatrix::zeros(WEIGHTS, WEIGHTS);
    let mut gradient = DVector::zeros(WEIGHTS);
    for batch in octets.chunks(BATCH) {
        for output in 0..OUTPUTS {
            add_output(network, batch, output, &mut matrix, &mut gradient);
        }
    }
    (matrix, gradient)
}

/// Adds one output's rows of J. Such a row is zero but for the hidden layers' weights and the output's own.
fn add_output(
    network: &Network,
    batch: &[Octet],
    output: usize,
    matrix: &mut DMatrix<f64>,
    gradient: &mut DVector<f64>,
) {
    let rows = batch.len() * LANES;
    // Transposed: one column a sample.
    let mut hidden = DMatrix::zeros(HIDDEN_WEIGHTS, rows);
    let mut own = DMatrix::zeros(HIDDEN + 1, rows);
    let mut residual = DVector::zeros(rows);
    for (index, octet) in batch.iter().enumerate() {
        let neurons = network.activations(&octet.inputs);
        for lane in 0..LANES {
            let row = index * LANES + lane;
            let weight = octet.weights[output][lane];
            residual[row] = weight * (neurons.outputs[output][lane] - octet.targets[output][lane]);
            let mut column = hidden.column_mut(row);
            network.gradient(&octet.inputs, &neurons, lane, output, column.as_mut_slice());
            column *= weight;
            let values = neurons.hidden_2.map(|lanes| lanes[lane]);
            own.view_mut((0, row), (HIDDEN, 1))
                .copy_from(&(DVectorView::from_slice(&values, HIDDEN) * weight));
            own[(HIDDEN, row)] = weight;
        }
    }
    let (hidden_t, own_t) = (hidden.transpose(), own.transpose());
    for first in (0..HIDDEN_WEIGHTS).step_by(TILE) {
        let width = first + TILE;
        let mut tile = matrix.view_mut((first, 0), (TILE, width));
        tile.gemm(1.0, &hidden.rows(first, TILE), &hidden_t.columns(0, width), 1.0);
    }
    let place = HIDDEN_WEIGHTS + output * (HIDDEN + 1);
    matrix.view_mut((place, 0), (HIDDEN + 1, HIDDEN_WEIGHTS)).gemm(1.0, &own, &hidden_t, 1.0);
    matrix.view_mut((place, place), (HIDDEN + 1, HIDDEN + 1)).gemm(1.0, &own, &own_t, 1.0);
    gradient.rows_mut(0, HIDDEN_WEIGHTS).gemv(1.0, &hidden, &residual, 1.0);
    gradient.rows_mut(place, HIDDEN + 1).gemv(1.0, &own, &residual, 1.0);
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
        for octet in &fit.octets {
            let (a, b) = (ahead.activations(&octet.inputs), behind.activations(&octet.inputs));
            for (o, weights) in octet.weights.iter().enumerate() {
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
