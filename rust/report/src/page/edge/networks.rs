//! Section of the page on networks when a strain is divided into many increments.

use crate::ReportError;
use crate::draw::{Axis, Line, Marker, Style, plot, series};
use crate::page::html::Figure;
use crate::report::Made;

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
        keys.push((style, format!("{} network, {:+} %", one.model, 100.0 * one.strain)));
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
        "Fig. #. The same strain divided into more and more increments, on packings that were not used in training: the errors of neither network grow. Largest error of the \
         stress with the most increments: {:.0} % (state) and {:.0} % (paper).",
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
    .html(made)
}

pub fn depth(made: &Made) -> Result<String, ReportError> {
    let all = &made.report.failures.depth;
    if all.is_empty() {
        return Ok(String::new());
    }
    let marks = [
        (0.02, Marker::Circle, 1, Line::Solid),
        (-0.02, Marker::Square, 2, Line::Dashed),
        (-0.05, Marker::Triangle, 3, Line::Dotted),
    ];
    let (mut drawn, mut keys) = (Vec::new(), Vec::new());
    for (strain, marker, colour, line) in marks {
        let rows = || all.iter().filter(move |d| d.strain == strain);
        let style = Style { line, ..Style::marker(colour, marker) };
        let hollow = Style { hollow: true, line: Line::None, ..style };
        drawn.push(series(rows().map(|d| (d.neurons[0] as f64, d.composed)).collect(), style));
        drawn.push(series(rows().map(|d| (d.neurons[0] as f64, d.once)).collect(), hollow));
        keys.push((style, format!("{:+} %", 100.0 * strain)));
    }
    let x = Axis { label: "neurons of the hidden layer", log: true, range: Some((1.5, 22.0)) };
    let y = Axis { label: "rms error of the stress [%]", log: true, range: None };
    let panels = vec![plot("size of the state network", &x, &y, &drawn)?];
    let worst = |neurons: usize| {
        let rows = all.iter().filter(|d| d.neurons[0] == neurons);
        rows.map(|d| d.composed).fold(0.0, f64::max)
    };
    let caption = format!(
        "Fig. #. Networks of 2, 4, 8 and 16 neurons, trained in the same way, on packings that were not used in training: in many increments (full) \
         and in one (hollow). Largest error {:.1}, {:.1}, {:.1}, {:.1} %; the shipped model has 4. Larger networks do not drift: the error \
         in many increments equals that in one.",
        worst(2),
        worst(4),
        worst(8),
        worst(16)
    );
    let source = "msdd train and score on cases/database/periodic.csv.gz; measured and cached";
    Figure { id: "depth", panels, keys, caption, source }.html(made)
}
