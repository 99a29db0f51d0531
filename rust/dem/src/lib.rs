//! Two-dimensional discrete element engine for discs between flat walls, or in a periodic box.
//!
//! Discs are cylinders of unit length (1 m) in a plane. SI units throughout; forces are those on the 1 m depth.
//! [`Simulation::step`] reads as the algorithm: boundaries, neighbours, contact forces, motion.
//!
//! A module uses only modules above it in this table, so that laws and lists can be read and tested alone. What
//! spheres need, too (threads, search for pairs, images in periodic boxes, the loop of a run), is in `msdd-engine`.
//!
//! | module | what |
//! |---|---|
//! | [`material`] | grain parameters (Table 2) |
//! | [`disc`] | one grain, packed in one cache line |
//! | [`walls`] | the box: four flat walls with prescribed velocities, and the affine motion between them |
//! | [`periodic`] | periodic boxes: the cell and the images of discs |
//! | [`law`] | contact law as pure functions (Table 1) |
//! | [`contacts`] | lists of pairs that may touch, with friction history |
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
pub mod heat;
mod kernel;
pub mod law;
pub mod material;
mod neighbours;
mod network;
pub mod periodic;
mod relax;
pub mod restore;
pub mod run;
pub mod simulation;
mod slabs;
pub mod time_step;
pub mod walls;

pub use contact::Contact;
pub use disc::Disc;
pub use failure::Failure;
pub use heat::{HeatPipes, HeatState, Thermal, WallHeat};
pub use material::{Material, MaterialError};
pub use msdd_engine::{Simd, Stage, message};
pub use periodic::{Cell, Image, Periodic};
pub use restore::RunState;
pub use simulation::Simulation;
pub use time_step::{Excess, StepChoice};
pub use walls::{Flow, Side, Walls};
