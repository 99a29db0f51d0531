//! Boxes of spheres: packing, averages, conduction of heat.
//!
//! A module uses only modules above it in this table.
//!
//! | module | what |
//! |---|---|
//! | [`scatter`] | seeded random numbers, random loose spheres to start from |
//! | [`averages`] | solid fraction, coordination, stress of a periodic box |
//! | [`pack`](mod@pack) | isotropic compression of a periodic box to a pressure |
//! | [`links`] | conductances between two spheres: contact, gas |
//! | [`conductivity`](mod@conductivity) | conductivity of a periodic box by its network of conductances |
#![forbid(unsafe_code)]

pub mod averages;
pub mod conductivity;
pub mod links;
pub mod pack;
pub mod scatter;

pub use averages::{Averages, averages};
pub use pack::{Packed, Packing, pack};

/// What can go wrong with a box.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum BedError {
    #[error("packing: {key} = {value}, allowed: {allowed}", value = msdd_engine::message::number(*value))]
    Packing { key: &'static str, value: f64, allowed: &'static str },
    #[error(transparent)]
    Material(#[from] msdd_spheres::MaterialError),
    #[error("packing: room for {placed} of {wanted} spheres only")]
    NoRoom { placed: usize, wanted: usize },
    #[error(transparent)]
    SmallCell(#[from] msdd_spheres::boundary::SmallCell),
    #[error(transparent)]
    Failure(#[from] msdd_spheres::Failure),
}
