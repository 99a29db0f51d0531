//! What the searches for pairs ask a grain.

/// A disc (D = 2) or a sphere (D = 3).
pub trait Grain<const D: usize>: Copy {
    /// Centre \[m\].
    fn centre(&self) -> [f64; D];
    /// \[m\]
    fn radius(&self) -> f64;
    /// The same grain elsewhere.
    fn at(self, centre: [f64; D]) -> Self;
}

/// a − b.
#[inline(always)]
pub fn difference<const D: usize>(a: [f64; D], b: [f64; D]) -> [f64; D] {
    std::array::from_fn(|k| a[k] - b[k])
}

/// |a|².
#[inline(always)]
pub fn square<const D: usize>(a: [f64; D]) -> f64 {
    a.iter().fold(0.0, |sum, x| sum + x * x)
}

/// The largest radius \[m\]; 0 without grains.
pub fn largest_radius<const D: usize>(grains: &[impl Grain<D>]) -> f64 {
    grains.iter().fold(0.0f64, |largest, grain| largest.max(grain.radius()))
}
