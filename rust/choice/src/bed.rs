//! The bed as far as the error bands need to know it.

/// What the bands need to know of a bed.
#[derive(Clone, Debug, PartialEq)]
pub struct Bed {
    /// Number of grains.
    pub grains: f64,
    /// Mean radius [m].
    pub mean_radius: f64,
    /// Number of grains over which a value is a mean.
    pub window: f64,
    /// Neighbouring points that differ in one coordinate: their numbers, the direction, and the distance [m].
    pub neighbours: Vec<([usize; 2], usize, f64)>,
}

impl Bed {
    /// Root of the mean square of the gradient over the points.
    pub fn gradient(&self, row: &[f64]) -> f64 {
        let mut sums = [(0.0, 0.0); 3];
        for &([a, b], direction, distance) in &self.neighbours {
            if let (Some(a), Some(b)) = (row.get(a), row.get(b)) {
                let slope = (b - a) / distance;
                if slope.is_finite() {
                    sums[direction].0 += slope * slope;
                    sums[direction].1 += 1.0;
                }
            }
        }
        sums.iter().filter(|sum| sum.1 > 0.0).map(|sum| sum.0 / sum.1).sum::<f64>().sqrt()
    }
}
