//! Sum-of-areas solid fraction from the porosity of a packed state.

use crate::SurrogateError;
use crate::dataset::StateRow;
use crate::scaling::Range;
use nalgebra::{DMatrix, DVector};
use serde::{Deserialize, Serialize};

/// Least-squares polynomial: solid fraction = Σ c_i η^i for packed states. Overlaps count twice in it, so that
/// ρ · fraction is the true mass per area, where the paper's ρ (1 − η) loses the overlaps' mass.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct SolidFraction {
    /// c_0, c_1, …
    pub coefficients: Vec<f64>,
    /// Porosities of the fit; others are clamped to it.
    pub porosity: Range,
    /// Root mean square of the fit's residuals [-].
    pub residual: f64,
}

/// Degree of the polynomial when there are enough states.
const DEGREE: usize = 2;
/// Relative to the largest singular value.
const RANK_LIMIT: f64 = 1e-12;

impl SolidFraction {
    /// Fit to the packed states (stop 0) among the rows.
    ///
    /// # Errors
    /// [`SurrogateError::Data`] when there is no such state.
    pub fn fit(rows: &[StateRow]) -> Result<Self, SurrogateError> {
        let packed: Vec<&StateRow> = rows.iter().filter(|row| row.stop == 0).collect();
        if packed.is_empty() {
            return Err(SurrogateError::Data("no packed state (stop 0)".to_string()));
        }
        let columns = (DEGREE + 1).min(packed.len());
        let powers =
            DMatrix::from_fn(packed.len(), columns, |i, power| packed[i].porosity.powi(power as i32));
        let solid = DVector::from_fn(packed.len(), |i, _| 1.0 - packed[i].porosity_sum_of_areas);
        let decomposition = powers.clone().svd(true, true);
        let limit = RANK_LIMIT * decomposition.singular_values.max();
        let coefficients =
            decomposition.solve(&solid, limit).map_err(|e| SurrogateError::Data(e.to_string()))?;
        let residual = (&powers * &coefficients - solid).norm() / (packed.len() as f64).sqrt();
        let porosity = Range::of(packed.iter().map(|row| row.porosity));
        Ok(Self { coefficients: coefficients.as_slice().to_vec(), porosity, residual })
    }

    /// Solid fraction with overlaps counted twice [-] of a packed state of this porosity.
    pub fn at(&self, porosity: f64) -> f64 {
        let inside = self.porosity.clamp(porosity);
        self.coefficients.iter().rev().fold(0.0, |sum, c| sum * inside + c)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::synthetic;

    #[test]
    fn recovers_a_parabola_from_packed_states_alone() {
        let mut rows = synthetic::rows(9, 2);
        for row in &mut rows {
            let eta = row.porosity;
            let solid = 1.05 - 1.2 * eta + 0.7 * eta * eta;
            row.porosity_sum_of_areas = if row.stop == 0 { 1.0 - solid } else { 0.9 };
        }
        let fit = SolidFraction::fit(&rows).expect("packed states");
        for (found, expected) in fit.coefficients.iter().zip([1.05, -1.2, 0.7]) {
            assert!((found - expected).abs() < 1e-9);
        }
        assert!(fit.residual < 1e-12);
        assert!((fit.at(0.12) - (1.05 - 0.144 + 0.7 * 0.0144)).abs() < 1e-12);
        assert_eq!(fit.at(0.9), fit.at(fit.porosity.max));
    }
}
