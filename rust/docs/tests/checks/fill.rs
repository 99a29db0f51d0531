//! Numbers and tables between marks.

use super::{checkout, found};
use msdd_docs::fill::fill;
use msdd_docs::results::Results;
use std::fs;
use std::path::PathBuf;

const RESULTS: &str = r#"{"schema": "msdd-results-1", "sections": {"cases": {
    "command": "scripts/results cases", "commit": "0123abc", "date": "2026-01-02", "values": {
        "H.T": {"value": "0.74", "unit": "%", "meaning": "error of T", "source": "results/summary.json"},
        "rows": {"value": "19 706", "unit": "1", "meaning": "rows", "source": "a.json"}},
    "tables": {"first": {"meaning": "all", "source": "a.json", "columns": ["case", "T"], "rows": [["H", "1.0"], ["C", "2.5 (0.4)"]]}}
}}}"#;

/// Fills `text` in as README.md next to [`RESULTS`]; the text afterwards and what was found.
fn filled(name: &str, text: &str, check: bool) -> (String, Vec<String>) {
    let root = checkout(name, &[("README.md", text), ("docs/results.json", RESULTS)]);
    let found = found(fill(&root, &[PathBuf::from("README.md")], check));
    (fs::read_to_string(root.join("README.md")).unwrap(), found)
}

#[test]
fn numbers_and_tables_are_renewed_and_a_check_names_file_line_key_text_and_value() {
    let code = "Write `<!--= some.key-->` or\n\n```\n<!--= other.key-->\n```\n\n    <!--/-->\n";
    assert_eq!(filled("code", code, false), (code.to_string(), Vec::new()));
    let old = "One.\n\nOff by <!--= cases.H.T-->9<!--/--> %, of <!--=cases.rows--><!--/--> rows.\n\n<!--= table:first-->\nold\n<!--/-->\n";
    let (text, wrong) = filled("check", old, true);
    assert_eq!((text.as_str(), wrong.len()), (old, 3));
    let message = "is '9' in the text, '0.74' in docs/results.json: run msdd-docs fill";
    assert_eq!(wrong[0], format!("README.md:3: 'cases.H.T' {message}"));
    let (text, wrong) = filled("renewed", old, false);
    assert_eq!(
        text,
        "One.\n\nOff by <!--= cases.H.T-->0.74<!--/--> %, of <!--=cases.rows-->19 706<!--/--> rows.\n\n<!--= table:first-->\n\n\
         | case | T |\n|---|---|\n| H | 1.0 |\n| C | 2.5 (0.4) |\n\n<!--/-->\n"
    );
    assert_eq!((wrong, filled("agree", &text, true)), (Vec::new(), (text.clone(), Vec::new())));
    let ranges = "T <!--= range:first@T-->1<!--/-->, of C <!--= range:first@T@C--><!--/--> (<!--= range:first@T ()--><!--/-->)\n";
    let filled_in = "T <!--= range:first@T-->1.0 to 2.5<!--/-->, of C <!--= range:first@T@C-->2.5<!--/--> (<!--= range:first@T ()-->0.4<!--/-->)\n";
    assert_eq!(filled("ranges", ranges, false), (filled_in.to_string(), Vec::new()));
    let (_, wrong) = filled("cell", &text.replace("2.5", "2.4"), true);
    assert!(wrong.len() == 1 && wrong[0].contains("'table:first' is"), "{wrong:?}");
}

#[test]
fn marks_that_lead_nowhere_are_errors_and_nothing_is_written() {
    for (name, text, message) in [
        ("unknown", "a <!--= cases.H.x-->1<!--/-->", "has no number 'cases.H.x'"),
        ("no-column", "a <!--= range:first@p-->1<!--/-->", "has no numbers 'first@p'"),
        ("no-row", "a <!--= range:first@T@D-->1<!--/-->", "has no numbers 'first@T@D'"),
        ("no-table", "<!--= table:second-->\n<!--/-->", "has no table 'second'"),
        ("unclosed", "a <!--= cases.H.T-->1 b", "the mark of 'cases.H.T' is not closed"),
        ("next-open", "a <!--= cases.H.T-->1 <!--= cases.rows-->2<!--/-->", "'cases.H.T' is not closed"),
        ("no-end", "a <!--= cases.H.T", "is not ended by -->"),
        ("no-open", "a 1<!--/--> b", "without a mark before it"),
        ("in-line", "a <!--= table:first-->1<!--/-->", "lines of their own"),
        ("line-begin", "<!--= cases.H.T-->1<!--/--> % is little.", "begins a line"),
        ("item-begin", "- <!--= cases.H.T-->1<!--/--> % is little.", "begins a line"),
    ] {
        let whole = format!("b <!--= cases.rows-->1<!--/-->\n\n{text}\n");
        let (after, wrong) = filled(name, &whole, false);
        let named = wrong.len() == 1 && wrong[0].contains(message) && wrong[0].starts_with("README.md:3: ");
        assert!(named && after == whole, "{wrong:?}");
    }
}

#[test]
fn results_of_another_form_are_refused() {
    for (name, from, to, message) in [
        ("schema", "msdd-results-1", "msdd-results-2", "allowed: msdd-results-1"),
        ("cells", r#"["C", "2.5 (0.4)"]"#, r#"["C"]"#, "has 1 cells, allowed: 2"),
        ("bar", "19 706", "19|706", "cases.rows is '19|706'"),
        ("field", r#""unit": "1""#, r#""units": "1""#, "unknown field `units`"),
    ] {
        let root = checkout(name, &[("docs/results.json", &RESULTS.replace(from, to))]);
        let error = Results::read(&root).unwrap_err().to_string();
        assert!(error.contains(message) && error.contains("docs/results.json"), "{error}");
    }
}
