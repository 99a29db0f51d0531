//! Training: the number of contacts is fitted first, then the law to the stress along paths, then the readouts to the states on them.

use super::fit::{PathFit, fit};
use super::fit_state::{contacts, readout, usual_fabric};
use super::model::{File, Ranges, Report, SCHEMA, SphereModel};
use super::parameters::{Free, beginning};
use super::tensor::{Tensor, contraction, deviator, mean};
use super::tracks::{Track, follow};
use crate::SurrogateError;
use crate::options::TrainingOptions;
use crate::scaling::Range;
use sha2::{Digest, Sha256};
use std::collections::BTreeSet;

/// Usual number of epochs: the fit begins near its minimum, and after these it is there for all practical purposes.
pub const DEFAULT_EPOCHS: u32 = 12;
/// One packing in so many is held out of the training.
const HELD_OUT: u64 = 5;
/// Least number of states to which the law is fitted.
const MIN_STEPS: usize = 100;

/// Whether a packing is held out of a training with this seed.
pub fn is_held_out(packing: i64, seed: u64) -> bool {
    let bytes = [seed.to_le_bytes(), packing.to_le_bytes()].concat();
    let number = Sha256::digest(bytes).iter().take(8).fold(0u64, |value, &byte| value << 8 | u64::from(byte));
    number % HELD_OUT == 0
}

/// Trains on paths of boxes of spheres.
///
/// # Errors
/// [`SurrogateError::Data`] for unusable data, [`SurrogateError::Option`] for unusable options.
pub fn train(tracks: &[Track], options: &TrainingOptions) -> Result<SphereModel, SurrogateError> {
    options.check()?;
    let (unseen, seen): (Vec<Track>, Vec<Track>) =
        tracks.iter().cloned().partition(|track| is_held_out(track.packing, options.seed));
    if seen.iter().map(|track| track.steps.len()).sum::<usize>() < MIN_STEPS {
        let text = "fewer than 100 states on paths of strain of boxes of spheres, to which this kind of model is fitted";
        return Err(SurrogateError::Data(text.to_string()));
    }
    if !seen.iter().any(|track| track.packed.gas.iter().all(|gas| gas.is_finite())) {
        let text =
            "poured beds alone, which have no data for the gas, allowed: poured beds together with boxes";
        return Err(SurrogateError::Data(text.to_string()));
    }
    let contacts = contacts(&beginning(), &seen);
    let free = Free::new(&options.fixed)?;
    let problem = PathFit { tracks: &seen, threads: options.threads_used(), contacts, free };
    let (mut law, minimum) = fit(&problem, options.max_epochs);
    law.fabric[1] = usual_fabric(&law, &seen);
    let readout = readout(&law, &seen);
    let ranges = ranges(&law, &seen);
    let packings = |tracks: &[Track]| tracks.iter().map(|track| track.packing).collect::<BTreeSet<_>>().len();
    let report = Report {
        packings: [packings(&seen), packings(&unseen)],
        paths: [seen.len(), unseen.len()],
        parameters: problem.free.count(),
        epochs: minimum.epochs,
        mean_square: minimum.mean_square,
    };
    let model = SphereModel::of(File {
        schema: SCHEMA.to_string(),
        name: options.name.clone(),
        law,
        readout,
        ranges,
        library_version: env!("CARGO_PKG_VERSION").to_string(),
        training: TrainingOptions { threads: 0, ..options.clone() },
        report,
    });
    // Whatever the data were, a model that is written can be read.
    SphereModel::read(&model.to_json())
}

fn ranges(law: &super::law::Law, tracks: &[Track]) -> Ranges {
    let points = || tracks.iter().flat_map(|track| (0..=track.steps.len()).map(|k| track.point(k)));
    let ratio = |stress: Tensor| {
        let part = deviator(stress);
        contraction(&part, &part).sqrt() / mean(stress)
    };
    let ratios = points().filter(|point| mean(point.stress) > 0.0).map(|point| ratio(point.stress));
    Ranges {
        jamming_fraction: Range::of(
            tracks.iter().flat_map(|track| follow(law, track)).map(|state| state.jamming),
        ),
        pressure: Range::of(points().map(|point| mean(point.stress))),
        stress_ratio: ratios.fold(0.0, f64::max),
    }
}
