use msdd_files::FileError;
use msdd_rve::database::DatabaseError;
use msdd_surrogate::SurrogateError;
use std::path::PathBuf;

/// Why a training cannot be done.
#[derive(Debug, thiserror::Error)]
pub enum TrainingError {
    #[error(transparent)]
    File(#[from] FileError),
    #[error(transparent)]
    Database(#[from] DatabaseError),
    #[error(transparent)]
    BedCase(#[from] msdd_beds::case::CaseError),
    /// The model, or a training option.
    #[error("{file}: {source}")]
    Surrogate { file: PathBuf, source: SurrogateError },
    /// Data that cannot be used: file, key, value and what is allowed.
    #[error("{0}")]
    Data(String),
}
