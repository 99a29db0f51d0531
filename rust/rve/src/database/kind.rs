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
    /// The packed state itself: stop 0 of every ramp that starts there.
    #[default]
    Packed,
    /// Radii grow.
    Up,
    /// Radii shrink.
    Down,
    /// Back from the last stop of `up`.
    UpDown,
    /// Back from the last stop of `down`.
    DownUp,
    /// x walls close (stops −1, −2, …), and from the packed state again, open (1, 2, …).
    Xx,
    /// As `xx`, with the y walls.
    Yy,
    /// A periodic box is sheared along x, one way (stops −1, −2, …) and, from the packed state again, the other.
    Xy,
    /// Bottom and top move along x.
    WallShear,
    /// Path: the box is strained along x or y, there, back and there again.
    Uniaxial,
    /// Path: it closes along one axis and opens along the other by the same strain, there, back and there again.
    Biaxial,
    /// Path: it is sheared, there, back and there again.
    Shear,
    /// Path: it closes or opens along both axes alike, there, back and there again.
    Isotropic,
    /// Path: radii grow or shrink, there, back and there again.
    Thermal,
    /// Path: the strains along x and y run on a circle.
    Circle,
    /// Path: strain without change of area, whose axes turn.
    Turning,
    /// Path: straight pieces in random directions of all strains.
    Mixed,
    /// Path: as `mixed`, but radii stay.
    Mechanical,
    /// Path: a layer of a bed through which a front of temperature passes, there, back and there again.
    Front,
    /// Single increments of the radii from the packed state, and of the box, which give the same packing up to its
    /// scale.
    Equivalence,
}

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

    /// The name in plans and rows.
    pub fn as_str(self) -> &'static str {
        match self {
            Self::Thermal => "thermal",
            Self::Mechanics => "mechanics",
            Self::WallShear => "wall_shear",
            Self::Paths => "paths",
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

    /// The name in plans and rows.
    pub fn as_str(self) -> &'static str {
        match self {
            Self::Packed => "packed",
            Self::Up => "up",
            Self::Down => "down",
            Self::UpDown => "up_down",
            Self::DownUp => "down_up",
            Self::Xx => "xx",
            Self::Yy => "yy",
            Self::Xy => "xy",
            Self::WallShear => "wall_shear",
            Self::Uniaxial => "uniaxial",
            Self::Biaxial => "biaxial",
            Self::Shear => "shear",
            Self::Isotropic => "isotropic",
            Self::Thermal => "thermal",
            Self::Circle => "circle",
            Self::Turning => "turning",
            Self::Mixed => "mixed",
            Self::Mechanical => "mechanical",
            Self::Front => "front",
            Self::Equivalence => "equivalence",
        }
    }
}
