//! Vector kernels of the two hot loops: contact forces and motion.
//!
//! One generic source per loop is compiled for one lane (scalar), four (AVX2) and eight (AVX-512). Every lane does the
//! same IEEE operations in the same order, without fused multiply-add, and loads are added up disc by disc in row
//! order, so all paths give the same bits.
//!
//! The crate's only unsafe code: vector intrinsics, and discs addressed through the rows without bounds checks. What
//! makes that sound is stated at `Pairs`, whose indices are checked when the list is built, and at `SharedDiscs`.
#![allow(unsafe_code)]
#![allow(clippy::undocumented_unsafe_blocks)] // the reasons are stated once, where said above

mod motion;
mod pairs;
mod shared;
mod vector;
#[cfg(target_arch = "x86_64")]
mod x86;

pub(crate) use motion::{Motion, advance, larger};
pub(crate) use pairs::add_pairs;
pub(crate) use shared::SharedDiscs;
pub(crate) use vector::{Columns, Vector};

use serde::{Deserialize, Serialize};
use std::sync::atomic::{AtomicU8, Ordering};

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

/// Index in [`Simd::ALL`] of the set that was preferred; none yet: the widest.
static PREFERRED: AtomicU8 = AtomicU8::new(u8::MAX);

impl Simd {
    pub const ALL: [Self; 3] = [Self::Scalar, Self::Avx2, Self::Avx512];

    /// Chooses the set of all simulations of this process that are made from now on. A matter of speed alone, for all
    /// sets give the same bits; hence it need not pass through every function that makes a simulation.
    ///
    /// # Panics
    /// When the machine does not have it; ask [`Simd::available`].
    pub fn prefer(self) {
        assert!(self.available(), "{self:?} is not available on this machine");
        PREFERRED.store(self as u8, Ordering::Relaxed);
    }

    /// The set of a new simulation: the preferred one, or else [`Simd::best`].
    pub fn preferred() -> Self {
        Self::ALL.get(usize::from(PREFERRED.load(Ordering::Relaxed))).copied().unwrap_or_else(Self::best)
    }

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
