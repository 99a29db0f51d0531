//! T at the probes over time, beside the measurements, as SVG.

use super::results::Results;
use crate::error::CliError;
use msdd_beds::bed::PlateKind;
use msdd_beds::experiment::ZERO_CELSIUS;
use plotters::coord::Shift;
use plotters::prelude::*;

const SIZE: (u32, u32) = (860, 560);
/// From the palette of Okabe and Ito, which can be told apart by colour-blind readers and in grey.
const COLOURS: [RGBColor; 4] =
    [RGBColor(0, 0, 0), RGBColor(230, 159, 0), RGBColor(0, 114, 178), RGBColor(0, 158, 115)];

type Drawn = Result<(), Box<dyn std::error::Error>>;

/// Lines: the plate held; dashes: the plate resisting; points: measured.
pub fn temperature(results: &Results) -> Result<String, CliError> {
    let mut svg = String::new();
    draw(results, &mut svg).map_err(|error| CliError::Message(format!("cannot draw the plot: {error}")))?;
    Ok(svg)
}

fn draw(results: &Results, svg: &mut String) -> Drawn {
    let root = SVGBackend::with_string(svg, SIZE).into_drawing_area();
    root.fill(&WHITE)?;
    let (head, body) = root.split_vertically(50);
    let measured: Vec<(f64, f64, f64)> =
        results.measured.iter().map(|m| (m.distance, m.time, m.temperature - ZERO_CELSIUS)).collect();
    let rows = results.compared.iter().flat_map(|run| &run.heated.records).flat_map(|record| &record.rows);
    let values: Vec<f64> = rows.map(|row| row.1 - ZERO_CELSIUS).chain(measured.iter().map(|m| m.2)).collect();
    let low = values.iter().copied().fold(f64::INFINITY, f64::min).floor();
    let high = values.iter().copied().fold(f64::NEG_INFINITY, f64::max).ceil().max(low + 1.0);
    let mut chart = ChartBuilder::on(&body)
        .margin(10)
        .margin_right(30)
        .x_label_area_size(40)
        .y_label_area_size(50)
        .build_cartesian_2d(0.0..results.case.heat.end, low..high)?;
    chart
        .configure_mesh()
        .x_desc("t [s]")
        .y_desc("T [°C]")
        .x_label_formatter(&|time| format!("{time:.0}"))
        .y_label_formatter(&|t| format!("{t:.0}"))
        .light_line_style(WHITE)
        .bold_line_style(BLACK.mix(0.12))
        .label_style(("sans-serif", 14))
        .axis_desc_style(("sans-serif", 15))
        .draw()?;
    let colour = |number: usize| COLOURS[number % COLOURS.len()];
    for run in &results.compared {
        for (number, record) in run.heated.records.iter().enumerate() {
            let line = record.rows.iter().map(|&(time, t)| (time, t - ZERO_CELSIUS));
            let style = colour(number).stroke_width(2);
            match run.heated.kind {
                PlateKind::Held => chart.draw_series(LineSeries::new(line, style)).map(|_| ())?,
                PlateKind::Resisting => {
                    chart.draw_series(DashedLineSeries::new(line, 7, 5, style)).map(|_| ())?;
                }
            }
        }
    }
    for (number, &distance) in results.case.heat.probes.iter().enumerate() {
        let here = measured.iter().filter(|m| (m.0 - distance).abs() < 1e-6);
        chart.draw_series(here.map(|&(_, time, t)| Circle::new((time, t), 3, colour(number).mix(0.7))))?;
    }
    legend(&head, results)?;
    root.present()?;
    Ok(())
}

fn legend(area: &DrawingArea<SVGBackend, Shift>, results: &Results) -> Drawn {
    let text =
        |x: i32, y: i32, words: String| area.draw(&Text::new(words, (x, y), ("sans-serif", 15).into_font()));
    let grey = BLACK.mix(0.6).stroke_width(2);
    area.draw(&PathElement::new(vec![(20, 16), (48, 16)], grey))?;
    text(56, 8, "first layer at the plate's temperature".to_string())?;
    area.draw(&PathElement::new(vec![(350, 16), (360, 16)], grey))?;
    area.draw(&PathElement::new(vec![(366, 16), (376, 16)], grey))?;
    text(384, 8, "plate with its resistance".to_string())?;
    area.draw(&Circle::new((606, 16), 3, BLACK.mix(0.6)))?;
    text(616, 8, "measured".to_string())?;
    for (number, distance) in results.case.heat.probes.iter().enumerate() {
        let x = 20 + 200 * number as i32;
        let colour = COLOURS[number % COLOURS.len()];
        area.draw(&Rectangle::new([(x, 32), (x + 10, 42)], colour.filled()))?;
        text(x + 16, 29, format!("{:.0} mm from the plate", 1e3 * distance))?;
    }
    Ok(())
}
