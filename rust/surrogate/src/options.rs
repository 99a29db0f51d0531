//! Options of a training, and the database that it uses.

use crate::SurrogateError;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// The database from which the training data came.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct DatabaseProvenance {
    /// SHA-256 of the plan's text.
    pub plan_hash: String,
    /// SHA-256 of the rows as JSON, in order. It differs when another engine has run the same plan. Absent in older
    /// files.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub rows_hash: Option<String>,
    /// Version of the program that made the database.
    pub engine_version: String,
    /// Grain parameters of the database.
    pub material: serde_json::Value,
    /// Smallest and largest grain radius \[m\].
    pub radius_min: f64,
    pub radius_max: f64,
}

/// Options of a training.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct TrainingOptions {
    /// Name of the model.
    pub name: String,
    /// Determines the split into training and test packings and the starting weights.
    pub seed: u64,
    /// Number of starts from different weights; the one with the lowest validation error is kept.
    pub restarts: u32,
    /// Largest number of epochs per start.
    pub max_epochs: u32,
    /// Training stops after this many epochs without a lower validation error (paper: 20).
    pub patience: u32,
    /// Parameters of the law of spheres that keep these values, by their names in a model file, for example `lode`; all others are
    /// fitted.
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    pub fixed: BTreeMap<String, f64>,
    /// Provenance of the rows.
    pub database: DatabaseProvenance,
    /// Number of threads, 0 = one per core. It does not change the result and is not in the model file.
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
            fixed: BTreeMap::new(),
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
                return Err(SurrogateError::Option {
                    key,
                    value: value.to_string(),
                    allowed: "1 to 100000".into(),
                });
            }
        }
        let DatabaseProvenance { radius_min, radius_max, .. } = self.database;
        if !(0.0..=radius_max).contains(&radius_min) || !radius_max.is_finite() {
            let value = format!("{radius_min} to {radius_max}");
            return Err(SurrogateError::Option {
                key: "database radii",
                value,
                allowed: "0 <= min <= max, finite".into(),
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
