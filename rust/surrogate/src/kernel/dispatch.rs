//! Runs work in the variant compiled for the widest instruction set of the machine.

use super::vector::{Portable, Vector};
#[cfg(target_arch = "x86_64")]
use super::x86;
use std::sync::atomic::{AtomicU8, Ordering};

/// Work on blocks of cells, written for any vector type.
pub trait Task {
    /// Does the work. This method and all functions that it calls with `V` must be `#[inline(always)]`: a function that
    /// is not inlined would not be compiled for the instruction set, unless it is a [`Part`](super::vector::Part).
    fn run<V: Vector>(self);
}

/// Instruction sets in the order of their width.
const SETS: [&str; 3] = ["scalar", "avx2", "avx512"];
static ALLOWED: AtomicU8 = AtomicU8::new(SETS.len() as u8 - 1);

/// Makes the kernels of this process use no wider set than this one ("scalar", "avx2", "avx512"), for measurements;
/// results are the same. Unknown names change nothing.
pub fn limit(set: &str) {
    if let Some(rank) = SETS.iter().position(|known| *known == set) {
        ALLOWED.store(rank as u8, Ordering::Relaxed);
    }
}

#[cfg(target_arch = "x86_64")]
#[inline]
fn has_avx512() -> bool {
    is_x86_feature_detected!("avx512f")
        && is_x86_feature_detected!("avx512dq")
        && is_x86_feature_detected!("fma")
        && ALLOWED.load(Ordering::Relaxed) >= 2
}

#[cfg(target_arch = "x86_64")]
#[inline]
fn has_avx2() -> bool {
    is_x86_feature_detected!("avx2")
        && is_x86_feature_detected!("fma")
        && ALLOWED.load(Ordering::Relaxed) >= 1
}

/// Instruction set that the kernels use on this machine: "avx512", "avx2" or "scalar".
pub fn simd() -> &'static str {
    #[cfg(target_arch = "x86_64")]
    {
        if has_avx512() {
            return "avx512";
        }
        if has_avx2() {
            return "avx2";
        }
    }
    "scalar"
}

macro_rules! dispatcher {
    ($(#[$about:meta])* $name:ident: $avx512:ident, $avx2:ident, $portable:ty) => {
        $(#[$about])*
        #[inline]
        pub fn $name<T: Task>(task: T) {
            #[cfg(target_arch = "x86_64")]
            {
                #[target_feature(enable = "avx512f,avx512dq,fma")]
                unsafe fn avx512<T: Task>(task: T) {
                    task.run::<x86::$avx512>();
                }
                #[target_feature(enable = "avx2,fma")]
                unsafe fn avx2<T: Task>(task: T) {
                    task.run::<x86::$avx2>();
                }
                if has_avx512() {
                    // SAFETY: the processor has the instructions; the function has no other requirement.
                    return unsafe { avx512(task) };
                }
                if has_avx2() {
                    // SAFETY: the processor has the instructions; the function has no other requirement.
                    return unsafe { avx2(task) };
                }
            }
            task.run::<$portable>();
        }
    };
}

dispatcher! {
    /// Does the work with the widest vectors of the machine, in blocks of [`LANES`](super::LANES). All of them give the same bits.
    dispatch: Avx512, Avx2, Portable
}
dispatcher! {
    /// As [`dispatch`], in blocks of as many cells as one register has: for work with more numbers than registers.
    dispatch_narrow: OneAvx512, OneAvx2, f64
}

/// As [`dispatch`], with each set of the machine in turn: for tests that compare bits.
#[cfg(test)]
pub fn with_every_set(mut task: impl FnMut(&str)) {
    let widest = ALLOWED.load(Ordering::Relaxed);
    for (rank, set) in SETS.iter().enumerate() {
        if rank <= usize::from(widest) {
            ALLOWED.store(rank as u8, Ordering::Relaxed);
            task(set);
        }
    }
    ALLOWED.store(widest, Ordering::Relaxed);
}
