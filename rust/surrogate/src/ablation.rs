//! Ablation study: how much each input contributes (the paper's Table 3), and how much a random split of samples
//! overestimates R² compared with a split of packings.
//!
//! An input is removed by setting it to a constant, both in training and in testing.

use crate::SurrogateError;
use crate::dataset::{self, Sample, StateRow};
use crate::network::INPUTS;
use crate::options::TrainingOptions;
use crate::report::Parts;
use crate::scaling;
use crate::score::{OneStep, one_step, ramps};
use crate::scores::Scores;
use crate::state::provenance::StateOptions;
use crate::state::training::{Mechanical, train_blind};
use crate::training;
use serde::Serialize;

/// Inputs of the paper's network.
pub const PAPER_INPUTS: [&str; INPUTS] = ["porosity", "fabric_index", "thermal_strain"];
/// Even inputs of the state model's networks. Its odd inputs are state variables as well and are left out together with
/// them.
pub const STATE_INPUTS: [&str; 4] = ["porosity", "pressure", "deviator or fabric squared", "thermal_strain"];

/// R² of a network without one of its inputs.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Line<T> {
    /// The input that was removed; none for the model with all inputs.
    pub without: Option<&'static str>,
    /// Whether the samples were split at random instead of the packings.
    pub random_split: bool,
    /// Scores on the part that the fit did not see.
    pub scores: T,
}

/// Scores of the paper's network: all inputs with either split, then without each input.
///
/// # Errors
/// [`SurrogateError::Data`] for unusable rows.
pub fn paper(rows: &[StateRow], options: &TrainingOptions) -> Result<Vec<Line<Scores>>, SurrogateError> {
    options.check()?;
    let split = dataset::split(dataset::ramps(rows)?, options.seed)?;
    let by_packing = Parts::of(&split, training::samples);
    let mut lines = vec![
        line(&shuffled(&by_packing, options.seed), None, true, options)?,
        line(&by_packing, None, false, options)?,
    ];
    for input in 0..INPUTS {
        lines.push(line(&by_packing, Some(input), false, options)?);
    }
    Ok(lines)
}

fn line(
    samples: &Parts<Vec<Sample>>,
    blind: Option<usize>,
    random_split: bool,
    options: &TrainingOptions,
) -> Result<Line<Scores>, SurrogateError> {
    let (range, scales) = scaling::measure(&samples.training)?;
    let constant = |sample: &Sample| {
        let mut sample = *sample;
        if let Some(input) = blind {
            let range = range.inputs()[input];
            sample.inputs[input] = 0.5 * (range.min + range.max);
        }
        sample
    };
    let blinded = samples.map(|part| part.iter().map(constant).collect());
    let scores = training::scores_of_fit(&blinded, &range, &scales, options);
    Ok(Line { without: blind.map(|input| PAPER_INPUTS[input]), random_split, scores })
}

/// All samples divided anew at random; a sample and its mirror image stay together.
fn shuffled(samples: &Parts<Vec<Sample>>, seed: u64) -> Parts<Vec<Sample>> {
    let all = [&samples.training[..], &samples.validation, &samples.test].concat();
    let mut pairs: Vec<&[Sample]> = all.chunks(2).collect();
    dataset::shuffle(&mut pairs, seed);
    let held = samples.test.len() / 2;
    let (test, rest) = pairs.split_at(held);
    let (validation, training) = rest.split_at(held.min(rest.len() / 2));
    Parts { training: training.concat(), validation: validation.concat(), test: test.concat() }
}

/// Scores of the state model fitted to single steps, on held-out packings: all inputs, then without each even input.
///
/// # Errors
/// [`SurrogateError::Data`] for unusable rows.
pub fn state(rows: &[StateRow], options: &StateOptions) -> Result<Vec<Line<OneStep>>, SurrogateError> {
    let plan = &options.common.database.plan_hash;
    let mut lines = Vec::new();
    for blind in std::iter::once(None).chain((0..STATE_INPUTS.len()).map(Some)) {
        let model = train_blind(rows, &Mechanical::default(), options, Some(blind))?;
        let scores = one_step(&model, &ramps(&model, rows, plan)?.unseen);
        lines.push(Line { without: blind.map(|k| STATE_INPUTS[k]), random_split: false, scores });
    }
    Ok(lines)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::synthetic;

    #[test]
    fn what_matters_is_missed() {
        let rows = synthetic::rows(20, 3);
        let options = TrainingOptions { max_epochs: 15, restarts: 1, ..TrainingOptions::default() };
        let lines = paper(&rows, &options).expect("good rows");
        let find = |without: Option<&str>, random| {
            lines.iter().find(|l| l.without == without && l.random_split == random).expect("there").scores
        };
        let all = find(None, false);
        assert!(all.delta_porosity > 0.99 && find(None, true).delta_porosity > 0.99, "{lines:?}");
        // As in the paper, the porosity increment needs the strain and the conductivity needs the porosity.
        assert!(find(Some("thermal_strain"), false).delta_porosity < 0.5, "{lines:?}");
        assert!(find(Some("porosity"), false).conductivity < all.conductivity - 0.05, "{lines:?}");

        let mut options = StateOptions::default();
        (options.common.max_epochs, options.common.restarts) = (12, 1);
        let lines = state(&rows, &options).expect("good rows");
        assert_eq!(lines.len(), 1 + STATE_INPUTS.len());
        let porosity = |line: usize| lines[line].scores.delta_porosity;
        assert!(porosity(0) > 0.999 && porosity(4) < 0.99, "{lines:?}"); // the last: without the strain
    }
}
