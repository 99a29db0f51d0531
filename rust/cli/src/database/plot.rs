//! `msdd database plot`: the inputs with their convex hulls (Fig. 4 of the paper), and outputs against porosity, as SVG.

use crate::error::CliError;
use clap::Args;
use msdd_files::write;
use msdd_rve::database::{Kind, RampName, Record, read};
use msdd_rve::region::Polygon;
use plotters::coord::Shift;
use plotters::coord::types::RangedCoordf64;
use plotters::prelude::*;
use std::ops::Range;
use std::path::PathBuf;

/// Size of one panel.
const PANEL: (u32, u32) = (420, 400);
/// Blue: contraction, orange: expansion, black: hull and packed state. From the palette of Okabe and Ito, which
/// colour-blind readers can tell apart.
const DOWN: RGBColor = RGBColor(0, 114, 178);
const UP: RGBColor = RGBColor(230, 159, 0);
const REST: RGBColor = RGBColor(0, 0, 0);

#[derive(Args)]
pub struct Arguments {
    /// Database, or the CSV that was exported from one.
    #[arg(value_name = "FILE")]
    database: PathBuf,
    /// Folder for inputs.svg and outputs.svg.
    #[arg(long, value_name = "DIR")]
    out: PathBuf,
}

/// A state to draw: one of the thermal ramps that start from the packed state, if it bears load.
struct Point {
    /// η₀, f₀, ε.
    inputs: [f64; 3],
    porosity: f64,
    /// K_xx, K_yy over k; σ_xx, σ_yy reduced.
    outputs: [f64; 4],
}

/// A panel: axis labels, and the points with the strain that colours them.
struct Panel {
    x: &'static str,
    y: &'static str,
    points: Vec<([f64; 2], f64)>,
    hull: bool,
}

pub fn run(arguments: &Arguments) -> Result<(), CliError> {
    let points = points(&read(&arguments.database)?.records);
    if points.is_empty() {
        let file = arguments.database.display();
        return Err(CliError::Message(format!("{file}: holds no loaded thermal states")));
    }
    for (name, panels) in [("inputs.svg", inputs(&points)), ("outputs.svg", outputs(&points))] {
        let path = arguments.out.join(name);
        write(&path, svg(&panels)?.as_bytes())?;
        outln!("{} states in {}", points.len(), path.display());
    }
    Ok(())
}

fn points(records: &[Record]) -> Vec<Point> {
    let ramps = [RampName::Packed, RampName::Up, RampName::Down];
    let thermal =
        records.iter().filter(|r| r.kind == Kind::Thermal && ramps.contains(&r.ramp) && r.bears_load());
    let point = |r: &Record| {
        Some(Point {
            inputs: [r.initial_porosity?, r.initial_fabric_index?, r.strain],
            porosity: r.porosity?,
            outputs: [r.conductivity_xx?, r.conductivity_yy?, r.stress_xx_reduced?, r.stress_yy_reduced?],
        })
    };
    thermal.filter_map(point).collect()
}

/// The three projections of the input space.
fn inputs(points: &[Point]) -> Vec<Panel> {
    let names = ["initial porosity", "initial fabric index", "thermal strain"];
    let panel = |[a, b]: [usize; 2]| Panel {
        x: names[a],
        y: names[b],
        points: points.iter().map(|p| ([p.inputs[a], p.inputs[b]], p.inputs[2])).collect(),
        hull: true,
    };
    [[0, 1], [0, 2], [1, 2]].map(panel).into()
}

/// K and σ against the porosity of the same state.
fn outputs(points: &[Point]) -> Vec<Panel> {
    let names = ["K_xx / k", "K_yy / k", "sigma_xx l / (E r)", "sigma_yy l / (E r)"];
    let panel = |k: usize| Panel {
        x: "porosity",
        y: names[k],
        points: points.iter().map(|p| ([p.porosity, p.outputs[k]], p.inputs[2])).collect(),
        hull: false,
    };
    (0..names.len()).map(panel).collect()
}

/// The panels in a row.
fn svg(panels: &[Panel]) -> Result<String, CliError> {
    let mut text = String::new();
    draw(panels, &mut text).map_err(|error| CliError::Message(format!("cannot draw the plot: {error}")))?;
    Ok(text)
}

fn draw(panels: &[Panel], text: &mut String) -> Result<(), Box<dyn std::error::Error>> {
    let root = SVGBackend::with_string(text, (PANEL.0 * panels.len() as u32, PANEL.1)).into_drawing_area();
    root.fill(&WHITE)?;
    for (panel, area) in panels.iter().zip(root.split_evenly((1, panels.len()))) {
        panel.draw(&area)?;
    }
    root.present()?;
    Ok(())
}

impl Panel {
    fn draw(&self, area: &DrawingArea<SVGBackend<'_>, Shift>) -> Result<(), Box<dyn std::error::Error>> {
        let [x, y] = [0, 1].map(|k| range(self.points.iter().map(|(point, _)| point[k])));
        let mut chart = ChartBuilder::on(area)
            .margin(12)
            .x_label_area_size(40)
            .y_label_area_size(56)
            .build_cartesian_2d(x, y)?;
        chart
            .configure_mesh()
            .x_desc(self.x)
            .y_desc(self.y)
            .x_labels(6)
            .y_labels(8)
            .light_line_style(WHITE)
            .bold_line_style(BLACK.mix(0.12))
            .label_style(("sans-serif", 12))
            .axis_desc_style(("sans-serif", 14))
            .draw()?;
        self.draw_points(&mut chart)?;
        if self.hull {
            let mut border = Polygon::hull(self.points.iter().map(|(point, _)| *point).collect()).corners;
            border.extend(border.first().copied());
            let corners = border.into_iter().map(|[x, y]| (x, y));
            chart.draw_series(LineSeries::new(corners, REST.stroke_width(2)))?;
        }
        Ok(())
    }

    fn draw_points<'a>(
        &self,
        chart: &mut ChartContext<'a, SVGBackend<'a>, Cartesian2d<RangedCoordf64, RangedCoordf64>>,
    ) -> Result<(), String> {
        let colour = |strain: f64| match strain {
            s if s > 0.0 => UP,
            s if s < 0.0 => DOWN,
            _ => REST,
        };
        let mut points: Vec<_> = distinct(&self.points);
        // Packed states come last, so that they are drawn on top.
        points.sort_by_key(|(_, strain)| *strain == 0.0);
        let circle =
            |([x, y], strain): ([f64; 2], f64)| Circle::new((x, y), 1, colour(strain).mix(0.6).filled());
        chart.draw_series(points.into_iter().map(circle)).map_err(|error| error.to_string())?;
        Ok(())
    }
}

/// The points without duplicates: of circles at the same place only the last is visible.
fn distinct(points: &[([f64; 2], f64)]) -> Vec<([f64; 2], f64)> {
    let mut seen = std::collections::BTreeSet::new();
    let new = |(point, strain): &&([f64; 2], f64)| {
        seen.insert((point.map(f64::to_bits), (*strain == 0.0, *strain > 0.0)))
    };
    points.iter().filter(new).copied().collect()
}

/// Range of the values with a margin of 5 % on both sides.
fn range(values: impl Iterator<Item = f64>) -> Range<f64> {
    let (low, high) = values.fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), v| (l.min(v), h.max(v)));
    let spare = 0.05 * (high - low).max(1e-3);
    low - spare..high + spare
}

#[cfg(test)]
mod tests {
    use super::*;

    fn record(porosity: f64, fabric_index: f64, strain: f64) -> Record {
        let some = Some(0.5);
        Record {
            ramp: if strain > 0.0 { RampName::Up } else { RampName::Packed },
            strain,
            outcome: "settled".to_string(),
            initial_porosity: Some(porosity),
            initial_fabric_index: Some(fabric_index),
            porosity: Some(porosity),
            conductivity_xx: some,
            conductivity_yy: some,
            stress_xx_reduced: some,
            stress_yy_reduced: some,
            ..Record::default()
        }
    }

    #[test]
    fn inputs_and_their_hull_are_drawn_and_other_rows_left_out() {
        let mut records: Vec<Record> =
            [(0.1, 0.0), (0.15, 0.0), (0.12, 0.1), (0.12, 0.05)].map(|(p, f)| record(p, f, 0.0)).into();
        records.push(record(0.1, 0.0, 0.02));
        records.push(Record { outcome: "unjammed".to_string(), ..record(0.1, 0.0, 0.02) });
        records.push(Record { kind: Kind::Mechanics, ..record(0.1, 0.0, 0.0) });
        let points = points(&records);
        assert_eq!(points.len(), 5);
        let drawn = svg(&inputs(&points)).unwrap();
        // A place with two colours is drawn twice (a packed state, black, over an expanded one, orange), with one colour once.
        assert_eq!(drawn.matches("<circle").count(), 5 + 4 + 4);
        assert_eq!(drawn.matches(&format!("stroke=\"#{:06X}\" stroke-width=\"2\"", 0)).count(), 3, "{drawn}");
        for label in ["initial porosity", "initial fabric index", "thermal strain"] {
            assert!(drawn.contains(label), "{label}");
        }
        assert!(svg(&outputs(&points)).unwrap().contains("K_yy / k"));
    }
}
