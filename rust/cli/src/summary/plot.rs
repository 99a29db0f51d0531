//! T at the three probes over time in all cases, beside the discs, as SVG.

use super::discs::Named;
use super::read::PROBES;
use crate::error::CliError;
use plotters::coord::Shift;
use plotters::prelude::*;

const SIZE: (u32, u32) = (1000, 1020);
/// Colours of P1, P2, P3 from the palette of Okabe and Ito, which can be told apart by colour-blind readers and in grey.
const COLOURS: [RGBColor; 3] = [RGBColor(230, 159, 0), RGBColor(0, 0, 0), RGBColor(0, 114, 178)];
/// Only every so-manieth time of DEM (0.1 s apart) is drawn as a point.
const SPARSE: usize = 8;

type Drawn = Result<(), Box<dyn std::error::Error>>;
type Area<'a> = DrawingArea<SVGBackend<'a>, Shift>;

/// The plot as SVG text: one panel for each case; dashed lines: the paper's scheme, solid lines: grains that move, points
/// and error bars: DEM.
pub fn temperature(cases: &[Named]) -> Result<String, CliError> {
    let mut svg = String::new();
    draw(cases, &mut svg).map_err(|error| CliError::Message(format!("cannot draw the plot: {error}")))?;
    Ok(svg)
}

/// Range of T of all curves, rounded outwards to tens of kelvin, and at least 0 to 100 K, the range of the shipped cases.
fn range(cases: &[Named]) -> std::ops::Range<f64> {
    let runs = cases.iter().flat_map(|case| [Some(&case.stay), case.moving.as_ref()]).flatten();
    let values: Vec<f64> =
        runs.flat_map(|run| run.probes.values().flatten()).map(|row| row.1 / 10.0).collect();
    let low = values.iter().copied().fold(0.0, f64::min).floor();
    let high = values.iter().copied().fold(10.0, f64::max).ceil();
    10.0 * low..10.0 * high
}

fn draw(cases: &[Named], svg: &mut String) -> Drawn {
    let root = SVGBackend::with_string(svg, SIZE).into_drawing_area();
    root.fill(&WHITE)?;
    let (head, body) = root.split_vertically(60);
    legend(&head)?;
    // H beside H*, C beside C*, HC beside HC*.
    let rows = cases.len().div_ceil(2);
    let panels = body.split_evenly((rows, 2));
    for (k, case) in cases.iter().enumerate() {
        panel(&panels[2 * (k % rows) + k / rows], case, range(cases))?;
    }
    root.present()?;
    Ok(())
}

/// The legend: a row of line samples with their names.
fn legend(area: &Area) -> Drawn {
    let text = |x: i32, words: &str| {
        area.draw(&Text::new(words.to_string(), (x, 22), ("sans-serif", 15).into_font()))
    };
    let grey = BLACK.mix(0.6).stroke_width(2);
    area.draw(&PathElement::new(vec![(30, 30), (40, 30)], grey))?;
    area.draw(&PathElement::new(vec![(46, 30), (56, 30)], grey))?;
    text(64, "paper's scheme: grains stay")?;
    area.draw(&PathElement::new(vec![(290, 30), (316, 30)], grey))?;
    text(324, "grains move")?;
    area.draw(&Circle::new((440, 30), 3, BLACK.mix(0.6).filled()))?;
    area.draw(&PathElement::new(vec![(440, 22), (440, 38)], BLACK.mix(0.6).stroke_width(1)))?;
    text(452, "15 000 discs: mean and scatter of three packings")?;
    for (k, (probe, colour)) in PROBES.into_iter().zip(COLOURS).enumerate() {
        let x = 835 + 50 * k as i32;
        area.draw(&Rectangle::new([(x, 25), (x + 10, 35)], colour.filled()))?;
        text(x + 15, probe)?;
    }
    Ok(())
}

fn panel(area: &Area, case: &Named, range: std::ops::Range<f64>) -> Drawn {
    let end = case.discs.pressure.last().map_or(case.stay.end.time, |row| row.0.max(case.stay.end.time));
    let mut chart = ChartBuilder::on(area)
        .caption(case.name, ("sans-serif", 18))
        .margin(10)
        .x_label_area_size(36)
        .y_label_area_size(48)
        .build_cartesian_2d(0.0..end, range)?;
    chart
        .configure_mesh()
        .x_desc("t [s]")
        .y_desc("T [K]")
        .light_line_style(WHITE)
        .bold_line_style(BLACK.mix(0.12))
        .label_style(("sans-serif", 13))
        .axis_desc_style(("sans-serif", 14))
        .draw()?;
    for (probe, colour) in PROBES.into_iter().zip(COLOURS) {
        let style = colour.stroke_width(2);
        if let Some(run) = &case.moving {
            chart.draw_series(LineSeries::new(run.probes[probe].iter().copied(), style))?;
        }
        chart.draw_series(DashedLineSeries::new(case.stay.probes[probe].iter().copied(), 7, 5, style))?;
        let discs = case.discs.temperature[probe].iter().step_by(SPARSE);
        chart.draw_series(discs.clone().map(|&(t, mean, _)| Circle::new((t, mean), 3, colour.filled())))?;
        chart.draw_series(discs.map(|&(t, mean, scatter)| {
            PathElement::new(vec![(t, mean - scatter), (t, mean + scatter)], colour.stroke_width(1))
        }))?;
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::summary::{fixture, read_all};

    #[test]
    fn all_cases_are_drawn_and_named_inside_the_range() {
        let folder = fixture::Cases::new("plot");
        let (cases, _) = read_all(folder.path(), Some(folder.path()), &fixture::reference()).unwrap();
        assert_eq!(range(&cases), 0.0..130.0);
        let svg = temperature(&cases).unwrap();
        for text in ["H", "C", "HC", "H*", "C*", "HC*", "t [s]", "T [K]", "grains move"] {
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
