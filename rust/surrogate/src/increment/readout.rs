//! What is computed from the elastic state: conductivity, overlaps of the grains, fabric.

use super::law::Stress;
use crate::SurrogateError;
use crate::dataset::ConductivityKind;
use crate::document::field;
use crate::kernel::vector::{Arithmetic, Portable};
use serde::{Deserialize, Serialize};

/// Overlaps and fabric. s = √p̃, r² = (q̃/p̃)², z as in [`super::law`], porosity x above `REFERENCE_POROSITY`.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Readout {
    /// Overlaps of the grains over the area, o/p̃: coefficients of 1, s, p̃, s z, s r².
    pub overlap: [f64; 5],
    /// Direction of the contacts, (F_xx − F_yy, 2 F_xy), as far as it follows the stress, over q̃/p̃: coefficients of 1, x, s, z.
    pub fabric: [f64; 4],
}

/// Conductivity of one kind, with s, r², z, x as in [`Readout`].
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Conductivity {
    pub kind: ConductivityKind,
    /// Mean conductivity over that of the grains, K/(k s): coefficients of 1, s, p̃, r², s r², x, x s, x p̃, x r², x², s x².
    pub mean: [f64; 11],
    /// (K_xx − K_yy, 2 K_xy)/(K_xx + K_yy): coefficients of q̃/p̃, of x q̃/p̃ and of the fabric.
    pub direction: [f64; 3],
}

/// Added to p̃ in q̃/p̃, so that the ratio tends to zero where the grains lose contact: a hundredth of p̃ of the loosest
/// packings.
pub const PRESSURE_FLOOR: f64 = 1e-4;
/// K/k of a state without stress: far below that of any packing (at least 0.05), but positive, as the heat equation needs.
pub const CONDUCTIVITY_FLOOR: f64 = 1e-4;
/// Least K/(k s): a fifth of that of the loosest packings.
const MIN_CONDUCTIVITY: f64 = 0.1;
/// Largest length of (K_xx − K_yy, 2 K_xy)/(K_xx + K_yy), so that the conductivity is positive in every direction.
const LARGEST_ANISOTROPY: f64 = 0.9;

/// Functions of a state that the readouts use.
#[derive(Clone, Copy)]
pub struct Features<V> {
    /// p̃ and √p̃.
    pub pressure: V,
    pub root: V,
    /// z.
    pub loose: V,
    /// q̃/p̃, both components, and the square of its length.
    pub ratio: [V; 2],
    pub square: V,
}

impl Features<Portable> {
    /// Those of the first cell.
    pub fn first(self) -> Features<f64> {
        let Self { pressure, root, loose, ratio, square } = self;
        let number = Portable::into_first;
        Features {
            pressure: number(pressure),
            root: number(root),
            loose: number(loose),
            ratio: ratio.map(number),
            square: number(square),
        }
    }
}

impl Features<f64> {
    /// The same in all cells.
    pub fn everywhere(&self) -> Features<Portable> {
        let all = Portable::all;
        Features {
            pressure: all(self.pressure),
            root: all(self.root),
            loose: all(self.loose),
            ratio: self.ratio.map(all),
            square: all(self.square),
        }
    }
}

impl<V: Arithmetic> Features<V> {
    #[inline(always)]
    pub fn of(stress: &Stress<V>, loose: V) -> Self {
        let [p, q1, q2] = *stress;
        let over = V::all(1.0) / (p + V::all(PRESSURE_FLOOR));
        let ratio = [q1 * over, q2 * over];
        let square = ratio[0].fused(ratio[0], ratio[1] * ratio[1]);
        Self { pressure: p, root: p.sqrt(), loose, ratio, square }
    }
}

/// Terms of K/(k s), see [`Conductivity::mean`].
#[inline(always)]
pub fn conductivity_row<V: Arithmetic>(features: &Features<V>, porosity: V) -> [V; 11] {
    let Features { pressure: p, root: s, square: r, .. } = *features;
    let x = porosity - V::all(REFERENCE_POROSITY);
    [V::all(1.0), s, p, r, s * r, x, x * s, x * p, x * r, x * x, s * (x * x)]
}

/// Porosity from which that of the packings is measured [-].
const REFERENCE_POROSITY: f64 = 0.12;

/// Terms of the fabric, see [`Readout::fabric`], for each component.
#[inline(always)]
pub fn fabric_rows<V: Arithmetic>(features: &Features<V>, porosity: V) -> [[V; 4]; 2] {
    let Features { root, loose, ratio: [along, across], .. } = *features;
    let x = porosity - V::all(REFERENCE_POROSITY);
    [[along, along * x, along * root, along * loose], [across, across * x, across * root, across * loose]]
}

/// Terms of the direction of the conductivity, see [`Conductivity::direction`], for each component.
#[inline(always)]
pub fn direction_rows<V: Arithmetic>(features: &Features<V>, porosity: V, fabric: [V; 2]) -> [[V; 3]; 2] {
    let [along, across] = features.ratio;
    let x = porosity - V::all(REFERENCE_POROSITY);
    [[along, along * x, fabric[0]], [across, across * x, fabric[1]]]
}

/// Sum of terms times coefficients.
#[inline(always)]
fn sum<V: Arithmetic, const N: usize>(terms: [V; N], coefficients: [f64; N]) -> V {
    let mut sum = V::zero();
    for k in 0..N {
        sum = terms[k].fused(V::all(coefficients[k]), sum);
    }
    sum
}

impl Readout {
    /// o [-]: the part of the plane that overlaps cover.
    #[inline(always)]
    pub fn overlap<V: Arithmetic>(&self, x: &Features<V>) -> V {
        let [one, s, p, sz, sr] = self.overlap;
        let (one, s, p, sz, sr) = (V::all(one), V::all(s), V::all(p), V::all(sz), V::all(sr));
        let of_root = sr.fused(x.square, sz.fused(x.loose, s));
        x.pressure * of_root.fused(x.root, p.fused(x.pressure, one))
    }

    /// The part of the fabric that follows the stress.
    #[inline(always)]
    pub fn fabric<V: Arithmetic>(&self, x: &Features<V>, porosity: V) -> [V; 2] {
        let [along, across] = fabric_rows(x, porosity);
        [sum(along, self.fabric), sum(across, self.fabric)]
    }

    /// # Errors
    /// [`SurrogateError::Field`] for numbers that are not finite or absurdly large.
    pub fn check(&self) -> Result<(), SurrogateError> {
        check("readout.overlap", &self.overlap)?;
        check("readout.fabric", &self.fabric)
    }
}

impl Conductivity {
    /// K_xx/k, K_yy/k, K_xy/k at a porosity and a fabric (F_xx − F_yy, 2 F_xy).
    /// `own`: mean conductivity of the packing over that of packings in the same state, less 1; and what is added to the
    /// direction (K_xx − K_yy, 2 K_xy)/(K_xx + K_yy). They stay as they are when the packing is strained.
    #[inline(always)]
    pub fn at<V: Arithmetic>(
        &self,
        x: &Features<V>,
        porosity: V,
        fabric: [V; 2],
        (own, direction): (V, [V; 2]),
    ) -> [V; 3] {
        let share = sum(conductivity_row(x, porosity), self.mean).at_least(V::all(MIN_CONDUCTIVITY));
        let mean = (x.root * share).fused(V::all(1.0) + own, V::all(CONDUCTIVITY_FLOOR));
        let rows = direction_rows(x, porosity, fabric);
        let along = sum(rows[0], self.direction) + direction[0];
        let across = sum(rows[1], self.direction) + direction[1];
        let length = along.fused(along, across * across).sqrt();
        let most = V::all(LARGEST_ANISOTROPY);
        let kept = length.where_greater(most, most / length.at_least(most), V::all(1.0));
        let (along, across) = (along * kept, across * kept);
        let unit = V::all(1.0);
        [mean * (unit + along), mean * (unit - along), mean * across]
    }

    /// # Errors
    /// As [`Readout::check`].
    pub fn check(&self) -> Result<(), SurrogateError> {
        check("conductivities.mean", &self.mean)?;
        check("conductivities.direction", &self.direction)
    }
}

fn check(key: &str, coefficients: &[f64]) -> Result<(), SurrogateError> {
    match coefficients.iter().find(|value| value.is_nan() || value.abs() > 1e6) {
        Some(value) => field(key, value, "-1e6 to 1e6"),
        None => Ok(()),
    }
}
