//! Share of the conductivity of a bed in air that radiation has, over the temperature: the figure and the table of the book's page on the
//! law of spheres.
//!
//! ```sh
//! cargo run --release -p msdd-cli --example radiation_share -- docs/src/images/radiation.svg
//! ```

use msdd_beds::named_gases::GasName;
use msdd_case::spheres::material::{Emissivity, MATERIALS};
use msdd_case::spheres::start::{Gas, PouredBed};
use plotters::prelude::*;
use std::error::Error;

const DIAMETERS: [f64; 3] = [1e-3, 5e-3, 2e-2];
/// k_s \[W/(m K)\].
const SOLIDS: [f64; 2] = [40.0, 2.0];
const EMISSIVITY: f64 = 0.8;
const POROSITY: f64 = 0.4;
/// Vertical stress \[Pa\].
const STRESS: f64 = 1e4;
/// T \[K\] of the figure and of the rows of the table.
const RANGE: [f64; 2] = [300.0, 1300.0];
const TABLE: [f64; 4] = [300.0, 600.0, 900.0, 1200.0];
const STEPS: u32 = 50;
/// As in the other figures: from the palette of Okabe and Ito.
const COLOURS: [RGBColor; 3] = [RGBColor(0, 114, 178), RGBColor(230, 159, 0), RGBColor(0, 0, 0)];

fn main() -> Result<(), Box<dyn Error>> {
    let file = std::env::args().nth(1).ok_or("usage: radiation_share FILE.svg")?;
    println!("| diameter | {} |", TABLE.map(|t| format!("{t} K")).join(" | "));
    println!("|---|{}", "---|".repeat(TABLE.len()));
    for diameter in DIAMETERS {
        let [good, poor] = [bed(diameter, SOLIDS[0])?, bed(diameter, SOLIDS[1])?];
        let cell = |t: f64| format!("{:.0}, {:.0}", share(&good, t), share(&poor, t));
        println!("| {:.0} mm | {} |", 1e3 * diameter, TABLE.map(cell).join(" | "));
    }
    draw(&file)
}

fn bed(diameter: f64, solid: f64) -> Result<PouredBed, Box<dyn Error>> {
    let mut spheres = MATERIALS[0].spheres();
    spheres.emissivity = Emissivity::Constant(EMISSIVITY);
    (spheres.grains.mean_radius, spheres.grains.thermal_conductivity) = (0.5 * diameter, solid);
    Ok(PouredBed::new(spheres, STRESS)?)
}

/// \[%\]
fn share(bed: &PouredBed, temperature: f64) -> f64 {
    let start = bed.start(POROSITY, &Gas { name: GasName::Air, pressure: 101_325.0 }, temperature);
    100.0 * start.by_radiation / start.conductivity
}

fn draw(file: &str) -> Result<(), Box<dyn Error>> {
    let root = SVGBackend::new(file, (720, 440)).into_drawing_area();
    root.fill(&WHITE)?;
    let mut chart = ChartBuilder::on(&root)
        .margin(10)
        .margin_right(20)
        .x_label_area_size(40)
        .y_label_area_size(55)
        .build_cartesian_2d(RANGE[0]..RANGE[1], 0.0..100.0)?;
    chart
        .configure_mesh()
        .x_desc("T [K]")
        .y_desc("share of K by radiation [%]")
        .x_label_formatter(&|t| format!("{t:.0}"))
        .y_label_formatter(&|share| format!("{share:.0}"))
        .light_line_style(WHITE)
        .bold_line_style(BLACK.mix(0.12))
        .label_style(("sans-serif", 14))
        .axis_desc_style(("sans-serif", 15))
        .draw()?;
    let at = |k: u32| RANGE[0] + (RANGE[1] - RANGE[0]) * f64::from(k) / f64::from(STEPS);
    for (diameter, colour) in DIAMETERS.into_iter().zip(COLOURS).rev() {
        for (number, solid) in SOLIDS.into_iter().enumerate() {
            let bed = bed(diameter, solid)?;
            let line = (0..=STEPS).map(|k| (at(k), share(&bed, at(k))));
            let style = colour.stroke_width(2);
            let drawn = match number {
                0 => chart.draw_series(LineSeries::new(line, style))?,
                _ => chart.draw_series(DashedLineSeries::new(line, 7, 5, style))?,
            };
            drawn.label(format!("{:.0} mm, {solid} W/(m K)", 1e3 * diameter)).legend(move |(x, y)| {
                let ends = if number == 0 { vec![(x, y), (x + 28, y)] } else { vec![(x, y), (x + 11, y)] };
                PathElement::new(ends, style)
            });
        }
    }
    chart
        .configure_series_labels()
        .position(SeriesLabelPosition::UpperLeft)
        .legend_area_size(34)
        .background_style(WHITE.mix(0.8))
        .label_font(("sans-serif", 14))
        .draw()?;
    root.present()?;
    Ok(())
}
