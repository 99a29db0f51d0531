//! The bed as far as the error bands need to know it.

/// Of what a bed is made.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Grains {
    Discs,
    Spheres,
}

/// Area of the plane for each disc over the square of the mean radius: radii from 0.6 to 1.4 times it, porosity 0.1 to 0.13.
const DISC: f64 = 3.7;
/// Volume for each sphere over the cube of the radius, for a porosity of 0.4.
const SPHERE: f64 = 4.0 / 3.0 * std::f64::consts::PI / 0.6;

impl Grains {
    /// Number of grains of this mean radius \[m\] in a volume \[m³\], of which `area` is a cut across z \[m²\]: discs lie in it alone.
    pub fn number(self, mean_radius: f64, volume: f64, area: f64) -> f64 {
        match self {
            Self::Discs => area / (DISC * mean_radius.powi(2)),
            Self::Spheres => volume / (SPHERE * mean_radius.powi(3)),
        }
    }
}

/// What the bands need to know of a bed.
#[derive(Clone, Debug, PartialEq)]
pub struct BandInputs {
    pub kind: Grains,
    /// Number of grains.
    pub grains: f64,
    /// Mean radius \[m\].
    pub mean_radius: f64,
    /// Number of grains over which a value is a mean.
    pub window: f64,
    /// Neighbouring points that differ in one coordinate: their numbers, the direction, and the distance \[m\].
    pub neighbours: Vec<([usize; 2], usize, f64)>,
}

impl BandInputs {
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
