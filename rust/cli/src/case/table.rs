//! `msdd case table`.

use crate::error::CliError;
use clap::Args;
use msdd_case::tables;
use std::path::PathBuf;

#[derive(Args)]
#[command(
    after_help = "A run that was killed and continued has written several files, and files of earlier runs may lie next to them. Rows after the
start of a later part belong to that part. The files of the run are listed in postProcessing/msddFoam/tables.json; without that
list the file that was changed last counts in each folder of a start.

Examples: msdd case table cases/H probes
          msdd case table cases/silo bed/wallPressure"
)]
pub struct Arguments {
    /// The case folder.
    folder: PathBuf,
    /// Function object: its folder in postProcessing, such as `probes` or `bed/wallPressure`.
    name: String,
    /// File of the function object, such as T. Default: its only one.
    #[arg(long, value_name = "FILE")]
    file: Option<String>,
}

/// Prints the head and the rows.
pub fn run(arguments: &Arguments) -> Result<(), CliError> {
    let table = tables::read(&arguments.folder, &arguments.name, arguments.file.as_deref())?;
    table.head.iter().chain(&table.rows).for_each(|line| outln!("{line}"));
    Ok(())
}
