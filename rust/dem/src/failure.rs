//! Why a run ends before its time.

use crate::periodic::SmallCell;

/// Largest overlap over the mean of the two radii before a run counts as blown up: beyond, a small disc is swallowed and
/// the contact law means nothing. Packings of 6 % porosity come near it.
pub const LARGEST_OVERLAP: f64 = 1.0;
/// Largest way of a disc in one step over its radius.
pub(crate) const LARGEST_STRIDE: f64 = 0.5;

/// Why a run ended before its time. `time` [s] is that of the look that found it.
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
