//! Plans of spheres, as the parts that are common to all plans need them.

use super::check;
use super::kind::PathName;
use super::plan::{SphereJob, SpherePlan};
use super::record::SphereRecord;
use super::rows::rows;
use crate::database::recipe::Recipe;
use crate::database::{DatabaseError, Dataset, Violation};

impl Recipe for SpherePlan {
    type Row = SphereRecord;
    type Job = SphereJob;
    const ENGINE_VERSION: i64 = 1;

    fn parse(text: &str, file: &str) -> Result<Self, DatabaseError> {
        SpherePlan::parse(text, file)
    }

    fn text(&self) -> &str {
        &self.text
    }

    fn grains(&self) -> Vec<(&'static str, String)> {
        let material = serde_json::json!({
            "friction": self.friction,
            "poisson_ratio": self.poisson_ratio,
            "restitution": self.restitution,
        });
        vec![("grains", "spheres".to_string()), ("material", material.to_string())]
    }

    fn jobs(&self) -> Vec<SphereJob> {
        SpherePlan::jobs(self)
    }

    fn packing(job: &SphereJob) -> (i64, u64) {
        (job.packing, job.preparation.seed)
    }

    fn places(job: &SphereJob) -> Vec<(PathName, i64)> {
        job.rows()
    }

    /// All packings count the same, so that they are made in the order of the plan, and the first part of it can be used
    /// before the rest is there.
    fn cost(_: &SphereJob) -> usize {
        0
    }

    fn make(&self, job: &SphereJob) -> Vec<SphereRecord> {
        rows(job)
    }

    fn violations(dataset: &Dataset<SphereRecord>) -> Vec<Violation> {
        check::check(dataset).violations
    }
}
