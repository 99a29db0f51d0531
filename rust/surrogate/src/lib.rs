//! Surrogate model of granular RVEs: (η, f, ε) → (Δη, Δf, K/k, σ ℓ/(E r̄)), the paper's Φ (sections 2.6 and 3.1.2).
//!
//! Dimensionless throughout; compression positive. Training runs offline ([`train`]); inference is
//! [`Model::block`], a block of cells at a time.
//!
//! | module | what |
//! |---|---|
//! | [`dataset`] | states of the database, training samples, 90° rotation, split by packing |
//! | [`scaling`] | trained range (clamping) and scales of inputs and outputs |
//! | [`kernel`] | the network's arithmetic, vectorised |
//! | [`network`] | the paper's 3-16-16-6 network and its gradient |
//! | [`levenberg_marquardt`] | the minimiser |
//! | [`fit`] | the network's fit to samples as a least-squares problem |
//! | [`training`] | the whole training |
//! | [`scores`] | R² (Eq. 12) |
//! | [`drift`] | error of composed increments |
//! | [`solid_fraction`] | sum-of-areas solid fraction from porosity |
//! | [`model`] | the trained surrogate |
//! | [`model_file`] | its file |
#![deny(unsafe_code)] // kernel.rs alone may: calls of functions compiled for a wider instruction set

pub mod ablation;
pub mod composition;
pub mod constant;
pub mod dataset;
pub mod drift;
mod error;
pub mod fit;
pub mod kernel;
pub mod least_squares;
pub mod levenberg_marquardt;
pub mod mechanics;
pub mod model;
pub mod model_file;
pub mod models;
pub mod network;
pub mod noise;
pub mod paper;
pub mod perceptron;
pub mod region;
pub mod scaling;
pub mod score;
pub mod scores;
pub mod solid_fraction;
pub mod state;
pub mod surrogate;
#[cfg(test)]
mod synthetic;
pub mod training;
pub mod wall_friction;

pub use dataset::StateRow;
pub use error::SurrogateError;
pub use levenberg_marquardt::Stopping;
pub use model::{Block, Model, Prediction};
pub use model_file::DatabaseProvenance;
pub use surrogate::Surrogate;
pub use training::{Progress, Report, TrainingOptions, train};
