//! Runs one job. Every job ends within its time limit, and with one of the outcomes.

use super::{setup, spheres, user_case};
use crate::jobs::job::{CaseJob, CaseProgram, Job, SolverJob, SpheresJob, ToolJob};
use crate::{ReportError, read_text, write_text};
use msdd_autotune::ChoiceError;
use msdd_case::tables;
use msdd_dem_reference::solver;
use msdd_dem_reference::solver::Run;
use msdd_files::Lock;
use serde::{Deserialize, Serialize};
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::sync::Arc;
use std::time::Instant;

#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Outcome {
    Done,
    /// The job ended with an error before the first step.
    Refused,
    /// The job ended with an error later.
    Failed,
    /// The job was stopped at its limit of processor time or, on a busy machine, at `PATIENCE` times as much wall time.
    TimedOut,
    /// The job was not run, because only results of the cache were wanted.
    NotRun,
}

impl Record {
    /// Whether another run would have the same outcome. It would not if a busy machine gave the job too little processor time.
    pub fn is_settled(&self) -> bool {
        self.outcome != Outcome::TimedOut || self.cpu_seconds >= 0.9 * self.job.limit() as f64
    }
}

impl Outcome {
    pub fn as_str(self) -> &'static str {
        match self {
            Self::Done => "done",
            Self::Refused => "refused",
            Self::Failed => "failed",
            Self::TimedOut => "timed out",
            Self::NotRun => "not run",
        }
    }
}

/// When and where a job ran.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Stamp {
    /// Date in UTC.
    pub date: String,
    /// Commit of the checkout, with a + when files differed from it.
    pub commit: String,
    pub cpu: String,
}

/// A job and its results.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Record {
    pub job: Job,
    pub outcome: Outcome,
    /// Why the job is not done; for a run of the solver that is done, its first warning.
    pub message: String,
    /// Processor time of the program alone, user and system \[s\].
    pub cpu_seconds: f64,
    pub wall_seconds: f64,
    pub run: Option<Run>,
    /// The output of a tool, and the text of the output file that the job names; of a run on a case of the user's, what it has
    /// given ([`user_case::result`]); of a run with spheres its comparison with DEM, and T at its probes.
    pub printed: String,
    pub file: Option<String>,
    pub stamp: Stamp,
    /// Whether the record was taken from the cache; not part of the file.
    #[serde(skip)]
    pub cached: bool,
}

/// Where jobs run.
#[derive(Clone, Debug)]
pub struct Place {
    pub checkout: PathBuf,
    /// The program `msdd` for jobs that run it.
    pub msdd: PathBuf,
    /// Folder for the folders of running jobs.
    pub work: PathBuf,
    pub stamp: Stamp,
    /// A lock that the programs of the jobs hold, too, so that it lasts until they have ended if this program is killed.
    pub lock: Option<Arc<Lock>>,
}

/// The example of `rust/cli` that stands for `msdd` where a job's arguments begin with its name.
const BENCH: &str = "bench";
/// Separates the arguments of two commands of one job, which run one after the other.
pub const THEN: &str = "THEN";
/// Largest number of characters of a message that are kept.
const MAX_MESSAGE: usize = 400;

/// Runs `job` in a folder of its own, which is removed afterwards.
///
/// # Errors
/// Only errors that say nothing about the job: files that cannot be written, a shell that cannot be started.
pub fn execute(place: &Place, job: &Job, name: &str) -> Result<Record, ReportError> {
    let folder = place.work.join(format!("{name}.{}", std::process::id()));
    let _ = std::fs::remove_dir_all(&folder);
    let record = match job {
        Job::Solver(solver) => run_solver(place, job, solver, &folder),
        Job::Spheres(asked) => run_spheres(place, job, asked, &folder),
        Job::Tool(tool) => run_tool(place, job, tool, &folder),
        Job::Case(case) => return run_case(place, job, case),
    };
    let _ = std::fs::remove_dir_all(&folder);
    // The path of the folder is removed from the message, because it differs from run to run.
    let inside = format!("{}/", folder.display());
    record.map(|record| Record { message: record.message.replace(&inside, ""), ..record })
}

/// Removes the folders of runs that were killed.
pub fn sweep(work: &Path) {
    for folder in msdd_files::list(work).unwrap_or_default() {
        let process = folder.extension().map(|id| Path::new("/proc").join(id));
        if process.is_some_and(|process| !process.exists()) {
            let _ = std::fs::remove_dir_all(&folder);
        }
    }
}

struct Ended {
    code: i32,
    cpu: f64,
    wall: f64,
}

/// On a busy machine a job may take this many times its limit of processor time.
const PATIENCE: u64 = 6;

/// Runs `preparation`, then `program`, whose processor time is measured, in `folder`, with the output in `log`. The status is
/// 97 when the preparation fails. The limit is one of processor time, so that the outcome does not depend on what else the
/// machine does.
fn timed(
    place: &Place,
    folder: &Path,
    preparation: &str,
    program: &str,
    limit: u64,
) -> Result<Ended, ReportError> {
    let script = format!(
        ". '{}/scripts/foam-env' && cd '{}' && {{ {preparation}; }} || exit 97\n\
         ulimit -t {limit}\n\
         TIMEFORMAT='%U %S'\n\
         {{ time timeout --kill-after=5 {wall} {program} > log 2>&1; }} 2> cpu\n\
         exit $?", // without it, bash would replace itself by the last command and measure no time
        place.checkout.display(),
        folder.display(),
        wall = PATIENCE * limit,
    );
    let input = match &place.lock {
        Some(lock) => Stdio::from(lock.handle()?),
        None => Stdio::null(),
    };
    let began = Instant::now();
    let status =
        Command::new("bash").args(["-c", &script]).stdin(input).stderr(Stdio::null()).status().map_err(
            |error| ReportError::Start { program: "bash".to_string(), problem: error.to_string() },
        )?;
    let cpu = read_text(&folder.join("cpu")).unwrap_or_default();
    // The last line; bash may print a line before it on the signal that ended the program.
    let cpu = cpu.lines().last().unwrap_or_default();
    let cpu = cpu.split_whitespace().filter_map(|word| word.parse::<f64>().ok()).sum();
    Ok(Ended { code: status.code().unwrap_or(137), cpu, wall: began.elapsed().as_secs_f64() })
}

/// Whether a status means that the limit was reached: ended by `timeout` (124), killed (128 + 9), or out of processor time
/// (128 + 24).
fn timed_out(code: i32) -> bool {
    [124, 137, 152].contains(&code)
}

fn record(place: &Place, job: &Job, ended: &Ended, outcome: Outcome, message: String) -> Record {
    Record {
        job: job.clone(),
        outcome,
        message,
        cpu_seconds: ended.cpu,
        wall_seconds: ended.wall,
        run: None,
        printed: String::new(),
        file: None,
        stamp: place.stamp.clone(),
        cached: false,
    }
}

fn run_solver(place: &Place, job: &Job, asked: &SolverJob, folder: &Path) -> Result<Record, ReportError> {
    setup::write_case(&place.checkout, asked, folder)?;
    let preparation = setup::preparation(&place.checkout, asked);
    let ended = timed(place, folder, &preparation, "msddFoam", asked.limit)?;
    let log = read_text(&folder.join("log")).unwrap_or_default();
    if let Some((outcome, message)) = unmeshed(&ended, folder).or_else(|| ill(&ended, asked.limit, &log)) {
        return Ok(record(place, job, &ended, outcome, message));
    }
    match solver::read(folder, asked.mesh, asked.end) {
        Ok(run) => {
            let mut record = record(place, job, &ended, Outcome::Done, warning(&log));
            record.run = Some(run);
            Ok(record)
        }
        Err(error) => {
            let text = error.to_string().replace(&folder.display().to_string(), "");
            Ok(record(place, job, &ended, Outcome::Failed, text))
        }
    }
}

fn run_spheres(place: &Place, job: &Job, asked: &SpheresJob, folder: &Path) -> Result<Record, ReportError> {
    spheres::write_case(&place.checkout, asked, folder)?;
    let ended = timed(place, folder, "blockMesh > log.blockMesh 2>&1", "msddFoam", asked.limit)?;
    let log = read_text(&folder.join("log")).unwrap_or_default();
    if let Some((outcome, message)) = unmeshed(&ended, folder).or_else(|| ill(&ended, asked.limit, &log)) {
        return Ok(record(place, job, &ended, outcome, message));
    }
    match spheres::compared(&place.checkout, asked, folder) {
        Ok(text) => {
            let mut record = record(place, job, &ended, Outcome::Done, warning(&log));
            record.printed = text;
            let probes = tables::read(folder, "probes", Some("T"))?;
            record.file = Some([probes.head, probes.rows].concat().join("\n") + "\n");
            Ok(record)
        }
        Err(problem) => Ok(record(place, job, &ended, Outcome::Failed, short(&problem))),
    }
}

/// Why there was no mesh to run on, if there was none.
fn unmeshed(ended: &Ended, folder: &Path) -> Option<(Outcome, String)> {
    let log = || read_text(&folder.join("log.blockMesh")).unwrap_or_default();
    (ended.code == 97).then(|| (Outcome::Refused, format!("blockMesh: {}", fatal(&log()))))
}

/// How and why a run of the solver with this log was not done, if it was not.
fn ill(ended: &Ended, limit: u64, log: &str) -> Option<(Outcome, String)> {
    if timed_out(ended.code) {
        let message = format!("stopped after {limit} s at t = {} s", last_time(log));
        return Some((Outcome::TimedOut, message));
    }
    let begun = log.contains("\nTime = ");
    let outcome = if begun { Outcome::Failed } else { Outcome::Refused };
    let at = if begun { format!(" (t = {} s)", last_time(log)) } else { String::new() };
    (ended.code != 0).then(|| (outcome, fatal(log) + &at))
}

/// Runs a program on a copy of a case of the user's, which is removed afterwards.
fn run_case(place: &Place, job: &Job, case: &CaseJob) -> Result<Record, ReportError> {
    let folder = user_case::copy_of(&case.folder);
    let ended = match user_case::prepare(case) {
        Ok(()) => {
            write_text(&folder.join("log"), "")?;
            timed(place, &folder, "true", &user_case::command(case, &place.msdd), case.limit)?
        }
        Err(ChoiceError::Run { program, problem, .. }) => {
            user_case::clear(&case.folder)?;
            let nothing = Ended { code: 1, cpu: 0.0, wall: 0.0 };
            return Ok(record(place, job, &nothing, Outcome::Refused, format!("{program}: {problem}")));
        }
        Err(error) => return Err(error.into()),
    };
    let log = read_text(&folder.join("log")).unwrap_or_default();
    let ill = match case.program {
        CaseProgram::Solver(_) => ill(&ended, case.limit, &log),
        _ if timed_out(ended.code) => Some((Outcome::TimedOut, format!("stopped after {} s", case.limit))),
        _ => (ended.code != 0).then(|| (Outcome::Failed, tail(&log))),
    };
    let (outcome, message, file) = match (ill, user_case::result(case)) {
        (Some((outcome, message)), _) => (outcome, message, None),
        (None, Ok(text)) => (Outcome::Done, warning(&log), Some(text)),
        (None, Err(error)) => (Outcome::Failed, error.to_string(), None),
    };
    user_case::clear(&case.folder)?;
    // The place of the case differs from machine to machine.
    let inside = case.folder.parent().map_or(String::new(), |folder| format!("{}/", folder.display()));
    let message = if inside.len() > 1 { message.replace(&inside, "") } else { message };
    Ok(Record { file, ..record(place, job, &ended, outcome, message) })
}

fn run_tool(place: &Place, job: &Job, tool: &ToolJob, folder: &Path) -> Result<Record, ReportError> {
    write_text(&folder.join("log"), "")?;
    let log = folder.join("log");
    let work = folder.display().to_string();
    let command = |arguments: &[String]| {
        let (program, arguments) = match arguments.split_first() {
            Some((name, others)) if name == BENCH => {
                (&place.msdd.with_file_name("examples").join(BENCH), others)
            }
            _ => (&place.msdd, arguments),
        };
        let quoted: Vec<String> =
            arguments.iter().map(|a| format!("'{}'", a.replace("WORK", &work))).collect();
        format!("'{}' {}", program.display(), quoted.join(" "))
    };
    let commands: Vec<String> = tool.arguments.split(|a| a == THEN).map(command).collect();
    // Tools take paths relative to the checkout.
    let script = format!("sh -c \"cd '{}' && {}\"", place.checkout.display(), commands.join(" && "));
    let ended = timed(place, folder, "true", &script, tool.limit)?;
    let printed = read_text(&log).unwrap_or_default();
    let outcome = match ended.code {
        0 => Outcome::Done,
        code if timed_out(code) => Outcome::TimedOut,
        _ => Outcome::Failed,
    };
    let message = if outcome == Outcome::Done { String::new() } else { tail(&printed) };
    let mut record = record(place, job, &ended, outcome, message);
    record.printed = printed;
    record.file = tool.output.as_ref().and_then(|name| read_text(&folder.join(name)).ok());
    Ok(record)
}

fn short(text: &str) -> String {
    let text = text.split_whitespace().collect::<Vec<_>>().join(" ");
    text.chars().take(MAX_MESSAGE).collect()
}

fn tail(text: &str) -> String {
    let lines: Vec<&str> = text.lines().filter(|line| !line.trim().is_empty()).collect();
    short(&lines[lines.len().saturating_sub(3)..].join(" "))
}

/// The message of OpenFOAM's fatal error, without the lines around it; else the last lines of the log.
fn fatal(log: &str) -> String {
    let Some(at) = log.find("FOAM FATAL") else { return tail(log) };
    let body: Vec<&str> = log[at..]
        .lines()
        .skip(1)
        .take_while(|line| {
            !["From ", "file: ", "FOAM exiting"].iter().any(|end| line.trim_start().starts_with(end))
        })
        .collect();
    short(&body.join(" "))
}

/// The first warning of a run, without the lines around it.
fn warning(log: &str) -> String {
    let frame = |line: &&str| ["From ", "in file"].iter().any(|begin| line.trim_start().starts_with(begin));
    let over =
        |line: &str| line.trim().is_empty() || line.starts_with("DICPCG") || line.starts_with("Time = ");
    let text = |rest: &str| {
        let lines = rest.lines().enumerate().take_while(|(k, line)| *k < 1 || !over(line));
        short(&lines.map(|(_, line)| line).filter(|line| !frame(line)).collect::<Vec<_>>().join(" "))
    };
    log.split("FOAM Warning :").nth(1).map(text).unwrap_or_default()
}

fn last_time(log: &str) -> &str {
    log.rsplit("\nTime = ")
        .next()
        .filter(|_| log.contains("\nTime = "))
        .map_or("0", |rest| rest.lines().next().unwrap_or("0"))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn place() -> Place {
        let checkout = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..").canonicalize().unwrap();
        let work = std::env::temp_dir().join(format!("msdd-report-execute-{}", std::process::id()));
        Place { checkout, msdd: PathBuf::from("/bin/sh"), work, stamp: Stamp::default(), lock: None }
    }

    fn shell(text: &str, limit: u64) -> Job {
        let arguments = ["-c", text].map(str::to_string).to_vec();
        Job::Tool(ToolJob { arguments, inputs: Vec::new(), output: Some("kept".to_string()), limit })
    }

    #[test]
    fn a_job_ends_in_an_outcome() {
        let done = execute(&place(), &shell("echo said; echo text > WORK/kept", 60), "done").unwrap();
        assert_eq!(
            (done.outcome, done.printed.as_str(), done.file.as_deref()),
            (Outcome::Done, "said\n", Some("text\n"))
        );
        let failed = execute(&place(), &shell("echo msdd: no such file; exit 3", 60), "failed").unwrap();
        assert_eq!((failed.outcome, failed.message.as_str()), (Outcome::Failed, "msdd: no such file"));
        let endless = execute(&place(), &shell("while true; do true; done", 1), "endless").unwrap();
        assert_eq!(endless.outcome, Outcome::TimedOut);
        assert!(!msdd_files::list(&place().work).unwrap().iter().any(|f| f.is_dir()));
        // How much processor time it got depends on what else the machine does.
        let [short, whole] = [0.5, 1.0].map(|cpu_seconds| Record { cpu_seconds, ..endless.clone() });
        assert!(!short.is_settled() && whole.is_settled());
        std::fs::remove_dir_all(place().work).unwrap();
    }

    #[test]
    fn the_fatal_message_is_taken_from_its_frame() {
        let log = "Time = 3\n\n--> FOAM FATAL ERROR: \nporosity is 0.05,\nallowed: 0.06\n\n    From void f()\nFOAM exiting\n";
        assert_eq!(fatal(log), "porosity is 0.05, allowed: 0.06");
        let warned =
            "x\n--> FOAM Warning : \n    From void f()\n    in file f.C at line 3\n    too hot\n\nTime = 4\n";
        assert_eq!(warning(warned), "too hot");
        assert_eq!(warning("--> FOAM Warning : too cold\n\nTime = 4\n"), "too cold");
        assert_eq!(fatal("a\nb\n\nc\nd\n"), "b c d");
        assert_eq!(last_time("\nTime = 0.1\n\nTime = 0.2\nx"), "0.2");
        assert_eq!(last_time("nothing"), "0");
    }
}
