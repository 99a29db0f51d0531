//! The studies of the report. Each study says which jobs it needs, and computes its results from their records.
//!
//! | module | what |
//! |---|---|
//! | [`validation`] | all cases against DEM |
//! | [`targets`] | the accuracy that the validation has to reach |
//! | [`front`], [`chart`] | error against cost, and the cheapest configuration for a wanted error |
//! | [`economy`] | how much of a case has to be computed |
//! | [`convergence`] | order of the coupling in time |
//! | [`sensitivity`] | influence of the parameters of the mechanics |
//! | [`other_cases`] | another geometry, another material |
//! | [`requests`] | what became of requests for an accuracy in the reference scenes |
//! | [`spheres`] | beds of spheres against DEM and measurements |
//! | [`known`] | states of the database |
//! | [`detail`] | runs that write additional data for figures |

pub mod chart;
pub mod convergence;
pub mod detail;
pub mod economy;
pub mod front;
pub mod known;
pub mod other_cases;
pub mod requests;
pub mod sensitivity;
pub mod spheres;
pub mod targets;
pub mod validation;
