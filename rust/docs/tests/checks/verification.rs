//! The tables of closed forms in the book against the tests that they name.

use msdd_docs::pages::{self, Page};
use std::fs;
use std::path::Path;

/// Texts in backticks.
fn code(cell: &str) -> Vec<&str> {
    cell.split('`').skip(1).step_by(2).collect()
}

/// What is wrong with a line of the tables: `| problem | closed form | allowed | file, test |`.
fn problem(root: &Path, line: &str) -> Option<String> {
    let cells: Vec<&str> = line.split('|').collect();
    let [_, _, _, allowed, place, _] = cells[..] else { return Some(format!("not four cells: {line}")) };
    let [file, test] = code(place)[..] else { return Some(format!("no file and test: {line}")) };
    let Ok(text) = fs::read_to_string(root.join(file)) else { return Some(format!("no file {file}")) };
    if !text.contains(test) {
        return Some(format!("{file} has no '{test}'"));
    }
    let numbers = code(allowed);
    let missing =
        numbers.into_iter().filter(|text| text.parse::<f64>().is_ok()).find(|number| !text.contains(number));
    missing.map(|number| format!("{file} has no {number}"))
}

#[test]
fn every_closed_form_of_the_book_is_tested_where_it_says_and_as_narrowly() {
    let root = pages::checkout(Path::new(env!("CARGO_MANIFEST_DIR"))).unwrap();
    let page = Page::read(&root, Path::new("docs/src/quality/verification.md")).unwrap();
    let rows: Vec<&str> =
        page.text.lines().filter(|line| line.starts_with("| ") && !line.starts_with("| problem")).collect();
    assert!(rows.len() > 40, "{} rows", rows.len());
    let wrong: Vec<String> = rows.iter().filter_map(|row| problem(&root, row)).collect();
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

#[test]
fn a_wrong_line_is_found() {
    let root = pages::checkout(Path::new(env!("CARGO_MANIFEST_DIR"))).unwrap();
    let line = "| a | b | `1e-13` | `rust/dem/src/simulation/tests.rs`, `momentum_is_conserved` |";
    assert_eq!(problem(&root, line), None);
    for (from, to) in
        [("1e-13", "1e-133"), ("momentum_is", "momentum_was"), ("rust/dem", "rust/no"), ("| b ", "")]
    {
        assert!(problem(&root, &line.replace(from, to)).is_some(), "{to}");
    }
}
