//! `msdd.h` in Rust: types, constants and declarations, made by bindgen and checked in, so that building needs no
//! libclang. `tests/header.rs` makes them afresh and compares.

#[allow(unsafe_code)] // declarations alone
#[allow(non_camel_case_types, unused, clippy::all)]
mod bindings;

pub use bindings::*;
