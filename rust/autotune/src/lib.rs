//! Finds out what a scene needs for a wanted accuracy of T and p, by short runs of the solver on the scene itself.
//!
//! | module | what |
//! |---|---|
//! | [`user_case`] | what of the user's case can be chosen: mesh, times, whether grains move |
//! | [`mirror`] | boxes of which one half is enough |
//! | [`settings`] | one combination of choices |
//! | [`quantity`] | what runs are compared in |
//! | [`series`] | values at points and times, and how far two runs are apart |
//! | [`average`] | initial fields on other meshes of a box |
//! | [`trial`] | the case folder of a combination, and its run |
//! | [`bed`] | the bed as far as the bands need to know it |
//! | [`bands`] | how far the discs of a real bed may lie from a run |
//! | [`found`] | what a search finds, and what it has seen on the way |
//! | [`runs`] | the runs of a search, and how far they are apart |
//! | [`cells`] | how many cells along each direction |
//! | [`search`] | which combination is the cheapest that is accurate enough |
//! | [`interval`] | the bands around the chosen run |
//! | [`record`] | what was tried, chosen and estimated, for people and for programs |
#![forbid(unsafe_code)]

pub mod average;
pub mod bands;
pub mod bed;
pub mod cells;
pub mod found;
pub mod interval;
pub mod mirror;
mod program;
pub mod quantity;
pub mod record;
pub mod runs;
pub mod search;
pub mod series;
pub mod settings;
pub mod trial;
pub mod user_case;

use std::path::PathBuf;

/// Why nothing can be chosen.
#[derive(Debug, thiserror::Error)]
pub enum ChoiceError {
    #[error(transparent)]
    Case(#[from] msdd_case::CaseError),
    #[error(transparent)]
    File(#[from] msdd_files::FileError),
    #[error("cannot run {program} in {folder}: {problem}", folder = folder.display())]
    Run { program: String, folder: PathBuf, problem: String },
    #[error("{}: {problem}", file.display())]
    Read { file: PathBuf, problem: String },
    #[error(
        "{} is there and was not made by msdd, which would replace it: move it away",
        folder.display()
    )]
    Foreign { folder: PathBuf },
    #[error("{}: {reason}", missed.iter().map(ToString::to_string).collect::<Vec<_>>().join("; "))]
    OutOfReach { missed: Vec<Missed>, reason: String },
}

/// A wanted accuracy that cannot be had.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Missed {
    /// Its key in `system/fvSolution`: `accuracy` or `pressureAccuracy`.
    pub key: &'static str,
    pub asked: f64,
    /// The best that can be had \[% of the range\].
    pub best: f64,
}

impl std::fmt::Display for Missed {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let Self { key, asked, best } = self;
        match *best <= 100.0 {
            true => write!(f, "{key} = {asked} %, allowed: at least {best:.2} % for this scene"),
            false => {
                write!(f, "{key} = {asked} %, allowed: none for this scene, where the best is {best:.2} %")
            }
        }
    }
}
