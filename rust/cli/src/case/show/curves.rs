//! Curves over time, along an axis and along the walls.

use super::maps::{QUANTITIES, Quantity, spread};
use super::run::Run;
use super::units::scaled;
use super::walls::{self, Along};
use crate::error::CliError;
use msdd_case::tables::Table;
use msdd_draw::map::range_of;
use msdd_draw::text::significant;
use msdd_draw::{Line, Marker, Series, Style, from_data, plot_named, series};
use std::collections::{BTreeMap, BTreeSet};

/// A figure with the name by which `--figures` selects it.
pub type Figure = (&'static str, String);

/// At most so many curves are drawn in a figure, and so many places along an axis.
const MAX_CURVES: usize = 8;
const PLACES: usize = 60;
/// Most rows of cells along an axis that are drawn one by one, else steps; rows are distinguished by this share of the length.
const MAX_ROWS: usize = 200;
const STEPS: f64 = 15.0;
const ROUNDED: f64 = 1e5;
const BANDS: &str = "bands.csv";

type Points = Vec<(f64, f64)>;

/// The colours of curves: black first, and the grey at the end.
fn colour(k: usize) -> usize {
    [2, 1, 3, 0, 5, 6, 7, 4][k % MAX_CURVES]
}

fn line(k: usize) -> Style {
    Style::line(colour(k), [Line::Solid, Line::Dashed, Line::Dotted][k / MAX_CURVES % 3])
}

/// Evenly spread numbers of at most [`MAX_CURVES`] of so many.
fn some(count: usize) -> Vec<usize> {
    let most = MAX_CURVES.min(count);
    (0..most).map(|k| if most < 2 { 0 } else { k * (count - 1) / (most - 1) }).collect()
}

/// A chart over time: curves with names, in the unit of their largest value. None without two points in a curve.
fn over_time(
    id: &'static str,
    title: &str,
    unit: &'static str,
    named: Vec<(String, Points)>,
) -> Result<Option<Figure>, CliError> {
    if named.iter().all(|(_, points)| points.len() < 2) {
        return Ok(None);
    }
    let (_, end) = range_of(named.iter().flat_map(|(_, points)| points.iter().map(|p| &p.0)));
    let (time_unit, time) = scaled(end, "s");
    let (low, high) = range_of(named.iter().flat_map(|(_, points)| points.iter().map(|p| &p.1)));
    let (unit, factor) = scaled(high.abs().max(low.abs()), unit);
    let curve = |(k, (name, points)): (usize, (String, Points))| {
        let points = points.into_iter().map(|(t, value)| (time * t, factor * value)).collect();
        (name, series(points, line(k)))
    };
    let list = named.into_iter().enumerate().map(curve).collect();
    let (x, y) = (format!("time [{time_unit}]"), format!("[{unit}]"));
    Ok(Some((id, plot_named(title, &from_data(&x, false), &from_data(&y, false), list)?)))
}

/// Time and a column of a table.
fn column(rows: &[Vec<f64>], k: usize) -> Points {
    rows.iter().filter_map(|row| Some((*row.first()?, *row.get(k)?))).collect()
}

/// All figures with curves.
pub fn all(run: &Run) -> Result<Vec<Figure>, CliError> {
    let mut figures = Vec::new();
    figures.extend(temperature(run)?);
    figures.extend(bands(run)?);
    figures.extend(profile(run)?);
    figures.extend(flow(run)?);
    figures.extend(wall_stress(run)?);
    figures.extend(wall_heat(run)?);
    figures.extend(along_walls(run)?);
    figures.extend(heat(run)?);
    Ok(figures)
}

/// T at the probes or, without any, least, mean and largest T of the written times.
fn temperature(run: &Run) -> Result<Option<Figure>, CliError> {
    let fixed = run.tables("spaceProbes.dat")?.into_iter();
    for (_, table) in fixed.chain(run.tables("T")?) {
        let rows = table.numbers()?;
        let names = points_of(&table);
        let count = names.len().min(rows.first().map_or(0, |row| row.len() - 1));
        if count > 0 && rows.len() > 1 {
            let named = some(count).into_iter().map(|k| (names[k].clone(), column(&rows, k + 1))).collect();
            let title = match count {
                ..=MAX_CURVES => "T at the probes".to_string(),
                _ => format!("T at {MAX_CURVES} of {count} probes"),
            };
            return over_time("T-time", &title, "K", named);
        }
    }
    let mut curves = [Vec::new(), Vec::new(), Vec::new()];
    for (k, (time, _)) in run.times.iter().enumerate() {
        let Some(found) = spread(run, &QUANTITIES[0], k)? else { continue };
        for (curve, value) in curves.iter_mut().zip([found.least, found.mean, found.most]) {
            curve.push((*time, value));
        }
    }
    let named = ["least", "mean", "largest"].map(str::to_string).into_iter().zip(curves).collect();
    over_time("T-time", "T of the grains", "K", named)
}

/// Names of probes: their points, from lines such as `# Probe 0 (1 2 3)`.
fn points_of(table: &Table) -> Vec<String> {
    let point = |line: &String| {
        let rest = line.strip_prefix("# Probe ")?;
        let (number, rest) = rest.split_once(|c: char| c.is_whitespace())?;
        let inner = rest.split_once('(')?.1.trim_end().trim_end_matches(')');
        let words =
            inner.split_whitespace().map(|word| word.parse().map_or("–".into(), |x| significant(x, 3)));
        Some(format!("P{} ({})", number.parse::<usize>().ok()? + 1, words.collect::<Vec<_>>().join(" ")))
    };
    table.head.iter().filter_map(point).collect()
}

/// T with its 90 % band, in the folder that `msdd case solve` has made.
fn bands(run: &Run) -> Result<Option<Figure>, CliError> {
    let file = run.folder.join(BANDS);
    if !file.is_file() {
        return Ok(None);
    }
    let text = msdd_files::read_text(&file)?;
    let mut lines = text.lines().filter(|line| !line.starts_with('#'));
    let head: Vec<&str> = lines.next().unwrap_or_default().split(',').collect();
    let place = |name: &str| head.iter().position(|column| *column == name);
    let columns = ["time", "x", "y", "z", "quantity", "value", "low", "high"].map(place);
    let mut points: BTreeMap<[String; 3], Vec<[f64; 4]>> = BTreeMap::new();
    for line in lines {
        let cells: Vec<&str> = line.split(',').collect();
        let cell = |k: usize| columns[k].and_then(|column| cells.get(column)).copied().unwrap_or_default();
        if cell(4) != "T" {
            continue;
        }
        let number = |k: usize| cell(k).parse().unwrap_or(f64::NAN);
        points.entry([1, 2, 3].map(|k| cell(k).to_string())).or_default().push([
            number(0),
            number(5),
            number(6),
            number(7),
        ]);
    }
    let all: Vec<(&[String; 3], &Vec<[f64; 4]>)> = points.iter().collect();
    if all.is_empty() {
        return Ok(None);
    }
    let (unit, factor) = scaled(all[0].1.iter().map(|row| row[0]).fold(0.0, f64::max), "s");
    let curve = |(k, at): (usize, usize)| {
        let (point, rows) = all[at];
        let point: Vec<String> =
            point.iter().map(|x| x.parse().map_or(x.clone(), |x| significant(x, 3))).collect();
        let half =
            |row: &[f64; 4]| Some(0.5 * (row[3] - row[2])).filter(|half| half.is_finite()).unwrap_or(0.0);
        (
            format!("({})", point.join(" ")),
            Series {
                points: rows.iter().map(|row| (factor * row[0], row[1])).collect(),
                bars: rows.iter().map(half).collect(),
                style: Style { marker: Marker::Circle, size: 2, ..line(k) },
            },
        )
    };
    let list = some(all.len().min(4))
        .into_iter()
        .map(|k| k * all.len() / all.len().min(4))
        .enumerate()
        .map(curve)
        .collect();
    let (x, y) = (format!("time [{unit}]"), from_data("[K]", false));
    Ok(Some(("T-band", plot_named("T with its 90 % band", &from_data(&x, false), &y, list)?)))
}

/// T of grains and gas along that axis of the picture on which it varies most, at the shown times.
fn profile(run: &Run) -> Result<Option<Figure>, CliError> {
    let view = &run.views[0];
    let places: Vec<[f64; 2]> = run.parts[0].mesh.centres.iter().map(|centre| view.at(*centre)).collect();
    let along = |axis: usize, values: &[f64]| -> Points {
        let (low, high) = range_of(places.iter().map(|p| &p[axis]));
        let share = |place: &[f64; 2]| (place[axis] - low) / (high - low).max(1e-300);
        // Rows of cells where the mesh has them, else steps that hold many cells
        let row = |place: &[f64; 2]| (ROUNDED * share(place)).round() as i64;
        let rows: BTreeSet<i64> = places.iter().map(row).collect();
        let step = |place: &[f64; 2]| ((STEPS - 1e-6) * share(place)).floor() as i64;
        let mut sums = BTreeMap::<i64, [f64; 3]>::new();
        for ((place, value), volume) in places.iter().zip(values).zip(&run.parts[0].mesh.volumes) {
            let key = if rows.len() <= MAX_ROWS { row(place) } else { step(place) };
            let sum = sums.entry(key).or_default();
            (0..3).for_each(|k| sum[k] += volume * [place[axis], *value, 1.0][k]);
        }
        sums.values().map(|[x, value, n]| (x / n, value / n)).collect()
    };
    let at = |quantity: &Quantity, time: usize| quantity.values(run, 0, time);
    let Some(last) = at(&QUANTITIES[0], run.last())? else { return Ok(None) };
    let change = |axis: usize| {
        let curve = along(axis, &last);
        let (low, high) = range_of(curve.iter().map(|p| &p.1));
        high - low
    };
    let axis = usize::from(change(1) >= change(0));
    let mut list = Vec::new();
    let mut gas = false;
    for (k, &time) in run.shown.iter().enumerate() {
        for (quantity, kind) in [(&QUANTITIES[0], Line::Solid), (&QUANTITIES[1], Line::Dashed)] {
            let Some(values) = at(quantity, time)? else { continue };
            gas |= kind == Line::Dashed;
            let name = if kind == Line::Solid { run.time(time) } else { String::new() };
            list.push((name, series(along(axis, &values), Style::line(colour(k), kind))));
        }
    }
    if list.iter().all(|(_, curve)| curve.points.len() < 2) {
        return Ok(None);
    }
    let name = &view.axes()[axis];
    let title = format!(
        "T {}along {name}, mean across it",
        if gas { "of grains (full) and gas (broken) " } else { "" }
    );
    let x = format!("{name} [m]");
    Ok(Some(("profile", plot_named(&title, &from_data(&x, false), &from_data("[K]", false), list)?)))
}

/// Temperature at the outlet and pressure drop of a gas that flows.
fn flow(run: &Run) -> Result<Vec<Figure>, CliError> {
    let mut figures = Vec::new();
    for (_, table) in run.tables("flow.dat")? {
        let (rows, columns) = (table.numbers()?, table.columns());
        let of = |name: &str| columns.iter().position(|column| *column == name).map(|k| column(&rows, k));
        let ends = [("outlet", of("outletTemperature")), ("inlet", of("inletTemperature"))];
        let named = ends.into_iter().filter_map(|(name, points)| Some((name.to_string(), points?))).collect();
        figures.extend(over_time("outlet", "T of the gas at the ends", "K", named)?);
        for (name, id, title, unit) in [
            ("pressureDrop", "pressure-drop", "pressure drop of the gas", "Pa"),
            ("heat", "gas-heat", "heat that the gas gives to the bed", "W"),
        ] {
            let Some(points) = of(name) else { continue };
            figures.extend(over_time(id, title, unit, vec![(String::new(), points)])?);
        }
    }
    Ok(figures)
}

/// Stress across each wall over time.
fn wall_stress(run: &Run) -> Result<Option<Figure>, CliError> {
    let Some((_, table)) = run.tables("wallPressure.dat")?.into_iter().next() else { return Ok(None) };
    let rows = table.numbers()?;
    let normal =
        |(k, name): (usize, &&str)| Some((name.strip_suffix("_normal")?.to_string(), column(&rows, k)));
    let walls = table.columns().iter().enumerate().filter_map(normal).take(MAX_CURVES).collect();
    over_time("wall-stress-time", "normal stress on each wall, mean", "Pa", walls)
}

/// Heat through each wall at the written times, at most so many as there are places.
fn wall_heat(run: &Run) -> Result<Option<Figure>, CliError> {
    let mut walls = BTreeMap::<String, Points>::new();
    for k in (0..run.times.len()).step_by(run.times.len().div_ceil(PLACES)) {
        for wall in walls::read(run, k)? {
            if let Some(heat) = wall.heat() {
                walls.entry(wall.name).or_default().push((run.times[k].0, heat));
            }
        }
    }
    over_time(
        "wall-heat-time",
        "heat through each wall into the bed",
        "W",
        walls.into_iter().take(MAX_CURVES).collect(),
    )
}

/// Normal stress and heat flux along each wall at the last time.
fn along_walls(run: &Run) -> Result<Vec<Figure>, CliError> {
    let found = walls::read(run, run.last())?;
    let mut figures = Vec::new();
    type Value = fn(&walls::Face) -> Option<f64>;
    let shown: [(&str, &str, &str, Value); 3] = [
        ("wall-stress", "normal stress along each wall", "Pa", |face| face.normal),
        ("wall-shear", "shear stress along each wall", "Pa", |face| face.shear),
        ("wall-heat", "heat flux into the bed along each wall", "W/m²", |face| face.heat),
    ];
    for (id, title, unit, value) in shown {
        let curves: Vec<(&Along, Points)> = found
            .iter()
            .map(|wall| (wall, wall.curve(PLACES, value)))
            .filter(|(_, points)| points.len() > 1)
            .collect();
        let (low, high) = range_of(curves.iter().flat_map(|(_, points)| points.iter().map(|p| &p.1)));
        if curves.is_empty() || (low == 0.0 && high == 0.0) {
            continue;
        }
        let (unit, factor) = scaled(high.abs().max(low.abs()), unit);
        let curve = |(k, (wall, points)): (usize, (&Along, Points))| {
            let points = points.into_iter().map(|(x, value)| (x, factor * value)).collect();
            (format!("{} (along {})", wall.name, wall.axis), series(points, line(k)))
        };
        let list = curves.into_iter().take(MAX_CURVES).enumerate().map(curve).collect();
        let title = format!("{title}, at {}", run.time(run.last()));
        let label = format!("[{unit}]");
        let x = from_data("position along the wall [m]", false);
        figures.push((id, plot_named(&title, &x, &from_data(&label, false), list)?));
    }
    Ok(figures)
}

/// Heat that came in, and that the bed holds, since the start.
fn heat(run: &Run) -> Result<Option<Figure>, CliError> {
    let mut tables = run.tables("heatAudit.dat")?;
    tables.extend(run.tables("regionHeat.dat")?);
    let Some((_, table)) = tables.into_iter().next() else { return Ok(None) };
    let rows = table.numbers()?;
    let wanted = |name: &str| ["patches", "fluids", "sources"].contains(&name) || name.ends_with("stored");
    let named = |(k, name): (usize, &&str)| wanted(name).then(|| (name.replace('_', " "), column(&rows, k)));
    let list = table.columns().iter().enumerate().filter_map(named).take(MAX_CURVES).collect();
    over_time("heat", "heat since the start", "J", list)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn probes_are_named_by_their_points() {
        let head =
            ["# Probe 0 (0.3225 0.32249999 0.005)", "# Probe 1 (1 2 3)", "#  Probe   0    1", "#  Time"];
        let table = Table { file: "T".into(), head: head.map(str::to_string).to_vec(), rows: Vec::new() };
        assert_eq!(points_of(&table), ["P1 (0.323 0.322 0.005)", "P2 (1 2 3)"]);
        assert_eq!((some(3), some(30).len(), some(30)[7], some(1)), (vec![0, 1, 2], 8, 29, vec![0]));
    }

    #[test]
    fn curves_over_time_have_units_that_fit() {
        let points = vec![(0.0, 0.0), (36_000.0, 2e5)];
        let (_, svg) = over_time("x", "stress", "Pa", vec![("side".into(), points)]).unwrap().unwrap();
        for text in ["time [h]", "[kPa]", "\n200\n", "\n10\n", "side"] {
            assert!(svg.contains(text), "{text}: {svg}");
        }
        assert_eq!(over_time("x", "", "K", vec![("a".into(), vec![(0.0, 1.0)])]).unwrap(), None);
    }
}
