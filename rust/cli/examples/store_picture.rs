//! What happens in a bed with gas that flows: the figures of the book's tutorial. Draws a row of panels from a finished case whose folder 0
//! has the centres of the cells (`postProcess -func writeCellCentres -time 0`):
//!
//! - `x`, `y` or `z`: temperatures of gas and spheres along this axis, at each time;
//! - `FOLDER/COLUMN*FACTOR:NAME`: a column of a table of `postProcessing` over time, such as `flow/pressureDrop*1:pressure drop [Pa]`.
//!
//! ```sh
//! cargo run --release -p msdd-cli --example store_picture -- CASE FILE.svg PANEL...
//! ```

use msdd_files::read_text;
use msdd_reference::solver::nonuniform;
use plotters::coord::Shift;
use plotters::coord::types::RangedCoordf64;
use plotters::prelude::*;
use std::collections::BTreeMap;
use std::error::Error;
use std::path::{Path, PathBuf};

type Result<T> = std::result::Result<T, Box<dyn Error>>;
type Panel<'a> = DrawingArea<SVGBackend<'a>, Shift>;
type Chart<'a> = ChartContext<'a, SVGBackend<'a>, Cartesian2d<RangedCoordf64, RangedCoordf64>>;
type Line = Vec<(f64, f64)>;

/// From blue to red, one a time.
const COLOURS: [RGBColor; 4] =
    [RGBColor(0, 114, 178), RGBColor(86, 180, 233), RGBColor(230, 159, 0), RGBColor(213, 94, 0)];
const HOUR: f64 = 3600.0;
const TEXT: (&str, i32) = ("sans-serif", 15);

fn main() -> Result<()> {
    let arguments: Vec<String> = std::env::args().collect();
    let [_, case, file, names @ ..] = arguments.as_slice() else {
        return Err("usage: store_picture CASE FILE.svg PANEL...".into());
    };
    let case = Path::new(case);
    let width = u32::try_from(names.len())? * 400;
    let root = SVGBackend::new(file, (width, 400)).into_drawing_area();
    root.fill(&WHITE)?;
    for (name, panel) in names.iter().zip(root.split_evenly((1, names.len()))) {
        let Some((source, title)) = name.split_once(':') else {
            profiles(case, name, &panel)?;
            continue;
        };
        let parts = source.split_once('/').and_then(|(folder, rest)| Some((folder, rest.split_once('*')?)));
        let (folder, (column, factor)) = parts.ok_or_else(|| format!("{name}: no panel"))?;
        let table = table(case, folder, &format!("{folder}.dat"))?;
        over_time(&panel, title, &series(&table, column, factor.parse()?)?)?;
    }
    root.present()?;
    Ok(())
}

/// Gas with full, spheres with broken lines, at each time.
fn profiles(case: &Path, axis: &str, panel: &Panel<'_>) -> Result<()> {
    let x = column(&case.join("0").join(format!("C{axis}")))?;
    let mut times: Vec<(f64, PathBuf)> = std::fs::read_dir(case)?
        .filter_map(|entry| entry.ok().map(|e| e.path()))
        .filter_map(|path| Some((path.file_name()?.to_str()?.parse().ok()?, path)))
        .filter(|(time, _)| *time > 0.0)
        .collect();
    times.sort_by(|a, b| a.0.total_cmp(&b.0));
    times.truncate(COLOURS.len());
    let lines: Vec<(f64, Line, Line)> = times
        .iter()
        .map(|(time, folder)| Ok((*time, along(&x, folder, "gasTemperature")?, along(&x, folder, "T")?)))
        .collect::<Result<_>>()?;
    let all: Line = lines.iter().flat_map(|(_, gas, spheres)| gas.iter().chain(spheres)).copied().collect();
    let mut chart = axes(panel, &all, &format!("{axis} [m]"), "T of gas (full) and spheres (broken) [K]")?;
    for ((time, gas, spheres), colour) in lines.iter().zip(COLOURS) {
        let style = colour.stroke_width(2);
        chart
            .draw_series(LineSeries::new(gas.iter().copied(), style))?
            .label(format!("{:.1} h", time / HOUR))
            .legend(move |(x, y)| PathElement::new([(x, y), (x + 24, y)], style));
        chart.draw_series(DashedLineSeries::new(spheres.iter().copied(), 6, 4, style))?;
    }
    let falls = lines.first().is_some_and(|(_, gas, _)| gas.first().map(|p| p.1) > gas.last().map(|p| p.1));
    chart
        .configure_series_labels()
        .position(if falls { SeriesLabelPosition::LowerLeft } else { SeriesLabelPosition::LowerRight })
        .background_style(WHITE.mix(0.8))
        .label_font(TEXT)
        .draw()?;
    Ok(())
}

fn over_time(panel: &Panel<'_>, name: &str, line: &Line) -> Result<()> {
    let mut chart = axes(panel, line, "time [h]", name)?;
    chart.draw_series(LineSeries::new(line.iter().copied(), COLOURS[0].stroke_width(2)))?;
    Ok(())
}

fn axes<'a>(panel: &Panel<'a>, points: &Line, x_name: &str, y_name: &str) -> Result<Chart<'a>> {
    let range = |values: &mut dyn Iterator<Item = f64>| {
        values.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], v| [low.min(v), high.max(v)])
    };
    let [left, right] = range(&mut points.iter().map(|p| p.0));
    let [low, high] = range(&mut points.iter().map(|p| p.1));
    let space = 0.05 * (high - low);
    let mut chart = ChartBuilder::on(panel)
        .margin(10)
        .x_label_area_size(42)
        .y_label_area_size(58)
        .build_cartesian_2d(left..right, low - space..high + space)?;
    chart
        .configure_mesh()
        .x_desc(x_name)
        .y_desc(y_name)
        .x_labels(6)
        .y_labels(8)
        .y_label_formatter(&|value| format!("{value:.0}"))
        .light_line_style(WHITE)
        .bold_line_style(BLACK.mix(0.12))
        .label_style(TEXT)
        .axis_desc_style(TEXT)
        .draw()?;
    Ok(chart)
}

/// The values of a field of scalars.
fn column(file: &Path) -> Result<Vec<f64>> {
    let values = nonuniform(&read_text(file)?).map_err(|text| format!("{}: {text}", file.display()))?;
    Ok(values.iter().map(|value| value[0]).collect())
}

/// Means of a field over the cells at the same place along the axis.
fn along(x: &[f64], folder: &Path, field: &str) -> Result<Line> {
    let mut sums = BTreeMap::<i64, [f64; 3]>::new();
    for (x, value) in x.iter().zip(column(&folder.join(field))?) {
        let sum = sums.entry((x * 1e6).round() as i64).or_default();
        (sum[0], sum[1], sum[2]) = (sum[0] + x, sum[1] + value, sum[2] + 1.0);
    }
    Ok(sums.values().map(|[x, value, n]| (x / n, value / n)).collect())
}

/// Columns of a table of the run, by name.
fn table(case: &Path, folder: &str, name: &str) -> Result<BTreeMap<String, Vec<f64>>> {
    let text = read_text(&case.join("postProcessing").join(folder).join("0").join(name))?;
    let header = text.lines().rfind(|line| line.starts_with('#')).ok_or("a table without names")?;
    let names: Vec<&str> = header.trim_start_matches('#').split_whitespace().collect();
    let mut columns = BTreeMap::new();
    for line in text.lines().filter(|line| !line.starts_with('#')) {
        for (name, value) in names.iter().zip(line.split_whitespace()) {
            columns.entry((*name).to_string()).or_insert_with(Vec::new).push(value.parse()?);
        }
    }
    Ok(columns)
}

fn series(table: &BTreeMap<String, Vec<f64>>, name: &str, factor: f64) -> Result<Line> {
    let column = |name: &str| table.get(name).ok_or_else(|| format!("there is no column {name}"));
    Ok(column("Time")?.iter().map(|t| t / HOUR).zip(column(name)?.iter().map(|v| v * factor)).collect())
}
