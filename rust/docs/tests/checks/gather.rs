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

/// What `msdd summary` writes, made small: of each case a value at 4.9, 5 and 20 s.
fn summary() -> String {
    let series = |value: f64| json!([[4.9, value - 1.0], [5.02, value], [20.0, value + 1.0]]);
    let probes = json!({"P1": series(70.04), "P2": series(50.0), "P3": series(38.96)});
    let end =
        json!({"porosity": 0.1194, "conductivity_xx": 40.0, "conductivity_yy": 30.0, "pressure": 2984.0});
    let band = |value: f64| json!([[0.0, 50.0, 0.0], [5.0, value, 0.25], [20.0, value, 0.1]]);
    let discs =
        json!({"temperature": {"P1": band(71.0), "P2": band(50.0), "P3": band(34.5)}, "scatter": 0.34});
    let run = json!({"probes": probes, "final": end, "cpu_seconds": 12.34});
    let errors = |largest: f64| json!({"temperature": [0.5, -0.1, largest]});
    let comparison = json!({"discs": discs, "grains_stay": errors(-4.46), "grains_move": errors(0.3)});
    let of_all = |value: &Value| CASES.iter().map(|case| (*case, value.clone())).collect::<BTreeMap<_, _>>();
    json!({"cases": of_all(&run), "moving": of_all(&run), "comparison": of_all(&comparison)}).to_string()
}

#[test]
fn cases_stand_beside_discs_and_the_paper() {
    let root = with_cases("cases", &[("results/summary.json", summary().as_str())]);
    renew(&root, "cases", origin()).unwrap();
    let results = Results::read(&root).unwrap();
    let value = |key: &str| results.value(key).unwrap_or_else(|| panic!("no {key}")).value.clone();
    assert_eq!([value("cases.H.paper.error"), value("cases.HC.moving.error")], ["4.5", "0.5"]);
    assert_eq!([value("cases.H.paper.T_P1"), value("cases.H.discs.T_P3")], ["70.0", "34.5 ± 0.2"]);
    assert_eq!([value("cases.H.paper.seconds"), value("cases.H.paper.pressure")], ["12", "2.98"]);
    let first = results.table("first").unwrap();
    assert_eq!((first.columns.len(), first.rows.len()), (4, 4));
    assert_eq!(results.table("errors").unwrap().columns.len(), 7);
    assert_eq!(
        [&first.rows[0][1], &first.rows[2][1], &first.rows[3][3]],
        ["4.5 % in 12 s", "± 0.3 %", "6.5 % in 40 s"]
    );
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
    assert!(error.contains("allowed: beds, cases, database"), "{error}");
    assert_eq!(fs::read_to_string(root.join("docs/results.json")).unwrap(), before);
}

#[test]
fn beds_of_spheres_are_five_tables() {
    let errors = "scene,use,packings,T_error,T_scatter,pressure_error,pressure_scatter,conductivity_error,conductivity_scatter\n\
                  a-bed,judge,3,0.371,0.16,4.9,4.12,1.831,1.37\n";
    let bands: String = ["T", "pressure", "conductivity"]
        .iter()
        .flat_map(|name| {
            ["calibrate", "judge", "outside"].map(|of| format!("{name},{of},60,0.912,0.85,1.449\n"))
        })
        .collect();
    let bands = format!("quantity,use,values,inside,inside_worst_scene,width\n{bands}");
    let names = ["T at the probes", "stress 1", "stress 2", "stress 3", "p", "K", "stress on the wall"];
    let line = |name: &&str| format!("{name:<22}       20     0.85    -1.36      0.21 %\n");
    let beside = "solver less elements     points      rms    worst  packings\n".to_string()
        + &names.iter().map(line).collect::<String>();
    let give = r#"[{"name": "kept", "packings": 2, "give": [null, null], "back": [null, null]},
        {"name": "path", "packings": 2, "give": [1.5, 0.25], "back": [0.1, 0.02]},
        {"name": "press", "packings": 1, "give": [1.0, null], "back": [null, null]}]"#;
    let root = checkout(
        "gather-beds",
        &[
            ("cases/beds/errors.csv", errors),
            ("cases/beds/bands.csv", &bands),
            ("results/numbers/column.txt", &beside),
            ("results/numbers/store.txt", &beside),
            ("results/numbers/give.json", give),
        ],
    );
    renew(&root, "beds", origin()).unwrap();
    let results = Results::read(&root).unwrap();
    assert_eq!(
        results.table("beds-errors").unwrap().rows[0][..5],
        ["`a-bed`", "judge", "3", "0.37", "0.16"].map(str::to_string)
    );
    let table = results.table("beds-bands").unwrap();
    assert_eq!((table.rows.len(), table.columns.len()), (3, 10));
    assert_eq!(table.rows[1][..4], ["p", "91", "85", "1.4"].map(str::to_string));
    let row = &results.table("beside-store").unwrap().rows[6];
    assert_eq!(row[..], ["stress on the side [%]", "0.8", "-1.4", "0.2", "5"].map(str::to_string));
    let table = results.table("plates-give").unwrap();
    assert_eq!(table.rows[0][..], ["`path`", "2", "1.50 ± 0.25", "0.10 ± 0.02"].map(str::to_string));
    assert_eq!(table.rows[1][..], ["`press`", "1", "1.00", "–"].map(str::to_string));
    assert_eq!(table.rows[2][..], ["mean", "", "1.25", "0.10"].map(str::to_string));
    fs::write(root.join("results/numbers/store.txt"), beside.replace("stress on the wall", "wall")).unwrap();
    let error = renew(&root, "beds", origin()).unwrap_err().to_string();
    assert!(error.contains("store.txt") && error.contains("'stress on the wall' is missing"), "{error}");
    fs::write(root.join("cases/beds/bands.csv"), bands.replace("inside_worst_scene", "worst")).unwrap();
    let error = renew(&root, "beds", origin()).unwrap_err().to_string();
    assert!(error.contains("bands.csv") && error.contains("inside_worst_scene"), "{error}");
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
