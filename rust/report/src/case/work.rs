//! The case, and the records of its jobs.

use super::discs::Discs;
use super::ladder::Rung;
use crate::ReportError;
use crate::jobs::execute::{Outcome, Record};
use crate::jobs::job::{CaseJob, CaseProgram, Job};
use crate::jobs::pool::{self, Asked, Progress, Records};
use crate::jobs::user_case::Measured;
use crate::settings::Settings;
use msdd_autotune::user_case::UserCase;

/// Processor time after which a run of the ladder, or a choice, is stopped [s]; of a quick report.
const LIMITS: [u64; 2] = [600, 120];

/// Progress of the parts.
pub type Watch<'a> = dyn FnMut(&str, &Progress) + Send + 'a;

/// A case, and the records of its jobs so far.
pub struct Work<'a> {
    pub settings: &'a Settings,
    pub scene: &'a UserCase,
    pub checksum: String,
    pub discs: Option<Discs>,
    pub records: Records,
}

impl Work<'_> {
    /// Processor time after which a run of the ladder, or a choice, is stopped [s].
    pub fn limit(&self) -> u64 {
        LIMITS[usize::from(self.settings.quick)]
    }

    /// A job on the case.
    pub fn job(&self, program: CaseProgram, limit: u64) -> Job {
        let (folder, checksum) = (self.scene.folder.clone(), self.checksum.clone());
        Job::Case(CaseJob { folder, checksum, program, limit })
    }

    /// The run of a configuration.
    pub fn solver(&self, rung: &Rung, limit: u64) -> Job {
        self.job(CaseProgram::Solver(rung.run(self.discs.as_ref().map(|discs| discs.place))), limit)
    }

    /// Runs the jobs one at a time, since they share a folder, and costs are measured.
    ///
    /// # Errors
    /// As [`pool::run`] and [`pool::found`].
    pub fn run(&mut self, what: &str, asked: &[Asked], watch: &mut Watch) -> Result<(), ReportError> {
        let Settings { cache, place, run, .. } = self.settings;
        let mut watch = |progress: &Progress| watch(what, progress);
        let records = match run {
            true => pool::run(cache, place, asked, 1, &mut watch)?,
            false => pool::found(cache, asked).or_else(|error| match error {
                ReportError::Empty { .. } if !self.records.is_empty() => Ok(Records::new()),
                other => Err(other),
            })?,
        };
        // A job that an earlier part has run is in the cache by now; its record says that it was measured.
        for (key, record) in records {
            self.records.entry(key).or_insert(record);
        }
        Ok(())
    }

    /// The record of a job, if it was run.
    pub fn record(&self, job: &Job) -> Option<&Record> {
        self.settings.record(&self.records, job)
    }

    /// What a job has given that is done.
    pub fn measured(&self, job: &Job) -> Option<Measured> {
        let record = self.record(job).filter(|record| record.outcome == Outcome::Done)?;
        serde_json::from_str(record.file.as_deref()?).ok()
    }
}
