//! The failure map.

use super::{Figure, table};
use crate::ReportError;
use crate::draw::{Axis, Line, Marker, Series, Style, plot};
use crate::report::Made;

pub fn section(made: &Made) -> Result<String, ReportError> {
    let mut html = "<h2>Where methods break</h2>\n<p>Each row was run. <b>refused</b>: nothing was computed; <b>ended</b>: stopped with the \
                    message; <b>cut</b>: steps were repeated with half the size; <b>reported</b>: went on, counted and said so; \
                    <b>done</b>: nothing to report.</p>\n"
        .to_string();
    let rows: Vec<Vec<String>> = made
        .report
        .failures
        .rows
        .iter()
        .map(|r| {
            [&r.method, &r.condition, &r.predicted, &r.behaviour, &r.message].map(String::clone).to_vec()
        })
        .collect();
    html += &table(&["'method", "'condition", "'predicted", "'behaviour", "\"what came out"], &rows);
    html += &steps(made)?;
    html += &coupling(made)?;
    html += &cycles(made)?;
    html += &drift(made)?;
    Ok(html)
}

fn series(points: Vec<(f64, f64)>, style: Style) -> Series {
    Series { points, bars: Vec::new(), style }
}

fn steps(made: &Made) -> Result<String, ReportError> {
    let steps = &made.report.failures.stable_steps;
    if steps.is_empty() {
        return Ok(String::new());
    }
    let predicted = Style::line(0, Line::Dashed);
    let measured = Style { size: 5, ..Style::marker(1, Marker::Circle) };
    let x = Axis { label: "porosity [-]", log: false, range: None };
    let of =
        |pick: &dyn Fn(usize) -> Vec<(f64, f64)>| vec![series(pick(0), predicted), series(pick(1), measured)];
    let mechanical = |k: usize| steps.iter().map(|s| (s.porosity, 1e3 * s.mechanical[k])).collect();
    let thermal = |k: usize| steps.iter().map(|s| (s.porosity, 1e3 * s.thermal[k])).collect();
    let from_zero = |label, high| Axis { label, log: false, range: Some((0.0, high)) };
    let panels = vec![
        plot("mechanical step", &x, &from_zero("largest stable step [ms]", 1.5), &of(&mechanical))?,
        plot("thermal step", &x, &from_zero("largest stable step [ms]", 1.5), &of(&thermal))?,
    ];
    let ratio = |of: &dyn Fn(&crate::failures::StableStep) -> [f64; 2]| {
        let ratios: Vec<f64> = steps.iter().map(|s| of(s)[1] / of(s)[0]).collect();
        let low = ratios.iter().copied().fold(f64::INFINITY, f64::min);
        format!("{low:.2} to {:.2}", ratios.iter().copied().fold(0.0, f64::max))
    };
    let caption = format!(
        "Fig. 7. Discrete elements: stable below, unstable above. Measured over predicted: mechanical {}, thermal {}; the program takes \
         0.4 and 0.7 of the bound, and refuses fixed steps beyond it.",
        ratio(&|s| s.mechanical),
        ratio(&|s| s.thermal)
    );
    let keys = vec![
        (predicted, "predicted bound".to_string()),
        (measured, "measured: largest step that stays bounded".to_string()),
    ];
    Figure {
        id: "stable-steps",
        panels,
        keys,
        caption,
        source: "msdd bench stability, 500 discs; measured and cached",
    }
    .html(made)
}

fn coupling(made: &Made) -> Result<String, ReportError> {
    let all = &made.report.failures.coupling;
    if all.is_empty() {
        return Ok(String::new());
    }
    let styles = [
        ("paper", "the paper's scheme", 1, Marker::Circle, Line::Solid),
        ("secondOrder", "second order", 2, Marker::Square, Line::Dashed),
    ];
    let mut drawn = Vec::new();
    let mut keys = Vec::new();
    for (scheme, name, colour, marker, line) in styles {
        let points: Vec<(f64, f64)> =
            all.iter().filter(|c| c.scheme == scheme).filter_map(|c| Some((c.step, c.error?))).collect();
        let style = Style { line, ..Style::marker(colour, marker) };
        drawn.push(series(points, style));
        keys.push((style, name.to_string()));
    }
    let x = Axis { label: "step [s]", log: true, range: None };
    let y = Axis { label: "error in time of T [K]", log: true, range: None };
    let panels = vec![plot("case H, 25 x 8 cells", &x, &y, &drawn)?];
    let ended: Vec<String> = all
        .iter()
        .filter(|c| c.error.is_none())
        .map(|c| format!("{} at {} s: {}", c.scheme, c.step, c.outcome))
        .collect();
    let largest = all.iter().filter(|c| c.scheme == "paper").filter_map(|c| c.error).fold(0.0, f64::max);
    let caption = format!(
        "Fig. 8. Coupling with fixed steps (paper, Fig. 21), against adaptive steps of 0.0005 K: nothing becomes unstable (largest error of the paper's \
         scheme {largest:.1} K), accuracy is lost instead, silently; adaptive steps control it. {}",
        if ended.is_empty() { String::new() } else { format!("Ended early: {}.", ended.join(", ")) }
    );
    Figure { id: "coupling", panels, keys, caption, source: "measured and cached" }.html(made)
}

fn cycles(made: &Made) -> Result<String, ReportError> {
    let all = &made.report.failures.cycles;
    if all.is_empty() {
        return Ok(String::new());
    }
    let styles = [
        (Marker::Circle, Line::Solid, 1),
        (Marker::Square, Line::Dashed, 2),
        (Marker::Triangle, Line::Dotted, 0),
    ];
    let (mut drawn, mut keys, mut said) = (Vec::new(), Vec::new(), Vec::new());
    for (cycles, (marker, line, colour)) in all.iter().zip(styles) {
        // Every fourth stop is the end of a cycle, back at no strain.
        let back: Vec<(f64, f64)> = cycles
            .stops
            .iter()
            .skip(3)
            .step_by(4)
            .enumerate()
            .map(|(k, s)| (k as f64 + 1.0, 1e-3 * s[1]))
            .collect();
        if let (Some(first), Some(last)) = (back.first(), back.last()) {
            said.push(format!("{}: {:.2} to {:.2} kPa", cycles.name, first.1, last.1));
        }
        let style = Style { line, ..Style::marker(colour, marker) };
        drawn.push(series(back, style));
        keys.push((style, cycles.name.clone()));
    }
    let x = Axis { label: "cycles of ±20 K", log: false, range: Some((0.0, 11.0)) };
    let y = Axis { label: "pressure back at 50 K [kPa]", log: false, range: None };
    let panels = vec![plot("thermal cycling", &x, &y, &drawn)?];
    let caption =
        format!("Fig. 9. Ten cycles: pressure at the end of each, first and last: {}.", said.join("; "));
    Figure {
        id: "cycles",
        panels,
        keys,
        caption,
        source: "solver on 10 x 3 cells; msdd rve expand; measured and cached",
    }
    .html(made)
}

fn drift(made: &Made) -> Result<String, ReportError> {
    let all = &made.report.failures.drift;
    if all.is_empty() {
        return Ok(String::new());
    }
    let marks = [(0.02, Marker::Circle), (-0.02, Marker::Square), (-0.05, Marker::Triangle)];
    let (mut drawn, mut keys) = (Vec::new(), Vec::new());
    for one in all {
        let (colour, line) = if one.model == "state" { (1, Line::Solid) } else { (2, Line::Dashed) };
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
        "Fig. 10. One strain in more and more increments, packings that training never saw: neither network drifts; largest error of the \
         stress at the most increments {:.0} % (state) and {:.0} % (paper).",
        last("state"),
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
