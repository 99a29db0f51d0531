//! The region of a model's training states, and the scatter between packings of equal state.

use crate::scaling::Range;
use serde::{Deserialize, Serialize};

/// Coordinates of a state, each scaled to [-1, 1] over the training data; unused ones are zero.
pub type Coordinates = [f64; MAX_COORDINATES];

/// Largest number of coordinates.
pub const MAX_COORDINATES: usize = 6;

/// Region of the training states in scaled coordinates; it is unchanged by a turn by 90°.
///
/// The convex hull of some thousand points in five dimensions would have a six-digit number of facets. Stored instead
/// is the smallest region around it bounded by half-spaces whose normals have up to three components of ±1: it contains
/// the hull and touches it in each of these directions. Gaps inside the region are detected by the distance to the
/// nearest of a set of training states.
/// such direction. Holes inside are known from the distance to the nearest of a set of training states.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Region {
    /// Number of coordinates in use.
    pub dimensions: usize,
    /// Largest n·z/|n| over the training states z, for the normals n in the order of `normals`.
    pub support: Vec<f64>,
    /// Some of the training states, such that every other one is near one of them (farthest-point sampling; Gonzalez
    /// 1985).
    pub states: Vec<Coordinates>,
    /// Largest distance of a training state from the nearest of `states`.
    pub spacing: f64,
}

/// Number of training states that are stored; `spacing` is then about a tenth of the range.
const KEPT_STATES: usize = 256;

/// Normals with one to three components of ±1, unit length.
fn normals(dimensions: usize) -> Vec<Coordinates> {
    let mut normals = Vec::new();
    let all = 3usize.pow(dimensions as u32);
    for code in 1..all {
        let mut normal = [0.0; MAX_COORDINATES];
        let (mut rest, mut count) = (code, 0);
        for component in normal.iter_mut().take(dimensions) {
            *component = [0.0, 1.0, -1.0][rest % 3];
            count += usize::from(rest % 3 != 0);
            rest /= 3;
        }
        if count <= 3 {
            normals.push(normal.map(|component| component / (count as f64).sqrt()));
        }
    }
    normals
}

fn dot(a: &Coordinates, b: &Coordinates) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).fold(0.0, |sum, term| sum + term)
}

fn square_distance(a: &Coordinates, b: &Coordinates) -> f64 {
    a.iter().zip(b).map(|(a, b)| (a - b) * (a - b)).fold(0.0, |sum, term| sum + term)
}

impl Region {
    /// The region of these points.
    ///
    /// # Panics
    /// When there are no points.
    pub fn of(points: &[Coordinates], dimensions: usize) -> Self {
        let highest = |normal: &Coordinates| points.iter().map(|p| dot(normal, p)).fold(f64::MIN, f64::max);
        let support = normals(dimensions).iter().map(highest).collect();
        let mut states = vec![points[0]];
        let mut distance: Vec<f64> = points.iter().map(|p| square_distance(p, &states[0])).collect();
        loop {
            let mut farthest = 0;
            for (index, d) in distance.iter().enumerate() {
                if *d > distance[farthest] {
                    farthest = index;
                }
            }
            if states.len() == KEPT_STATES || distance[farthest] == 0.0 {
                let spacing = distance[farthest].sqrt().max(1e-6);
                return Self { dimensions, support, states, spacing };
            }
            states.push(points[farthest]);
            for (d, p) in distance.iter_mut().zip(points) {
                *d = d.min(square_distance(p, &points[farthest]));
            }
        }
    }

    /// Number of half-spaces in this many dimensions.
    pub fn support_count(dimensions: usize) -> usize {
        if dimensions <= MAX_COORDINATES { normals(dimensions).len() } else { 0 }
    }

    /// Distance by which a point lies outside of the region, measured to the half-space that it violates most; 0
    /// inside.
    pub fn beyond_hull(&self, point: &Coordinates) -> f64 {
        let normals = normals(self.dimensions);
        let beyond = normals.iter().zip(&self.support).map(|(normal, support)| dot(normal, point) - support);
        beyond.fold(0.0, f64::max)
    }

    /// Distance to the nearest stored state over `spacing`: above 1, there was no training state near the point.
    pub fn distance(&self, point: &Coordinates) -> f64 {
        let nearest = self.states.iter().map(|state| square_distance(state, point)).fold(f64::MAX, f64::min);
        nearest.sqrt() / self.spacing
    }
}

/// Standard deviations between packings of equal state, as functions of the reduced pressure.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Spread {
    pub pressure: Range,
    /// Relative standard deviation of K, in bins of equal width in √p̃.
    pub conductivity: Vec<f64>,
    /// Standard deviation of dp̃/dε [-], in the same bins.
    pub pressure_rate: Vec<f64>,
}

const BINS: usize = 6;

impl Spread {
    /// Number of bins.
    pub const BINS: usize = BINS;

    /// Computed from the residuals of a fit at states of known p̃: (p̃, relative error of K) and (p̃, error of dp̃/dε).
    pub fn of(pressure: Range, conductivity: &[(f64, f64)], rate: &[(f64, f64)]) -> Self {
        let mut spread = Self { pressure, conductivity: vec![0.0; BINS], pressure_rate: vec![0.0; BINS] };
        let deviation = |errors: &[(f64, f64)]| {
            let mut sums = [[0.0; 2]; BINS];
            for (pressure, error) in errors {
                let bin = spread.bin(*pressure).0;
                sums[bin][0] += error * error;
                sums[bin][1] += 1.0;
            }
            let all = errors.iter().map(|(_, e)| e * e).sum::<f64>() / errors.len().max(1) as f64;
            let value = |[sum, count]: [f64; 2]| if count < 10.0 { all.sqrt() } else { (sum / count).sqrt() };
            sums.map(value).to_vec()
        };
        (spread.conductivity, spread.pressure_rate) = (deviation(conductivity), deviation(rate));
        spread
    }

    /// Bin of a pressure, and the fraction of the way to the middle of the next bin, for interpolation.
    fn bin(&self, pressure: f64) -> (usize, f64) {
        let share = (self.pressure.clamp(pressure) / self.pressure.max).sqrt() * BINS as f64;
        let bin = (share as usize).min(BINS - 1);
        (bin, share - bin as f64 - 0.5)
    }

    /// Standard deviation of K (relative) and of dp̃/dε at a reduced pressure.
    pub fn at(&self, pressure: f64) -> [f64; 2] {
        let (bin, beyond) = self.bin(pressure);
        let other = if beyond < 0.0 { bin.saturating_sub(1) } else { (bin + 1).min(BINS - 1) };
        let between = |values: &[f64]| values[bin] + beyond.abs() * (values[other] - values[bin]);
        [between(&self.conductivity), between(&self.pressure_rate)]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn ring() -> Vec<Coordinates> {
        (0..720)
            .map(|i| {
                let angle = f64::from(i) * std::f64::consts::PI / 360.0;
                [angle.cos(), angle.sin(), 0.0, 0.0, 0.0, 0.0]
            })
            .collect()
    }

    #[test]
    fn the_distance_knows_the_hole_that_the_hull_does_not() {
        let region = Region::of(&ring(), 2);
        let at = |x: f64, y: f64| [x, y, 0.0, 0.0, 0.0, 0.0];
        assert_eq!(region.beyond_hull(&at(0.0, 0.0)), 0.0);
        assert!(region.distance(&at(0.0, 0.0)) > 10.0);
        assert!(ring().iter().all(|p| region.beyond_hull(p) < 1e-12 && region.distance(p) <= 1.0));
        assert!((region.beyond_hull(&at(1.5, 0.0)) - 0.5).abs() < 1e-9);
        assert!((region.beyond_hull(&at(-1.0, -1.0)) - (2f64.sqrt() - 1.0)).abs() < 1e-4);
    }

    #[test]
    fn spread_follows_the_bins() {
        let errors: Vec<(f64, f64)> = (0..6000)
            .map(|i| {
                let share = (f64::from(i) + 0.5) / 6000.0;
                (0.2 * share * share, if i % 2 == 0 { share } else { -share })
            })
            .collect();
        let spread = Spread::of(Range { min: 0.0, max: 0.2 }, &errors, &errors);
        let [low, _] = spread.at(0.2 * 0.25);
        let [high, rate] = spread.at(0.2 * 0.81);
        assert!((low - 0.5).abs() < 0.05 && (high - 0.9).abs() < 0.05 && rate == high, "{low} {high}");
    }
}
