//! Share of the conductivity of a bed in air that radiation has, over the temperature: the figure and the table of the book's page on the
//! law of spheres.
//!
//! ```sh
//! cargo run --release -p msdd-cli --example radiation_share -- docs/src/images/radiation.svg
//! ```

use msdd_beds::case::GasKeys;
use msdd_beds::named_gases::GasName;
use msdd_beds::property::Property;
use msdd_case::material::{OF_SPHERES, Values};
use msdd_case::spheres::material::Spheres;
use msdd_case::spheres::start::PouredBed;
use msdd_draw::{Axis, Line, Style, plot_named, series};
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
/// Numbers of the palette.
const COLOURS: [usize; 3] = [2, 1, 0];

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
    let mut spheres = Spheres::of(&OF_SPHERES[0], OF_SPHERES[0].grains(&Values::default())?)?;
    spheres.emissivity = Property::Constant(EMISSIVITY);
    (spheres.grains.mean_radius, spheres.grains.thermal_conductivity) = (0.5 * diameter, solid);
    Ok(PouredBed::new(spheres, STRESS)?)
}

/// \[%\]
fn share(bed: &PouredBed, temperature: f64) -> f64 {
    let start = bed.start(POROSITY, &GasKeys::new(GasName::Air, 101_325.0), temperature);
    100.0 * start.by_radiation / start.conductivity
}

fn draw(file: &str) -> Result<(), Box<dyn Error>> {
    let at = |k: u32| RANGE[0] + (RANGE[1] - RANGE[0]) * f64::from(k) / f64::from(STEPS);
    let mut list = Vec::new();
    for (diameter, colour) in DIAMETERS.into_iter().zip(COLOURS).rev() {
        for (solid, line) in SOLIDS.into_iter().zip([Line::Solid, Line::Dashed]) {
            let bed = bed(diameter, solid)?;
            let points = (0..=STEPS).map(|k| (at(k), share(&bed, at(k)))).collect();
            let name = format!("{:.0} mm, {solid} W/(m K)", 1e3 * diameter);
            list.push((name, series(points, Style::line(colour, line))));
        }
    }
    let x = Axis { label: "T [K]", log: false, range: Some((RANGE[0], RANGE[1])) };
    let y = Axis { label: "share of K by radiation [%]", log: false, range: Some((0.0, 100.0)) };
    let title = "Radiation dominates above 600 K in beds of 20 mm spheres";
    Ok(std::fs::write(file, plot_named(title, &x, &y, list)?)?)
}
