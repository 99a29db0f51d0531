//! The models' arithmetic in blocks of cells, compiled once per instruction set.
//!
//! Every operation acts on each lane separately and in one fixed order, and multiplications are fused with additions
//! exactly where the source says so. So all instruction sets give the same bits, and a cell's answer does not depend on
//! the other cells of its block. On a processor without fused multiply-add (x86-64 before 2013) the mathematical
//! library does it, slowly. No operation raises the floating-point exceptions invalid, divide-by-zero or overflow for
//! finite inputs and weights up to [`WEIGHT_LIMIT`](crate::network::WEIGHT_LIMIT).
#![allow(unsafe_code)] // calls of functions compiled for an instruction set

mod dispatch;
pub mod elementary;
mod layers;
mod products;
pub mod vector;
#[cfg(target_arch = "x86_64")]
mod x86;

#[cfg(test)]
pub(crate) use dispatch::with_every_set;
pub use dispatch::{Task, dispatch, dispatch_narrow, limit, simd};
pub use layers::layer;
pub use products::add_outer_products;
pub use vector::{LANES, Lanes};
