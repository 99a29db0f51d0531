//! Figures next to each other as one picture, SVG or PNG.

use super::curves::Figure;
use crate::error::CliError;
use resvg::{tiny_skia, usvg};

/// Width of a figure [px], and pixels of a PNG for each.
const WIDTH: f64 = 480.0;
const FINE: f32 = 2.0;
/// Families that are looked for as the one without serifs.
const FONTS: [&str; 4] = ["DejaVu Sans", "Liberation Sans", "Noto Sans", "Arial"];

/// The figures in columns, each below the shortest one so far.
pub fn sheet(figures: &[Figure]) -> String {
    let columns = figures.len().clamp(1, 3);
    let (mut ends, mut body) = (vec![0.0f64; columns], String::new());
    for (_, svg) in figures {
        let Some((height, inner)) = opened(svg) else { continue };
        let column = (0..columns).min_by(|&a, &b| ends[a].total_cmp(&ends[b])).unwrap_or(0);
        let (x, y) = (WIDTH * column as f64, ends[column]);
        body += &format!("<svg x=\"{x}\" y=\"{y}\" width=\"{WIDTH}\" height=\"{height}\" {inner}");
        ends[column] += height;
    }
    let (wide, tall) = (WIDTH * columns as f64, ends.into_iter().fold(1.0, f64::max));
    format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {wide} {tall}\" width=\"{wide}\" height=\"{tall}\">\n\
         <rect width=\"{wide}\" height=\"{tall}\" fill=\"#fff\"/>\n{body}</svg>\n"
    )
}

/// Height of a figure, and its text after `<svg `.
fn opened(svg: &str) -> Option<(f64, &str)> {
    let inner = svg.strip_prefix("<svg ")?;
    let view = inner.split_once("viewBox=\"")?.1.split_once('"')?.0;
    Some((view.split_whitespace().nth(3)?.parse().ok()?, inner))
}

/// The picture in pixels.
pub fn png(svg: &str) -> Result<Vec<u8>, CliError> {
    let failed = |problem: String| CliError::Message(format!("cannot draw the PNG: {problem}"));
    let mut options = usvg::Options::default();
    let fonts = options.fontdb_mut();
    fonts.load_system_fonts();
    let there =
        |name: &&&str| fonts.faces().any(|face| face.families.iter().any(|family| family.0 == ***name));
    let first = fonts.faces().next().and_then(|face| Some(face.families.first()?.0.clone()));
    let Some(family) = FONTS.iter().find(there).map(|name| (*name).to_string()).or(first) else {
        return Err(failed(
            "there is no font; install one, such as the package fonts-dejavu-core, or use --svg".into(),
        ));
    };
    fonts.set_sans_serif_family(family);
    let tree = usvg::Tree::from_str(svg, &options).map_err(|error| failed(error.to_string()))?;
    let size = tree.size().to_int_size().scale_by(FINE).ok_or_else(|| failed("no size".into()))?;
    let mut pixels = tiny_skia::Pixmap::new(size.width(), size.height())
        .ok_or_else(|| failed("it is too large".into()))?;
    resvg::render(&tree, tiny_skia::Transform::from_scale(FINE, FINE), &mut pixels.as_mut());
    pixels.encode_png().map_err(|error| failed(error.to_string()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn figures_are_set_in_columns() {
        let figure = |height: u32| ("T", format!("<svg viewBox=\"0 0 480 {height}\"><path d=\"\"/></svg>\n"));
        let svg = sheet(&[100, 50, 80, 10].map(figure));
        for place in ["x=\"0\" y=\"0\"", "x=\"480\" y=\"0\"", "x=\"960\" y=\"0\"", "x=\"480\" y=\"50\""] {
            assert!(svg.contains(place), "{place}: {svg}");
        }
        assert!(svg.contains("viewBox=\"0 0 1440 100\""));
    }
}
