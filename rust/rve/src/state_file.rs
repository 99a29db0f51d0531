//! What state files of discs ([`crate::state`]) and of spheres ([`crate::spheres::state`]) share: schema, dimension, checksum, and
//! checks of columns.

use crate::database::provenance::sha256;
use crate::message::{number, shortened};
use serde::de::DeserializeOwned;
use serde::{Deserialize, Serialize};

/// Largest magnitude of a state's numbers, and its inverse the smallest: products of several stay finite.
pub(crate) const LARGEST: f64 = 1e30;
const SMALLEST: f64 = 1e-30;
/// Name of the schema.
pub const SCHEMA: &str = "msdd-state-1";

/// What is wrong with a state.
#[derive(Debug, thiserror::Error)]
pub enum StateError {
    #[error("not a state: {text}", text = shortened(&.0.to_string()))]
    Json(#[from] serde_json::Error),
    #[error("schema: '{found}', allowed: '{SCHEMA}'", found = shortened(.0))]
    Schema(String),
    #[error("dimension = {found}, allowed: {allowed}")]
    Dimension { found: u32, allowed: &'static str },
    #[error(transparent)]
    Material(#[from] msdd_dem::MaterialError),
    #[error(transparent)]
    SphereMaterial(#[from] msdd_spheres::MaterialError),
    #[error("box: {0}")]
    Box(String),
    #[error("{column} has {found} values, x has {expected}")]
    Length { column: &'static str, found: usize, expected: usize },
    #[error("particle {particle}: {column} = {value}, allowed: {allowed}", value = number(*value))]
    Particle { particle: usize, column: &'static str, value: f64, allowed: &'static str },
    #[error("contact {contact}: {problem}")]
    Contact { contact: usize, problem: String },
    #[error("run: {0}")]
    Run(String),
    #[error(
        "checksum = '{found}', but the values have '{expected}': the file is damaged, or was edited; in the latter case take \
         its entry checksum out", found = shortened(found)
    )]
    Checksum { found: String, expected: String },
}

/// SHA-256 of the values of a file without its checksum, independent of the layout of the text; hexadecimal.
pub(crate) fn digest(file: &impl Serialize) -> Result<String, StateError> {
    let text = serde_json::to_string(file)?;
    Ok(sha256(text.as_bytes()))
}

/// Reads a file of grains of a dimension, and compares its checksum, which it loses, with that of its values.
pub(crate) fn read<F: Serialize + DeserializeOwned>(
    text: &str,
    (number, allowed): (u32, &'static str),
    checksum: fn(&mut F) -> Option<String>,
) -> Result<F, StateError> {
    let found = dimension(text)?;
    if found != number {
        return Err(StateError::Dimension { found, allowed });
    }
    let mut file: F = serde_json::from_str(text)?;
    let Some(found) = checksum(&mut file) else { return Ok(file) };
    let expected = digest(&file)?;
    if found == expected { Ok(file) } else { Err(StateError::Checksum { found, expected }) }
}

/// Whether a state is of discs (2) or of spheres (3).
///
/// # Errors
/// What is no state.
pub fn dimension(text: &str) -> Result<u32, StateError> {
    /// What every state has.
    #[derive(Deserialize)]
    struct Head {
        schema: String,
        #[serde(default = "plane")]
        dimension: u32,
    }
    fn plane() -> u32 {
        2
    }
    let head: Head = serde_json::from_str(text)?;
    match (head.schema.as_str(), head.dimension) {
        (SCHEMA, 2 | 3) => Ok(head.dimension),
        (SCHEMA, found) => Err(StateError::Dimension { found, allowed: "2 for discs, 3 for spheres" }),
        _ => Err(StateError::Schema(head.schema)),
    }
}

/// What is allowed in columns.
pub(crate) const ANY: &str = "-1e30 to 1e30";
pub(crate) const POSITIVE: &str = "1e-30 to 1e30";

/// Whether a number is one of [`ANY`] or of [`POSITIVE`].
pub(crate) fn is_allowed(value: f64, allowed: &str) -> bool {
    value.abs() <= LARGEST && (allowed != POSITIVE || value >= SMALLEST)
}

/// Refuses columns that have another number of values than expected.
pub(crate) fn check_lengths<const N: usize>(
    columns: [(&'static str, usize); N],
    expected: usize,
) -> Result<(), StateError> {
    match columns.into_iter().find(|(_, found)| *found != expected) {
        Some((column, found)) => Err(StateError::Length { column, found, expected }),
        None => Ok(()),
    }
}

/// Refuses a column that has another number of values than expected, or a value that is not allowed.
pub(crate) fn check_column(
    column: &'static str,
    values: &[f64],
    allowed: &'static str,
    expected: usize,
) -> Result<(), StateError> {
    check_lengths([(column, values.len())], expected)?;
    match values.iter().enumerate().find(|(_, value)| !is_allowed(**value, allowed)) {
        Some((particle, &value)) => Err(StateError::Particle { particle, column, value, allowed }),
        None => Ok(()),
    }
}
