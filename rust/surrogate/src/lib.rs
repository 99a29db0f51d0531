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
//! | [`surrogate`] | the trait that all models implement; batches of cells |
//! | [`tracks`] | paths of strain, and errors along them |
//! | [`training_data`] | rows and paths of a database for training |
//! | [`models`] | the kinds of models by name, and those compiled in |
//! | [`increment`] | the default model: one law for thermal and mechanical strain |
//! | [`paper`], [`constant`] | the paper's network and the trivial model as implementations of the trait |
//! | [`network`] | the paper's 3-16-16-6 network and its gradient |
//! | [`levenberg_marquardt`] | the minimiser |
//! | [`fit`] | the fit of the paper's network to samples as a least-squares problem |
//! | [`training`] | the complete training of the paper's network |
//! | [`scores`] | R² (Eq. 12) |
//! | [`score`], [`composition`], [`noise`] | errors of a model on held-out packings; composed increments; noise floor |
//! | [`compared`] | ranges of the beds by which the default models were compared with DEM |
//! | [`drift`] | error of composed increments of the paper's network |
//! | [`region`] | where the training states lie, and how much packings of equal state differ |
//! | [`wall_friction`] | wall friction |
//! | [`solid_fraction`] | sum-of-areas solid fraction from porosity |
//! | [`spheres`] | the law of packings of spheres: its tracks, fit, readouts, model and scores |
//! | [`predictor`], [`model`] | the part of the paper's network that answers queries; the trained model |
//! | [`options`], [`report`] | training options and training report |
//! | [`model_file`], [`document`] | the file of the paper's network; what all model files share |
#![deny(unsafe_code)] // kernel/ alone may: vectors of the instruction sets and what calls them

pub mod compared;
pub mod composition;
pub mod constant;
pub mod dataset;
pub mod document;
pub mod drift;
mod error;
pub mod fit;
pub mod increment;
pub mod kernel;
pub mod least_squares;
pub mod levenberg_marquardt;
pub mod model;
pub mod model_file;
pub mod models;
pub mod network;
pub mod noise;
pub mod number;
pub mod options;
pub mod paper;
mod path_fit;
pub mod predictor;
pub mod region;
pub mod report;
pub mod scaling;
pub mod score;
pub mod scores;
pub mod solid_fraction;
pub mod spheres;
pub mod surrogate;
#[cfg(test)]
mod synthetic;
pub mod tracks;
pub mod training;
pub mod training_data;
pub mod wall_friction;

pub use dataset::StateRow;
pub use error::SurrogateError;
pub use levenberg_marquardt::Stopping;
pub use model::Model;
pub use options::{DatabaseProvenance, TrainingOptions};
pub use predictor::{Block, Prediction};
pub use report::Report;
pub use surrogate::Surrogate;
pub use training::{Progress, train};
