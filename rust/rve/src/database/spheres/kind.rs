//! Names of how boxes of spheres are packed and strained.

use serde::{Deserialize, Serialize};

/// How a box closes.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum SphereCompression {
    /// Along all axes alike.
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
    /// The packed state itself.
    #[default]
    Packed,
    /// The box closes along all axes alike, or opens, and back and there again.
    Isotropic,
    /// Radii grow, or shrink, and back and there again.
    Thermal,
    /// The box closes along one axis, or opens, and back and there again.
    Uniaxial,
    /// It closes along one axis and opens along another by half of the strain, and back and there again; or the other way
    /// round.
    Biaxial,
    /// It closes along two axes, or opens, and gives way along the third so that the stress there stays, and back and there again.
    Pressed,
    /// It is sheared, there, beyond the start, and there again.
    Shear,
    /// Straight pieces in random directions of all strains.
    Mixed,
    /// Single increments from the packed state, each with another one that gives the same packing up to its scale or the names of its
    /// axes.
    Equivalence,
}

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

    /// The name in plans and rows.
    pub fn as_str(self) -> &'static str {
        match self {
            Self::Packed => "packed",
            Self::Isotropic => "isotropic",
            Self::Thermal => "thermal",
            Self::Uniaxial => "uniaxial",
            Self::Biaxial => "biaxial",
            Self::Pressed => "pressed",
            Self::Shear => "shear",
            Self::Mixed => "mixed",
            Self::Equivalence => "equivalence",
        }
    }
}
