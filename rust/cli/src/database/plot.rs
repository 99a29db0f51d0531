//! `msdd database plot`: the inputs with their convex hulls (Fig. 4 of the paper), and outputs against porosity, as SVG.

use crate::error::CliError;
use clap::Args;
use msdd_draw::text::significant;
use msdd_draw::{Line, Style, from_data, plot_named, series};
use msdd_files::write;
use msdd_rve::database::{Kind, RampName, Record, read};
use msdd_rve::region::Polygon;
use std::path::PathBuf;

/// Colours, by the sign of the strain: cooled, packed, heated.
const COLOURS: [(&str, usize); 3] = [("cooled", 2), ("heated", 7), ("packed", 0)];
/// Points of a panel closer than this share of the axes are drawn once.
const RESOLUTION: f64 = 2e-3;

#[derive(Args)]
pub struct Arguments {
    /// Database, or the CSV that was exported from one.
    #[arg(value_name = "FILE")]
    database: PathBuf,
    /// Folder for inputs.svg and outputs.svg.
    #[arg(long, value_name = "DIR")]
    out: PathBuf,
}

/// A state to draw: one of the thermal ramps that start from the packed state, if it carries load.
struct Point {
    /// η₀, f₀, ε.
    inputs: [f64; 3],
    porosity: f64,
    /// K_xx, K_yy over k; σ_xx, σ_yy reduced.
    outputs: [f64; 4],
}

/// A panel: axis labels, and the points with the strain that colours them.
struct Panel {
    names: [&'static str; 2],
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
        records.iter().filter(|r| r.kind == Kind::Thermal && ramps.contains(&r.ramp) && r.carries_load());
    let point = |r: &Record| {
        Some(Point {
            inputs: [r.initial_porosity?, r.initial_fabric_index?, r.strain],
            porosity: r.porosity?,
            outputs: [r.conductivity_xx?, r.conductivity_yy?, r.stress_xx_reduced?, r.stress_yy_reduced?],
        })
    };
    thermal.filter_map(point).collect()
}

/// The three projections of the input space. Packings have all their strains at one place of the first.
fn inputs(points: &[Point]) -> Vec<Panel> {
    let names = ["initial porosity", "initial fabric index", "thermal strain"];
    let panel = |[a, b]: [usize; 2]| Panel {
        names: [names[a], names[b]],
        points: points
            .iter()
            .map(|p| ([p.inputs[a], p.inputs[b]], if b == 2 { p.inputs[2] } else { 0.0 }))
            .collect(),
        hull: true,
    };
    [[0, 1], [0, 2], [1, 2]].map(panel).into()
}

/// K and σ against the porosity of the same state.
fn outputs(points: &[Point]) -> Vec<Panel> {
    let names = ["K_xx / k", "K_yy / k", "σ_xx ℓ / (E r)", "σ_yy ℓ / (E r)"];
    let panel = |k: usize| Panel {
        names: ["porosity", names[k]],
        points: points.iter().map(|p| ([p.porosity, p.outputs[k]], p.inputs[2])).collect(),
        hull: false,
    };
    (0..names.len()).map(panel).collect()
}

/// The panels in two columns.
fn svg(panels: &[Panel]) -> Result<String, CliError> {
    let drawn = panels.iter().map(Panel::draw).collect::<Result<Vec<_>, _>>()?;
    Ok(msdd_draw::sheet(&drawn, 2))
}

impl Panel {
    /// The title states the range that the points cover.
    fn draw(&self) -> Result<String, CliError> {
        let ranges = [0, 1].map(|k| range(self.points.iter().map(|(point, _)| point[k])));
        let covered = [0, 1].map(|k| {
            let [low, high] = ranges[k].map(|end| significant(end, 2));
            format!("{} {low} to {high}", self.names[k].replace("initial ", ""))
        });
        let points = distinct(&self.points, ranges);
        let of = |name: &'static str| {
            points.iter().filter(move |(_, sign)| *sign == name).map(move |(point, _)| (point[0], point[1]))
        };
        let coloured = COLOURS.map(|(name, colour)| (name, series(of(name).collect(), Style::dots(colour))));
        let mut list: Vec<_> = coloured.into_iter().filter(|(_, one)| !one.points.is_empty()).collect();
        if self.hull {
            let mut border = Polygon::hull(self.points.iter().map(|(point, _)| *point).collect()).corners;
            border.extend(border.first().copied());
            let border = border.into_iter().map(|[x, y]| (x, y)).collect();
            list.push(("convex hull", series(border, Style::line(0, Line::Solid))));
        }
        let list = list.into_iter().map(|(name, one)| (name.to_string(), one)).collect();
        let [x, y] = self.names.map(|name| format!("{name} [-]"));
        Ok(plot_named(&covered.join(", "), &from_data(&x, false), &from_data(&y, false), list)?)
    }
}

/// The points with the name of their colour, once at each place.
fn distinct(points: &[([f64; 2], f64)], ranges: [[f64; 2]; 2]) -> Vec<([f64; 2], &'static str)> {
    let mut seen = std::collections::BTreeSet::new();
    let named = points.iter().map(|(point, strain)| {
        let sign = if *strain < 0.0 { 0 } else { 2 - usize::from(*strain > 0.0) };
        (*point, COLOURS[sign].0)
    });
    let place = |point: &[f64; 2]| {
        let cell = |k: usize| {
            let [low, high] = ranges[k];
            ((point[k] - low) / (RESOLUTION * (high - low).max(f64::MIN_POSITIVE))).round() as i64
        };
        [cell(0), cell(1)]
    };
    named.filter(|(point, name)| seen.insert((place(point), *name))).collect()
}

/// The least and the largest value.
fn range(values: impl Iterator<Item = f64>) -> [f64; 2] {
    values.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], v| [low.min(v), high.max(v)])
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
        // Two packings share a place of the second and third panel; a legend has no element of its kind.
        assert_eq!(drawn.matches("<circle").count(), 4 + 4 + 4);
        let keys =
            ["packed", "heated", "convex hull"].map(|key| drawn.matches(&format!("\n{key}\n")).count());
        assert_eq!(keys, [3, 2, 3], "{drawn}");
        assert!(drawn.contains("porosity 0.1 to 0.15, fabric index 0 to 0.1"), "{drawn}");
        for label in ["initial porosity", "initial fabric index", "thermal strain"] {
            assert!(drawn.contains(label), "{label}");
        }
        assert!(svg(&outputs(&points)).unwrap().contains("K_yy / k"));
    }
}
