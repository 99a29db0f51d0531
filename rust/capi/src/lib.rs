//! C ABI of MSDD. The header `include/msdd.h` is written by hand, bindgen makes the crate `msdd-abi` from it, and this
//! crate implements its functions.
//!
//! | module | what |
//! |---|---|
//! | [`exports`] | the header's functions: pointers checked, then safe code |
//! | `handles` | the types behind the opaque handles |
//! | `model` | what the exports need of a model, our own or a plug-in |
//! | `columns` | columns of the caller: arrays with one value per cell |
//! | `batch` | checks and evaluation of a batch |
//! | `si` | conversion of dimensionless results to SI units |
//! | `sphere_material` | spheres and gas of a caller, and the conductivity of a bed of them |
//! | `status` | conversion of errors to status codes and texts |
//! | `panics` | panics are caught and become errors |
#![allow(unsafe_code)] // the C boundary

pub use msdd_abi as abi;

mod batch;
mod columns;
pub mod exports;
mod handles;
mod model;
mod panics;
mod si;
mod signatures;
mod sphere_material;
mod status;
#[cfg(test)]
mod tests;
