//! Instruction sets of the kernels.

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

/// Index in [`Simd::ALL`] of the preferred set. The initial value is no such index and means the widest set of the
/// machine.
static PREFERRED: AtomicU8 = AtomicU8::new(u8::MAX);

impl Simd {
    pub const ALL: [Self; 3] = [Self::Scalar, Self::Avx2, Self::Avx512];

    /// Sets the instruction set of all simulations that this process makes from now on. All sets give the same bits, so
    /// the choice affects speed only; that is why it is a global setting and not an argument of every function that
    /// makes a simulation.
    ///
    /// # Panics
    /// When the machine does not have the set; see [`Simd::available`].
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
