//! Plans of discs, as the parts that are common to all plans need them.

use super::kind::RampName;
use super::plan::{Job, Plan};
use super::recipe::Recipe;
use super::record::Record;
use super::rows::rows;
use super::{DatabaseError, Dataset, ENGINE_VERSION, Violation, check};

impl Recipe for Plan {
    type Row = Record;
    type Job = Job;
    const ENGINE_VERSION: i64 = ENGINE_VERSION;

    fn parse(text: &str, file: &str) -> Result<Self, DatabaseError> {
        Plan::parse(text, file)
    }

    fn text(&self) -> &str {
        &self.text
    }

    fn grains(&self) -> Vec<(&'static str, String)> {
        vec![
            ("material", serde_json::json!(self.material).to_string()),
            ("radius_distribution", "uniform".to_string()),
            ("radius_min", self.radius_min.to_string()),
            ("radius_max", self.radius_max.to_string()),
            ("mean_radius", self.mean_radius().to_string()),
        ]
    }

    fn jobs(&self) -> Vec<Job> {
        Plan::jobs(self)
    }

    fn packing(job: &Job) -> (i64, u64) {
        (job.packing, job.spec.seed)
    }

    fn places(job: &Job) -> Vec<(RampName, i64)> {
        job.rows()
    }

    fn cost(job: &Job) -> usize {
        job.spec.discs * job.rows().len()
    }

    fn make(&self, job: &Job) -> Vec<Record> {
        rows(self, job)
    }

    fn violations(dataset: &Dataset) -> Vec<Violation> {
        check::violations(dataset)
    }
}
