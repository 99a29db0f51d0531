//! Linear least squares with a few unknowns, in one fixed order of operations, so that every machine gives the same
//! bits.

use nalgebra::{Cholesky, DMatrix, DVector};

/// Added to the diagonal of the normal equations, which is scaled to 1. When features are linearly dependent, the
/// coefficients are then shared between them.
const RIDGE: f64 = 1e-10;

/// Number of iterative refinements of the solution, which remove the effect of the addition where the features are
/// independent.
const REFINEMENTS: usize = 4;

/// Coefficients c that minimise Σ w (c·x − y)², from samples (x, y, w); all zero when no sample has weight.
pub fn fit<const N: usize>(samples: impl Iterator<Item = ([f64; N], f64, f64)>) -> [f64; N] {
    let (mut matrix, mut right) = ([[0.0; N]; N], [0.0; N]);
    for (x, y, weight) in samples {
        for i in 0..N {
            for j in 0..=i {
                matrix[i][j] += weight * x[i] * x[j];
            }
            right[i] += weight * x[i] * y;
        }
    }
    let scale: [f64; N] = std::array::from_fn(|i| match matrix[i][i].sqrt() {
        norm if norm > 0.0 => 1.0 / norm,
        _ => 0.0,
    });
    let scaled =
        DMatrix::from_fn(
            N,
            N,
            |i, j| {
                if i == j { 1.0 } else { matrix[i.max(j)][i.min(j)] * scale[i] * scale[j] }
            },
        );
    let right = DVector::from_fn(N, |i, _| right[i] * scale[i]);
    let Some(factors) = Cholesky::new(&scaled + DMatrix::identity(N, N) * RIDGE) else { return [0.0; N] };
    let mut solution = factors.solve(&right);
    for _ in 0..REFINEMENTS {
        let residual =
            DVector::from_fn(N, |i, _| (0..N).fold(right[i], |sum, j| sum - scaled[(i, j)] * solution[j]));
        solution += factors.solve(&residual);
    }
    std::array::from_fn(|i| solution[i] * scale[i])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn recovers_a_plane_and_ignores_weight_zero() {
        let sample = |i: usize| {
            let (x, z) = ((i as f64 * 0.7).sin(), i as f64);
            let wrong = if i == 5 { 100.0 } else { 0.0 };
            ([1.0, x, z], 0.3 - 2.0 * x + 0.01 * z + wrong, if i == 5 { 0.0 } else { 1.0 })
        };
        let found = fit((0..40).map(sample));
        for (found, expected) in found.iter().zip([0.3, -2.0, 0.01]) {
            assert!((found - expected).abs() < 1e-8, "{found} against {expected}");
        }
        assert_eq!(fit(std::iter::empty::<([f64; 2], f64, f64)>()), [0.0; 2]);
    }
}
