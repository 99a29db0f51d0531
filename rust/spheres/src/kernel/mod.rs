//! Vector kernels of the two hot loops: contact forces and motion.
//!
//! Every lane does the same IEEE operations in the same order, without fused multiply-add, and the loads of each sphere
//! are added up in row order. So all instruction sets give the same bits.
//!
//! This module has the only unsafe code of the crate: vector intrinsics, and access to spheres through the indices of
//! the pair list without bounds checks. Why that is sound is explained at `Pairs`, whose indices are checked when the
//! list is built.
#![allow(unsafe_code)]
#![allow(clippy::undocumented_unsafe_blocks)] // the reasons are stated once, where said above

mod lanes;
mod motion;
mod pairs;
#[cfg(target_arch = "x86_64")]
mod x86;

pub(crate) use motion::{Motion, advance};
pub(crate) use pairs::add_pairs;
