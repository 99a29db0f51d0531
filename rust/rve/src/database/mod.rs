//! The offline database: many packings, each expanded and contracted through a list of strains.
//!
//! | module | what |
//! |---|---|
//! | [`plan`] | what to make, as a TOML file |
//! | [`record`] | one row: one state of one packing |
//! | [`store`] | the SQLite file: schema, provenance, resume |
//! | [`generate`](mod@generate) | makes the rows, on several threads |
//! | [`export`] | CSV with a column dictionary; reading either form |

pub mod export;
pub mod generate;
pub mod plan;
pub mod record;
pub mod store;

pub use export::{Dataset, export_csv, read};
pub use generate::{Progress, generate};
pub use plan::Plan;
pub use record::Record;
pub use store::Store;

use std::path::PathBuf;

/// Raised by one whenever the same plan and seed give other numbers. Databases of different versions do not mix.
pub const ENGINE_VERSION: i64 = 3;

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
    #[error(
        "{path}: was made with {key} = {found}, now it is {expected}; rows of both cannot stand in one database: choose \
         another --out or remove the file"
    )]
    Mismatch { path: PathBuf, key: &'static str, found: String, expected: String },
}
