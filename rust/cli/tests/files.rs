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
    refused(&folder, &format!("{GENERATE} a > /dev/full"), full);
    refused(&folder, "$msdd database check a > /dev/full", full);
    // Also when standard error cannot be written.
    let output = shell(&folder, "$msdd database check a > /dev/full 2> /dev/full");
    assert_eq!(output.status.code(), Some(1));
    good(&folder, "$msdd database check a");
    assert_eq!(names(&folder), ["a", "a.json", "plan.toml"]);
    // A reader that closes the pipe ends the program by the signal, 13.
    let line = "{ sleep 0.3; $msdd database check a; echo \"status $?\" >&2; } | true";
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
        let here =
            if command == PACK { "no name of a file" } else { ".: not an msdd database (it has files" };
        refused(&folder, &format!("{command} ."), here);
    }
    good(&folder, &format!("{GENERATE} a"));
    refused(&folder, "$msdd train --database a --out link", "link: is a symbolic link to victim");
    refused(&folder, "$msdd database export a --out link", "link: is a symbolic link to victim");
    assert_eq!(std::fs::read_to_string(folder.join("victim")).unwrap(), "precious");
    assert_eq!(names(&folder), ["a", "link", "plan.toml", "victim"]);
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
    good(&folder, &format!("{GENERATE} a"));
    refused(&folder, &format!("trap '' XFSZ; ulimit -f 1; {GENERATE} b"), "cannot write b/packing-");
    refused(&folder, "trap '' XFSZ; ulimit -f 1; $msdd database export a --out c.csv", "cannot write ");
    for kept in [&folder, &folder.join("b")] {
        assert!(names(kept).iter().all(|name| !name.ends_with(".part")), "{:?}", names(kept));
    }
    // The next run completes the database that it left.
    good(&folder, &format!("{GENERATE} b && diff -r a b"));
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
    let first = format!("{GENERATE} a > /dev/null 2>&1 & first=$!;");
    let wait =
        "until grep -q process a/shard-1-of-1.lock 2> /dev/null; do sleep 0.01; done; kill -STOP $first;";
    let second = format!("{GENERATE} a; code=$?; kill -KILL $first; exit $code");
    refused(&folder, &format!("{first} {wait} {second}"), "is at work on it");
}

#[test]
fn numbers_of_threads_have_a_range() {
    let folder = folder("threads");
    for threads in ["0", "1025", "99999999", "-1"] {
        for line in [&format!("{GENERATE} a"), "$msdd reference pack --case H"] {
            let output = shell(&folder, &format!("{line} --threads={threads}"));
            let text = stderr(&output);
            assert_eq!(output.status.code(), Some(2), "{text}");
            assert!(threads == "-1" || text.contains("is not in 1..=1024"), "{text}");
        }
    }
    good(&folder, &format!("{GENERATE} a --threads 1024"));
}

#[test]
fn what_check_refuses_is_refused_by_all() {
    let folder = folder("readers");
    good(&folder, &format!("{GENERATE} a"));
    let said = good(&folder, "$msdd database check a");
    assert!(said.contains("exact laws: hold on all"), "{said}");
    good(&folder, "$msdd database export a --out a.csv && sed -i 's/,0.01,/,0.0101,/' a.csv");
    let damaged = "a.csv: is damaged: ";
    refused(&folder, "$msdd database check a.csv", damaged);
    refused(&folder, "$msdd train --database a.csv --out model.json", damaged);
    refused(&folder, "$msdd database export a.csv --out b.csv", damaged);
    // Without its hash the file looks like one of version 0.2: the laws find the change.
    good(&folder, "sed -i 's/\"sha256\":\"[0-9a-f]*\",\\?//g; s/,}/}/' a.provenance.json");
    let problem = "a.csv: 1 violations of exact laws, the first: ";
    refused(&folder, "$msdd train --database a.csv --out model.json", problem);
    assert!(!folder.join("model.json").exists() && !folder.join("b.csv").exists());
}
