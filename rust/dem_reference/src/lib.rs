//! The reference: simulates all grains in the box of a case by DEM (section 3.2 of the paper), with the
//! parameters from the solver's own case files.
//!
//! | module | what |
//! |---|---|
//! | [`model`] | the packed initial model and its statistics |
//! | [`start`] | the start of a case compared with that packing |
//! | [`mod@observe`] | what is recorded of a state: series, sub-regions, profiles |
//! | [`run`](mod@run) | heat, expansion and motion to the end time |
//! | [`checkpoint`] | files from which a killed run continues |
//! | [`fields`] | initial fields for the solver |
//! | [`results`] | result files |
//! | [`packings`] | the committed runs, three packings for each case |
//! | [`solver`] | reads the solver's results from a case folder |
//! | [`series`] | interpolation, means and deviations |
//! | [`compare`] | the solver's errors against the discs |
//!
//! Case folders are read by [`msdd_case`].
#![forbid(unsafe_code)]

pub mod checkpoint;
pub mod compare;
pub mod fields;
pub mod model;
pub mod observe;
pub mod packings;
pub mod results;
pub mod run;
pub mod series;
pub mod solver;
pub mod start;

pub use model::{Model, ModelSpec, Statistics};
pub use msdd_case::Case;
pub use run::{RunSpec, run};

use msdd_rve::message::value as value_text;
use std::path::PathBuf;

/// What can be wrong with a case, or go wrong in a run.
#[derive(Debug, thiserror::Error)]
pub enum ReferenceError {
    #[error(transparent)]
    Case(#[from] msdd_case::CaseError),
    #[error("cannot read {file}: {problem}", file = file.display())]
    Read { file: PathBuf, problem: String },
    #[error("{key} = {value}, allowed: {allowed}", value = value_text(value))]
    Parameter { key: &'static str, value: String, allowed: String },
    #[error(
        "checkpoint {file}: {problem}; when the file is deleted, the run starts from its beginning", file = file.display()
    )]
    Checkpoint { file: PathBuf, problem: String },
    #[error(transparent)]
    Rve(#[from] msdd_rve::RveError),
    #[error(transparent)]
    State(#[from] msdd_rve::state::StateError),
    #[error(transparent)]
    Failure(#[from] msdd_dem::Failure),
    #[error(transparent)]
    Json(#[from] serde_json::Error),
    #[error(transparent)]
    File(#[from] msdd_files::FileError),
    #[error("cannot start threads: {0}")]
    Threads(#[from] std::io::Error),
    #[error("{0}")]
    Watch(String),
}
