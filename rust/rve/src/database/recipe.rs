//! What a plan has to know so that a database is made and checked by it.

use super::plan::Plan;
use super::provenance::sha256;
use super::spheres::SpherePlan;
use super::table::{Place, Row};
use super::{DatabaseError, Dataset, Violation};
use serde::de::DeserializeOwned;

/// A plan of packings.
pub trait Recipe: DeserializeOwned + Sync {
    type Row: Row;
    /// One packing.
    type Job: Sync;
    /// Increased by one whenever the same plan and seed give other numbers. Databases of different versions cannot be
    /// mixed.
    const ENGINE_VERSION: i64;

    /// The error names key, value and allowed range.
    ///
    /// # Errors
    /// The first thing that is wrong.
    fn check(&self) -> Result<(), String>;
    /// The plan with the text that it was read from.
    #[must_use]
    fn with_text(self, text: String) -> Self;
    /// The text that the plan was read from.
    fn text(&self) -> &str;
    /// Entries of the provenance that say what the grains are.
    fn grains(&self) -> Vec<(&'static str, String)>;
    /// The packings.
    fn jobs(&self) -> Vec<Self::Job>;
    /// Index of a packing in the plan, and its seed.
    fn packing(job: &Self::Job) -> (i64, u64);
    /// Every row that a packing has, in order.
    fn places(job: &Self::Job) -> Vec<Place<Self::Row>>;
    /// The rows of a packing.
    fn make(&self, job: &Self::Job) -> Vec<Self::Row>;
    /// Violated laws of a dataset of such rows.
    fn violations(dataset: &Dataset<Self::Row>) -> Vec<Violation>;

    /// A measure of the time that a packing takes; the most expensive are made first. Where all count the same, they are made in the
    /// order of the plan, and its first part can be used before the rest is there.
    fn cost(_: &Self::Job) -> usize {
        0
    }

    /// Reads a plan. `file` names it in errors.
    ///
    /// # Errors
    /// [`DatabaseError::Plan`].
    fn parse(text: &str, file: &str) -> Result<Self, DatabaseError> {
        let problem = |problem: String| DatabaseError::Plan { file: file.to_string(), problem };
        let plan: Self = toml::from_str(text).map_err(|error| problem(error.to_string()))?;
        plan.check().map_err(problem)?;
        Ok(plan.with_text(text.to_string()))
    }

    /// Rows that the plan makes.
    fn rows(&self) -> usize {
        self.jobs().iter().map(|job| Self::places(job).len()).sum()
    }

    /// SHA-256 of the plan's text, hexadecimal.
    fn hash(&self) -> String {
        sha256(self.text().as_bytes())
    }
}

/// The packings of a plan of any grains, and the entries of the provenance that follow from it. `file` names it in errors.
pub(super) fn planned(text: &str, file: &str) -> Result<Planned, DatabaseError> {
    fn all<P: Recipe>(plan: &P) -> Planned {
        let mut entries = plan.grains();
        entries.push(("plan_hash", plan.hash()));
        (plan.jobs().iter().map(|job| P::packing(job).0).collect(), entries)
    }
    Ok(match SpherePlan::has_sphere_schema(text) {
        true => all(&SpherePlan::parse(text, file)?),
        false => all(&Plan::parse(text, file)?),
    })
}

type Planned = (Vec<i64>, Vec<(&'static str, String)>);
