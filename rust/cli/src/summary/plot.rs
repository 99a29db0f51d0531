//! T at P2 over time in all cases, as SVG.

use super::Named;
use crate::error::CliError;
use plotters::prelude::*;

const SIZE: (u32, u32) = (860, 520);

/// Colours of hot, cold, and hot–cold cases: Okabe and Ito's, told apart by the colour-blind; their greys differ too.
const COLOURS: [RGBColor; 3] = [RGBColor(213, 94, 0), RGBColor(0, 114, 178), RGBColor(0, 158, 115)];

/// The plot's SVG text. Cases without expansion are dashed.
pub fn temperature(cases: &[Named]) -> Result<String, CliError> {
    let mut svg = String::new();
    draw(cases, &mut svg).map_err(|error| CliError::Message(format!("cannot draw the plot: {error}")))?;
    Ok(svg)
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
        .build_cartesian_2d(0.0..end, 0.0..100.0)?;
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
        let dashed = case.name.ends_with('*');
        series.label(case.name).legend(move |(x, y)| {
            let ends = if dashed { vec![(x, y), (x + 9, y)] } else { vec![(x, y), (x + 26, y)] };
            PathElement::new(ends, style)
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
