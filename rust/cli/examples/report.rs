//! Writes the report on speed and accuracy, as a page and as JSON. `scripts/report` runs it.

use clap::Parser;
use msdd_cli::shared::{CliError, Progress};
use msdd_report::case::CaseReport;
use msdd_report::jobs::cache::{Cache, programs};
use msdd_report::jobs::execute::{Place, Stamp};
use msdd_report::jobs::pool;
use msdd_report::report::{Made, Report, make};
use msdd_report::settings::Settings;
use msdd_report::{case, page};
use std::error::Error;
use std::path::{Path, PathBuf};
use std::process::{Command, ExitCode};

/// Write the report on speed and accuracy, a page with figures; runs the simulations that are missing.
#[derive(Parser)]
#[command(
    after_help = "Needs a checkout whose solver is built (scripts/report does all that is needed). The result of each simulation \
is kept in the cache under everything that it depends on (program, inputs, parameters): a second run takes it from there, and a \
run that was killed continues.

With --case, the case is run on coarser and finer meshes, with larger and smaller tolerances, with grains that stay and that \
move, and as msdd case solve chooses it; each run is compared with one that is 4 or 8 times finer in space and time, or, with \
--discs, with DEM of the same box. Copies are next to the case while they run; the case itself stays as it is. \
It needs its mesh (blockMesh).

Example: scripts/report --case cases/HC --quick"
)]
struct Arguments {
    /// Few configurations, one packing and coarse meshes, as for the tests.
    #[arg(long)]
    quick: bool,
    /// Run no simulations: draw the results that the cache has.
    #[arg(long)]
    draw: bool,
    /// The case folder, with its mesh, whose chart of speed against accuracy is wanted, instead of the cases of the
    /// paper.
    #[arg(long, value_name = "DIR")]
    case: Option<PathBuf>,
    /// Compare the case with DEM: for a box along the axes in the plane, with insulated walls or walls with a
    /// temperature, and without sources of heat.
    #[arg(long, requires = "case")]
    discs: bool,
    /// Folder for the page, index.html; next to it stands spheres.html, on beds of spheres, unless a case is given. Default:
    /// `report`, or `report/NAME` for a case of that name.
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// JSON file to write; of a case also a table, in a file of the same name that ends in .csv. Default:
    /// `results/report.json`, or `results/report_NAME.json`.
    #[arg(long, value_name = "FILE")]
    json: Option<PathBuf>,
    /// Folder of the cache for results of simulations.
    #[arg(long, value_name = "DIR", default_value = ".cache/report")]
    cache: PathBuf,
    /// Number of simulations at the same time. Those whose cost is measured always run alone.
    #[arg(long, default_value_t = 2, value_parser = clap::value_parser!(u32).range(1..=64))]
    jobs: u32,
}

fn main() -> ExitCode {
    let Err(error) = run(&Arguments::parse()) else { return ExitCode::SUCCESS };
    eprintln!("report: {error}");
    ExitCode::FAILURE
}

fn run(arguments: &Arguments) -> Result<(), Box<dyn Error>> {
    let checkout = std::env::current_dir().map_err(|e| CliError::Message(format!("current folder: {e}")))?;
    let missing = |needed: &Path| {
        CliError::Message(format!("{} is missing: run scripts/report, in the checkout", needed.display()))
    };
    let reference = Path::new("cases/reference/results");
    if !checkout.join(reference).exists() {
        return Err(missing(reference).into());
    }
    let programs = programs(&checkout)?;
    if let Some(program) = programs.first().filter(|program| !program.exists()) {
        return Err(missing(program).into());
    }
    let targets = Targets::of(arguments)?;
    let settings = settings(arguments, &checkout, &programs)?;
    let mut progress: Option<(String, Progress)> = None;
    let mut watch = |what: &str, now: &pool::Progress| {
        if progress.as_ref().is_none_or(|(name, _)| name != what) {
            progress = Some((what.to_string(), Progress::new("jobs", now.total as u64)));
        }
        let [done, all] = now.work;
        let left = if done > 0.0 { now.elapsed * (all - done) / done } else { 0.0 };
        let note = format!("({what}: {}; about {left:.0} s left of this part)", now.last);
        if let Some((_, progress)) = &mut progress {
            progress.set(now.done as u64, now.total as u64, &note);
        }
    };
    let said = match &arguments.case {
        Some(folder) => targets.write_case(case::make(settings, folder, arguments.discs, &mut watch)?)?,
        None => targets.write_paper(&make(&settings, &mut watch)?)?,
    };
    if let Some((_, progress)) = &progress {
        progress.finish();
    }
    println!("{said}");
    println!("page: {}   figures: {}", targets.page.display(), targets.json.display());
    Ok(())
}

/// The files that are written.
struct Targets {
    page: PathBuf,
    json: PathBuf,
}

impl Targets {
    /// Files that cannot be written are refused now rather than at the end of a long run.
    fn of(arguments: &Arguments) -> Result<Self, CliError> {
        let name = match &arguments.case {
            Some(folder) => {
                let whole = folder.canonicalize().unwrap_or_else(|_| folder.clone());
                Some(whole.file_name().unwrap_or_default().to_string_lossy().into_owned())
            }
            None => None,
        };
        let usual = |of_paper: &str, of_case: &dyn Fn(&str) -> String| {
            name.as_deref().map_or(PathBuf::from(of_paper), |name| PathBuf::from(of_case(name)))
        };
        let out = arguments.out.clone();
        let out = out.unwrap_or_else(|| usual("report", &|name| format!("report/{name}")));
        let json = arguments.json.clone();
        let json = json
            .unwrap_or_else(|| usual("results/report.json", &|name| format!("results/report_{name}.json")));
        let targets = Self { page: out.join("index.html"), json };
        for file in [&targets.page, &targets.json, &targets.csv(), &targets.spheres()] {
            msdd_files::check_target(file)?;
        }
        Ok(targets)
    }

    /// The page on beds of spheres, which belongs to the report on the paper's cases.
    fn spheres(&self) -> PathBuf {
        self.page.with_file_name("spheres.html")
    }

    fn csv(&self) -> PathBuf {
        self.json.with_extension("csv")
    }

    fn write(&self, json: &impl serde::Serialize, page: &str) -> Result<(), Box<dyn Error>> {
        let json = serde_json::to_string_pretty(json).map_err(|e| CliError::Message(e.to_string()))?;
        msdd_report::write_text(&self.json, &json)?;
        Ok(msdd_report::write_text(&self.page, page)?)
    }

    fn write_paper(&self, made: &Made) -> Result<String, Box<dyn Error>> {
        let report = &made.report;
        self.write(report, &page::text(made)?)?;
        msdd_report::write_text(&self.spheres(), &page::spheres(made)?)?;
        Ok(format!("{} jobs, {} from the cache\n{}", report.jobs, report.cached_jobs, judged(report)))
    }

    fn write_case(&self, report: CaseReport) -> Result<String, Box<dyn Error>> {
        self.write(&report, &page::case(&report)?)?;
        msdd_report::write_text(&self.csv(), &page::table(&report)?)?;
        let done = report.rows.iter().filter(|row| row.errors.temperature.is_some()).count();
        let sentences: Vec<&str> = report.choices.iter().map(|choice| choice.sentence.as_str()).collect();
        Ok(format!(
            "{} jobs, {} from the cache\n{}\n{done} of {} configurations were run and compared with it.\n{}",
            report.jobs,
            report.cached_jobs,
            report.reference.what,
            report.rows.len(),
            sentences.join("\n")
        ))
    }
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

fn settings(arguments: &Arguments, checkout: &Path, programs: &[PathBuf]) -> Result<Settings, CliError> {
    let msdd =
        std::env::current_exe().map_err(|e| CliError::Message(format!("path of this program: {e}")))?;
    let msdd = msdd.with_file_name("../msdd");
    let cpu = processor();
    let cache = checkout.join(&arguments.cache);
    let stamp = Stamp { date: date(), commit: commit(checkout), cpu: cpu.clone() };
    Ok(Settings {
        quick: arguments.quick,
        place: Place { checkout: checkout.to_path_buf(), msdd, work: cache.join("work"), stamp, lock: None },
        cache: Cache::new(&cache, checkout, &cpu, programs),
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
