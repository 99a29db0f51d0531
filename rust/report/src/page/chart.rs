//! Section of the page on error against cost, with the table of what can be left out of a case.

use super::html::{Figure, case_name};
use crate::ReportError;
use crate::plan::{CHARTED, FAMILIES};
use crate::report::Made;
use crate::studies::front::{Point, stairs};
use msdd_draw::html::{fixed, table};
use msdd_draw::{Axis, Line, MARKERS, Series, Style, plot};
use std::fmt::Write;

const COST: Axis = Axis { label: "cost [core-s]", log: true, range: Some((0.05, 2e5)) };

pub fn section(made: &Made) -> Result<String, ReportError> {
    let report = &made.report;
    let mut html = "<h2>What accuracy costs</h2>\n".to_string();
    html += "<p>The cheapest configuration for a wanted error of T: the largest, over 20 s and P1 to P3, of the mean over the packings \
             of solver minus DEM, in % of the range of T (50 K; HC 100 K).</p>\n";
    let rows: Vec<Vec<String>> = report
        .cheapest
        .iter()
        .map(|c| {
            let name = c.configuration.clone().unwrap_or_else(|| "none reaches it".to_string());
            vec![case_name(&c.case).to_string(), format!("{} %", c.error), name, fixed(c.core_seconds, 2)]
        })
        .collect();
    html += &table(&["'case", "error of T", "'cheapest configuration", "core-s"], &rows);
    html += &figure(made, 0)?;
    html += &figure(made, 1)?;
    let _ = writeln!(
        html,
        "<p>The cost of every run of the solver includes {} core-s to start. Differences of a tenth of a second are noise of the machine.</p>",
        fixed(report.start_up, 2)
    );
    html += "<details><summary>All points</summary>\n";
    html += &points_table(made);
    html += "</details>\n";
    html += &ledger(made);
    Ok(html)
}

fn style(point: &Point) -> Style {
    let family = FAMILIES.iter().position(|f| *f == point.family).unwrap_or(0);
    let guessed = point.cost == "extrapolated" || point.cost == "quoted";
    Style { hollow: guessed, size: 5, ..Style::marker(family, MARKERS[family]) }
}

/// The charts in the order of the cases.
fn charts(made: &Made) -> impl Iterator<Item = (&'static str, &Vec<Point>)> {
    CHARTED.into_iter().filter_map(|case| Some((case, made.report.chart.get(case)?)))
}

/// The figure for the error of T (0) or of the pressure (1), with one panel for each case.
fn figure(made: &Made, which: usize) -> Result<String, ReportError> {
    let label = ["error of T [% of range]", "error of pressure [% of range]"][which];
    let lowest = made.report.chart.values().flatten().filter_map(|p| p.place(which)).map(|p| p.1);
    let low = 0.6 * lowest.filter(|e| *e > 0.0).fold(1.0, f64::min);
    let y = Axis { label, log: true, range: Some((low, 60.0)) };
    let mut panels = Vec::new();
    for (case, points) in charts(made) {
        let mut series = vec![Series {
            points: stairs(points, which),
            bars: Vec::new(),
            style: Style::line(4, Line::Solid),
        }];
        for point in points {
            let place = match (point.place(which), point.core_seconds) {
                (Some(place), _) => place,
                // The paper's reference has no error of its own: it is drawn at the lower edge.
                (None, Some(cost)) if point.cost == "quoted" => (cost, 1.08 * low),
                _ => continue,
            };
            series.push(Series { points: vec![place], bars: Vec::new(), style: style(point) });
        }
        panels.push(plot(&format!("case {}", case_name(case)), &COST, &y, &series)?);
    }
    let mut keys: Vec<(Style, String)> = Vec::new();
    for point in charts(made).flat_map(|(_, points)| points) {
        if !keys.iter().any(|(_, name)| *name == point.family) && point.cost != "extrapolated" {
            keys.push((style(point), point.family.clone()));
        }
    }
    keys.push((
        Style::line(4, Line::Solid),
        "front: no configuration is both cheaper and more accurate".to_string(),
    ));
    let best: Vec<String> = charts(made).filter_map(|(case, points)| best(case, points, which)).collect();
    let caption = format!(
        "Fig. #. {} against cost, one point for each configuration, both axes logarithmic, in % of the range ({}); hollow: extrapolated or quoted. The most accurate \
         that were run: {}.{}",
        ["Error of T", "Error of the mean pressure"][which],
        ["50 K; HC 100 K", "the paper's: H 3.2, C 2.2, HC 3.8 kPa"][which],
        best.join("; "),
        if which == 0 {
            " The error of DEM is the scatter between packings. The paper gives errors at P2 alone for H and C."
        } else {
            ""
        }
    );
    let id = ["chart-temperature", "chart-pressure"][which];
    Figure { id, panels, keys, caption, source: "measured and cached; paper quoted" }.html(&made.report.made)
}

fn best(case: &str, points: &[Point], which: usize) -> Option<String> {
    let run = points.iter().filter(|p| p.outcome == "done" && p.family != FAMILIES[7]);
    let best = run.filter_map(|p| Some((p, p.place(which)?))).min_by(|a, b| a.1.1.total_cmp(&b.1.1))?;
    let (point, (cost, error)) = best;
    Some(format!("{} {error:.2} % in {cost:.2} core-s ({}: {})", case_name(case), point.family, point.name))
}

fn points_table(made: &Made) -> String {
    let mut rows = Vec::new();
    for (case, points) in charts(made) {
        let mut points: Vec<&Point> = points.iter().collect();
        points.sort_by(|a, b| {
            a.core_seconds.unwrap_or(f64::INFINITY).total_cmp(&b.core_seconds.unwrap_or(f64::INFINITY))
        });
        rows.extend(points.into_iter().map(|p| {
            let marks = ["T", "p"].iter().zip(p.front).filter(|(_, on)| *on).map(|(name, _)| *name);
            vec![
                case_name(case).to_string(),
                p.family.clone(),
                p.name.clone(),
                fixed(p.core_seconds, 2),
                fixed(p.temperature_error, 2),
                fixed(p.pressure_error, 1),
                p.cost.clone(),
                marks.collect::<Vec<_>>().join(" "),
                if p.outcome == "done" || p.outcome == "quoted" {
                    String::new()
                } else {
                    format!("{}: {}", p.outcome, p.message)
                },
            ]
        }));
    }
    let heads = [
        "'case",
        "'family",
        "'configuration",
        "core-s",
        "error of T [%]",
        "of p [%]",
        "'cost",
        "'front",
        "\"outcome",
    ];
    table(&heads, &rows)
}

fn ledger(made: &Made) -> String {
    let rows: Vec<Vec<String>> = made
        .report
        .economy
        .iter()
        .filter(|s| s.outcome != "not run")
        .map(|s| {
            let asked = (s.cell_steps > 0).then(|| 100.0 * s.cell_queries as f64 / s.cell_steps as f64);
            vec![
                case_name(&s.case).to_string(),
                s.what.clone(),
                s.cells.to_string(),
                s.steps.to_string(),
                s.cell_queries.to_string(),
                fixed(asked, 1),
                fixed(s.core_seconds, 2),
                fixed(s.change, 2),
                fixed(s.error, 2),
                if s.outcome == "done" { String::new() } else { format!("{}: {}", s.outcome, s.message) },
            ]
        })
        .collect();
    let heads = [
        "'case",
        "'computed",
        "cells",
        "steps",
        "queries",
        "of all [%]",
        "core-s",
        "change of T [%]",
        "error of T [%]",
        "\"outcome",
    ];
    format!(
        "<h2>No more than a case needs</h2>\n<p>What can be left out of the computation of each case, and the error that this causes. Change of T: largest difference at \
         P1 to P3 from 1 s on, from the run that computes all. Error of T: against DEM, over all 20 s. Law of the increments, cells keep \
         their place. A half and a quarter of the box have the initial fields of their part. Processor time was measured with two jobs at \
         a time.</p>\n{}",
        table(&heads, &rows)
    )
}
