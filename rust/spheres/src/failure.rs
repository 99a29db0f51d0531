//! Reasons for which a run ends early.

use crate::boundary::SmallCell;
use msdd_engine::message::number;

/// A run counts as blown up when an overlap exceeds this times the mean of the two radii.
pub const LARGEST_OVERLAP: f64 = 1.0;
/// Largest distance that a sphere may move in one step, over its radius.
pub(crate) const LARGEST_STRIDE: f64 = 0.5;

/// Why a run ended early. `time` \[s\] is that of the check that found the failure.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum Failure {
    #[error("t = {} s: sphere {sphere} has a non-finite position or velocity", number(*time))]
    NonFinite { sphere: usize, time: f64 },
    #[error("t = {} s: spheres {i} and {j} overlap by {ratio:.3} of their mean radius, allowed: {LARGEST_OVERLAP}", number(*time))]
    Overlap { i: usize, j: usize, ratio: f64, time: f64 },
    #[error("t = {} s: sphere {sphere} moves {ratio:.3} of its radius in one step, allowed: {LARGEST_STRIDE}", number(*time))]
    Speed { sphere: usize, ratio: f64, time: f64 },
    #[error("t = {} s: time step {step:.3e} s exceeds the stability bound {bound:.3e} s", number(*time))]
    TimeStep { step: f64, bound: f64, time: f64 },
    #[error("t = {} s: {problem}", number(*time))]
    Cell { problem: SmallCell, time: f64 },
}
