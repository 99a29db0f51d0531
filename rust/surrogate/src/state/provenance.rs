//! Options of the training of a state model, and its report.

use super::variables::Variables;
use crate::SurrogateError;
use crate::composition::Composed;
use crate::levenberg_marquardt::Stopping;
use crate::options::TrainingOptions;
use crate::perceptron::shape_is_sound;
use crate::report::Parts;
use serde::{Deserialize, Serialize};

/// Options of the training of a state model.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct StateOptions {
    pub common: TrainingOptions,
    pub variables: Variables,
    /// Neurons of the hidden layers of the rates' network, for one or two layers.
    pub hidden: Vec<usize>,
    /// The same for the readout's network.
    pub readout_hidden: Vec<usize>,
}

impl Default for StateOptions {
    fn default() -> Self {
        Self {
            common: TrainingOptions { restarts: 2, max_epochs: 40, ..TrainingOptions::default() },
            variables: Variables::ALL,
            hidden: vec![4],
            readout_hidden: vec![4],
        }
    }
}

impl StateOptions {
    /// Number of threads of one fit, when several starts run at the same time.
    pub(super) fn fit_threads(&self) -> usize {
        let threads = self.common.threads_used();
        (threads / threads.min(self.common.restarts as usize).max(1)).max(1)
    }

    pub(super) fn check(&self) -> Result<(), SurrogateError> {
        self.common.check()?;
        for (key, layers) in [("hidden", &self.hidden), ("readout_hidden", &self.readout_hidden)] {
            let sizes = [&[1], layers.as_slice(), &[1]].concat();
            if !shape_is_sound(&sizes) {
                let value = format!("{layers:?}");
                let allowed = "one or two layers of 1 to 16 neurons";
                return Err(SurrogateError::Option { key, value, allowed });
            }
        }
        Ok(())
    }
}

/// Report of one network's fit.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct FitReport {
    pub weights: usize,
    /// Number of the start that was kept, from 0.
    pub restart: u32,
    /// Number of epochs of that start, and the epoch whose weights were kept.
    pub epochs: u32,
    pub best_epoch: u32,
    pub stopping: Stopping,
    /// Mean squared weighted residual.
    pub training_error: f64,
    /// Mean squared weighted residual on the validation packings, by which the epoch and the start were chosen.
    pub validation_error: f64,
}

/// Results of a training.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct StateReport {
    pub packings: Parts<usize>,
    /// Numbers of pairs of stops.
    pub samples: Parts<usize>,
    pub rates: FitReport,
    pub readouts: Vec<FitReport>,
    /// Errors on the held-out packings.
    pub composed: Vec<Composed>,
}

/// How the model was made.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Provenance {
    /// Version of the library that trained it.
    pub library_version: String,
    pub training: StateOptions,
    pub report: StateReport,
}
