//! Rows against the plan that they were made by, and the tolerance of all laws.

use crate::database::provenance::DIGITS;
use crate::database::recipe::Recipe;
use crate::database::record::FAILED;
use crate::database::table::{Place, Row};
use crate::database::{DatabaseError, Dataset, Violation};
use std::collections::{BTreeMap, BTreeSet};

/// Relative tolerance of the laws; it covers the rounding of exports to nine digits.
const TOLERANCE: f64 = 1e-9;
/// Exports with at most this many digits need a larger tolerance.
const FEW_DIGITS: i32 = 8;

/// The tolerance for this file. When it was exported with few digits: half a unit of the last digit.
pub fn tolerance<R>(dataset: &Dataset<R>) -> f64 {
    match dataset.provenance.get(DIGITS).and_then(|digits| digits.parse().ok()) {
        Some(digits @ 3..=FEW_DIGITS) => 0.5 * 10f64.powi(1 - digits),
        _ => TOLERANCE,
    }
}

/// Whether |off| is at most the tolerance; false for NaN.
pub fn within(off: f64, tolerance: f64) -> bool {
    off.abs() <= tolerance
}

/// Violated laws of a row, each with what was found.
pub type Found = Vec<(&'static str, String)>;

/// Violations of the laws of a row.
pub fn named<R: Row>(record: &R, found: Found) -> impl Iterator<Item = Violation> + use<R> {
    let row = record.name();
    found.into_iter().map(move |(law, found)| Violation { row: row.clone(), law, found })
}

/// What a row violates whose state was not reached; none of other rows.
pub fn failed<R: Row>(record: &R, has_averages: bool) -> Option<Found> {
    let (outcome, failure) = (record.outcome(), record.failure());
    if outcome != FAILED && failure.is_none() {
        return None;
    }
    let sound = outcome == FAILED && failure.is_some() && !has_averages;
    let text = format!("outcome {outcome}, failure {failure:?}");
    Some(if sound { Vec::new() } else { vec![("a failure has a reason and no averages", text)] })
}

/// Laws by which a number is 0, with its scale; and laws that hold or do not, with a number to show.
pub fn found(
    zeros: &[(&'static str, f64, f64)],
    holds: &[(&'static str, bool, f64)],
    tolerance: f64,
) -> Found {
    let off = zeros.iter().filter(|(_, off, scale)| !within(*off, 4.0 * tolerance * scale));
    let off = off.map(|(law, off, _)| (*law, format!("off by {off:.3e}")));
    let holds = holds.iter().filter(|(_, holds, _)| !holds);
    off.chain(holds.map(|(law, _, value)| (*law, value.to_string()))).collect()
}

/// The packings of the plan in the provenance.
pub fn jobs<P: Recipe>(dataset: &Dataset<P::Row>) -> Result<Vec<P::Job>, DatabaseError> {
    let text = dataset.provenance.get("plan").map_or("", String::as_str);
    Ok(P::parse(text, "the plan in the provenance")?.jobs())
}

/// Rows and seeds must be those of the plan in the provenance.
pub fn plan_laws<P: Recipe>(dataset: &Dataset<P::Row>) -> Vec<Violation> {
    let violation = |row: String, law, found: &str| Violation { row, law, found: found.to_string() };
    let jobs = match jobs::<P>(dataset) {
        Ok(jobs) => jobs,
        Err(error) => return vec![violation("provenance".to_string(), "has a plan", &error.to_string())],
    };
    let seeds: BTreeMap<i64, u64> = jobs.iter().map(P::packing).collect();
    let expected: BTreeSet<_> = jobs
        .iter()
        .flat_map(|job| P::places(job).into_iter().map(|place| (P::packing(job).0, place)))
        .collect();
    let mut found = BTreeSet::new();
    let mut violations = Vec::new();
    for record in &dataset.records {
        if !found.insert((record.packing(), record.place())) {
            violations.push(violation(record.name(), "a row stands once", "twice"));
        }
        if seeds.get(&record.packing()) != Some(&record.seed()) {
            violations.push(violation(record.name(), "the seed is the plan's", &record.seed().to_string()));
        }
    }
    let name = |&(packing, place): &(i64, Place<P::Row>)| P::Row::name_of(packing, place);
    let missing =
        expected.difference(&found).map(|row| violation(name(row), "every row of the plan", "absent"));
    let foreign =
        found.difference(&expected).map(|row| violation(name(row), "no row but the plan's", "present"));
    violations.into_iter().chain(missing).chain(foreign).collect()
}
