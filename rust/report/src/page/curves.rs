//! Section of the page with curves over time: T at the probes, mean pressure, stress at the walls.

use super::html::{Figure, case_name};
use crate::ReportError;
use crate::plan::FAMILIES;
use crate::report::Made;
use crate::studies::detail::{WALL_COLUMNS, WALLS};
use crate::studies::validation::Validated;
use msdd_draw::{Axis, Line, Marker, Series, Style, plot};
use msdd_reference::packings::Reference;
use msdd_reference::series::statistics;
use msdd_reference::series::{at, largest};
use msdd_reference::solver::Run;

const SOURCE: &str = "DEM committed; solver measured and cached";
const TIME: Axis = Axis { label: "t [s]", log: false, range: Some((0.0, 20.0)) };
/// Style of DEM.
const DISCS: Style = Style { colour: 0, marker: Marker::Circle, line: Line::None, hollow: false, size: 4 };
/// Style of DEM when they are averaged over the whole box.
const DISCS_WHOLE: Style =
    Style { colour: 0, marker: Marker::Square, line: Line::None, hollow: true, size: 4 };

pub fn section(made: &Made) -> Result<String, ReportError> {
    Ok(temperatures(made)? + &pressures(made)? + &walls(made)?)
}

/// Line styles of the validated configurations, in their order.
pub const LINES: [(Line, usize); 4] =
    [(Line::Solid, 1), (Line::Dashed, 2), (Line::Dotted, 3), (Line::Dashed, 5)];

pub fn configurations(made: &Made) -> Vec<String> {
    let mut names: Vec<String> = Vec::new();
    for v in &made.report.validation {
        if !names.contains(&v.configuration) {
            names.push(v.configuration.clone());
        }
    }
    names
}

pub fn keys(made: &Made) -> Vec<(Style, String)> {
    let mut keys: Vec<(Style, String)> = configurations(made)
        .into_iter()
        .zip(LINES)
        .map(|(name, (line, colour))| (Style::line(colour, line), name))
        .collect();
    keys.push((Style::marker(0, Marker::Circle), "DEM, bars: scatter of the packings".to_string()));
    keys
}

/// Mean over the packings of a series of the runs.
fn mean(runs: &[Run], of: impl Fn(&Run) -> Vec<(f64, f64)>) -> Vec<(f64, f64)> {
    let all: Vec<Vec<(f64, f64)>> = runs.iter().map(of).collect();
    let values: Vec<Vec<f64>> = all.iter().map(|series| series.iter().map(|p| p.1).collect()).collect();
    let times = all.first().cloned().unwrap_or_default();
    times.iter().zip(statistics(&values)).map(|(&(t, _), (m, _))| (t, m)).collect()
}

pub fn curves(made: &Made, case: &str, of: impl Fn(&Run) -> Vec<(f64, f64)>) -> Vec<Series> {
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

/// Points of the reference at some of its times, with the scatter of the packings.
fn elements(reference: &Reference, by_packing: &[Vec<f64>], scale: f64, style: Style) -> Series {
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
        style: Style { size: 3, ..style },
    }
}

fn temperatures(made: &Made) -> Result<String, ReportError> {
    let mut panels = Vec::new();
    for reference in &made.references {
        for (probe, by_packing) in reference.temperature().iter().enumerate() {
            // In a symmetric case, P3 is the mirror image of P1 and differs from it by the packing only: not drawn.
            if !reference.case.starts_with("HC") && probe == 2 {
                continue;
            }
            let of = |run: &Run| run.temperature.iter().map(|row| (row[0], row[1 + probe])).collect();
            let mut series = curves(made, &reference.case, of);
            series.push(elements(reference, by_packing, 1.0, DISCS));
            let title = format!("case {}, P{}", case_name(&reference.case), probe + 1);
            panels.push(plot(&title, &TIME, &Axis { label: "T [K]", log: false, range: None }, &series)?);
        }
    }
    let caption = format!(
        "Fig. #. T at the probes (paper, Figs. 11, 17, 18): means over the packings. Largest errors at P1, P2, P3: {}.",
        worst_temperatures(made)
    );
    Figure { id: "temperatures", panels, keys: keys(made), caption, source: SOURCE }.html(&made.report.made)
}

fn worst_temperatures(made: &Made) -> String {
    let of = |v: &Validated| {
        let [a, b, c] = v.errors.as_ref()?.temperature;
        Some(format!("{} {}: {a:.1}, {b:.1}, {c:.1} %", case_name(&v.case), v.configuration))
    };
    let expanding = made.report.validation.iter().filter(|v| !v.case.ends_with("star"));
    expanding.filter_map(of).collect::<Vec<_>>().join("; ")
}

fn expanding(made: &Made) -> impl Iterator<Item = &Reference> {
    made.references.iter().filter(|r| !r.case.ends_with("star"))
}

fn pressures(made: &Made) -> Result<String, ReportError> {
    let mut panels = Vec::new();
    for reference in expanding(made) {
        let of = |run: &Run| run.pressure.iter().map(|row| (row[0], 1e-3 * row[1])).collect();
        let mut series = curves(made, &reference.case, of);
        series.push(elements(reference, &reference.series("pressure_inner"), 1e-3, DISCS));
        series.push(elements(reference, &reference.series("pressure"), 1e-3, DISCS_WHOLE));
        let y = Axis { label: "mean pressure [kPa]", log: false, range: None };
        panels.push(plot(&format!("case {}", case_name(&reference.case)), &TIME, &y, &series)?);
    }
    let error = |v: &Validated| {
        let errors = v.errors.as_ref()?;
        let (name, inner) = (case_name(&v.case), errors.pressure_inner?);
        Some(format!("{name} {}: {inner:.1}, {:.1} %", v.configuration, errors.pressure))
    };
    let shown = made.report.validation.iter().filter(|v| !v.case.ends_with("star"));
    let caption = format!(
        "Fig. #. Mean pressure (paper, Fig. 20). Grains at a wall are packed more loosely, so the pressure of the whole box of discs is below that of its inner region, \
         two mean radii away from the walls. Largest errors against the inner region and against the whole box, % of the paper's range: {}.",
        shown.filter_map(error).collect::<Vec<_>>().join("; ")
    );
    let mut keys = keys(made);
    if let Some(last) = keys.last_mut() {
        last.1 = "DEM, inner region, bars: scatter of the packings".to_string();
    }
    keys.push((DISCS_WHOLE, "DEM, whole box".to_string()));
    Figure { id: "pressures", panels, keys, caption, source: SOURCE }.html(&made.report.made)
}

/// A group of walls: name, their indices in the order left, right, bottom, top, and how it is drawn.
type Walls = (&'static str, &'static [usize], usize, Marker, Line);
const ENDS_AND_SIDES: [Walls; 2] = [
    ("left and right", &[0, 1], 1, Marker::Circle, Line::Solid),
    ("bottom and top", &[2, 3], 2, Marker::Square, Line::Dashed),
];
const HOT_COLD_SIDES: [Walls; 3] = [
    ("left (hot)", &[0], 1, Marker::Circle, Line::Solid),
    ("right (cold)", &[1], 3, Marker::Triangle, Line::Dotted),
    ("bottom and top", &[2, 3], 2, Marker::Square, Line::Dashed),
];

/// Normal stress of the discs on walls [Pa], force over length, by packing.
fn wall_stress(reference: &Reference, walls: &[usize]) -> Vec<Vec<f64>> {
    let names = ["left", "right", "bottom", "top"];
    let of = |result: &msdd_reference::results::Results| -> Vec<f64> {
        let columns: Vec<(Vec<f64>, f64)> = walls
            .iter()
            .map(|&k| {
                let force = result.series.column(&format!("normal_force_{}", names[k])).unwrap_or_default();
                (force, result.size[if k < 2 { 1 } else { 0 }])
            })
            .collect();
        let count = columns.iter().map(|c| c.0.len()).min().unwrap_or(0);
        let mean =
            |t: usize| columns.iter().map(|(f, length)| f[t] / length).sum::<f64>() / walls.len() as f64;
        (0..count).map(mean).collect()
    };
    reference.results.iter().map(of).collect()
}

fn walls(made: &Made) -> Result<String, ReportError> {
    let (mut panels, mut said) = (Vec::new(), Vec::new());
    for reference in expanding(made) {
        let groups = if reference.case == "HC" { &HOT_COLD_SIDES[..] } else { &ENDS_AND_SIDES[..] };
        let runs = made.details.watched.iter();
        let moving = &made.report.validation.iter().find(|v| v.family == FAMILIES[1]);
        let name = moving.map(|v| v.configuration.clone()).unwrap_or_default();
        let runs =
            runs.filter(|((case, configuration), _)| *case == reference.case && *configuration == name);
        let runs: Vec<Run> = runs.flat_map(|(_, runs)| runs.clone()).collect();
        let (mut series, mut differences) = (Vec::new(), Vec::new());
        for (name, walls, colour, marker, line) in groups {
            let stress = |row: &Vec<f64>| -> f64 {
                walls.iter().filter_map(|&k| row.get(WALL_COLUMNS[k])).sum::<f64>() / walls.len() as f64
            };
            let of = |run: &Run| -> Vec<(f64, f64)> {
                run.watched.get(WALLS).into_iter().flatten().map(|row| (row[0], 1e-3 * stress(row))).collect()
            };
            let dem = wall_stress(reference, walls);
            let solver = mean(&runs, of);
            let discs: Vec<[f64; 2]> = reference
                .times()
                .into_iter()
                .zip(statistics(&dem))
                .map(|(t, (m, _))| [t, 1e-3 * m])
                .collect();
            let each: Vec<f64> = solver.iter().map(|(t, value)| value - at(&discs, *t)).collect();
            differences.push(format!("{name} {:+.2}", largest(&each)));
            series.push(Series { points: solver, bars: Vec::new(), style: Style::line(*colour, *line) });
            series.push(elements(reference, &dem, 1e-3, Style::marker(*colour, *marker)));
        }
        let y = Axis { label: "normal stress on the wall [kPa]", log: false, range: None };
        panels.push(plot(&format!("case {}", case_name(&reference.case)), &TIME, &y, &series)?);
        said.push(format!("{}: {}", case_name(&reference.case), differences.join(", ")));
    }
    let mut keys = Vec::new();
    for ((_, _, colour, marker, line), name) in HOT_COLD_SIDES.into_iter().zip([
        "left and right; in HC left (hot)",
        "in HC right (cold)",
        "bottom and top",
    ]) {
        keys.push((Style { line, ..Style::marker(colour, marker) }, name.to_string()));
    }
    let caption = format!(
        "Fig. #. Normal stress on the walls over time, markers: DEM (force of the grains over the length of the wall), lines: solver, grains \
         that move, in the cells at the wall. Largest difference, solver minus DEM [kPa]: {}.",
        said.join("; ")
    );
    Figure { id: "walls", panels, keys, caption, source: SOURCE }.html(&made.report.made)
}
