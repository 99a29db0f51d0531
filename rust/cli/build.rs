//! Puts the commit that `msdd` is built from into `msdd --version`.

use std::process::Command;

/// What git prints, if there is git and this is a checkout.
fn git(arguments: &[&str]) -> Option<String> {
    let output =
        Command::new("git").args(arguments).output().ok().filter(|output| output.status.success())?;
    Some(String::from_utf8(output.stdout).ok()?.trim().to_string())
}

fn main() {
    let commit = git(&["rev-parse", "--short", "HEAD"]).unwrap_or_else(|| "unknown".to_string());
    println!("cargo:rustc-env=MSDD_COMMIT={commit}");
    println!("cargo:rerun-if-changed=build.rs");
    // git adds a line to this log with every commit and every checkout of another one: then build again.
    if let Some(log) = git(&["rev-parse", "--path-format=absolute", "--git-path", "logs/HEAD"]) {
        println!("cargo:rerun-if-changed={log}");
    }
}
