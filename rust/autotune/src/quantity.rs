//! What runs are compared in, and what gets error bands.

use serde::{Deserialize, Serialize};

/// A number at a point of the bed.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Quantity {
    Temperature,
    Pressure,
    ConductivityXx,
    ConductivityYy,
    ConductivityZz,
    DisplacementX,
    DisplacementY,
    DisplacementZ,
}

impl Quantity {
    pub const ALL: [Self; 8] = [
        Self::Temperature,
        Self::Pressure,
        Self::ConductivityXx,
        Self::ConductivityYy,
        Self::ConductivityZz,
        Self::DisplacementX,
        Self::DisplacementY,
        Self::DisplacementZ,
    ];
    /// Those of discs in the plane.
    pub const PLANE: [Self; 6] = [
        Self::Temperature,
        Self::Pressure,
        Self::ConductivityXx,
        Self::ConductivityYy,
        Self::DisplacementX,
        Self::DisplacementY,
    ];

    /// Field of the solver, and which of its components.
    pub fn field(self) -> (&'static str, usize) {
        match self {
            Self::Temperature => ("T", 0),
            Self::Pressure => ("pressure", 0),
            Self::ConductivityXx => ("conductivity", 0),
            Self::ConductivityYy => ("conductivity", 3),
            Self::ConductivityZz => ("conductivity", 5),
            Self::DisplacementX => ("D", 0),
            Self::DisplacementY => ("D", 1),
            Self::DisplacementZ => ("D", 2),
        }
    }

    /// Name in tables, that of the fields in the tables of the reference scenes.
    pub fn name(self) -> &'static str {
        match self {
            Self::Temperature => "T",
            Self::Pressure => "pressure",
            Self::ConductivityXx => "conductivity_xx",
            Self::ConductivityYy => "conductivity_yy",
            Self::ConductivityZz => "conductivity_zz",
            Self::DisplacementX => "displacement_x",
            Self::DisplacementY => "displacement_y",
            Self::DisplacementZ => "displacement_z",
        }
    }

    pub fn unit(self) -> &'static str {
        match self {
            Self::Temperature => "K",
            Self::Pressure => "Pa",
            Self::ConductivityXx | Self::ConductivityYy | Self::ConductivityZz => "W/(m K)",
            Self::DisplacementX | Self::DisplacementY | Self::DisplacementZ => "m",
        }
    }

    /// Whether it is zero everywhere if the grains stay.
    pub fn needs_motion(self) -> bool {
        matches!(self, Self::DisplacementX | Self::DisplacementY | Self::DisplacementZ)
    }

    /// Whether it points out of the plane. In a mesh that does not extend along z it is not compared: it is zero, or, in a wedge,
    /// OpenFOAM's interpolation to points does not have it.
    pub fn leaves_plane(self) -> bool {
        matches!(self, Self::ConductivityZz | Self::DisplacementZ)
    }
}
