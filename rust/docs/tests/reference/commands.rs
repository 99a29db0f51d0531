//! Commands with their options, scripts and environment variables.

use crate::set::{Cell, Set};
use crate::sources::{all, checkout, files, firsts, text};
use regex::Regex;
use std::collections::BTreeSet;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::time::SystemTime;

const PAGE: &str = "reference/commands.md";

/// Options that every program of OpenFOAM has; those worth a line.
const OF_OPENFOAM: [(&str, &str); 6] = [
    ("-case", "argList"),
    ("-parallel", "argList"),
    ("-decomposeParDict", "argList"),
    ("-noFunctionObjects", "argList"),
    ("-help", "argList"),
    ("-help-full", "argList"),
];

/// Arguments of scripts that are not compared with a word there.
const POSITIONAL: [(&str, &str); 5] = [
    ("scripts/results SECTION …", "compared with a list"),
    ("scripts/compare-engines STATE", "the first argument, a path"),
    ("scripts/train-default DIR", "the first argument, a path"),
    ("scripts/foam-env build", "compared with a word by [, not by case"),
    ("cases/reference/make SEED …", "all arguments"),
];

/// Defaults that depend on the machine.
const OF_MACHINE: [&str; 4] =
    ["msdd reference pack", "msdd reference run", "msdd reference fields", "msdd case new"];

pub fn sets() -> Vec<Set> {
    let program = program();
    let mut sets: Vec<Set> = Vec::new();
    add_commands(&program, &[], &mut sets);
    sets.extend([solver(), scripts(), script_options(), environment()]);
    sets
}

/// `msdd` beside this test, which `cargo test --workspace` builds before it runs any.
fn program() -> PathBuf {
    let test = std::env::current_exe().expect("this test");
    let program = test.ancestors().nth(2).expect("deps is in a folder").join("msdd");
    let time =
        |path: &Path| path.metadata().and_then(|data| data.modified()).unwrap_or(SystemTime::UNIX_EPOCH);
    let newest = files("rust/cli/src", &["rs"]).iter().map(|(path, _)| time(&checkout().join(path))).max();
    assert!(
        newest.is_some_and(|newest| newest <= time(&program)),
        "{} is missing or older than rust/cli/src: build it with cargo build --release --bin msdd",
        program.display()
    );
    program
}

fn help_of(program: &Path, path: &[&str]) -> String {
    let output = Command::new(program).args(path).arg("--help").output().expect("msdd runs");
    assert!(output.status.success(), "msdd {path:?} --help failed");
    String::from_utf8(output.stdout).expect("text")
}

fn add_commands(program: &Path, path: &[&str], sets: &mut Vec<Set>) {
    let help = help_of(program, path);
    let names = firsts(r"(?m)^  (\S+) ", &section(&help, "Commands"));
    for name in names.iter().filter(|name| *name != "help") {
        add_commands(program, &[path, &[name.as_str()]].concat(), sets);
    }
    if names.is_empty() {
        sets.push(command(&format!("msdd {}", path.join(" ")), &help));
    }
}

/// A part of the help, from its title to the next line that is not indented.
fn section(help: &str, title: &str) -> String {
    let lines = help.lines().skip_while(|line| *line != format!("{title}:")).skip(1);
    lines.take_while(|line| line.is_empty() || line.starts_with(' ')).collect::<Vec<_>>().join("\n") + "\n"
}

/// Options and arguments of a command, under whatever title, with defaults and possible values.
fn command(name: &str, help: &str) -> Set {
    let usage = firsts("(?m)^Usage: (.*)$", help).join(" ");
    let start = Regex::new(r"(?m)^ {2,6}(?:-\w, )?(--[\w-]+|<\w+>|\[\w+\])").expect("a pattern");
    let starts: Vec<(String, usize)> = start
        .captures_iter(help)
        .map(|found| (found[1].to_string(), found.get(0).map_or(0, |m| m.start())))
        .collect();
    let ends = starts.iter().skip(1).map(|(_, place)| *place).chain([help.len()]);
    // What follows a blank line belongs to the next title.
    let part = |start: usize, end: usize| help[start..end].split("\n\n").next().unwrap_or_default();
    let options: Vec<(&str, &str)> = starts
        .iter()
        .zip(ends)
        .map(|((option, start), end)| (option.as_str(), part(*start, end)))
        .filter(|(option, _)| *option != "--help")
        .collect();
    let source = format!("`{name} --help`");
    let mut set = Set::new(PAGE, name, &source, options.iter().map(|(option, part)| argument(option, part)));
    for (option, part) in &options {
        set = with_help(set, name, &argument(option, part), part, &usage);
    }
    set
}

/// `<FILE>...` of an argument that may be given several times.
fn argument(option: &str, part: &str) -> String {
    if part.contains(&format!("{option}...")) { format!("{option}...") } else { option.to_string() }
}

fn with_help(mut set: Set, name: &str, option: &str, part: &str, usage: &str) -> Set {
    let part = part.split_whitespace().collect::<Vec<_>>().join(" ");
    if let Some(values) = firsts(r"\[possible values: ([^\]]*)\]", &part).pop() {
        let values: Vec<String> = values.split(", ").map(str::to_string).collect();
        set = set.with_words(option, "allowed", &values);
    }
    let of_machine = OF_MACHINE.contains(&name) && option == "--threads";
    if let Some(default) = firsts(r"\[default: ([^\]]+)\]", &part).pop().filter(|_| !of_machine) {
        set = set.with(option, "default", Cell::Text(default));
    }
    if all(r"<?[\w-]+>?", usage).iter().any(|word| word[0] == option.trim_end_matches('.')) {
        set = set.with(option, "default", Cell::Text("required".to_string()));
    }
    set
}

fn solver() -> Set {
    const SOURCE: &str = "openfoam/msddFoam/msddFoam.C";
    let own = firsts(r#"argList::add(?:Bool)?Option\s*\(\s*"([\w-]+)""#, &text(SOURCE));
    let options = own.into_iter().map(|option| format!("-{option}"));
    Set { table: "msddFoam options".to_string(), ..Set::new(PAGE, "options", SOURCE, options) }
        .and(&OF_OPENFOAM)
}

/// Files of scripts, and the scripts of cases and of the solver.
fn scripts() -> Set {
    let folder = std::fs::read_dir(checkout().join("scripts")).expect("the scripts");
    let names =
        folder.map(|entry| format!("scripts/{}", entry.expect("a file").file_name().to_string_lossy()));
    let solver = ["openfoam/Allwmake", "openfoam/Allwclean"].map(str::to_string);
    let cases = ["cases/<name>/Allrun", "cases/<name>/Allclean", "cases/reference/make"].map(str::to_string);
    assert!(
        checkout().join("cases/reference/make").is_file() && checkout().join("cases/H/Allclean").is_file()
    );
    Set::new(PAGE, "scripts", "scripts, openfoam, cases", names.chain(solver).chain(cases))
}

/// Words with which `case` compares an argument. A row is named by script and option.
fn script_options() -> Set {
    let mut names = Vec::new();
    for (path, text) in files("scripts", &[""]).into_iter().chain(files("cases/common", &[""])) {
        let script = if path == "cases/common/run" { "cases/<name>/Allrun" } else { &path };
        for option in firsts(r"(?m)(?:^|[\s|])(-{1,2}[a-z]{3,}[\w-]*)\)", &text) {
            names.push(format!("{script} {option}"));
        }
    }
    Set::new(PAGE, "options of scripts", "scripts, cases/common/run", names).and(&POSITIONAL)
}

fn environment() -> Set {
    let mut names = BTreeSet::new();
    for (_, text) in files("rust", &["rs", "py"]).iter().chain(&files("openfoam", &["C", "H"])) {
        names.extend(firsts(
            r#"(?:env::var|env::var_os|option_env!|getEnv|environ\.get|getenv|environ)[(\[]"(\w+)""#,
            text,
        ));
        names.extend(firsts(r#"const char\* const \w+ = "(MSDD_\w+)""#, text));
    }
    for folder in ["scripts", "tests", "cases", "openfoam"] {
        for (_, text) in files(folder, &["", "sh", "py"]) {
            names.extend(firsts(r"\$\{([A-Z][A-Z_]+):-", &text));
            names.extend(firsts(r"\$[({]?(MSDD_[A-Z_]+)", &text));
        }
    }
    // Set by the build itself.
    for (_, text) in files("rust", &["rs"]) {
        firsts(r"cargo:rustc-env=(\w+)", &text).iter().for_each(|name| {
            names.remove(name);
        });
    }
    // Of the machine, not of this program.
    for name in ["PATH", "LD_LIBRARY_PATH"] {
        names.remove(name);
    }
    Set::new(PAGE, "environment", "sources, scripts and cases", names)
}
