//! What a plan has to know so that a database is made and checked by it.

use super::plan::Plan;
use super::provenance::sha256;
use super::spheres::SpherePlan;
use super::table::{Place, Row};
use super::{DatabaseError, Dataset, Violation};

/// A plan of packings.
pub trait Recipe: Sized + Sync {
    type Row: Row;
    /// One packing.
    type Job: Sync;
    /// Increased by one whenever the same plan and seed give other numbers. Databases of different versions cannot be
    /// mixed.
    const ENGINE_VERSION: i64;

    /// Reads a plan. `file` names it in errors.
    ///
    /// # Errors
    /// [`DatabaseError::Plan`].
    fn parse(text: &str, file: &str) -> Result<Self, DatabaseError>;
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
    /// A measure of the time that a packing takes; the most expensive are made first.
    fn cost(job: &Self::Job) -> usize;
    /// The rows of a packing.
    fn make(&self, job: &Self::Job) -> Vec<Self::Row>;
    /// Violated laws of a dataset of such rows.
    fn violations(dataset: &Dataset<Self::Row>) -> Vec<Violation>;

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
