//! T at P2 over time in all cases, as SVG.

use super::read::Named;
use crate::error::CliError;
use plotters::prelude::*;

const SIZE: (u32, u32) = (860, 520);

/// Colours of hot, cold, and hot–cold cases: Okabe and Ito's, told apart by the colour-blind, and in grey.
const COLOURS: [RGBColor; 3] = [RGBColor(230, 159, 0), RGBColor(0, 114, 178), RGBColor(0, 0, 0)];

/// The plot's SVG text. Cases without expansion are dashed.
pub fn temperature(cases: &[Named]) -> Result<String, CliError> {
    let mut svg = String::new();
    draw(cases, &mut svg).map_err(|error| CliError::Message(format!("cannot draw the plot: {error}")))?;
    Ok(svg)
}

/// Lowest and highest T at P2, rounded outwards to tens of kelvin, 0 to 100 K at least: the walls of the shipped cases.
fn range(cases: &[Named]) -> std::ops::Range<f64> {
    let values = || cases.iter().flat_map(|case| &case.result.probes["P2"]).map(|&(_, value)| value / 10.0);
    let low = values().fold(0.0, f64::min).floor();
    let high = values().fold(10.0, f64::max).ceil();
    10.0 * low..10.0 * high
}

fn draw(cases: &[Named], svg: &mut String) -> Result<(), Box<dyn std::error::Error>> {
    let root = SVGBackend::with_string(svg, SIZE).into_drawing_area();
    root.fill(&WHITE)?;
    let end = cases.iter().map(|case| case.result.end.time).fold(0.0, f64::max);
    let mut chart = ChartBuilder::on(&root)
        .caption("Temperature at P2, the centre", ("sans-serif", 20))
        .margin(14)
        .x_label_area_size(44)
        .y_label_area_size(56)
        .build_cartesian_2d(0.0..end, range(cases))?;
    chart
        .configure_mesh()
        .x_desc("t [s]")
        .y_desc("T [K]")
        .light_line_style(WHITE)
        .bold_line_style(BLACK.mix(0.12))
        .label_style(("sans-serif", 14))
        .axis_desc_style(("sans-serif", 16))
        .draw()?;
    for (case, colour) in cases.iter().zip(COLOURS.iter().cycle()) {
        let points = case.result.probes["P2"].iter().copied();
        let style = colour.stroke_width(2);
        let series = if case.name.ends_with('*') {
            chart.draw_series(DashedLineSeries::new(points, 7, 5, style))?
        } else {
            chart.draw_series(LineSeries::new(points, style))?
        };
        // Two dashes, which meet in a solid line.
        let gap = if case.name.ends_with('*') { 4 } else { 0 };
        series.label(case.name).legend(move |at| {
            EmptyElement::at(at)
                + PathElement::new(vec![(0, 0), (13 - gap, 0)], style)
                + PathElement::new(vec![(13 + gap, 0), (26, 0)], style)
        });
    }
    chart
        .configure_series_labels()
        // Between the curves that end near 100 K and those that end near 50 K.
        .position(SeriesLabelPosition::Coordinate(660, 34))
        .background_style(WHITE)
        .border_style(BLACK.mix(0.3))
        .label_font(("sans-serif", 15))
        .legend_area_size(34)
        .margin(8)
        .draw()?;
    root.present()?;
    drop(chart);
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::summary::{fixture, read_all};

    #[test]
    fn all_cases_are_drawn_and_named_inside_the_range() {
        let folder = fixture::Cases::new("plot");
        let (cases, _) = read_all(folder.path()).unwrap();
        assert_eq!(range(&cases), 0.0..120.0);
        let svg = temperature(&cases).unwrap();
        for text in ["H", "C", "HC", "H*", "C*", "HC*", "t [s]", "T [K]"] {
            assert!(svg.contains(&format!(">\n{text}\n</text>")), "no {text} in {svg}");
        }
        for RGBColor(r, g, b) in COLOURS {
            assert!(svg.contains(&format!("#{r:02X}{g:02X}{b:02X}")));
        }
    }

    #[test]
    fn colours_differ_in_grey() {
        let mut greys = COLOURS
            .map(|RGBColor(r, g, b)| 0.299 * f64::from(r) + 0.587 * f64::from(g) + 0.114 * f64::from(b));
        greys.sort_by(f64::total_cmp);
        assert!(greys.windows(2).all(|pair| pair[1] - pair[0] > 60.0), "{greys:?}");
    }
}
