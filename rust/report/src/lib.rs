//! The report on speed and accuracy: runs of the solver and of DEM as cached jobs, compared with the
//! committed reference. Written as `results/report.json` and as a single page that needs no other files.
//!
//! A module uses only modules above it in this table.
//!
//! | module | what |
//! |---|---|
//! | [`jobs`] | runs with a cache of their results |
//! | [`plan`] | the configurations of the report |
//! | [`settings`] | which report is made, and where |
//! | [`studies`] | studies: the jobs that each needs, and its results |
//! | [`failures`] | where methods lose accuracy or fail, and what the programs do there |
//! | [`report`] | all results as data: the JSON file |
//! | [`case`] | speed against accuracy for a case of the user's |
//! | [`page`] | the page |
//!
//! Errors against DEM are those of [`msdd_dem_reference::compare`].
#![forbid(unsafe_code)]

pub mod case;
pub mod failures;
pub mod jobs;
pub mod page;
pub mod plan;
pub mod report;
pub mod settings;
pub mod studies;

use std::path::{Path, PathBuf};

/// Why a report cannot be made. A job that fails is part of the report and not an error.
#[derive(Debug, thiserror::Error)]
pub enum ReportError {
    #[error("cannot read {file}: {problem}", file = file.display())]
    Read { file: PathBuf, problem: String },
    #[error("cannot write {file}: {problem}", file = file.display())]
    Write { file: PathBuf, problem: String },
    #[error(transparent)]
    File(#[from] msdd_files::FileError),
    #[error(transparent)]
    Case(#[from] msdd_case::CaseError),
    #[error(transparent)]
    Choice(#[from] msdd_autotune::ChoiceError),
    #[error(transparent)]
    Reference(#[from] msdd_dem_reference::ReferenceError),
    #[error("{cache} has no result of these jobs: nothing to draw; without --draw they are run", cache = cache.display())]
    Empty { cache: PathBuf },
    #[error("there is no chart of this case: {problem}")]
    Useless { problem: String },
    #[error("cannot start {program}: {problem}")]
    Start { program: String, problem: String },
    #[error(transparent)]
    Draw(#[from] msdd_draw::DrawError),
}

/// Reads a text file.
///
/// # Errors
/// [`ReportError::File`].
pub fn read_text(file: &Path) -> Result<String, ReportError> {
    Ok(msdd_files::read_text(file)?)
}

/// The rows of a CSV file that may begin with lines of comments.
///
/// # Errors
/// [`ReportError::File`]; [`ReportError::Read`] for a column that is missing or a value that cannot be read.
pub fn rows<T: serde::de::DeserializeOwned>(file: &Path) -> Result<Vec<T>, ReportError> {
    parsed(&read_text(file)?)
        .map_err(|error| ReportError::Read { file: file.to_path_buf(), problem: error.to_string() })
}

/// The rows of a text as [`rows`].
fn parsed<T: serde::de::DeserializeOwned>(text: &str) -> Result<Vec<T>, csv::Error> {
    csv::ReaderBuilder::new().comment(Some(b'#')).from_reader(text.as_bytes()).deserialize().collect()
}

/// Writes a text file whole, so that a killed program leaves the old file or the new one. Makes the folder if needed.
///
/// # Errors
/// [`ReportError::File`].
pub fn write_text(file: &Path, text: &str) -> Result<(), ReportError> {
    Ok(msdd_files::write(file, text.as_bytes())?)
}
