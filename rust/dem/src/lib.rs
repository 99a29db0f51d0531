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
//! | `team`, `pace` | threads that share the work of a step, and whether sharing is faster at the moment |
//! | `stage` | the parts of a step, for timing |
//! | [`material`] | grain parameters (Table 2) |
//! | [`disc`] | one grain, packed in one cache line |
//! | [`walls`] | the box: four flat walls with prescribed velocities, and the affine motion between them |
//! | [`periodic`] | periodic boxes: the cell and the images of discs |
//! | [`law`] | contact law as pure functions (Table 1) |
//! | [`contacts`] | lists of pairs that may touch, with friction history |
//! | `grid` | the search for pairs that are near each other |
//! | `neighbours` | when to search again; the friction history is carried over |
//! | [`contact`] | one force-bearing contact, and the iteration over all of them |
//! | `forces` | contact forces of walls |
//! | `kernel` | vector kernels of the hot loops: contact forces and motion |
//! | `slabs` | the sweep: forces and motion block by block, in one pass through memory |
//! | `network` | the conductance matrix of the thermal pipes |
//! | [`heat`] | heat through the contacts (thermal pipes), in sub-steps (Eq. 5) |
//! | [`time_step`] | bound on the stable step |
//! | [`simulation`] | the state, and `step()` |
//! | [`failure`] | reasons for which a run ends early |
//! | [`run`] | many steps, with regular checks of the state |
//! | `relax` | fast relaxation (FIRE) |
//! | [`audit`] | energy audit: work, losses, stored energy |
//! | [`restore`] | the part of a state file besides discs, walls and friction history |
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
