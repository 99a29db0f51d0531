//! Curves over time, in the language of [`msdd_draw::page`]: T at the probes, mean pressure, stress at the walls, slices along x.

use super::names::case_name;
use crate::plan::FAMILIES;
use crate::report::Made;
use crate::studies::detail::{WALL_COLUMNS, WALLS};
use crate::studies::other_cases::WAYS;
use crate::studies::spheres::Spheres;
use msdd_dem_reference::packings::Reference;
use msdd_dem_reference::results::Results;
use msdd_dem_reference::series::{at, largest, statistics};
use msdd_dem_reference::solver::{COLUMNS, Run};
use serde_json::{Value, json};
use std::fmt::Write;

/// Styles of the validated configurations, in their order.
const LINES: [&str; 4] = ["1 solid", "2 dashed", "3 dotted", "5 dashed"];
const DISCS: &str = "0 circle size=3 | DEM, bars: scatter of the packings";
const DISCS_WHOLE: &str = "0 square hollow size=3 | DEM, whole box";

pub fn all(made: &Made) -> Value {
    let (walls, wall_differences) = walls(made);
    json!({
        "temperatures": temperatures(made), "pressures": pressures(made), "walls": walls, "wall_differences": wall_differences,
        "profiles": profiles(made), "other_cases": other_cases(made),
    })
}

/// A series with points (x, y, half the length of the error bar).
fn series<const N: usize>(look: &str, points: impl IntoIterator<Item = [f64; N]>) -> String {
    let mut text = format!("series {look}\n");
    for point in points {
        let _ = writeln!(text, "{}", point.map(|number| number.to_string()).join(" "));
    }
    text
}

pub fn configurations(made: &Made) -> Vec<String> {
    let mut names: Vec<String> = Vec::new();
    for v in &made.report.validation {
        if !names.contains(&v.configuration) {
            names.push(v.configuration.clone());
        }
    }
    names
}

/// Mean over the packings of a series of the runs.
fn mean(runs: &[Run], of: impl Fn(&Run) -> Vec<[f64; 2]>) -> Vec<[f64; 2]> {
    let all: Vec<Vec<[f64; 2]>> = runs.iter().map(of).collect();
    let values: Vec<Vec<f64>> = all.iter().map(|series| series.iter().map(|p| p[1]).collect()).collect();
    let times = all.first().cloned().unwrap_or_default();
    times.iter().zip(statistics(&values)).map(|([t, _], (mean, _))| [*t, mean]).collect()
}

/// The validated configurations in a case.
fn curves(made: &Made, case: &str, of: impl Fn(&Run) -> Vec<[f64; 2]>) -> String {
    let named = configurations(made).into_iter().zip(LINES);
    let one = |(name, line): (String, &str)| {
        let runs = made.runs.get(&(case.to_string(), name.clone()))?;
        Some(series(&format!("{line} | {name}"), mean(runs, &of)))
    };
    named.filter_map(one).collect()
}

/// Points of the reference at some of its times, with the scatter of the packings.
fn elements(reference: &Reference, by_packing: &[Vec<f64>], scale: f64, look: &str) -> String {
    let shown = |t: f64| {
        [0.0, 0.5, 1.0, 1.5, 2.0, 3.0, 4.0, 5.0].iter().any(|s| (s - t).abs() < 1e-6)
            || (t > 5.5 && (t / 2.5 - (t / 2.5).round()).abs() < 1e-6)
    };
    let all = reference.times().into_iter().zip(statistics(by_packing)).filter(|(t, _)| shown(*t));
    series(look, all.map(|(t, (mean, deviation))| [t, scale * mean, scale * deviation]))
}

fn temperatures(made: &Made) -> String {
    let mut text = String::new();
    for reference in &made.references {
        for (probe, by_packing) in reference.temperature().iter().enumerate() {
            // In a symmetric case, P3 is the mirror image of P1 and differs from it by the packing only: not drawn.
            if !reference.case.starts_with("HC") && probe == 2 {
                continue;
            }
            let of = |run: &Run| run.temperature.iter().map(|row| [row[0], row[1 + probe]]).collect();
            let _ = writeln!(text, "panel case {}, P{}", case_name(&reference.case), probe + 1);
            text += &(curves(made, &reference.case, of) + &elements(reference, by_packing, 1.0, DISCS));
        }
    }
    text
}

fn expanding(made: &Made) -> impl Iterator<Item = &Reference> {
    made.references.iter().filter(|r| !r.case.ends_with("star"))
}

fn pressures(made: &Made) -> String {
    let mut text = String::new();
    for reference in expanding(made) {
        let of = |run: &Run| run.pressure.iter().map(|row| [row[0], 1e-3 * row[1]]).collect();
        let _ = writeln!(text, "panel case {}", case_name(&reference.case));
        text += &curves(made, &reference.case, of);
        text += &elements(
            reference,
            &reference.series("pressure_inner"),
            1e-3,
            &DISCS.replace(',', ", inner region,"),
        );
        text += &elements(reference, &reference.series("pressure"), 1e-3, DISCS_WHOLE);
    }
    text
}

/// A group of walls: their indices in the order left, right, bottom, top, line, marker, and name.
type Walls = (&'static [usize], &'static str, &'static str, &'static str);
const ENDS_AND_SIDES: [Walls; 2] =
    [(&[0, 1], "1 solid", "1 circle", "left and right"), (&[2, 3], "2 dashed", "2 square", "bottom and top")];
const HOT_COLD_SIDES: [Walls; 3] = [
    (&[0], "1 solid", "1 circle", "left (hot)"),
    (&[1], "3 dotted", "3 triangle", "right (cold)"),
    ENDS_AND_SIDES[1],
];

/// Normal stress of the discs on walls [Pa], force over length, by packing.
fn wall_stress(reference: &Reference, walls: &[usize]) -> Vec<Vec<f64>> {
    let names = ["left", "right", "bottom", "top"];
    let of = |result: &Results| -> Vec<f64> {
        let columns = walls.iter().map(|&k| {
            let force = result.series.column(&format!("normal_force_{}", names[k])).unwrap_or_default();
            (force, result.size[if k < 2 { 1 } else { 0 }])
        });
        let columns: Vec<(Vec<f64>, f64)> = columns.collect();
        let count = columns.iter().map(|c| c.0.len()).min().unwrap_or(0);
        let mean =
            |t: usize| columns.iter().map(|(f, length)| f[t] / length).sum::<f64>() / walls.len() as f64;
        (0..count).map(mean).collect()
    };
    reference.results.iter().map(of).collect()
}

/// The curves of the walls, and the largest differences in words.
fn walls(made: &Made) -> (String, String) {
    let (mut text, mut said) = (String::new(), Vec::new());
    let moving = made.report.validation.iter().find(|v| v.family == FAMILIES[1]);
    let moving = moving.map(|v| v.configuration.clone()).unwrap_or_default();
    for reference in expanding(made) {
        let groups = if reference.case == "HC" { &HOT_COLD_SIDES[..] } else { &ENDS_AND_SIDES[..] };
        let runs = made.details.watched.get(&(reference.case.clone(), moving.clone()));
        let mut differences = Vec::new();
        let _ = writeln!(text, "panel case {}", case_name(&reference.case));
        for (walls, line, marker, name) in groups {
            let stress = |row: &Vec<f64>| {
                walls.iter().filter_map(|&k| row.get(WALL_COLUMNS[k])).sum::<f64>() / walls.len() as f64
            };
            let of = |run: &Run| -> Vec<[f64; 2]> {
                run.watched.get(WALLS).into_iter().flatten().map(|row| [row[0], 1e-3 * stress(row)]).collect()
            };
            let dem = wall_stress(reference, walls);
            let solver = mean(runs.map_or(&[], Vec::as_slice), of);
            let means = reference.times().into_iter().zip(statistics(&dem));
            let discs: Vec<[f64; 2]> = means.map(|(t, (mean, _))| [t, 1e-3 * mean]).collect();
            let each: Vec<f64> = solver.iter().map(|[t, value]| value - at(&discs, *t)).collect();
            differences.push(format!("{name} {:+.2}", largest(&each)));
            text += &series(line, solver);
            text += &elements(reference, &dem, 1e-3, &format!("{marker} size=3 | {name}"));
        }
        said.push(format!("{}: {}", case_name(&reference.case), differences.join(", ")));
    }
    (text, said.join("; "))
}

/// Stress and displacement in ten slices of case HC.
fn profiles(made: &Made) -> String {
    let Some(reference) = made.references.iter().find(|r| r.case == "HC") else { return String::new() };
    let x = |k: usize| (k as f64 + 0.5) * 0.215;
    let column = COLUMNS.iter().position(|c| *c == "stress_xx").unwrap_or(0);
    let stress = |run: &Run| -> Vec<[f64; 2]> {
        run.columns.iter().enumerate().map(|(k, row)| [x(k), 1e-3 * row[column]]).collect()
    };
    let moved =
        |run: &Run| run.displacement.iter().flatten().enumerate().map(|(k, u)| [x(k), 1e3 * u]).collect();
    let dem = |name: &str, scale: f64| {
        let slices = statistics(&reference.slices(name)).into_iter().enumerate();
        series(DISCS, slices.map(|(k, (mean, deviation))| [x(k), scale * mean, scale * deviation]))
    };
    [
        "panel case HC, stress along x\ny σ_xx [kPa]\n".to_string(),
        curves(made, "HC", stress),
        dem("stress_xx", 1e-3),
        "panel case HC, displacement along x\ny u_x [mm]\n".to_string(),
        curves(made, "HC", moved),
        dem("displacement_x", 1e3),
    ]
    .concat()
}

fn other_cases(made: &Made) -> String {
    let found = &made.other_cases;
    let mut text = String::new();
    for discs in &found.discs {
        let times = discs.series.column("time").unwrap_or_default();
        let _ = writeln!(text, "panel case {}", discs.case);
        for (probe, marker) in ["1 circle", "2 square", "3 triangle"].into_iter().enumerate() {
            for ((way, _), line) in WAYS.iter().zip(["solid", "dotted"]) {
                let run = found.runs.get(&(discs.case.clone(), (*way).to_string()));
                let points = run.iter().flat_map(|run| &run.temperature).map(|row| [row[0], row[1 + probe]]);
                text += &series(&format!("{} {line}", &marker[..1]), points);
            }
            let values = discs.series.column(&format!("T_P{}_window", probe + 1)).unwrap_or_default();
            let shown = times.iter().zip(values).step_by(20).map(|(t, value)| [*t, value]);
            text += &series(&format!("{marker} size=3"), shown);
        }
    }
    text
}

/// Beaulieu's bed: T over time by the solver and as measured.
pub fn steel(spheres: &Spheres) -> String {
    const ZERO_CELSIUS: f64 = 273.15;
    let mut text = String::new();
    for (k, record) in spheres.simulated.iter().enumerate() {
        let colour = k + 1;
        text += &series(
            &format!("{colour} solid"),
            record.rows.iter().map(|(t, value)| [*t, value - ZERO_CELSIUS]),
        );
        let at = spheres.measured.iter().filter(|one| (one.distance - record.distance).abs() < 1e-6);
        let look = format!(
            "{colour} auto hollow size=3 | measured, {:.0} mm below the plate",
            1e3 * record.distance
        );
        text += &series(&look, at.map(|one| [one.time, one.temperature - ZERO_CELSIUS]));
    }
    text
}
