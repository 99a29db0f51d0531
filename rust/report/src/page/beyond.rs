//! Section of the page beyond the six cases: order in time, sensitivity, another geometry and another material.

use super::html::{Figure, case_name};
use crate::ReportError;
use crate::plan::CHARTED;
use crate::report::Made;
use crate::studies::other_cases::WAYS;
use msdd_draw::html::{fixed, table};
use msdd_draw::{Axis, Line, Marker, Series, Style, plot};

pub fn section(made: &Made) -> Result<String, ReportError> {
    Ok(convergence(made)? + &sensitivity(made) + &other_cases(made)?)
}

/// The paper's fit: factor [K] and order (section 3.4).
const PAPER_ORDER: [f64; 2] = [2.205, 1.141];

fn convergence(made: &Made) -> Result<String, ReportError> {
    let styles = [
        ("paper", "the paper's scheme", 1, Marker::Circle, Line::Solid),
        ("secondOrder", "second order", 2, Marker::Square, Line::Dashed),
    ];
    let (mut drawn, mut keys, mut said) = (Vec::new(), Vec::new(), Vec::new());
    for (scheme, name, colour, marker, line) in styles {
        let Some(found) = made.report.convergence.iter().find(|c| c.scheme == scheme) else { continue };
        let points: Vec<(f64, f64)> = found.errors.iter().map(|e| (e[0], e[1])).collect();
        if let (Some(factor), Some(order)) = (found.factor, found.order) {
            let fit = points.iter().map(|p| (p.0, factor * p.0.powf(order))).collect();
            drawn.push(Series { points: fit, bars: Vec::new(), style: Style::line(colour, line) });
            said.push(format!("{name} {factor:.3} Δt^{order:.3}"));
        }
        drawn.push(Series { points, bars: Vec::new(), style: Style::marker(colour, marker) });
        keys.push((Style { line, ..Style::marker(colour, marker) }, format!("{name}, line: fit")));
    }
    if drawn.is_empty() {
        return Ok(String::new());
    }
    let [factor, order] = PAPER_ORDER;
    let steps: Vec<f64> = made.report.convergence.iter().flat_map(|c| &c.errors).map(|e| e[0]).collect();
    let ends =
        [steps.iter().copied().fold(f64::INFINITY, f64::min), steps.iter().copied().fold(0.0, f64::max)];
    let quoted = Style::line(4, Line::Dotted);
    drawn.push(Series {
        points: ends.iter().map(|step| (*step, factor * step.powf(order))).collect(),
        bars: Vec::new(),
        style: quoted,
    });
    keys.push((quoted, "the paper's fit, quoted".to_string()));
    let x = Axis { label: "step [s]", log: true, range: None };
    let y = Axis { label: "RMSE of the mean T [K]", log: true, range: None };
    let panels = vec![plot("case H, grains stay", &x, &y, &drawn)?];
    let caption = format!(
        "Fig. #. Order in time (paper, Fig. 21): root mean square over 20 s of the error of the mean T with fixed steps, against second-order steps of {} ms. Fits [K, s]: {}; \
         the paper {factor} Δt^{order}.",
        if made.report.quick { 10 } else { 2 },
        said.join(", ")
    );
    Figure { id: "convergence", panels, keys, caption, source: "measured and cached; paper quoted" }
        .html(&made.report.made)
}

fn sensitivity(made: &Made) -> String {
    let all = &made.report.sensitivity;
    let mut names: Vec<&String> = Vec::new();
    for one in all {
        if !names.contains(&&one.what) {
            names.push(&one.what);
        }
    }
    let row = |what: &&String| {
        let of = |case: &str| all.iter().find(|s| s.case == case && s.what == **what);
        let mut row = vec![(*what).clone()];
        row.extend(CHARTED.map(|case| fixed(of(case).and_then(|s| s.temperature), 2)));
        row.extend(["H", "C"].map(|case| fixed(of(case).and_then(|s| s.pressure), 1)));
        row.push(fixed(of("HC").and_then(|s| s.displacement), 0));
        row
    };
    let rows: Vec<Vec<String>> = names.iter().map(row).collect();
    let heads =
        ["'changed", "T in H [%]", "C [%]", "HC [%]", "pressure in H [%]", "C [%]", "displacement in HC [%]"];
    format!(
        "<h3>Sensitivity</h3>\n<p>Nothing is fitted to these runs: stiffness, strength and wall friction come from the databases of small boxes. \
         In each row one setting of the walls is changed; packing 1. Largest errors of T at P1 to P3 and of the pressure in the inner region, without \
         two mean radii along each wall (% of the ranges), and of the displacement (% of the largest).</p>\n{}",
        table(&heads, &rows)
    )
}

fn other_cases(made: &Made) -> Result<String, ReportError> {
    let found = &made.other_cases;
    let mut panels = Vec::new();
    let markers = [(1, Marker::Circle), (2, Marker::Square), (3, Marker::Triangle)];
    let lines = [Line::Solid, Line::Dotted];
    for discs in &found.discs {
        let times = discs.series.column("time").unwrap_or_default();
        let mut series = Vec::new();
        for (probe, (colour, marker)) in markers.into_iter().enumerate() {
            for ((way, _), line) in WAYS.iter().zip(lines) {
                let run = found.runs.get(&(discs.case.clone(), (*way).to_string()));
                let points = run.iter().flat_map(|run| &run.temperature).map(|row| (row[0], row[1 + probe]));
                series.push(Series {
                    points: points.collect(),
                    bars: Vec::new(),
                    style: Style::line(colour, line),
                });
            }
            let values = discs.series.column(&format!("T_P{}_window", probe + 1)).unwrap_or_default();
            let shown = times.iter().copied().zip(values).enumerate().filter(|(k, _)| k % 20 == 0);
            series.push(Series {
                points: shown.map(|(_, point)| point).collect(),
                bars: Vec::new(),
                style: Style { size: 3, ..Style::marker(colour, marker) },
            });
        }
        let x = Axis { label: "t [s]", log: false, range: Some((0.0, 20.0)) };
        let y = Axis { label: "T [K]", log: false, range: None };
        panels.push(plot(&format!("case {}", discs.case), &x, &y, &series)?);
    }
    let mut keys: Vec<(Style, String)> = (0..3)
        .map(|k| {
            (Style { line: Line::Solid, ..Style::marker(markers[k].0, markers[k].1) }, format!("P{}", k + 1))
        })
        .collect();
    keys.push((Style::line(0, Line::Solid), "solver, grains move".to_string()));
    keys.push((Style::line(0, Line::Dotted), "solver, grains stay".to_string()));
    keys.push((Style::marker(0, Marker::Circle), "DEM".to_string()));
    let worst = |way: &str| -> Vec<String> {
        let rows = found.rows.iter().filter(|row| row.what == way);
        let text = |t: &[f64; 3]| t.map(|e| format!("{:.1}", e.abs())).join(", ");
        rows.filter_map(|row| Some(format!("{} {} %", row.case, text(row.temperature.as_ref()?)))).collect()
    };
    let caption = format!(
        "Fig. #. Two cases that were not used to choose any parameter, run as shipped with the same model: half of the walls of a square box hot (corner), and grains of another size, density, E, k, c and α \
         (material). Largest errors at P1, P2, P3, % of the range (50, 100 K): grains move {}; grains stay {}.",
        worst(WAYS[0].0).join("; "),
        worst(WAYS[1].0).join("; ")
    );
    let source = "DEM committed, packings 11 and 12; solver measured and cached";
    let figure = Figure { id: "other-cases", panels, keys, caption, source }.html(&made.report.made)?;
    Ok(format!("<h3>Another scene, another material</h3>\n{}{figure}{}", other_table(made), scalings(made)))
}

fn other_table(made: &Made) -> String {
    let row = |row: &crate::studies::other_cases::OtherCase| {
        let mut cells = vec![case_name(&row.case).to_string(), row.what.clone()];
        cells.extend((0..3).map(|k| fixed(row.temperature.map(|t| t[k]), 2)));
        cells.extend((0..2).map(|k| fixed(row.pressure.map(|p| 1e-3 * p[k]), 2)));
        cells
    };
    let rows: Vec<Vec<String>> = made.other_cases.rows.iter().map(row).collect();
    let heads = [
        "'case",
        "'solver",
        "T at P1 [%]",
        "P2 [%]",
        "P3 [%]",
        "p at the end [kPa]",
        "discs, whole box [kPa]",
    ];
    table(&heads, &rows)
}

/// Table that shows why the law has stresses over E r̄/ℓ and not, as the paper has them, over E.
fn scalings(made: &Made) -> String {
    let all = &made.other_cases.scalings;
    let row = |s: &crate::studies::other_cases::Scaling| {
        vec![
            s.case.clone(),
            format!("{:.0}", 1e-6 * s.young_modulus),
            format!("{:.1}", 1e3 * s.mean_radius),
            format!("{:.4}", s.porosity),
            format!("{:.2}", 1e-3 * s.pressure),
            format!("{:.2}", 1e4 * s.over_modulus),
            format!("{:.4}", s.reduced),
        ]
    };
    let rows: Vec<Vec<String>> = all.iter().map(row).collect();
    let heads =
        ["'packing of", "E [MPa]", "r̄ [mm]", "porosity [-]", "p [kPa]", "p/E [1e-4]", "p ℓ/(E r̄) [-]"];
    let pair = all.iter().find(|s| s.case == "H").zip(all.iter().find(|s| s.case == "material"));
    let said = pair.map_or(String::new(), |(first, other)| {
        format!(
            " Packed in the same way, case material has {:.2} times the p/E of case H, and {:.3} times its p ℓ/(E r̄): the stiffness of a contact is a force per length, E r, so stress over E \
             still depends on the size of the grains.",
            other.over_modulus / first.over_modulus,
            other.reduced / first.reduced
        )
    });
    format!(
        "<p>The law of the increments has stresses σ ℓ/(E r̄), ℓ = 1 m; the paper has σ/E.{said}</p>\n{}",
        table(&heads, &rows)
    )
}
