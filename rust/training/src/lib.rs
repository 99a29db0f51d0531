//! Training of models: the data come from databases of packings ([`msdd_rve::database`]) and from beds of DEM ([`msdd_beds`]), the models
//! from [`msdd_surrogate`]. [`train`] is what `msdd train`, `msdd_train` of the C interface and `msdd.train` of Python call.

pub mod dem_start;
mod error;
mod rows;
pub mod spheres;
mod tracks;

pub use error::TrainingError;
use msdd_rve::database::{Dataset, read_all};
use msdd_surrogate::document::hash;
use msdd_surrogate::spheres::model::SphereModel;
use msdd_surrogate::spheres::parameters::Free;
use msdd_surrogate::spheres::tracks::Track;
use msdd_surrogate::spheres::training;
use msdd_surrogate::surrogate::Surrogate;
use msdd_surrogate::training_data::TrainingData;
use msdd_surrogate::{DatabaseProvenance, TrainingOptions, models};
pub use rows::training_data;
use serde::Deserialize;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

/// What is trained, and on which data.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Request {
    /// Databases, or CSVs exported from them, all together; for spheres also folders of beds.
    pub database: Vec<PathBuf>,
    /// Kind of model: `constant`, `paper`, `increment` or `spheres`.
    pub model: String,
    /// Its name; its kind if none is given.
    pub name: Option<String>,
    /// Seed of the split into training and held-out packings, and of the starting weights.
    pub seed: u64,
    /// See [`TrainingOptions`]; by default those of the kind.
    pub restarts: Option<u32>,
    pub epochs: Option<u32>,
    pub patience: Option<u32>,
    /// Parameters of the law of spheres that are not fitted, see [`TrainingOptions::fixed`].
    pub fix: BTreeMap<String, f64>,
    /// Number of threads, 0 = one per core. The result does not depend on it.
    pub threads: usize,
}

impl Default for Request {
    fn default() -> Self {
        Self {
            database: Vec::new(),
            model: models::DEFAULT.to_string(),
            name: None,
            seed: TrainingOptions::default().seed,
            restarts: None,
            epochs: None,
            patience: None,
            fix: BTreeMap::new(),
            threads: 0,
        }
    }
}

impl Request {
    fn options(&self, epochs: u32, database: DatabaseProvenance) -> TrainingOptions {
        let usual = TrainingOptions::default();
        TrainingOptions {
            name: self.name.clone().unwrap_or_else(|| self.model.clone()),
            seed: self.seed,
            restarts: self.restarts.unwrap_or(usual.restarts),
            max_epochs: self.epochs.unwrap_or(epochs),
            patience: self.patience.unwrap_or(usual.patience),
            fixed: self.fix.clone(),
            database,
            threads: self.threads,
        }
    }
}

/// A model, with the data that it was trained on.
pub enum Trained {
    Discs { model: Box<dyn Surrogate>, data: TrainingData, plan_hash: String },
    Spheres { model: Box<SphereModel>, tracks: Vec<Track> },
}

impl Trained {
    /// Text of the model file.
    pub fn to_json(&self) -> String {
        match self {
            Self::Discs { model, .. } => model.to_json(),
            Self::Spheres { model, .. } => model.to_json(),
        }
    }

    pub fn hash(&self) -> String {
        match self {
            Self::Discs { model, .. } => model.hash().to_string(),
            Self::Spheres { model, .. } => model.hash().to_string(),
        }
    }
}

/// Trains a model.
///
/// # Errors
/// Data that cannot be read or used, options that are not allowed.
pub fn train(request: &Request) -> Result<Trained, TrainingError> {
    let Some(first) = request.database.first() else {
        let text = "database = [], allowed: at least one database, CSV or folder of beds";
        return Err(TrainingError::Data(text.to_string()));
    };
    let failed = |source| TrainingError::Surrogate { file: first.clone(), source };
    if request.model == spheres::KIND {
        Free::new(&request.fix).map_err(failed)?;
        let (tracks, provenance) = spheres::read(&request.database)?;
        let options = request.options(training::DEFAULT_EPOCHS, provenance);
        let model = Box::new(training::train(&tracks, &options).map_err(failed)?);
        return Ok(Trained::Spheres { model, tracks });
    }
    if let Some((name, value)) = request.fix.first_key_value() {
        return Err(TrainingError::Data(format!(
            "fix: {name} = {value} with model {}, allowed: with model {}",
            request.model,
            spheres::KIND
        )));
    }
    let kind = models::kind(&request.model).map_err(failed)?;
    let dataset = read_all(&request.database)?;
    let data = training_data(&dataset.records);
    let options = request.options(kind.epochs, provenance(first, &dataset)?);
    let model = (kind.train)(&data, &options).map_err(failed)?;
    Ok(Trained::Discs { model, data, plan_hash: options.database.plan_hash })
}

fn provenance(file: &Path, dataset: &Dataset) -> Result<DatabaseProvenance, TrainingError> {
    let data = |text: String| TrainingError::Data(format!("{}: {text}", file.display()));
    let value =
        |key: &str| dataset.provenance.get(key).ok_or_else(|| data(format!("no {key} in its provenance")));
    let bad = |key: &str, error: String| data(format!("provenance {key}: {error}"));
    let number = |key: &str| value(key)?.parse::<f64>().map_err(|error| bad(key, error.to_string()));
    let rows = serde_json::to_string(&dataset.records).map_err(|error| data(error.to_string()))?;
    Ok(DatabaseProvenance {
        rows_hash: Some(hash(&rows)),
        plan_hash: value("plan_hash")?.clone(),
        engine_version: value("engine_version")?.clone(),
        material: serde_json::from_str(value("material")?)
            .map_err(|error| bad("material", error.to_string()))?,
        radius_min: number("radius_min")?,
        radius_max: number("radius_max")?,
    })
}
