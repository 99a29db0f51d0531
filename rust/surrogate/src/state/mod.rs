//! The default model: all variables of the state, the stress among them, advance as ε · g(state, ε); conductivity is
//! read from the state.
//!
//! Under a turn by 90° the porosity η and the pressure p̃ keep their sign (even), while the fabric index f, the
//! conductivity's f_K and the stress deviator q̃ change it (odd). A network that sees even features alone gives the
//! rates of the even variables, and coefficients that multiply the odd ones to give the rates of the odd variables: so
//! the symmetry is exact, to the bit.
//!
//! | module | what |
//! |---|---|
//! | [`variables`] | which variables the state has, their features and scales |
//! | [`rates`] | advance of the state |
//! | [`readout`] | conductivity, and odd quantities that the state does not carry |
//! | [`composed_fit`] | fit of the rates to composed increments |
//! | [`pairs`] | pairs of stops and states as samples |
//! | [`fit`] | fit of a network as a least-squares problem |
//! | [`mean`] | the mean state, when the stress at the start is not known |
//! | [`core`](mod@core) | what of the trained model answers queries |
//! | [`provenance`] | how it was trained, and how that went |
//! | [`model`] | the trained model |
//! | [`file`] | its file |
//! | [`training`] | the whole training |

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
