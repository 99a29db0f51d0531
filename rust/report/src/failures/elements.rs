//! Limits of DEM.

use crate::jobs::job::Job;
use crate::plan;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// Largest stable time steps of 500 discs, as `bench stability` prints them \[s\].
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct StableStep {
    pub porosity: f64,
    /// Predicted by the bound, measured.
    pub mechanical: [f64; 2],
    pub thermal: [f64; 2],
}

/// What `bench limits`, an example of `rust/cli`, prints.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Limits {
    pub packings: u64,
    pub ramp_rate: Vec<RampRate>,
    pub balance: Vec<Balance>,
    pub wall_speed: Vec<WallSpeed>,
    pub unjamming: Vec<Unjamming>,
}

/// Pressure after a strain at a rate, against that at the lowest rate [%].
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct RampRate {
    pub strain: f64,
    /// Strain rate [1/s].
    pub rate: f64,
    pub pressure_mean: f64,
    pub pressure_rms: f64,
    pub not_settled: u64,
}

/// Difference of the pressure after a strain when a state counts as equilibrium at `unbalanced`, from that at the strictest
/// limit [%].
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Balance {
    pub strain: f64,
    /// Limit of the unbalanced force: mean resultant force on a grain over mean contact force [-].
    pub unbalanced: f64,
    pub pressure_mean: f64,
    pub pressure_rms: f64,
    pub not_settled: u64,
}

/// Packings that were compressed at a speed of the walls: mean and standard deviation.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct WallSpeed {
    /// Speed of the walls [m/s].
    pub speed: f64,
    pub failed: u64,
    /// Pressure \[Pa\].
    pub pressure: [f64; 2],
    pub porosity: [f64; 2],
    pub fabric_index: [f64; 2],
}

/// Means over the packings at a strain, of DEM and of each model.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Unjamming {
    pub strain: f64,
    pub by: BTreeMap<String, Answer>,
}

#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Answer {
    /// K/k, mean of xx and yy [-].
    pub conductivity: f64,
    /// Pressure \[Pa\].
    pub pressure: f64,
}

/// The shipped models of discs.
pub const MODELS: [&str; 2] = ["rust/surrogate/models/increment.json", "rust/surrogate/models/paper.json"];

pub fn stability(quick: bool) -> Job {
    let porosities = if quick { "0.09,0.12" } else { "0.06,0.07,0.08,0.09,0.1,0.12,0.14,0.17" };
    plan::tool(&format!("bench stability --porosity {porosities}"), &["rust/cli/examples/bench"], None, 300)
}

pub fn limits(quick: bool) -> Job {
    let [first, second] = MODELS;
    let packings = if quick { 1 } else { 8 };
    let run =
        format!("bench limits --packings {packings} --model {first} --model {second} --out WORK/limits.json");
    plan::tool(
        &run,
        &["rust/cli/examples/bench", "rust/surrogate/src", first, second],
        Some("limits.json"),
        600,
    )
}
