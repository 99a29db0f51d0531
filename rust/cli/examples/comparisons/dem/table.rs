//! Errors of the solver in a scene compared with the scatter of its packings, at the output times after the start.

use super::SceneResults;
use msdd_dem_reference::ReferenceError;
use msdd_dem_reference::series::{at, mean_and_deviation};
use msdd_dem_reference::solver::{pressure_rows, probe_rows};
use std::path::Path;

/// Mean and largest value.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Size {
    pub mean: f64,
    pub worst: f64,
}

impl Size {
    fn of(values: &[f64]) -> Self {
        let mean = values.iter().sum::<f64>() / values.len().max(1) as f64;
        Self { mean, worst: values.iter().copied().fold(0.0, f64::max) }
    }
}

/// One scene.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Row {
    /// |T of the solver − T of the discs| at the probes [% of the range of T].
    pub temperature: Size,
    /// Standard deviation between packings of T of the discs at the probes [% of the range].
    pub temperature_scatter: Size,
    /// |p of the solver − p of the discs|, mean over the box [% of the largest p of the discs].
    pub pressure: Size,
    pub pressure_scatter: Size,
}

/// T of a packing's discs at output times and probes, one after the other, with the time [s]; without the start.
fn temperatures(results: &SceneResults) -> Vec<[f64; 3]> {
    let rows = results.probes.rows.iter().filter(|row| row[0] > 0.0);
    rows.map(|row| [row[0], row[1], row[4]]).collect()
}

/// Time [s] and mean pressure [Pa] over the windows, which are of equal size; without the start.
fn pressures(results: &SceneResults) -> Vec<[f64; 2]> {
    let column = |name| results.windows.column(name).unwrap_or_default();
    let mut means: Vec<(f64, f64, f64)> = Vec::new();
    for (time, pressure) in column("time").into_iter().zip(column("pressure")).filter(|row| row.0 > 0.0) {
        match means.last_mut().filter(|last| last.0 == time) {
            Some((_, sum, count)) => (*sum, *count) = (*sum + pressure, *count + 1.0),
            None => means.push((time, pressure, 1.0)),
        }
    }
    means.into_iter().map(|(time, sum, count)| [time, sum / count]).collect()
}

/// The errors of a scene: `packings` are the results of its discs and the case folder in which the solver has run from the same
/// packing; `range` is that of T \[K\].
///
/// # Errors
/// [`ReferenceError::File`], [`ReferenceError::Read`] for results of the solver that are missing.
pub fn row(packings: &[(&SceneResults, &Path)], range: f64) -> Result<Row, ReferenceError> {
    let largest = packings.iter().flat_map(|(results, _)| pressures(results)).map(|row| row[1]);
    let largest = largest.fold(0.0, f64::max);
    let (mut temperature, mut pressure) = (Vec::new(), Vec::new());
    for (results, folder) in packings {
        let series = probe_rows(folder)?;
        for [time, probe, discs] in temperatures(results) {
            let own: Vec<[f64; 2]> =
                series.iter().filter_map(|row| Some([row[0], *row.get(1 + probe as usize)?])).collect();
            temperature.push(100.0 * (at(&own, time) - discs).abs() / range);
        }
        let own = pressure_rows(folder)?;
        let errors = pressures(results).into_iter().map(|[time, discs]| at(&own, time) - discs);
        pressure.extend(errors.map(|error| 100.0 * error.abs() / largest));
    }
    let scatter = |values: Vec<Vec<f64>>, range: f64| {
        let count = values.iter().map(Vec::len).min().unwrap_or(0);
        let deviation = |k: usize| mean_and_deviation(&values.iter().map(|of| of[k]).collect::<Vec<_>>()).1;
        Size::of(&(0..count).map(|k| 100.0 * deviation(k) / range).collect::<Vec<_>>())
    };
    let by_packing = |values: fn(&SceneResults) -> Vec<f64>| packings.iter().map(|p| values(p.0)).collect();
    Ok(Row {
        temperature: Size::of(&temperature),
        temperature_scatter: scatter(
            by_packing(|results| temperatures(results).iter().map(|row| row[2]).collect()),
            range,
        ),
        pressure: Size::of(&pressure),
        pressure_scatter: scatter(
            by_packing(|results| pressures(results).iter().map(|row| row[1]).collect()),
            largest,
        ),
    })
}
