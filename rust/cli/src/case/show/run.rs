//! The run that is shown: its meshes, times, fields and summary.

use super::units::duration;
use crate::error::CliError;
use msdd_case::mesh::Mesh;
use msdd_case::results::{self, Field};
use msdd_case::section::{Section, View};
use msdd_case::tables;
use msdd_files::read_text;
use serde_json::Value;
use std::path::{Path, PathBuf};

/// Number of times at which maps are drawn, unless others are named.
const SHOWN: usize = 3;

/// A region with its mesh; the bed has granular properties.
pub struct Part {
    pub region: String,
    pub mesh: Mesh,
}

/// How a run ended.
#[derive(Clone, Debug, PartialEq)]
pub enum State {
    Finished,
    /// Neither its end nor an error is in the log.
    Running,
    Failed(String),
}

pub struct Run {
    pub folder: PathBuf,
    pub name: String,
    /// The bed first.
    pub parts: Vec<Part>,
    pub views: Vec<View>,
    /// All cells in the first view, and those in the second, if there is one.
    pub sections: Vec<Section>,
    /// All written times \[s\] and their folders.
    pub times: Vec<(f64, String)>,
    /// Those at which maps are drawn.
    pub shown: Vec<usize>,
    pub state: State,
    /// `summary.json`, if the solver has written it.
    pub summary: Option<Value>,
    /// Time on the clock \[s\].
    pub wall_seconds: Option<f64>,
}

fn wrong(text: String) -> CliError {
    CliError::Message(text)
}

impl Run {
    /// Reads a case folder. `wanted`: times at which maps are drawn \[s\]; of each the next one that is written is taken.
    pub fn read(folder: &Path, wanted: &[f64]) -> Result<Self, CliError> {
        let at = folder.display();
        if !folder.join("system/controlDict").is_file() {
            return Err(wrong(format!("{at}: is no case folder, allowed: a folder with system/controlDict")));
        }
        let mut regions =
            if folder.join("constant").is_dir() { results::regions(folder)? } else { Vec::new() };
        if regions.is_empty() {
            return Err(wrong(format!(
                "{at}/constant/polyMesh/points: is missing; run the case first (Allrun, or blockMesh)"
            )));
        }
        // The bed first
        let is_bed =
            |region: &String| folder.join("constant").join(region).join("granularProperties").is_file();
        regions.sort_by_key(|region| !is_bed(region));
        let times = results::times(folder, &regions[0])?;
        if times.is_empty() || (times.len() == 1 && times[0].0 == 0.0 && !read_log(folder).1) {
            let reconstruct = folder.join("processor0").is_dir();
            let remedy = if reconstruct {
                "the fields lie in processor folders: run reconstructPar"
            } else {
                "run the case first"
            };
            return Err(wrong(format!("{at}: has no time folder with results, a field T; {remedy}")));
        }
        let shown = chosen(&times, wanted)?;
        let parts = regions
            .into_iter()
            .map(|region| Ok(Part { mesh: Mesh::read(folder, &region)?, region }))
            .collect::<Result<Vec<_>, CliError>>()?;
        let views = View::of(&parts[0].mesh, gravity(folder));
        let meshes: Vec<&Mesh> = parts.iter().map(|part| &part.mesh).collect();
        let sections = views.iter().map(|view| Section::new(&meshes, view)).collect();
        let file = folder.join("postProcessing").join(&parts[0].region).join("msddFoam/summary.json");
        let summary = if file.is_file() {
            let text = read_text(&file)?;
            Some(
                serde_json::from_str::<Value>(&text)
                    .map_err(|error| wrong(format!("{}: {error}", file.display())))?,
            )
        } else {
            None
        };
        let (log, _) = read_log(folder);
        let whole = std::path::absolute(folder).unwrap_or_else(|_| folder.to_path_buf());
        Ok(Self {
            name: whole.file_name().unwrap_or_default().to_string_lossy().into_owned(),
            folder: folder.to_path_buf(),
            state: state(&log, summary.is_some()),
            wall_seconds: summary.as_ref().and_then(|s| s["wall_seconds"].as_f64()).or_else(|| clock(&log)),
            parts,
            views,
            sections,
            times,
            shown,
            summary,
        })
    }

    /// A field of a region at a time, by its number; none if it was not written.
    pub fn field(&self, part: usize, time: usize, name: &str) -> Result<Option<Field>, CliError> {
        let Part { region, mesh } = &self.parts[part];
        let file = self.folder.join(&self.times[time].1).join(region).join(name);
        Ok(Field::read(&file, mesh.volumes.len())?)
    }

    /// A time, by its number, in the unit that fits the last one.
    pub fn time(&self, number: usize) -> String {
        duration(self.times[number].0, self.times[self.last()].0)
    }

    /// Number of the last time.
    pub fn last(&self) -> usize {
        self.times.len() - 1
    }

    /// The tables whose file has this name: of each the name of its function object.
    pub fn tables(&self, file: &str) -> Result<Vec<(String, tables::Table)>, CliError> {
        let mut found = Vec::new();
        for (name, own) in tables::all(&self.folder) {
            if own == file {
                found.push((name.clone(), tables::read(&self.folder, &name, Some(file))?));
            }
        }
        Ok(found)
    }
}

/// The log of the run, and whether there is one.
fn read_log(folder: &Path) -> (String, bool) {
    let logs = ["log.msddFoam", "log.chtMultiRegionFoam"].map(|name| folder.join(name));
    let bytes = logs.iter().find_map(|file| std::fs::read(file).ok());
    (bytes.as_deref().map(String::from_utf8_lossy).unwrap_or_default().into_owned(), bytes.is_some())
}

fn state(log: &str, summary: bool) -> State {
    if let Some((_, error)) = log.split_once("FOAM FATAL") {
        let words: Vec<&str> = error
            .split_whitespace()
            .skip_while(|word| word.ends_with(':') || *word == "IO" || word.starts_with("(openfoam"))
            .collect();
        let end = words.iter().position(|word| *word == "From" || *word == "file:").unwrap_or(words.len());
        return State::Failed(words[..end.min(40)].join(" "));
    }
    let ended = log.lines().rev().take(8).any(|line| line.trim() == "End");
    if summary || ended { State::Finished } else { State::Running }
}

/// The last time on the clock that the log has \[s\].
fn clock(log: &str) -> Option<f64> {
    log.rsplit_once("ClockTime = ")?.1.split_whitespace().next()?.parse().ok()
}

/// The acceleration in `constant/g`, in text.
fn gravity(folder: &Path) -> Option<[f64; 3]> {
    let text = std::fs::read_to_string(folder.join("constant/g")).ok()?;
    let value = text.rsplit_once("value")?.1;
    let numbers: Vec<f64> = value
        .split(|c: char| c.is_whitespace() || "();".contains(c))
        .filter_map(|w| w.parse().ok())
        .collect();
    numbers.get(..3)?.try_into().ok()
}

/// Numbers of the times to show: those that were named, else about three, evenly spread, with the last one and, unless it is the
/// only one, without the start, which has not all fields.
fn chosen(times: &[(f64, String)], wanted: &[f64]) -> Result<Vec<usize>, CliError> {
    if !wanted.is_empty() {
        let (low, high) = (times[0].0, times[times.len() - 1].0);
        let mut found = Vec::new();
        for &time in wanted {
            if !(low..=high).contains(&time) {
                return Err(wrong(format!(
                    "--times = {time}, allowed: {low} to {high}, the written times [s]"
                )));
            }
            let distance = |k: &usize| (times[*k].0 - time).abs();
            found.extend((0..times.len()).min_by(|a, b| distance(a).total_cmp(&distance(b))));
        }
        found.sort_unstable();
        found.dedup();
        return Ok(found);
    }
    let first = usize::from(times.len() > 1 && times[0].0 == 0.0);
    let count = times.len() - first;
    let mut found: Vec<usize> = (0..SHOWN.min(count))
        .map(|k| first + (k * (count - 1)).div_ceil(SHOWN.min(count).max(2) - 1))
        .collect();
    found.dedup();
    Ok(found)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn times(count: usize) -> Vec<(f64, String)> {
        (0..count).map(|k| (k as f64, k.to_string())).collect()
    }

    #[test]
    fn three_times_are_shown_without_the_start_or_those_that_are_named() {
        let found = |count| chosen(&times(count), &[]).unwrap();
        assert_eq!(
            [found(1), found(2), found(3), found(4), found(5), found(10)],
            [vec![0], vec![1], vec![1, 2], vec![1, 2, 3], vec![1, 3, 4], vec![1, 5, 9]]
        );
        assert_eq!(chosen(&times(10), &[7.2, 0.0, 7.0]).unwrap(), [0, 7]);
        let error = chosen(&times(10), &[12.0]).unwrap_err().to_string();
        assert_eq!(error, "--times = 12, allowed: 0 to 9, the written times [s]");
    }

    #[test]
    fn the_log_says_how_a_run_ended() {
        assert_eq!(state("Time = 1\nEnd\n\n", false), State::Finished);
        assert_eq!(state("Time = 1\nExecutionTime = 2 s  ClockTime = 3 s\n", false), State::Running);
        assert_eq!(clock("ClockTime = 3 s\nClockTime = 4 s\n"), Some(4.0));
        let error = "--> FOAM FATAL IO ERROR: (openfoam-1912)\nno T here\n\n    From function x\n";
        assert_eq!(state(error, false), State::Failed("no T here".to_string()));
    }
}
