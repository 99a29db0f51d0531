//! The database of spheres: periodic boxes, packed and taken along paths of strain.
//!
//! | module | what |
//! |---|---|
//! | [`kind`] | names of compressions and paths |
//! | [`paths`] | the increments of each path |
//! | [`plan`] | the packings and paths to make |
//! | [`record`] | one row: one state of one packing |
//! | `recipe` | what is common to all plans |
//! | `rows` | the rows of one packing |
//! | `free_axis` | boxes that keep their stress along one axis |
//! | [`check`] | exact laws on every row |

pub mod check;
mod free_axis;
pub mod kind;
pub mod paths;
pub mod plan;
mod recipe;
pub mod record;
mod rows;

pub use kind::{PathName, SphereCompression};
pub use plan::SpherePlan;
pub use record::SphereRecord;
