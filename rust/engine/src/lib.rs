//! What discrete element engines in two and in three dimensions share: everything but the grains themselves, their
//! contact laws and their averages.
//!
//! The engine of discs is `msdd-dem`, that of spheres `msdd-spheres`. Where only places of grains matter (search for
//! pairs, images in a periodic box, how long a list of pairs stays valid) the number of dimensions is a parameter `D`.
//! A grain here is a disc or a sphere.
//!
//! A module uses only modules above it in this table.
//!
//! | module | what |
//! |---|---|
//! | [`message`] | numbers in messages |
//! | [`vector`] | arithmetic on one or several grains at a time |
//! | [`team`], [`pace`] | threads that share the work of a step, and whether sharing is faster at the moment |
//! | [`stage`] | the parts of a step, for timing |
//! | [`time_step`] | how the mechanical step is chosen |
//! | [`fire`] | the descent of the minimiser FIRE |
//! | [`rows`] | pairs that may touch, in rows, slabs and blocks |
//! | [`grain`] | what the searches ask a grain |
//! | [`lattice`] | periodic cells and images |
//! | [`grid`] | the search for pairs that are near each other |
//! | [`skin`] | how long a list of pairs stays valid |
//! | [`kernel`] | vectors of the instruction sets; one array of grains for several threads |
//! | [`run`] | many steps, with regular checks of the state |
#![deny(unsafe_code)]

pub mod fire;
pub mod grain;
pub mod grid;
pub mod kernel;
pub mod lattice;
pub mod message;
pub mod pace;
pub mod rows;
pub mod run;
pub mod skin;
pub mod stage;
pub mod team;
pub mod time_step;
pub mod vector;

pub use grain::Grain;
pub use kernel::Simd;
pub use lattice::{Image, Lattice, Shift};
pub use run::{Assembly, LastGood, Threads};
pub use stage::Stage;
pub use time_step::{Excess, StepChoice};
