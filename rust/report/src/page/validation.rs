//! The solver beside discrete elements: table, targets, curves, maps, profiles.

use super::{Figure, case_name, fixed, table};
use crate::ReportError;
use crate::compare::{reference_sub_regions, sub_regions};
use crate::draw::{Axis, Line, Marker, Series, Style, maps, plot};
use crate::output::{COLUMNS, Run};
use crate::reference::{Reference, statistics};
use crate::report::{Made, Validated};

/// Errors that the paper reports: case, T at P1, P2, P3 [% of the range], pressure [% of its range].
const PAPER: [(&str, [&str; 3], &str); 3] =
    [("H", ["–", "5.3", "–"], "9.6"), ("C", ["–", "2.8", "–"], "10.9"), ("HC", ["2.2", "1.3", "6.5"], "3.0")];

pub fn section(made: &Made) -> Result<String, ReportError> {
    let mut html = "<h2>Validation</h2>\n<p>Each run starts from the fields of one packing and is compared with that packing's discrete \
                    elements; T of 40 mm windows. Errors are solver minus discrete elements where they are largest; in brackets the \
                    largest of a single packing. Sub-regions: 10 × 3, at the end, root mean square over all packings; worst one in \
                    brackets.</p>\n"
        .to_string();
    html += &errors_table(made);
    html += &targets_table(made);
    html += &temperatures(made)?;
    html += &pressures(made)?;
    html += &all_maps(made)?;
    html += &profiles(made)?;
    Ok(html)
}

fn errors_table(made: &Made) -> String {
    let mut rows: Vec<Vec<String>> = made.report.validation.iter().map(|v| row(made, v)).collect();
    for (case, temperature, pressure) in PAPER {
        let mut row = vec![case.to_string(), "the paper, quoted".to_string()];
        row.extend(temperature.map(str::to_string));
        row.push(pressure.to_string());
        row.extend((0..7).map(|_| "–".to_string()));
        rows.push(row);
    }
    rows.sort_by_key(|row| ["H", "C", "HC", "H*", "C*", "HC*"].iter().position(|c| *c == row[0]));
    let heads = [
        "'case",
        "'configuration",
        "T at P1 [%]",
        "P2 [%]",
        "P3 [%]",
        "pressure [%]",
        "porosity [%, abs.]",
        "K_xx [%]",
        "K_yy [%]",
        "σ_xx [kPa]",
        "σ_yy [kPa]",
        "displacement [%]",
        "scatter of T between packings [%]",
    ];
    table(&heads, &rows)
}

fn row(made: &Made, v: &Validated) -> Vec<String> {
    let mut row = vec![case_name(&v.case).to_string(), v.configuration.clone()];
    let Some(errors) = &v.errors else {
        row.push(if v.outcome == "done" { "not all packings run".to_string() } else { why(v) });
        row.extend((0..10).map(|_| "–".to_string()));
        return row;
    };
    let worst = |values: &mut dyn Iterator<Item = f64>| {
        values.fold(0.0, |w: f64, v| if v.abs() > w.abs() { v } else { w })
    };
    for probe in 0..3 {
        let each = worst(&mut errors.temperature_of_seeds.iter().map(|e| e[probe]));
        row.push(format!("{:.1} ({each:.1})", errors.temperature[probe]));
    }
    let each = worst(&mut errors.pressure_of_seeds.iter().copied());
    row.push(format!("{:.1} ({each:.1})", errors.pressure));
    let mut field = |quantity: &str, relative: bool, factor: f64, digits: usize| {
        row.push(errors.field(quantity).map_or("–".to_string(), |f| {
            let scale = if relative { factor / f.means[1] } else { factor };
            format!("{:.digits$} ({:.digits$})", scale * f.rms, scale * f.worst)
        }));
    };
    field("porosity", false, 100.0, 2);
    field("conductivity_xx", true, 100.0, 1);
    field("conductivity_yy", true, 100.0, 1);
    field("stress_xx", false, 1e-3, 2);
    field("stress_yy", false, 1e-3, 2);
    row.push(fixed(errors.displacement, 0));
    row.push(fixed(made.report.scatter.get(&v.case).copied(), 1));
    row
}

fn targets_table(made: &Made) -> String {
    let rows: Vec<Vec<String>> = made
        .report
        .targets
        .iter()
        .map(|t| {
            let verdict = match (t.met, t.reached) {
                (true, _) => "reached".to_string(),
                (false, Some(value)) => format!("missed, {:.1} times the target", value / t.target),
                (false, None) => "not known".to_string(),
            };
            vec![
                case_name(&t.case).to_string(),
                t.what.clone(),
                t.target.to_string(),
                fixed(t.reached, 2),
                verdict,
            ]
        })
        .collect();
    let met = made.report.targets.iter().filter(|t| t.met).count();
    format!(
        "<p>Targets, with grains that move: {met} of {} reached.</p>\n{}",
        rows.len(),
        table(&["'case", "'what", "at most", "reached", "'verdict"], &rows)
    )
}

/// Outcome of a run that did not end well.
fn why(v: &Validated) -> String {
    let message: String = v.message.chars().take(80).collect();
    if message.is_empty() { v.outcome.clone() } else { format!("{}: {message}", v.outcome) }
}

/// Lines of the configurations that were validated, in order.
const LINES: [(Line, usize); 3] = [(Line::Solid, 1), (Line::Dashed, 2), (Line::Dotted, 3)];

fn configurations(made: &Made) -> Vec<String> {
    let mut names: Vec<String> = Vec::new();
    for v in &made.report.validation {
        if !names.contains(&v.configuration) {
            names.push(v.configuration.clone());
        }
    }
    names
}

fn keys(made: &Made) -> Vec<(Style, String)> {
    let mut keys: Vec<(Style, String)> = configurations(made)
        .into_iter()
        .zip(LINES)
        .map(|(name, (line, colour))| (Style::line(colour, line), name))
        .collect();
    keys.push((
        Style::marker(0, Marker::Circle),
        "discrete elements, bars: scatter of the packings".to_string(),
    ));
    keys
}

/// Mean over the packings of a series of the runs.
fn mean(runs: &[Run], of: impl Fn(&Run) -> Vec<(f64, f64)>) -> Vec<(f64, f64)> {
    let all: Vec<Vec<(f64, f64)>> = runs.iter().map(of).collect();
    let values: Vec<Vec<f64>> = all.iter().map(|series| series.iter().map(|p| p.1).collect()).collect();
    let times = all.first().cloned().unwrap_or_default();
    times.iter().zip(statistics(&values)).map(|(&(t, _), (m, _))| (t, m)).collect()
}

fn curves(made: &Made, case: &str, of: impl Fn(&Run) -> Vec<(f64, f64)>) -> Vec<Series> {
    let names = configurations(made);
    let with_runs = names
        .iter()
        .zip(LINES)
        .filter_map(|(name, style)| Some((made.runs.get(&(case.to_string(), name.clone()))?, style)));
    with_runs
        .map(|(runs, (line, colour))| Series {
            points: mean(runs, &of),
            bars: Vec::new(),
            style: Style::line(colour, line),
        })
        .collect()
}

/// Points of the reference at some of its times.
fn elements(reference: &Reference, by_packing: &[Vec<f64>], scale: f64) -> Series {
    let times = reference.times();
    let shown = |t: f64| {
        [0.0, 0.5, 1.0, 1.5, 2.0, 3.0, 4.0, 5.0].iter().any(|s| (s - t).abs() < 1e-6)
            || (t > 5.5 && (t / 2.5 - (t / 2.5).round()).abs() < 1e-6)
    };
    let kept: Vec<(f64, (f64, f64))> =
        times.into_iter().zip(statistics(by_packing)).filter(|(t, _)| shown(*t)).collect();
    Series {
        points: kept.iter().map(|(t, (m, _))| (*t, scale * m)).collect(),
        bars: kept.iter().map(|(_, (_, d))| scale * d).collect(),
        style: Style { size: 3, ..Style::marker(0, Marker::Circle) },
    }
}

fn temperatures(made: &Made) -> Result<String, ReportError> {
    let time = Axis { label: "t [s]", log: false, range: Some((0.0, 20.0)) };
    let mut panels = Vec::new();
    for reference in &made.references {
        for (probe, by_packing) in reference.temperature().iter().enumerate() {
            // P3 mirrors P1 where all walls are alike, up to the packing.
            if !reference.case.starts_with("HC") && probe == 2 {
                continue;
            }
            let of = |run: &Run| run.temperature.iter().map(|row| (row[0], row[1 + probe])).collect();
            let mut series = curves(made, &reference.case, of);
            series.push(elements(reference, by_packing, 1.0));
            let title = format!("case {}, P{}", case_name(&reference.case), probe + 1);
            panels.push(plot(&title, &time, &Axis { label: "T [K]", log: false, range: None }, &series)?);
        }
    }
    let caption = format!(
        "Fig. 3. T at the probes (paper, Figs. 11, 17, 18): means over the packings. Largest errors at P1, P2, P3: {}.",
        worst_temperatures(made)
    );
    let source = "discrete elements committed; solver measured and cached";
    Figure { id: "temperatures", panels, keys: keys(made), caption, source }.html(made)
}

fn worst_temperatures(made: &Made) -> String {
    let of = |v: &Validated| {
        let [a, b, c] = v.errors.as_ref()?.temperature;
        Some(format!("{} {}: {a:.1}, {b:.1}, {c:.1} %", case_name(&v.case), v.configuration))
    };
    let expanding = made.report.validation.iter().filter(|v| !v.case.ends_with("star"));
    expanding.filter_map(of).collect::<Vec<_>>().join("; ")
}

fn pressures(made: &Made) -> Result<String, ReportError> {
    let time = Axis { label: "t [s]", log: false, range: Some((0.0, 20.0)) };
    let mut panels = Vec::new();
    for reference in made.references.iter().filter(|r| !r.case.ends_with("star")) {
        let of = |run: &Run| run.pressure.iter().map(|row| (row[0], 1e-3 * row[1])).collect();
        let mut series = curves(made, &reference.case, of);
        series.push(elements(reference, &reference.series("pressure"), 1e-3));
        let y = Axis { label: "mean pressure [kPa]", log: false, range: None };
        panels.push(plot(&format!("case {}", case_name(&reference.case)), &time, &y, &series)?);
    }
    let all: Vec<String> = made
        .report
        .validation
        .iter()
        .filter(|v| !v.case.ends_with("star"))
        .filter_map(|v| {
            Some(format!("{} {}: {:.1} %", case_name(&v.case), v.configuration, v.errors.as_ref()?.pressure))
        })
        .collect();
    let caption = format!(
        "Fig. 4. Mean pressure (paper, Fig. 20). Largest errors, % of the paper's range: {}.",
        all.join("; ")
    );
    let source = "discrete elements committed; solver measured and cached";
    Figure { id: "pressures", panels, keys: keys(made), caption, source }.html(made)
}

/// Mean over the packings of values in sub-regions.
fn averaged(by_packing: &[Vec<f64>], scale: f64) -> Vec<f64> {
    statistics(by_packing).into_iter().map(|(mean, _)| scale * mean).collect()
}

fn all_maps(made: &Made) -> Result<String, ReportError> {
    let quantities = [
        ("porosity", "porosity [%]", 100.0, 1),
        ("conductivity_xx", "K_xx [W/(m K)]", 1.0, 1),
        ("stress_xx", "σ_xx [kPa]", 1e-3, 2),
        ("stress_yy", "σ_yy [kPa]", 1e-3, 2),
    ];
    let mut panels = Vec::new();
    for reference in made.references.iter().filter(|r| !r.case.ends_with("star")) {
        for (quantity, label, scale, digits) in quantities {
            let dem = reference_sub_regions(reference, quantity, false);
            let mut named = vec![("discrete elements", averaged(&dem, scale))];
            let names = configurations(made);
            // The paper's network has the affine conductivity, another scale.
            for name in names.iter().take(2) {
                if let Some(runs) = made.runs.get(&(reference.case.clone(), name.clone())) {
                    let values: Vec<Vec<f64>> = runs.iter().map(|run| sub_regions(run, quantity)).collect();
                    named.push((name.as_str(), averaged(&values, scale)));
                }
            }
            panels.push(maps(&format!("case {}: {label}", case_name(&reference.case)), digits, &named)?);
        }
    }
    let caption = "Fig. 5. Means over 10 × 3 sub-regions at the end, and over the packings (paper, Figs. 14, 16, 19): light is \
                   high, one scale for the maps of a panel. K of discrete elements by the network solved."
        .to_string();
    let source = "discrete elements committed; solver measured and cached";
    Figure { id: "maps", panels, keys: Vec::new(), caption, source }.html(made)
}

fn profiles(made: &Made) -> Result<String, ReportError> {
    let Some(reference) = made.references.iter().find(|r| r.case == "HC") else { return Ok(String::new()) };
    let x = |k: usize| (k as f64 + 0.5) * 0.215;
    let along = Axis { label: "x [m]", log: false, range: Some((0.0, 2.15)) };
    let column = COLUMNS.iter().position(|c| *c == "stress_xx").unwrap_or(0);
    let stress =
        |run: &Run| run.columns.iter().enumerate().map(|(k, row)| (x(k), 1e-3 * row[column])).collect();
    let moved = |run: &Run| -> Vec<(f64, f64)> {
        run.displacement.iter().flatten().enumerate().map(|(k, u)| (x(k), 1e3 * u)).collect()
    };
    let dem = |name: &str, scale: f64| {
        let (points, bars) = statistics(&reference.slices(name))
            .into_iter()
            .enumerate()
            .map(|(k, (mean, deviation))| ((x(k), scale * mean), scale * deviation))
            .unzip();
        Series { points, bars, style: Style { size: 3, ..Style::marker(0, Marker::Circle) } }
    };
    let mut stresses = curves(made, "HC", stress);
    stresses.push(dem("stress_xx", 1e-3));
    let mut displacements = curves(made, "HC", moved);
    displacements.push(dem("displacement_x", 1e3));
    let axis = |label| Axis { label, log: false, range: None };
    let panels = vec![
        plot("case HC, stress along x", &along, &axis("σ_xx [kPa]"), &stresses)?,
        plot("case HC, displacement along x", &along, &axis("u_x [mm]"), &displacements)?,
    ];
    let caption = "Fig. 6. Case HC at the end, ten slices along x (paper, Fig. 15): without grains that move each slice keeps the stress of its own strain; \
                   with them σ_xx evens out up to the friction of the long walls."
        .to_string();
    let source = "discrete elements committed; solver measured and cached";
    Figure { id: "profiles", panels, keys: keys(made), caption, source }.html(made)
}
