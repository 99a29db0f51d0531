//! Reads, makes and checks case folders of the solver `msddFoam`.
//!
//! | module | what |
//! |---|---|
//! | [`dictionary`] | OpenFOAM dictionaries as `foamDictionary -expand` prints them |
//! | `binary` | files with lists in binary |
//! | [`case`] | material, temperatures, box and times of a case folder |
//! | [`functions`] | functions of time and of temperature in dictionaries |
//! | [`model`] | the grains that the surrogate of a case was made for |
//! | [`walls`] | thermal boundary conditions of the walls over time |
//! | [`mesh`] | a case's mesh, with centres and volumes of its cells |
//! | [`results`] | times and fields that a run has written |
//! | [`section`] | a mesh in a plane: its cells as polygons |
//! | [`disc_model`] | the model of discs of a new case |
//! | [`fields`] | texts of initial fields |
//! | [`grains`] | the grains of new cases |
//! | [`material`] | materials as files, named ones and those of users |
//! | [`scene`] | the parameters of a new case |
//! | [`packing`] | the initial packing of a new case |
//! | [`folder`] | the files of a new case |
//! | [`tables`] | tables of function objects, joined over the parts of a run |
//! | [`spheres`] | new cases of beds of spheres |
//! | [`path`] | paths that OpenFOAM can work with |
//! | [`numbers`] | numbers as a person writes them |
//! | [`values`] | values in these files, as text |
//! | [`check`](mod@check) | what is missing, out of range or warned before a run |
#![forbid(unsafe_code)]

mod binary;
pub mod case;
pub mod check;
pub mod dictionary;
pub mod disc_model;
pub mod fields;
pub mod folder;
pub mod functions;
pub mod grains;
pub mod material;
pub mod mesh;
pub mod model;
pub mod numbers;
mod openfoam;
pub mod packing;
pub mod path;
pub mod ranges;
pub mod results;
pub mod scene;
#[cfg(test)]
mod scenes_for_tests;
pub mod section;
pub mod spheres;
pub mod tables;
pub mod values;
pub mod walls;

pub use case::Case;

use msdd_rve::message::{shortened, value as value_text};
use std::path::PathBuf;

/// What can be wrong with a case folder, or with the parameters of a new case.
#[derive(Debug, thiserror::Error)]
pub enum CaseError {
    #[error("{file}: {key} = {value}, allowed: {allowed}", file = file.display(), value = value_text(value))]
    Key { file: PathBuf, key: String, value: String, allowed: String },
    #[error("{file}: line {line}: {problem}", file = file.display(), problem = shortened(problem))]
    Syntax { file: PathBuf, line: usize, problem: String },
    #[error("cannot read {file}: {problem}", file = file.display())]
    Read { file: PathBuf, problem: String },
    #[error("{key} = {value}, allowed: {allowed}", value = value_text(value))]
    Parameter { key: String, value: String, allowed: String },
    #[error(transparent)]
    Rve(#[from] msdd_rve::RveError),
    #[error(transparent)]
    Model(#[from] msdd_surrogate::SurrogateError),
    #[error("cannot start threads: {0}")]
    Threads(std::io::Error),
    #[error(transparent)]
    File(#[from] msdd_files::FileError),
}

/// The error of a parameter whose value is not allowed.
fn refused(key: impl Into<String>, value: impl Into<String>, allowed: impl Into<String>) -> CaseError {
    CaseError::Parameter { key: key.into(), value: value.into(), allowed: allowed.into() }
}
