//! Values at points and times.

use crate::ChoiceError;
use msdd_case::tables;
use serde::{Deserialize, Deserializer, Serialize};
use std::path::Path;

/// OpenFOAM's value at a point outside of the mesh.
const OUTSIDE: f64 = 1e200;
/// Times of two runs are the same up to this share of the largest.
const SAME_TIME: f64 = 1e-6;

/// Numbers at points, in rows of one time \[s\] each.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Series {
    pub times: Vec<f64>,
    /// One row for each time, one column for each point, or as many as a vector or tensor has components; NaN outside of the mesh.
    #[serde(deserialize_with = "with_gaps")]
    pub values: Vec<Vec<f64>>,
}

/// JSON has null instead of NaN.
fn with_gaps<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Vec<Vec<f64>>, D::Error> {
    let rows: Vec<Vec<Option<f64>>> = Vec::deserialize(deserializer)?;
    Ok(rows.into_iter().map(|row| row.into_iter().map(|value| value.unwrap_or(f64::NAN)).collect()).collect())
}

impl Series {
    /// Reads the table `file` of the function object `name` in a case.
    ///
    /// # Errors
    /// [`ChoiceError::Case`], [`ChoiceError::Read`].
    pub fn read(case: &Path, name: &str, file: &str) -> Result<Self, ChoiceError> {
        let table = tables::read(case, name, Some(file))?;
        let wrong = |line: &str| ChoiceError::Read { file: table.file.clone(), problem: format!("'{line}'") };
        let mut series = Self::default();
        for line in &table.rows {
            let words = line.split(|c: char| c.is_whitespace() || "()".contains(c));
            let numbers: Result<Vec<f64>, _> =
                words.filter(|word| !word.is_empty()).map(str::parse).collect();
            let numbers = numbers.map_err(|_| wrong(line))?;
            let Some((&time, values)) = numbers.split_first() else { continue };
            let inside = |&value: &f64| if value.abs() < OUTSIDE { value } else { f64::NAN };
            series.times.push(time);
            series.values.push(values.iter().map(inside).collect());
        }
        match series.values.iter().flatten().any(|value| value.is_finite()) {
            true => Ok(series),
            false => Err(wrong("no point inside the mesh")),
        }
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

    /// Mean over points inside the mesh and times; NaN without any.
    pub fn mean(&self) -> f64 {
        let finite = self.values.iter().flatten().filter(|value| value.is_finite());
        let (sum, count) = finite.fold((0.0, 0), |(sum, count), value| (sum + value, count + 1));
        sum / f64::from(count)
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

    /// How far `other` is away in each column: the root of the mean square over the times that both have. NaN without such times,
    /// and for points outside of the mesh.
    pub fn deviations(&self, other: &Self) -> Vec<f64> {
        let difference = self.minus(other, 1.0);
        let columns = self.values.first().map_or(0, Vec::len);
        let at = |column: usize| {
            let squares = difference.values.iter().map(|row| row[column].powi(2));
            (squares.sum::<f64>() / difference.values.len() as f64).sqrt()
        };
        (0..columns).map(at).collect()
    }

    /// One component of a field at so many points.
    pub fn component(&self, points: usize, component: usize) -> Self {
        let pick = |row: &Vec<f64>| {
            row.chunks(row.len().div_ceil(points.max(1)).max(1))
                .map(|parts| parts.get(component).copied().unwrap_or(f64::NAN))
                .collect()
        };
        Self { times: self.times.clone(), values: self.values.iter().map(pick).collect() }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(name: &str, text: &str) -> Series {
        let case = std::env::temp_dir().join(format!("msdd-autotune-{name}-{}", std::process::id()));
        msdd_files::write(&case.join("postProcessing/p/0/T"), text.as_bytes()).unwrap();
        let read = Series::read(&case, "p", "T").unwrap();
        std::fs::remove_dir_all(&case).unwrap();
        read
    }

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
        assert_eq!((a.range(), a.mean()), (4.0, 3.5));
        assert_eq!(a.deviations(&b), [0.0, (0.5f64 * (9.0 + 16.0)).sqrt()]);
        assert!(a.distance(&Series::default()).is_nan());
    }

    #[test]
    fn points_outside_of_the_mesh_do_not_count_and_survive_json() {
        let read = read("series", "# Probe 0 (1 1 1)\n#  Time\n 0 -1e+300 3\n 1 -1e+300 4\n");
        assert_eq!((read.range(), read.times.len()), (1.0, 2));
        assert_eq!(read.distance(&read), 0.0);
        let again: Series = serde_json::from_str(&serde_json::to_string(&read).unwrap()).unwrap();
        assert!(again.values[0][0].is_nan());
        assert_eq!(again.distance(&read), 0.0);
    }

    #[test]
    fn vectors_have_three_columns() {
        let read = read("vectors", "# Probe 0 (1 1 1)\n 0 (0 0 0) (1 2 3)\n");
        assert_eq!(read.values, [[0.0, 0.0, 0.0, 1.0, 2.0, 3.0]]);
        assert_eq!(read.component(2, 1).values, [[0.0, 2.0]]);
    }
}
