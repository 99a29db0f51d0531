//! Report of a training of the paper's network.

use crate::dataset::{Ramp, Split};
use crate::drift::Drift;
use crate::levenberg_marquardt::Stopping;
use crate::options::TrainingOptions;
use crate::scores::Scores;
use serde::{Deserialize, Serialize};

/// One value for each part of the split into training, validation and test.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Parts<T> {
    pub training: T,
    pub validation: T,
    /// Packings that the training did not use.
    pub test: T,
}

impl<T> Parts<T> {
    pub(crate) fn of(split: &Split, part: impl Fn(&[Ramp]) -> T) -> Self {
        let Split { training, validation, test } = split;
        Self { training: part(training), validation: part(validation), test: part(test) }
    }

    pub(crate) fn map<U>(&self, part: impl Fn(&T) -> U) -> Parts<U> {
        Parts { training: part(&self.training), validation: part(&self.validation), test: part(&self.test) }
    }
}

/// Results of a training.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Report {
    pub packings: Parts<usize>,
    /// Numbers of samples, mirror images included.
    pub samples: Parts<usize>,
    /// Number of the start that was kept, from 0.
    pub restart: u32,
    /// Number of epochs of that start, and the epoch whose weights were kept.
    pub epochs: u32,
    pub best_epoch: u32,
    pub stopping: Stopping,
    /// Mean squared residuals of the scaled outputs at the kept weights [-].
    pub training_error: f64,
    pub validation_error: f64,
    pub scores: Parts<Scores>,
    /// Errors on the test packings.
    pub drift: Vec<Drift>,
}

/// How the model was made.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Provenance {
    /// Version of this library that trained it.
    pub library_version: String,
    pub training: TrainingOptions,
    pub report: Report,
}
