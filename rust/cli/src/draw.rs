//! `msdd rve draw`: the grains of a state with the forces between them, alone or next to a field of the solver, as SVG.

use crate::error::CliError;
use clap::Args;
use msdd_case::results::Field;
use msdd_draw::{Cells, Map, Sheet, maps, sheet};
use msdd_files::{read_text, write};
use msdd_rve::{Simulation, state};
use std::fmt::Write;
use std::path::{Path, PathBuf};

#[derive(Args)]
#[command(after_help = "Examples:
  msdd rve draw --state state.json --out grains.svg
  msdd rve draw --state state.json --field results/moving/HC/5/T --cells 100,30 --label 'temperature after 5 s [K]' --out both.svg

Lines join the centres of grains that press on each other; their width is proportional to the normal force.")]
pub struct Arguments {
    /// State file of a box of grains, as `msdd rve pack` writes it.
    #[arg(long, value_name = "FILE")]
    state: PathBuf,
    /// Field of the solver to draw next to the box: the file of a scalar field in a time folder, in text format, with one
    /// value for each cell; needs --cells.
    #[arg(long, value_name = "FILE", requires = "cells")]
    field: Option<PathBuf>,
    /// Number of cells of the field along x and y; cells are drawn as squares.
    #[arg(long, value_name = "NX,NY", value_parser = cells)]
    cells: Option<[usize; 2]>,
    /// Name of the field with its unit, as the caption.
    #[arg(long, default_value = "")]
    label: String,
    /// SVG file to write.
    #[arg(long, value_name = "FILE")]
    out: PathBuf,
}

fn cells(text: &str) -> Result<[usize; 2], String> {
    let numbers: Option<Vec<usize>> =
        text.split(',').map(|n| n.trim().parse().ok().filter(|&n| n > 0)).collect();
    let pair = numbers.and_then(|numbers| <[usize; 2]>::try_from(numbers).ok());
    pair.ok_or_else(|| "expected two numbers of cells, for example 100,30".to_string())
}

/// Side of the box of grains, and heights of its caption and of the whole figure \[px\].
const BOX: f64 = 440.0;
const HEAD: f64 = 34.0;
const TALL: f64 = 490.0;
/// From the left edge to the box \[px\].
const LEFT: f64 = 20.0;
/// Width of a line at the mean normal force \[px\], and largest width.
const LINE: f64 = 1.2;
const WIDEST: f64 = 5.0;

pub fn run(arguments: &Arguments) -> Result<(), CliError> {
    let problem = |text: String| CliError::Message(format!("{}: {text}", arguments.state.display()));
    let simulation = state::from_json(&read_text(&arguments.state)?).map_err(|e| problem(e.to_string()))?;
    let mut figures = vec![grains(&simulation)];
    if let Some((path, cells)) = arguments.field.as_ref().zip(arguments.cells) {
        figures.push(map(&scalars(path, cells)?, cells, &arguments.label));
    }
    Ok(write(&arguments.out, sheet(&figures, 2).as_bytes())?)
}

/// The values of a scalar field in as many cells.
fn scalars(path: &Path, cells: [usize; 2]) -> Result<Vec<f64>, CliError> {
    let count = cells.iter().product();
    let field = Field::read(path, count)?.filter(|field| field.cells.width == 1);
    let wrong = || CliError::Message(format!("{}: allowed: a scalar field", path.display()));
    let field = field.ok_or_else(wrong)?;
    Ok((0..count).flat_map(|cell| field.cells.row(cell).to_vec()).collect())
}

/// The grains in grey and the contact forces as black lines.
fn grains(simulation: &Simulation) -> String {
    let [x0, x1, y0, y1] = simulation.walls.position;
    let scale = BOX / (x1 - x0).max(y1 - y0);
    let (width, height) = (scale * (x1 - x0), scale * (y1 - y0));
    let at = |x: f64, y: f64| (LEFT + scale * (x - x0), HEAD + height - scale * (y - y0));
    let frame = format!("x=\"{LEFT}\" y=\"{HEAD}\" width=\"{width:.1}\" height=\"{height:.1}\"");
    let title = format!("A box of {} grains, and the forces between them", simulation.discs.len());
    let mut svg = format!(
        "<svg viewBox=\"0 0 480 {TALL}\" xmlns=\"http://www.w3.org/2000/svg\" role=\"img\" aria-label=\"{title}\" \
         font-family=\"sans-serif\">\n<rect width=\"480\" height=\"{TALL}\" fill=\"#fff\"/>\n\
         <clipPath id=\"box\"><rect {frame}/></clipPath>\n\
         <text x=\"{LEFT}\" y=\"20\" font-size=\"16\">{title}</text>\n<g clip-path=\"url(#box)\">\n\
         <g fill=\"#dde3ea\" stroke=\"#aeb8c4\" stroke-width=\"0.5\">\n"
    );
    for disc in &simulation.discs {
        let (x, y) = at(disc.x, disc.y);
        let _ = writeln!(svg, "<circle cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"{:.1}\"/>", scale * disc.radius);
    }
    svg += "</g>\n<g stroke=\"black\" stroke-linecap=\"round\">\n";
    let mut contacts = Vec::new();
    simulation.for_each_contact(|contact| {
        let disc = &simulation.discs[contact.j];
        let [dx, dy] = contact.branch;
        contacts.push((disc.x - dx, disc.y - dy, disc.x, disc.y, contact.normal_force()));
    });
    let mean = contacts.iter().map(|c| c.4).sum::<f64>() / contacts.len().max(1) as f64;
    for (x1, y1, x2, y2, force) in contacts {
        let ((x1, y1), (x2, y2)) = (at(x1, y1), at(x2, y2));
        let thickness = (LINE * force / mean).min(WIDEST);
        let _ =
            writeln!(svg, "<path d=\"M{x1:.1} {y1:.1}L{x2:.1} {y2:.1}\" stroke-width=\"{thickness:.2}\"/>");
    }
    svg + &format!("</g></g>\n<rect {frame} fill=\"none\" stroke=\"#666\"/>\n</svg>\n")
}

/// The field on square cells.
fn map(values: &[f64], [columns, rows]: [usize; 2], label: &str) -> String {
    let wide = columns + 1;
    let points = (0..wide * (rows + 1)).map(|k| [(k % wide) as f64, (k / wide) as f64]).collect();
    let corners = |k: usize| {
        let first = k % columns + k / columns * wide;
        vec![first, first + 1, first + 1 + wide, first + wide]
    };
    let cells = Cells::Polygons { points, cells: (0..values.len()).map(corners).collect() };
    let sheet = Sheet { title: "The solver's field", label, ..Sheet::default() };
    maps(&sheet, &[Map { name: "", cells: &cells, values }])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_field_of_another_mesh_is_refused() {
        let file = std::env::temp_dir().join(format!("msdd-draw-{}", std::process::id()));
        let text = "class volScalarField; internalField nonuniform List<scalar>\n3\n(\n1\n2\n3\n)\n;";
        std::fs::write(&file, text).unwrap();
        assert_eq!(scalars(&file, [3, 1]).unwrap(), [1.0, 2.0, 3.0]);
        let error = scalars(&file, [2, 2]).unwrap_err().to_string();
        assert!(error.contains("3 values, allowed: 4, one for each cell of the mesh"), "{error}");
        std::fs::remove_file(&file).unwrap();
    }
}
