//! The tables of closed forms in the book against the tests that they name.

use super::repository::root;
use msdd_docs::pages::Page;
use regex_lite::Regex;
use std::fs;
use std::path::Path;

/// Folders of files in the tables that do not begin with one of the checkout: of tests in Rust, and of others.
const RUST: &str = "rust/surrogate/src/increment/";
const CHECKS: &str = "tests/openfoam/checks/";

/// What is wrong with a line of the tables: `| problem | closed form | allowed | file, test |`.
fn problem(line: &str) -> Option<String> {
    let form = Regex::new(r"^\|[^|]+\|[^|]+\|([^|]+)\| `([^`]+)`, `([^`]+)` \|$").unwrap();
    let Some(cells) = form.captures(line) else { return Some(format!("not four cells: {line}")) };
    let folder = match &cells[2] {
        whole if whole.starts_with("rust/") || whole.starts_with("tests/") => "",
        rust if rust.ends_with(".rs") => RUST,
        _ => CHECKS,
    };
    let file = format!("{folder}{}", &cells[2]);
    let text = fs::read_to_string(root().join(&file)).unwrap_or_default();
    let numbers = cells[1].split('`').skip(1).step_by(2).filter(|code| code.parse::<f64>().is_ok());
    let missing = numbers.chain([&cells[3]]).find(|code| !text.contains(code));
    missing.map(|code| format!("{file} has no '{code}'"))
}

#[test]
fn every_closed_form_of_the_book_is_tested_where_it_says_and_as_narrowly() {
    let page = Page::read(&root(), Path::new("docs/src/quality/verification.md")).unwrap().text;
    let rows = page.lines().filter(|line| line.starts_with("| ") && !line.starts_with("| problem"));
    let rows: Vec<&str> = rows.collect();
    assert!(rows.len() > 40, "{} rows", rows.len());
    let wrong: Vec<String> = rows.iter().filter_map(|row| problem(row)).collect();
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
    let right = "| a | b | `1e-13` | `rust/dem/src/simulation/tests.rs`, `momentum_is_conserved` |";
    for (from, to) in [("1e-13", "1e-133"), ("m_is", "m_was"), ("rust/dem", "rust/no"), ("| b ", "")] {
        assert!(problem(right).is_none() && problem(&right.replace(from, to)).is_some(), "{to}");
    }
}
