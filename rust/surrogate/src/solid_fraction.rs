//! Sum-of-areas solid fraction as a function of the porosity of a packed state.

use crate::SurrogateError;
use crate::dataset::StateRow;
use crate::document::field;
use crate::least_squares;
use crate::network::WEIGHT_LIMIT;
use crate::scaling::Range;
use serde::{Deserialize, Serialize};

/// Least-squares polynomial: solid fraction = Σ c_i η^i for packed states. It is the sum of disc areas over the box
/// area, in which overlaps count twice, so that ρ · fraction is the true mass per area. The paper's ρ (1 − η) loses the
/// mass of the overlaps.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct SolidFraction {
    /// c_0, c_1, …
    pub coefficients: Vec<f64>,
    /// Range of porosities of the fit; others are clamped to it.
    pub porosity: Range,
    /// Root mean square of the fit's residuals [-].
    pub residual: f64,
}

impl SolidFraction {
    /// Fit to the packed states (stop 0) among the rows.
    ///
    /// # Errors
    /// [`SurrogateError::Data`] when there is no such state.
    pub fn fit(rows: &[StateRow]) -> Result<Self, SurrogateError> {
        let packed = rows.iter().filter(|row| row.stop == 0);
        Self::of(packed.map(|row| (row.porosity, 1.0 - row.porosity_sum_of_areas)))
    }

    /// Fit to porosities and solid fractions of packed states.
    ///
    /// # Errors
    /// [`SurrogateError::Data`] when there is none.
    pub fn of(packed: impl Iterator<Item = (f64, f64)>) -> Result<Self, SurrogateError> {
        let packed: Vec<(f64, f64)> = packed.collect();
        if packed.is_empty() {
            return Err(SurrogateError::Data("no packed state (stop 0)".to_string()));
        }
        let powers = |eta: f64| [1.0, eta, eta * eta];
        let coefficients = least_squares::fit(packed.iter().map(|(eta, solid)| (powers(*eta), *solid, 1.0)));
        let error = |(eta, solid): &(f64, f64)| {
            powers(*eta).iter().zip(&coefficients).map(|(x, c)| x * c).fold(-solid, |sum, term| sum + term)
        };
        let square = packed.iter().map(|row| error(row) * error(row)).fold(0.0, |sum, term| sum + term);
        let residual = (square / packed.len() as f64).sqrt();
        let porosity = Range::of(packed.iter().map(|(eta, _)| *eta));
        Ok(Self { coefficients: coefficients.to_vec(), porosity, residual })
    }

    /// Returns an error for values that no fit can give.
    pub(crate) fn check(&self) -> Result<(), SurrogateError> {
        let Range { min, max } = self.porosity;
        if !(0.0 <= min && min <= max && max <= 1.0) {
            return field("solid_fraction.porosity", format!("{min} to {max}"), "0 <= min <= max <= 1");
        }
        let unsound = |c: &&f64| c.is_nan() || c.abs() > WEIGHT_LIMIT;
        match self.coefficients.iter().find(unsound) {
            Some(value) => field("solid_fraction.coefficients", value, "-1e9 to 1e9"),
            None => Ok(()),
        }
    }

    /// Sum-of-areas solid fraction [-] of a packed state of this porosity.
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
