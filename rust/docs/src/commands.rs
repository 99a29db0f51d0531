//! Runs the commands of the book as they stand on its pages. A comment before a block says what is done with it; readers do
//! not see it:
//!
//! | comment | the block below it |
//! |---|---|
//! | `<!-- run -->` | is run: `sh` by bash, `python` by python3 |
//! | `<!-- run: slow -->` | is run if slow ones are asked for |
//! | `<!-- no run: why -->` | is not run |
//! | `<!-- file: name -->` | is written into a file |
//! | `<!-- append: name -->` | is written at the end of a file |
//!
//! A block of `sh` without any of them is an error, so that no command escapes. The blocks of a page run one after the other
//! in one shell, in a copy of the checkout that is made for the page, with what the book tells its readers to set once:
//! OpenFOAM's environment, `msdd` in the path, the Python package in Python's path.

use crate::error::{DocsError, Finding, none_found};
use crate::pages::Page;
use pulldown_cmark::{CodeBlockKind, Event, Tag};
use std::fs;
use std::ops::Range;
use std::path::{Path, PathBuf};
use std::process::Command;

/// Ends what is written into files; no page has such a line.
const END: &str = "END_OF_THE_BLOCK";
/// Lines of output that are shown of a command that failed.
const SHOWN: usize = 25;
/// What every page's shell begins with: the first command that fails ends it, and says in which line of the page it stands. Scripts
/// that the page calls do not begin with it: bash would read BASH_ENV there, too.
const BEGIN: &str = "unset BASH_ENV\nset -eEo pipefail\ntrap 'echo \"@failed $LINENO $BASH_COMMAND\" >> \"$MSDD_DOCS_FAILED\"' ERR\n\
                     . scripts/foam-env\n";

/// What is done with a block.
#[derive(Clone, Debug, PartialEq)]
enum Task {
    Run { slow: bool },
    Leave,
    Write(String),
    Append(String),
}

/// How pages are run.
pub struct Settings {
    pub root: PathBuf,
    /// Folder for the copies; replaced.
    pub work: PathBuf,
    /// Folder of the programs msdd and msdd-docs.
    pub programs: PathBuf,
    /// Whether slow blocks run, too.
    pub slow: bool,
    /// Most time that a page may take \[s\].
    pub limit: u64,
}

/// The script of a page: as many lines as the page, so that a shell's line is the page's. None if it has nothing to run.
///
/// # Errors
/// Blocks of commands that nothing is said about, and comments that say nothing known.
pub fn script(page: &Page, slow: bool) -> Result<Option<String>, DocsError> {
    let mut lines = vec![String::new(); page.text.lines().count() + 1];
    let (mut findings, mut comment, mut runs) = (Vec::new(), None, false);
    for (event, range) in page.events() {
        let line = page.line(range.start);
        let mut wrong = |text: String| findings.push(Finding { file: page.file.clone(), line, text });
        match event {
            Event::Html(html) if html.trim_start().starts_with("<!--") => {
                comment = Some(html.trim().to_string())
            }
            Event::Start(Tag::HtmlBlock) | Event::End(_) => {}
            Event::Start(Tag::CodeBlock(CodeBlockKind::Fenced(info))) => {
                let language = info.split([',', ' ']).next().unwrap_or_default().to_string();
                match task(comment.take().as_deref(), &language) {
                    Ok(Some(task)) => runs |= place(&mut lines, page, &range, &language, &task, slow),
                    Ok(None) => {}
                    Err(problem) => wrong(problem),
                }
            }
            _ => comment = None,
        }
    }
    none_found(findings)?;
    Ok(runs.then(|| lines.join("\n") + "\n"))
}

/// What the comment before a block of this language asks for.
fn task(comment: Option<&str>, language: &str) -> Result<Option<Task>, String> {
    let said = comment.and_then(|text| text.strip_prefix("<!--")?.strip_suffix("-->")).map(str::trim);
    let (what, rest) = said.map_or(("", ""), |text| text.split_once(':').unwrap_or((text, "")));
    let (what, rest) = (what.trim(), rest.trim());
    let runs = ["sh", "bash", "python"].contains(&language);
    match (what, rest) {
        ("run", "" | "slow") if runs => Ok(Some(Task::Run { slow: rest == "slow" })),
        ("run", "" | "slow") => Err(format!("a block of '{language}' cannot be run, allowed: sh, bash, python")),
        ("run", other) => Err(format!("'run: {other}' is not known, allowed: run, run: slow")),
        ("no run", "") => Err("'no run' has to say why: <!-- no run: why -->".to_string()),
        ("no run", _) => Ok(Some(Task::Leave)),
        ("file" | "append", "") => Err(format!("'{what}' has to name a file")),
        ("file", name) => Ok(Some(Task::Write(name.to_string()))),
        ("append", name) => Ok(Some(Task::Append(name.to_string()))),
        _ if language == "sh" || language == "bash" => Err(
            "nothing is said about running these commands: put <!-- run -->, <!-- run: slow -->, or <!-- no run: why --> on a line \
             before the block"
                .to_string(),
        ),
        _ => Ok(None),
    }
}

/// Puts a block into the lines of the script; whether it is run.
fn place(
    lines: &mut [String],
    page: &Page,
    range: &Range<usize>,
    language: &str,
    task: &Task,
    slow: bool,
) -> bool {
    let first = page.line(range.start) - 1;
    let block = page.text[range.clone()].trim_end_matches('\n');
    let last = first + block.lines().count() - 1;
    let (open, runs) = match task {
        Task::Leave => return false,
        Task::Run { slow: true } if !slow => return false,
        Task::Run { .. } if language == "python" => (format!("python3 - <<'{END}'"), true),
        Task::Run { .. } => (String::new(), true),
        Task::Write(name) => (format!("mkdir -p \"$(dirname '{name}')\"; cat > '{name}' <<'{END}'"), false),
        Task::Append(name) => (format!("cat >> '{name}' <<'{END}'"), false),
    };
    lines[last] = if open.is_empty() { String::new() } else { END.to_string() };
    for (k, text) in block.lines().enumerate().skip(1) {
        if first + k < last {
            lines[first + k] = text.to_string();
        }
    }
    lines[first] = open;
    runs
}

/// Runs the commands of the pages; `watch` receives each page before it is run.
///
/// # Errors
/// What is wrong with comments; then nothing is run. Commands that failed, with page, line, command and output.
pub fn run(settings: &Settings, files: &[PathBuf], mut watch: impl FnMut(&Path)) -> Result<usize, DocsError> {
    let (mut scripts, mut findings) = (Vec::new(), Vec::new());
    for file in files {
        match script(&Page::read(&settings.root, file)?, settings.slow) {
            Ok(Some(script)) => scripts.push((file, script)),
            Ok(None) => {}
            Err(DocsError::Found(found)) => findings.extend(found),
            Err(error) => return Err(error),
        }
    }
    none_found(findings)?;
    let mut failed = Vec::new();
    for (file, script) in &scripts {
        watch(file);
        failed.extend(run_page(settings, file, script)?);
    }
    none_found(failed)?;
    Ok(scripts.len())
}

fn run_page(settings: &Settings, file: &Path, script: &str) -> Result<Option<Finding>, DocsError> {
    // Beside the copy there is room for what a page puts outside of the checkout.
    let own = settings.work.join(file.with_extension("").to_string_lossy().replace('/', "-"));
    let copy = own.join("msdd");
    if own.exists() {
        fs::remove_dir_all(&own).map_err(|source| DocsError::Folder { folder: own.clone(), source })?;
    }
    copy_checkout(&settings.root, &copy)?;
    let place = |name: &str| copy.join(".cache").join(name);
    let (begin, page, output, failed) =
        (place("begin.sh"), place("page.sh"), place("output"), place("failed"));
    msdd_files::write(&begin, BEGIN.as_bytes())?;
    msdd_files::write(&page, script.as_bytes())?;
    let broken = |source| DocsError::Folder { folder: copy.clone(), source };
    // The system's Python is the one that has the packages which the book tells to install.
    fs::create_dir_all(place("bin")).map_err(broken)?;
    std::os::unix::fs::symlink("/usr/bin/python3", place("bin").join("python3")).map_err(broken)?;
    let out = fs::File::create(&output).map_err(broken)?;
    let path = std::env::var("PATH").unwrap_or_default();
    let status = Command::new("timeout")
        .args([&settings.limit.to_string(), "bash"])
        .arg(&page)
        .current_dir(&copy)
        .env("BASH_ENV", &begin)
        .env("MSDD_DOCS_FAILED", &failed)
        .env("PATH", format!("{}:{}:{path}", settings.programs.display(), place("bin").display()))
        .env("PYTHONPATH", copy.join("rust/python"))
        .stderr(out.try_clone().map_err(broken)?)
        .stdout(out)
        .status()
        .map_err(broken)?;
    if status.success() {
        fs::remove_dir_all(&own).map_err(broken)?;
        return Ok(None);
    }
    let said = fs::read_to_string(&failed).unwrap_or_default();
    let mut words = said.lines().next().unwrap_or_default().splitn(3, ' ').skip(1);
    let line = words.next().and_then(|word| word.parse().ok()).unwrap_or(1);
    let command = words.next().unwrap_or("the page's commands").to_string();
    let output = fs::read(&output).map_err(broken)?;
    let output = String::from_utf8_lossy(&output).into_owned();
    let lines: Vec<&str> = output.lines().collect();
    let shown = lines[lines.len().saturating_sub(SHOWN)..].join("\n    ");
    let why = if status.code() == Some(124) {
        format!("took more than {} s", settings.limit)
    } else {
        status.to_string()
    };
    let text = format!("'{command}' failed ({why}) in {}:\n    {shown}", copy.display());
    Ok(Some(Finding { file: file.to_path_buf(), line, text }))
}

/// A copy of what git keeps, with the programs that are built linked in.
fn copy_checkout(root: &Path, copy: &Path) -> Result<(), DocsError> {
    let broken = |source| DocsError::Folder { folder: copy.to_path_buf(), source };
    fs::create_dir_all(copy.join(".cache")).map_err(broken)?;
    let listed = Command::new("git").args(["ls-files", "-z"]).current_dir(root).output().map_err(broken)?;
    let listed = String::from_utf8_lossy(&listed.stdout).into_owned();
    for file in listed.split('\0').filter(|file| !file.is_empty() && root.join(file).is_file()) {
        let target = copy.join(file);
        fs::create_dir_all(target.parent().unwrap_or(copy)).map_err(broken)?;
        fs::copy(root.join(file), target).map_err(broken)?;
    }
    for built in ["openfoam/platforms", "target", ".cache/openfoam"] {
        if root.join(built).is_dir()
            && !copy.join(built).exists()
            && copy.join(built).parent().is_some_and(Path::is_dir)
        {
            std::os::unix::fs::symlink(root.join(built), copy.join(built)).map_err(broken)?;
        }
    }
    Ok(())
}
