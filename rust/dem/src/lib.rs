//! Two-dimensional discrete element engine for discs between flat walls, or in a periodic box.
//!
//! Discs are cylinders of unit length (1 m) in a plane. SI units throughout; forces are those on the 1 m depth.
//! [`Simulation::step`] reads as the algorithm: boundaries, neighbours, contact forces, motion.
//!
//! A module uses only modules above it in this table, so that laws and lists can be read and tested alone.
//!
//! | module | what |
//! |---|---|
//! | `vector` | arithmetic on one or several discs at a time |
//! | `team`, `pace` | threads that share a step, and whether they pay at the moment |
//! | `stage` | the parts of a step, for timing |
//! | [`material`] | grain parameters (Table 2) |
//! | [`disc`] | one grain, packed in one cache line |
//! | [`walls`] | the box: four flat walls with prescribed velocities |
//! | [`periodic`] | periodic boxes: the cell and the images of discs |
//! | [`law`] | contact law as pure functions (Table 1) |
//! | [`contacts`] | pairs that may touch, in rows, with friction history |
//! | `grid` | the search for pairs that are near each other |
//! | `neighbours` | when to search again; histories that outlive it |
//! | [`contact`] | one contact, and the way through all of them |
//! | `forces` | contact forces of walls |
//! | `kernel` | vector kernels of the hot loops: contact forces and motion |
//! | `slabs` | the sweep: forces and motion block by block |
//! | `network` | the pipes as a sparse matrix |
//! | [`heat`] | thermal pipes, sub-stepped (Eq. 5) |
//! | [`time_step`] | bound on the stable step |
//! | [`simulation`] | the state, and `step()` |
//! | [`failure`] | why a run ends before its time |
//! | [`run`] | many steps, watched |
//! | `relax` | fast relaxation (FIRE) |
//! | [`audit`] | where the energy goes |
//! | [`restore`] | what a state file holds beside the discs |
#![deny(unsafe_code)]

pub mod audit;
pub mod contact;
pub mod contacts;
pub mod disc;
pub mod failure;
mod forces;
mod grid;
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
mod stage;
mod team;
pub mod time_step;
mod vector;
pub mod walls;

pub use contact::Contact;
pub use disc::Disc;
pub use failure::Failure;
pub use heat::{HeatPipes, HeatState, Thermal, WallHeat};
pub use kernel::Simd;
pub use material::{Material, MaterialError};
pub use periodic::{Cell, Image, Periodic};
pub use restore::RunState;
pub use simulation::Simulation;
pub use stage::Stage;
pub use time_step::{Excess, StepChoice};
pub use walls::{Flow, Side, Walls};
