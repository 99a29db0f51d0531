//! How to train, and on which database.

use crate::SurrogateError;
use serde::{Deserialize, Serialize};

/// Where the training data came from.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct DatabaseProvenance {
    /// SHA-256 of the plan's text.
    pub plan_hash: String,
    /// SHA-256 of the rows as JSON, in order; a plan run by another engine gives other rows. Older files lack it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub rows_hash: Option<String>,
    /// Version of the program that made the database.
    pub engine_version: String,
    /// Grain parameters of the database.
    pub material: serde_json::Value,
    /// Smallest and largest grain radius [m].
    pub radius_min: f64,
    pub radius_max: f64,
}

/// How to train.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct TrainingOptions {
    /// Name of the model.
    pub name: String,
    /// Fixes the split and the starting weights.
    pub seed: u64,
    /// Starts from other weights; the one with the best validation error is kept.
    pub restarts: u32,
    /// Epochs at most, per start.
    pub max_epochs: u32,
    /// Epochs without a better validation error after which training stops (paper: 20).
    pub patience: u32,
    /// Where the rows came from.
    pub database: DatabaseProvenance,
    /// Threads, 0 = one a core. Does not change the result and is not in the model file.
    #[serde(skip)]
    pub threads: usize,
}

impl Default for TrainingOptions {
    fn default() -> Self {
        Self {
            name: "unnamed".to_string(),
            seed: 1,
            restarts: 1,
            max_epochs: 200,
            patience: 20,
            database: DatabaseProvenance::default(),
            threads: 0,
        }
    }
}

impl TrainingOptions {
    pub(crate) fn check(&self) -> Result<(), SurrogateError> {
        for (key, value) in
            [("restarts", self.restarts), ("max_epochs", self.max_epochs), ("patience", self.patience)]
        {
            if !(1..=100_000).contains(&value) {
                return Err(SurrogateError::Option { key, value: value.to_string(), allowed: "1 to 100000" });
            }
        }
        let DatabaseProvenance { radius_min, radius_max, .. } = self.database;
        if !(0.0..=radius_max).contains(&radius_min) || !radius_max.is_finite() {
            let value = format!("{radius_min} to {radius_max}");
            return Err(SurrogateError::Option {
                key: "database radii",
                value,
                allowed: "0 <= min <= max, finite",
            });
        }
        Ok(())
    }
}

impl TrainingOptions {
    pub(crate) fn threads_used(&self) -> usize {
        match self.threads {
            0 => std::thread::available_parallelism().map_or(1, |cores| cores.get()),
            threads => threads,
        }
    }
}
