//! `msdd rve draw`: the grains of a state with the forces between them, alone or beside a field of the solver, as SVG.

use crate::error::CliError;
use clap::Args;
use msdd_files::{read_text, write};
use msdd_reference::solver::nonuniform;
use msdd_rve::{Simulation, state};
use std::fmt::Write;
use std::path::PathBuf;

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

/// Side of the box of grains and width of the field, and gap between them [px].
const BOX: f64 = 400.0;
const FIELD: f64 = 620.0;
const GAP: f64 = 60.0;
/// Height of the captions above and of the scale below [px].
const HEAD: f64 = 30.0;
const FOOT: f64 = 44.0;
/// Width of a line at the mean normal force [px], and largest width.
const LINE: f64 = 1.4;
const WIDEST: f64 = 7.0;
/// Number of colours of the field.
const SHADES: usize = 48;
/// Ends and middle of the colour scale: blue, white and red, which colour-blind readers can tell apart.
const COLD: [f64; 3] = [33.0, 102.0, 172.0];
const MIDDLE: [f64; 3] = [247.0, 247.0, 247.0];
const HOT: [f64; 3] = [178.0, 24.0, 43.0];

pub fn run(arguments: &Arguments) -> Result<(), CliError> {
    let problem = |text: String| CliError::Message(format!("{}: {text}", arguments.state.display()));
    let simulation = state::from_json(&read_text(&arguments.state)?).map_err(|e| problem(e.to_string()))?;
    let field = match arguments.field.as_ref().zip(arguments.cells) {
        Some((path, cells)) => {
            let values = scalars(&read_text(path)?, cells)
                .map_err(|text| CliError::Message(format!("{}: {text}", path.display())))?;
            Some((values, cells[0]))
        }
        None => None,
    };
    let mut body = grains(&simulation);
    let mut width = BOX + 2.0;
    if let Some((values, columns)) = &field {
        body += &map(values, *columns, &arguments.label);
        width += GAP + FIELD + 20.0;
    }
    let height = HEAD + BOX + FOOT;
    let svg = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {width} {height}\" font-family=\"sans-serif\" \
         font-size=\"15\"><rect width=\"{width}\" height=\"{height}\" fill=\"white\"/>\n{body}</svg>\n"
    );
    Ok(write(&arguments.out, svg.as_bytes())?)
}

/// The values of a scalar field, if there are as many as `cells`.
fn scalars(text: &str, cells: [usize; 2]) -> Result<Vec<f64>, String> {
    let values: Vec<f64> = nonuniform(text)?.iter().filter_map(|row| row.first().copied()).collect();
    let expected: usize = cells.iter().product();
    if values.len() == expected {
        Ok(values)
    } else {
        Err(format!("{} values, expected {expected} of {} x {} cells", values.len(), cells[0], cells[1]))
    }
}

/// SVG of the grains in grey and of the contact forces as black lines.
fn grains(simulation: &Simulation) -> String {
    let [x0, x1, y0, y1] = simulation.walls.position;
    let scale = BOX / (x1 - x0).max(y1 - y0);
    let (width, height) = (scale * (x1 - x0), scale * (y1 - y0));
    let top = HEAD + BOX - height;
    let at = |x: f64, y: f64| (1.0 + scale * (x - x0), HEAD + BOX - scale * (y - y0));
    let mut svg = format!(
        "<clipPath id=\"box\"><rect x=\"1\" y=\"{top:.1}\" width=\"{width:.1}\" height=\"{height:.1}\"/></clipPath>\n\
         <text x=\"1\" y=\"20\">a box of {} grains, and the forces between them</text>\n<g clip-path=\"url(#box)\">\n",
        simulation.discs.len()
    );
    svg += "<g fill=\"#dde3ea\" stroke=\"#aeb8c4\" stroke-width=\"0.5\">\n";
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
    svg + &format!(
        "</g></g>\n<rect x=\"1\" y=\"{top:.1}\" width=\"{width:.1}\" height=\"{height:.1}\" fill=\"none\" stroke=\"black\"/>\n"
    )
}

/// SVG of the field in colours with the scale below. Neighbouring cells of a row with the same colour are one rectangle.
fn map(values: &[f64], columns: usize, label: &str) -> String {
    let (low, high) =
        values.iter().fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), &v| (l.min(v), h.max(v)));
    let shade =
        |v: f64| ((v - low) / (high - low).max(1e-300) * SHADES as f64).min(SHADES as f64 - 1.0) as usize;
    let cell = FIELD / columns as f64;
    let rows = values.len() / columns;
    let (left, top) = (BOX + GAP, HEAD + 0.5 * (BOX - cell * rows as f64));
    let mut svg = format!(
        "<text x=\"{left}\" y=\"{:.1}\">the solver's field: {label}</text>\n<g shape-rendering=\"crispEdges\">\n",
        top - 10.0
    );
    for (row, line) in values.chunks(columns).enumerate() {
        let y = top + cell * (rows - 1 - row) as f64;
        let mut begin = 0;
        while begin < columns {
            let same = line[begin..].iter().take_while(|&&v| shade(v) == shade(line[begin])).count();
            let (x, width) = (left + cell * begin as f64, cell * same as f64);
            let _ = writeln!(
                svg,
                "<rect x=\"{x:.1}\" y=\"{y:.1}\" width=\"{width:.1}\" height=\"{cell:.1}\" fill=\"{}\"/>",
                colour(shade(line[begin]))
            );
            begin += same;
        }
    }
    let bottom = top + cell * rows as f64;
    for k in 0..SHADES {
        let step = 0.5 * FIELD / SHADES as f64;
        let _ = writeln!(
            svg,
            "<rect x=\"{:.1}\" y=\"{:.1}\" width=\"{step:.1}\" height=\"12\" fill=\"{}\"/>",
            left + step * k as f64,
            bottom + 16.0,
            colour(k)
        );
    }
    let _ = writeln!(
        svg,
        "</g>\n<text x=\"{left}\" y=\"{:.1}\">{}</text><text x=\"{:.1}\" y=\"{:.1}\" text-anchor=\"end\">{}</text>",
        bottom + 46.0,
        brief(low),
        left + 0.5 * FIELD,
        bottom + 46.0,
        brief(high)
    );
    let _ = writeln!(
        svg,
        "<rect x=\"{left}\" y=\"{top:.1}\" width=\"{FIELD}\" height=\"{:.1}\" fill=\"none\" stroke=\"black\"/>",
        cell * rows as f64
    );
    svg
}

fn colour(shade: usize) -> String {
    let share = 2.0 * shade as f64 / (SHADES - 1) as f64;
    let (from, to, w) = if share < 1.0 { (COLD, MIDDLE, share) } else { (MIDDLE, HOT, share - 1.0) };
    let [r, g, b] = [0, 1, 2].map(|k| (from[k] + w * (to[k] - from[k])).round() as u8);
    format!("#{r:02x}{g:02x}{b:02x}")
}

/// A number with three significant digits.
fn brief(value: f64) -> String {
    let digits = (2.0 - value.abs().max(1e-300).log10().floor()).clamp(0.0, 9.0) as usize;
    format!("{value:.digits$}")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cells_of_one_shade_are_joined_and_the_ends_are_cold_and_hot() {
        let svg = map(&[0.0, 0.0, 0.0, 100.0], 2, "T [K]");
        // Three rectangles for the cells, those of the scale, and the frame.
        assert_eq!(svg.matches("<rect").count(), 3 + SHADES + 1, "{svg}");
        assert!(svg.contains("#2166ac") && svg.contains("#b2182b") && svg.contains(">100</text>"), "{svg}");
    }

    #[test]
    fn a_field_of_another_mesh_is_refused() {
        let text = "internalField nonuniform List<scalar>\n3\n(\n1\n2\n3\n)\n;";
        assert_eq!(scalars(text, [3, 1]).unwrap(), [1.0, 2.0, 3.0]);
        assert_eq!(scalars(text, [2, 2]).unwrap_err(), "3 values, expected 4 of 2 x 2 cells");
    }
}
