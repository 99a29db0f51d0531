//! Levenberg–Marquardt: (JᵀJ + μ I) step = −Jᵀr, with μ between gradient descent (large) and Gauss–Newton (small).
//! Damping as in Hagan and Menhaj (1994), which the paper's toolbox uses.

use nalgebra::{Cholesky, DMatrix, DVector};
use serde::{Deserialize, Serialize};
use std::ops::ControlFlow;

/// A mean of squared residuals to be minimised; without a factor ½, so its gradient is 2 Jᵀr / n.
pub trait LeastSquares {
    /// rᵀr / n at `parameters`.
    fn mean_square(&self, parameters: &DVector<f64>) -> f64;
    /// The normal equations at `parameters`.
    fn normal_equations(&self, parameters: &DVector<f64>) -> NormalEquations;
}

/// JᵀJ / n (lower triangle; the upper one is not read) and Jᵀr / n.
pub struct NormalEquations {
    pub matrix: DMatrix<f64>,
    pub gradient: DVector<f64>,
}

/// Why the minimisation ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Stopping {
    /// The `watch` function ended it: no better validation error for the given number of epochs.
    ValidationStalled,
    /// The given number of epochs was reached.
    MaxEpochs,
    /// |Jᵀr / n| below the limit: a minimum.
    GradientSmall,
    /// No step, however short, lowers the error: a minimum to rounding.
    DampingLimit,
}

/// Conditions under which the minimisation ends.
#[derive(Clone, Copy, Debug)]
pub struct Limits {
    pub max_epochs: u32,
    /// Limit for the largest component of Jᵀr / n.
    pub gradient: f64,
}

/// Result of a minimisation.
pub struct Minimum {
    pub parameters: DVector<f64>,
    pub mean_square: f64,
    pub epochs: u32,
    pub stopping: Stopping,
}

/// μ at the start; like the equations it is divided by n. Paper: "learning rate 10⁻⁴".
const DAMPING_START: f64 = 1e-4;
const DAMPING_UP: f64 = 10.0;
const DAMPING_DOWN: f64 = 0.1;
/// For a smaller μ, rounding errors in JᵀJ dominate.
const DAMPING_MIN: f64 = 1e-15;
const DAMPING_MAX: f64 = 1e10;

/// Minimises from `start`. After each epoch (one step taken) `watch` is called with the number of the epoch, the
/// parameters and their mean square; it may end the minimisation.
pub fn minimise<P: LeastSquares>(
    problem: &P,
    start: DVector<f64>,
    limits: Limits,
    mut watch: impl FnMut(u32, &DVector<f64>, f64) -> ControlFlow<()>,
) -> Minimum {
    let mut parameters = start;
    let mut mean_square = problem.mean_square(&parameters);
    let mut damping = DAMPING_START;
    let mut epochs = 0;
    let stopping = loop {
        if epochs == limits.max_epochs {
            break Stopping::MaxEpochs;
        }
        let equations = problem.normal_equations(&parameters);
        if equations.gradient.amax() <= limits.gradient {
            break Stopping::GradientSmall;
        }
        let Some(step) = descent(problem, &equations, &parameters, mean_square, &mut damping) else {
            break Stopping::DampingLimit;
        };
        (parameters, mean_square) = step;
        damping = (damping * DAMPING_DOWN).max(DAMPING_MIN);
        epochs += 1;
        if watch(epochs, &parameters, mean_square).is_break() {
            break Stopping::ValidationStalled;
        }
    };
    Minimum { parameters, mean_square, epochs, stopping }
}

/// Raises the damping until a step lowers the error; `None` when no damping does.
fn descent<P: LeastSquares>(
    problem: &P,
    equations: &NormalEquations,
    from: &DVector<f64>,
    mean_square: f64,
    damping: &mut f64,
) -> Option<(DVector<f64>, f64)> {
    while *damping <= DAMPING_MAX {
        let mut matrix = equations.matrix.clone();
        for i in 0..matrix.nrows() {
            matrix[(i, i)] += *damping;
        }
        // When rounding errors make the matrix not positive definite, more damping is tried.
        if let Some(factors) = Cholesky::new(matrix) {
            let parameters = from - factors.solve(&equations.gradient);
            let reached = problem.mean_square(&parameters);
            if reached < mean_square {
                return Some((parameters, reached));
            }
        }
        *damping *= DAMPING_UP;
    }
    None
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Rosenbrock's valley, r = (10 (y − x²), 1 − x): minimum 0 at (1, 1).
    struct Rosenbrock;

    impl LeastSquares for Rosenbrock {
        fn mean_square(&self, p: &DVector<f64>) -> f64 {
            ((10.0 * (p[1] - p[0] * p[0])).powi(2) + (1.0 - p[0]).powi(2)) / 2.0
        }
        fn normal_equations(&self, p: &DVector<f64>) -> NormalEquations {
            let jacobian = DMatrix::from_row_slice(2, 2, &[-20.0 * p[0], 10.0, -1.0, 0.0]);
            let residual = DVector::from_vec(vec![10.0 * (p[1] - p[0] * p[0]), 1.0 - p[0]]);
            let transposed = jacobian.transpose();
            NormalEquations { matrix: &transposed * jacobian / 2.0, gradient: transposed * residual / 2.0 }
        }
    }

    #[test]
    fn finds_the_minimum_of_rosenbrocks_valley() {
        let limits = Limits { max_epochs: 100, gradient: 1e-12 };
        let start = DVector::from_vec(vec![-1.2, 1.0]);
        let minimum = minimise(&Rosenbrock, start, limits, |_, _, _| ControlFlow::Continue(()));
        assert_eq!(minimum.stopping, Stopping::GradientSmall);
        assert!(minimum.epochs < 50, "{} epochs", minimum.epochs);
        assert!((minimum.parameters - DVector::from_vec(vec![1.0, 1.0])).amax() < 1e-9);
    }

    #[test]
    fn stops_for_the_stated_reason() {
        let run = |max_epochs, at: f64, end: u32| {
            let limits = Limits { max_epochs, gradient: 0.0 };
            let watch = |epoch, _: &_, _| {
                if epoch == end { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
            };
            minimise(&Rosenbrock, DVector::from_vec(vec![at, 1.0]), limits, watch)
        };
        assert_eq!(run(3, -1.2, 9).stopping, Stopping::MaxEpochs);
        assert_eq!(run(9, -1.2, 2).epochs, 2);
        assert_eq!(run(9, -1.2, 2).stopping, Stopping::ValidationStalled);
        assert_eq!(run(9, 1.0, 2).stopping, Stopping::GradientSmall);
    }
}
