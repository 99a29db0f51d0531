//! One row of the database: one state of one packing.

use super::plan::Job;
use crate::{Averages, Compression, Material, Settled};
use serde::{Deserialize, Serialize};

/// One state at one stop of a ramp. The packed state is stop 0 of the ramp "packed", with strain 0; stops of the ramps
/// "up" and "down" count from 1. Averages are absent when the job failed.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Record {
    pub packing: i64,
    pub seed: u64,
    pub compression: Compression,
    pub target_porosity: f64,
    pub ramp: String,
    pub stop: i64,
    pub strain: f64,
    pub outcome: String,
    pub steps: u64,
    pub unbalanced: Option<f64>,
    pub young_modulus: f64,
    pub initial_porosity: Option<f64>,
    pub initial_fabric_index: Option<f64>,
    pub porosity: Option<f64>,
    pub porosity_sum_of_areas: Option<f64>,
    pub overlap_fraction: Option<f64>,
    pub fabric_index: Option<f64>,
    pub fabric_conductivity: Option<f64>,
    pub conductivity_xx: Option<f64>,
    pub conductivity_yy: Option<f64>,
    pub conductivity_xy: Option<f64>,
    pub stress_xx: Option<f64>,
    pub stress_yy: Option<f64>,
    pub stress_xy: Option<f64>,
    pub stress_yx: Option<f64>,
    pub pressure: Option<f64>,
    pub stress_xx_over_young_modulus: Option<f64>,
    pub stress_yy_over_young_modulus: Option<f64>,
    pub coordination: Option<f64>,
    pub rattlers: Option<u64>,
    pub contacts: Option<u64>,
    pub mean_radius: Option<f64>,
}

/// A column: name, SQLite type, unit, meaning.
pub struct Column(pub &'static str, pub &'static str, pub &'static str, pub &'static str);

/// The columns, in the order of [`Record`]'s fields.
#[rustfmt::skip]
pub const COLUMNS: [Column; 32] = [
    Column("packing", "INTEGER", "-", "index of the packing in the plan"),
    Column("seed", "INTEGER", "-", "seed of the packing"),
    Column("compression", "TEXT", "-", "isotropic: walls close in x and y; horizontal: in x only"),
    Column("target_porosity", "REAL", "-", "porosity of the whole box at which the walls stopped, overlaps counted once"),
    Column("ramp", "TEXT", "-", "packed: before any strain; up: expansion; down: contraction"),
    Column("stop", "INTEGER", "-", "place on the ramp; 0 is the packed state"),
    Column("strain", "REAL", "-", "radial thermal strain relative to the packed state"),
    Column("outcome", "TEXT", "-", "settled; capped: step cap before balance; unjammed: bears no load; failed: reason"),
    Column("steps", "INTEGER", "-", "time steps from the previous stop"),
    Column("unbalanced", "REAL", "-", "mean resultant force over mean contact force"),
    Column("young_modulus", "REAL", "Pa", "E of the grains"),
    Column("initial_porosity", "REAL", "-", "porosity of the packed state (input of the paper's database)"),
    Column("initial_fabric_index", "REAL", "-", "fabric index of the packed state (input of the paper's database)"),
    Column("porosity", "REAL", "-", "of the region, overlaps counted once"),
    Column("porosity_sum_of_areas", "REAL", "-", "1 - sum of disc areas / box area"),
    Column("overlap_fraction", "REAL", "-", "part of the region covered more than once"),
    Column("fabric_index", "REAL", "-", "F_xx - F_yy, Eq. 8"),
    Column("fabric_conductivity", "REAL", "-", "(K_xx - K_yy)/(K_xx + K_yy)"),
    Column("conductivity_xx", "REAL", "-", "K_xx / k, affine, Eq. 9"),
    Column("conductivity_yy", "REAL", "-", "K_yy / k, affine, Eq. 9"),
    Column("conductivity_xy", "REAL", "-", "K_xy / k, affine, Eq. 9"),
    Column("stress_xx", "REAL", "Pa", "Love stress, Eq. 10, compression positive"),
    Column("stress_yy", "REAL", "Pa", "Love stress, Eq. 10, compression positive"),
    Column("stress_xy", "REAL", "Pa", "Love stress, branch x, force y"),
    Column("stress_yx", "REAL", "Pa", "Love stress, branch y, force x"),
    Column("pressure", "REAL", "Pa", "(stress_xx + stress_yy)/2, Eq. 11"),
    Column("stress_xx_over_young_modulus", "REAL", "-", "the paper's scaling; grows with the grain size"),
    Column("stress_yy_over_young_modulus", "REAL", "-", "the paper's scaling; grows with the grain size"),
    Column("coordination", "REAL", "-", "contacts of a disc that has any, walls included, mean"),
    Column("rattlers", "INTEGER", "-", "discs without contact, whole box"),
    Column("contacts", "INTEGER", "-", "pair contacts in the region"),
    Column("mean_radius", "REAL", "m", "mean disc radius, current"),
];

impl Record {
    /// The row of a state, or of a failure when `averages` is None. `initial` is the packed state.
    pub(crate) fn new(
        job: &Job,
        material: &Material,
        (ramp, stop, strain): (&str, usize, f64),
        state: Result<(&Settled, &Averages), String>,
        initial: Option<&Averages>,
    ) -> Self {
        let (settled, averages) = match &state {
            Ok((settled, averages)) => (Some(*settled), Some(*averages)),
            Err(_) => (None, None),
        };
        let outcome = match &state {
            Ok((settled, _)) => settled.outcome.as_str().to_string(),
            Err(reason) => format!("failed: {reason}"),
        };
        let value = |field: fn(&Averages) -> f64| averages.map(field);
        Self {
            packing: job.packing,
            seed: job.spec.seed,
            compression: job.spec.compression,
            target_porosity: job.spec.porosity,
            ramp: ramp.to_string(),
            stop: stop as i64,
            strain,
            outcome,
            steps: settled.map_or(0, |s| s.steps),
            unbalanced: settled.map(|s| s.unbalanced),
            young_modulus: material.young_modulus,
            initial_porosity: initial.map(|a| a.porosity),
            initial_fabric_index: initial.map(|a| a.fabric_index),
            porosity: value(|a| a.porosity),
            porosity_sum_of_areas: value(|a| a.porosity_sum_of_areas),
            overlap_fraction: value(|a| a.overlap_fraction),
            fabric_index: value(|a| a.fabric_index),
            fabric_conductivity: value(|a| a.fabric_conductivity),
            conductivity_xx: value(|a| a.conductivity_xx),
            conductivity_yy: value(|a| a.conductivity_yy),
            conductivity_xy: value(|a| a.conductivity_xy),
            stress_xx: value(|a| a.stress_xx),
            stress_yy: value(|a| a.stress_yy),
            stress_xy: value(|a| a.stress_xy),
            stress_yx: value(|a| a.stress_yx),
            pressure: value(|a| a.pressure),
            stress_xx_over_young_modulus: value(|a| a.stress_xx).map(|s| s / material.young_modulus),
            stress_yy_over_young_modulus: value(|a| a.stress_yy).map(|s| s / material.young_modulus),
            coordination: value(|a| a.coordination),
            rattlers: averages.map(|a| a.rattlers),
            contacts: averages.map(|a| a.contacts),
            mean_radius: value(|a| a.mean_radius),
        }
    }
}
