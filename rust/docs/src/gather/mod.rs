//! Makes sections of the results from what our programs wrote. `scripts/results` runs the programs; their files lie in
//! `results/numbers` under fixed names. Nothing is measured here: numbers are chosen, converted and rounded for print.

pub mod beds;
pub mod beside;
pub mod cases;
pub mod database;
pub mod json;
pub mod print;
pub mod report;
pub mod speed;
pub mod surrogate;
pub mod witness;

use crate::error::DocsError;
use crate::results::{Results, Section};
use std::path::Path;

/// Makes one section of the checkout; its origin is filled in by [`renew`].
type Make = fn(&Path) -> Result<Section, DocsError>;

/// Sections by name.
pub const SECTIONS: [(&str, Make); 9] = [
    ("beds", beds::section),
    ("cases", cases::section),
    ("database", database::section),
    ("more-beds", beds::more),
    ("report", report::section),
    ("solver", speed::solver),
    ("speed", speed::section),
    ("surrogate", surrogate::section),
    ("witness", witness::section),
];

/// Where a section comes from.
pub struct Origin {
    pub commit: String,
    pub date: String,
    pub machine: String,
}

/// Renews one section of docs/results.json from the files of its programs; the others stay.
///
/// # Errors
/// A section that there is none of; files that are missing or lack an entry.
pub fn renew(root: &Path, name: &str, origin: Origin) -> Result<(), DocsError> {
    let Some((_, make)) = SECTIONS.iter().find(|(section, _)| *section == name) else {
        let names = SECTIONS.map(|(section, _)| section).join(", ");
        return Err(DocsError::Section { name: name.to_string(), names });
    };
    let made = make(root)?;
    let command = format!("scripts/results {name}");
    let section =
        Section { command, commit: origin.commit, date: origin.date, machine: origin.machine, ..made };
    let mut results =
        if root.join(crate::results::FILE).is_file() { Results::read(root)? } else { Results::default() };
    results.sections.insert(name.to_string(), section);
    results.write(root)
}
