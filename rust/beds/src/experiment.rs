//! Measured temperatures, and how far a simulation is from them.

use msdd_files::{FileError, read_text};
use std::path::{Path, PathBuf};

/// The header that a file of measurements begins with.
pub const HEADER: &str = "distance_m,time_s,temperature_C";
/// 0 °C \[K\].
pub const ZERO_CELSIUS: f64 = 273.15;

/// One measurement.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Measured {
    /// From the plate \[m\].
    pub distance: f64,
    /// \[s\]
    pub time: f64,
    /// \[K\]
    pub temperature: f64,
}

/// T \[K\] at a distance from the plate, at the times of a run.
#[derive(Clone, Debug, PartialEq)]
pub struct Record {
    /// \[m\]
    pub distance: f64,
    /// \[s\], \[K\]
    pub rows: Vec<(f64, f64)>,
}

/// What a simulation differs by.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Misfit {
    /// \[m\]; none: all distances.
    pub distance: Option<f64>,
    pub points: usize,
    /// Root mean square, largest, and mean of simulated less measured \[K\]; NaN without points.
    pub rms: f64,
    pub worst: f64,
    pub bias: f64,
}

#[derive(Debug, thiserror::Error)]
pub enum ExperimentError {
    #[error(transparent)]
    File(#[from] FileError),
    #[error("{file}, line {line}: '{text}', allowed: {allowed}", file = file.display())]
    Line { file: PathBuf, line: usize, text: String, allowed: String },
    #[error("{file}: distance_m = {distance} is none of record.distances = {probes:?}", file = file.display())]
    NoProbe { file: PathBuf, distance: f64, probes: Vec<f64> },
}

/// Reads measurements: [`HEADER`], then a line each. Lines that begin with # are comments.
///
/// # Errors
/// The first line that is no measurement.
pub fn read(file: &Path) -> Result<Vec<Measured>, ExperimentError> {
    let (text, mut headed, mut rows) = (read_text(file)?, false, Vec::new());
    for (number, line) in text.lines().enumerate() {
        if line.starts_with('#') || line.trim().is_empty() {
            continue;
        }
        let wrong = |allowed: &str| ExperimentError::Line {
            file: file.to_path_buf(),
            line: number + 1,
            text: line.to_string(),
            allowed: allowed.to_string(),
        };
        if !headed {
            if line.trim() != HEADER {
                return Err(wrong(HEADER));
            }
            headed = true;
            continue;
        }
        let numbers: Option<Vec<f64>> =
            line.split(',').map(|field| field.trim().parse().ok().filter(|x: &f64| x.is_finite())).collect();
        match numbers.as_deref() {
            Some(&[distance, time, celsius]) => {
                rows.push(Measured { distance, time, temperature: celsius + ZERO_CELSIUS });
            }
            _ => return Err(wrong("three finite numbers")),
        }
    }
    Ok(rows)
}

/// The record of a distance, if there is one.
fn record_at(records: &[Record], distance: f64) -> Option<&Record> {
    records.iter().find(|record| (record.distance - distance).abs() < 1e-6)
}

/// Checks that each measurement has a record.
///
/// # Errors
/// The first distance without one.
pub fn check(file: &Path, measured: &[Measured], probes: &[f64]) -> Result<(), ExperimentError> {
    let known = |m: &&Measured| probes.iter().any(|probe| (probe - m.distance).abs() < 1e-6);
    match measured.iter().find(|m| !known(m)) {
        None => Ok(()),
        Some(m) => Err(ExperimentError::NoProbe {
            file: file.to_path_buf(),
            distance: m.distance,
            probes: probes.to_vec(),
        }),
    }
}

/// Number of measurements outside the time of the run, which [`misfits`] leave out.
pub fn left_out(measured: &[Measured], records: &[Record]) -> usize {
    let inside = |m: &&Measured| record_at(records, m.distance).and_then(|r| at(r, m.time)).is_some();
    measured.len() - measured.iter().filter(inside).count()
}

/// Misfits by distance, and then of all; measurements outside the time of the run are left out. NaN if none is left.
pub fn misfits(measured: &[Measured], records: &[Record]) -> Vec<Misfit> {
    let errors = |m: &Measured| Some(at(record_at(records, m.distance)?, m.time)? - m.temperature);
    let of = |distance: Option<f64>| {
        let wanted = |m: &&Measured| distance.is_none_or(|d| (d - m.distance).abs() < 1e-6);
        let errors: Vec<f64> = measured.iter().filter(wanted).filter_map(errors).collect();
        // 0/0: nothing to compare with is no perfect fit.
        let count = errors.len() as f64;
        let first = errors.first().copied().unwrap_or(f64::NAN);
        Misfit {
            distance,
            points: errors.len(),
            rms: (errors.iter().map(|e| e * e).sum::<f64>() / count).sqrt(),
            worst: errors.iter().fold(first, |worst, e| if e.abs() > f64::abs(worst) { *e } else { worst }),
            bias: errors.iter().sum::<f64>() / count,
        }
    };
    records.iter().map(|record| of(Some(record.distance))).chain([of(None)]).collect()
}

/// T of a record at a time, straight between its rows; none outside.
fn at(record: &Record, time: f64) -> Option<f64> {
    let rows = &record.rows;
    let above = rows.partition_point(|row| row.0 < time);
    let b = rows.get(above)?;
    if above == 0 {
        return (b.0 == time).then_some(b.1);
    }
    let a = rows[above - 1];
    Some(a.1 + (b.1 - a.1) * (time - a.0) / (b.0 - a.0))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn misfits_are_those_of_straight_lines() {
        let record = |distance: f64| Record { distance, rows: vec![(0.0, 300.0), (10.0, 310.0)] };
        let point = |distance: f64, time: f64, temperature: f64| Measured { distance, time, temperature };
        let measured =
            [point(0.1, 5.0, 304.0), point(0.1, 10.0, 311.0), point(0.2, 2.0, 305.0), point(0.2, 11.0, 0.0)];
        let found = misfits(&measured, &[record(0.1), record(0.2)]);
        assert_eq!(found[0], Misfit { distance: Some(0.1), points: 2, rms: 1.0, worst: 1.0, bias: 0.0 });
        assert_eq!(found[1], Misfit { distance: Some(0.2), points: 1, rms: 3.0, worst: -3.0, bias: -3.0 });
        assert_eq!((found[2].points, found[2].bias), (3, -1.0));
        assert_eq!(left_out(&measured, &[record(0.1), record(0.2)]), 1);
        let none = misfits(&measured[3..], &[record(0.2)])[1];
        assert!(none.points == 0 && none.rms.is_nan() && none.worst.is_nan() && none.bias.is_nan());
    }
}
