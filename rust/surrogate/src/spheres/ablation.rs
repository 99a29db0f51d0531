//! How much each part of the law of spheres contributes: the law is fitted again without it.

use super::errors::Errors;
use super::score::score;
use super::tracks::{Track, follow};
use super::training::{is_held_out, train_without};
use crate::SurrogateError;
use crate::options::TrainingOptions;
use serde::Serialize;
use std::time::Instant;

/// Errors along held-out paths without a part of the law.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Line {
    /// The part that was left out; none for the whole law.
    pub without: Option<&'static str>,
    /// Numbers that were fitted to stresses.
    pub numbers: usize,
    /// Means over the kinds of path of which they are known.
    pub along: Errors,
    /// The same where solid fraction, stress and the mobilised part of the friction alone are known at the start.
    pub of_stress_alone: Errors,
}

/// What a line is fitted without: name, and values of parameters (their numbers in [`super::parameters`]) that do it.
type LeftOut = (Option<&'static str>, &'static [(usize, f64)]);

/// ln of the least strength that a file may have.
const NONE: f64 = -13.8;

const LINES: [LeftOut; 15] = [
    (None, &[]),
    (
        Some("mobilised friction"),
        &[
            (2, 0.0),
            (4, 0.0),
            (8, 0.0),
            (11, 0.0),
            (14, 0.0),
            (15, 0.0),
            (16, 0.0),
            (17, 1.0),
            (18, 0.0),
            (22, 0.0),
            (27, 0.0),
            (33, 0.0),
            (39, 0.0),
            (45, 0.0),
        ],
    ),
    (Some("collapse"), &[(14, 0.0), (15, 0.0), (16, 0.0), (17, 1.0)]),
    (Some("settling of any bed with mobilised friction that opens"), &[(22, 0.0)]),
    (
        Some("fabric (fourth element)"),
        &[
            (12, 0.0),
            (13, 0.0),
            (23, 0.0),
            (42, NONE),
            (43, NONE),
            (44, 0.0),
            (45, 0.0),
            (46, 0.0),
            (47, 0.0),
            (48, 0.0),
            (49, 0.0),
        ],
    ),
    (Some("contacts below which the fabric does not turn"), &[(48, 0.0)]),
    (Some("forgetting of a fabric far from its strength"), &[(49, 0.0)]),
    (Some("third element"), &[(36, 0.0), (37, NONE), (38, 0.0), (39, 0.0), (40, 0.0), (41, 0.0)]),
    (
        Some("first and third element"),
        &[
            (24, 0.0),
            (25, NONE),
            (26, 0.0),
            (27, 0.0),
            (28, 0.0),
            (29, 0.0),
            (36, 0.0),
            (37, NONE),
            (38, 0.0),
            (39, 0.0),
            (40, 0.0),
            (41, 0.0),
        ],
    ),
    (Some("powers of the pressure other than Hertz's"), &[(3, 0.0), (4, 0.0), (5, 0.0)]),
    (Some("less stiffness of little friction that hardly bears"), &[(50, 0.0)]),
    (Some("strengths that depend on the load"), &[(28, 0.0), (34, 0.0), (40, 0.0), (46, 0.0)]),
    (Some("dilatancy by sliding"), &[(9, 0.0), (10, 0.0), (11, 0.0), (12, 0.0), (13, 0.0)]),
    (Some("the fabric in the dilatancy by sliding"), &[(12, 0.0), (13, 0.0)]),
    (Some("a deviator that depends on its direction"), &[(51, 0.0)]),
];

/// One packing in so many is used, of those that a training sees.
const USED: i64 = 3;

/// Fits the law, and the law without each of its parts, to a third of the packings; errors are those on the held-out packings.
///
/// # Errors
/// [`SurrogateError::Data`] for unusable data.
pub fn ablation(tracks: &[Track], options: &TrainingOptions) -> Result<Vec<Line>, SurrogateError> {
    let (unseen, seen): (Vec<Track>, Vec<Track>) =
        tracks.iter().cloned().partition(|track| is_held_out(track.packing, options.seed));
    let used: Vec<Track> = seen.into_iter().filter(|track| track.packing % USED == 0).collect();
    let line = |(without, fixed): &LeftOut| {
        let model = train_without(&used, options, fixed)?;
        let kinds = score(&model, &unseen);
        let mean = |of: fn(&super::score::PathErrors) -> Errors| {
            // Of beds that were poured, nothing of the gas is known.
            let known = |part: fn(&Errors) -> f64| {
                let values: Vec<f64> =
                    kinds.iter().map(|kind| part(&of(kind))).filter(|value| value.is_finite()).collect();
                values.iter().sum::<f64>() / values.len().max(1) as f64
            };
            Errors {
                pressure: known(|errors| errors.pressure),
                deviator: known(|errors| errors.deviator),
                contact: known(|errors| errors.contact),
                gas: known(|errors| errors.gas),
            }
        };
        let numbers = model.file.report.parameters;
        let (along, of_stress_alone) = (mean(|kind| kind.along), mean(|kind| kind.of_stress_alone));
        Ok(Line { without: *without, numbers, along, of_stress_alone })
    };
    LINES.iter().map(line).collect()
}

/// Time of one increment of the law \[ns\]: the least of several rounds over these tracks.
pub fn nanoseconds(law: &super::law::Law, tracks: &[Track]) -> f64 {
    let increments: f64 = tracks
        .iter()
        .flat_map(|track| &track.steps)
        .map(|step| super::tracks::parts(step.thermal, step.stretch))
        .sum();
    let round = |_| {
        let begin = Instant::now();
        let sum: f64 =
            tracks.iter().flat_map(|track| follow(law, track)).map(|state| state.compression).sum();
        std::hint::black_box(sum);
        begin.elapsed().as_secs_f64()
    };
    1e9 * (0..ROUNDS).map(round).fold(f64::INFINITY, f64::min) / increments.max(1.0)
}

const ROUNDS: u32 = 5;
