//! Section of the page on the limits of the solver's discretisation.

use crate::ReportError;
use crate::failures::cycles::{Cycles, worst};
use crate::page::html::Figure;
use crate::report::Made;
use msdd_draw::html::fixed;
use msdd_draw::{Axis, Line, Marker, Style, from_data, plot, series};

/// A panel, the entries of its legend, and its part of the caption.
type Part = (String, Vec<(Style, String)>, String);

pub fn coupling(made: &Made) -> Result<String, ReportError> {
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
        "Fig. #. Coupling with fixed steps (paper, Fig. 21), compared with adaptive steps and a tolerance of 0.0005 K: nothing becomes unstable (largest error of the paper's \
         scheme {largest:.1} K), but accuracy is lost without a warning; adaptive steps control the error. {}",
        if ended.is_empty() { String::new() } else { format!("Ended early: {}.", ended.join(", ")) }
    );
    Figure { id: "coupling", panels, keys, caption, source: "measured and cached" }.html(&made.report.made)
}

/// Contrasts of conductivity, and slanted cells.
pub fn discretisation(made: &Made) -> Result<String, ReportError> {
    let failures = &made.report.failures;
    if failures.contrast.is_empty() {
        return Ok(String::new());
    }
    let looks = [
        (10, Style { size: 5, ..Style::marker(1, Marker::Circle) }),
        (30, Style { size: 5, ..Style::marker(2, Marker::Square) }),
        (100, Style { size: 5, ..Style::marker(3, Marker::Triangle) }),
    ];
    let (mut drawn, mut keys) = (Vec::new(), Vec::new());
    for (cells, style) in looks {
        let rows = failures.contrast.iter().filter(|c| c.cells == cells && c.contrast > 1.0);
        drawn.push(series(
            rows.clone().map(|c| (c.contrast, c.predicted)).collect(),
            Style::line(style.colour, Line::Dashed),
        ));
        drawn.push(series(rows.filter_map(|c| Some((c.contrast, c.measured?))).collect(), style));
        keys.push((style, format!("{cells} cells")));
    }
    keys.push((Style::line(0, Line::Dashed), "predicted: a chain of resistances".to_string()));
    let x = from_data("ratio of the conductivities [-]", true);
    let y = Axis { label: "error of the heat flow [%]", log: true, range: Some((0.1, 30.0)) };
    let mut panels = vec![plot("two halves, at rest", &x, &y, &drawn)?];
    let even = failures.contrast.iter().filter(|c| c.contrast == 1.0).filter_map(|c| c.measured);
    let mut caption = format!(
        "Fig. #. Left: steady heat flow through a box whose halves differ in conductivity. K at a face is the mean of the two cells, so the heat flow \
         is too large by a share of about one over the number of cells ({:.1e} % without contrast), at any contrast: the method does not fail.",
        even.fold(0.0, |worst: f64, e| worst.max(e.abs()))
    );
    if !failures.slant.is_empty() {
        let (panel, more, said) = slant(made)?;
        panels.push(panel);
        keys.extend(more);
        caption += &said;
    }
    Figure { id: "discretisation", panels, keys, caption, source: "measured and cached" }
        .html(&made.report.made)
}

fn slant(made: &Made) -> Result<Part, ReportError> {
    let rows = &made.report.failures.slant;
    let looks = [
        ([50, 15], 0, Style { line: Line::Solid, ..Style::marker(5, Marker::Diamond) }),
        ([50, 15], 3, Style { line: Line::Dashed, ..Style::marker(6, Marker::Plus) }),
        ([100, 30], 0, Style { line: Line::Dotted, ..Style::marker(7, Marker::Down) }),
    ];
    let (mut drawn, mut keys) = (Vec::new(), Vec::new());
    for (cells, correctors, style) in looks {
        let mine = rows.iter().filter(|s| s.cells == cells && s.correctors == correctors);
        drawn.push(series(mine.filter_map(|s| Some((s.angle, s.error?))).collect(), style));
        keys.push((style, format!("{} x {} cells, {correctors} corrections", cells[0], cells[1])));
    }
    let x = Axis { label: "non-orthogonality [degrees]", log: false, range: Some((-2.0, 84.0)) };
    let panel = plot("slanted cells", &x, &from_data("error of T [% of range]", true), &drawn)?;
    let bad = |s: &&crate::failures::solver::Slant| s.cells == [100, 30] && s.error.is_some_and(|e| e > 1.0);
    let first = rows.iter().filter(bad).map(|s| s.angle).fold(90.0, f64::min);
    let ended: Vec<String> = rows
        .iter()
        .filter(|s| s.error.is_none())
        .map(|s| format!("{} degrees: {}", s.angle, s.outcome))
        .collect();
    let said = format!(
        " Right: case H* in a slanted box, compared with 200 x 60 cells: the error of the shipped mesh is above 1 % from {first} \
         degrees on, where the solver warns; at 80 degrees the box is so slender that T is that of the walls. {}",
        if ended.is_empty() { "None ended early.".to_string() } else { ended.join(", ") }
    );
    Ok((panel, keys, said))
}

pub fn cycles(made: &Made) -> Result<String, ReportError> {
    let all = &made.report.failures.cycles;
    if all.is_empty() {
        return Ok(String::new());
    }
    let marks = [(Marker::Circle, 1), (Marker::Square, 2), (Marker::Triangle, 0)];
    // The end of a cycle, and its quarters
    let quarters = [(0, "ends, 50 K"), (1, "peaks, 70 K"), (3, "troughs, 30 K")];
    let x = Axis { label: "cycle", log: false, range: Some((0.0, 10.5)) };
    let (mut panels, mut keys) = (Vec::new(), Vec::new());
    for (cycles, (marker, colour)) in all.iter().zip(marks) {
        keys.push((Style { line: Line::Solid, ..Style::marker(colour, marker) }, cycles.name.clone()));
    }
    for (quarter, title) in quarters {
        let line = |cycles: &Cycles, style: Style| {
            let stops = cycles.stops.iter().skip(quarter).step_by(4).enumerate();
            series(stops.map(|(k, p)| (k as f64 + 0.25 * quarter as f64, *p)).collect(), style)
        };
        let drawn: Vec<_> = all.iter().zip(&keys).map(|(cycles, (style, _))| line(cycles, *style)).collect();
        panels.push(plot(title, &x, &from_data("pressure over the start's [-]", false), &drawn)?);
    }
    let ends = |cycles: &Cycles| {
        let at = |k: usize| cycles.stops.get(4 * k).copied().unwrap_or(f64::NAN);
        format!(
            "{}: {:.4}, {:.4} and {:.4} (K_xx/K_yy in the end {:.2})",
            cycles.name,
            at(1),
            at(2),
            at(10),
            cycles.anisotropy
        )
    };
    let caption = format!(
        "Fig. #. Ten cycles of 50 K ± 20 K at the walls (case cycle): pressure over that at the start, after 1, 2 and 10 cycles {}. Grains rearrange in \
         the first cycle and hardly after; T lags behind the walls, so that a cycle does not end at 50 K. Largest difference from the \
         DEM: {} % when cells keep their place, {} % when grains move.",
        all.iter().map(ends).collect::<Vec<_>>().join("; "),
        fixed(worst(&made.report.failures.cycles, "keep"), 1),
        fixed(worst(&made.report.failures.cycles, "move"), 1)
    );
    let source = "DEM committed, seeds 21 to 23; solver measured and cached";
    Figure { id: "cycles", panels, keys, caption, source }.html(&made.report.made)
}
