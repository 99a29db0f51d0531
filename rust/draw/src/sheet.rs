//! Several figures as one picture.

/// Width of a figure \[px\].
const WIDTH: f64 = 480.0;

/// The figures in at most `columns` columns, each below the shortest one so far.
pub fn sheet<T: AsRef<str>>(figures: &[T], columns: usize) -> String {
    let columns = figures.len().clamp(1, columns.max(1));
    let (mut ends, mut body) = (vec![0.0f64; columns], String::new());
    for figure in figures {
        let Some((height, inner)) = opened(figure.as_ref()) else { continue };
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn figures_are_set_in_columns() {
        let figure = |height: u32| format!("<svg viewBox=\"0 0 480 {height}\"><path d=\"\"/></svg>\n");
        let svg = sheet(&[100, 50, 80, 10].map(figure), 3);
        for place in ["x=\"0\" y=\"0\"", "x=\"480\" y=\"0\"", "x=\"960\" y=\"0\"", "x=\"480\" y=\"50\""] {
            assert!(svg.contains(place), "{place}: {svg}");
        }
        assert!(svg.contains("viewBox=\"0 0 1440 100\""));
    }
}
