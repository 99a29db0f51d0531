//! Settings of a report, and the records of jobs that belong to it.

use crate::jobs::cache::Cache;
use crate::jobs::execute::{Place, Record};
use crate::jobs::job::Job;
use crate::jobs::pool::Records;
use crate::plan::Configuration;
use msdd_dem_reference::packings::SEEDS;

/// Settings of a report.
pub struct Settings {
    pub quick: bool,
    pub place: Place,
    pub cache: Cache,
    pub at_a_time: usize,
    /// Whether jobs that the cache does not have are run; else they are reported as not run.
    pub run: bool,
}

impl Settings {
    /// Seeds of the packings that are run.
    pub fn seeds(&self) -> &'static [u32] {
        if self.quick { &SEEDS[..1] } else { &SEEDS }
    }

    /// Number of packings that a configuration is run for.
    pub fn packings(&self, configuration: &Configuration) -> usize {
        self.seeds().len().min(configuration.packings)
    }

    /// Records of one configuration in a case, one for each packing.
    pub fn records<'a>(
        &self,
        records: &'a Records,
        configuration: &Configuration,
        case: &str,
    ) -> Vec<&'a Record> {
        let job = |seed: &u32| Job::Solver(configuration.job(case, *seed));
        let seeds = self.seeds().iter().take(configuration.packings);
        seeds.filter_map(|seed| self.record(records, &job(seed))).collect()
    }

    /// The record of a job, if there is one.
    pub fn record<'a>(&self, records: &'a Records, job: &Job) -> Option<&'a Record> {
        records.get(&self.cache.key(job).ok()?)
    }
}
