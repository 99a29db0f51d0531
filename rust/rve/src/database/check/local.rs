//! Local linear regression of an output in two inputs: its expected value at given inputs, and the scatter of single
//! values about it.

/// Number of nearest points of a local fit; three would determine the plane.
pub const NEIGHBOURS: usize = 16;

/// Data points: inputs and one output.
pub struct Points<'a> {
    pub inputs: &'a [[f64; 2]],
    pub output: &'a [f64],
}

impl Points<'_> {
    /// Value at `at` of the plane fitted to the nearest points, and the variance of single values about that plane.
    /// None with fewer than [`NEIGHBOURS`] points, or when they lie on a line.
    pub fn fit(&self, at: [f64; 2]) -> Option<(f64, f64)> {
        if self.inputs.len() < NEIGHBOURS {
            return None;
        }
        let scale = scale(self.inputs);
        let distance = |k: usize| {
            let [a, b] = self.inputs[k];
            ((a - at[0]) / scale[0]).hypot((b - at[1]) / scale[1])
        };
        let mut order: Vec<(f64, usize)> = (0..self.inputs.len()).map(|k| (distance(k), k)).collect();
        let nearer = |a: &(f64, usize), b: &(f64, usize)| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1));
        order.select_nth_unstable_by(NEIGHBOURS - 1, nearer);
        let near = &mut order[..NEIGHBOURS];
        near.sort_by(nearer);
        let near: Vec<usize> = near.iter().map(|(_, k)| *k).collect();
        let basis = |k: usize| {
            let [a, b] = self.inputs[k];
            [1.0, (a - at[0]) / scale[0], (b - at[1]) / scale[1]]
        };
        let mut normal = [[0.0; 4]; 3];
        for &k in &near {
            let row = basis(k);
            for (i, equation) in normal.iter_mut().enumerate() {
                (0..3).for_each(|j| equation[j] += row[i] * row[j]);
                equation[3] += row[i] * self.output[k];
            }
        }
        let plane = solve(normal)?;
        let residual =
            |k: usize| self.output[k] - basis(k).iter().zip(&plane).map(|(b, c)| b * c).sum::<f64>();
        let squares: f64 = near.iter().map(|&k| residual(k).powi(2)).sum();
        Some((plane[0], squares / (NEIGHBOURS - 3) as f64))
    }
}

/// Standard deviation of each input; 1 for inputs that are constant.
fn scale(inputs: &[[f64; 2]]) -> [f64; 2] {
    [0, 1].map(|k| {
        let deviation = variance(&inputs.iter().map(|input| input[k]).collect::<Vec<f64>>()).sqrt();
        if deviation > 0.0 { deviation } else { 1.0 }
    })
}

/// Mean; 0 for an empty list.
pub fn mean(values: &[f64]) -> f64 {
    values.iter().sum::<f64>() / values.len().max(1) as f64
}

/// Variance of the values, n − 1 in the denominator.
pub fn variance(values: &[f64]) -> f64 {
    let mean = mean(values);
    values.iter().map(|v| (v - mean).powi(2)).sum::<f64>() / values.len().saturating_sub(1).max(1) as f64
}

/// Median, the upper one of an even number; 0 for an empty list.
pub fn median(values: &[f64]) -> f64 {
    let mut sorted = values.to_vec();
    sorted.sort_by(f64::total_cmp);
    sorted.get(sorted.len() / 2).copied().unwrap_or(0.0)
}

/// Gaussian elimination with pivoting for three equations; the last column is the right-hand side.
fn solve(mut a: [[f64; 4]; 3]) -> Option<[f64; 3]> {
    let size = a.iter().flatten().fold(0.0, |m: f64, v| m.max(v.abs()));
    for k in 0..3 {
        let pivot = (k..3).max_by(|&i, &j| a[i][k].abs().total_cmp(&a[j][k].abs()))?;
        a.swap(k, pivot);
        if a[k][k].abs() <= 1e-12 * size {
            return None;
        }
        let row = a[k];
        for (_, other) in a.iter_mut().enumerate().filter(|(i, _)| *i != k) {
            let factor = other[k] / row[k];
            (0..4).for_each(|j| other[j] -= factor * row[j]);
        }
    }
    Some([0, 1, 2].map(|k| a[k][3] / a[k][k]))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// For a plane plus alternating noise of known size, both the plane and the size of the noise are found.
    #[test]
    fn plane_and_scatter_are_found() {
        let inputs: Vec<[f64; 2]> = (0..400).map(|k| [f64::from(k % 20), 0.1 * f64::from(k / 20)]).collect();
        let noise = |k: usize| if (k * 7919 + k / 20).is_multiple_of(2) { 0.01 } else { -0.01 };
        let output: Vec<f64> =
            inputs.iter().enumerate().map(|(k, [a, b])| 3.0 + 2.0 * a - b + noise(k)).collect();
        let (value, variance) = Points { inputs: &inputs, output: &output }.fit([7.3, 0.85]).unwrap();
        assert!((value - (3.0 + 14.6 - 0.85)).abs() < 0.01, "{value}");
        assert!((variance.sqrt() / 0.01 - 1.0).abs() < 0.25, "{variance}");
        assert!(Points { inputs: &inputs[..5], output: &output[..5] }.fit([0.0, 0.0]).is_none());
    }
}
