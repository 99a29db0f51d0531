//! C ABI of MSDD. `include/msdd.h` is the truth, `msdd-abi` is what bindgen makes of it, and this crate follows.
//!
//! | module | what |
//! |---|---|
//! | [`exports`] | the header's functions: pointers checked, then safe code |
//! | `handles` | what the opaque handles are |
//! | `model` | what the exports ask of a model, our own or a plug-in |
//! | `columns` | a caller's columns |
//! | `batch` | checks and evaluation of a batch |
//! | `si` | dimensionless answers to SI units |
//! | `status` | errors to status codes and text |
//! | `panics` | panics stop here |
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
mod status;
#[cfg(test)]
mod tests;
