//! One combination of choices.

use serde::{Deserialize, Serialize};

/// How often a direction of the mesh is halved.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Level {
    /// The user's cells, halved so many times; doubled if the number is negative.
    Halved(i32),
    /// A single cell: nothing changes along this direction.
    One,
}

/// Fewest cells along a direction, unless nothing changes along it.
pub const FEWEST: usize = 4;

impl Level {
    /// Cells along a direction in which the user's mesh has `cells`.
    pub fn cells(self, cells: usize) -> usize {
        match self {
            Self::One => 1,
            Self::Halved(times) if times < 0 => cells << times.unsigned_abs(),
            Self::Halved(times) => cells.div_ceil(1 << times.min(30)).max(FEWEST.min(cells)),
        }
    }

    /// The next finer level.
    pub fn finer(self) -> Self {
        match self {
            Self::Halved(times) => Self::Halved(times - 1),
            Self::One => Self::One,
        }
    }

    /// The next coarser level, if there is one.
    pub fn coarser(self, cells: usize) -> Option<Self> {
        match self {
            Self::Halved(times) if Self::Halved(times + 1).cells(cells) < self.cells(cells) => {
                Some(Self::Halved(times + 1))
            }
            _ => None,
        }
    }
}

/// What a run takes.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Settings {
    /// One level for each direction that can be chosen by itself.
    pub levels: Vec<Level>,
    /// Error of T that an adaptive step may make, as a share of the range of T.
    pub tolerance: f64,
    /// Whether grains move (`mechanics equilibrium`).
    pub moves: bool,
    /// Factor of the conductivity: 1, but for the run that shows what another conductivity would change.
    #[serde(default = "one", skip_serializing_if = "is_one")]
    pub conductivity: f64,
    /// Constant conductivity of the bed along x and y [W/(m K)] instead of the model.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub constant: Option<[f64; 2]>,
    /// Directions of which the half up to the middle is run, with half the cells; the others are run whole.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub halved: Vec<bool>,
}

impl Settings {
    /// A run with the model.
    pub fn new(levels: Vec<Level>, tolerance: f64, moves: bool) -> Self {
        Self { levels, tolerance, moves, conductivity: 1.0, constant: None, halved: Vec::new() }
    }

    /// Whether the half of a direction is run.
    pub fn halves(&self, direction: usize) -> bool {
        self.halved.get(direction).is_some_and(|&halved| halved)
    }

    /// Cells of the user's mesh along a direction, in the part of the box that is run.
    pub fn own_cells(&self, direction: usize, cells: usize) -> usize {
        if self.halves(direction) { cells / 2 } else { cells }
    }
}

fn one() -> f64 {
    1.0
}

fn is_one(factor: &f64) -> bool {
    *factor == 1.0
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn levels_halve_down_to_the_fewest_cells() {
        let counts: Vec<usize> = (0..6).map(|times| Level::Halved(times).cells(30)).collect();
        assert_eq!(counts, [30, 15, 8, 4, 4, 4]);
        assert_eq!(Level::Halved(2).coarser(30), Some(Level::Halved(3)));
        assert_eq!(Level::Halved(3).coarser(30), None);
        assert_eq!((Level::Halved(-2).cells(30), Level::Halved(-1).finer()), (120, Level::Halved(-2)));
        assert_eq!((Level::One.cells(30), Level::One.coarser(30)), (1, None));
        assert_eq!((Level::Halved(0).cells(2), Level::Halved(0).coarser(2)), (2, None));
    }
}
