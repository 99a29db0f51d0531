//! Jobs: runs of the solver or of `msdd` in folders of their own, within a time limit, with a cache of their results.
//!
//! | module | what |
//! |---|---|
//! | [`job`] | one configuration to run: a case of the solver, or a program |
//! | [`grid`] | initial fields of the reference on other meshes |
//! | [`setup`] | the case folder of a job |
//! | [`spheres`] | the case folder of a job with spheres, and what a run in it has given |
//! | [`user_case`] | copies of a case of the user's: how they are made, and what a run in them has given |
//! | [`execute`] | runs a job and records its results |
//! | [`cache`] | results of jobs, by a hash of everything that they depend on |
//! | [`pool`] | runs many jobs, several at the same time |

pub mod cache;
pub mod execute;
pub mod grid;
pub mod job;
pub mod pool;
pub mod setup;
pub mod spheres;
pub mod user_case;
