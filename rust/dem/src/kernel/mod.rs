//! Vector kernels of the two hot loops: contact forces and motion.
//!
//! One generic source per loop is compiled for one lane (scalar), four (AVX2) and eight (AVX-512). Every lane does the
//! same IEEE operations in the same order, without fused multiply-add, and loads are added up disc by disc in row
//! order, so all paths give the same bits.
//!
//! The crate's only unsafe code: vector intrinsics, and discs addressed through the rows without bounds checks. What
//! makes that sound is stated at `Pairs`, whose indices are checked when the list is built, and at `SharedDiscs`.
#![allow(unsafe_code)]

mod motion;
mod pairs;
mod shared;
mod vector;
#[cfg(target_arch = "x86_64")]
mod x86;

pub(crate) use motion::{Motion, advance};
pub(crate) use pairs::add_pairs;
pub(crate) use shared::SharedDiscs;
pub(crate) use vector::{Columns, Vector};

use serde::{Deserialize, Serialize};

/// Instruction set of the kernels.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Simd {
    /// One lane, any machine.
    Scalar,
    /// Four lanes.
    Avx2,
    /// Eight lanes.
    Avx512,
}

impl Simd {
    /// The widest set that this machine has.
    pub fn best() -> Self {
        [Self::Avx512, Self::Avx2].into_iter().find(|set| set.available()).unwrap_or(Self::Scalar)
    }

    /// Whether this machine has the set.
    pub fn available(self) -> bool {
        match self {
            Self::Scalar => true,
            #[cfg(target_arch = "x86_64")]
            Self::Avx2 => is_x86_feature_detected!("avx2"),
            #[cfg(target_arch = "x86_64")]
            Self::Avx512 => is_x86_feature_detected!("avx512f") && is_x86_feature_detected!("avx512dq"),
            #[cfg(not(target_arch = "x86_64"))]
            _ => false,
        }
    }
}
