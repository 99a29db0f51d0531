//! The offline database: many packings, each taken through ramps of thermal strain, wall strain or wall slip, or along
//! paths of strain.
//!
//! | module | what |
//! |---|---|
//! | [`plan`] | the packings and ramps to make, as a TOML file |
//! | `block` | the blocks of a plan |
//! | `table` | columns and schema: what stands in a row |
//! | `recipe` | what a plan of any grains has to know |
//! | `discs` | that, for plans of discs |
//! | [`spheres`] | plan, rows and checks of spheres |
//! | `grains` | whether a file holds discs or spheres |
//! | `seed` | seeds of packings |
//! | `kind` | names of kinds, ramps and paths |
//! | [`paths`] | the increments of each path |
//! | `rows` | the rows of one packing |
//! | `path_rows` | the rows of one path |
//! | [`record`] | one row: one state of one packing |
//! | `store` | the folder of a database |
//! | `provenance` | where the rows come from |
//! | [`generate`](mod@generate) | makes the rows, on several threads |
//! | [`offenders`] | a plan of new packings from a solver's queries outside a model's range |
//! | `read`(mod@read) | reading a database or CSV, or several files as one dataset |
//! | [`export`] | CSV with a column dictionary |
//! | [`csv_file`] | reading CSV |
//! | [`check`] | exact laws on every row, statistics, noise floor |

mod block;
pub mod check;
pub mod csv_file;
mod discs;
pub mod export;
pub mod generate;
mod grains;
mod kind;
pub mod offenders;
mod path_rows;
pub mod paths;
pub mod plan;
pub(crate) mod provenance;
mod read;
mod recipe;
pub mod record;
mod rows;
mod seed;
mod shard;
pub mod spheres;
mod store;
pub mod table;

pub use export::export_csv;
pub use generate::{Progress, Run, generate};
pub use grains::{Grains, grains};
pub use offenders::{Effort, Offenders};
pub use plan::{Kind, Plan, RampName};
pub use provenance::PROVENANCE;
pub use read::{inspect, read, read_all, read_spheres};
pub use recipe::Recipe;
pub use record::Record;
pub use shard::Shard;
pub use spheres::{PathName, SpherePlan, SphereRecord};

use std::collections::BTreeMap;
use std::path::PathBuf;

/// Increased by one whenever the same plan and seed give other numbers. Databases of different versions cannot be
/// mixed.
pub const ENGINE_VERSION: i64 = 4;

/// The rows of a database with their provenance.
#[derive(Clone, Debug, PartialEq)]
pub struct Dataset<R = Record> {
    /// In the order of packing, ramp and stop, whatever the order in the file, so that a model trained on them does not
    /// depend on that.
    pub records: Vec<R>,
    pub provenance: BTreeMap<String, String>,
}

/// A law that a row does not obey.
#[derive(Clone, Debug, PartialEq)]
pub struct Violation {
    /// Name of the row, or of the part of the file, that violates the law.
    pub row: String,
    pub law: &'static str,
    /// What was found.
    pub found: String,
}

impl std::fmt::Display for Violation {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "{}: {}: {}", self.row, self.law, self.found)
    }
}

/// What can go wrong with plans and databases.
#[derive(Debug, thiserror::Error)]
pub enum DatabaseError {
    #[error("{file}: {problem}", problem = crate::message::shortened(problem))]
    Plan { file: String, problem: String },
    #[error(transparent)]
    File(#[from] msdd_files::FileError),
    #[error("{path}: {source}", source = crate::message::shortened(&source.to_string()))]
    Csv { path: PathBuf, source: csv::Error },
    #[error("{path}: not an msdd database ({problem})")]
    Format { path: PathBuf, problem: String },
    #[error("{path}: holds rows of spheres, allowed: rows of discs")]
    Spheres { path: PathBuf },
    #[error("{path}: {table}, row {row}, column {column}: {problem}")]
    Value { path: PathBuf, table: &'static str, row: u64, column: &'static str, problem: String },
    #[error("{path}: is damaged: {problem}; copy the original file again, or generate it again")]
    Damaged { path: PathBuf, problem: String },
    #[error(
        "{path}: {count} violations of exact laws, the first: {first}; the file is not used, and msdd \
         database check reports them all"
    )]
    Unsound { path: PathBuf, count: usize, first: String },
    #[error(
        "{path}: packing {packing} is packing {other_packing} of {other}: the same grains would be among the packings \
         for training and among those held out for testing; give every database once, as itself or as its CSV"
    )]
    Twice { path: PathBuf, packing: i64, other: PathBuf, other_packing: i64 },
    #[error("{path}: {missing} of {of} packings are missing: {list}; msdd database generate continues it")]
    Incomplete { path: PathBuf, missing: usize, of: usize, list: String },
    #[error(
        "{path}: was made with {key} = {found}, now it is {expected}; rows of both cannot stand in one database: choose \
         another --out or remove it", found = crate::message::shortened(found)
    )]
    Mismatch { path: PathBuf, key: &'static str, found: String, expected: String },
}
