//! `msdd report`: the report on speed and accuracy, as a page and as JSON.

use crate::error::CliError;
use crate::progress::Progress;
use clap::Args;
use msdd_report::jobs::cache::Cache;
use msdd_report::jobs::execute::{Place, Stamp};
use msdd_report::report::{Report, make};
use msdd_report::settings::Settings;
use std::path::{Path, PathBuf};
use std::process::Command;

#[derive(Args)]
#[command(
    after_help = "Needs a checkout whose solver is built (scripts/report does all that is needed). The result of each simulation \
is kept in the cache under everything that it depends on (program, inputs, parameters): a second run takes it from there, and a \
run that was killed continues."
)]
pub struct Arguments {
    /// Few configurations, one packing and coarse meshes, as for the tests.
    #[arg(long)]
    quick: bool,
    /// Run no simulations: draw the results that the cache has.
    #[arg(long)]
    draw: bool,
    /// Folder for the page, index.html.
    #[arg(long, value_name = "DIR", default_value = "report")]
    out: PathBuf,
    /// JSON file to write.
    #[arg(long, value_name = "FILE", default_value = "results/report.json")]
    json: PathBuf,
    /// Folder of the cache for results of simulations.
    #[arg(long, value_name = "DIR", default_value = ".cache/report")]
    cache: PathBuf,
    /// Number of simulations at the same time. Those whose cost is measured always run alone.
    #[arg(long, default_value_t = 2, value_parser = clap::value_parser!(u32).range(1..=64))]
    jobs: u32,
}

pub fn run(arguments: &Arguments) -> Result<(), CliError> {
    let checkout = std::env::current_dir().map_err(|e| CliError::Message(format!("current folder: {e}")))?;
    for needed in ["cases/reference/results", "openfoam/platforms/bin/msddFoam"] {
        if !checkout.join(needed).exists() {
            let text = format!("{needed} is missing: run scripts/report, in the checkout");
            return Err(CliError::Message(text));
        }
    }
    let page = arguments.out.join("index.html");
    for file in [&page, &arguments.json] {
        msdd_files::check_target(file)?;
    }
    let settings = settings(arguments, &checkout)?;
    let mut progress: Option<(String, Progress)> = None;
    let made = make(&settings, &mut |what, now| {
        if progress.as_ref().is_none_or(|(name, _)| name != what) {
            progress = Some((what.to_string(), Progress::new("jobs", now.total as u64)));
        }
        let [done, all] = now.work;
        let left = if done > 0.0 { now.elapsed * (all - done) / done } else { 0.0 };
        let note = format!("({what}: {}; about {left:.0} s left of this part)", now.last);
        if let Some((_, progress)) = &mut progress {
            progress.set(now.done as u64, now.total as u64, &note);
        }
    })?;
    if let Some((_, progress)) = &progress {
        progress.finish();
    }
    let json = serde_json::to_string_pretty(&made.report).map_err(|e| CliError::Message(e.to_string()))?;
    msdd_report::write_text(&arguments.json, &json)?;
    msdd_report::write_text(&page, &msdd_report::page::text(&made)?)?;
    let report = &made.report;
    outln!("{} jobs, {} from the cache", report.jobs, report.cached_jobs);
    outln!("{}", judged(report));
    outln!("page: {}   figures: {}", page.display(), arguments.json.display());
    Ok(())
}

/// How many targets are reached. A quick report does not judge those of accuracy, and the text says so.
fn judged(report: &Report) -> String {
    let rows = &report.failures.rows;
    let good = rows.iter().filter(|row| row.as_allowed).count();
    let edges = format!("{good} of {} configurations at an edge behave as they should", rows.len());
    if report.quick {
        return format!(
            "{edges}; the {} targets of accuracy are not judged by the quick report, whose meshes are coarse and which runs one \
             packing: scripts/report judges them",
            report.targets.len()
        );
    }
    let met = report.targets.iter().filter(|target| target.met == Some(true)).count();
    format!("{met} of {} targets of accuracy reached; {edges}", report.targets.len())
}

fn settings(arguments: &Arguments, checkout: &Path) -> Result<Settings, CliError> {
    let msdd = std::env::current_exe().map_err(|e| CliError::Message(format!("path of msdd: {e}")))?;
    let cpu = processor();
    let cache = checkout.join(&arguments.cache);
    let stamp = Stamp { date: date(), commit: commit(checkout), cpu: cpu.clone() };
    Ok(Settings {
        quick: arguments.quick,
        place: Place { checkout: checkout.to_path_buf(), msdd, work: cache.join("work"), stamp },
        cache: Cache::new(&cache, checkout, &cpu),
        at_a_time: arguments.jobs as usize,
        run: !arguments.draw,
    })
}

/// Name of the processor.
fn processor() -> String {
    let text = std::fs::read_to_string("/proc/cpuinfo").unwrap_or_default();
    let line = text.lines().find(|line| line.starts_with("model name"));
    line.and_then(|line| line.split_once(':')).map_or("unknown", |(_, name)| name.trim()).to_string()
}

fn printed(program: &str, arguments: &[&str]) -> Option<String> {
    let output = Command::new(program).args(arguments).output().ok()?;
    output.status.success().then(|| String::from_utf8_lossy(&output.stdout).trim().to_string())
}

fn date() -> String {
    printed("date", &["-u", "+%Y-%m-%d %H:%M UTC"]).unwrap_or_default()
}

/// Commit of the checkout, with a + when tracked files differ from it.
fn commit(checkout: &Path) -> String {
    let folder = checkout.to_string_lossy();
    let git = |arguments: &[&str]| printed("git", &[&["-C", &folder], arguments].concat());
    let Some(commit) = git(&["rev-parse", "--short", "HEAD"]) else { return "unknown".to_string() };
    let changed = git(&["status", "--porcelain", "--untracked-files=no"]).is_none_or(|text| !text.is_empty());
    if changed { commit + "+" } else { commit }
}
