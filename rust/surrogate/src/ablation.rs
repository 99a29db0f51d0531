//! Ablation study: how much each input contributes (the paper's Table 3), and how much a random split of samples
//! overestimates R² compared with a split of packings.
//!
//! An input is removed by setting it to a constant, both in training and in testing.

use crate::SurrogateError;
use crate::dataset::{self, Sample, StateRow};
use crate::increment::forms::{self, Form};
use crate::increment::learned;
use crate::increment::training::train_without;
use crate::network::INPUTS;
use crate::options::TrainingOptions;
use crate::report::Parts;
use crate::scaling;
use crate::scores::Scores;
use crate::surrogate::Surrogate;
use crate::tracks::{PathErrors, Track};
use crate::training;
use crate::training_data::TrainingData;
use serde::Serialize;
use std::time::Instant;

/// Inputs of the paper's network.
pub const PAPER_INPUTS: [&str; INPUTS] = ["porosity", "fabric_index", "thermal_strain"];
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

/// Parts of the law of the increments that are left out: name, and values of the fit's parameters that do it.
const LEFT_OUT: [(&str, &[(usize, f64)]); 6] = [
    // Strengths of a thousand pressures.
    ("sliding", &[(8, 6.9), (9, 6.9), (10, 0.0), (11, 0.0), (12, 0.0)]),
    // One element, which has the whole modulus but for two millionths, the least that a file may have: it knows the stress,
    // but not where the grains have been.
    ("second element (memory)", &[(7, 13.0), (9, 6.9), (11, 0.0)]),
    ("dilatancy", &[(10, 0.0), (11, 0.0), (12, 0.0)]),
    ("looseness", &[(1, 0.0), (12, 0.0), (13, 0.0), (14, 0.0)]),
    ("growth of G with p", &[(4, -16.0), (5, 0.0)]),
    ("settling", &[(15, 0.0)]),
];

/// Errors of the law of the increments on held-out paths: the whole law, then without each part.
///
/// # Errors
/// [`SurrogateError::Data`] for unusable data.
pub fn increments(
    data: &TrainingData,
    options: &TrainingOptions,
) -> Result<Vec<Line<Vec<PathErrors>>>, SurrogateError> {
    let (tracks, _) = held_out(data, options)?;
    let whole: (Option<&'static str>, &[(usize, f64)]) = (None, &[]);
    let all = std::iter::once(whole).chain(LEFT_OUT.iter().map(|(name, fixed)| (Some(*name), *fixed)));
    all.map(|(without, fixed)| {
        let model = train_without(data, options, fixed)?;
        Ok(Line { without, random_split: false, scores: model.path_errors(&tracks) })
    })
    .collect()
}

/// The classical form of the law of the increments, and a learned one for comparison, on held-out paths.
///
/// # Errors
/// [`SurrogateError::Data`] for unusable data.
pub fn forms(data: &TrainingData, options: &TrainingOptions) -> Result<[Form; 2], SurrogateError> {
    let (tracks, seen) = held_out(data, options)?;
    let begin = Instant::now();
    let core = train_without(data, options, &[])?.core;
    let seconds = begin.elapsed().as_secs_f64();
    let how = (options.seed, learned::training::USUAL_EPOCHS, options.threads_used());
    Ok([forms::classical(&core, &tracks, seconds), forms::learned(&core, &seen, &tracks, how)])
}

/// The tracks that the fits do not see, and those that they do.
fn held_out(
    data: &TrainingData,
    options: &TrainingOptions,
) -> Result<(Vec<Track>, Vec<Track>), SurrogateError> {
    let held_out = data.split(options.seed)?.test;
    Ok(data.tracks.iter().cloned().partition(|track| held_out.contains(&track.packing)))
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
    }

    #[test]
    fn a_law_without_one_of_its_parts_errs_more() {
        let tracks = crate::increment::synthetic::tracks(10, 6);
        let data = TrainingData { tracks, ..TrainingData::default() };
        let options = TrainingOptions { max_epochs: 15, threads: 2, ..TrainingOptions::default() };
        let lines = increments(&data, &options).expect("good paths");
        let error = |without: Option<&str>, path: &str| {
            let line = lines.iter().find(|line| line.without == without).expect("there");
            let errors = line.scores.iter().find(|errors| errors.name == path).expect("there");
            errors.pressure.hypot(errors.deviator)
        };
        let all = error(None, "shear");
        assert!(all < 0.02, "{lines:?}");
        for part in ["sliding", "second element (memory)", "dilatancy"] {
            assert!(error(Some(part), "shear") > 2.0 * all, "{part}: {lines:?}");
        }
    }
}
