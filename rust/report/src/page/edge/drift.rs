//! Section of the page on models when a strain is divided into many increments.

use crate::ReportError;
use crate::page::html::Figure;
use crate::report::Made;
use msdd_draw::{Axis, Line, Marker, Style, plot, series};

pub fn drift(made: &Made) -> Result<String, ReportError> {
    let all = &made.report.failures.drift;
    if all.is_empty() {
        return Ok(String::new());
    }
    let marks = [(0.02, Marker::Circle), (-0.02, Marker::Square), (-0.05, Marker::Triangle)];
    let (mut drawn, mut keys) = (Vec::new(), Vec::new());
    for one in all {
        let (colour, line) = if one.model == "increment" { (1, Line::Solid) } else { (2, Line::Dashed) };
        let marker = marks.iter().find(|m| m.0 == one.strain).map_or(Marker::Cross, |m| m.1);
        let style = Style { line, ..Style::marker(colour, marker) };
        drawn.push(series(one.stress.iter().map(|p| (p[0], p[1])).collect(), style));
        keys.push((style, format!("{}, {:+} %", one.model, 100.0 * one.strain)));
    }
    let x = Axis { label: "increments that the strain is composed of", log: true, range: None };
    let y = Axis { label: "rms error of the stress [%]", log: true, range: None };
    let panels = vec![plot("composition", &x, &y, &drawn)?];
    let last = |model: &str| {
        all.iter()
            .filter(|d| d.model == model)
            .filter_map(|d| d.stress.last())
            .map(|p| p[1])
            .fold(0.0, f64::max)
    };
    let caption = format!(
        "Fig. #. The same strain divided into more and more increments, on packings that were not used in training: the errors of neither model grow. Largest error of the \
         stress with the most increments: {:.0} % (increment) and {:.0} % (paper).",
        last("increment"),
        last("paper")
    );
    Figure {
        id: "drift",
        panels,
        keys,
        caption,
        source: "msdd score on the full database; measured and cached",
    }
    .html(&made.report.made)
}
