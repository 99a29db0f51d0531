//! Values at points and times.

use crate::ChoiceError;
use msdd_files::read_text;
use serde::{Deserialize, Deserializer, Serialize};
use std::path::Path;

/// OpenFOAM's value at a point outside of the mesh.
const OUTSIDE: f64 = 1e200;
/// Times of two runs are the same up to this share of the largest.
const SAME_TIME: f64 = 1e-6;

/// One number at points, in rows of one time [s] each.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Series {
    pub times: Vec<f64>,
    /// One row for each time, one column for each point; NaN outside of the mesh.
    #[serde(deserialize_with = "with_gaps")]
    pub values: Vec<Vec<f64>>,
}

/// JSON has null in place of NaN.
fn with_gaps<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Vec<Vec<f64>>, D::Error> {
    let rows: Vec<Vec<Option<f64>>> = Vec::deserialize(deserializer)?;
    Ok(rows.into_iter().map(|row| row.into_iter().map(|value| value.unwrap_or(f64::NAN)).collect()).collect())
}

impl Series {
    /// Reads one component of the file of OpenFOAM's function object `probes` for so many points.
    ///
    /// # Errors
    /// [`ChoiceError::File`], [`ChoiceError::Read`].
    pub fn read(file: &Path, points: usize, component: usize) -> Result<Self, ChoiceError> {
        let wrong = |line: &str| ChoiceError::Read { file: file.to_path_buf(), problem: format!("'{line}'") };
        let mut series = Self::default();
        for line in read_text(file)?.lines().filter(|line| !line.trim_start().starts_with('#')) {
            let words = line.split(|c: char| c.is_whitespace() || c == '(' || c == ')');
            let numbers: Result<Vec<f64>, _> =
                words.filter(|word| !word.is_empty()).map(str::parse).collect();
            let numbers = numbers.map_err(|_| wrong(line))?;
            let Some((&time, values)) = numbers.split_first() else { continue };
            let components = values.len() / points.max(1);
            if component >= components || values.len() != components * points {
                return Err(wrong(line));
            }
            let inside = |value: f64| if value.abs() < OUTSIDE { value } else { f64::NAN };
            series.times.push(time);
            series.values.push(values.chunks(components).map(|parts| inside(parts[component])).collect());
        }
        match series.values.iter().flatten().any(|value| value.is_finite()) {
            true => Ok(series),
            false => Err(wrong("no point inside the mesh")),
        }
    }

    /// Adds the rows of another part of the same run.
    pub fn add(&mut self, other: Self) {
        self.times.extend(other.times);
        self.values.extend(other.values);
    }

    /// Largest minus smallest value.
    pub fn range(&self) -> f64 {
        let finite = || self.values.iter().flatten().copied().filter(|value| value.is_finite());
        finite().fold(f64::NEG_INFINITY, f64::max) - finite().fold(f64::INFINITY, f64::min)
    }

    /// The row of a time.
    pub fn at(&self, time: f64) -> Option<&[f64]> {
        let last = self.times.iter().copied().map(f64::abs).fold(0.0, f64::max);
        let index = self.times.iter().position(|t| (t - time).abs() <= SAME_TIME * last)?;
        Some(&self.values[index])
    }

    /// This minus `other`, times `factor`, at the times that both have.
    pub fn minus(&self, other: &Self, factor: f64) -> Self {
        let mut series = Self::default();
        for (&time, row) in self.times.iter().zip(&self.values) {
            if let Some(base) = other.at(time) {
                series.times.push(time);
                series.values.push(row.iter().zip(base).map(|(a, b)| factor * (a - b)).collect());
            }
        }
        series
    }

    /// Root of the mean square over points inside the mesh and times; NaN without any.
    pub fn rms(&self) -> f64 {
        let finite = self.values.iter().flatten().filter(|value| value.is_finite());
        let (sum, count) = finite.fold((0.0, 0), |(sum, count), value| (sum + value * value, count + 1));
        if count == 0 { f64::NAN } else { (sum / f64::from(count)).sqrt() }
    }

    /// Root of the mean square of the difference over points and the times that both have; NaN without such times.
    pub fn distance(&self, other: &Self) -> f64 {
        self.minus(other, 1.0).rms()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn distance_is_the_mean_over_points_and_common_times() {
        let a = Series {
            times: vec![0.0, 1.0, 2.0],
            values: vec![vec![1.0, 5.0], vec![2.0, 5.0], vec![3.0, 5.0]],
        };
        let b = Series {
            times: vec![1.0, 2.0, 3.0],
            values: vec![vec![2.0, 8.0], vec![3.0, 9.0], vec![0.0, 0.0]],
        };
        assert_eq!(a.distance(&b), (0.25f64 * (9.0 + 16.0)).sqrt());
        assert_eq!(a.range(), 4.0);
        assert!(a.distance(&Series::default()).is_nan());
    }

    #[test]
    fn points_outside_of_the_mesh_do_not_count_and_survive_json() {
        let file = std::env::temp_dir().join(format!("msdd-choice-series-{}", std::process::id()));
        std::fs::write(&file, "# Probe 0 (1 1 1)\n#  Time\n 0 -1e+300 3\n 1 -1e+300 4\n").unwrap();
        let read = Series::read(&file, 2, 0).unwrap();
        std::fs::write(&file, "0 (1 2 3) (4 5 6)\n").unwrap();
        let vectors = Series::read(&file, 2, 1).unwrap();
        let too_many = Series::read(&file, 4, 0);
        std::fs::remove_file(&file).unwrap();
        assert_eq!((read.range(), read.times.len()), (1.0, 2));
        assert_eq!(read.distance(&read), 0.0);
        assert_eq!(vectors.values, [[2.0, 5.0]]);
        assert!(too_many.is_err());
        let again: Series = serde_json::from_str(&serde_json::to_string(&read).unwrap()).unwrap();
        assert!(again.values[0][0].is_nan());
        assert_eq!(again.distance(&read), 0.0);
    }
}
