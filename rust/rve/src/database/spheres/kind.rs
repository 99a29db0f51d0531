//! Names of how boxes of spheres are packed and strained.

use serde::{Deserialize, Serialize};

/// How a box closes.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum SphereCompression {
    /// Along all axes equally.
    #[default]
    Isotropic,
    /// Along z only.
    Uniaxial,
    /// Along z, while it opens along x and y, each a quarter as fast.
    Sheared,
}

impl SphereCompression {
    /// Rates along x, y and z in their ratio.
    pub fn rates(self) -> [f64; 3] {
        match self {
            Self::Isotropic => [1.0; 3],
            Self::Uniaxial => [0.0, 0.0, 1.0],
            Self::Sheared => [-0.25, -0.25, 1.0],
        }
    }
}

/// A path: a way through states of one packing.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum PathName {
    /// The packed state itself, the first row of every packing; it is not named in a plan.
    #[default]
    Packed,
    /// The box closes along all axes by `strain`, opens again to a fifth of it, closes to seven tenths.
    Isotropic,
    /// Radii grow by `strain`, shrink to what they were, grow to six tenths: what heat does to a bed between fixed walls.
    Thermal,
    /// As `isotropic`, along one axis.
    Uniaxial,
    /// As `isotropic`: it closes along one axis and opens along another by half as much.
    Biaxial,
    /// The box closes along two axes by `strain`, opens again, closes to six tenths, and moves along the third so that the
    /// stress there stays as it was packed, within some per cent: what heat does to a bed under a lid. How far it moves is
    /// found on the way, and is in the rows.
    Pressed,
    /// It is sheared by twice `strain`, back beyond the start by six tenths, there again to eight tenths. The volume stays:
    /// loose boxes under little pressure lose their load.
    Shear,
    /// Eight straight pieces in random directions of all seven strains (the strain of the radii half as large); only directions
    /// after which the box is still compressed.
    Mixed,
    /// Single increments from the packed state, each with a twin: radii by 1 + ε, and the box by 1/(1 + ε) along all axes; then
    /// along x by −ε, and the same in a box whose axes have other names. ε is −0.3, 0.3, 1 and 3 times (p/E*)^(2/3), 0.01 at
    /// most.
    Equivalence,
}

msdd_beds::named!(PathName);

impl PathName {
    /// The paths that a plan may name.
    pub const ALL: [Self; 8] = [
        Self::Isotropic,
        Self::Thermal,
        Self::Uniaxial,
        Self::Biaxial,
        Self::Pressed,
        Self::Shear,
        Self::Mixed,
        Self::Equivalence,
    ];
}
