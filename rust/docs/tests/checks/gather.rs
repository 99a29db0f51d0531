//! Sections of the results, from files as programs write them.

use super::checkout;
use msdd_docs::gather::{Origin, renew};
use msdd_docs::pages;
use msdd_docs::results::Results;
use serde_json::{Value, json};
use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};

const CASES: [&str; 6] = ["H", "C", "HC", "Hstar", "Cstar", "HCstar"];

fn origin() -> Origin {
    Origin { commit: "0123abc".to_string(), date: "2026-01-02".to_string(), machine: "a machine".to_string() }
}

/// A checkout with these inputs and this project's cases.
fn with_cases(name: &str, files: &[(&str, &str)]) -> PathBuf {
    let root = checkout(&format!("gather-{name}"), files);
    let cases = pages::checkout(Path::new(env!("CARGO_MANIFEST_DIR"))).unwrap().join("cases");
    std::os::unix::fs::symlink(cases, root.join("cases")).unwrap();
    root
}

/// What `msdd summary` writes for runs that find the first packing's discs, `offset` [K] warmer at P2.
fn summary(offset: f64) -> String {
    let cases = pages::checkout(Path::new(env!("CARGO_MANIFEST_DIR"))).unwrap().join("cases");
    let mut all = BTreeMap::new();
    for case in CASES {
        let text = fs::read_to_string(cases.join(format!("reference/results/{case}_seed1.json"))).unwrap();
        let discs: Value = serde_json::from_str(&text).unwrap();
        let columns = discs["series"]["columns"].as_array().unwrap();
        let rows = discs["series"]["rows"].as_array().unwrap();
        let series = |probe: usize| -> Vec<Value> {
            let column = columns.iter().position(|c| c == &format!("T_P{probe}_window")).unwrap();
            let value = |row: &Value| row[column].as_f64().unwrap() + if probe == 2 { offset } else { 0.0 };
            rows.iter().skip(1).map(|row| json!([row[0], value(row)])).collect()
        };
        let end =
            json!({"porosity": 0.1, "conductivity_xx": 40.0, "conductivity_yy": 30.0, "pressure": 3000.0});
        all.insert(
            case,
            json!({"probes": {"P1": series(1), "P2": series(2), "P3": series(3)}, "final": end}),
        );
    }
    json!({ "cases": all }).to_string()
}

fn seconds() -> String {
    let each: BTreeMap<&str, f64> = CASES.iter().map(|case| (*case, 12.34)).collect();
    json!({"paper": each, "moving": each}).to_string()
}

#[test]
fn errors_of_cases_are_shares_of_the_range() {
    let (paper, moving, seconds) = (summary(1.0), summary(-0.25), seconds());
    let files = [
        ("results/numbers/paper.json", paper.as_str()),
        ("results/numbers/moving.json", moving.as_str()),
        ("results/numbers/seconds.json", seconds.as_str()),
    ];
    let root = with_cases("cases", &files);
    renew(&root, "cases", origin()).unwrap();
    let results = Results::read(&root).unwrap();
    let value = |key: &str| results.value(key).unwrap_or_else(|| panic!("no {key}")).value.clone();
    assert_eq!(value("cases.H.paper.error"), "2.0"); // 1 K of 50 K
    assert_eq!(value("cases.HC.paper.error"), "1.0"); // of 100 K
    assert_eq!(value("cases.HC.moving.error"), "0.2"); // 0.25 of 100 K
    assert_eq!(value("cases.H.paper.seconds"), "12");
    assert_eq!(value("cases.H.paper.pressure"), "3.00");
    let first = results.table("first").unwrap();
    assert_eq!((first.columns.len(), first.rows.len()), (7, 4));
    assert_eq!(first.rows[0][1], "2.0 % in 12 s");
    let section = &results.sections["cases"];
    assert_eq!(
        [&section.command, &section.commit, &section.machine],
        ["scripts/results cases", "0123abc", "a machine"]
    );
}

#[test]
fn a_section_renewed_leaves_the_others_and_missing_entries_are_named() {
    let witness = "engines: msdd against YADE\nat 0.02 1/s in both engines; allowed\nstrain  0.01  p 3987.0 Pa  f 0.0380  differences:  \
                   pressure 1.2e-05  stress.xx 2.4e-05  stress.yy 4.0e-06  fabric_index 2.0e-06  porosity 1.0e-07\n\
                   at msdd's own rates; allowed\nstrain -0.01  p 2860.0 Pa  f 0.0380  differences:  pressure 1.0e-04  \
                   stress.xx 2.0e-04  stress.yy 2.0e-05  fabric_index 7.0e-04  porosity 1.0e-07\nengines: passed\n";
    let other = r#"{"schema": "msdd-results-1", "sections": {"other": {"command": "a", "commit": "b", "date": "c",
        "values": {"k": {"value": "1", "unit": "1", "meaning": "m", "source": "s"}}, "tables": {}}}}"#;
    let root =
        checkout("gather-witness", &[("results/numbers/witness.txt", witness), ("docs/results.json", other)]);
    renew(&root, "witness", origin()).unwrap();
    let results = Results::read(&root).unwrap();
    assert_eq!(results.value("other.k").unwrap().value, "1");
    assert_eq!(results.value("witness.same.stress").unwrap().value, "2e-5");
    assert_eq!(
        results.table("witness").unwrap().rows[1][..3],
        ["each its own rate", "-1 %", "2.86"].map(str::to_string)
    );

    let before = fs::read_to_string(root.join("docs/results.json")).unwrap();
    fs::write(root.join("results/numbers/witness.txt"), witness.replace("fabric_index", "fabric")).unwrap();
    let error = renew(&root, "witness", origin()).unwrap_err().to_string();
    assert!(error.contains("witness.txt"), "{error}");
    let error = renew(&root, "none", origin()).unwrap_err().to_string();
    assert!(error.contains("allowed: cases, database"), "{error}");
    assert_eq!(fs::read_to_string(root.join("docs/results.json")).unwrap(), before);
}

#[test]
fn a_quick_report_is_refused() {
    let root = checkout(
        "gather-report",
        &[("results/report.json", r#"{"schema": "msdd-report-1", "quick": true}"#)],
    );
    let error = renew(&root, "report", origin()).unwrap_err().to_string();
    assert!(error.contains("results/report.json") && error.contains("allowed: the whole report"), "{error}");
}
