//! Draws maps: cells or grains in colours by a value, next to each other on one colour scale.
//!
//! Cells of equal colour are drawn as one area, and each colour covers all that is above its value. So a map takes little more space
//! than its isolines, and there are no gaps between colours.

use crate::text::{escape, number, significant, ticks};
use std::collections::{BTreeMap, BTreeSet};
use std::fmt::Write;

/// What a map is made of, in its plane \[m\].
#[derive(Clone, Debug)]
pub enum Cells {
    /// Points, and the points of each cell in their order around it.
    Polygons { points: Vec<[f64; 2]>, cells: Vec<Vec<usize>> },
    /// Centre and radius of each grain.
    Circles(Vec<([f64; 2], f64)>),
}

/// A map with a name and a value for each cell; cells whose value is not finite are grey.
pub struct Map<'a> {
    pub name: &'a str,
    pub cells: &'a Cells,
    pub values: &'a [f64],
}

/// What the maps of a figure have in common.
pub struct Sheet<'a> {
    /// Title, and the quantity with its unit on the colour scale.
    pub title: &'a str,
    pub label: &'a str,
    /// Corners of the window \[m\]; `None`: around all cells.
    pub window: Option<[[f64; 2]; 2]>,
    /// Ends of the colour scale; `None`: those of the values.
    pub range: Option<(f64, f64)>,
    /// Digits after the point of the value written into each cell; then there is no colour scale.
    pub written: Option<usize>,
    /// Number of colours.
    pub shades: usize,
}

impl Default for Sheet<'_> {
    fn default() -> Self {
        Self { title: "", label: "", window: None, range: None, written: None, shades: SHADES }
    }
}

/// Number of colours, unless a figure has to be smaller.
pub const SHADES: usize = 32;
/// Width of a figure, margin at its sides, and largest height of a map \[px\].
const WIDTH: f64 = 480.0;
const MARGIN: f64 = 10.0;
const TALLEST: f64 = 420.0;
/// Steps of a pixel to which corners are rounded.
const FINE: f64 = 4.0;
/// Maps that are flatter, or higher, are stretched.
const FLATTEST: f64 = 16.0;

/// Draws the maps one below the other or, where they are high, next to each other.
pub fn maps(sheet: &Sheet, list: &[Map]) -> String {
    let window = sheet.window.unwrap_or_else(|| around(list));
    let (low, high) = sheet.range.unwrap_or_else(|| range_of(list.iter().flat_map(|map| map.values)));
    let share = |value: f64| if high > low { (value - low) / (high - low) } else { 0.5 };
    let [wide, tall] = [0, 1].map(|k| (window[1][k] - window[0][k]).max(1e-300));
    let aspect = (tall / wide).clamp(1.0 / FLATTEST, FLATTEST);
    let columns = if aspect > 0.7 { list.len().max(1) } else { 1 };
    let room = (WIDTH - 2.0 * MARGIN - 12.0 * (columns - 1) as f64) / columns as f64;
    let width = room.min(TALLEST / aspect);
    let height = width * aspect;
    let mut body = String::new();
    let line = 34.0 + height;
    for (k, map) in list.iter().enumerate() {
        let (column, row) = (k % columns, k / columns);
        let (x, y) = (MARGIN + (room + 12.0) * column as f64, 30.0 + line * row as f64);
        let _ = writeln!(body, "<text x=\"{x:.0}\" y=\"{:.0}\">{}</text>", y + 13.0, escape(map.name));
        let _ = writeln!(
            body,
            "<svg x=\"{x:.2}\" y=\"{:.2}\" width=\"{width:.2}\" height=\"{height:.2}\" viewBox=\"0 0 {:.0} {:.0}\" \
             preserveAspectRatio=\"none\">",
            y + 20.0,
            FINE * width,
            FINE * height
        );
        let scale = [FINE * width / wide, FINE * height / tall];
        let at = |p: [f64; 2]| [scale[0] * (p[0] - window[0][0]), scale[1] * (window[1][1] - p[1])];
        match map.cells {
            Cells::Polygons { points, cells } => {
                let points: Vec<[f64; 2]> = points.iter().map(|p| at(*p)).collect();
                let shade = |value: f64| {
                    value
                        .is_finite()
                        .then(|| ((share(value) * sheet.shades as f64) as usize).min(sheet.shades - 1))
                };
                let shades: Vec<Option<usize>> = map.values.iter().map(|value| shade(*value)).collect();
                areas(&mut body, &points, cells, &shades, sheet.shades);
                if let Some(digits) = sheet.written {
                    values(&mut body, &points, cells, map.values, &share, digits);
                }
            }
            Cells::Circles(list) => {
                for ((middle, radius), value) in list.iter().zip(map.values) {
                    let [x, y] = at(*middle);
                    let _ = writeln!(
                        body,
                        "<circle cx=\"{x:.0}\" cy=\"{y:.0}\" r=\"{:.0}\" fill=\"{}\" stroke=\"#000\" stroke-width=\"{FINE}\"/>",
                        scale[0] * radius,
                        shade(share(*value))
                    );
                }
            }
        }
        let _ = writeln!(
            body,
            "</svg>\n<rect x=\"{x:.2}\" y=\"{:.2}\" width=\"{width:.2}\" height=\"{height:.2}\" fill=\"none\" stroke=\"#666\"/>",
            y + 20.0
        );
    }
    let mut end = 30.0 + line * list.len().div_ceil(columns) as f64 + 6.0;
    if sheet.written.is_none() {
        scale_bar(&mut body, sheet, (low, high), end);
        end += 40.0;
    }
    if (tall / wide - aspect).abs() > 1e-6 * aspect {
        let _ = writeln!(
            body,
            "<text x=\"{MARGIN}\" y=\"{:.0}\">not to scale: {} x {} m</text>",
            end + 8.0,
            number(wide),
            number(tall)
        );
        end += 20.0;
    }
    let title = escape(sheet.title);
    format!(
        "<svg viewBox=\"0 0 {WIDTH:.0} {end:.0}\" xmlns=\"http://www.w3.org/2000/svg\" role=\"img\" aria-label=\"{title}\" \
         font-family=\"sans-serif\" font-size=\"13\">\n<rect width=\"{WIDTH:.0}\" height=\"{end:.0}\" fill=\"#fff\"/>\n\
         <text x=\"{MARGIN}\" y=\"20\" font-size=\"16\">{title}</text>\n{body}</svg>\n"
    )
}

/// Least and largest of the finite values; 0 and 0 without any.
pub fn range_of<'a>(values: impl Iterator<Item = &'a f64>) -> (f64, f64) {
    let ends = values
        .filter(|value| value.is_finite())
        .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), value| (low.min(*value), high.max(*value)));
    if ends.0 > ends.1 { (0.0, 0.0) } else { ends }
}

/// The window around all cells.
fn around(list: &[Map]) -> [[f64; 2]; 2] {
    let mut window = [[f64::INFINITY; 2], [f64::NEG_INFINITY; 2]];
    let mut hold = |p: &[f64; 2], radius: f64| {
        for k in 0..2 {
            window[0][k] = window[0][k].min(p[k] - radius);
            window[1][k] = window[1][k].max(p[k] + radius);
        }
    };
    for map in list {
        match map.cells {
            Cells::Polygons { points, cells } => cells.iter().flatten().for_each(|&p| hold(&points[p], 0.0)),
            Cells::Circles(list) => list.iter().for_each(|(p, radius)| hold(p, *radius)),
        }
    }
    if window[0][0] > window[1][0] { [[0.0; 2], [1.0; 2]] } else { window }
}

/// Colour from dark (0) to light (1), by five colours of the palette viridis; also in grey, darker means less.
pub fn shade(share: f64) -> String {
    const STOPS: [[f64; 3]; 5] = [
        [68.0, 1.0, 84.0],
        [59.0, 82.0, 139.0],
        [33.0, 145.0, 140.0],
        [94.0, 201.0, 98.0],
        [253.0, 231.0, 37.0],
    ];
    let place = 4.0 * share.clamp(0.0, 1.0);
    let k = (place as usize).min(3);
    let part = place - k as f64;
    let [r, g, b] = [0, 1, 2].map(|c| (STOPS[k][c] + part * (STOPS[k + 1][c] - STOPS[k][c])) as u8);
    format!("#{r:02x}{g:02x}{b:02x}")
}

/// Colour in the middle of one of `shades` steps.
fn step(k: usize, shades: usize) -> String {
    shade((k as f64 + 0.5) / shades as f64)
}

/// The areas of all colours, each as one path.
fn areas(
    body: &mut String,
    points: &[[f64; 2]],
    cells: &[Vec<usize>],
    shades: &[Option<usize>],
    count: usize,
) {
    let mut edges: BTreeSet<(usize, usize)> = BTreeSet::new();
    let mut path = |own: &mut dyn Iterator<Item = usize>, colour: &str| {
        edges.clear();
        for cell in own {
            let corners = &cells[cell];
            let turned = area(points, corners) < 0.0;
            for (k, &a) in corners.iter().enumerate() {
                let b = corners[(k + 1) % corners.len()];
                let edge = if turned { (b, a) } else { (a, b) };
                // A side that two cells share is inside of the area
                if !edges.remove(&(edge.1, edge.0)) {
                    edges.insert(edge);
                }
            }
        }
        if !edges.is_empty() {
            let _ = writeln!(
                body,
                "<path fill=\"{colour}\" fill-rule=\"evenodd\" d=\"{}\"/>",
                outline(points, &edges)
            );
        }
    };
    path(&mut (0..cells.len()).filter(|&c| shades[c].is_none()), "#ddd");
    let present: BTreeSet<usize> = shades.iter().flatten().copied().collect();
    for k in present {
        path(&mut (0..cells.len()).filter(|&c| shades[c].is_some_and(|shade| shade >= k)), &step(k, count));
    }
}

/// Twice the area of a polygon, positive if its corners go round in the sense of the axes.
fn area(points: &[[f64; 2]], corners: &[usize]) -> f64 {
    let pair = |k: usize| [points[corners[k]], points[corners[(k + 1) % corners.len()]]];
    (0..corners.len()).map(pair).map(|[a, b]| a[0] * b[1] - a[1] * b[0]).sum()
}

/// The closed lines that edges make, with corners rounded and those left out that lie on a straight line.
fn outline(points: &[[f64; 2]], edges: &BTreeSet<(usize, usize)>) -> String {
    let mut from: BTreeMap<usize, Vec<usize>> = BTreeMap::new();
    for (a, b) in edges {
        from.entry(*a).or_default().push(*b);
    }
    let mut text = String::new();
    while let Some((&first, _)) = from.first_key_value() {
        let (mut at, mut loop_) = (first, Vec::new());
        while let Some(next) = from.get_mut(&at).and_then(Vec::pop) {
            if from[&at].is_empty() {
                from.remove(&at);
            }
            loop_.push(points[at].map(|x| x.round() as i64));
            at = next;
            if at == first {
                break;
            }
        }
        text += &closed(&loop_);
    }
    text
}

/// A closed line, in relative coordinates.
fn closed(corners: &[[i64; 2]]) -> String {
    let minus = |a: [i64; 2], b: [i64; 2]| [a[0] - b[0], a[1] - b[1]];
    let mut kept: Vec<[i64; 2]> = Vec::new();
    // The first one again, to see whether the last one is on a straight line
    for &corner in corners.iter().chain(corners.first()) {
        while let [.., a, b] = kept[..] {
            let (u, v) = (minus(b, a), minus(corner, b));
            if u[0] * v[1] != u[1] * v[0] {
                break;
            }
            kept.pop();
        }
        if kept.last() != Some(&corner) {
            kept.push(corner);
        }
    }
    kept.pop();
    if kept.len() < 3 {
        return String::new();
    }
    let mut text = format!("M{} {}", kept[0][0], kept[0][1]);
    for pair in kept.windows(2) {
        let [x, y] = minus(pair[1], pair[0]);
        let _ = match (x, y) {
            (_, 0) => write!(text, "h{x}"),
            (0, _) => write!(text, "v{y}"),
            _ => write!(text, "l{x} {y}"),
        };
    }
    text + "z"
}

/// The value of each cell, written in its middle.
fn values(
    body: &mut String,
    points: &[[f64; 2]],
    cells: &[Vec<usize>],
    values: &[f64],
    share: &dyn Fn(f64) -> f64,
    digits: usize,
) {
    let size = 10f64.powi(digits as i32);
    for (corners, value) in cells.iter().zip(values).filter(|(_, value)| value.is_finite()) {
        let [x, y] =
            [0, 1].map(|k| corners.iter().map(|&c| points[c][k]).sum::<f64>() / corners.len().max(1) as f64);
        // White on the dark half of the colours; not -0.00
        let ink = if share(*value) > 0.45 { "#000" } else { "#fff" };
        let text = format!("{:.digits$}", (size * value).round() / size + 0.0);
        let _ = writeln!(
            body,
            "<text x=\"{x:.0}\" y=\"{:.0}\" font-size=\"{}\" text-anchor=\"middle\" fill=\"{ink}\">{text}</text>",
            y + 4.5 * FINE,
            13.0 * FINE
        );
    }
}

/// The colour scale with round numbers, at a height of the figure.
fn scale_bar(body: &mut String, sheet: &Sheet, (low, high): (f64, f64), y: f64) {
    const LONG: f64 = 260.0;
    if high <= low {
        let text = format!("everywhere {}", significant(low, 4));
        let _ = writeln!(
            body,
            "<text x=\"{MARGIN}\" y=\"{:.0}\">{text} {}</text>",
            y + 12.0,
            escape(sheet.label)
        );
        return;
    }
    let wide = LONG / sheet.shades as f64;
    for k in 0..sheet.shades {
        let _ = writeln!(
            body,
            "<rect x=\"{:.2}\" y=\"{y:.0}\" width=\"{:.2}\" height=\"12\" fill=\"{}\"/>",
            MARGIN + wide * k as f64,
            // The next one covers the rest
            if k + 1 < sheet.shades { wide + 1.0 } else { wide },
            step(k, sheet.shades)
        );
    }
    for value in ticks(low, high, 5) {
        let x = MARGIN + LONG * (value - low) / (high - low);
        let _ = writeln!(
            body,
            "<path d=\"M{x:.1} {y:.0}v16\" stroke=\"#000\"/><text x=\"{:.1}\" y=\"{:.0}\" text-anchor=\"middle\">{}</text>",
            // Not cut off at the left
            x.max(MARGIN + 8.0),
            y + 29.0,
            number(value)
        );
    }
    let _ = writeln!(
        body,
        "<text x=\"{:.0}\" y=\"{:.0}\">{}</text>",
        MARGIN + LONG + 14.0,
        y + 11.0,
        escape(sheet.label)
    );
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Squares of 1 m, `columns` in a row.
    fn squares(columns: usize, rows: usize) -> Cells {
        let wide = columns + 1;
        let points = (0..wide * (rows + 1)).map(|k| [(k % wide) as f64, (k / wide) as f64]).collect();
        let cell = |k: usize| {
            let a = k % columns + k / columns * wide;
            vec![a, a + 1, a + 1 + wide, a + wide]
        };
        Cells::Polygons { points, cells: (0..columns * rows).map(cell).collect() }
    }

    #[test]
    fn cells_of_a_colour_are_one_area_and_higher_ones_lie_on_lower_ones() {
        let cells = squares(2, 2);
        let sheet = Sheet { title: "T <at> 1 s", label: "T [K]", ..Sheet::default() };
        let svg = maps(&sheet, &[Map { name: "", cells: &cells, values: &[1.0, 1.0, 1.0, 3.0] }]);
        let paths: Vec<&str> = svg.lines().filter(|line| line.starts_with("<path fill")).collect();
        // 420 px are 2 m, at a quarter of a pixel; y grows downwards. The whole square, and on it the upper right cell.
        assert_eq!(paths.len(), 2, "{svg}");
        assert!(
            paths[0].contains("#430657") && paths[0].contains("d=\"M0 1680v-1680h1680v1680z\""),
            "{}",
            paths[0]
        );
        assert!(paths[1].contains("d=\"M840 840v-840h840v840z\""), "{}", paths[1]);
        assert!(svg.contains("T &lt;at&gt; 1 s") && svg.contains(">1.5</text>") && svg.contains("T [K]"));
    }

    #[test]
    fn holes_unknown_values_and_equal_values_are_drawn() {
        let cells = squares(3, 3);
        let mut values = [2.0; 9];
        values[4] = f64::NAN;
        let svg = maps(&Sheet::default(), &[Map { name: "", cells: &cells, values: &values }]);
        let paths: Vec<&str> = svg.lines().filter(|line| line.starts_with("<path fill")).collect();
        assert!(paths[0].contains("#ddd") && paths[1].matches('M').count() == 2, "{paths:?}");
        assert!(svg.contains("everywhere 2"));
    }

    #[test]
    fn flat_maps_are_stretched_and_say_so_and_values_are_written() {
        let flat = Cells::Polygons {
            points: vec![[0.0, 0.0], [1.0, 0.0], [1.0, 0.01], [0.0, 0.01]],
            cells: vec![vec![0, 1, 2, 3]],
        };
        assert!(
            maps(&Sheet::default(), &[Map { name: "", cells: &flat, values: &[1.0] }])
                .contains("not to scale: 1 x 0.01 m")
        );
        let values: Vec<f64> = (0..30).map(|k| 0.1 + 0.001 * f64::from(k)).collect();
        let sheet = Sheet { title: "porosity [-]", written: Some(3), ..Sheet::default() };
        let cells = squares(10, 3);
        let svg = maps(&sheet, &[Map { name: "solver", cells: &cells, values: &values }]);
        assert!(svg.contains(">0.100<") && svg.contains(">0.129<") && !svg.contains("not to scale"));
        let sheet = Sheet { written: Some(2), ..Sheet::default() };
        assert!(!maps(&sheet, &[Map { name: "", cells: &cells, values: &[-1e-4; 30] }]).contains("-0.00"));
    }

    #[test]
    fn a_grain_is_drawn_to_scale_in_its_window() {
        let grain = Cells::Circles(vec![([0.06, 0.03], 0.012)]);
        let sheet = Sheet {
            window: Some([[0.0; 2], [0.12; 2]]),
            range: Some((0.0, 4.0)),
            label: "overlap [%]",
            ..Sheet::default()
        };
        let svg = maps(&sheet, &[Map { name: "case H", cells: &grain, values: &[2.0] }]);
        // 420 px are 0.12 m, at a quarter of a pixel
        assert!(svg.contains("cx=\"840\" cy=\"1260\" r=\"168\"") && svg.contains("overlap [%]"), "{svg}");
    }

    #[test]
    fn shades_grow_lighter() {
        let light = |share: f64| {
            let colour = shade(share);
            let part = |k: usize| f64::from(u8::from_str_radix(&colour[k..k + 2], 16).unwrap());
            0.3 * part(1) + 0.59 * part(3) + 0.11 * part(5)
        };
        assert!((0..10).all(|k| light(f64::from(k + 1) / 10.0) > light(f64::from(k) / 10.0) + 5.0));
    }
}
