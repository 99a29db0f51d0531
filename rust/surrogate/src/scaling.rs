//! Trained range of the inputs, and scales of inputs and outputs.

use crate::SurrogateError;
use crate::dataset::Sample;
use crate::kernel::{LANES, Lanes};
use crate::network::{INPUTS, OUTPUTS};
use serde::{Deserialize, Serialize};

/// A closed interval.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Range {
    pub min: f64,
    pub max: f64,
}

impl Range {
    /// Smallest range that holds all values.
    pub fn of(values: impl Iterator<Item = f64>) -> Self {
        let start = Self { min: f64::INFINITY, max: f64::NEG_INFINITY };
        values.fold(start, |range, v| Self { min: range.min.min(v), max: range.max.max(v) })
    }

    pub fn width(&self) -> f64 {
        self.max - self.min
    }

    pub fn contains(&self, value: f64) -> bool {
        (self.min..=self.max).contains(&value)
    }

    /// The nearest value inside. Written with comparisons, which are one instruction each; max and min are three,
    /// because they treat NaN separately.
    #[inline(always)]
    pub fn clamp(&self, value: f64) -> f64 {
        let value = if value > self.min { value } else { self.min };
        if value < self.max { value } else { self.max }
    }
}

/// Range of the training inputs; inputs outside are clamped to it. The paper uses the convex hull of the inputs; the
/// box used here is the simplest region that contains that hull.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct TrainedRange {
    pub porosity: Range,
    /// Symmetric, because the samples are mirrored.
    pub fabric_index: Range,
    pub thermal_strain: Range,
}

impl TrainedRange {
    pub fn inputs(&self) -> [Range; INPUTS] {
        [self.porosity, self.fabric_index, self.thermal_strain]
    }

    /// The inputs clamped to the range, and for each lane whether any of its inputs was outside.
    pub fn clamp(&self, inputs: &[Lanes; INPUTS]) -> ([Lanes; INPUTS], [bool; LANES]) {
        let (mut clamped, mut outside) = (*inputs, [false; LANES]);
        for (values, range) in clamped.iter_mut().zip(self.inputs()) {
            for (value, outside) in values.iter_mut().zip(&mut outside) {
                let inside = range.clamp(*value);
                *outside |= inside != *value;
                *value = inside;
            }
        }
        (clamped, outside)
    }

    /// The clamped inputs scaled to [-1, 1].
    pub fn scaled(&self, inputs: &[Lanes; INPUTS]) -> [Lanes; INPUTS] {
        let ranges = self.inputs();
        std::array::from_fn(|k| {
            let Range { min, max } = ranges[k];
            inputs[k].map(|value| (value - min) * (2.0 / (max - min)) - 1.0)
        })
    }
}

/// Scales that bring the network's outputs to order one.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct OutputScales {
    /// s_η: Δη = ε s_η y_0.
    pub delta_porosity_per_strain: f64,
    /// s_f: Δf = ε s_f y_1.
    pub delta_fabric_index_per_strain: f64,
    /// K/k at y = 0 and y = 1.
    pub conductivity: Range,
    /// σ ℓ/(E r̄) at y = 0 and y = 1. The range starts at 0, since dry grains carry no tension.
    pub stress: Range,
}

impl OutputScales {
    /// Δη, Δf, K, σ from the network's outputs. K and σ are limited below by the ends of their ranges, because a
    /// composed state outside the data must not give a negative conductivity or tension. Zero strain gives exactly zero
    /// increments.
    pub fn physical(&self, strain: &Lanes, outputs: &[Lanes; OUTPUTS]) -> [Lanes; OUTPUTS] {
        let increments = [self.delta_porosity_per_strain, self.delta_fabric_index_per_strain];
        let ranges = [self.conductivity, self.conductivity, self.stress, self.stress];
        std::array::from_fn(|o| {
            std::array::from_fn(|lane| match o {
                0 | 1 => strain[lane] * (increments[o] * outputs[o][lane]),
                _ => ranges[o - 2].min + ranges[o - 2].width() * outputs[o][lane].max(0.0),
            })
        })
    }

    /// Target of each network output for a sample, and its weight in the fit.
    pub fn targets(&self, sample: &Sample, largest_strain: f64) -> [(f64, f64); OUTPUTS] {
        let strain = sample.inputs[2];
        let increment = |delta: f64, scale: f64| match strain {
            0.0 => (0.0, 0.0), // exact by construction
            // Weight √|ε|, a compromise. With the weight |ε| the increments Δ would be fitted and large strains would
            // dominate, although solvers take small steps, for which the rate matters. With the weight 1 the rates Δ/ε
            // would be fitted and the noise of small strains would dominate. The paper does not say (its network fits
            // Δ). All three drift equally within the scatter, but one training with the weight 1 gave a useless Δf.
            _ => (delta / (strain * scale), (strain.abs() / largest_strain).sqrt()),
        };
        let state = |value: f64, range: Range| ((value - range.min) / range.width(), 1.0);
        let [delta_porosity, delta_fabric_index, kxx, kyy, sxx, syy] = sample.outputs;
        let (fabric, weight) = increment(delta_fabric_index, self.delta_fabric_index_per_strain);
        [
            increment(delta_porosity, self.delta_porosity_per_strain),
            (fabric, if sample.fabric_known { weight } else { 0.0 }),
            state(kxx, self.conductivity),
            state(kyy, self.conductivity),
            state(sxx, self.stress),
            state(syy, self.stress),
        ]
    }
}

/// Ranges and scales of training samples.
///
/// # Errors
/// [`SurrogateError::Data`] when an input or output does not vary.
pub fn measure(samples: &[Sample]) -> Result<(TrainedRange, OutputScales), SurrogateError> {
    let input = |k: usize| Range::of(samples.iter().map(|s| s.inputs[k]));
    let output = |o: usize| {
        let known = samples.iter().filter(|s| o != 1 || s.fabric_known);
        Range::of(known.map(|s| s.outputs[o]))
    };
    let largest = |range: Range| range.min.abs().max(range.max.abs());
    let strain = input(2);
    let range = TrainedRange { porosity: input(0), fabric_index: input(1), thermal_strain: strain };
    let scales = OutputScales {
        delta_porosity_per_strain: largest(output(0)) / largest(strain),
        delta_fabric_index_per_strain: largest(output(1)) / largest(strain),
        conductivity: Range { min: output(2).min.max(0.0), max: output(2).max },
        stress: Range { min: 0.0, max: output(4).max },
    };
    let widths = [
        ("porosity", range.porosity.width()),
        ("fabric_index", range.fabric_index.width()),
        ("thermal_strain", range.thermal_strain.width()),
        ("porosity increment", scales.delta_porosity_per_strain),
        ("fabric index increment", scales.delta_fabric_index_per_strain),
        ("conductivity", scales.conductivity.width()),
        ("stress", scales.stress.width()),
    ];
    match widths.iter().find(|(_, width)| !(*width > 0.0 && width.is_finite())) {
        None => Ok((range, scales)),
        Some((key, _)) => Err(SurrogateError::Data(format!("{key} is the same in all training samples"))),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn clamping_flags_the_lane_and_keeps_the_rest() {
        let unit = Range { min: -1.0, max: 1.0 };
        let range =
            TrainedRange { porosity: Range { min: 0.1, max: 0.2 }, fabric_index: unit, thermal_strain: unit };
        let mut inputs = [[0.15; LANES], [0.0; LANES], [1.0; LANES]];
        inputs[0][3] = f64::MAX;
        inputs[2][6] = -1.0000001;
        let (clamped, outside) = range.clamp(&inputs);
        assert_eq!(outside, std::array::from_fn(|lane| lane == 3 || lane == 6));
        assert_eq!((clamped[0][3], clamped[2][6], clamped[0][0]), (0.2, -1.0, 0.15));
        assert_eq!(range.scaled(&clamped)[0][3], 1.0);
    }

    #[test]
    fn targets_invert_to_the_sample() {
        let samples = [
            Sample {
                inputs: [0.1, 0.1, 0.05],
                outputs: [-0.08, -0.02, 0.5, 0.4, 0.2, 0.1],
                fabric_known: true,
            },
            Sample {
                inputs: [0.2, -0.1, -0.05],
                outputs: [0.07, 0.03, 0.2, 0.3, 0.0, 0.05],
                fabric_known: true,
            },
        ];
        let (_, scales) = measure(&samples).expect("varied");
        let targets = scales.targets(&samples[1], 0.05);
        let physical = scales.physical(&[-0.05; LANES], &targets.map(|(target, _)| [target; LANES]));
        for (value, expected) in physical.iter().zip(samples[1].outputs) {
            assert!((value[0] - expected).abs() < 1e-15, "{} {expected}", value[0]);
        }
        assert!(scales.physical(&[0.0; LANES], &[[0.7; LANES]; OUTPUTS])[0].iter().all(|d| *d == 0.0));
    }
}
