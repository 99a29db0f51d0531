//! Section of the page that compares the solver with DEM: errors and targets. The figures are in `curves`,
//! `fields`, `states` and `beyond`.

use super::html::case_name;
use super::{beyond, curves, fields, states};
use crate::ReportError;
use crate::report::Made;
use crate::studies::validation::Validated;
use msdd_draw::html::{fixed, table};

/// Errors that the paper reports: case, T at P1, P2, P3 [% of the range], pressure [% of its range].
const PAPER: [(&str, [&str; 3], &str); 3] =
    [("H", ["–", "5.3", "–"], "9.6"), ("C", ["–", "2.8", "–"], "10.9"), ("HC", ["2.2", "1.3", "6.5"], "3.0")];

pub fn section(made: &Made) -> Result<String, ReportError> {
    let mut html = "<h2>Validation</h2>\n<p>Each run starts from the fields of one packing and is compared with that packing's discrete \
                    elements; T is a mean over windows of 40 mm. Pressure: the solver's mean against the mean of the discs off the walls (the box without two mean radii along each wall: grains \
                    at a wall are packed more loosely, which the cells of the solver do not describe), and against the whole box. Errors are solver minus DEM where they are largest; in brackets the \
                    largest of a single packing. Sub-regions: 10 × 3, at the end, root mean square over all packings; worst one in \
                    brackets.</p>\n"
        .to_string();
    html += &errors_table(made);
    html += &targets_table(made);
    html += &curves::section(made)?;
    html += &fields::section(made)?;
    html += &states::section(made)?;
    html += &beyond::section(made)?;
    Ok(html)
}

fn errors_table(made: &Made) -> String {
    let mut rows: Vec<Vec<String>> = made.report.validation.iter().map(|v| row(made, v)).collect();
    for (case, temperature, pressure) in PAPER {
        let mut row = vec![case.to_string(), "the paper, quoted".to_string()];
        row.extend(temperature.map(str::to_string));
        row.extend(["–".to_string(), pressure.to_string()]);
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
        "pressure, off the walls [%]",
        "whole box [%]",
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
        row.extend((0..11).map(|_| "–".to_string()));
        return row;
    };
    let worst = |values: &mut dyn Iterator<Item = f64>| {
        values.fold(0.0, |w: f64, v| if v.abs() > w.abs() { v } else { w })
    };
    for probe in 0..3 {
        let each = worst(&mut errors.temperature_of_seeds.iter().map(|e| e[probe]));
        row.push(format!("{:.1} ({each:.1})", errors.temperature[probe]));
    }
    let each = worst(&mut errors.pressure_inner_of_seeds.iter().copied());
    row.push(errors.pressure_inner.map_or("–".to_string(), |inner| format!("{inner:.1} ({each:.1})")));
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
                (None, _) => "not judged by the quick report".to_string(),
                (Some(true), _) => "reached".to_string(),
                (Some(false), Some(value)) => format!("missed, {:.1} times the target", value / t.target),
                (Some(false), None) => "not known".to_string(),
            };
            vec![
                case_name(&t.case).to_string(),
                t.what.clone(),
                t.target.to_string(),
                fixed(t.reached, 2),
                t.beside.clone(),
                verdict,
            ]
        })
        .collect();
    let said = match made.report.quick {
        true => "not judged by the quick report: they are for 100 × 30 cells and the mean of three packings, and it runs coarser \
                 meshes and one packing, whose errors stand below. <code>scripts/report</code> judges them"
            .to_string(),
        false => {
            let met = made.report.targets.iter().filter(|t| t.met == Some(true)).count();
            format!("{met} of {} reached", rows.len())
        }
    };
    format!(
        "<p>Targets, with grains that move: {said}.</p>\n{}",
        table(&["'case", "'what", "at most", "reached", "'beside", "'verdict"], &rows)
    )
}

/// Outcome of a run that was not completed, with its message.
fn why(v: &Validated) -> String {
    let message: String = v.message.chars().take(80).collect();
    if message.is_empty() { v.outcome.clone() } else { format!("{}: {message}", v.outcome) }
}
