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
    DisplacementX,
    DisplacementY,
}

impl Quantity {
    pub const ALL: [Self; 6] = [
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
            Self::DisplacementX => ("D", 0),
            Self::DisplacementY => ("D", 1),
        }
    }

    /// Name in tables, that of the fields in the tables of the reference scenes.
    pub fn name(self) -> &'static str {
        match self {
            Self::Temperature => "T",
            Self::Pressure => "pressure",
            Self::ConductivityXx => "conductivity_xx",
            Self::ConductivityYy => "conductivity_yy",
            Self::DisplacementX => "displacement_x",
            Self::DisplacementY => "displacement_y",
        }
    }

    pub fn unit(self) -> &'static str {
        match self {
            Self::Temperature => "K",
            Self::Pressure => "Pa",
            Self::ConductivityXx | Self::ConductivityYy => "W/(m K)",
            Self::DisplacementX | Self::DisplacementY => "m",
        }
    }

    /// Whether it is zero everywhere if the grains stay.
    pub fn needs_motion(self) -> bool {
        matches!(self, Self::DisplacementX | Self::DisplacementY)
    }
}
