//! Drift of the paper's network: error of the state after many composed increments, as in a macroscale solver.

use crate::composition::increment;
use crate::dataset::{Ramp, strain_between};
use crate::predictor::Predictor;
use serde::{Deserialize, Serialize};

/// Errors at the ends of ramps of held-out packings, starting from their packed states.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Drift {
    /// Mean strain of the ramps' last stops [-].
    pub strain: f64,
    /// Number of increments in which the strain was applied.
    pub increments: u32,
    /// Number of ramps in the mean.
    pub ramps: usize,
    /// Root mean square error of Kxx and Kyy over their root mean square [-].
    pub conductivity: f64,
    /// Root mean square error of σxx and σyy over their root mean square [-].
    pub stress: f64,
    /// Root mean square error of η [-].
    pub porosity: f64,
}

/// A single step, and as many as a macroscale run takes while the front of a heat wave passes.
const INCREMENTS: [u32; 2] = [1, 500];

/// Drift of expansion, then of contraction; a direction without ramps has no entry.
pub fn drifts(predictor: &Predictor, ramps: &[Ramp]) -> Vec<Drift> {
    let end = |ramp: &&Ramp| ramp.states.last().map_or(0.0, |state| state.strain);
    let up: Vec<&Ramp> = ramps.iter().filter(|ramp| end(ramp) > 0.0).collect();
    let down: Vec<&Ramp> = ramps.iter().filter(|ramp| end(ramp) < 0.0).collect();
    let sides = [up, down].into_iter().filter(|ramps| !ramps.is_empty());
    sides.flat_map(|ramps| INCREMENTS.map(|increments| drift(predictor, &ramps, increments))).collect()
}

fn drift(predictor: &Predictor, ramps: &[&Ramp], increments: u32) -> Drift {
    let (mut strain, mut porosity) = (0.0, 0.0);
    let (mut conductivity, mut stress) = ([0.0; 2], [0.0; 2]); // squares of error, of value
    for ramp in ramps {
        let (first, last) = (&ramp.states[0], &ramp.states[ramp.states.len() - 1]);
        let total = strain_between(first, last);
        let end = composed(predictor, first.porosity, first.fabric_index, total, increments);
        strain += total / ramps.len() as f64;
        porosity += (end[0] - last.porosity).powi(2) / ramps.len() as f64;
        let predicted = [end[1], end[2], end[3], end[4]];
        let data = [last.conductivity_xx, last.conductivity_yy, last.stress_xx, last.stress_yy];
        for (component, (predicted, data)) in predicted.iter().zip(data).enumerate() {
            let sums = if component < 2 { &mut conductivity } else { &mut stress };
            sums[0] += (predicted - data).powi(2);
            sums[1] += data.powi(2);
        }
    }
    let relative = |[error, value]: [f64; 2]| if value > 0.0 { (error / value).sqrt() } else { 0.0 };
    Drift {
        strain,
        increments,
        ramps: ramps.len(),
        conductivity: relative(conductivity),
        stress: relative(stress),
        porosity: porosity.sqrt(),
    }
}

/// η, Kxx, Kyy, σxx, σyy after a strain in equal increments of the radii.
fn composed(
    predictor: &Predictor,
    mut porosity: f64,
    mut fabric_index: f64,
    total: f64,
    increments: u32,
) -> [f64; 5] {
    let mut end = predictor.evaluate(porosity, fabric_index, 0.0);
    for k in 0..increments {
        end = predictor.evaluate(porosity, fabric_index, increment(total, k, increments));
        porosity += end.delta_porosity;
        fabric_index += end.delta_fabric_index;
    }
    [porosity, end.conductivity_xx, end.conductivity_yy, end.stress_xx, end.stress_yy]
}
