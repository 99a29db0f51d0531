//! Temperatures at points and times.

use crate::ChoiceError;
use msdd_files::read_text;
use std::path::Path;

/// OpenFOAM's value at a point outside of the mesh.
const OUTSIDE: f64 = 1e200;
/// Times of two runs are the same up to this share of the largest.
const SAME_TIME: f64 = 1e-6;

/// A quantity at points, such as T [K], in rows of one time [s] each.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Series {
    pub times: Vec<f64>,
    /// One row for each time, one column for each point, or three for those of a vector; NaN outside of the mesh.
    pub values: Vec<Vec<f64>>,
}

impl Series {
    /// Reads the file of OpenFOAM's function object `probes`.
    ///
    /// # Errors
    /// [`ChoiceError::File`], [`ChoiceError::Read`].
    pub fn read(file: &Path) -> Result<Self, ChoiceError> {
        let wrong = |line: &str| ChoiceError::Read { file: file.to_path_buf(), problem: format!("'{line}'") };
        let mut series = Self::default();
        for line in read_text(file)?.lines().filter(|line| !line.trim_start().starts_with('#')) {
            let words = line.split(|c: char| c.is_whitespace() || "()".contains(c));
            let numbers: Result<Vec<f64>, _> =
                words.filter(|word| !word.is_empty()).map(str::parse).collect();
            let numbers = numbers.map_err(|_| wrong(line))?;
            let Some((&time, values)) = numbers.split_first() else { continue };
            series.times.push(time);
            series.values.push(
                values.iter().map(|&value| if value.abs() < OUTSIDE { value } else { f64::NAN }).collect(),
            );
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

    /// Largest minus smallest T [K].
    pub fn range(&self) -> f64 {
        let finite = || self.values.iter().flatten().copied().filter(|value| value.is_finite());
        finite().fold(f64::NEG_INFINITY, f64::max) - finite().fold(f64::INFINITY, f64::min)
    }

    /// How far `other` is away [K]: the largest of the [`Self::deviations`]. NaN without common times.
    pub fn distance(&self, other: &Self) -> f64 {
        self.deviations(other).into_iter().filter(|distance| distance.is_finite()).fold(f64::NAN, f64::max)
    }

    /// How far `other` is away in each column: the root of the mean square over the times that both have. NaN without such times,
    /// and for points outside of the mesh.
    pub fn deviations(&self, other: &Self) -> Vec<f64> {
        let last = self.times.iter().copied().map(f64::abs).fold(0.0, f64::max);
        let pairs: Vec<(&Vec<f64>, &Vec<f64>)> = self
            .times
            .iter()
            .zip(&self.values)
            .filter_map(|(&time, row)| {
                let same = |&(_, &t): &(usize, &f64)| (t - time).abs() <= SAME_TIME * last;
                let (at, _) = other.times.iter().enumerate().find(same)?;
                Some((row, &other.values[at]))
            })
            .collect();
        let columns = self.values.first().map_or(0, Vec::len);
        let at = |column: usize| {
            let squares = pairs.iter().map(|(a, b)| (a[column] - b[column]).powi(2));
            (squares.sum::<f64>() / pairs.len() as f64).sqrt()
        };
        (0..columns).map(at).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn distance_is_the_worst_point_over_common_times() {
        let a = Series {
            times: vec![0.0, 1.0, 2.0],
            values: vec![vec![1.0, 5.0], vec![2.0, 5.0], vec![3.0, 5.0]],
        };
        let b = Series {
            times: vec![1.0, 2.0, 3.0],
            values: vec![vec![2.0, 8.0], vec![3.0, 9.0], vec![0.0, 0.0]],
        };
        assert_eq!(a.distance(&b), (0.5f64 * (9.0 + 16.0)).sqrt());
        assert_eq!(a.range(), 4.0);
        assert_eq!(a.deviations(&b), [0.0, (0.5f64 * (9.0 + 16.0)).sqrt()]);
        assert!(a.distance(&Series::default()).is_nan());
    }

    #[test]
    fn points_outside_of_the_mesh_do_not_count() {
        let file = std::env::temp_dir().join(format!("msdd-choice-series-{}", std::process::id()));
        std::fs::write(&file, "# Probe 0 (1 1 1)\n#  Time\n 0 -1e+300 3\n 1 -1e+300 4\n").unwrap();
        let read = Series::read(&file).unwrap();
        std::fs::remove_file(&file).unwrap();
        assert_eq!((read.range(), read.times.len()), (1.0, 2));
        assert_eq!(read.distance(&read), 0.0);
    }

    #[test]
    fn vectors_have_three_columns() {
        let file = std::env::temp_dir().join(format!("msdd-choice-vectors-{}", std::process::id()));
        std::fs::write(&file, "# Probe 0 (1 1 1)\n 0 (0 0 0) (1 2 3)\n").unwrap();
        let read = Series::read(&file).unwrap();
        std::fs::remove_file(&file).unwrap();
        assert_eq!(read.values, [[0.0, 0.0, 0.0, 1.0, 2.0, 3.0]]);
    }
}
