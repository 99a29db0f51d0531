//! What was tried, chosen and estimated, for people and for programs.

use crate::ChoiceError;
use crate::found::{Differences, Found, Share};
use crate::interval::{self, MeanBand};
use crate::settings::{Level, Settings};
use crate::trial::Beyond;
use crate::user_case::UserCase;
use msdd_case::numbers::plain;
use msdd_files::{read_text, write};
use serde::{Deserialize, Serialize};
use std::fmt::Write as _;
use std::path::Path;

/// Name of the file in the folder of the chosen run.
pub const FILE: &str = "choice.json";
/// Name of the file with what the search has seen at each point and time.
const SEEN: &str = "differences.json";

/// A choice and what it rests on.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Record {
    /// Wanted accuracy of T [% of its range].
    pub accuracy: f64,
    /// Wanted accuracy of p [% of its range], if it was asked for.
    pub pressure_accuracy: Option<f64>,
    /// What was run instead of an accuracy that cannot be had, and why.
    #[serde(default)]
    pub warning: Option<String>,
    /// Checksum of the case and its mesh.
    pub checksum: String,
    pub found: Found,
    /// Wall time of the search \[s\].
    pub search_seconds: f64,
    /// Wall time of the chosen run \[s\], and the estimate of its error in space that a run with half the cells gave [% of the
    /// range of T], once they are known.
    pub run_seconds: Option<f64>,
    pub checked: Option<Share>,
    /// 90 % bands in the mean, once the chosen run is complete.
    pub bands: Vec<MeanBand>,
    /// From when on there are none, and why.
    #[serde(default)]
    pub beyond: Option<Beyond>,
    /// Warnings of the chosen run, such as of radiation, which no estimate includes.
    #[serde(default)]
    pub run_warnings: Vec<String>,
}

impl Record {
    /// The record of an earlier search and what it has seen, if it belongs to this case and these accuracies.
    pub fn earlier(
        folder: &Path,
        checksum: &str,
        accuracy: f64,
        pressure_accuracy: Option<f64>,
    ) -> Option<(Self, Differences)> {
        let read: Self = serde_json::from_str(&read_text(&folder.join(FILE)).ok()?).ok()?;
        let seen = serde_json::from_str(&read_text(&folder.join(SEEN)).ok()?).ok()?;
        let same = read.checksum == checksum
            && read.accuracy == accuracy
            && read.pressure_accuracy == pressure_accuracy;
        same.then_some((read, seen))
    }

    /// Writes the record into the folder of the chosen run, for programs and as its README.md for people.
    ///
    /// # Errors
    /// [`ChoiceError::File`].
    pub fn write(&self, scene: &UserCase, folder: &Path) -> Result<(), ChoiceError> {
        write_json(&folder.join(FILE), self, true)?;
        Ok(write(&folder.join("README.md"), self.readme(scene, folder).as_bytes())?)
    }

    fn readme(&self, scene: &UserCase, folder: &Path) -> String {
        let name = |path: &Path| path.file_name().unwrap_or_default().to_string_lossy().into_owned();
        let chosen = name(folder);
        format!(
            "# Case {chosen}\n\nMade by `msdd case solve` from the case `{}`, with a mesh and steps for an error of T of at most {} % \
             of its range. The next `msdd case solve` for another accuracy replaces this folder: rename it to keep it.\n\n\
             - **Results**: fields in the time folders (open `{chosen}.foam` in ParaView), tables in `postProcessing`, 90 % bands \
             in `{}`.\n\
             - **Run again**: `./Allrun`, if the case has it, else `msddFoam`.\n\n```text\n{}```\n",
            name(&scene.folder),
            plain(self.accuracy),
            interval::FILE,
            self.text(scene)
        )
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
    pub fn text(&self, scene: &UserCase) -> String {
        let mut text = format!("Chosen: {}.\n", sentence(&self.found.settings, scene, self.found.range));
        if let Some(warning) = &self.warning {
            let _ = writeln!(text, "Warning: {warning}.");
        }
        if let Some(profiles) = profiles(&self.found.settings, scene) {
            let _ = writeln!(text, "{profiles}");
        }
        let _ = writeln!(text, "\n       %  estimated error of T, share of its range, by source");
        for share in self.found.shares.iter().chain(&self.found.open) {
            let _ = writeln!(text, "{:8.3}  {}: {}", share.percent, share.source, share.how);
        }
        let asked = plain(self.accuracy);
        let _ = writeln!(text, "{:8.3}  all together, {asked} % requested", self.found.total());
        if let Some(wanted) = self.pressure_accuracy {
            let _ = writeln!(
                text,
                "          {wanted} % of the range of p requested: an error of p counts {:.3} times",
                self.accuracy / wanted
            );
        }
        if let Some(share) = &self.checked {
            let _ = writeln!(text, "{:8.3}  {}: {}", share.percent, share.source, share.how);
        }
        for note in &self.found.notes {
            let _ = writeln!(text, "Note: {note}.");
        }
        if self.run_seconds.is_some() {
            let bands = interval::text(&self.bands, self.beyond.as_ref());
            let _ = write!(text, "\n{bands}At each point and time: {}.\n{}", interval::FILE, self.warnings());
        }
        text
    }

    /// The warnings of the chosen run, a line each.
    pub fn warnings(&self) -> String {
        self.run_warnings.iter().map(|each| format!("Warning, not in the estimates: {each}.\n")).collect()
    }
}

/// Writes what the search has seen into the folder of the chosen run.
///
/// # Errors
/// [`ChoiceError::File`].
pub fn write_seen(seen: &Differences, folder: &Path) -> Result<(), ChoiceError> {
    write_json(&folder.join(SEEN), seen, false)
}

fn write_json(file: &Path, value: &impl Serialize, pretty: bool) -> Result<(), ChoiceError> {
    let text = if pretty { serde_json::to_string_pretty(value) } else { serde_json::to_string(value) };
    let text =
        text.map_err(|error| ChoiceError::Read { file: file.to_path_buf(), problem: error.to_string() })?;
    Ok(write(file, format!("{text}\n").as_bytes())?)
}

/// What a coarser mesh than that of the case means for profiles.
fn profiles(settings: &Settings, scene: &UserCase) -> Option<String> {
    let coarser = scene.blocks.as_ref().ok()?.coarser(settings);
    let along: Vec<String> =
        coarser.iter().map(|(name, cells, own)| format!("{cells} along {name} instead of {own}")).collect();
    (!along.is_empty()).then(|| {
        format!(
            "Profiles of T, p and K have as many points as the mesh has cells: {}. For finer ones run the case itself.",
            along.join(", ")
        )
    })
}

/// Settings as a sentence. `range`: of T \[K\].
pub fn sentence(settings: &Settings, scene: &UserCase, range: f64) -> String {
    let mesh = match &scene.blocks {
        Ok(blocks) => {
            let total = blocks.total(settings);
            let whole = settings.levels.iter().all(|&level| level == Level::Halved(0));
            match (settings.halved.iter().filter(|&&halved| halved).count(), whole) {
                (0, true) => format!("the case's own {total} cells"),
                (0, false) => format!("{total} cells instead of {}", scene.cells),
                (1, _) => format!("{total} cells of half the box instead of {}", scene.cells),
                _ => format!("{total} cells of a quarter of the box instead of {}", scene.cells),
            }
        }
        Err(why) => format!("the case's own {} cells ({why})", scene.cells),
    };
    let steps = match range > 0.0 {
        true => format!("steps with an error of {:.3} K", settings.tolerance * range),
        false => format!("steps with an error of {} % of the range of T", 100.0 * settings.tolerance),
    };
    let grains = if settings.moves { "grains that move" } else { "grains that stay" };
    let constant = settings.constant.map_or(String::new(), |[x, y]| {
        format!(", a constant conductivity of {x:.4} along x and {y:.4} W/(m K) along y")
    });
    format!("{mesh}, {steps}, {grains}{constant}")
}
