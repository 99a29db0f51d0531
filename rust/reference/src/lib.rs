//! The reference: all grains of a case's box by discrete elements (section 3.2), run from the solver's own case files.
//!
//! | module | what |
//! |---|---|
//! | [`dictionary`] | OpenFOAM dictionaries as `foamDictionary -expand` prints them |
//! | [`case`] | material, temperatures, box and times of a case folder |
//! | [`mesh`] | cell centres of a case's mesh |
//! | [`model`] | the packed initial model and its statistics |
//! | [`mod@observe`] | what is recorded of a state: series, sub-regions, profiles |
//! | [`run`](mod@run) | heat, expansion and motion to the end time |
//! | [`checkpoint`] | what a killed run continues from |
//! | [`fields`] | initial fields for the solver |
//! | [`results`] | result files |
//! | [`packings`] | the committed runs, three packings a case |
//! | [`solver`] | what the solver wrote into a case folder |
//! | [`series`] | interpolation, means and deviations |
//! | [`compare`] | the solver's errors against the discs |
//! | [`walls`] | what walls do to heat, over time |
#![forbid(unsafe_code)]

pub mod case;
pub mod checkpoint;
pub mod compare;
pub mod dictionary;
pub mod fields;
pub mod mesh;
pub mod model;
pub mod observe;
pub mod packings;
pub mod results;
pub mod run;
pub mod series;
pub mod solver;
pub mod walls;

pub use case::Case;
pub use model::{Model, ModelSpec, Statistics};
pub use run::{RunSpec, run};

use msdd_rve::message::{shortened, value as value_text};
use std::path::PathBuf;

/// What can be wrong with a case, or go wrong in a run.
#[derive(Debug, thiserror::Error)]
pub enum ReferenceError {
    #[error("{file}: {key} = {value}, allowed: {allowed}", file = file.display(), value = value_text(value))]
    Key { file: PathBuf, key: String, value: String, allowed: String },
    #[error("{file}: line {line}: {problem}", file = file.display(), problem = shortened(problem))]
    Syntax { file: PathBuf, line: usize, problem: String },
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
