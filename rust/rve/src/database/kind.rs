//! Names of what is done to packings: kinds of blocks, and ramps and paths through states.

use serde::{Deserialize, Serialize};

/// What is moved in the ramps of a block: radii, walls, or walls along the grains; or all of a periodic box, on paths.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Kind {
    #[default]
    Thermal,
    Mechanics,
    WallShear,
    Paths,
}

/// A ramp or a path: a way through states of one packing.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum RampName {
    /// The packed state itself, the first row of every packing; it is not named in a plan.
    #[default]
    Packed,
    /// Of `thermal`: radii grow.
    Up,
    /// Of `thermal`: radii shrink.
    Down,
    /// Of `thermal`: back from the last stop of `up`, which has to stand before it; only if named.
    UpDown,
    /// Of `thermal`: back from the last stop of `down`, which has to stand before it; only if named.
    DownUp,
    /// Of `mechanics`: the box closes along x (stops −1, −2, …) and, from the packed state again, opens (1, 2, …).
    Xx,
    /// Of `mechanics`: the same along y.
    Yy,
    /// Of `mechanics`: a periodic box is sheared one way (stops −1, −2, …) and, from the packed state again, the other; only if
    /// named.
    Xy,
    /// Of `wall_shear`: bottom and top move along x.
    WallShear,
    /// Path: the box is strained along x or y: 25 increments one way, 25 back, 15 one way again.
    Uniaxial,
    /// Path: it is strained along x and by the opposite along y: 15, 25 back, 15.
    Biaxial,
    /// Path: it is sheared by twice the increment: 15, 25 back, 15.
    Shear,
    /// Path: it is strained along x and y by the same: 12, 18 back, 10.
    Isotropic,
    /// Path: radii grow or shrink: 20, 35 back, 15.
    Thermal,
    /// Path: the strains along x and y run on a circle through the packed state, of a radius of five increments: three turns of
    /// 20 chords.
    Circle,
    /// Path: strain without change of area, whose axes turn: 60 increments ε_xx = −ε_yy = h cos t, γ_xy = 2h sin t, t from 0 to
    /// 3π.
    Turning,
    /// Path: eight straight pieces of 4 to 12 increments, each in a random direction of the strain of the radii (half as large)
    /// and of the three strains of the box; the largest part is the increment.
    Mixed,
    /// Path: as `mixed`, but radii stay.
    Mechanical,
    /// Path: a layer of a bed that a front of temperature passes: radii grow or shrink by the increment, 24, 16 back, 8. The
    /// box keeps its size along one axis; along the other it is strained by 0 to 2 times the strain of the radii, in each piece
    /// by another share.
    Front,
    /// Path: radii by ±0.5, 1 and 2 %, each in one increment from the packed state, and after each its twin, in which the box
    /// is strained by 1/(1 + ε) − 1 along x and y, also from the packed state. Both give the same packing up to its scale.
    Equivalence,
}

msdd_beds::named!(Kind RampName);

impl Kind {
    /// The ramps of a block that names none; and the further ramps that a block of this kind may name.
    pub(super) fn ramps(self) -> (&'static [RampName], &'static [RampName]) {
        match self {
            Self::Thermal => (&[RampName::Up, RampName::Down], &[RampName::UpDown, RampName::DownUp]),
            Self::Mechanics => (&[RampName::Xx, RampName::Yy], &[RampName::Xy]),
            Self::WallShear => (&[RampName::WallShear], &[]),
            Self::Paths => (&[], &RampName::PATHS),
        }
    }
}

impl RampName {
    /// The paths of `[[paths]]`.
    pub const PATHS: [Self; 11] = [
        Self::Uniaxial,
        Self::Biaxial,
        Self::Shear,
        Self::Isotropic,
        Self::Thermal,
        Self::Circle,
        Self::Turning,
        Self::Mixed,
        Self::Mechanical,
        Self::Front,
        Self::Equivalence,
    ];

    /// Whether it is a path of `[[paths]]`, each of whose rows has the increment that leads to it.
    pub fn is_path(self) -> bool {
        Self::PATHS.contains(&self)
    }

    /// The ramp from whose last stop this one starts; none when it starts from the packed state.
    pub fn starts_from(self) -> Option<Self> {
        match self {
            Self::UpDown => Some(Self::Up),
            Self::DownUp => Some(Self::Down),
            _ => None,
        }
    }
}
