//! Training of the paper's network (section 3.1.2) on database rows.

use crate::dataset::{self, Ramp, Sample};
use crate::drift::drifts;
use crate::fit::NetworkFit;
use crate::levenberg_marquardt::{LeastSquares, Limits, Stopping, minimise};
use crate::network::Network;
use crate::options::TrainingOptions;
use crate::predictor::Predictor;
use crate::report::{Parts, Provenance, Report};
use crate::scaling::{self, OutputScales, TrainedRange};
use crate::scores::scores;
use crate::solid_fraction::SolidFraction;
use crate::training_data::TrainingData;
use crate::{Model, SurrogateError};
use nalgebra::DVector;
use std::ops::ControlFlow;

/// Progress of a running training.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Progress {
    /// Number of the start, from 0.
    pub restart: u32,
    /// Number of epochs done.
    pub epoch: u32,
    /// Mean squared residuals of the scaled outputs [-].
    pub training_error: f64,
    pub validation_error: f64,
}

/// Trains a model on the thermal rows of a database.
///
/// # Errors
/// [`SurrogateError::Data`] for unusable rows, [`SurrogateError::Option`] for unusable options.
pub fn train(
    data: &TrainingData,
    options: &TrainingOptions,
    mut progress: impl FnMut(Progress),
) -> Result<(Model, Report), SurrogateError> {
    options.check()?;
    let rows = &data.rows;
    let split = dataset::split(dataset::ramps(rows)?, options.seed)?;
    let samples = Parts::of(&split, samples);
    let (range, scales) = scaling::measure(&samples.training)?;
    let solid_fraction = SolidFraction::fit(rows)?;
    let fitted = best_of_starts(&samples, &range, &scales, options, &mut progress);
    let predictor = Predictor { network: fitted.network, range, scales };
    let report = Report {
        packings: Parts::of(&split, dataset::packings),
        samples: samples.map(Vec::len),
        restart: fitted.restart,
        epochs: fitted.epochs,
        best_epoch: fitted.best_epoch,
        stopping: fitted.stopping,
        training_error: fitted.training_error,
        validation_error: fitted.validation_error,
        scores: samples.map(|samples| scores(&predictor, samples)),
        drift: drifts(&predictor, &split.test),
    };
    let provenance = Provenance {
        library_version: env!("CARGO_PKG_VERSION").to_string(),
        training: TrainingOptions { threads: 0, ..options.clone() },
        report: report.clone(),
    };
    Ok((Model::new(options.name.clone(), predictor, solid_fraction, provenance), report))
}

/// Largest number of samples: eight times the paper's, for 438 weights. More would only take longer.
const MAX_SAMPLES: usize = 40_000;

/// Samples of some ramps. When there are too many, only every second, third, … of them is taken, each with its mirror
/// image.
fn samples(ramps: &[Ramp]) -> Vec<Sample> {
    let samples: Vec<Sample> = ramps.iter().flat_map(Ramp::samples).collect();
    let every = samples.len().div_ceil(MAX_SAMPLES).max(1);
    samples.chunks(2).step_by(every).flatten().copied().collect()
}

/// Result of one start.
struct Fitted {
    network: Network,
    restart: u32,
    epochs: u32,
    best_epoch: u32,
    stopping: Stopping,
    training_error: f64,
    validation_error: f64,
}

fn best_of_starts(
    samples: &Parts<Vec<Sample>>,
    range: &TrainedRange,
    scales: &OutputScales,
    options: &TrainingOptions,
    progress: &mut impl FnMut(Progress),
) -> Fitted {
    let threads = options.threads_used();
    let training = NetworkFit::new(&samples.training, range, scales, threads);
    let validation = NetworkFit::new(&samples.validation, range, scales, threads);
    let mut best = fit_from(0, &training, &validation, options, progress);
    for restart in 1..options.restarts {
        let next = fit_from(restart, &training, &validation, options, progress);
        if next.validation_error < best.validation_error {
            best = next;
        }
    }
    best
}

/// Minimises the training error, and keeps the weights with the lowest validation error.
fn fit_from(
    restart: u32,
    training: &NetworkFit,
    validation: &NetworkFit,
    options: &TrainingOptions,
    progress: &mut impl FnMut(Progress),
) -> Fitted {
    let start = DVector::from_column_slice(Network::initial(options.seed, restart.into()).weights.as_slice());
    let mut best = (0, start.clone(), training.mean_square(&start), validation.mean_square(&start));
    let limits = Limits { max_epochs: options.max_epochs, gradient: GRADIENT_LIMIT };
    let minimum = minimise(training, start, limits, |epoch, weights, training_error| {
        let validation_error = validation.mean_square(weights);
        progress(Progress { restart, epoch, training_error, validation_error });
        if validation_error < best.3 {
            best = (epoch, weights.clone(), training_error, validation_error);
        }
        if epoch - best.0 < options.patience { ControlFlow::Continue(()) } else { ControlFlow::Break(()) }
    });
    let (best_epoch, weights, training_error, validation_error) = best;
    let network = Network::from_slice(weights.as_slice());
    let (epochs, stopping) = (minimum.epochs, minimum.stopping);
    Fitted { network, restart, epochs, best_epoch, stopping, training_error, validation_error }
}

/// Limit for the largest component of the mean gradient. Errors are of order 1e-3, so below it the fit is at a minimum
/// for all practical purposes.
const GRADIENT_LIMIT: f64 = 1e-10;

#[cfg(test)]
mod tests {
    use super::*;
    use crate::synthetic;

    fn options(threads: usize) -> TrainingOptions {
        TrainingOptions { max_epochs: 25, threads, ..TrainingOptions::default() }
    }

    fn data(packings: i64, stops: i64) -> TrainingData {
        TrainingData::from(synthetic::rows(packings, stops))
    }

    #[test]
    fn learns_a_smooth_law_on_packings_it_never_saw() {
        let mut epochs = Vec::new();
        let (model, report) = train(&data(24, 3), &options(0), |p| epochs.push(p)).expect("good rows");
        assert_eq!((report.packings.training, report.packings.validation, report.packings.test), (16, 4, 4));
        assert_eq!(report.samples.test, 4 * 2 * 20);
        assert!(report.scores.test.delta_porosity > 0.999, "{report:?}");
        assert!(report.scores.test.conductivity > 0.99 && report.scores.test.stress > 0.98, "{report:?}");
        assert_eq!(epochs.len(), report.epochs as usize);
        assert!(epochs[4].training_error < epochs[0].training_error);
        assert_eq!(report.drift.len(), 4);
        assert!(
            report.drift.iter().all(|d| d.ramps == 4 && d.stress < 0.5 && d.strain.abs() > 0.049),
            "{report:?}"
        );
        let still = model.evaluate(0.13, 0.04, 0.0);
        assert_eq!((still.delta_porosity, still.delta_fabric_index), (0.0, 0.0));
        assert_eq!(Model::from_json(&model.to_json()).expect("own text"), model);
    }

    #[test]
    fn same_seed_gives_the_same_bytes_whatever_the_thread_count() {
        let text = |options| train(&data(6, 2), &options, |_| ()).expect("good rows").0.to_json();
        assert_eq!(text(options(1)), text(options(2)));
        assert_ne!(text(options(1)), text(TrainingOptions { seed: 2, ..options(1) }));
    }

    #[test]
    fn options_are_checked() {
        let bad = TrainingOptions { patience: 0, ..options(1) };
        let message = train(&data(6, 2), &bad, |_| ()).expect_err("patience 0").to_string();
        assert!(message.contains("patience = 0"), "{message}");
    }
}
