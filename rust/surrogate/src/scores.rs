//! Coefficient of determination, Eq. 12.

use crate::dataset::Sample;
use crate::kernel::LANES;
use crate::network::{OUTPUTS, padded};
use crate::predictor::Predictor;
use serde::{Deserialize, Serialize};

/// R² of every output over some samples [-]; 1 is perfect. 0 also where the data does not vary.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Scores {
    pub delta_porosity: f64,
    /// Over samples whose states carry load.
    pub delta_fabric_index: f64,
    pub conductivity_xx: f64,
    pub conductivity_yy: f64,
    pub stress_xx: f64,
    pub stress_yy: f64,
    /// Both components (xx and yy) together.
    pub conductivity: f64,
    /// Both components (xx and yy) together.
    pub stress: f64,
}

/// 1 − Σ (D − P)² / Σ (D − \[D\])² over pairs (D, P) of data and prediction.
pub fn r_squared(pairs: &[[f64; 2]]) -> f64 {
    let mean = pairs.iter().map(|[data, _]| data).sum::<f64>() / pairs.len() as f64;
    let spread: f64 = pairs.iter().map(|[data, _]| (data - mean).powi(2)).sum();
    let error: f64 = pairs.iter().map(|[data, predicted]| (data - predicted).powi(2)).sum();
    if spread > 0.0 { 1.0 - error / spread } else { 0.0 }
}

/// Scores of the model in the form in which it is used: clamped inputs, zero increments for zero strain.
pub fn scores(predictor: &Predictor, samples: &[Sample]) -> Scores {
    let mut pairs: [Vec<[f64; 2]>; OUTPUTS] = Default::default();
    for chunk in samples.chunks(LANES) {
        let block =
            predictor.block(&std::array::from_fn(|k| padded(chunk.len(), |lane| chunk[lane].inputs[k])));
        let predicted = [
            block.delta_porosity,
            block.delta_fabric_index,
            block.conductivity_xx,
            block.conductivity_yy,
            block.stress_xx,
            block.stress_yy,
        ];
        for (lane, sample) in chunk.iter().enumerate() {
            for (o, pairs) in pairs.iter_mut().enumerate().filter(|(o, _)| *o != 1 || sample.fabric_known) {
                pairs.push([sample.outputs[o], predicted[o][lane]]);
            }
        }
    }
    let [delta_porosity, delta_fabric_index, conductivity_xx, conductivity_yy, stress_xx, stress_yy] =
        std::array::from_fn(|o| r_squared(&pairs[o]));
    let [_, _, kxx, kyy, sxx, syy] = pairs;
    Scores {
        delta_porosity,
        delta_fabric_index,
        conductivity_xx,
        conductivity_yy,
        stress_xx,
        stress_yy,
        conductivity: r_squared(&[kxx, kyy].concat()),
        stress: r_squared(&[sxx, syy].concat()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn r_squared_of_known_sets() {
        assert_eq!(r_squared(&[[1.0, 1.0], [2.0, 2.0], [3.0, 3.0]]), 1.0);
        assert_eq!(r_squared(&[[1.0, 2.0], [2.0, 2.0], [3.0, 2.0]]), 0.0); // the mean explains nothing
        assert_eq!(r_squared(&[[1.0, 1.0], [2.0, 2.0], [3.0, 2.0]]), 0.5);
        assert_eq!(r_squared(&[[2.0, 2.0], [2.0, 2.0]]), 0.0);
    }
}
