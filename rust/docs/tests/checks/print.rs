//! What is printed into pages, and what pages hold by hand of the sources.

use super::found;
use super::repository::root;
use msdd_docs::pages::Page;
use msdd_docs::print::{self, expanded, header};
use regex_lite::Regex;
use std::collections::BTreeSet;
use std::fs;
use std::path::Path;
use std::process::Command;

#[test]
fn a_marker_becomes_what_its_source_prints_and_lines_stay_those_of_the_page() {
    let page = Page::new("docs/src/a.md", "# A\n\n<!-- print: commands -->\n\nEnd.\n");
    let page = expanded(&root(), &page).unwrap();
    let line = |text: &str| page.line(page.text.find(text).unwrap());
    assert_eq!(["# A", "### msdd train", "End."].map(line), [1, 3, 5]);
}

#[test]
fn what_cannot_be_printed_is_named_with_page_and_line() {
    for (marker, message) in [
        ("<!-- print: nonsense a -->", "nothing is printed from 'nonsense', allowed: columns, commands, "),
        ("<!-- print: commands train -->", "'train': all commands are printed"),
        ("<!-- print: header none -->", "rust/capi/include/msdd.h has no section 'none', allowed: library, "),
        ("<!-- print: scripts scripts/none -->", "cannot read "),
        ("Text <!-- print: commands -->", "a line <!-- print: SOURCE ARGUMENT --> holds nothing else"),
    ] {
        let wrong = found(expanded(&root(), &Page::new("docs/src/a.md", format!("# A\n\n{marker}\n"))));
        assert!(
            wrong.len() == 1 && wrong[0].starts_with(&format!("docs/src/a.md:3: {message}")),
            "{wrong:?}"
        );
    }
}

/// A new section of the header needs a marker on the page.
#[test]
fn every_function_and_structure_of_the_header_is_on_its_page() {
    let text = fs::read_to_string(root().join(header::FILE)).unwrap();
    let page = print::page(&root(), Path::new("docs/src/reference/c-interface.md")).unwrap().text;
    let declared = text.lines().filter(|line| !line.starts_with([' ', '/', '#'])).flat_map(words);
    for name in declared.filter(|name| name.starts_with("msdd_")) {
        assert!(page.contains(&format!("\n### {name}\n")), "{name}");
    }
    assert!(page.contains("| `young_modulus` | `double` | E of the grains [Pa], 1e-9 to 1e15 |"));
}

/// Variables are read at many places in four languages, so their table is written by hand, unless the head of a script says
/// it. A variable that a test alone reads is explained by a comment of the file that reads it.
#[test]
fn every_environment_variable_of_this_project_is_on_the_page_or_explained_by_its_test() {
    let page = print::page(&root(), Path::new("docs/src/reference/commands.md")).unwrap().text;
    let read = r#"(?:(?:var|var_os|getEnv|getenv|environ\.get)\("|environ\["|\$\{?)(MSDD_\w+)"#;
    let read = Regex::new(read).unwrap();
    let comment = Regex::new(r#"(?m)^\s*(?://|#|""").*$"#).unwrap();
    for (path, text) in sources(&["rust", "openfoam", "scripts", "tests", "cases", ":!rust/docs"]) {
        let test = path.contains("tests/") || path.contains("_tests.");
        let comments: String = comment.find_iter(&text).filter(|_| test).map(|line| line.as_str()).collect();
        for name in read.captures_iter(&text) {
            let known = page.contains(&format!("`{}`", &name[1])) || comments.contains(&name[1]);
            assert!(known, "{path}: {}", &name[1]);
        }
    }
}

/// The names in code that the table of symbols gives are words of the sources.
#[test]
fn symbols_have_their_names_in_the_code() {
    let page = Page::read(&root(), Path::new("docs/src/theory/symbols.md")).unwrap().text;
    let sources = sources(&["rust", "openfoam", "cases", ":!rust/docs"]);
    let known: BTreeSet<&str> = sources.iter().flat_map(|(_, text)| words(text)).collect();
    let cells = page.lines().filter(|line| line.starts_with("| ")).filter_map(|line| line.rsplit('|').nth(1));
    for name in
        cells.flat_map(|cell| cell.split('`').skip(1).step_by(2)).flat_map(|name| name.split(['.', ' ']))
    {
        assert!(known.contains(name), "{name}");
    }
}

fn words(text: &str) -> impl Iterator<Item = &str> {
    text.split(|c: char| !(c.is_alphanumeric() || c == '_')).filter(|word| !word.is_empty())
}

/// Paths and texts of the sources in this checkout that `git` finds at these places.
pub fn sources(places: &[&str]) -> Vec<(String, String)> {
    let mut git = Command::new("git");
    git.args(["ls-files", "-co", "--exclude-standard"]).args(places);
    let files = String::from_utf8(git.current_dir(root()).output().unwrap().stdout).unwrap();
    let wanted = Regex::new(r"(?:^|/)[^./]+$|\.(?:rs|C|H|h|hpp|py|sh)$").unwrap();
    let text = |file: &str| Some((file.to_string(), fs::read_to_string(root().join(file)).ok()?));
    files.lines().filter(|file| wanted.is_match(file)).filter_map(text).collect()
}
