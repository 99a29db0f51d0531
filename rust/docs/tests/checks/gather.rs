//! Sections of the results, from files as programs write them.

use super::checkout;
use super::repository::root as project;
use msdd_docs::gather::print::{decimals, grouped, power, two};
use msdd_docs::gather::{Origin, renew};
use msdd_docs::results::Results;
use serde_json::{Value, json};
use std::collections::BTreeMap;
use std::fs;

const CASES: [&str; 6] = ["H", "C", "HC", "Hstar", "Cstar", "HCstar"];
const WITNESS: &str = "engines: msdd against YADE\nat 0.02 1/s in both engines; allowed\nstrain  0.01  p 3987.0 Pa  f 0.0380  differences:  \
    pressure 1.2e-05  stress.xx 2.4e-05  stress.yy 4.0e-06  fabric_index 2.0e-06  porosity 1.0e-07\n\
    at msdd's own rates; allowed\nstrain -0.01  p 2860.0 Pa  f 0.0380  differences:  pressure 1.0e-04  \
    stress.xx 2.0e-04  stress.yy 2.0e-05  fabric_index 7.0e-04  porosity 1.0e-07\nengines: passed\n";
const OTHER: &str = r#"{"schema": "msdd-results-1", "sections": {"other": {"command": "a", "commit": "b", "date": "c",
    "values": {"k": {"value": "1", "unit": "1", "meaning": "m", "source": "s"}}, "tables": {}}}}"#;
const ERRORS: &str = "scene,use,packings,T_error,T_scatter,pressure_error,pressure_scatter,conductivity_error,conductivity_scatter\n\
    a-bed,judge,3,0.371,0.16,4.9,4.12,1.831,1.37\n";
const ABOUT: &str = "# Beds\n\n| bed | spheres, gas |\n|---|---|\n| `a-bed` | steel, air |\n\nEnd.\n";
const GIVE: &str = r#"[{"name": "kept", "packings": 2, "give": [null, null], "back": [null, null]},
    {"name": "path", "packings": 2, "give": [1.5, 0.25], "back": [0.1, 0.02]},
    {"name": "press", "packings": 1, "give": [1.0, null], "back": [null, null]}]"#;

/// What `msdd summary` writes, made small: of each case a value at 4.9, 5 and 20 s.
fn summary() -> String {
    let series = |value: f64| json!([[4.9, value - 1.0], [5.02, value], [20.0, value + 1.0]]);
    let band = |value: f64| json!([[0.0, 50.0, 0.0], [5.0, value, 0.25], [20.0, value, 0.1]]);
    let end =
        json!({"porosity": 0.1194, "conductivity_xx": 40.0, "conductivity_yy": 30.0, "pressure": 2984.0});
    let probes = json!({"P1": series(70.04), "P2": series(50.0), "P3": series(38.96)});
    let run = json!({"probes": probes, "final": end, "cpu_seconds": 12.34});
    let temperature = json!({"P1": band(71.0), "P2": band(50.0), "P3": band(34.5)});
    let errors = |largest: f64| json!({"temperature": [0.5, -0.1, largest]});
    let comparison = json!({"discs": {"temperature": temperature, "scatter": 0.34}, "grains_stay": errors(-4.46), "grains_move": errors(0.3)});
    let of_all = |value: &Value| CASES.iter().map(|case| (*case, value.clone())).collect::<BTreeMap<_, _>>();
    json!({"cases": of_all(&run), "moving": of_all(&run), "comparison": of_all(&comparison)}).to_string()
}

#[test]
fn sections_are_numbers_and_tables_of_files_the_others_stay_and_missing_entries_are_named() {
    let mut bands = "quantity,use,values,inside,inside_worst_scene,width\n".to_string();
    for name in ["T", "pressure", "conductivity"] {
        bands
            .extend(["calibrate", "judge", "outside"].map(|of| format!("{name},{of},60,0.912,0.85,1.449\n")));
    }
    let names = ["T at the probes", "stress 1", "stress 2", "stress 3", "p", "K", "stress on the wall"];
    let mut beside = "solver minus DEM         points      rms    worst  packings\n".to_string();
    beside.extend(names.map(|name| format!("{name:<22}       20     0.85    -1.36      0.21 %\n")));
    let other = beside.replace("0.85", "2.25");
    let varied = format!("with `a`: 1\ncase a.variants: done\n{other}with `b`\n{beside}");
    let discs = "cases/reference/summary.json";
    let files = [
        (discs, &fs::read_to_string(project().join(discs)).unwrap()),
        ("results/summary.json", &summary()),
        ("results/numbers/witness.txt", &WITNESS.to_string()),
        ("docs/results.json", &OTHER.to_string()),
        ("results/report.json", &r#"{"schema": "msdd-report-1", "quick": true}"#.to_string()),
        ("cases/beds/errors.csv", &ERRORS.to_string()),
        ("cases/beds/bands.csv", &bands),
        ("results/numbers/column.txt", &beside),
        ("results/numbers/store.txt", &beside),
        ("results/numbers/give.json", &GIVE.to_string()),
        ("cases/beds/README.md", &ABOUT.to_string()),
        ("cases/beds/errors-proposed.csv", &ERRORS.to_string()),
        ("results/numbers/column-inputs.txt", &varied),
        ("results/numbers/store-inputs.txt", &varied),
    ];
    let root = checkout("gather", &files.map(|(file, text)| (file, text.as_str())));
    let renewed = |section: &str| {
        let [commit, date, machine] = ["0123abc", "2026-01-02", "a machine"].map(str::to_string);
        renew(&root, section, Origin { commit, date, machine }).map_err(|error| error.to_string())
    };
    ["cases", "witness", "beds"].iter().for_each(|section| renewed(section).unwrap());
    let results = Results::read(&root).unwrap();
    for (key, value) in [
        ("other.k", "1"),
        ("witness.same.stress", "2e-5"),
        ("cases.H.paper.error", "4.5"),
        ("cases.HC.moving.error", "0.5"),
        ("cases.H.paper.T_P1", "70.0"),
        ("cases.H.discs.T_P3", "34.5 ± 0.2"),
        ("cases.H.paper.seconds", "12"),
        ("cases.H.paper.pressure", "2.98"),
    ] {
        assert_eq!(results.value(key).unwrap().value, value, "{key}");
    }
    for (table, row, cells) in [
        ("errors", 0, "|4.5 % in 12 s|4.5 % in 12 s|4.5 % in 12 s"),
        ("errors", 2, "|± 0.3 %|± 0.3 %|± 0.3 %"),
        ("errors", 3, "|5.3 % in 40 s|2.8 % in 40 s|6.5 % in 40 s|–|–|–"),
        ("witness", 1, "each its own rate|-1 %|2.86|"),
        ("beds-errors", 0, "`a-bed`|steel, air|validation|0.37|0.16|4.90|4.12|1.83|1.37"),
        ("beds-proposed", 0, "`a-bed`|0.4|4.9|1.8"),
        ("beds-bands", 1, "calibration|p|91|85|1.4"),
        ("beside-store", 6, "stress on the side [%]|0.8|-1.4|0.2|5"),
        ("inputs-store", 0, "as in the case|0.8|0.8|0.8|0.8|-1.4"),
        ("inputs-store", 1, "`a`: 1|2.2|2.2|2.2|2.2|-1.4"),
        ("inputs-store", 2, "`b`|0.8|"),
        ("plates-give", 0, "`path`|2|1.50 ± 0.25|0.10 ± 0.02"),
        ("plates-give", 1, "`press`|1|1.00|–"),
        ("plates-give", 2, "mean||1.25|0.10"),
    ] {
        let found = results.table(table).unwrap().rows[row].join("|");
        assert!(found.contains(cells), "{table}: {found}");
    }
    let section = &results.sections["cases"];
    let origin = [&section.command, &section.commit, &section.machine];
    assert_eq!(origin, ["scripts/results cases", "0123abc", "a machine"]);
    for (section, file, from, message) in [
        ("witness", 2, "fabric_index", "'differences:' is missing"),
        ("beds", 8, "stress on the wall", "'stress on the wall' is missing"),
        ("beds", 6, "inside_worst_scene", "'inside_worst_scene' is missing"),
        ("beds", 10, "`a-bed`", "'`a-bed`' is missing"),
        ("beds", 11, "pressure_error", "'pressure_error' is missing"),
        ("beds", 12, "K   ", "'K' is missing"),
        ("report", 4, "none", "allowed: the whole report"),
    ] {
        let (path, text) = files[file];
        fs::write(root.join(path), text.replace(from, "another")).unwrap();
        let error = renewed(section).unwrap_err();
        assert!(error.contains(path) && error.contains(message), "{error}");
        fs::write(root.join(path), text).unwrap();
    }
    assert!(renewed("none").unwrap_err().contains("allowed: beds, cases, database"));
    assert_eq!(Results::read(&root).unwrap(), results);
}

#[test]
fn numbers_are_rounded_as_said() {
    let twos = [0.0, 0.174, 0.0996, 1.64, 9.96, 26.4, 131.2, 1604.0].map(two);
    assert_eq!(twos, ["0", "0.17", "0.10", "1.6", "10", "26", "131", "1\u{a0}604"]);
    assert_eq!([19706.0, -1237.0, 12.0, -0.2].map(grouped), ["19\u{a0}706", "-1\u{a0}237", "12", "0"]);
    assert_eq!([decimals(-0.04, 1), decimals(-0.06, 1), power(4.6e-5)], ["0.0", "-0.1", "5e-5"]);
}
