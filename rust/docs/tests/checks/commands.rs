//! Commands on pages.

use super::{checkout, found};
use msdd_docs::commands::{Settings, run};
use std::path::PathBuf;
use std::process::Command;

const GOOD: &str = "# A\n\n<!-- file: folder/a.txt -->\n```text\none\n$two\n```\n\n<!-- run -->\n```sh\ncd folder\nword=three\n```\n\n\
                    <!-- append: a.txt -->\n```text\nmore\n```\n\n<!-- run -->\n```sh\ntest \"$(cat a.txt)\" = 'one\n$two\nmore'\n\
                    echo $word > result\nbash -c 'false; true'\n```\n\n<!-- no run: it would delete all -->\n```sh\nfalse\n```\n\n<!-- run: slow -->\n\
                    ```sh\ntouch slow\nfalse\n```\n\n```text\nnothing is said about text\n```\n";

/// Runs the commands of one page in a checkout of git; what was found.
fn commands(name: &str, text: &str, slow: bool) -> Vec<String> {
    let root = checkout(&format!("commands-{name}"), &[("docs/src/a.md", text), ("scripts/foam-env", "")]);
    for arguments in [&["init", "-q"][..], &["add", "."]] {
        assert!(Command::new("git").args(arguments).current_dir(&root).status().unwrap().success());
    }
    let settings = Settings { work: root.join("work"), programs: root.clone(), root, slow, limit: 3 };
    found(run(&settings, &[PathBuf::from("docs/src/a.md")], |_| ()))
}

#[test]
fn a_page_is_one_shell_its_files_are_written_and_slow_blocks_run_when_they_are_asked_for() {
    assert_eq!(commands("good", GOOD, false), [""; 0]);
    let wrong = commands("slow", GOOD, true);
    assert!(wrong.len() == 1 && wrong[0].starts_with("docs/src/a.md:37: 'false' failed"), "{wrong:?}");
}

#[test]
fn a_command_that_fails_is_named_with_page_line_and_output_and_no_block_escapes() {
    let unsaid = "nothing is said about running these commands";
    let run = |line: &str| format!("<!-- run -->\n```sh\ntrue\n{line}\n```\n\nText\n");
    for (name, text, messages) in [
        ("exit", &run("echo hello; test 1 = 2"), ["docs/src/a.md:4: 'test 1 = 2' failed", "hello"]),
        ("unknown", &run("no-such-program --flag"), ["a.md:4: 'no-such-program --flag' failed", "not found"]),
        ("pipe", &run("false | cat"), ["docs/src/a.md:4: ", "failed"]),
        ("long", &run("sleep 30"), ["took more than 3 s", "docs/src/a.md"]),
        ("silent", &"```sh\ntrue\n```\n".into(), [unsaid, ""]),
        ("typo", &"<!-- runs -->\n```sh\ntrue\n```\n".into(), [unsaid, ""]),
        ("far", &"<!-- run -->\n\nText\n\n```sh\ntrue\n```\n".into(), [unsaid, ""]),
        ("how", &"<!-- run: quick -->\n```sh\ntrue\n```\n".into(), ["'run: quick' is not known", ""]),
        ("why", &"<!-- no run -->\n```sh\ntrue\n```\n".into(), ["has to say why", ""]),
        ("language", &"<!-- run -->\n```c\nint a;\n```\n".into(), ["a block of 'c' cannot be run", ""]),
        ("file", &"<!-- file: -->\n```c\nint a;\n```\n".into(), ["has to name a file", ""]),
    ] {
        let wrong = commands(name, text, false);
        assert!(wrong.len() == 1 && messages.iter().all(|message| wrong[0].contains(message)), "{wrong:?}");
    }
}
