//! Three-dimensional discrete element engine for spheres between walls (flat, cylinders), or in a periodic box.
//!
//! SI units throughout. What discs need, too (threads, search for pairs, images in periodic boxes, the loop of a run),
//! is in `msdd-engine`. [`Simulation::step`] reads as the algorithm: boundaries, neighbours, contact forces, motion.
//!
//! A module uses only modules above it in this table.
//!
//! | module | what |
//! |---|---|
//! | [`space`] | vectors with three components, of one or several grains at a time |
//! | [`material`] | parameters of the grains |
//! | [`sphere`] | one grain, in two cache lines |
//! | [`boundary`] | walls, flat or cylinders; periodic cells with strain and shear |
//! | [`law`] | contact laws (Hertz–Mindlin–Coulomb, linear) as pure functions |
//! | `contacts` | lists of pairs that may touch, with friction history |
//! | `neighbours` | when to search again; the friction history is carried over |
//! | [`contact`] | one contact, and the iteration over all of them |
//! | `forces` | resultants on the spheres; contact forces of walls |
//! | `kernel` | vector kernels of the hot loops: contact forces and motion |
//! | `slabs` | the sweep: forces and motion, in parallel for large assemblies |
//! | [`time_step`] | bound on the stable step |
//! | [`failure`] | reasons for which a run ends early |
//! | [`simulation`] | the state, and `step()` |
//! | [`state`] | all that a run needs to continue bit for bit |
//! | [`run`] | many steps, with regular checks of the state |
//! | [`relax`] | fast relaxation (FIRE) |
//! | [`audit`] | energy audit |
#![deny(unsafe_code)]

pub mod audit;
pub mod boundary;
pub mod contact;
mod contacts;
pub mod failure;
mod forces;
mod kernel;
pub mod law;
pub mod material;
mod neighbours;
pub mod relax;
pub mod run;
pub mod simulation;
mod slabs;
pub mod space;
pub mod sphere;
pub mod state;
pub mod time_step;

pub use boundary::{Boundary, Cell, SmallCell, Surface, Wall};
pub use contact::{Contact, Partner};
pub use failure::Failure;
pub use forces::Load;
pub use law::{ContactLaw, History};
pub use material::{Material, MaterialError, Stiffness};
pub use msdd_engine::{Excess, Image, Simd, StepChoice};
pub use simulation::Simulation;
pub use sphere::Sphere;
pub use state::State;
