//! Representative volume elements (RVEs): square boxes of a few hundred discs that are packed, expanded and averaged.
//!
//! | module | what |
//! |---|---|
//! | [`pack`](mod@pack) | random discs; walls close until a target porosity; relaxation |
//! | [`expand`] | ramps of thermal strain and wall strain, with stops |
//! | [`place`] | seeded random numbers, random loose discs to start from |
//! | [`settle`] | relaxation to static equilibrium, and how it ended |
//! | [`region`] | the averaging region: a convex polygon |
//! | [`area`] | exact area of a union of discs inside a polygon |
//! | [`homogenise`](mod@homogenise) | porosity, fabric, conductivity, stress (Eqs. 8–11) |
//! | [`network`] | conductivity from the solved network of contacts |
//! | [`slide`](mod@slide) | long walls slip along the grains: mobilised wall friction |
//! | [`state`] | state files: one assembly as JSON |
//! | [`window`](mod@window) | averages over rectangles of a large assembly |
//! | [`last_good`] | writing the last good state of a run that failed |
//! | [`message`] | shortening of long values in messages |
//! | [`vtk`] | ParaView files |
//! | [`stopwatch`] | time spent in each part of the work |
//! | [`spheres`] | periodic boxes of spheres: strain and averages |
//! | [`database`] | plan, generation, storage, export |
#![forbid(unsafe_code)]

pub mod area;
pub mod database;
pub mod expand;
#[cfg(test)]
mod heat_check_tests;
pub mod homogenise;
pub mod last_good;
pub mod message;
pub mod network;
pub mod pack;
pub mod place;
pub mod region;
mod resistors;
pub mod scale;
pub mod settle;
pub mod slide;
pub mod spheres;
pub mod state;
mod state_file;
pub mod stopwatch;
pub mod vtk;
pub mod window;

pub use expand::{Protocol, Ramp, Stop, Strains, follow};
pub use homogenise::{Averages, homogenise, homogenise_affine_in, homogenise_in};
pub use msdd_dem::{Material, Simulation};
pub use pack::{
    Boundary, Compression, Packed, PackingSpec, Preparation, Stopped, pack, pack_as, pack_watched,
};
pub use region::{Cut, RegionKind};
pub use settle::{Outcome, Relaxation, Settled, unbalanced_force};
pub use slide::slide;
pub use window::{Window, window, window_around, windows};

/// Errors in an RVE's specification or during its making.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum RveError {
    #[error(transparent)]
    Material(#[from] msdd_dem::MaterialError),
    #[error("{key} = {value}, allowed: {allowed}", value = message::value(value))]
    Parameter { key: &'static str, value: String, allowed: String },
    #[error(
        "only {placed} of {wanted} discs could be placed without overlap: choose a looser start or fewer discs"
    )]
    NoRoom { placed: usize, wanted: usize },
    #[error("packing stopped at porosity {reached:.4} after {steps} steps, target {target:.4}")]
    TargetNotReached { reached: f64, target: f64, steps: u64 },
    #[error(transparent)]
    Cell(#[from] msdd_dem::periodic::SmallCell),
    #[error(transparent)]
    Failure(#[from] msdd_dem::Failure),
}

impl RveError {
    /// A parameter that is not allowed.
    pub(crate) fn parameter<T>(
        key: &'static str,
        value: impl ToString,
        allowed: impl Into<String>,
    ) -> Result<T, Self> {
        Err(Self::Parameter { key, value: value.to_string(), allowed: allowed.into() })
    }
}
