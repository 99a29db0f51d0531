//! The scripts of the jobs.

use super::parts::Parts;
use crate::error::CliError;
use msdd_files::write as write_file;
use std::path::{Path, PathBuf};

/// The files of the scripts.
pub struct Scripts {
    pub part: PathBuf,
    pub merge: PathBuf,
}

/// Text in single quotes of the shell.
fn quoted(text: &str) -> String {
    format!("'{}'", text.replace('\'', r"'\''"))
}

fn path(path: &Path) -> Result<String, CliError> {
    match path.to_str() {
        // sbatch takes % for a pattern in the names of logs.
        Some(text) if !text.contains(['\n', '%', '\\']) => Ok(quoted(text)),
        _ => Err(CliError::Message(format!(
            "{}: a path for Slurm, allowed: UTF-8 without line breaks, % and backslashes",
            path.display()
        ))),
    }
}

/// Writes the scripts of a part and of joining all parts into the folder of the parts, with absolute paths.
pub fn write(parts: &Parts, plan: &Path, threads: u32, commit: Option<&str>) -> Result<Scripts, CliError> {
    let failed = |error: std::io::Error| CliError::Message(format!("cannot find this program: {error}"));
    let program = path(&std::env::current_exe().map_err(failed)?)?;
    let commit = commit.map_or_else(String::new, |commit| format!(" --commit {}", quoted(commit)));
    let plan = path(&std::path::absolute(plan).map_err(failed)?)?;
    let (count, number) = (parts.count(), "\"$SLURM_ARRAY_TASK_ID\"");
    let folder = path(parts.folder())?;
    let part = format!(
        "#!/bin/sh\n# Makes one part of a database, or goes on with it.\nexec {program} database generate --plan {plan} \
         --shard {number}/{count} --threads {threads}{commit} --out {folder}/{number}-of-{count}.msdd\n"
    );
    let databases = (1..=count).map(|part| path(&parts.database(&part.to_string())));
    let databases: Vec<String> = databases.collect::<Result<_, _>>()?;
    let merge = format!(
        "#!/bin/sh\n# Joins the parts of a database.\nexec {program} database merge --out {} \\\n    {}\n",
        path(parts.out())?,
        databases.join(" \\\n    ")
    );
    let scripts = Scripts { part: parts.folder().join("part.sh"), merge: parts.folder().join("merge.sh") };
    write_file(&scripts.part, part.as_bytes())?;
    write_file(&scripts.merge, merge.as_bytes())?;
    Ok(scripts)
}
