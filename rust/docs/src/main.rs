//! `msdd-docs`: fills in and checks README and book.
#![forbid(unsafe_code)]

use clap::{Parser, Subcommand};
use msdd_docs::{DocsError, fill, gather, links, pages, results};
use std::path::PathBuf;
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
        Command::Gather { section, commit, date, machine } => {
            gather::renew(&root, &section, gather::Origin { commit, date, machine })?;
            println!("renewed the section {section} of {}", results::FILE);
        }
        Command::Links { files } => links::check(&root, &chosen(files)?)?,
    }
    Ok(())
}
