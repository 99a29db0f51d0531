//! Results of the six cases by DEM, mean and scatter of three packings, and the solver's errors against them.

use super::read::{CaseResult, PROBES};
use crate::error::CliError;
use msdd_dem_reference::compare::{difference, with_start};
use msdd_dem_reference::packings::{Reference, SEEDS, pressure_range, temperature_range};
use msdd_dem_reference::series::{largest, statistics};
use msdd_files::read_text;
use serde::Serialize;
use std::collections::BTreeMap;
use std::path::Path;

/// Mean and standard deviation over packings at a time: (t [s], mean, deviation).
pub type Band = Vec<(f64, f64, f64)>;

/// One case by DEM.
#[derive(Clone, Debug, Serialize)]
pub struct Discs {
    /// Range of T that errors are given in per cent of [K].
    pub temperature_range: f64,
    /// Mean T over windows of 40 mm around the probes [K], by name of the probe.
    pub temperature: BTreeMap<&'static str, Band>,
    /// Mean pressure of the box [Pa], compression positive.
    pub pressure: Band,
    /// Standard deviation of T between packings, the largest over time and probes [% of the range].
    pub scatter: f64,
    /// Processor time of one packing [s], if it was measured.
    pub core_seconds: Option<f64>,
}

/// Differences of a run of the solver from the mean of DEM: the largest over time, with its sign.
#[derive(Clone, Debug, Serialize)]
pub struct Errors {
    /// Of T at the probes [% of the range].
    pub temperature: [f64; 3],
    /// Of the mean pressure at the end [% of the paper's range].
    pub pressure_at_end: f64,
}

impl Errors {
    /// Largest absolute value of the three probes [% of the range].
    pub fn largest(&self) -> f64 {
        largest(&self.temperature).abs()
    }
}

/// A case: its name, the solver's runs, and DEM.
pub struct Named {
    pub folder: &'static str,
    pub name: &'static str,
    /// The run with the paper's scheme (grains stay in their cells) and, if there is one, that with grains that move.
    pub stay: CaseResult,
    pub moving: Option<CaseResult>,
    pub discs: Discs,
}

/// The same data for the JSON file.
#[derive(Serialize)]
pub struct Comparison<'a> {
    discs: &'a Discs,
    grains_stay: Option<Errors>,
    grains_move: Option<Errors>,
}

impl Named {
    pub fn errors(&self, run: &CaseResult) -> Option<Errors> {
        self.discs.errors(self.folder, run)
    }

    pub fn comparison(&self) -> Comparison<'_> {
        Comparison {
            discs: &self.discs,
            grains_stay: self.errors(&self.stay),
            grains_move: self.moving.as_ref().and_then(|run| self.errors(run)),
        }
    }
}

/// Processor times of the reference runs [s], by case folder: `cost.json` next to the results, written by their script.
fn costs(reference: &Path) -> Result<BTreeMap<String, f64>, CliError> {
    let path = reference.join("cost.json");
    if !path.exists() {
        return Ok(BTreeMap::new());
    }
    #[derive(serde::Deserialize)]
    struct Cost {
        core_seconds: BTreeMap<String, f64>,
    }
    let cost: Cost = serde_json::from_str(&read_text(&path)?)
        .map_err(|error| CliError::Message(format!("{}: {error}", path.display())))?;
    Ok(cost.core_seconds)
}

impl Discs {
    /// Reads the three packings of `case` in the checkout of which `reference` is the folder `cases/reference`.
    pub fn read(reference: &Path, case: &str) -> Result<Self, CliError> {
        let checkout = reference.join("../..");
        let discs =
            Reference::read(&checkout, case, &SEEDS).map_err(|error| CliError::Message(error.to_string()))?;
        let range = temperature_range(case);
        let times = discs.times();
        let band = |by_packing: &[Vec<f64>]| -> Band {
            let moments = statistics(by_packing);
            times.iter().zip(moments).map(|(&t, (mean, deviation))| (t, mean, deviation)).collect()
        };
        let temperature: BTreeMap<_, _> =
            PROBES.into_iter().zip(discs.temperature().iter().map(|probe| band(probe))).collect();
        let widest = temperature.values().flatten().map(|&(_, _, deviation)| deviation).fold(0.0, f64::max);
        Ok(Self {
            temperature_range: range,
            temperature,
            pressure: band(&discs.series("pressure")),
            scatter: 100.0 * widest / range,
            core_seconds: costs(reference)?.get(case).copied(),
        })
    }

    /// Differences of `run` from the mean of the packings. `None` when the run ended earlier than DEM.
    pub fn errors(&self, case: &str, run: &CaseResult) -> Option<Errors> {
        let end = self.pressure.last()?;
        let of_probe = |probe: &str| -> Option<f64> {
            let series: Vec<[f64; 2]> = run.probes.get(probe)?.iter().map(|&(t, value)| [t, value]).collect();
            if series.last()?[0] < end.0 - 1e-6 {
                return None;
            }
            let (times, means): (Vec<f64>, Vec<f64>) =
                self.temperature[probe].iter().map(|&(t, mean, _)| (t, mean)).unzip();
            let series = with_start(&series, means[0]);
            Some(largest(&difference(&times, &series, &means, 100.0 / self.temperature_range)))
        };
        Some(Errors {
            temperature: [of_probe(PROBES[0])?, of_probe(PROBES[1])?, of_probe(PROBES[2])?],
            pressure_at_end: 100.0 * (run.end.pressure - end.1) / pressure_range(case),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::summary::fixture;

    fn reference() -> std::path::PathBuf {
        Path::new(env!("CARGO_MANIFEST_DIR")).join("../../cases/reference")
    }

    /// A run with the mean temperatures of the discs, but P3 two kelvin warmer, and a pressure 38 Pa too high.
    #[test]
    fn an_offset_is_found_and_the_mean_itself_has_no_error() {
        let discs = Discs::read(&reference(), "HC").unwrap();
        let folder = fixture::Cases::new("offset");
        let mut run = crate::summary::read::case(&folder.path().join("HC")).unwrap();
        for (probe, offset) in PROBES.into_iter().zip([0.0, 0.0, 2.0]) {
            let series = discs.temperature[probe].iter().skip(1).map(|&(t, mean, _)| (t, mean + offset));
            run.probes.insert(probe, series.collect());
        }
        run.end.pressure = discs.pressure.last().unwrap().1 + 38.0;
        let errors = discs.errors("HC", &run).unwrap();
        assert!(errors.temperature[0].abs() < 1e-9 && (errors.largest() - 2.0).abs() < 1e-9, "{errors:?}");
        assert!((errors.pressure_at_end - 1.0).abs() < 1e-9);
        run.probes.get_mut("P1").unwrap().truncate(100);
        assert!(discs.errors("HC", &run).is_none());
    }

    #[test]
    fn the_packings_of_c_scatter_more_than_those_of_h() {
        let scatter = |case| Discs::read(&reference(), case).unwrap().scatter;
        assert!(scatter("C") > 2.0 && scatter("H") < 1.0);
    }
}
