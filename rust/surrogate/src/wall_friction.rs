//! Wall friction: the part of the friction that is mobilised when a wall slips along the grains.

use crate::SurrogateError;
use crate::document::field;
use crate::levenberg_marquardt::{LeastSquares, Limits, NormalEquations, minimise};
use nalgebra::{DMatrix, DVector};
use serde::{Deserialize, Serialize};
use std::ops::ControlFlow;

/// A measured value: friction mobilised at a slip.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WallSlip {
    /// Slip of the wall over the mean radius [-].
    pub slip: f64,
    /// Shear over normal force on the wall [-].
    pub friction: f64,
}

/// Law μ(s) = μ_∞ s/(s + s_0), with the slip s in mean radii.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct WallFriction {
    /// μ_∞ [-], the limit at large slip.
    pub limit: f64,
    /// s_0 [mean radii]: the slip at which half of the limit is mobilised; μ_∞/s_0 is the stiffness before sliding.
    pub slip: f64,
    pub samples: usize,
    /// Root mean square of the residuals [-].
    pub scatter: f64,
}

struct Fit<'a>(&'a [WallSlip]);

impl Fit<'_> {
    /// Residual and its derivatives with respect to μ_∞ and s_0.
    fn residual(p: &DVector<f64>, sample: &WallSlip) -> (f64, [f64; 2]) {
        let share = sample.slip / (sample.slip + p[1].abs());
        let by_slip = -p[0] * share / (sample.slip + p[1].abs()) * p[1].signum();
        (p[0] * share - sample.friction, [share, by_slip])
    }
}

impl LeastSquares for Fit<'_> {
    fn mean_square(&self, p: &DVector<f64>) -> f64 {
        self.0.iter().map(|s| Self::residual(p, s).0.powi(2)).fold(0.0, |a, b| a + b) / self.0.len() as f64
    }

    fn normal_equations(&self, p: &DVector<f64>) -> NormalEquations {
        let (mut matrix, mut gradient) = (DMatrix::zeros(2, 2), DVector::zeros(2));
        for sample in self.0 {
            let (residual, slope) = Self::residual(p, sample);
            for i in 0..2 {
                gradient[i] += slope[i] * residual / self.0.len() as f64;
                for j in 0..2 {
                    matrix[(i, j)] += slope[i] * slope[j] / self.0.len() as f64;
                }
            }
        }
        NormalEquations { matrix, gradient }
    }
}

impl WallFriction {
    /// `None` with fewer than ten samples of positive slip.
    pub fn fit(samples: &[WallSlip]) -> Option<Self> {
        let moved: Vec<WallSlip> = samples.iter().copied().filter(|s| s.slip > 0.0).collect();
        if moved.len() < 10 {
            return None;
        }
        let limits = Limits { max_epochs: 200, gradient: 1e-14 };
        let start = DVector::from_vec(vec![0.4, 0.3]);
        let minimum = minimise(&Fit(&moved), start, limits, |_, _, _| ControlFlow::Continue(()));
        Some(Self {
            limit: minimum.parameters[0],
            slip: minimum.parameters[1].abs(),
            samples: moved.len(),
            scatter: minimum.mean_square.sqrt(),
        })
    }

    /// Returns an error for values that no fit can give.
    pub(crate) fn check(&self) -> Result<(), SurrogateError> {
        if self.limit.abs() <= 1e3 && self.slip > 0.0 && self.slip <= 1e6 {
            return Ok(());
        }
        let found = format!("limit {}, slip {}", self.limit, self.slip);
        field("wall_friction", found, "limit to 1e3, slip above 0, to 1e6")
    }

    /// Mobilised friction [-] at a slip [mean radii] of either sign.
    pub fn at(&self, slip: f64) -> f64 {
        self.limit * slip / (slip.abs() + self.slip)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn recovers_the_law_that_made_the_samples() {
        let law = WallFriction { limit: 0.27, slip: 0.6, samples: 30, scatter: 0.0 };
        let samples: Vec<WallSlip> = (0..31)
            .map(|i| 0.1 * f64::from(i))
            .map(|slip| WallSlip { slip, friction: law.at(slip) })
            .collect();
        let found = WallFriction::fit(&samples).expect("enough samples");
        assert!((found.limit - 0.27).abs() < 1e-6 && (found.slip - 0.6).abs() < 1e-6, "{found:?}");
        assert!(found.scatter < 1e-7 && found.samples == 30);
        assert!(found.at(-0.6) < 0.0 && (found.at(1e9) - 0.27).abs() < 1e-6);
        assert!(WallFriction::fit(&samples[..5]).is_none());
    }
}
