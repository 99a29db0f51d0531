//! The page: title that says the result, key numbers, accuracy and warnings, and the figures.

use super::curves::{self, Figure};
use super::maps::{self, QUANTITIES, spread};
use super::run::{Run, State};
use super::units::scaled;
use super::walls::{self, Along, Face};
use crate::error::CliError;
use msdd_case::section::View;
use msdd_draw::html::{head, table};
use msdd_draw::map::{SHADES, range_of};
use msdd_draw::text::significant;
use msdd_draw::{escape, number};
use serde_json::Value;
use std::fmt::Write;

/// Most bytes of a page.
const MAX_BYTES: usize = 2_000_000;
/// Numbers of colours of maps that are tried until the page is small enough.
const COLOURS: [usize; 3] = [SHADES, 16, 8];

/// Sections of the page and the figures in them.
const SECTIONS: [(&str, &[&str]); 5] = [
    ("Temperature", &["T", "gasTemperature", "T-time", "T-band", "profile"]),
    ("Grains", &["pressure", "conductivity", "D", "porosity"]),
    ("Walls", &["wall-stress-time", "wall-stress", "wall-shear", "wall-heat-time", "wall-heat"]),
    ("Gas", &["outlet", "pressure-drop", "gas-heat"]),
    ("Heat", &["heat"]),
];

/// Names of all figures that there can be.
pub fn names() -> Vec<&'static str> {
    SECTIONS.iter().flat_map(|section| section.1).copied().collect()
}

/// All figures of a run, with so many colours in the maps, which show all times or the last one.
pub fn figures(run: &Run, shades: usize, last_alone: bool) -> Result<Vec<Figure>, CliError> {
    let times = if last_alone { &run.shown[run.shown.len() - 1..] } else { &run.shown[..] };
    let mut figures = maps::all(run, times, shades)?;
    figures.extend(curves::all(run)?);
    Ok(figures)
}

/// The page. Maps of large meshes get fewer colours, or show the last time alone, until the page is small enough. With `animated` maps,
/// too, if wanted.
pub fn text(run: &Run, animated: bool) -> Result<String, CliError> {
    let mut page = String::new();
    for (shades, last_alone) in COLOURS.into_iter().map(|shades| (shades, false)).chain([(COLOURS[2], true)])
    {
        page = whole(run, &figures(run, shades, last_alone)?, last_alone)?;
        if page.len() < MAX_BYTES {
            return if animated { super::animation::add(run, &page, MAX_BYTES) } else { Ok(page) };
        }
    }
    let (bytes, most) = (page.len(), MAX_BYTES);
    Err(CliError::Message(format!(
        "the page of {} would have {bytes} bytes, allowed: {most}; name one time by --times",
        run.name
    )))
}

fn whole(run: &Run, figures: &[Figure], last_alone: bool) -> Result<String, CliError> {
    let title = title(run)?;
    let mut page = head(&title);
    let _ = writeln!(page, "<h1>{}</h1>\n<p>{}</p>", escape(&title), escape(&status(run)));
    page += "<h2>Key numbers</h2>\n<div class=\"panels\">\n<div>\n";
    page += &key_numbers(run)?;
    page += "</div>\n<div>\n";
    page += &results(run)?;
    page += "</div>\n</div>\n";
    page += &wall_table(run)?;
    page += &accuracy_and_warnings(run);
    for (name, ids) in SECTIONS {
        let own: Vec<&Figure> =
            ids.iter().flat_map(|id| figures.iter().filter(move |figure| figure.0 == *id)).collect();
        if own.is_empty() {
            continue;
        }
        let _ = writeln!(page, "<h2>{name}</h2>\n<div class=\"panels\">");
        for (id, svg) in own {
            let _ = writeln!(page, "<figure id=\"{id}\">{svg}</figure>");
        }
        page += "</div>\n";
    }
    let _ = writeln!(page, "<p class=\"source\">{}</p>\n</body>\n</html>", escape(&notes(run, last_alone)));
    Ok(page)
}

/// What came out.
fn title(run: &Run) -> Result<String, CliError> {
    let time = run.time(run.last());
    let Some(t) = spread(run, &QUANTITIES[0], run.last())? else {
        return Ok(format!("{} after {time}", run.name));
    };
    let [least, mean, most] = [t.least, t.mean, t.most].map(kelvin);
    let ends = if least == most {
        format!("{mean} K everywhere")
    } else {
        format!("{least} to {most} K, mean {mean} K")
    };
    Ok(format!("{}: {ends}, after {time}", run.name))
}

/// A temperature to a tenth of a kelvin.
fn kelvin(value: f64) -> String {
    number((10.0 * value).round() / 10.0)
}

fn status(run: &Run) -> String {
    let written = format!("{} times are written, the last one at {}", run.times.len(), run.time(run.last()));
    match &run.state {
        State::Finished => format!("The run has finished; {written}."),
        State::Running => {
            format!("The run has not finished: it is at work or was stopped. So far {written}.")
        }
        State::Failed(error) => format!("The run ended with an error: {error}. Before it {written}."),
    }
}

/// Least, mean and largest value of each field in the bed.
fn key_numbers(run: &Run) -> Result<String, CliError> {
    let mut rows = Vec::new();
    for quantity in &QUANTITIES {
        let Some(found) = spread(run, quantity, run.last())? else { continue };
        let (unit, factor) = scaled(found.most.abs().max(found.least.abs()), quantity.unit);
        let value = |value: f64| if unit == "K" { kelvin(value) } else { significant(factor * value, 3) };
        let [least, mean, most] = [found.least, found.mean, found.most].map(value);
        rows.push(vec![quantity.name.to_string(), unit.to_string(), least, mean, most]);
    }
    let time = run.time(run.last());
    Ok(format!("<p>In the bed at {time}; means by volume.</p>\n")
        + &table(&["'field", "'unit", "least", "mean", "largest"], &rows))
}

/// Numbers of the whole run.
fn results(run: &Run) -> Result<String, CliError> {
    let mut rows: Vec<Vec<String>> = Vec::new();
    let mut row = |name: &str, value: f64, unit: &'static str| {
        let (unit, factor) = if unit == "-" { ("", 1.0) } else { scaled(value, unit) };
        let text = match unit {
            "" => number(value),
            "K" => kelvin(value),
            _ => significant(factor * value, 4),
        };
        rows.push(vec![name.to_string(), text, unit.to_string()]);
    };
    for (_, table) in run.tables("flow.dat")? {
        let (numbers, columns) = (table.numbers()?, table.columns());
        let Some(last) = numbers.last() else { continue };
        for (column, name, unit) in [
            ("massFlow", "mass flow of the gas", "kg/s"),
            ("outletTemperature", "temperature at the outlet", "K"),
            ("pressureDrop", "pressure drop", "Pa"),
            ("heat", "heat that the gas gives to the bed", "W"),
        ] {
            if let Some(value) = columns.iter().position(|own| *own == column).and_then(|k| last.get(k)) {
                row(name, *value, unit);
            }
        }
    }
    if let Some(summary) = &run.summary {
        let of = |group: &str, key: &str| summary[group][key].as_f64();
        for (group, key, name, unit) in [
            ("heat", "patches", "heat through the walls", "J"),
            ("heat", "sources", "heat from sources and gas", "J"),
            ("heat", "stored", "heat that the grains took up", "J"),
            ("steady", "rate", "largest change of T at the end", "K/s"),
        ] {
            if let Some(value) = of(group, key) {
                row(name, value, unit);
            }
        }
        if let Some(steps) = summary["steps"].as_f64() {
            row("time steps", steps, "-");
        }
    }
    row("cells of the mesh", run.parts.iter().map(|part| part.mesh.volumes.len()).sum::<usize>() as f64, "-");
    if let Some(seconds) = run.wall_seconds {
        row("duration on the clock", seconds, "s");
    }
    Ok("<p>Of the run.</p>\n".to_string() + &table(&["'quantity", "value", "'unit"], &rows))
}

/// Heat and stress on each wall at the end.
fn wall_table(run: &Run) -> Result<String, CliError> {
    let found = walls::read(run, run.last())?;
    let (least, most) =
        range_of(found.iter().flat_map(|wall| wall.faces.iter().filter_map(|face| face.normal.as_ref())));
    let (unit, factor) = scaled(least.abs().max(most.abs()), "Pa");
    let row = |wall: &Along| {
        let ends = |value: fn(&Face) -> Option<f64>| {
            let values: Vec<f64> = wall.faces.iter().filter_map(value).collect();
            (!values.is_empty()).then(|| range_of(values.iter()))
        };
        let mean = || {
            let known = wall.faces.iter().filter_map(|face| Some((face.normal? * face.area, face.area)));
            let (force, area) = known.fold((0.0, 0.0), |(sum, area), (value, own)| (sum + value, area + own));
            (area > 0.0).then(|| force / area)
        };
        let text =
            |value: Option<f64>, factor: f64| value.map_or("–".to_string(), |x| significant(factor * x, 3));
        let normal = ends(|face| face.normal);
        vec![
            wall.name.clone(),
            text(wall.heat(), 1.0),
            text(normal.map(|ends| ends.0), factor),
            text(mean(), factor),
            text(normal.map(|ends| ends.1), factor),
            text(ends(|face| face.shear).map(|ends| ends.1), factor),
        ]
    };
    let [least, largest] =
        ["normal stress, least", "shear stress, largest"].map(|name| format!("{name} [{unit}]"));
    let heads = ["'wall", "heat into the bed [W]", &least, "mean", "largest", &largest];
    let rows: Vec<Vec<String>> = found.iter().map(row).collect();
    Ok(if rows.is_empty() { String::new() } else { table(&heads, &rows) })
}

fn accuracy_and_warnings(run: &Run) -> String {
    let Some(summary) = &run.summary else { return String::new() };
    let texts = |key: &str| summary[key].as_array().cloned().unwrap_or_default().into_iter();
    let text = |value: Value| value.as_str().map(escape);
    let warnings =
        texts("warnings").filter_map(text).map(|text| format!("<li class=\"no\">Warning: {text}</li>\n"));
    let sentences = texts("what_to_know").filter_map(text).map(|text| format!("<li>{text}</li>\n"));
    let all: String = warnings.chain(sentences).collect();
    if all.is_empty() { all } else { format!("<h2>Accuracy and warnings</h2>\n<ul>\n{all}</ul>\n") }
}

/// What a reader has to know about the figures.
fn notes(run: &Run, last_alone: bool) -> String {
    let mut text = match &run.views[0] {
        View::Wedge { angle, .. } => {
            let share = std::f64::consts::TAU / angle;
            format!(
                "The mesh is a wedge of {} degrees; heat and mass flow refer to the wedge, {} times as much in the whole bed. \
                 Maps: the section through the axis, mirrored. ",
                significant(angle.to_degrees(), 3),
                significant(share, 4)
            )
        }
        View::Cut { .. } => {
            let names: Vec<String> = run.views.iter().map(View::name).collect();
            format!("Maps: cuts at {}. ", names.join(" (left) and "))
        }
        View::Layer { .. } => "Heat refers to the thickness of the mesh. ".to_string(),
    };
    if last_alone {
        text += "The mesh is large: maps show the last time alone. ";
    }
    let file = |part: &super::run::Part| {
        if part.region.is_empty() { "bed".to_string() } else { part.region.clone() }
    };
    if run.parts.len() > 1 {
        let names: Vec<String> = run.parts.iter().map(file).collect();
        let _ = write!(
            text,
            "Regions: {}; numbers and curves are of the first one, maps show regions that have the field. ",
            names.join(", ")
        );
    }
    text + &format!("Stress is positive in compression. Made by msdd {}.", env!("CARGO_PKG_VERSION"))
}
