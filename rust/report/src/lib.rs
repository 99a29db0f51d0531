//! Speed against accuracy: runs of the solver and of the discrete elements as cached jobs, compared with the committed
//! reference, as `results/report.json` and as a page that needs nothing else.
//!
//! | module | what |
//! |---|---|
//! | [`job`] | one configuration to run: a case of the solver, or a program |
//! | [`setup`] | the case folder of a job |
//! | [`grid`] | initial fields of the reference on other meshes |
//! | [`execute`] | runs a job with a time limit; what came out |
//! | [`output`] | reads what the solver wrote |
//! | [`cache`] | results of jobs by the hash of what decides them |
//! | [`pool`] | runs many jobs, some at a time |
//! | [`plan`] | the configurations of the report |
//! | [`reference`](mod@reference) | the committed runs by discrete elements |
//! | [`compare`] | errors against the reference |
//! | [`front`] | cheapest configurations, Pareto front |
//! | [`solver_table`] | the former as `msddFoam -cheapest` prints them |
//! | [`detail`] | runs that write what some figures need |
//! | [`convergence`] | order of the coupling in time |
//! | [`sensitivity`] | what the mechanics' parameters do |
//! | [`other_cases`] | another scene, another material |
//! | [`known`] | states of the database |
//! | [`economy`] | what each case needs |
//! | [`failures`] | where methods break, and what the program does there |
//! | [`targets`] | what the validation is to reach |
//! | [`report`] | all of it as data: the JSON |
//! | [`draw`] | figures as SVG |
//! | [`page`] | the page |
#![forbid(unsafe_code)]

pub mod cache;
pub mod compare;
pub mod convergence;
pub mod detail;
pub mod draw;
pub mod economy;
pub mod execute;
pub mod failures;
pub mod front;
pub mod grid;
pub mod job;
pub mod known;
pub mod other_cases;
pub mod output;
pub mod page;
pub mod plan;
pub mod pool;
pub mod reference;
pub mod report;
pub mod sensitivity;
pub mod setup;
pub mod solver_table;
pub mod targets;

use std::path::{Path, PathBuf};

/// What keeps a report from being made. A job that fails is an outcome of the job, not an error.
#[derive(Debug, thiserror::Error)]
pub enum ReportError {
    #[error("cannot read {file}: {problem}", file = file.display())]
    Read { file: PathBuf, problem: String },
    #[error("cannot write {file}: {problem}", file = file.display())]
    Write { file: PathBuf, problem: String },
    #[error(transparent)]
    File(#[from] msdd_files::FileError),
    #[error("{cache} has no result of these jobs: nothing to draw; without --draw they are run", cache = cache.display())]
    Empty { cache: PathBuf },
    #[error("cannot start {program}: {problem}")]
    Start { program: String, problem: String },
    #[error("cannot draw {figure}: {problem}")]
    Draw { figure: String, problem: String },
}

/// Reads a text file.
///
/// # Errors
/// [`ReportError::Read`].
pub fn read_text(file: &Path) -> Result<String, ReportError> {
    std::fs::read_to_string(file)
        .map_err(|error| ReportError::Read { file: file.to_path_buf(), problem: error.to_string() })
}

/// Writes a whole text file, so that a killed run leaves the old file or the new one. Makes the folder.
///
/// # Errors
/// [`ReportError::File`].
pub fn write_text(file: &Path, text: &str) -> Result<(), ReportError> {
    Ok(msdd_files::write(file, text.as_bytes())?)
}
