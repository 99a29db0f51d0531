//! The page on a case of the user's.

use super::html::Figure;
use crate::ReportError;
use crate::case::errors::Error;
use crate::case::ladder::FAMILIES;
use crate::case::{CaseReport, Row};
use crate::studies::front::{Point, stairs};
use msdd_draw::html::{fixed, head, numbered, table};
use msdd_draw::{Axis, Line, MARKERS, Series, Style, escape, plot, series};
use std::fmt::Write;

/// The page's text.
///
/// # Errors
/// [`ReportError::Draw`].
pub fn text(report: &CaseReport) -> Result<String, ReportError> {
    let stamp = &report.made;
    let title = format!("Speed against accuracy: case {}", report.case);
    let mut page = head(&title);
    let _ = writeln!(
        page,
        "<h1>{}</h1>\n<p>The case in {} configurations, each compared with a reference. {} jobs, {} of them from the cache; made {} \
         on {}, commit {}.{}</p>",
        escape(&title),
        report.rows.len(),
        report.jobs,
        report.cached_jobs,
        escape(&stamp.date),
        escape(&stamp.cpu),
        escape(&stamp.commit),
        if report.quick { " <b>Quick version: fewer configurations.</b>" } else { "" }
    );
    page += "<h2>The reference</h2>\n";
    let _ = writeln!(page, "<p>{}</p>", escape(&reference(report)));
    page += "<h2>What accuracy costs</h2>\n";
    page += "<p>The error of a run is, at the worst point, the root of the mean square over the times of its difference from the \
             reference. Cost is processor time of msddFoam on one process, start and output included, without the making of the mesh. \
             A run lies on the front if no other is both cheaper and more accurate; differences of a tenth of a second are noise of the \
             machine.</p>\n";
    page += &figure(report, 0)?;
    page += &figure(report, 1)?;
    page += "<h2>What msdd case solve chooses</h2>\n";
    for choice in &report.choices {
        let _ = writeln!(page, "<p>{}</p>", escape(&choice.sentence));
    }
    page += "<h2>All runs</h2>\n";
    page += &runs(report);
    Ok(numbered(&(page + "</body>\n</html>\n")))
}

fn reference(report: &CaseReport) -> String {
    let reference = &report.reference;
    let mut text = format!(
        "{} It took {:.1} core-s. Runs are compared with it at {} points and {} times; errors of T are in percent of its range, {:.4} K.",
        reference.what, reference.core_seconds, report.points, report.times, report.range
    );
    if let Some(error) = reference.own_error {
        let _ = write!(
            text,
            " By the order of the methods its own error of T is about {error:.2} %, so differences of that size between runs say little."
        );
    }
    if let Some(scatter) = &reference.scatter {
        let one = |name: &str, error: Option<Error>| {
            error.map(|error| format!("{name} {:.2} % ({:.2} % on the mean)", error.worst, error.mean))
        };
        let all = [
            one("T", scatter.temperature),
            one("pressure", scatter.pressure),
            one("displacement", scatter.displacement),
        ];
        let _ = write!(
            text,
            " Single packings scatter around their mean (standard deviations at the worst point): {}. Smaller errors say little about \
             another packing.",
            all.into_iter().flatten().collect::<Vec<_>>().join(", ")
        );
    }
    text
}

fn style(point: &Point) -> Style {
    let family = FAMILIES.iter().position(|family| *family == point.family).unwrap_or(0);
    Style { size: 5, ..Style::marker(family, MARKERS[family]) }
}

/// The figure for the error of T (0) or of the pressure (1); empty if there is nothing to draw.
fn figure(report: &CaseReport, which: usize) -> Result<String, ReportError> {
    let points: Vec<Point> = report.rows.iter().map(|row| row.point.clone()).collect();
    if points.iter().all(|point| point.place(which).is_none()) {
        return Ok(String::new());
    }
    let mut lines = vec![series(stairs(&points, which), Style::line(4, Line::Solid))];
    for point in &points {
        // An error of 0 has no place on a logarithmic axis.
        if let Some(place) = point.place(which).filter(|place| place.1 > 0.0) {
            lines.push(Series { points: vec![place], bars: Vec::new(), style: style(point) });
        }
    }
    let quantity = ["T", "pressure"][which];
    let label = format!("error of {quantity} [%]");
    let panel = plot(
        &format!("case {}", report.case),
        &decades("cost [core-s]", points.iter().filter_map(|point| Some(point.place(which)?.0))),
        &decades(&label, points.iter().filter_map(|point| Some(point.place(which)?.1))),
        &lines,
    )?;
    let mut keys: Vec<(Style, String)> = Vec::new();
    for point in points.iter().filter(|point| point.place(which).is_some()) {
        if !keys.iter().any(|(_, name)| *name == point.family) {
            keys.push((style(point), point.family.clone()));
        }
    }
    keys.push((Style::line(4, Line::Solid), "front".to_string()));
    let best = points.iter().filter_map(|point| Some((point, point.place(which)?)));
    let best = best.min_by(|a, b| a.1.1.total_cmp(&b.1.1));
    let caption = format!(
        "Fig. #. Error of {quantity} against cost, one point for each run, both axes logarithmic, in percent of {}.{}",
        ["the range of T", "the reference's largest pressure"][which],
        best.map_or(String::new(), |(point, (cost, error))| format!(
            " The most accurate: {error:.2} % in {cost:.2} core-s ({}: {}).",
            point.family, point.name
        ))
    );
    let id = ["chart-temperature", "chart-pressure"][which];
    Figure { id, panels: vec![panel], keys, caption, source: "measured and cached" }.html(&report.made)
}

/// A logarithmic axis that ends at powers of ten, so that both ends have a number.
pub(super) fn decades(label: &str, values: impl Iterator<Item = f64>) -> Axis<'_> {
    let usable = values.filter(|value| value.is_finite() && *value > 0.0).map(f64::log10);
    let (low, high) = usable.fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), v| (l.min(v), h.max(v)));
    let range = (low <= high).then(|| (10f64.powf(low.floor()), 10f64.powf(high.floor() + 1.0)));
    Axis { label, log: true, range }
}

fn runs(report: &CaseReport) -> String {
    let mut rows: Vec<&Row> = report.rows.iter().collect();
    let cost = |row: &Row| row.point.core_seconds.unwrap_or(f64::INFINITY);
    rows.sort_by(|a, b| cost(a).total_cmp(&cost(b)));
    let heads = [
        "'family",
        "'configuration",
        "core-s",
        "wall s",
        "error of T [%]",
        "mean [%]",
        "of p [%]",
        "mean [%]",
        "of displacement [%]",
        "mean [%]",
        "'front",
        "\"outcome",
    ];
    let row = |row: &&Row| {
        let point = &row.point;
        let marks = ["T", "p"].iter().zip(point.front).filter(|(_, on)| *on).map(|(name, _)| *name);
        let mut cells = vec![
            point.family.clone(),
            point.name.clone(),
            fixed(point.core_seconds, 2),
            fixed(row.wall_seconds, 2),
        ];
        let errors = &row.errors;
        for error in [errors.temperature, errors.pressure, errors.displacement] {
            cells.push(fixed(error.map(|error| error.worst), 3));
            cells.push(fixed(error.map(|error| error.mean), 3));
        }
        cells.push(marks.collect::<Vec<_>>().join(" "));
        cells.push(match (point.outcome.as_str(), point.message.as_str()) {
            ("done", message) => message.to_string(),
            (outcome, message) => format!("{outcome}: {message}"),
        });
        cells
    };
    let note = "<p>Errors at the worst point, and the mean over the points. Pressure in percent of the largest, displacement in \
                percent of the largest displacement of the reference; grains that stay have none.</p>\n";
    note.to_string() + &table(&heads, &rows.iter().map(row).collect::<Vec<_>>())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn axes_end_at_powers_of_ten() {
        let range = |values: &[f64]| decades("x", values.iter().copied()).range.unwrap();
        let near =
            |(a, b): (f64, f64), (c, d): (f64, f64)| (a / c - 1.0).abs() < 1e-9 && (b / d - 1.0).abs() < 1e-9;
        assert!(near(range(&[0.3, 0.9]), (0.1, 1.0)));
        assert!(near(range(&[0.03, 1.5, 0.0]), (0.01, 10.0)));
        assert_eq!(decades("x", [0.0].into_iter()).range, None);
    }
}
