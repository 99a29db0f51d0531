//! What `scripts/report` found: speed against accuracy, targets, sensitivity, and what happens at the edges of the methods.
//! Jobs that were not run leave cells without a number.

mod edges;

use crate::error::DocsError;
use crate::gather::json::Json;
use crate::gather::print::{NONE, decimals, grouped, or_none, two};
use crate::results::Section;
use edges::FILE;
use std::path::Path;

const CASES: [&str; 3] = ["H", "C", "HC"];
const LAW: &str = "law of the increments";
const MOVING: &str = "law of the increments, grains move";

/// Family and name of a configuration in the report, and words for the table.
const CHART: [(&str, &str, &str); 20] = [
    (LAW, "fixed steps 1 ms", "paper's scheme, steps of 1 ms"),
    (LAW, "fixed steps 10 ms", "paper's scheme, steps of 10 ms"),
    (LAW, "adaptive, 0.5 K, 25x8", "adaptive steps, 25 × 8 cells"),
    (LAW, "adaptive, 0.05 K, 50x15", "adaptive steps, 50 × 15 cells"),
    (LAW, "adaptive, 0.05 K", "adaptive steps"),
    (MOVING, "equilibrium, adaptive, 0.5 K, 25x8", "grains move, adaptive steps, 25 × 8 cells"),
    (MOVING, "equilibrium, adaptive, 0.05 K, 50x15", "grains move, adaptive steps, 50 × 15 cells"),
    (MOVING, "equilibrium, adaptive, 0.05 K", "grains move, adaptive steps"),
    (MOVING, "equilibrium, steps 20 ms", "grains move, steps of 20 ms"),
    (MOVING, "equilibrium, steps 100 ms", "grains move, steps of 100 ms"),
    (
        "one-dimensional",
        "equilibrium, steps 100 ms, 100x1",
        "grains move, in one dimension, 100 × 1 cells, steps of 100 ms",
    ),
    ("paper's network", "paper's network, steps 10 ms", "the paper's network, steps of 10 ms"),
    (
        "effective medium (plug-in)",
        "steps 10 ms",
        "effective medium (the example of a plug-in), steps of 10 ms",
    ),
    ("constant conductivity", "constant", "conductivity that does not change, steps of 10 ms"),
    ("online RVEs", "all cells, 10x3, one packing", "a box of grains in each cell, 10 × 3 cells"),
    ("online RVEs", "all cells, 30x9, one packing", "a box of grains in each cell, 30 × 9 cells"),
    ("online RVEs", "shared, tolerance 5e-3, 100x30, one packing", "boxes of grains shared by like cells"),
    ("online RVEs", "all cells, 100x30, one packing", "a box of grains in each cell (cost extrapolated)"),
    ("DEM", "DEM", "15 000 discs, one thread"),
    ("quoted from the paper", "paper: multiscale, 40 s", "the paper's solver against its own discs (quoted)"),
];

/// # Errors
/// A report that is missing, quick, or of another form.
pub fn section(root: &Path) -> Result<Section, DocsError> {
    let report = Json::read(root, FILE)?;
    if !report.says("/schema", "msdd-report-1") || report.value["quick"] != false {
        return Err(report.wrong("/quick", "allowed: the whole report (schema msdd-report-1, quick false)"));
    }
    let mut section = Section::default();
    let jobs = grouped(report.number("/jobs")?);
    section.number("jobs", jobs, "1", "jobs of the report", FILE);
    for case in ["H", "C", "HC"] {
        let scatter = decimals(report.number(&format!("/scatter/{case}"))?, 1);
        let meaning =
            format!("{case}, discs: largest standard deviation of T over three packings, of the range of T");
        section.number(&format!("{case}.scatter"), scatter, "%", &meaning, FILE);
    }
    chart(&mut section, &report)?;
    cheapest(&mut section, &report)?;
    validation(&mut section, &report)?;
    targets(&mut section, &report)?;
    sensitivity(&mut section, &report)?;
    other_cases(&mut section, &report)?;
    convergence(&mut section, &report)?;
    edges::stable_steps(&mut section, &report)?;
    edges::edges(&mut section, &report)?;
    edges::limits(&mut section, &report)?;
    Ok(section)
}

fn chart(section: &mut Section, report: &Json) -> Result<(), DocsError> {
    let mut rows = Vec::new();
    for (family, name, words) in CHART {
        let mut row = vec![words.to_string()];
        for case in CASES {
            let points = report.list(&format!("/chart/{case}"))?;
            let fits = |point: &&Json| {
                point.says("/family", family) && (point.says("/name", name) || family == "DEM")
            };
            let point = points.iter().find(fits);
            let number = |entry: &str| point.and_then(|point| point.maybe(entry));
            let cost = number("/core_seconds").map(|seconds| format!("{} s", two(seconds)));
            let error = number("/temperature_error").map(|error| format!("{} %", decimals(error, 1)));
            row.push(match (error, cost) {
                (Some(error), Some(cost)) => format!("{error} in {cost}"),
                (error, cost) => error.or(cost).unwrap_or_else(|| NONE.to_string()),
            });
        }
        rows.push(row);
    }
    let meaning = "largest error of T over 20 s at three points, mean over three packings, of the range of T; processor time; 100 x 30 \
                   cells where nothing else is said";
    section.add_table("speed-accuracy", meaning, FILE, &["", "H", "C", "HC"], rows);
    Ok(())
}

fn cheapest(section: &mut Section, report: &Json) -> Result<(), DocsError> {
    let list = report.list("/cheapest")?;
    let mut errors: Vec<f64> = Vec::new();
    for entry in &list {
        let error = entry.number("/error")?;
        if !errors.contains(&error) {
            errors.push(error);
        }
    }
    let cell = |case: &str, error: f64| {
        let found = list.iter().find(|e| e.says("/case", case) && e.maybe("/error") == Some(error));
        let seconds = found.and_then(|e| e.maybe("/core_seconds"));
        let name = found.and_then(|e| e.text("/configuration").ok());
        seconds.zip(name).map_or(NONE.to_string(), |(seconds, name)| format!("{name}: {} s", two(seconds)))
    };
    let row = |error: &f64| {
        let cells = CASES.map(|case| cell(case, *error));
        [vec![format!("{error} %")], cells.to_vec()].concat()
    };
    let rows = errors.iter().map(row).collect();
    let meaning = "the cheapest configuration whose largest error of T is at most this";
    section.add_table("cheapest", meaning, FILE, &["error of T at most", "H", "C", "HC"], rows);
    Ok(())
}

/// Errors of T, pressure and displacement with grains that stay and that move.
fn validation(section: &mut Section, report: &Json) -> Result<(), DocsError> {
    let list = report.list("/validation")?;
    let absolute = |value: Option<f64>| or_none(value, |v| decimals(v.abs(), 1));
    let mut rows = Vec::new();
    for case in ["H", "C", "HC", "Hstar", "Cstar", "HCstar"] {
        for (family, key, words) in [
            (LAW, "stay", "stay"),
            (MOVING, "move", "move"),
            ("paper's network", "network", "stay; the paper's network"),
        ] {
            let Some(found) = list.iter().find(|v| v.says("/case", case) && v.says("/family", family)) else {
                continue;
            };
            let number = |entry: &str| found.maybe(&format!("/errors{entry}"));
            let probes = [0, 1, 2].map(|probe| number(&format!("/temperature/{probe}")));
            let largest = probes.iter().try_fold(0.0, |most: f64, e| e.map(|e| most.max(e.abs())));
            let meaning = format!(
                "{case}, grains {words}: largest error of T over 20 s, mean over three packings, of the range of T"
            );
            section.number(&format!("{case}.{key}.error"), absolute(largest), "%", &meaning, FILE);
            rows.push(vec![
                case.replace("star", "*"),
                words.to_string(),
                probes.map(absolute).join(", "),
                absolute(number("/pressure")),
                absolute(number("/pressure_inner")),
                absolute(number("/displacement")),
            ]);
        }
    }
    let columns = [
        "case",
        "grains",
        "T at P1, P2, P3 [% of its range]",
        "pressure, whole box [% of the paper's range]",
        "pressure, off the walls [% of the paper's range]",
        "displacement at the end [% of the largest]",
    ];
    let meaning = "largest errors over 20 s against 15 000 discs, mean over three packings";
    section.add_table("validation", meaning, FILE, &columns, rows);
    Ok(())
}

fn targets(section: &mut Section, report: &Json) -> Result<(), DocsError> {
    let list = report.list("/targets")?;
    let met = list.iter().filter(|target| target.value["met"] == true).count();
    section.number("targets", list.len().to_string(), "1", "targets of the validation", FILE);
    section.number("targets_met", met.to_string(), "1", "targets of the validation that are met", FILE);
    let row = |target: &Json| -> Result<Vec<String>, DocsError> {
        Ok(vec![
            target.text("/case")?,
            target.text("/what")?,
            decimals(target.number("/target")?, 1),
            or_none(target.maybe("/reached"), |value| decimals(value, 2)),
            verdict(target).to_string(),
        ])
    };
    let rows = list.iter().map(row).collect::<Result<_, _>>()?;
    let meaning = "targets of the solver with grains that move, steps of 20 ms, against 15 000 discs";
    section.add_table("targets", meaning, FILE, &["case", "what", "target", "reached", ""], rows);
    Ok(())
}

/// Whether a target is met, if it could be judged.
fn verdict(target: &Json) -> &'static str {
    match (target.maybe("/reached"), target.value["met"] == true) {
        (None, _) => "not judged",
        (_, true) => "met",
        (_, false) => "missed",
    }
}

fn sensitivity(section: &mut Section, report: &Json) -> Result<(), DocsError> {
    let list = report.list("/sensitivity")?;
    let mut changes: Vec<String> = Vec::new();
    for entry in &list {
        let what = entry.text("/what")?;
        if !changes.contains(&what) {
            changes.push(what);
        }
    }
    let cell = |what: &str, case: &str| {
        let found = list.iter().find(|e| e.says("/what", what) && e.says("/case", case));
        or_none(found.and_then(|e| e.maybe("/temperature")), |value| decimals(value.abs(), 1))
    };
    let row = |what: &String| [vec![what.clone()], CASES.map(|case| cell(what, case)).to_vec()].concat();
    let rows = changes.iter().map(row).collect();
    let meaning = "largest error of T over 20 s at three points [% of the range], first packing, grains move, one setting changed";
    section.add_table("sensitivity", meaning, FILE, &["", "H", "C", "HC"], rows);
    Ok(())
}

fn other_cases(section: &mut Section, report: &Json) -> Result<(), DocsError> {
    let row = |entry: &Json| -> Result<Vec<String>, DocsError> {
        let probes = [0, 1, 2].map(|probe| entry.maybe(&format!("/temperature/{probe}")));
        let pressure = [0, 1].map(|which| entry.maybe(&format!("/pressure/{which}")));
        let kilo = |value: Option<f64>| or_none(value, |v| decimals(1e-3 * v, 2));
        Ok(vec![
            format!("{}, {}", entry.text("/case")?, entry.text("/what")?),
            probes.map(|e| or_none(e, |v| decimals(v.abs(), 1))).join(", "),
            pressure.map(kilo).join("; "),
        ])
    };
    let rows = report.list("/other_cases")?.iter().map(row).collect::<Result<_, _>>()?;
    let columns = [
        "case",
        "largest error of T at P1, P2, P3 [% of its range]",
        "pressure at the end [kPa]: solver; discs",
    ];
    let meaning = "cases that nothing was chosen on, as shipped, against discs of other packings";
    section.add_table("other-cases", meaning, FILE, &columns, rows);
    Ok(())
}

fn convergence(section: &mut Section, report: &Json) -> Result<(), DocsError> {
    let mut rows = Vec::new();
    for entry in report.list("/convergence")? {
        let scheme = entry.text("/scheme")?;
        let order = or_none(entry.maybe("/order"), |order| decimals(order, 2));
        let meaning = format!("case H, scheme {scheme}: order of the mean T in the step");
        section.number(&format!("order.{scheme}"), order.clone(), "1", &meaning, FILE);
        let mut steps = Vec::new();
        for pair in entry.list("/errors")? {
            steps.push(format!("{} ms: {} K", two(1e3 * pair.number("/0")?), two(pair.number("/1")?)));
        }
        rows.push(vec![scheme, steps.join(", "), order]);
    }
    let columns = ["scheme", "rms error of the mean T over 20 s, by step", "order"];
    section.add_table("convergence", "case H: error of the mean T by time step", FILE, &columns, rows);
    Ok(())
}
