//! What a killed run continues from, bit for bit: the state, the heat, and what was recorded so far.

use crate::ReferenceError;
use crate::results::Table;
use msdd_dem::heat::HeatState;
use msdd_rve::state;
use serde::{Deserialize, Serialize};
use serde_json::value::RawValue;
use std::path::Path;

/// Name of the schema.
const SCHEMA: &str = "msdd-reference-checkpoint-2";

/// What was recorded so far.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Records {
    pub series: Table,
    pub sub_regions_start: Table,
    pub profiles: Table,
    pub network: Table,
}

/// Where a run stands.
#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Checkpoint {
    schema: String,
    /// What the run was asked for; a checkpoint of another run is refused.
    asked: String,
    pub records: Records,
    pub heat: HeatState,
    /// The state file.
    pub state: Box<RawValue>,
}

impl Checkpoint {
    /// As text, of a simulation with heat.
    ///
    /// # Errors
    /// [`ReferenceError::State`] or [`ReferenceError::Json`] when a number is not finite.
    pub fn text(
        asked: &str,
        simulation: &msdd_dem::Simulation,
        records: &Records,
    ) -> Result<Option<String>, ReferenceError> {
        let Some(heat) = simulation.heat() else { return Ok(None) };
        let checkpoint = Self {
            schema: SCHEMA.to_string(),
            asked: asked.to_string(),
            records: records.clone(),
            heat: heat.state(),
            state: RawValue::from_string(state::to_json(simulation)?)?,
        };
        Ok(Some(serde_json::to_string(&checkpoint)?))
    }

    /// Reads a checkpoint of the run that was asked for; none when there is no file.
    ///
    /// # Errors
    /// [`ReferenceError::Checkpoint`] when it is unreadable or of another run.
    pub fn read(file: &Path, asked: &str) -> Result<Option<Self>, ReferenceError> {
        let failed = |problem: String| ReferenceError::Checkpoint { file: file.to_path_buf(), problem };
        let text = match std::fs::read_to_string(file) {
            Ok(text) => text,
            Err(error) if error.kind() == std::io::ErrorKind::NotFound => return Ok(None),
            Err(error) => return Err(failed(error.to_string())),
        };
        let checkpoint: Self = serde_json::from_str(&text).map_err(|error| failed(error.to_string()))?;
        if checkpoint.schema != SCHEMA {
            return Err(failed(format!("schema '{}', allowed: '{SCHEMA}'", checkpoint.schema)));
        }
        if checkpoint.asked != asked {
            let problem =
                format!("is of the run {}, not of {asked}; remove it to start afresh", checkpoint.asked);
            return Err(failed(problem));
        }
        Ok(Some(checkpoint))
    }
}
