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

mod lanes;
mod motion;
mod pairs;
mod shared;
mod simd;
#[cfg(target_arch = "x86_64")]
mod x86;

pub(crate) use motion::{Motion, advance};
pub(crate) use pairs::add_pairs;
pub(crate) use shared::SharedDiscs;
pub use simd::Simd;
