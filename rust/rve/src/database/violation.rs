//! A law that does not hold.

use std::fmt;

/// A law that a row does not obey.
#[derive(Clone, Debug, PartialEq)]
pub struct Violation {
    /// Name of the row, or of the part of the file, that violates the law.
    pub row: String,
    pub law: &'static str,
    /// What was found.
    pub found: String,
}

impl fmt::Display for Violation {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}: {}: {}", self.row, self.law, self.found)
    }
}
