//! Starts OpenFOAM's programs.

use msdd_rve::message::shortened;
use std::path::Path;
use std::process::Command;

/// The folder with `etc/` in Debian's package; OpenFOAM's programs need to know where it is.
const DEBIAN_PROJECT_DIR: &str = "/usr/share/openfoam";

/// A command that starts one of OpenFOAM's programs.
pub fn command(program: &Path) -> Command {
    let mut command = Command::new(program);
    // A PWD that is missing, or is not the folder of this process, makes OpenFOAM print a warning amid its output; it ends
    // in a folder that was deleted.
    match std::env::current_dir() {
        Ok(folder) => command.env("PWD", folder),
        Err(_) => command.current_dir("/").env("PWD", "/"),
    };
    if std::env::var_os("WM_PROJECT_DIR").is_none() {
        command.env("WM_PROJECT_DIR", DEBIAN_PROJECT_DIR);
    }
    command
}

/// The end of what a program has printed, on one line.
pub fn message(text: &str, folder: &Path) -> String {
    let text = text.rsplit_once("FATAL").map_or(text, |(_, rest)| rest);
    let words: Vec<&str> = text.split_whitespace().take(80).collect();
    shortened(&words.join(" ").replace(&format!("{}/", folder.display()), ""))
}
