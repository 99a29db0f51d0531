//! Reasons for which a run ends early.

use crate::periodic::SmallCell;

/// A run counts as blown up when an overlap exceeds this times the mean of the two radii: beyond, the smaller disc lies
/// inside the other one and the contact law has no meaning. Packings of 6 % porosity come near this value.
pub const LARGEST_OVERLAP: f64 = 1.0;
/// Largest distance that a disc may move in one step, over its radius.
pub(crate) const LARGEST_STRIDE: f64 = 0.5;

/// Why a run ended early. `time` \[s\] is that of the check that found the failure.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum Failure {
    #[error("t = {time} s: disc {disc} has a non-finite position or velocity")]
    NonFinite { disc: usize, time: f64 },
    #[error(
        "t = {time} s: discs {i} and {j} overlap by {ratio:.3} of their mean radius, allowed: {LARGEST_OVERLAP}"
    )]
    Overlap { i: usize, j: usize, ratio: f64, time: f64 },
    #[error(
        "t = {time} s: disc {disc} moves {ratio:.3} of its radius in one step, allowed: {LARGEST_STRIDE}"
    )]
    Speed { disc: usize, ratio: f64, time: f64 },
    #[error("t = {time} s: time step {step:.3e} s exceeds the stability bound {bound:.3e} s")]
    TimeStep { step: f64, bound: f64, time: f64 },
    #[error("t = {time} s: {problem}")]
    Cell { problem: SmallCell, time: f64 },
}
