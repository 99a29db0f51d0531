//! The offline database: many packings, each taken through ramps of thermal strain, wall strain or wall slip.
//!
//! | module | what |
//! |---|---|
//! | [`plan`] | what to make, as a TOML file |
//! | `rows` | the rows of one packing |
//! | [`record`] | one row: one state of one packing |
//! | [`store`] | the SQLite file: schema, provenance, resume |
//! | [`generate`](mod@generate) | makes the rows, on several threads |
//! | [`merge`](mod@merge) | shards made on several machines become one file |
//! | [`offenders`] | a plan from queries outside a model's range |
//! | [`export`] | CSV with a column dictionary; reading any form |
//! | [`check`] | exact laws on every row, statistics, noise floor |

pub mod check;
pub mod export;
pub mod generate;
pub mod merge;
pub mod offenders;
pub mod plan;
pub mod record;
mod rows;
mod shard;
pub mod store;

pub use export::{Dataset, export_csv, read, read_all};
pub use generate::{Progress, Run, generate};
pub use merge::merge;
pub use offenders::{Effort, Offenders};
pub use plan::{Kind, Plan, RampName};
pub use record::Record;
pub use shard::Shard;
pub use store::Store;

use std::path::PathBuf;

/// Raised by one whenever the same plan and seed give other numbers. Databases of different versions do not mix.
pub const ENGINE_VERSION: i64 = 4;

/// What can go wrong with plans and databases.
#[derive(Debug, thiserror::Error)]
pub enum DatabaseError {
    #[error("{file}: {problem}")]
    Plan { file: String, problem: String },
    #[error("{path}: {source}")]
    Io { path: PathBuf, source: std::io::Error },
    #[error("{path}: {source}")]
    Sqlite { path: PathBuf, source: rusqlite::Error },
    #[error("{path}: {source}")]
    Csv { path: PathBuf, source: csv::Error },
    #[error("{path}: not an msdd database ({problem})")]
    Format { path: PathBuf, problem: String },
    #[error("{path}: {problem}")]
    Merge { path: PathBuf, problem: String },
    #[error(
        "{path}: was made with {key} = {found}, now it is {expected}; rows of both cannot stand in one database: choose \
         another --out or remove the file"
    )]
    Mismatch { path: PathBuf, key: &'static str, found: String, expected: String },
}
