//! What is found out by runs: each study says which jobs it needs and what follows from their records.
//!
//! | module | what |
//! |---|---|
//! | [`validation`] | all cases against the discrete elements |
//! | [`targets`] | what the validation is to reach |
//! | [`front`], [`chart`] | error against cost, and the cheapest for a wanted error |
//! | [`economy`] | what each case needs |
//! | [`convergence`] | order of the coupling in time |
//! | [`sensitivity`] | what the mechanics' parameters do |
//! | [`other_cases`] | another scene, another material |
//! | [`known`] | states of the database |
//! | [`detail`] | runs that write what some figures need |

pub mod chart;
pub mod convergence;
pub mod detail;
pub mod economy;
pub mod front;
pub mod known;
pub mod other_cases;
pub mod sensitivity;
pub mod targets;
pub mod validation;
