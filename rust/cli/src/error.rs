//! Errors that the program reports before it exits with status 1.

use std::path::PathBuf;

#[derive(Debug, thiserror::Error)]
pub enum CliError {
    #[error(transparent)]
    File(#[from] msdd_files::FileError),
    #[error("cannot write to standard output: {0}")]
    Output(String),
    #[error("{file}: {source}")]
    Bed { file: PathBuf, source: msdd_beds::BedError },
    #[error(transparent)]
    BedCase(#[from] msdd_beds::case::CaseError),
    #[error(transparent)]
    Experiment(#[from] msdd_beds::experiment::ExperimentError),
    #[error(transparent)]
    Case(#[from] msdd_case::CaseError),
    #[error(transparent)]
    Draw(#[from] msdd_draw::DrawError),
    #[error(transparent)]
    Database(#[from] msdd_rve::database::DatabaseError),
    #[error(transparent)]
    Reference(#[from] msdd_dem_reference::ReferenceError),
    #[error(transparent)]
    Rve(#[from] msdd_rve::RveError),
    #[error("{source}; the last good state, after {steps} steps at t = {time} s, is in {file}")]
    Stopped { source: msdd_rve::RveError, file: PathBuf, steps: u64, time: f64 },
    #[error("{file}: {source}")]
    State { file: PathBuf, source: msdd_rve::state::StateError },
    #[error(transparent)]
    Training(#[from] msdd_training::TrainingError),
    #[error("{file}: {source}")]
    Model { file: PathBuf, source: msdd_surrogate::SurrogateError },
    #[error("{0}")]
    Message(String),
}
