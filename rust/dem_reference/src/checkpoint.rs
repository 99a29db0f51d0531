//! Checkpoints, from which a killed run continues bit for bit: the state, the temperatures, and what was recorded so far.

use crate::ReferenceError;
use crate::results::Table;
use msdd_dem::heat::HeatState;
use msdd_files::FileError;
use msdd_rve::message::shortened;
use msdd_rve::state;
use serde::{Deserialize, Serialize};
use serde_json::value::RawValue;
use sha2::{Digest, Sha256};
use std::io::ErrorKind;
use std::path::Path;

/// Name of the file's schema.
const SCHEMA: &str = "msdd-reference-checkpoint-3";

/// What was recorded so far.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Records {
    pub series: Table,
    pub sub_regions_start: Table,
    pub profiles: Table,
    pub network: Table,
}

/// All that is needed to continue a run.
#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Checkpoint {
    schema: String,
    /// Parameters of the run in one line; a checkpoint of a run with other parameters is refused.
    asked: String,
    pub records: Records,
    pub heat: HeatState,
    /// The state file.
    pub state: Box<RawValue>,
    /// SHA-256 of all fields above, hexadecimal.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    checksum: Option<String>,
}

impl Checkpoint {
    /// SHA-256 of all fields but the checksum itself.
    fn digest(&self) -> Result<String, serde_json::Error> {
        let text = serde_json::to_string(self)?;
        Ok(Sha256::digest(text.as_bytes()).iter().map(|byte| format!("{byte:02x}")).collect())
    }

    /// The text of a checkpoint of a simulation with heat conduction.
    ///
    /// # Errors
    /// [`ReferenceError::State`] or [`ReferenceError::Json`] when a number is not finite.
    pub fn text(
        asked: &str,
        simulation: &msdd_dem::Simulation,
        records: &Records,
    ) -> Result<Option<String>, ReferenceError> {
        let Some(heat) = simulation.heat() else { return Ok(None) };
        let mut checkpoint = Self {
            schema: SCHEMA.to_string(),
            asked: asked.to_string(),
            records: records.clone(),
            heat: heat.state(),
            state: RawValue::from_string(state::to_json(simulation)?)?,
            checksum: None,
        };
        checkpoint.checksum = Some(checkpoint.digest()?);
        Ok(Some(serde_json::to_string(&checkpoint)?))
    }

    /// Reads a checkpoint of the run with the parameters `asked`; `None` when there is no file.
    ///
    /// # Errors
    /// [`ReferenceError::Checkpoint`] when it is damaged, unreadable or of another run.
    pub fn read(file: &Path, asked: &str) -> Result<Option<Self>, ReferenceError> {
        let failed = |problem: String| ReferenceError::Checkpoint { file: file.to_path_buf(), problem };
        match msdd_files::read_text(file) {
            Ok(text) => Self::parse(&text, asked).map(Some).map_err(failed),
            Err(FileError::Read { source, .. }) if source.kind() == ErrorKind::NotFound => Ok(None),
            Err(error) => Err(failed(error.to_string())),
        }
    }

    /// Reads the text of a checkpoint of the run with the parameters `asked`.
    ///
    /// # Errors
    /// What is wrong with it.
    pub fn parse(text: &str, asked: &str) -> Result<Self, String> {
        let mut checkpoint: Self = serde_json::from_str(text)
            .map_err(|error| format!("is damaged: {}", shortened(&error.to_string())))?;
        if checkpoint.schema != SCHEMA {
            return Err(format!("schema '{}', allowed: '{SCHEMA}'", shortened(&checkpoint.schema)));
        }
        let found = checkpoint.checksum.take();
        if found != Some(checkpoint.digest().map_err(|error| error.to_string())?) {
            return Err("is damaged: its checksum does not agree".to_string());
        }
        if checkpoint.asked != asked {
            return Err(format!("is of the run {}, not of {asked}", checkpoint.asked));
        }
        Ok(checkpoint)
    }
}
