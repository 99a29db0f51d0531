//! Files and standard output of the program under unusual conditions: links, full disks, closed pipes, damaged files.

use std::path::{Path, PathBuf};
use std::process::{Command, Output};

const PLAN: &str = "radius_min = 3e-3\nradius_max = 7e-3\nseed = 3\n\
    [[thermal]]\ndiscs = 40\nporosities = [0.16]\ncompressions = [\"isotropic\"]\nrepeats = 1\nstops = [0.01]\n";

fn folder(name: &str) -> PathBuf {
    let path = Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("files-{name}"));
    let _ = std::fs::remove_dir_all(&path);
    std::fs::create_dir_all(&path).unwrap();
    std::fs::write(path.join("plan.toml"), PLAN).unwrap();
    path
}

/// Runs a line of the shell in the folder, with the program as `$msdd`.
fn shell(folder: &Path, line: &str) -> Output {
    let mut command = Command::new("bash");
    command.args(["-c", line]).current_dir(folder).env("msdd", env!("CARGO_BIN_EXE_msdd"));
    command.output().unwrap()
}

fn stderr(output: &Output) -> String {
    String::from_utf8_lossy(&output.stderr).into_owned()
}

fn good(folder: &Path, line: &str) -> String {
    let output = shell(folder, line);
    assert!(output.status.success(), "{line}: {}", stderr(&output));
    String::from_utf8_lossy(&output.stdout).into_owned() + &stderr(&output)
}

/// Status 1, and the problem on standard error.
fn refused(folder: &Path, line: &str, problem: &str) {
    let output = shell(folder, line);
    let text = stderr(&output);
    assert_eq!(output.status.code(), Some(1), "{line}: {text}");
    assert!(text.contains(problem) && !text.contains("panicked"), "{line}: {text}");
}

fn names(folder: &Path) -> Vec<String> {
    let entries = std::fs::read_dir(folder).unwrap();
    let mut names: Vec<String> =
        entries.map(|entry| entry.unwrap().file_name().into_string().unwrap()).collect();
    names.sort();
    names
}

const PACK: &str = "$msdd rve pack --discs 40 --porosity 0.16 --out";
const GENERATE: &str = "$msdd database generate --plan plan.toml --out";

#[test]
fn a_full_standard_output_ends_with_an_error_and_the_files_are_written() {
    let folder = folder("stdout");
    let full = "cannot write to standard output: No space left on device";
    refused(&folder, &format!("{PACK} a.json > /dev/full"), full);
    refused(&folder, "$msdd rve homogenise --state a.json > /dev/full", full);
    refused(&folder, &format!("{GENERATE} a.msdd > /dev/full"), full);
    refused(&folder, "$msdd database check a.msdd > /dev/full", full);
    // Also when standard error cannot be written.
    let output = shell(&folder, "$msdd database check a.msdd > /dev/full 2> /dev/full");
    assert_eq!(output.status.code(), Some(1));
    good(&folder, "$msdd database check a.msdd");
    assert_eq!(names(&folder), ["a.json", "a.msdd", "plan.toml"]);
    // A reader that closes the pipe ends the program by the signal, 13.
    let line = "{ sleep 0.3; $msdd database check a.msdd; echo \"status $?\" >&2; } | true";
    assert_eq!(stderr(&shell(&folder, line)), "status 141\n");
}

#[test]
fn links_and_devices_as_out_are_refused_before_the_work() {
    let folder = folder("links");
    std::fs::write(folder.join("victim"), "precious").unwrap();
    std::os::unix::fs::symlink("victim", folder.join("link")).unwrap();
    for command in [PACK, GENERATE] {
        refused(&folder, &format!("{command} link"), "link: is a symbolic link to victim");
        refused(&folder, &format!("{command} /dev/null"), "/dev/null: is a device");
        refused(&folder, &format!("{command} ."), "no name of a file");
    }
    good(&folder, &format!("{GENERATE} a.msdd"));
    refused(&folder, "$msdd train --database a.msdd --out link", "link: is a symbolic link to victim");
    refused(&folder, "$msdd database export a.msdd --out link", "link: is a symbolic link to victim");
    assert_eq!(std::fs::read_to_string(folder.join("victim")).unwrap(), "precious");
    assert_eq!(names(&folder), ["a.msdd", "link", "plan.toml", "victim"]);
}

/// A limit on the size of files stands for a full disk.
#[test]
fn a_full_disk_leaves_the_old_file_and_no_part() {
    let folder = folder("disk");
    good(&folder, &format!("{PACK} a.json"));
    let old = std::fs::read(folder.join("a.json")).unwrap();
    let full = "trap '' XFSZ; ulimit -f 4;";
    refused(&folder, &format!("{full} {PACK} a.json --seed 2"), "cannot write a.json: File too large");
    assert_eq!(std::fs::read(folder.join("a.json")).unwrap(), old);
    good(&folder, &format!("{GENERATE} a.msdd"));
    let before = std::fs::read(folder.join("a.msdd")).unwrap();
    refused(&folder, &format!("{full} {GENERATE} b.msdd"), "b.msdd: ");
    refused(&folder, &format!("{full} $msdd database merge a.msdd --out c.msdd"), "c.msdd: ");
    refused(&folder, &format!("{full} $msdd database export a.msdd --out c.csv"), "cannot write ");
    assert_eq!(std::fs::read(folder.join("a.msdd")).unwrap(), before);
    assert!(names(&folder).iter().all(|name| !name.ends_with(".part")), "{:?}", names(&folder));
    // The next run completes the database that it left.
    good(&folder, &format!("{GENERATE} b.msdd"));
    assert_eq!(std::fs::read(folder.join("b.msdd")).unwrap(), before);
}

#[test]
fn names_that_mean_something_to_sqlite_are_files() {
    let folder = folder("names");
    for name in [":memory:", "'file:x?mode=memory'"] {
        good(&folder, &format!("{GENERATE} {name} && $msdd database check {name}"));
    }
    assert_eq!(names(&folder), [":memory:", "file:x?mode=memory", "plan.toml"]);
}

#[test]
fn two_writers_of_one_state_both_succeed_and_two_generators_do_not_meet() {
    let folder = folder("two");
    // By their numbers: 'wait -n' forgets a process that ended before it was called.
    let line = format!("{PACK} a.json & one=$!; {PACK} a.json --seed 2 & two=$!; wait $one && wait $two");
    good(&folder, &line);
    good(&folder, "$msdd rve homogenise --state a.json");
    let plan = PLAN.replace("repeats = 1", "repeats = 200");
    std::fs::write(folder.join("plan.toml"), plan).unwrap();
    // The first process is stopped (SIGSTOP) as soon as it holds the lock, so that the second certainly finds it locked.
    let first = format!("{GENERATE} a.msdd > /dev/null 2>&1 & first=$!;");
    let wait = "until grep -q process a.msdd.lock 2> /dev/null; do sleep 0.01; done; kill -STOP $first;";
    let second = format!("{GENERATE} a.msdd; code=$?; kill -KILL $first; exit $code");
    refused(&folder, &format!("{first} {wait} {second}"), "is at work on it");
}

#[test]
fn numbers_of_threads_have_a_range() {
    let folder = folder("threads");
    for threads in ["0", "1025", "99999999", "-1"] {
        for line in [&format!("{GENERATE} a.msdd"), "$msdd bench dem", "$msdd reference pack --case H"] {
            let output = shell(&folder, &format!("{line} --threads={threads}"));
            let text = stderr(&output);
            assert_eq!(output.status.code(), Some(2), "{text}");
            assert!(threads == "-1" || text.contains("is not in 1..=1024"), "{text}");
        }
    }
    good(&folder, &format!("{GENERATE} a.msdd --threads 1024"));
}

#[test]
fn what_check_refuses_is_refused_by_all_and_older_files_are_warned_of() {
    let folder = folder("readers");
    good(&folder, &format!("{GENERATE} a.msdd"));
    let said = good(&folder, "$msdd database check a.msdd");
    assert!(said.contains("checksums: agree"), "{said}");
    let csv = good(&folder, "$msdd database export a.msdd --out a.csv && cat a.csv");
    assert!(!csv.contains("warning"), "{csv}");
    good(&folder, "sed -i 's/,0.01,/,0.0101,/' a.csv");
    let damaged = "a.csv: is damaged: ";
    refused(&folder, "$msdd database check a.csv", damaged);
    refused(&folder, "$msdd train --database a.csv --out model.json", damaged);
    refused(&folder, "$msdd database plot a.csv --out plots", damaged);
    refused(&folder, "$msdd database export a.csv --out b.csv", damaged);
    assert!(!folder.join("model.json").exists() && !folder.join("b.csv").exists());
    // Remove the checksums, so that the file looks like one of an older program.
    good(&folder, "sed -i 's/\"[a-z]*_sha256\":\"[0-9a-f]*\",\\?//g; s/,}/}/' a.provenance.json");
    refused(&folder, "$msdd train --database a.csv --out model.json", "warning: a.csv has no checksums");
    refused(
        &folder,
        "$msdd train --database a.csv --out model.json",
        "a.csv: 1 violations of exact laws, the first: ",
    );
    good(&folder, "$msdd database export a.msdd --out a.csv");
    good(&folder, "sed -i 's/\"[a-z]*_sha256\":\"[0-9a-f]*\",\\?//g; s/,}/}/' a.provenance.json");
    let said = good(&folder, "$msdd database check a.csv");
    assert!(said.contains("checksums: there are none"), "{said}");
    good(&folder, "$msdd database seal a.csv");
    let said = good(&folder, "$msdd database check a.csv");
    assert!(said.contains("checksums: agree"), "{said}");
}
