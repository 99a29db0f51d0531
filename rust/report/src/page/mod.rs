//! The pages, from `templates`: single files with their figures inside, without scripts. A chart or table that needs only the report's
//! data is described in its template; the modules prepare what has to be computed first.

mod curves;
mod fields;
mod names;
mod states;

use crate::ReportError;
use crate::case::{self, CaseReport};
use crate::failures::cycles::worst;
use crate::jobs::execute::Stamp;
use crate::plan::{CHARTED, FAMILIES};
use crate::report::Made;
use crate::studies::front::{Point, stairs};
use crate::studies::{known, requests, spheres};
use msdd_dem_reference::packings::CASES;
use msdd_draw::page;
use serde_json::json;
use std::collections::BTreeMap;

/// Text of a template of this crate with its name.
macro_rules! templates {
    ($($name:literal),*) => { [$(($name, include_str!(concat!("../../templates/", $name)))),*] };
}
const TEMPLATES: [(&str, &str); 9] = templates!(
    "index.html",
    "chart.html",
    "requests.html",
    "validation.html",
    "beyond.html",
    "edge.html",
    "spheres.html",
    "case.html",
    "case.csv"
);

fn origin(stamp: &Stamp) -> String {
    format!("scripts/report · {} · {}", stamp.commit, stamp.date)
}

fn plan() -> serde_json::Value {
    let cases = CASES.map(|case| case.0);
    json!({ "families": FAMILIES, "sphere_families": spheres::FAMILIES, "charted": CHARTED, "cases": cases, "database": known::DATABASE })
}

/// The page on the paper's cases.
///
/// # Errors
/// [`ReportError::Draw`].
pub fn text(made: &Made) -> Result<String, ReportError> {
    let report = &made.report;
    let both = |points: &Vec<Point>| [0, 1].map(|which| stairs(points, which));
    let stairs: BTreeMap<_, _> = report.chart.iter().map(|(case, points)| (case, both(points))).collect();
    let lowest = [0, 1].map(|which| {
        let errors = report.chart.values().flatten().filter_map(|point| Some(point.place(which)?.1));
        0.6 * errors.filter(|error| *error > 0.0).fold(1.0, f64::min)
    });
    let cycles = &report.failures.cycles;
    let context = json!({
        "report": report, "plan": plan(), "origin": origin(&report.made), "names": BTreeMap::from(CASES),
        "stairs": stairs, "lowest": lowest,
        "judged": made.judged, "tallies": requests::tallies(&made.judged.requests),
        "curves": curves::all(made), "fields": fields::all(made), "states": states::all(made),
        "cycles": { "fixed": worst(cycles, "keep"), "moving": worst(cycles, "move") },
    });
    Ok(page(&TEMPLATES, "index.html", context)?)
}

/// The page on beds of spheres.
///
/// # Errors
/// [`ReportError::Draw`].
pub fn spheres(made: &Made) -> Result<String, ReportError> {
    let report = &made.report;
    let steel = curves::steel(&report.spheres);
    let context = json!({ "report": report, "plan": plan(), "origin": origin(&report.made), "steel": steel });
    Ok(page(&TEMPLATES, "spheres.html", context)?)
}

/// The page on a case of the user's.
///
/// # Errors
/// [`ReportError::Draw`].
pub fn case(report: &CaseReport) -> Result<String, ReportError> {
    let points: Vec<Point> = report.rows.iter().map(|row| row.point.clone()).collect();
    let stairs = [0, 1].map(|which| stairs(&points, which));
    let context = json!({ "report": report, "families": case::ladder::FAMILIES, "origin": origin(&report.made), "stairs": stairs });
    Ok(page(&TEMPLATES, "case.html", context)?)
}

/// The configurations of a case as CSV, one a line.
///
/// # Errors
/// [`ReportError::Draw`].
pub fn table(report: &CaseReport) -> Result<String, ReportError> {
    Ok(page(&TEMPLATES, "case.csv", json!({ "report": report }))?)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The sections that a quick report leaves empty.
    #[test]
    fn what_only_the_full_report_has_is_drawn() {
        let cycles: Vec<_> = ["keep", "move", "discs"]
            .map(|name| json!({ "name": name, "stops": vec![1.0; 41], "anisotropy": 1.3 }))
            .to_vec();
        let failures = json!({
            "rows": [{ "method": "m", "condition": "c", "predicted": "p", "behaviour": "ended", "as_allowed": false, "message": "<x>" }],
            "contrast": [{ "contrast": 1.0, "cells": 10, "predicted": 0.0, "measured": 1e-9 },
                         { "contrast": 10.0, "cells": 10, "predicted": 5.0, "measured": 5.5 }],
            "slant": [{ "angle": 50.0, "cells": [100, 30], "correctors": 0, "error": 0.4 },
                      { "angle": 70.0, "cells": [100, 30], "correctors": 0, "error": 2.5 },
                      { "angle": 80.0, "cells": [50, 15], "correctors": 3, "error": null, "outcome": "failed" }],
            "cycles": cycles,
            "drift": [{ "model": "increment", "strain": -0.02, "stress": [[1.0, 3.0], [5.0, 4.0]] }],
        });
        let context =
            json!({ "report": { "failures": failures }, "cycles": { "fixed": 3.25, "moving": null } });
        let html = page(&TEMPLATES, "edge.html", context).unwrap();
        let said = [
            "0 of 1 rows",
            "ended, NOT as it should be",
            "&lt;x&gt;",
            "1e-9 % without",
            "70 degrees on",
            "80 degrees: failed.",
            "id=\"cycles\"",
            "1.0000, 1.0000 and 1.0000 (K_xx/K_yy in the end 1.30)",
            "3.2 % with a fixed packing, – %",
            "4 % (increment)",
        ];
        for text in said {
            assert!(html.contains(text), "{text}: {html}");
        }
    }

    #[test]
    fn text_cannot_break_a_line_of_the_table() {
        let row = json!({
            "family": "f", "name": "a \"b\", c", "cells": 8, "core_seconds": 1.5, "wall_seconds": null, "front": [true, false],
            "errors": { "temperature": { "worst": 2.0, "mean": 0.25 }, "pressure": null }, "outcome": "done", "message": "1 < 2"
        });
        let text = page(&TEMPLATES, "case.csv", json!({ "report": { "rows": [row] } })).unwrap();
        let (head, line) = text.split_once('\n').unwrap();
        assert_eq!(
            line.trim_end(),
            "\"f\",\"a \"\"b\"\", c\",8,1.500000,,2.000000,0.250000,,,,,true,false,done,\"1 < 2\""
        );
        assert_eq!(head.split(',').count(), 15);
    }
}
