//! C ABI of MSDD. The header `include/msdd.h` is written by hand, bindgen makes the crate `msdd-abi` from it, and this
//! crate implements its functions.
//!
//! | module | what |
//! |---|---|
//! | [`exports`] | the header's functions: pointers checked, then safe code |
//! | `handles` | the types behind the opaque handles |
//! | `model` | what the exports need of a model, our own or a plug-in |
//! | `load` | which model a caller names |
//! | `discs`, `spheres`, `foreign` | the models of discs, the model of spheres, plug-ins |
//! | `columns` | columns of the caller: one value per cell, at a stride |
//! | `start`, `step` | the checked columns of an initial state and of a step |
//! | `grains` | grains and gas of a caller |
//! | `si` | conversion of dimensionless results to SI units |
//! | `sphere_material` | properties of spheres and gas, and the conductivity of a bed of them |
//! | `status` | conversion of errors to status codes and texts |
//! | `panics` | panics are caught and become errors |
#![allow(unsafe_code)] // the C boundary

pub use msdd_abi as abi;

mod columns;
mod discs;
pub mod exports;
mod foreign;
mod grains;
mod handles;
mod load;
mod model;
mod panics;
mod si;
mod signatures;
mod sphere_material;
mod spheres;
mod start;
mod status;
mod step;
/// Under the name by which the tests know it.
#[cfg(test)]
extern crate self as msdd;
#[cfg(test)]
mod tests;
