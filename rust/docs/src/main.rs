//! `msdd-docs`: fills in and checks README and book.
#![forbid(unsafe_code)]

use clap::{Parser, Subcommand};
use msdd_docs::{DocsError, commands, fill, gather, links, math, pages, print as printed, results};
use std::path::{Path, PathBuf};
use std::process::ExitCode;

#[derive(Parser)]
#[command(name = "msdd-docs", about = "Fills in and checks the README and the book in docs")]
struct Arguments {
    /// The checkout [default: the nearest folder from here upwards that holds docs/book.toml].
    #[arg(long, value_name = "DIR", global = true)]
    root: Option<PathBuf>,
    #[command(subcommand)]
    command: Command,
}

#[derive(Subcommand)]
enum Command {
    /// Renew the marked numbers and tables from docs/results.json.
    Fill {
        /// Change nothing; fail, naming file, line, key, text and value, where text and results differ.
        #[arg(long)]
        check: bool,
        /// Files, relative to the checkout [default: README.md, the book, READMEs of cases and rust].
        files: Vec<PathBuf>,
    },
    /// Run the commands of the book, each page in a copy of the checkout; needs msdd and the solver built.
    Commands {
        /// Run blocks that are marked slow, too.
        #[arg(long)]
        full: bool,
        /// Folder for the copies.
        #[arg(long, value_name = "DIR", default_value = ".cache/tests/docs")]
        work: PathBuf,
        /// Most time that a page may take [s].
        #[arg(long, value_name = "SECONDS", default_value_t = 900)]
        limit: u64,
        /// Pages, relative to the checkout [default: README.md, the book, READMEs of cases and rust].
        files: Vec<PathBuf>,
    },
    /// Preprocessor of mdBook: prints from the code, and equations as MathML.
    Math {
        #[command(subcommand)]
        question: Option<Question>,
    },
    /// Print what a line `<!-- print: SOURCE ARGUMENT -->` of a page becomes.
    Print {
        source: String,
        #[arg(default_value = "")]
        argument: String,
    },
    /// Renew a section of docs/results.json from what scripts/results left in results/numbers.
    Gather {
        section: String,
        /// Commit of the sources that made the numbers.
        #[arg(long)]
        commit: String,
        /// Day, year-month-day.
        #[arg(long)]
        date: String,
        /// Processor and cores, if times are in the section.
        #[arg(long, default_value = "")]
        machine: String,
    },
    /// Check relative links, anchors, paths in backticks, and that SUMMARY.md lists every page.
    Links {
        /// Files, relative to the checkout [default: README.md, the book, READMEs of cases and rust].
        files: Vec<PathBuf>,
    },
}

/// What mdBook asks before it hands the book over.
#[derive(Subcommand)]
enum Question {
    /// Whether a renderer is supported: every one is.
    Supports { renderer: String },
}

fn main() -> ExitCode {
    match run(Arguments::parse()) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("{error}");
            ExitCode::FAILURE
        }
    }
}

fn run(arguments: Arguments) -> Result<(), DocsError> {
    let root = match arguments.root {
        Some(root) => root,
        None => {
            let here = std::env::current_dir();
            pages::checkout(&here.map_err(|source| DocsError::Folder { folder: ".".into(), source })?)?
        }
    };
    let chosen = |files: Vec<PathBuf>| if files.is_empty() { pages::all(&root) } else { Ok(files) };
    match arguments.command {
        Command::Fill { check, files } => {
            let written = fill::fill(&root, &chosen(files)?, check)?;
            written.iter().for_each(|file| println!("renewed {}", file.display()));
        }
        Command::Commands { full, work, limit, files } => {
            run_commands(&root, &work, full, limit, &chosen(files)?)?
        }
        Command::Math { question: Some(Question::Supports { .. }) } => {}
        Command::Math { question: None } => {
            let input = std::io::read_to_string(std::io::stdin());
            let input =
                input.map_err(|source| DocsError::Folder { folder: "standard input".into(), source })?;
            print!("{}", math::preprocess(&root, &input)?);
        }
        Command::Print { source, argument } => print!("{}", printed::text(&root, &source, &argument)?),
        Command::Gather { section, commit, date, machine } => {
            gather::renew(&root, &section, gather::Origin { commit, date, machine })?;
            println!("renewed the section {section} of {}", results::FILE);
        }
        Command::Links { files } => links::check(&root, &chosen(files)?)?,
    }
    Ok(())
}

fn run_commands(
    root: &Path,
    work: &Path,
    slow: bool,
    limit: u64,
    files: &[PathBuf],
) -> Result<(), DocsError> {
    let program = std::env::current_exe();
    let program = program.map_err(|source| DocsError::Folder { folder: "msdd-docs".into(), source })?;
    let programs = program.parent().unwrap_or(root).to_path_buf();
    let settings =
        commands::Settings { root: root.to_path_buf(), work: root.join(work), programs, slow, limit };
    let count = commands::run(&settings, files, |file| println!("commands of {}", file.display()))?;
    println!("the commands of {count} pages ran");
    Ok(())
}
