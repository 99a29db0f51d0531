//! Vectors of the instruction sets, and one array of grains for several threads.
//!
//! A hot loop is written once, generic over the number of lanes, and compiled for one lane (scalar), four (AVX2) and
//! eight (AVX-512). Every lane does the same IEEE operations in the same order, without fused multiply-add, so all
//! instruction sets give the same bits.
//!
//! This module has the only unsafe code of the crate.
#![allow(unsafe_code)]
#![allow(clippy::undocumented_unsafe_blocks)] // the reasons are stated once, at `Lanes` and at `SharedGrains`

mod fetch;
mod lanes;
mod shared;
mod simd;
#[cfg(target_arch = "x86_64")]
mod x86;

pub use fetch::{Cache, fetch};
pub use lanes::Lanes;
pub use shared::SharedGrains;
pub use simd::Simd;
#[cfg(target_arch = "x86_64")]
pub use x86::{Avx2, Avx512, transpose4, transpose8};
