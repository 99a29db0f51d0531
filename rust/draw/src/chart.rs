//! Draws lines and markers on axes. Colours are from the palette of Okabe and Ito; series that differ in colour also differ in
//! marker or dash.

use crate::DrawError;
use crate::text::{escape, number};
use plotters::coord::Shift;
use plotters::coord::ranged1d::{Ranged, ValueFormatter};
use plotters::prelude::*;

/// Width and height of a figure \[px\], before it is scaled to the page.
pub const SIZE: (u32, u32) = (480, 330);
const FONT: &str = "sans-serif";
const COLOURS: [RGBColor; 8] = [
    RGBColor(0, 0, 0),
    RGBColor(213, 94, 0),
    RGBColor(0, 114, 178),
    RGBColor(0, 158, 115),
    RGBColor(150, 150, 150),
    RGBColor(204, 121, 167),
    RGBColor(86, 180, 233),
    RGBColor(230, 159, 0),
];

type Drawn = Result<(), Box<dyn std::error::Error>>;

#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Marker {
    None,
    /// For thousands of points: an element of SVG each, instead of an outline.
    Dot,
    Circle,
    Square,
    Triangle,
    Diamond,
    Cross,
    Plus,
    Down,
    Star,
}

/// Markers that can be distinguished.
pub const MARKERS: [Marker; 9] = [
    Marker::Circle,
    Marker::Square,
    Marker::Triangle,
    Marker::Diamond,
    Marker::Cross,
    Marker::Down,
    Marker::Plus,
    Marker::Star,
    Marker::Square,
];

#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Line {
    None,
    Solid,
    Dashed,
    Dotted,
}

/// Colour, marker and line of a series.
#[derive(Clone, Copy, Debug)]
pub struct Style {
    /// Index of the colour; numbers beyond the last colour start again from the first.
    pub colour: usize,
    pub marker: Marker,
    pub line: Line,
    pub hollow: bool,
    /// Half the size of a marker \[px\].
    pub size: i32,
}

impl Style {
    pub fn line(colour: usize, line: Line) -> Self {
        Self { colour, marker: Marker::None, line, hollow: false, size: 4 }
    }
    pub fn marker(colour: usize, marker: Marker) -> Self {
        Self { colour, marker, line: Line::None, hollow: false, size: 4 }
    }
    /// Dots of 2 px.
    pub fn dots(colour: usize) -> Self {
        Self { size: 1, ..Self::marker(colour, Marker::Dot) }
    }
    fn rgb(self) -> RGBColor {
        COLOURS[self.colour % COLOURS.len()]
    }
}

pub struct Series {
    pub points: Vec<(f64, f64)>,
    /// Half the length of error bars along y; empty: none.
    pub bars: Vec<f64>,
    pub style: Style,
}

pub struct Axis<'a> {
    /// Name of the quantity with its unit.
    pub label: &'a str,
    pub log: bool,
    /// Ends of the axis; `None`: they follow from the points.
    pub range: Option<(f64, f64)>,
}

impl Axis<'_> {
    fn range(&self, values: impl Iterator<Item = f64>) -> std::ops::Range<f64> {
        if let Some((low, high)) = self.range {
            return low..high;
        }
        let usable = values.filter(|v| v.is_finite() && (!self.log || *v > 0.0));
        let (low, high) = usable.fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), v| (l.min(v), h.max(v)));
        if low > high {
            return if self.log { 0.1..10.0 } else { 0.0..1.0 };
        }
        if self.log {
            return 0.7 * low..1.4 * high;
        }
        let margin = 0.05 * (high - low).max(1e-12 + 0.01 * high.abs());
        low - margin..high + margin
    }
}

/// Draws lines and markers on axes. `title` stands above this panel of the figure.
///
/// # Errors
/// [`DrawError`].
pub fn plot(title: &str, x: &Axis, y: &Axis, series: &[Series]) -> Result<String, DrawError> {
    with_keys(title, x, y, series, &[])
}

/// As [`plot`], with a legend between title and axes of those series that have a name.
///
/// # Errors
/// [`DrawError`].
pub fn plot_named(
    title: &str,
    x: &Axis,
    y: &Axis,
    named: Vec<(String, Series)>,
) -> Result<String, DrawError> {
    let (names, series): (Vec<String>, Vec<Series>) = named.into_iter().unzip();
    let keys = names.into_iter().zip(&series).filter(|(name, _)| !name.is_empty());
    with_keys(title, x, y, &series, &keys.map(|(name, one)| (one.style, name)).collect::<Vec<_>>())
}

fn with_keys(
    title: &str,
    x: &Axis,
    y: &Axis,
    series: &[Series],
    keys: &[(Style, String)],
) -> Result<String, DrawError> {
    let mut svg = String::new();
    panel(&mut svg, title, x, y, series, keys)
        .map_err(|error| DrawError { figure: title.to_string(), problem: error.to_string() })?;
    Ok(responsive(&svg, title))
}

/// Space of a character and of the sign of a key, and height of a row of keys \[px\].
const LETTER: i32 = 7;
const SIGN: i32 = 42;
const ROW: i32 = 18;

/// Places of the keys in rows that are as wide as the figure, and the number of rows.
fn places(keys: &[(Style, String)]) -> (Vec<(i32, i32)>, i32) {
    let (mut x, mut row) = (0, 0);
    let mut place = |text: &str| {
        let wide = SIGN + LETTER * text.chars().count() as i32 + 8;
        if x > 0 && x + wide > SIZE.0 as i32 - 20 {
            (x, row) = (0, row + 1);
        }
        x += wide;
        (10 + x - wide, row)
    };
    let places: Vec<(i32, i32)> = keys.iter().map(|(_, text)| place(text)).collect();
    let rows = places.last().map_or(0, |last| last.1 + 1);
    (places, rows)
}

fn panel(
    svg: &mut String,
    title: &str,
    x: &Axis,
    y: &Axis,
    series: &[Series],
    keys: &[(Style, String)],
) -> Drawn {
    let (places, rows) = places(keys);
    let whole = SVGBackend::with_string(svg, (SIZE.0, SIZE.1 + (rows * ROW) as u32)).into_drawing_area();
    whole.fill(&WHITE)?;
    let (head, root) = whole.split_vertically(if title.is_empty() { 4 } else { 30 } + rows * ROW);
    head.draw(&Text::new(title.to_string(), (10, 8), (FONT, 16)))?;
    for ((style, text), (x, row)) in keys.iter().zip(places) {
        let y = 28 + ROW * row;
        sample(&head, *style, (x, y))?;
        head.draw(&Text::new(text.clone(), (x + 40, y), (FONT, 13)))?;
    }
    let xs = x.range(series.iter().flat_map(|s| s.points.iter().map(|p| p.0)));
    let with_bars = |s: &Series| -> Vec<f64> {
        let bar = |k: usize| s.bars.get(k).copied().unwrap_or(0.0);
        s.points.iter().enumerate().flat_map(|(k, p)| [p.1 - bar(k), p.1 + bar(k)]).collect()
    };
    let ys = y.range(series.iter().flat_map(with_bars));
    let mut builder = ChartBuilder::on(&root);
    builder.margin(6).margin_right(18).x_label_area_size(42).y_label_area_size(62);
    match (x.log, y.log) {
        (false, false) => fill(builder.build_cartesian_2d(xs, ys)?, x, y, series)?,
        (true, false) => fill(builder.build_cartesian_2d(xs.log_scale(), ys)?, x, y, series)?,
        (false, true) => fill(builder.build_cartesian_2d(xs, ys.log_scale())?, x, y, series)?,
        (true, true) => fill(builder.build_cartesian_2d(xs.log_scale(), ys.log_scale())?, x, y, series)?,
    }
    whole.present()?;
    Ok(())
}

fn fill<X, Y>(
    mut chart: ChartContext<SVGBackend, Cartesian2d<X, Y>>,
    x: &Axis,
    y: &Axis,
    series: &[Series],
) -> Drawn
where
    X: Ranged<ValueType = f64> + ValueFormatter<f64>,
    Y: Ranged<ValueType = f64> + ValueFormatter<f64>,
{
    // Ticks are sums of steps, so that of zero may differ from it by rounding.
    let tick = |value: f64, range: std::ops::Range<f64>, log: bool| {
        let is_zero = !log && value.abs() < 1e-9 * (range.end - range.start);
        number(if is_zero { 0.0 } else { value })
    };
    let (xs, ys) = (chart.x_range(), chart.y_range());
    chart
        .configure_mesh()
        .x_desc(x.label)
        .y_desc(y.label)
        .x_labels(7)
        .y_labels(7)
        .x_label_formatter(&|v| tick(*v, xs.clone(), x.log))
        .y_label_formatter(&|v| tick(*v, ys.clone(), y.log))
        .light_line_style(WHITE)
        .bold_line_style(BLACK.mix(0.12))
        .label_style((FONT, 13))
        .axis_desc_style((FONT, 14))
        .draw()?;
    for one in series {
        let style = one.style;
        let stroke = style.rgb().stroke_width(2);
        let points = one.points.iter().copied().filter(|p| p.0.is_finite() && p.1.is_finite());
        match style.line {
            Line::None => {}
            Line::Solid => drop(chart.draw_series(LineSeries::new(points.clone(), stroke))?),
            Line::Dashed => drop(chart.draw_series(DashedLineSeries::new(points.clone(), 8, 4, stroke))?),
            Line::Dotted => drop(chart.draw_series(DashedLineSeries::new(points.clone(), 2, 3, stroke))?),
        }
        for ((px, py), bar) in one.points.iter().zip(&one.bars) {
            let ends = vec![(*px, py - bar), (*px, py + bar)];
            chart.draw_series([PathElement::new(ends, style.rgb().stroke_width(1))])?;
        }
        if style.marker == Marker::Dot {
            let dot = |point| Circle::new(point, style.size, style.rgb().filled());
            chart.draw_series(points.map(dot))?;
            continue;
        }
        let area = chart.plotting_area();
        for point in points {
            for (outline, filled) in outlines(style) {
                if filled {
                    area.draw(&(EmptyElement::at(point) + Polygon::new(outline, style.rgb().filled())))?;
                } else {
                    area.draw(&(EmptyElement::at(point) + PathElement::new(outline, stroke)))?;
                }
            }
        }
    }
    Ok(())
}

/// Outlines of a marker around its place [px], and whether each is filled.
fn outlines(style: Style) -> Vec<(Vec<(i32, i32)>, bool)> {
    let s = style.size;
    let d = (f64::from(s) * 0.8).round() as i32;
    let closed = |points: &[(i32, i32)]| vec![([points, &points[..1]].concat(), !style.hollow)];
    match style.marker {
        Marker::None => Vec::new(),
        Marker::Circle | Marker::Dot => {
            let at = |k: i32| f64::from(k) * std::f64::consts::PI / 8.0;
            let round = |v: f64| (f64::from(s) * v).round() as i32;
            closed(&(0..16).map(|k| (round(at(k).cos()), round(at(k).sin()))).collect::<Vec<_>>())
        }
        Marker::Square => closed(&[(-d, -d), (d, -d), (d, d), (-d, d)]),
        Marker::Triangle => closed(&[(-s, d), (0, -s), (s, d)]),
        Marker::Down => closed(&[(-s, -d), (0, s), (s, -d)]),
        Marker::Diamond => closed(&[(-s, 0), (0, -s), (s, 0), (0, s)]),
        Marker::Cross => vec![(vec![(-d, -d), (d, d)], false), (vec![(-d, d), (d, -d)], false)],
        Marker::Plus => vec![(vec![(-s, 0), (s, 0)], false), (vec![(0, -s), (0, s)], false)],
        Marker::Star => {
            vec![
                (vec![(-s, 0), (s, 0)], false),
                (vec![(-d, -d), (d, d)], false),
                (vec![(-d, d), (d, -d)], false),
            ]
        }
    }
}

/// A short piece of a line with its marker, for the legend.
///
/// # Errors
/// [`DrawError`].
pub fn key(style: Style) -> Result<String, DrawError> {
    let mut svg = String::new();
    let draw = |svg: &mut String| -> Drawn {
        let root = SVGBackend::with_string(svg, (34, 14)).into_drawing_area();
        sample(&root, style, (0, 0))?;
        root.present()?;
        Ok(())
    };
    draw(&mut svg)
        .map_err(|error| DrawError { figure: "a legend".to_string(), problem: error.to_string() })?;
    Ok(svg.lines().filter(|line| !line.starts_with("<?xml")).collect::<Vec<_>>().join(""))
}

/// A short piece of a line with its marker, from the upper left corner of its 34 x 14 pixels.
fn sample(area: &DrawingArea<SVGBackend, Shift>, style: Style, (x, y): (i32, i32)) -> Drawn {
    let stroke = style.rgb().stroke_width(2);
    let pieces: Vec<(i32, i32)> = match style.line {
        Line::None => Vec::new(),
        Line::Solid => vec![(1, 33)],
        Line::Dashed => vec![(1, 9), (13, 21), (25, 33)],
        Line::Dotted => (0..7).map(|k| (1 + 5 * k, 3 + 5 * k)).collect(),
    };
    for (from, to) in pieces {
        area.draw(&PathElement::new(vec![(x + from, y + 7), (x + to, y + 7)], stroke))?;
    }
    // Dots are larger here, so that their colour can be seen.
    for (outline, filled) in outlines(Style { size: style.size.max(3), ..style }) {
        let outline: Vec<(i32, i32)> =
            outline.into_iter().map(|(dx, dy)| (x + 17 + dx, y + 7 + dy)).collect();
        if filled {
            area.draw(&Polygon::new(outline, style.rgb().filled()))?;
        } else {
            area.draw(&PathElement::new(outline, stroke))?;
        }
    }
    Ok(())
}

/// Points without bars of deviation.
pub fn series(points: Vec<(f64, f64)>, style: Style) -> Series {
    Series { points, bars: Vec::new(), style }
}

/// An axis whose range is that of the data.
pub fn from_data(label: &str, log: bool) -> Axis<'_> {
    Axis { label, log, range: None }
}

/// The SVG for a page: as wide as the space that it has, and with a title for screen readers.
fn responsive(svg: &str, title: &str) -> String {
    let body: Vec<&str> = svg.lines().filter(|line| !line.starts_with("<?xml")).collect();
    let body = body.join("\n");
    let Some((head, rest)) = body.split_once('>') else { return body };
    let view = head.split("viewBox=").nth(1).map_or("", |v| v.split('"').nth(1).unwrap_or(""));
    let title = escape(title);
    format!(
        "<svg viewBox=\"{view}\" xmlns=\"http://www.w3.org/2000/svg\" role=\"img\" aria-label=\"{title}\">{rest}\n"
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    const X: Axis = Axis { label: "cost [core-s]", log: true, range: None };
    const Y: Axis = Axis { label: "error [%]", log: true, range: None };

    #[test]
    fn a_plot_holds_its_labels_and_scales() {
        let series = [Series {
            points: vec![(0.1, 5.0), (100.0, 0.5)],
            bars: Vec::new(),
            style: Style::marker(1, Marker::Circle),
        }];
        let svg = plot("case H", &X, &Y, &series).unwrap();
        for text in ["cost [core-s]", "error [%]", "case H", "viewBox=\"0 0 480 330\""] {
            assert!(svg.contains(text), "{text}");
        }
        assert_eq!(svg.matches("#D55E00").count(), 2, "two markers");
        assert!(!svg.contains("width=\"480\" height=\"330\" viewBox"), "scales with the page");
    }

    #[test]
    fn a_legend_is_above_the_axes_and_needs_no_more_width() {
        let one = |colour| series(vec![(1.0, 1.0), (2.0, 3.0)], Style::line(colour, Line::Solid));
        let named = (0..9).map(|k| (format!("a name of a series, {k}"), one(k)));
        let svg = plot_named("case H", &X, &Y, named.chain([(String::new(), one(0))]).collect()).unwrap();
        assert_eq!(svg.matches("a name of a series").count(), 9);
        // Two in a row, five rows of 18 px
        assert!(svg.contains("viewBox=\"0 0 480 420\""), "{}", &svg[..200]);
        assert!(svg.matches("<polyline").count() > 10);
    }

    #[test]
    fn an_empty_plot_is_drawn() {
        assert!(plot("none", &X, &Axis { log: false, ..Y }, &[]).unwrap().contains("</svg>"));
    }
}
