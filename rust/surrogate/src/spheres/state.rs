//! The state of a cell, and what may be known of it at the start.

use super::number::Number;
use super::tensor::{Tensor, sum};

/// Number of elements, each of which bears a part of the deviator. The last is that of the fabric.
pub const ELEMENTS: usize = 4;
/// The element whose stress ratio is that of the directions of the contacts.
pub const FABRIC: usize = ELEMENTS - 1;
/// Solid fraction from which x is measured.
const USUAL_FRACTION: f64 = 0.6;
/// x of all packings of the training lies between these; others have the numbers of these.
const MOST_LOOSE: f64 = -0.045;
const MOST_DENSE: f64 = 0.045;
/// v below which grains count as touching by this much: its pressure is far below that of any bed.
pub const LEAST_COMPRESSION: f64 = 1e-7;
/// The mobilised part of the friction of beds that were poured, as `msdd bed run` counts it there: 0.84 between plates, 0.91 in a
/// cylinder.
pub const POURED: f64 = 0.85;

/// What determines the stress of a cell.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct State<N = f64> {
    /// φ_J: the solid fraction at which the packing would bear no load \[-\].
    pub jamming: N,
    /// v = φ/φ_J − 1; negative where the grains do not touch.
    pub compression: N,
    /// η_k: parts of the deviator of the stress over A.
    pub ratios: [Tensor<N>; ELEMENTS],
    /// Factor of the strengths, see [`super::law::Law::factor`], which does not change: 1 but for packings that bear more.
    pub strength: f64,
    /// Part of the friction that is mobilised, 0 to 1: as where all contacts were made under friction (1), or without any (0).
    pub mobilised: N,
    /// z: contacts per sphere, all spheres counted. By those that bear load the fabric turns.
    pub coordination: N,
}

/// What may be known of a packing beside its solid fraction and stress. What is not known is as it usually is.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Known {
    /// Contacts per sphere, all spheres counted.
    pub coordination: Option<f64>,
    /// Mean of n n over the contacts, with the normals n.
    pub fabric: Option<Tensor>,
    /// The mobilised part of the friction: [`POURED`] unless it is known.
    pub mobilised: Option<f64>,
}

impl<N: Number> State<N> {
    /// x, between those of the packings of the training.
    pub fn density(&self) -> N {
        self.jamming.plus(-USUAL_FRACTION).at_least(MOST_LOOSE).at_most(MOST_DENSE)
    }

    /// g: the part of the friction that is not mobilised.
    pub(super) fn free(&self) -> N {
        self.mobilised.times(-1.0).plus(1.0).at_least(0.0).at_most(1.0)
    }

    /// φ: volume of the grains over the volume \[-\].
    pub fn solid(&self) -> N {
        self.jamming + self.jamming * self.compression
    }

    /// Deviator of the stress over A.
    pub fn ratio(&self) -> Tensor<N> {
        let [first, second, third, fabric] = &self.ratios;
        sum(&sum(first, second), &sum(third, fabric))
    }

    /// The same state without the derivatives by the strain.
    pub fn value(&self) -> State {
        State {
            jamming: self.jamming.value(),
            compression: self.compression.value(),
            ratios: self.ratios.map(|ratio| ratio.map(Number::value)),
            mobilised: self.mobilised.value(),
            strength: self.strength,
            coordination: self.coordination.value(),
        }
    }
}

impl State {
    /// The same state, as numbers that do not depend on the strain.
    pub fn fixed<N: Number>(&self) -> State<N> {
        State {
            jamming: N::of(self.jamming),
            compression: N::of(self.compression),
            ratios: self.ratios.map(|ratio| ratio.map(N::of)),
            mobilised: N::of(self.mobilised),
            strength: self.strength,
            coordination: N::of(self.coordination),
        }
    }
}
