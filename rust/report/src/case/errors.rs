//! How far a run is from the reference.

use crate::jobs::user_case::Measured;
use msdd_autotune::series::Series;
use serde::Serialize;

/// An error at the worst point and the mean over the points, each the root of the mean square over the times [%].
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Error {
    pub worst: f64,
    pub mean: f64,
}

/// Errors of a run, each `None` if the run or the reference does not have the quantity.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct Errors {
    /// In percent of the range of T.
    pub temperature: Option<Error>,
    /// In percent of the largest pressure of the reference.
    pub pressure: Option<Error>,
    /// In percent of the largest displacement of the reference.
    pub displacement: Option<Error>,
}

/// What runs are compared with.
#[derive(Clone, Debug, Default)]
pub struct Truth {
    pub temperature: Series,
    pub pressure: Series,
    pub displacement: Series,
    /// Range of T \[K\].
    pub range: f64,
}

impl Truth {
    pub fn of(measured: &Measured, range: f64) -> Self {
        Self {
            temperature: measured.temperature.series(),
            pressure: measured.pressure.series(),
            displacement: measured.displacement.series(),
            range,
        }
    }

    /// Errors of a run.
    pub fn errors(&self, run: &Measured) -> Errors {
        let scalar = |deviations: Vec<f64>| deviations;
        Errors {
            temperature: error(&self.temperature, &run.temperature.series(), self.range, scalar),
            pressure: error(&self.pressure, &run.pressure.series(), largest(&self.pressure), scalar),
            displacement: error(
                &self.displacement,
                &run.displacement.series(),
                largest(&self.displacement),
                lengths,
            ),
        }
    }
}

/// Largest absolute value; of a vector its largest component.
fn largest(series: &Series) -> f64 {
    series
        .values
        .iter()
        .flatten()
        .filter(|value| value.is_finite())
        .fold(0.0, |most, value| value.abs().max(most))
}

/// Lengths of vectors with three columns each.
fn lengths(columns: Vec<f64>) -> Vec<f64> {
    columns.chunks(3).map(|vector| vector.iter().map(|v| v * v).sum::<f64>().sqrt()).collect()
}

fn error(truth: &Series, run: &Series, scale: f64, points: impl Fn(Vec<f64>) -> Vec<f64>) -> Option<Error> {
    let columns = |series: &Series| series.values.first().map_or(0, Vec::len);
    if scale <= 0.0 || columns(truth) == 0 || columns(truth) != columns(run) {
        return None;
    }
    let all = points(truth.deviations(run)).into_iter().filter(|deviation| deviation.is_finite());
    let shares: Vec<f64> = all.map(|deviation| 100.0 * deviation / scale).collect();
    let worst = shares.iter().copied().fold(f64::NAN, f64::max);
    let mean = shares.iter().sum::<f64>() / shares.len() as f64;
    worst.is_finite().then_some(Error { worst, mean })
}

/// Mean over several packings, and for each the errors that it has against this mean as if it were a run: the scatter.
pub fn mean(packings: &[Measured], range: f64) -> (Truth, Option<Errors>) {
    let all: Vec<Truth> = packings.iter().map(|packing| Truth::of(packing, range)).collect();
    let over = |part: fn(&Truth) -> &Series| {
        let first = all.first().map(part).cloned().unwrap_or_default();
        let value = |t: usize, k: usize| {
            let values = all.iter().map(|one| part(one).values.get(t).and_then(|row| row.get(k)).copied());
            values.map(|value| value.unwrap_or(f64::NAN)).sum::<f64>() / all.len() as f64
        };
        let row = |t: usize| (0..first.values[t].len()).map(|k| value(t, k)).collect();
        Series { values: (0..first.values.len()).map(row).collect(), times: first.times.clone() }
    };
    let truth = Truth {
        temperature: over(|truth| &truth.temperature),
        pressure: over(|truth| &truth.pressure),
        displacement: over(|truth| &truth.displacement),
        range,
    };
    let errors: Vec<Errors> = packings.iter().map(|packing| truth.errors(packing)).collect();
    // Standard deviations: the root of the mean square, with n - 1.
    let count = packings.len() as f64;
    let scatter = |part: fn(&Errors) -> Option<Error>| {
        let list: Vec<Error> = errors.iter().filter_map(part).collect();
        let root = |of: fn(&Error) -> f64| {
            (list.iter().map(|error| of(error).powi(2)).sum::<f64>() / (count - 1.0)).sqrt()
        };
        (list.len() == packings.len()).then(|| Error { worst: root(|e| e.worst), mean: root(|e| e.mean) })
    };
    let scatter = (packings.len() > 1).then(|| Errors {
        temperature: scatter(|errors| errors.temperature),
        pressure: scatter(|errors| errors.pressure),
        displacement: scatter(|errors| errors.displacement),
    });
    (truth, scatter)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::jobs::user_case::Rows;

    fn measured(temperature: [f64; 2], displacement: [f64; 3]) -> Measured {
        let rows = |values: &[f64]| Rows {
            times: vec![1.0],
            values: vec![values.iter().map(|&value| Some(value)).collect()],
        };
        Measured { temperature: rows(&temperature), displacement: rows(&displacement), ..Measured::default() }
    }

    #[test]
    fn errors_are_shares_of_the_range() {
        let truth = Truth::of(&measured([10.0, 20.0], [0.0, 5.0, 0.0]), 50.0);
        let errors = truth.errors(&measured([11.0, 20.0], [0.3, 5.4, 0.0]));
        assert_eq!(errors.temperature, Some(Error { worst: 2.0, mean: 1.0 }));
        let displacement = errors.displacement.unwrap();
        assert!((displacement.worst - 10.0).abs() < 1e-9, "{displacement:?}");
        assert_eq!(errors.pressure, None);
    }

    #[test]
    fn scatter_of_two_packings() {
        let pair = [measured([10.0, 20.0], [1.0; 3]), measured([12.0, 20.0], [1.0; 3])];
        let (truth, scatter) = mean(&pair, 100.0);
        assert_eq!(truth.temperature.values, [[11.0, 20.0]]);
        let temperature = scatter.unwrap().temperature.unwrap();
        assert!((temperature.worst - 2f64.sqrt()).abs() < 1e-12, "{temperature:?}");
        assert!(mean(&pair[..1], 100.0).1.is_none());
    }
}
