//! C ABI of MSDD. `include/msdd.h` is the truth; this crate follows it.
//!
//! | module | what |
//! |---|---|
//! | [`ffi`] | the header's types |
//! | [`exports`] | the header's functions: pointers checked, then safe code |
//! | `columns` | a caller's columns |
//! | `batch` | checks and evaluation of a batch |
//! | `si` | dimensionless answers to SI units |
//! | `status` | errors to status codes and text; panics stop here |

mod batch;
mod columns;
pub mod exports;
pub mod ffi;
mod si;
mod status;
#[cfg(test)]
mod tests;
