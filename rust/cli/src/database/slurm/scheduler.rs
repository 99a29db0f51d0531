//! Calls of the programs of Slurm.

use super::parts::Parts;
use crate::error::CliError;
use std::path::{Path, PathBuf};
use std::process::Command;

/// Slurm, for the jobs of one database.
pub struct Scheduler {
    /// Names of the jobs: of the parts, and of joining them.
    name: String,
    merge_name: String,
    folder: PathBuf,
}

/// What is queued or runs.
pub struct Queued {
    /// Numbers of parts, growing.
    pub parts: Vec<u32>,
    /// Their jobs.
    pub jobs: Vec<u64>,
    /// Whether the job that joins them is queued.
    pub merge: bool,
}

impl Scheduler {
    pub fn new(parts: &Parts) -> Self {
        // The same database has the same name, whoever looks, and no other has it.
        let name = format!("msdd-{}", parts.key());
        Self { merge_name: format!("{name}-merge"), name, folder: parts.folder().to_path_buf() }
    }

    /// What of the database is queued or runs.
    pub fn queued(&self) -> Result<Queued, CliError> {
        let names = format!("{},{}", self.name, self.merge_name);
        let text =
            call("squeue", &["--me", "--noheader", "--array", "--name", &names, "--format", "%F %K %j"])?;
        let mut queued = Queued { parts: Vec::new(), jobs: Vec::new(), merge: false };
        for line in text.lines().filter(|line| !line.trim().is_empty()) {
            let mut words = line.split_whitespace();
            let (job, index, name) = (words.next(), words.next(), words.next());
            let not_understood = || {
                CliError::Message(format!(
                    "squeue says '{line}', expected: a job, its number in the array, its name"
                ))
            };
            if name == Some(&self.merge_name) {
                queued.merge = true;
                continue;
            }
            let number = |word: Option<&str>| {
                word.and_then(|word| word.parse::<u64>().ok()).ok_or_else(not_understood)
            };
            queued.jobs.push(number(job)?);
            queued.parts.push(u32::try_from(number(index)?).map_err(|_| not_understood())?);
        }
        queued.parts.sort_unstable();
        queued.jobs.sort_unstable();
        queued.jobs.dedup();
        Ok(queued)
    }

    /// Submits an array of parts; returns the job.
    pub fn submit_parts(
        &self,
        script: &Path,
        indices: &str,
        threads: u32,
        options: &[String],
    ) -> Result<u64, CliError> {
        let mut arguments =
            vec![format!("--array={indices}"), format!("--cpus-per-task={threads}"), "--requeue".to_string()];
        arguments.push("--open-mode=append".to_string());
        arguments.push(format!("--output={}", self.folder.join("%a.log").display()));
        self.submit(&self.name, arguments, script, options)
    }

    /// Submits the job that joins the parts, once `jobs` have ended, however they end: it says what is missing.
    pub fn submit_merge(&self, script: &Path, jobs: &[u64], options: &[String]) -> Result<u64, CliError> {
        let mut arguments = vec![format!("--output={}", self.folder.join("merge.log").display())];
        if !jobs.is_empty() {
            let jobs: Vec<String> = jobs.iter().map(u64::to_string).collect();
            arguments.push(format!("--dependency=afterany:{}", jobs.join(":")));
        }
        self.submit(&self.merge_name, arguments, script, options)
    }

    fn submit(
        &self,
        name: &str,
        mut arguments: Vec<String>,
        script: &Path,
        options: &[String],
    ) -> Result<u64, CliError> {
        arguments.extend(["--parsable".to_string(), format!("--job-name={name}")]);
        arguments.extend(options.iter().cloned());
        arguments.push(script.display().to_string());
        let arguments: Vec<&str> = arguments.iter().map(String::as_str).collect();
        let text = call("sbatch", &arguments)?;
        // With a cluster's name behind the job when there are several.
        let job = text.trim().split(';').next().and_then(|job| job.parse().ok());
        job.ok_or_else(|| CliError::Message(format!("sbatch says '{}', expected: a job", text.trim())))
    }

    /// Takes the job that joins the parts from the queue, before another takes its place.
    pub fn cancel_merge(&self) -> Result<(), CliError> {
        call("scancel", &["--me", "--name", &self.merge_name, "--state", "PENDING"]).map(|_| ())
    }
}

/// Runs a program of Slurm; returns what it prints.
fn call(program: &'static str, arguments: &[&str]) -> Result<String, CliError> {
    let failed = |error| CliError::Message(format!("cannot run {program}, a program of Slurm: {error}"));
    let output = Command::new(program).args(arguments).output().map_err(failed)?;
    if !output.status.success() {
        let text = String::from_utf8_lossy(&output.stderr);
        return Err(CliError::Message(format!("{program} failed ({}): {}", output.status, text.trim())));
    }
    Ok(String::from_utf8_lossy(&output.stdout).into_owned())
}
