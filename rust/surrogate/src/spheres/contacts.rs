//! The number of contacts per sphere along a path of strain.
//!
//! z = z̄ + ζ: a mean z̄ of all packings in a state of the law, and what a packing has more than that. A strain makes it forget ζ,
//! compression as well as shear: dζ = −ζ g⁸ (a |dv|/v + b |de|/v), with the deviator de of the strain and the part g of the friction
//! that is not mobilised. So boxes that were made with less friction, whose contacts are many for that reason, lose them when they are
//! strained; a bed whose friction is mobilised has more contacts than a box because grains without load rest on others, and keeps them.

use super::tensor::{Tensor, contraction, deviator};
use serde::{Deserialize, Serialize};

/// Number of coefficients of z̄.
pub const COEFFICIENTS: usize = 8;

#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Contacts {
    /// z̄: coefficients of [`row`].
    pub usual: [f64; COEFFICIENTS],
    /// a and b.
    pub fading: [f64; 2],
}

/// Compression below which packings that were opened have lost contacts.
const OPENED: f64 = 1.5e-4;
/// Bounds of z: none has more than equal spheres of the densest packings.
const CONTACTS: [f64; 2] = [0.0, 12.0];

/// 1, s, v, x, x², x s, o, o x, with s = √v, x = φ_J − 0.6 and o = 1/(1 + v/1.5e-4), of the elastic compression v and x.
pub fn row(compression: f64, x: f64) -> [f64; COEFFICIENTS] {
    let v = compression.max(0.0);
    let s = v.sqrt();
    let opened = 1.0 / (1.0 + v / OPENED);
    [1.0, s, v, x, x * x, x * s, opened, opened * x]
}

impl Contacts {
    /// z̄ of a state with this [`row`].
    pub fn usual(&self, row: &[f64; COEFFICIENTS]) -> f64 {
        let sum: f64 = row.iter().zip(&self.usual).map(|(a, b)| a * b).sum();
        sum.clamp(CONTACTS[0], CONTACTS[1])
    }

    /// −ln of what is left of ζ after a strain between two compressions above 0.
    pub fn forgotten(&self, before: f64, after: f64, strain: &Tensor) -> f64 {
        let [of_compression, of_shear] = self.fading;
        let distortion = deviator(*strain);
        let length = contraction(&distortion, &distortion).sqrt() / after;
        of_compression * libm::log(after / before).abs() + of_shear * length
    }

    /// Numbers for [`super::law::Law::check`]: name, value, whether it is allowed, and what is.
    pub fn numbers(&self) -> impl Iterator<Item = (&'static str, f64, bool, &'static str)> {
        let usual =
            self.usual.into_iter().map(|value| ("contacts.usual", value, value.abs() <= 1e6, "-1e6 to 1e6"));
        let fading = |value: f64| ("contacts.fading", value, (0.0..=100.0).contains(&value), "0 to 100");
        usual.chain(self.fading.into_iter().map(fading))
    }
}
