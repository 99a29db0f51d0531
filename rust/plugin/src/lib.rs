//! Host of surrogate models that others built as shared libraries against `msdd.h`.
//!
//! | module | what |
//! |---|---|
//! | [`library`] | from a path to a table: file, version, sizes and pointers are checked before anything is called |
//! | [`names`] | names of state columns, which become names of fields and files elsewhere |
//! | [`plugin`] | calls of the table's functions |
//! | [`columns`] | copies of the inputs for them, and room for the outputs |
//! | [`checks`] | what their answers are held to |
//! | [`error`] | why a plug-in was refused or failed |
//!
//! Loading a library runs its code, with all rights of the process. Foreign code is trusted with memory, as every library
//! of a process is, and with nothing else: statuses are plain integers, texts are copied, inputs are copies, outputs go into
//! our own columns and are looked at before anybody sees them.
#![allow(unsafe_code)] // calls of foreign code

mod checks;
mod columns;
mod error;
mod library;
mod names;
mod plugin;
mod questions;

pub use error::{PluginError, shown};
pub use plugin::Plugin;
pub use questions::{Answer, Start, Step, WallFriction};
