//! Fit of the rates to composed increments along whole ramps, which is how a solver uses them, together with single
//! large steps.
//!
//! With single steps alone, small steps would be learnt only from those near the packed states, where the response is
//! stiffest, and the fit would apply that to every small step: the composed deviator then drifts. So residuals of both
//! kinds are used.

use super::fit::PerceptronFit;
use super::pairs::{self, Track};
use super::rates::{EVEN_OUTPUTS, RateInputs, Rates, direction};
use super::variables::{FeatureRanges, POROSITY, PRESSURE, Variables};
use crate::kernel::{LANES, add_outer_products};
use crate::levenberg_marquardt::{LeastSquares, NormalEquations};
use crate::perceptron::{Neurons, Perceptron, WIDTH};
use crate::surrogate::{MAX_STATE, StateLanes, VIRGIN};
use nalgebra::DVector;

/// The residuals of single steps and of tracks (whole ramps in increments) together.
pub struct RatesFit<'a> {
    pub single: PerceptronFit,
    pub tracks: Vec<Track>,
    pub variables: Variables,
    pub ranges: &'a FeatureRanges,
    pub rates: &'a Rates,
}

/// Perturbation of the state for forward differences; the state's variables are of order 0.1.
const PERTURBATION: f64 = 1e-7;

impl RatesFit<'_> {
    fn with(&self, parameters: &DVector<f64>) -> Rates {
        let network =
            Perceptron { sizes: self.rates.network.sizes.clone(), weights: parameters.as_slice().to_vec() };
        Rates { network, ..self.rates.clone() }
    }

    /// Follows a track in increments; calls `row` with each residual and, when `gradient` is set, its gradient with
    /// respect to the weights.
    fn follow(&self, rates: &Rates, track: &Track, gradient: bool, mut row: impl FnMut(f64, &[f64])) {
        let (names, weights) = (self.variables.names().len(), rates.network.weights.len());
        let mut sensitivity = vec![vec![0.0; if gradient { weights } else { 0 }]; names];
        let mut state = track.start;
        let mut neurons = Neurons::new();
        let mut scaled = vec![0.0; if gradient { weights } else { 0 }];
        for stop in &track.stops {
            for strain in stop.increments() {
                state = self.step(rates, &state, strain, &mut neurons, gradient.then_some(&mut sensitivity));
            }
            for column in 0..names {
                let weight = pairs::end_weight(self.variables, column, &stop.to);
                if weight == 0.0 || !(stop.to.jammed || column == POROSITY || column == PRESSURE) {
                    continue;
                }
                if gradient {
                    scaled.iter_mut().zip(&sensitivity[column]).for_each(|(s, d)| *s = weight * d);
                }
                row(weight * (state[column] - stop.to.state[column]), &scaled);
            }
        }
    }

    /// Advances one state by one increment, and also its sensitivity S to the weights w: S' = (∂x'/∂x) S + ∂x'/∂w.
    fn step(
        &self,
        rates: &Rates,
        state: &[f64; MAX_STATE],
        strain: f64,
        neurons: &mut Neurons,
        sensitivity: Option<&mut Vec<Vec<f64>>>,
    ) -> [f64; MAX_STATE] {
        // Lane 0 holds the state itself; each other lane is perturbed in one variable.
        let lanes: StateLanes = std::array::from_fn(|column| {
            std::array::from_fn(|lane| state[column] + if lane == column + 1 { PERTURBATION } else { 0.0 })
        });
        // The features are those of zero strain: the rate in the limit of many increments. How large strains differ is
        // learnt from the single steps.
        let features = &self.ranges.features(self.variables, &lanes, &[0.0; LANES]);
        let (variables, strain_lanes) = (self.variables, [strain; LANES]);
        let from = RateInputs { variables, state: &lanes, strain: &strain_lanes, virgin: &VIRGIN, features };
        let mut next = lanes;
        rates.advance(from, neurons, &mut next);
        let Some(sensitivity) = sensitivity else { return next.map(|column| column[0]) };
        let names = self.variables.names().len();
        let old = std::mem::take(sensitivity);
        let count = self.variables.odd_count();
        for column in 0..names {
            let mut row = vec![0.0; rates.network.weights.len()];
            let cut = next[PRESSURE][0] == 0.0 && column != POROSITY;
            if !cut {
                let mut c = [0.0; WIDTH];
                let by_output = strain * rates.scale[column];
                match self.variables.odd().position(|odd| odd == column) {
                    Some(k) => {
                        let first = EVEN_OUTPUTS + k * (count + 1);
                        for (i, odd) in features.odd[..count].iter().enumerate() {
                            c[first + i] = by_output * odd[0];
                        }
                        c[first + count] = by_output * direction(strain) * features.odd[k][0];
                    }
                    None => c[usize::from(column == PRESSURE)] = by_output,
                }
                rates.network.gradient(neurons, 0, &c[..rates.network.outputs()], &mut row);
            }
            for (by, old) in old.iter().enumerate() {
                let slope = (next[column][by + 1] - next[column][0]) / PERTURBATION;
                row.iter_mut().zip(old).for_each(|(row, old)| *row += slope * old);
            }
            sensitivity.push(row);
        }
        next.map(|column| column[0])
    }

    fn track_count(&self) -> f64 {
        let mut count = 0.0;
        let rates = self.rates;
        self.tracks.iter().for_each(|track| self.follow(rates, track, false, |_, _| count += 1.0));
        count
    }
}

impl LeastSquares for RatesFit<'_> {
    fn mean_square(&self, parameters: &DVector<f64>) -> f64 {
        let rates = self.with(parameters);
        let (mut sum, mut count) = (0.0, 0.0);
        for track in &self.tracks {
            self.follow(&rates, track, false, |residual, _| {
                sum += residual * residual;
                count += 1.0;
            });
        }
        let single = self.single.count();
        (sum + single * self.single.mean_square(parameters)) / (single + count)
    }

    fn normal_equations(&self, parameters: &DVector<f64>) -> NormalEquations {
        let rates = self.with(parameters);
        let weights = parameters.len();
        let mut matrix = self.single.summed_products(&rates.network);
        let width = PerceptronFit::width(weights);
        let mut rows = Vec::new();
        for track in &self.tracks {
            rows.clear();
            self.follow(&rates, track, true, |residual, gradient| {
                let start = rows.len();
                rows.extend_from_slice(gradient);
                rows.push(residual);
                rows.resize(start + width, 0.0);
            });
            add_outer_products(&rows, width, &mut matrix);
        }
        PerceptronFit::equations(&matrix, weights, self.single.count() + self.track_count())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::state::training::StateOptions;
    use crate::{dataset, scaling, state::variables::ConductivityKind, synthetic};

    #[test]
    fn gradient_along_tracks_is_that_of_the_mean_square() {
        let (variables, kind) = (Variables::ALL, ConductivityKind::Affine);
        let mut ramps = dataset::ramps(&synthetic::rows(8, 4)).expect("good rows");
        // Only ramps away from unjamming, where the derivative of the state is discontinuous.
        ramps.retain(|ramp| ramp.states.iter().all(|row| row.stress_xx + row.stress_yy > 0.02));
        assert!(ramps.len() > 6);
        let pairs = pairs::pairs(variables, kind, &ramps);
        let strains = scaling::Range::of(pairs.iter().map(|pair| pair.strain));
        let ranges = FeatureRanges::of(&pairs::points(variables, kind, &ramps), strains);
        let mut rates = pairs::blank_rates(variables, &StateOptions::default().hidden, &pairs, &ramps);
        rates.network = Perceptron::initial(&rates.network.sizes, 5, 1);
        let fit = RatesFit {
            single: PerceptronFit::new(rates.network.sizes.clone(), &[], 1),
            tracks: pairs::tracks(variables, kind, &ramps),
            variables,
            ranges: &ranges,
            rates: &rates,
        };
        let start = DVector::from_vec(rates.network.weights.clone());
        let equations = fit.normal_equations(&start);
        for index in (0..start.len()).step_by(7) {
            let at = |by: f64| {
                let mut moved = start.clone();
                moved[index] += by;
                fit.mean_square(&moved)
            };
            let numeric = (at(1e-6) - at(-1e-6)) / 2e-6 / 2.0;
            let analytic = equations.gradient[index];
            let largest = equations.gradient.amax();
            assert!(
                (analytic - numeric).abs() < 1e-4 * largest,
                "{index}: {analytic} against {numeric}, largest {largest}"
            );
        }
    }
}
