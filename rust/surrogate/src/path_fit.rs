//! Robust least squares along paths, with derivatives by differences: the fit of the models of discs and of spheres.

use crate::levenberg_marquardt::{LeastSquares, NormalEquations};
use nalgebra::{DMatrix, DVector};

/// Step of the differences, over a parameter or 0.1.
const STEP: f64 = 1e-4;

/// A model along the paths of its data.
pub trait Paths: Sync {
    /// Residual beyond which its square counts less.
    const ROBUST: f64;

    fn threads(&self) -> usize;

    /// All residuals, in a fixed order.
    fn residuals(&self, x: &DVector<f64>) -> Vec<f64>;

    /// Weight of a residual's square, and its share of the sum: that of a large residual grows less than with its square.
    fn robust(residual: f64) -> [f64; 2] {
        let ratio = residual / Self::ROBUST;
        let root = (1.0 + ratio * ratio).sqrt();
        [1.0 / root, 2.0 * Self::ROBUST * Self::ROBUST * (root - 1.0)]
    }
}

/// Residuals at several parameters, on the fit's threads.
fn residuals_of<P: Paths>(problem: &P, all: &[DVector<f64>]) -> Vec<Vec<f64>> {
    let each = all.len().div_ceil(problem.threads().max(1)).max(1);
    std::thread::scope(|scope| {
        let some = |some: &'_ [DVector<f64>]| some.iter().map(|x| problem.residuals(x)).collect::<Vec<_>>();
        let handles: Vec<_> = all.chunks(each).map(|chunk| scope.spawn(move || some(chunk))).collect();
        handles.into_iter().flat_map(|handle| handle.join().unwrap_or_default()).collect()
    })
}

impl<P: Paths> LeastSquares for P {
    fn mean_square(&self, x: &DVector<f64>) -> f64 {
        let residuals = self.residuals(x);
        residuals.iter().map(|&r| P::robust(r)[1]).sum::<f64>() / residuals.len().max(1) as f64
    }

    fn normal_equations(&self, x: &DVector<f64>) -> NormalEquations {
        let parameters = x.len();
        let steps: Vec<f64> = x.iter().map(|value| STEP * value.abs().max(0.1)).collect();
        let moved = |(k, side): (usize, f64)| {
            let mut x = x.clone();
            x[k] += side * steps[k];
            x
        };
        let sides = (0..parameters).flat_map(|k| [(k, 1.0), (k, -1.0)]).map(moved);
        let at: Vec<DVector<f64>> = sides.chain([x.clone()]).collect();
        let found = residuals_of(self, &at);
        let here = &found[2 * parameters];
        let mut matrix = DMatrix::zeros(parameters, parameters);
        let mut gradient = DVector::zeros(parameters);
        let mut row = vec![0.0; parameters];
        for (n, &residual) in here.iter().enumerate() {
            for (k, value) in row.iter_mut().enumerate() {
                *value = (found[2 * k][n] - found[2 * k + 1][n]) / (2.0 * steps[k]);
            }
            let [weight, _] = P::robust(residual);
            for a in 0..parameters {
                gradient[a] += weight * row[a] * residual;
                for b in 0..=a {
                    matrix[(a, b)] += weight * row[a] * row[b];
                }
            }
        }
        let count = here.len().max(1) as f64;
        NormalEquations { matrix: matrix / count, gradient: gradient / count }
    }
}
