//! The mean packed state as a function of porosity and fabric, which is assumed where the stress at the start is not known.

use crate::SurrogateError;
use crate::document::field;
use crate::least_squares;
use crate::network::WEIGHT_LIMIT;
use crate::scaling::Range;
use crate::tracks::Point;
use serde::{Deserialize, Serialize};

/// Least-squares fits over packed states.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct MeanStress {
    /// Range of porosities of the fit; others are clamped to it.
    pub porosity: Range,
    /// p̃ = Σ c_i η^i.
    pub pressure: [f64; 4],
    /// q̃/p̃ = F (c_0 + c_1 η), with the fabric F = (F_xx − F_yy, 2 F_xy).
    pub stress_ratio: [f64; 2],
    /// Root mean square of the residuals of p̃ and of a component of q̃/p̃.
    pub residuals: [f64; 2],
}

/// Largest component of q̃/p̃ that the fit may give.
const RATIO_LIMIT: f64 = 0.5;

impl MeanStress {
    /// The fits to states as packed.
    pub fn fit(packed: &[Point]) -> Self {
        let loaded: Vec<&Point> =
            packed.iter().filter(|p| p.load_bearing && p.invariants()[0] > 0.0).collect();
        let pressure = loaded.iter().map(|point| {
            let eta = point.porosity;
            ([1.0, eta, eta * eta, eta * eta * eta], point.invariants()[0], 1.0)
        });
        let ratio = loaded.iter().flat_map(|point| {
            let [p, q1, q2] = point.invariants();
            let row = |f: f64, q: f64| ([f, f * point.porosity], q / p, 1.0);
            [Some(row(point.fabric_index, q1)), point.fabric_shear.map(|f| row(f, q2))].into_iter().flatten()
        });
        let mut mean = Self {
            porosity: Range::of(loaded.iter().map(|point| point.porosity)),
            pressure: least_squares::fit(pressure),
            stress_ratio: least_squares::fit(ratio),
            residuals: [0.0; 2],
        };
        let mut squares = [0.0; 2];
        for point in &loaded {
            let [p, q1, _] = point.invariants();
            let [found, along, _] = mean.at(point.porosity, [point.fabric_index, 0.0]);
            squares[0] += (found - p).powi(2);
            squares[1] += if found > 0.0 { (along / found - q1 / p).powi(2) } else { 0.0 };
        }
        mean.residuals = squares.map(|square| (square / loaded.len().max(1) as f64).sqrt());
        mean
    }

    /// p̃, q̃₁, q̃₂ at a porosity and a fabric.
    pub fn at(&self, porosity: f64, fabric: [f64; 2]) -> [f64; 3] {
        let eta = self.porosity.clamp(porosity);
        let pressure = self.pressure.iter().rev().fold(0.0, |sum, c| sum * eta + c).max(0.0);
        let [c0, c1] = self.stress_ratio;
        let [along, across] = fabric.map(|f| (f * (c0 + c1 * eta)).clamp(-RATIO_LIMIT, RATIO_LIMIT));
        [pressure, pressure * along, pressure * across]
    }

    /// # Errors
    /// [`SurrogateError::Field`] for values that no fit can give.
    pub fn check(&self) -> Result<(), SurrogateError> {
        let Range { min, max } = self.porosity;
        if !(0.0 <= min && min <= max && max <= 1.0) {
            return field("mean_stress.porosity", format!("{min} to {max}"), "0 <= min <= max <= 1");
        }
        let all = self.pressure.iter().chain(&self.stress_ratio);
        match all.into_iter().find(|value| value.is_nan() || value.abs() > WEIGHT_LIMIT) {
            Some(value) => field("mean_stress (a coefficient)", value, "-1e9 to 1e9"),
            None => Ok(()),
        }
    }
}
