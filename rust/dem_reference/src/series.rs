//! Time series and numbers by packing: interpolation, means and deviations.

/// Mean and standard deviation over packings (n - 1).
pub fn mean_and_deviation(values: &[f64]) -> (f64, f64) {
    let n = values.len() as f64;
    let mean = values.iter().sum::<f64>() / n;
    let squares: f64 = values.iter().map(|v| (v - mean).powi(2)).sum();
    (mean, if n > 1.0 { (squares / (n - 1.0)).sqrt() } else { 0.0 })
}

/// Mean and deviation of columns `[packing][k]` at each `k`.
pub fn statistics(by_packing: &[Vec<f64>]) -> Vec<(f64, f64)> {
    let count = by_packing.iter().map(Vec::len).min().unwrap_or(0);
    (0..count)
        .map(|k| mean_and_deviation(&by_packing.iter().map(|values| values[k]).collect::<Vec<_>>()))
        .collect()
}

/// The value that is furthest from zero, with its sign.
pub fn largest(values: &[f64]) -> f64 {
    values.iter().fold(0.0, |worst: f64, &v| if v.abs() > worst.abs() { v } else { worst })
}

/// Value of a series at time `t`, by the cubic through the four points around it, or a polynomial through fewer near the
/// ends. Linear interpolation would be too coarse: adaptive steps may be longer than the 0.1 s of the reference.
pub fn at(series: &[[f64; 2]], t: f64) -> f64 {
    let after = series.partition_point(|row| row[0] < t - 1e-9);
    if let Some(row) = series.get(after).filter(|row| (row[0] - t).abs() < 1e-9) {
        return row[1];
    }
    let first = after.saturating_sub(2);
    let near = &series[first..(after + 2).min(series.len())];
    near.iter()
        .enumerate()
        .map(|(i, row)| {
            let others = near.iter().enumerate().filter(|&(j, _)| j != i);
            others.fold(row[1], |w, (_, other)| w * (t - other[0]) / (row[0] - other[0]))
        })
        .sum()
}

/// Root mean square; 0 when there are no values.
pub fn root_mean_square(values: &[f64]) -> f64 {
    (values.iter().map(|v| v * v).sum::<f64>() / values.len().max(1) as f64).sqrt()
}

/// Mean over all sub-regions and packings, and the standard deviation over the sub-regions, averaged over the packings.
pub fn spread(by_packing: &[Vec<f64>]) -> (f64, f64) {
    let each: Vec<(f64, f64)> = by_packing.iter().map(|values| mean_and_deviation(values)).collect();
    let n = each.len() as f64;
    (each.iter().map(|e| e.0).sum::<f64>() / n, each.iter().map(|e| e.1).sum::<f64>() / n)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn mean_and_deviation_over_packings() {
        assert_eq!(statistics(&[vec![1.0, 5.0], vec![3.0, 5.0]])[1], (5.0, 0.0));
        assert!((statistics(&[vec![1.0], vec![3.0]])[0].1 - 2f64.sqrt()).abs() < 1e-12);
    }

    #[test]
    fn a_series_is_interpolated_by_a_cubic() {
        let cubic = |t: f64| 1.0 + t - 2.0 * t * t + 0.3 * t * t * t;
        let series: Vec<[f64; 2]> = [0.0, 0.4, 1.1, 1.5, 2.6].map(|t| [t, cubic(t)]).to_vec();
        for t in [0.7, 1.2, 1.5] {
            assert!((at(&series, t) - cubic(t)).abs() < 1e-12, "{t}");
        }
    }
}
