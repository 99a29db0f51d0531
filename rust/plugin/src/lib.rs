//! Host of surrogate models that others built as shared libraries against `msdd.h`.
//!
//! | module | what |
//! |---|---|
//! | [`library`] | from a path to a table: file, version, sizes and pointers are checked before anything is called |
//! | [`plugin`] | calls of the table's functions, and checks of what they answer |
//! | [`error`] | why a plug-in was refused or failed |
//!
//! Foreign code is trusted with memory, as every library of a process is, and with nothing else: statuses are plain
//! integers, texts are copied, outputs go into our own columns and are looked at before anybody sees them.
#![allow(unsafe_code)] // calls of foreign code

mod error;
mod library;
mod plugin;

pub use error::PluginError;
pub use plugin::{Answer, Plugin, Start, Step, WallFriction};
