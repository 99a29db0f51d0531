//! Results of a run: one compact JSON file, and its time series as CSV.

use crate::ReferenceError;
use crate::model::Statistics;
use msdd_case::Case;
use msdd_case::packing::RADIUS_RANGE;
use msdd_dem::{Material, Thermal};
use msdd_files::read_text;
use serde::{Deserialize, Serialize};
use std::fmt::Write;
use std::path::Path;

/// Name of the file's schema.
pub const SCHEMA: &str = "msdd-reference-1";
/// Significant digits of a number in a table.
const DIGITS: usize = 7;

/// Rows of numbers with named columns.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Table {
    pub columns: Vec<String>,
    pub rows: Vec<Vec<f64>>,
}

impl Table {
    pub fn new(columns: Vec<String>) -> Self {
        Self { columns, rows: Vec::new() }
    }

    /// Adds a row, rounded to 7 significant digits.
    ///
    /// # Panics
    /// When the row has not exactly one number for each column.
    pub fn push(&mut self, row: Vec<f64>) {
        assert_eq!(row.len(), self.columns.len(), "one number a column");
        self.rows.push(row.into_iter().map(rounded).collect());
    }

    /// A column by name.
    pub fn column(&self, name: &str) -> Option<Vec<f64>> {
        let k = self.columns.iter().position(|column| column == name)?;
        Some(self.rows.iter().map(|row| row[k]).collect())
    }

    /// Multiplies the columns that a function chooses by their names.
    fn multiply(&mut self, chosen: impl Fn(&str) -> bool, factor: f64) {
        for (k, _) in self.columns.iter().enumerate().filter(|(_, name)| chosen(name)) {
            self.rows.iter_mut().for_each(|row| row[k] = rounded(row[k] * factor));
        }
    }

    /// The table as CSV with a head line.
    pub fn to_csv(&self) -> String {
        let mut text = self.columns.join(",");
        text.push('\n');
        for row in &self.rows {
            let line: Vec<String> = row.iter().map(f64::to_string).collect();
            let _ = writeln!(text, "{}", line.join(","));
        }
        text
    }
}

fn rounded(value: f64) -> f64 {
    // −0 becomes 0, so that equal numbers have equal texts.
    format!("{value:.*e}", DIGITS - 1).parse::<f64>().map_or(value, |value| value + 0.0)
}

/// What the discs of a run are.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Properties {
    pub material: Material,
    pub thermal: Thermal,
    /// \[m\]
    pub mean_radius: f64,
    /// Smallest and largest radius over the mean radius \[-\].
    pub radii: [f64; 2],
}

impl Properties {
    pub fn of(case: &Case) -> Self {
        let Case { material, thermal, mean_radius, radii, .. } = case.clone();
        Self { material, thermal, mean_radius, radii }
    }

    /// Names and values in SI units. The first are those that the surrogate of a case says.
    pub fn values(&self) -> Vec<(&'static str, f64)> {
        let (material, thermal) = (&self.material, &self.thermal);
        vec![
            ("friction_angle", material.friction_angle),
            ("stiffness_ratio", material.stiffness_ratio),
            ("smallest radius over the mean", self.radii[0]),
            ("largest radius over the mean", self.radii[1]),
            ("density", material.density),
            ("young_modulus", material.young_modulus),
            ("mean radius", self.mean_radius),
            ("conductivity", thermal.conductivity),
            ("heat_capacity", thermal.heat_capacity),
            ("expansion", thermal.expansion),
        ]
    }
}

/// Parameters and results of a run. SI units, compression positive.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Results {
    /// `msdd-reference-1`.
    pub schema: String,
    /// Name of the case.
    pub case: String,
    /// Seed of the packing.
    pub seed: u64,
    /// Number of grains.
    pub discs: usize,
    /// Material, thermal properties and radii of the grains; absent in older files, whose grains are those of the paper.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub properties: Option<Properties>,
    /// Width and height of the box \[m\].
    #[serde(rename = "box")]
    pub size: [f64; 2],
    /// Points where T was recorded \[m\].
    pub probes: Vec<[f64; 2]>,
    /// Side of the windows around the probes over which T is averaged: eight mean radii; 40 mm in files without this entry
    /// \[m\].
    #[serde(default = "older_window")]
    pub probe_window: f64,
    /// Averages of the box at the start.
    pub model: Statistics,
    /// Mechanical steps; none in a case without expansion, where the grains stay at rest.
    pub steps: u64,
    /// Thermal sub-steps in them.
    pub thermal_substeps: u64,
    /// Largest mechanical step that was given; `null`: from the stability bound \[s\].
    pub time_step: Option<f64>,
    /// Factor of `--speed-up`, absent if 1; times and heat capacity here are those of the case.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub speed_up: Option<f64>,
    /// Table over time.
    pub series: Table,
    /// Table of averages in 10 × 3 windows at the start.
    pub sub_regions_start: Table,
    /// The same at the end.
    pub sub_regions_end: Table,
    /// Table of profiles along x, at several times.
    pub profiles: Table,
    /// Table of K/k of the box over time, network.
    pub network: Table,
    /// Table of the mean displacement of the grains that started in each sub-region; absent in older files \[m\].
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub displacement: Option<Table>,
    /// The grains around the second probe: `window`, and tables at the `start` and at the `end`; absent without that probe
    /// [m, K].
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub grains: Option<Grains>,
}

fn older_window() -> f64 {
    0.04
}

/// Number of the first of [`Properties::values`] that an older file has: all discs had the paper's then.
const KNOWN_OF_OLDER: usize = 4;

impl Results {
    /// Names and values of the properties of the discs, as far as the file holds them.
    pub fn properties(&self) -> Vec<(&'static str, f64)> {
        let older = || Properties {
            material: Material::default(),
            thermal: Thermal::default(),
            mean_radius: 0.0,
            radii: RADIUS_RANGE,
        };
        match &self.properties {
            Some(properties) => properties.values(),
            None => older().values().into_iter().take(KNOWN_OF_OLDER).collect(),
        }
    }

    /// Turns the results of [`Case::sped_up`] into those of the case itself: heat capacity, times, and the heat that passed the
    /// walls are multiplied by the factor. Steps and the time step that was given stay those of the run.
    #[must_use]
    pub fn of_sped_up(mut self, factor: f64) -> Self {
        if let Some(properties) = &mut self.properties {
            properties.thermal.heat_capacity *= factor;
        }
        for table in [&mut self.series, &mut self.profiles, &mut self.network] {
            table.multiply(|name| name == "time" || name.starts_with("heat_"), factor);
        }
        self.speed_up = Some(factor);
        self
    }

    /// Reads a result file.
    ///
    /// # Errors
    /// [`ReferenceError::File`]; [`ReferenceError::Read`] when it is not a result file.
    pub fn read(file: &Path) -> Result<Self, ReferenceError> {
        serde_json::from_str(&read_text(file)?)
            .map_err(|error| ReferenceError::Read { file: file.to_path_buf(), problem: error.to_string() })
    }
}

/// Discs in a small window: number, x, y, r \[m\], T \[K\].
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Grains {
    /// Lower left and upper right corner of the window \[m\]; discs that reach into it are listed.
    pub window: [[f64; 2]; 2],
    pub start: Table,
    pub end: Table,
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tables_round_and_read_back() {
        let mut table = Table::new(vec!["a".to_string(), "b".to_string()]);
        table.push(vec![1.0 / 3.0, -0.0]);
        assert_eq!(table.to_csv(), "a,b\n0.3333333,0\n");
        assert_eq!(table.column("b"), Some(vec![0.0]));
        let text = serde_json::to_string(&table).unwrap();
        assert_eq!(serde_json::from_str::<Table>(&text).unwrap(), table);
        table.multiply(|name| name == "a", 3.0);
        assert_eq!(table.rows, [[0.9999999, 0.0]]);
    }
}
