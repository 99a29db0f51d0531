//! Two-dimensional discrete element engine for discs between flat walls, or in a periodic box.
//!
//! Discs are cylinders of unit length (1 m) in a plane. SI units throughout; forces are those on the 1 m depth.
//! [`Simulation::step`] reads as the algorithm: boundaries, neighbours, contact forces, motion.
//!
//! | module | what |
//! |---|---|
//! | [`material`] | grain parameters (Table 2) |
//! | [`law`] | contact law as pure functions (Table 1) |
//! | [`disc`] | one grain, packed in one cache line |
//! | [`walls`] | the box: four flat walls with prescribed velocities |
//! | [`periodic`] | periodic boxes: the cell, images, ghosts |
//! | [`contact`] | one contact, as averages see it |
//! | [`contacts`] | candidate pairs in rows, with friction history |
//! | `neighbours` | the search that fills the rows |
//! | `forces` | contact forces of walls |
//! | `kernel` | vector kernels of the hot loops |
//! | `slabs` | the sweep: forces and motion block by block |
//! | `team` | threads that share a step |
//! | `pace` | whether threads pay at the moment |
//! | `network` | the pipes as a sparse matrix |
//! | [`heat`] | thermal pipes, sub-stepped (Eq. 5) |
//! | [`time_step`] | bound on the stable step |
//! | [`run`] | many steps, watched; typed failures |
//! | `relax` | fast relaxation (FIRE) |
//! | [`audit`] | where the energy goes |
//! | [`restore`] | what a state file holds beside the discs |
//! | [`simulation`] | the state, and `step()` |
#![deny(unsafe_code)]

pub mod audit;
pub mod contact;
pub mod contacts;
pub mod disc;
mod forces;
pub mod heat;
mod kernel;
pub mod law;
pub mod material;
pub mod message;
mod neighbours;
mod network;
mod pace;
pub mod periodic;
mod relax;
pub mod restore;
pub mod run;
pub mod simulation;
mod slabs;
mod team;
pub mod time_step;
pub mod walls;

pub use contact::Contact;
pub use disc::Disc;
pub use heat::{HeatPipes, HeatState, Thermal, WallHeat};
pub use kernel::Simd;
pub use material::{Material, MaterialError};
pub use periodic::{Cell, Image, Periodic};
pub use restore::RunState;
pub use run::Failure;
pub use simulation::{Simulation, Stage};
pub use time_step::{Excess, StepChoice};
pub use walls::{Flow, Side, Walls};
