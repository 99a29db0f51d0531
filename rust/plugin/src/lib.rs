//! Loads and calls plug-ins: surrogate models that others built as shared libraries against `msdd.h`.
//!
//! | module | what |
//! |---|---|
//! | `library` | loads a library and gets its table of functions; checks file, version and size |
//! | `names` | checks the names of state columns, which become names of fields and files elsewhere |
//! | `plugin` | calls the functions of the table |
//! | `columns` | copies of the inputs for these calls, and space for the outputs |
//! | `checks` | checks of the results |
//! | `error` | why a plug-in was refused or failed |
//!
//! Loading a library runs its code, with all rights of the process, so a plug-in can access all of its memory. Apart from
//! that it is not trusted: statuses are plain integers, texts are copied, inputs are copies, and outputs go into our own
//! columns and are checked before the caller gets them.
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
pub use questions::{Answer, InitialColumns, Step, WallFriction};
