//! Beds of spheres: packing, pouring, averages, conduction of heat.
//!
//! A module uses only modules above it in this table.
//!
//! | module | what |
//! |---|---|
//! | [`random`] | seeded random numbers |
//! | [`sizes`] | diameters of unequal spheres |
//! | [`scatter`] | random loose spheres to start from |
//! | [`averages`](mod@averages) | solid fraction, coordination, stress of a periodic box |
//! | [`settle`](mod@settle) | coming to rest under gravity; turning it |
//! | [`pour`](mod@pour) | grains rain into a box or cylinder until they are at rest |
//! | [`press`](mod@press) | a wall that is pressed onto a bed |
//! | [`mod@harden`] | grains that were poured soft get their stiffness under a lid |
//! | [`wall_control`] | walls that move on a path, under a pressure, or with the compliance of a shell |
//! | [`pack`](mod@pack) | compression of a periodic box to a pressure |
//! | [`schedule`] | a quantity that is given over time |
//! | [`property`] | properties by temperature |
//! | [`units`] | numbers with units |
//! | [`gas`] | law of heat through gas: between two spheres, and to a plate |
//! | [`named_gases`] | air, nitrogen, helium, argon, vacuum |
//! | [`solid`] | law of heat through a contact, smooth or rough; stress in it |
//! | [`effective`] | from the reduced conductivities of the law of spheres to those of a bed |
//! | [`wall`] | what a wall adds to the resistance of a bed |
//! | [`conductances`] | conductances between the spheres of a simulation: contact, gas |
//! | [`plate_view_areas`](mod@plate_view_areas) | which part of a plate belongs to which sphere |
//! | [`rays`] | straight rays between spheres and walls |
//! | [`exchange`](mod@exchange) | exchange of heat by radiation between spheres and walls, by ray tracing |
//! | [`radiation`] | conductivity by radiation in closed form |
//! | [`solve`] | conjugate gradients |
//! | [`network`] | the network of a bed at rest with plates; conductances by temperature |
//! | [`transient`] | temperatures of the spheres in time |
//! | [`case`](mod@case) | the description of a bed |
//! | [`experiment`] | measured temperatures, and how far a simulation is from them |
//! | [`profile`] | a bed between two distances from a plate; probes |
//! | [`mobilised`] | how much of the friction of its contacts a packing has mobilised |
//! | [`region`] | stresses in the inner part of a bed |
//! | [`coupled`] | a bed whose walls move: heat, growth of the grains, walls, averages over time |
//! | [`cost`] | how long it takes, by an estimate |
//! | [`rows`] | its averages as a file |
//! | [`packings`] | mean and scatter of several packings of such a bed, from their files |
//! | [`bed`] | a measured bed from pouring to temperatures |
//! | [`vtk`] | grains for ParaView |
//! | [`conductivity`](mod@conductivity) | conductivity of a periodic box by its network of conductances |
#![forbid(unsafe_code)]

/// Writes enumerations by the names that serde gives them.
#[macro_export]
macro_rules! named {
    ($($type:ty)*) => {$(
        impl std::fmt::Display for $type {
            fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                serde::Serialize::serialize(self, f)
            }
        }
    )*};
}

#[cfg(test)]
#[path = "../examples/direct/mod.rs"]
mod direct;
#[cfg(test)]
extern crate self as msdd_beds;

pub mod averages;
pub mod bed;
pub mod case;
pub mod conductances;
pub mod conductivity;
pub mod cost;
pub mod coupled;
pub mod effective;
pub mod exchange;
pub mod experiment;
pub mod gas;
pub mod harden;
pub mod mobilised;
pub mod named_gases;
pub mod network;
pub mod pack;
pub mod packings;
pub mod plate_view_areas;
pub mod plates;
pub mod pour;
pub mod press;
pub mod profile;
pub mod property;
pub mod radiation;
pub mod random;
pub mod rays;
pub mod region;
pub mod rows;
pub mod scatter;
pub mod schedule;
pub mod settle;
pub mod sizes;
pub mod solid;
pub mod solve;
pub mod transient;
pub mod units;
pub mod vtk;
pub mod wall;
pub mod wall_control;

pub use averages::{Averages, averages};
pub use pack::{Packed, Packing, pack, pack_along, shake};

/// Increased by one whenever the same description and seed of a bed give other numbers: earlier results of it are then computed again.
pub const ENGINE_VERSION: u32 = 1;

/// What can go wrong with a box.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum BedError {
    #[error("packing: {key} = {value}, allowed: {allowed}", value = msdd_engine::message::number(*value))]
    Packing { key: &'static str, value: f64, allowed: &'static str },
    #[error("pouring: {key} = {value}, allowed: {allowed}", value = msdd_engine::message::number(*value))]
    Pouring { key: &'static str, value: f64, allowed: &'static str },
    #[error("packing: sizes = {0}")]
    Sizes(#[from] sizes::SizesError),
    #[error("pressing: a wall that is not flat, allowed: flat walls")]
    NotFlat,
    #[error(
        "stage '{stage}': after {time:.3} s the grains still move (kinetic energy {kinetic:.1e} of the energy of falling by a radius), \
         allowed: a bed at rest; try more friction, a lower restitution, or another pressure of lid and plate"
    )]
    NotSettled { stage: &'static str, time: f64, kinetic: f64 },
    #[error(
        "plate.wall = {wall}, with no grain next to it, allowed: a wall that the bed touches, or plate.pressure"
    )]
    WallNotTouching { wall: String },
    #[error(
        "stage 'lid': {depth:.4e} m above the floor, where lid.porosity has it, the lid does not touch the grains: the highest is at \
         {highest:.4e} m, allowed: a smaller lid.porosity"
    )]
    LidNotTouching { depth: f64, highest: f64 },
    /// `key`: that of the distance \[m\].
    #[error("{key} = {distance}, allowed: distances from the wall at which there are grains")]
    NoGrains { key: &'static str, distance: f64 },
    #[error("record.heights: up to {high} m, allowed: up to the depth of the poured bed, {depth:.4} m")]
    Heights { high: f64, depth: f64 },
    #[error(
        "averages at {time} s: no {name} that a bed has, allowed: a region ('record') with more loaded spheres, and a bed at rest"
    )]
    Averages { name: &'static str, time: f64 },
    #[error(
        "at {time} s spheres overlap by {:.0} % of their radius, allowed: up to {:.0} %, beyond which Hertz's law has no meaning: less \
         expansion, strain or pressure", 100.0 * overlap, 100.0 * most
    )]
    Overlap { time: f64, overlap: f64, most: f64 },
    #[error(transparent)]
    NotConverged(#[from] transient::NotConverged),
    #[error(transparent)]
    Radiation(#[from] exchange::OutOfRange),
    #[error("cannot start threads: {0}")]
    Threads(String),
    #[error(transparent)]
    Material(#[from] msdd_spheres::MaterialError),
    #[error("packing: room for {placed} of {wanted} spheres only")]
    NoRoom { placed: usize, wanted: usize },
    #[error(transparent)]
    SmallCell(#[from] msdd_spheres::boundary::SmallCell),
    #[error(transparent)]
    Failure(#[from] msdd_spheres::Failure),
}
