//! What was tried, chosen and estimated, for people and for programs.

use crate::ChoiceError;
use crate::scene::Scene;
use crate::search::{Found, Share};
use crate::settings::{Level, Settings};
use msdd_files::{read_text, write};
use serde::{Deserialize, Serialize};
use std::fmt::Write as _;
use std::path::Path;

/// Name of the file in the folder of the chosen run.
pub const FILE: &str = "choice.json";

/// A choice and what it rests on.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Record {
    /// Wanted accuracy of T [% of its range].
    pub accuracy: f64,
    /// Checksum of the case and its mesh.
    pub checksum: String,
    pub found: Found,
    /// Wall time of the search [s].
    pub search_seconds: f64,
    /// Wall time of the chosen run [s], and the estimate of its error in space that a run with half the cells gave [% of the
    /// range of T], once they are known.
    pub run_seconds: Option<f64>,
    pub checked: Option<Share>,
}

impl Record {
    /// The record of an earlier search, if it belongs to this case and this accuracy.
    pub fn earlier(folder: &Path, checksum: &str, accuracy: f64) -> Option<Self> {
        let read: Self = serde_json::from_str(&read_text(&folder.join(FILE)).ok()?).ok()?;
        (read.checksum == checksum && read.accuracy == accuracy).then_some(read)
    }

    /// Writes the record into the folder of the chosen run.
    ///
    /// # Errors
    /// [`ChoiceError::File`].
    pub fn write(&self, folder: &Path) -> Result<(), ChoiceError> {
        let file = folder.join(FILE);
        let failed = |problem: String| ChoiceError::Read { file: file.clone(), problem };
        let text = serde_json::to_string_pretty(self).map_err(|error| failed(error.to_string()))?;
        Ok(write(&file, format!("{text}\n").as_bytes())?)
    }

    /// Adds the record to the summary that the solver wrote, under the key `choice`.
    ///
    /// # Errors
    /// [`ChoiceError::File`], [`ChoiceError::Read`].
    pub fn add_to_summary(&self, folder: &Path) -> Result<(), ChoiceError> {
        let file = folder.join("postProcessing/msddFoam/summary.json");
        let failed =
            |error: serde_json::Error| ChoiceError::Read { file: file.clone(), problem: error.to_string() };
        let mut summary: serde_json::Value = serde_json::from_str(&read_text(&file)?).map_err(failed)?;
        summary["choice"] = serde_json::to_value(self).map_err(failed)?;
        let text = serde_json::to_string_pretty(&summary).map_err(failed)?;
        Ok(write(&file, format!("{text}\n").as_bytes())?)
    }

    /// The choice and the estimates in sentences and a table.
    pub fn text(&self, scene: &Scene) -> String {
        let mut text = format!("Chosen: {}.\n", sentence(&self.found.settings, scene, self.found.range));
        let _ = writeln!(text, "\n       %  estimated error of T, share of its range, by source");
        for share in &self.found.shares {
            let _ = writeln!(text, "{:8.3}  {}: {}", share.percent, share.source, share.how);
        }
        let _ = writeln!(text, "{:8.3}  all together, {} % asked for", self.found.total(), self.accuracy);
        if let Some(share) = &self.checked {
            let _ = writeln!(text, "{:8.3}  {}: {}", share.percent, share.source, share.how);
        }
        for note in &self.found.notes {
            let _ = writeln!(text, "Note: {note}.");
        }
        text += "What the model itself and the packing leave open is not part of this estimate.\n";
        text
    }
}

/// Settings as a sentence. `range`: of T [K].
pub fn sentence(settings: &Settings, scene: &Scene, range: f64) -> String {
    let mesh = match &scene.blocks {
        Ok(blocks) => {
            let total = blocks.total(&settings.levels);
            match settings.levels.iter().all(|&level| level == Level::Halved(0)) {
                true => format!("the case's own {total} cells"),
                false => format!("{total} cells instead of {}", scene.cells),
            }
        }
        Err(why) => format!("the case's own {} cells ({why})", scene.cells),
    };
    let steps = match range > 0.0 {
        true => format!("steps with an error of {:.3} K", settings.tolerance * range),
        false => format!("steps with an error of {} % of the range of T", 100.0 * settings.tolerance),
    };
    let grains = if settings.moves { "grains that move" } else { "grains that stay" };
    format!("{mesh}, {steps}, {grains}")
}
