//! What builds and checks the book in `docs` and the READMEs.
//!
//! | module | what |
//! |---|---|
//! | [`results`] | `docs/results.json`: every measured number and table, with its unit, meaning and source |
//! | [`marks`] | the marks in Markdown between which numbers and tables of the results stand |
//! | [`fill`] | renews what stands between the marks, or says where it differs |
//! | [`gather`] | makes sections of the results from what our programs wrote |
//! | [`links`] | links, anchors, paths of the repository and the book's table of contents |
//! | [`headings`] | the anchors that headings get |
//! | [`commands`] | runs the commands of the book |
//! | [`math`] | equations as MathML, as a preprocessor of mdBook |
//! | [`paths`] | paths of the repository that are named in backticks |
//! | [`pages`] | which Markdown files there are, and reading them |
//! | [`print`] | the parts of the reference pages that are printed from the code |
#![forbid(unsafe_code)]

pub mod commands;
pub mod error;
pub mod fill;
pub mod gather;
pub mod headings;
pub mod links;
pub mod marks;
pub mod math;
pub mod pages;
pub mod paths;
pub mod print;
pub mod results;

pub use error::DocsError;
