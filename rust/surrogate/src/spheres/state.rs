//! The state of a cell, and what may be known of it at the start.

use super::components::six;
use super::number::Number;
use super::tensor::{Tensor, sum};
use crate::kernel::vector::Arithmetic;

/// Number of elements, each of which carries a part of the deviator. The last is that of the fabric.
pub const ELEMENTS: usize = 4;
/// The element whose stress ratio is that of the directions of the contacts.
pub const FABRIC: usize = ELEMENTS - 1;
/// Solid fraction from which x is measured.
const REFERENCE_FRACTION: f64 = 0.6;
/// x of all packings of the training lies between these; others have the numbers of these.
const MAX_LOOSE: f64 = -0.045;
const MAX_DENSE: f64 = 0.045;
/// v below which grains count as touching by this much: its pressure is far below that of any bed.
pub const MIN_COMPRESSION: f64 = 1e-7;
/// The mobilised part of the friction of beds that were poured, as `msdd bed run` counts it there: 0.84 between plates, 0.91 in a
/// cylinder.
pub const POURED: f64 = 0.85;

/// What determines the stress of a cell.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct State<N: Number = f64> {
    /// φ_J: the solid fraction at which the packing would carry no load \[-\].
    pub jamming: N,
    /// v = φ/φ_J − 1; negative where the grains do not touch.
    pub compression: N,
    /// η_k: parts of the deviator of the stress over A.
    pub ratios: [Tensor<N>; ELEMENTS],
    /// Factor of the strengths, see `super::law::Law::factor`, which does not change: 1 but for packings that carry more.
    pub strength: N::Values,
    /// Part of the friction that is mobilised, 0 to 1: as where all contacts were made under friction (1), or without any (0).
    pub mobilised: N,
    /// z: contacts per sphere, all spheres counted. By those that carry load the fabric turns.
    pub coordination: N,
}

/// What may be known of a packing apart from its solid fraction and stress. What is not known is as it usually is.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct PackingData {
    /// Contacts per sphere, all spheres counted.
    pub coordination: Option<f64>,
    /// Mean of n n over the contacts, with the normals n.
    pub fabric: Option<Tensor>,
    /// The mobilised part of the friction: [`POURED`] unless it is known.
    pub mobilised: Option<f64>,
}

/// An array of all elements.
macro_rules! four {
    ($k:ident => $of:expr) => {
        six!([0 1 2 3] $k => $of)
    };
}

impl<N: Number> State<N> {
    /// x, between those of the packings of the training.
    #[inline(always)]
    pub fn density(&self) -> N {
        self.jamming.plus(-REFERENCE_FRACTION).not_below(MAX_LOOSE).not_above(MAX_DENSE)
    }

    /// g: the part of the friction that is not mobilised.
    #[inline(always)]
    pub(super) fn unmobilised(&self) -> N {
        self.mobilised.times(-1.0).plus(1.0).not_below(0.0).not_above(1.0)
    }

    /// φ: volume of the grains over the volume \[-\].
    #[inline(always)]
    pub fn solid(&self) -> N {
        self.jamming + self.jamming * self.compression
    }

    /// Deviator of the stress over A.
    #[inline(always)]
    pub fn ratio(&self) -> Tensor<N> {
        let [first, second, third, fabric] = &self.ratios;
        sum(&sum(first, second), &sum(third, fabric))
    }

    /// A state whose numbers do not depend on the strain.
    #[inline(always)]
    pub fn fixed<V: Arithmetic + Number<Values = V>>(state: &State<V>) -> Self
    where
        N: Number<Values = V>,
    {
        State {
            jamming: N::of(state.jamming),
            compression: N::of(state.compression),
            ratios: four!(k => six!(c => N::of(state.ratios[k][c]))),
            strength: state.strength,
            mobilised: N::of(state.mobilised),
            coordination: N::of(state.coordination),
        }
    }

    /// The same state without the derivatives by the strain.
    #[inline(always)]
    pub fn values<V: Arithmetic + Number<Values = V>>(&self) -> State<V>
    where
        N: Number<Values = V>,
    {
        State {
            jamming: self.jamming.value(),
            compression: self.compression.value(),
            ratios: four!(k => six!(c => self.ratios[k][c].value())),
            strength: self.strength,
            mobilised: self.mobilised.value(),
            coordination: self.coordination.value(),
        }
    }

    /// `this` where `a` > `b`, `other` elsewhere.
    #[inline(always)]
    pub(super) fn where_greater([a, b]: [N::Values; 2], this: &Self, other: &Self) -> Self {
        let (a, b) = (N::of(a), N::of(b));
        State {
            jamming: a.where_above(b, this.jamming, other.jamming),
            compression: a.where_above(b, this.compression, other.compression),
            ratios: four!(k => six!(c => a.where_above(b, this.ratios[k][c], other.ratios[k][c]))),
            strength: this.strength,
            mobilised: a.where_above(b, this.mobilised, other.mobilised),
            coordination: a.where_above(b, this.coordination, other.coordination),
        }
    }
}
