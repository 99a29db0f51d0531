//! The default model: all variables of the state, the stress among them, advance as ε · g(state, ε); conductivity is
//! read from the state.
//!
//! Under a turn by 90° the porosity η and the pressure p̃ do not change ("even" variables), while the fabric index f,
//! the anisotropy f_K of the conductivity and the stress deviator q̃ change their sign ("odd" variables). The network
//! gets only features that are even. Its outputs are the rates of the even variables, and coefficients by which the odd
//! variables are multiplied to give the rates of the odd variables. So the symmetry holds exactly, to the last bit.
//!
//! | module | what |
//! |---|---|
//! | [`variables`] | variables of the state, their features and scales |
//! | [`rates`] | advance of the state |
//! | [`readout`] | conductivity from the state, and odd quantities that the state does not contain |
//! | [`composed_fit`] | fit of the rates to composed increments |
//! | [`pairs`] | samples from pairs of stops and from single states |
//! | [`fit`] | fit of a network as a least-squares problem |
//! | [`mean`] | the mean packed state, for a start at which the stress is not known |
//! | [`core`](mod@core) | the part of the trained model that answers queries |
//! | [`provenance`] | training options and report |
//! | [`model`] | the trained model |
//! | [`file`] | its file |
//! | [`training`] | the complete training |

pub mod composed_fit;
pub mod core;
pub mod file;
pub mod fit;
pub mod mean;
pub mod model;
pub mod pairs;
pub mod provenance;
pub mod rates;
pub mod readout;
pub mod training;
pub mod variables;
