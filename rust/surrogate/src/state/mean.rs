//! The mean packed state as a function of porosity and fabric index, which is assumed when the stress at the start is
//! not known.

use super::variables::{FABRIC_INDEX, POROSITY, PRESSURE, Point, stress_ratio};
use crate::least_squares;
use crate::scaling::Range;
use serde::{Deserialize, Serialize};

/// Least-squares fits over packed states.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct MeanState {
    /// Range of porosities of the fit; others are clamped to it.
    pub porosity: Range,
    /// p̃ = Σ c_i η^i.
    pub pressure: [f64; 4],
    /// q̃/p̃ = f (c_0 + c_1 η).
    pub stress_ratio_of_fabric: [f64; 2],
    /// q̃/p̃ = f_K (c_0 + c_1 η) + f (c_2 + c_3 η).
    pub stress_ratio_of_both: [f64; 4],
    /// f_K = f (c_0 + c_1 η).
    pub fabric_conductivity_of_fabric: [f64; 2],
    /// f_K = q̃/p̃ (c_0 + c_1 η) + f (c_2 + c_3 η).
    pub fabric_conductivity_of_both: [f64; 4],
    /// Root mean square of the residuals of p̃ [-], of q̃/p̃ from f, of f_K from f.
    pub residuals: [f64; 3],
}

/// The quantities of the state besides η and f.
pub struct Filled {
    pub pressure: f64,
    pub deviator: f64,
    pub fabric_conductivity: f64,
}

/// Largest |q̃/p̃| and |f_K| that a fit may give.
const RATIO_LIMIT: f64 = 0.5;

impl MeanState {
    /// Fits the laws to packed states.
    pub fn fit(points: &[Point]) -> Self {
        let jammed: Vec<&Point> = points.iter().filter(|p| p.jammed).collect();
        let eta = |p: &Point| p.state[POROSITY];
        let f = |p: &Point| p.state[FABRIC_INDEX];
        let powers = |eta: f64| [1.0, eta, eta * eta, eta * eta * eta];
        let one = |odd: f64, eta: f64| [odd, odd * eta];
        let two = |a: f64, b: f64, eta: f64| [a, a * eta, b, b * eta];
        let samples = || jammed.iter();
        let mut mean = Self {
            porosity: Range::of(samples().map(|p| eta(p))),
            pressure: least_squares::fit(samples().map(|p| (powers(eta(p)), p.state[PRESSURE], 1.0))),
            stress_ratio_of_fabric: least_squares::fit(
                samples().map(|p| (one(f(p), eta(p)), p.stress_ratio, 1.0)),
            ),
            stress_ratio_of_both: least_squares::fit(
                samples().map(|p| (two(p.fabric_conductivity, f(p), eta(p)), p.stress_ratio, 1.0)),
            ),
            fabric_conductivity_of_fabric: least_squares::fit(
                samples().map(|p| (one(f(p), eta(p)), p.fabric_conductivity, 1.0)),
            ),
            fabric_conductivity_of_both: least_squares::fit(
                samples().map(|p| (two(p.stress_ratio, f(p), eta(p)), p.fabric_conductivity, 1.0)),
            ),
            residuals: [0.0; 3],
        };
        let rms = |error: &dyn Fn(&Point) -> f64| {
            (samples().map(|p| error(p) * error(p)).sum::<f64>() / jammed.len().max(1) as f64).sqrt()
        };
        mean.residuals = [
            rms(&|p| mean.filled(eta(p), f(p), None, None).pressure - p.state[PRESSURE]),
            rms(&|p| mean.ratio(eta(p), f(p), None) - p.stress_ratio),
            rms(&|p| mean.fabric(eta(p), f(p), None) - p.fabric_conductivity),
        ];
        mean
    }

    /// p̃, q̃ and f_K of a cell from η and f, and from f_K or the reduced stress (p̃, q̃) where these are known.
    pub fn filled(&self, eta: f64, f: f64, fabric: Option<f64>, stress: Option<[f64; 2]>) -> Filled {
        let eta = self.porosity.clamp(eta);
        let [pressure, deviator] = stress.unwrap_or_else(|| {
            let pressure = self.pressure.iter().rev().fold(0.0, |sum, c| sum * eta + c).max(0.0);
            [pressure, pressure * self.ratio(eta, f, fabric)]
        });
        let ratio = stress.map(|[p, q]| stress_ratio(q, p));
        let fabric_conductivity = fabric.unwrap_or_else(|| self.fabric(eta, f, ratio));
        Filled { pressure, deviator, fabric_conductivity }
    }

    fn ratio(&self, eta: f64, f: f64, fabric: Option<f64>) -> f64 {
        odd(eta, f, fabric, &self.stress_ratio_of_fabric, &self.stress_ratio_of_both)
    }

    fn fabric(&self, eta: f64, f: f64, ratio: Option<f64>) -> f64 {
        odd(eta, f, ratio, &self.fabric_conductivity_of_fabric, &self.fabric_conductivity_of_both)
    }
}

fn odd(eta: f64, f: f64, other: Option<f64>, alone: &[f64; 2], both: &[f64; 4]) -> f64 {
    let value = match other {
        None => f * (alone[0] + alone[1] * eta),
        Some(other) => other * (both[0] + both[1] * eta) + f * (both[2] + both[3] * eta),
    };
    value.clamp(-RATIO_LIMIT, RATIO_LIMIT)
}
