//! Parity plots (the paper's Fig. 5) and response surfaces (Fig. 6), as SVG.

use crate::error::CliError;
use msdd_surrogate::dataset::Ramp;
use msdd_surrogate::score::one_step_pairs;
use msdd_surrogate::scores::r_squared;
use msdd_surrogate::surrogate::{InitialData, Surrogate};
use plotters::prelude::*;

const PANEL: u32 = 320;
/// Largest number of points of a panel; more could not be told apart.
const POINTS: usize = 1500;
const BLUE: RGBColor = RGBColor(0, 114, 178);

/// Files of the plots: name and SVG text.
pub fn all(model: &dyn Surrogate, ramps: &[Ramp]) -> Result<Vec<(&'static str, String)>, CliError> {
    let failed = |error: Box<dyn std::error::Error>| CliError::Message(format!("cannot draw: {error}"));
    Ok(vec![
        ("parity.svg", parity(model, ramps).map_err(failed)?),
        ("response.svg", response(model).map_err(failed)?),
    ])
}

fn parity(model: &dyn Surrogate, ramps: &[Ramp]) -> Result<String, Box<dyn std::error::Error>> {
    let names =
        ["increment of porosity", "increment of fabric index", "increment of f_K", "K/k", "stress, reduced"];
    let pairs = one_step_pairs(model, ramps);
    let panels: Vec<_> = names.iter().zip(&pairs).filter(|(_, pairs)| !pairs.is_empty()).collect();
    let mut svg = String::new();
    {
        let root =
            SVGBackend::with_string(&mut svg, (PANEL * panels.len() as u32, PANEL)).into_drawing_area();
        root.fill(&WHITE)?;
        for (area, (name, pairs)) in root.split_evenly((1, panels.len())).iter().zip(panels) {
            let all = pairs.iter().flatten();
            let low = all.clone().copied().fold(f64::MAX, f64::min);
            let high = all.copied().fold(f64::MIN, f64::max);
            let caption = format!("{name}, R2 = {:.4}", r_squared(pairs));
            let mut chart = ChartBuilder::on(area)
                .caption(caption, ("sans-serif", 14))
                .margin(8)
                .x_label_area_size(34)
                .y_label_area_size(52)
                .build_cartesian_2d(low..high, low..high)?;
            chart.configure_mesh().x_desc("DEM").y_desc("model").x_labels(5).y_labels(5).draw()?;
            let step = pairs.len().div_ceil(POINTS);
            let dot = |[data, model]: &[f64; 2]| Circle::new((*data, *model), 1, BLUE.mix(0.5).filled());
            chart.draw_series(pairs.iter().step_by(step).map(dot))?;
            chart.draw_series(LineSeries::new([(low, low), (high, high)], BLACK))?;
        }
        root.present()?;
    }
    Ok(svg)
}

/// K and p after strains from −5 to 5 %, from mean states of several porosities, in 100 increments.
fn response(model: &dyn Surrogate) -> Result<String, Box<dyn std::error::Error>> {
    const POROSITIES: [f64; 5] = [0.08, 0.11, 0.13, 0.15, 0.17];
    let curve = |porosity: f64, value: &dyn Fn(&msdd_surrogate::surrogate::Answer) -> f64| {
        let start = model.initial_state(&InitialData { porosity, ..InitialData::default() });
        let mut points = Vec::new();
        for sign in [-1.0, 1.0] {
            let mut state = start;
            points.push((0.0, value(&model.evaluate(&state, 0.0))));
            for k in 1..=100 {
                let answer = model.evaluate(&state, sign * 5e-4 / (1.0 + sign * 5e-4 * f64::from(k - 1)));
                state = answer.state.map(|lanes| lanes[0]);
                points.push((sign * 5e-4 * f64::from(k), value(&answer)));
            }
        }
        points.sort_by(|a, b| a.0.total_cmp(&b.0));
        points
    };
    let mut svg = String::new();
    {
        let root = SVGBackend::with_string(&mut svg, (3 * PANEL, PANEL)).into_drawing_area();
        root.fill(&WHITE)?;
        type Value = fn(&msdd_surrogate::surrogate::Answer) -> f64;
        let panels: [(&str, f64, Value); 3] = [
            ("porosity", 0.3, |a| a.state[0][0]),
            ("mean K/k", 0.9, |a| 0.5 * (a.conductivity[0][0] + a.conductivity[1][0])),
            ("p, reduced", 0.25, |a| 0.5 * (a.stress[0][0] + a.stress[1][0])),
        ];
        for (area, (name, highest, value)) in root.split_evenly((1, 3)).iter().zip(panels) {
            let mut chart = ChartBuilder::on(area)
                .caption(format!("{name}; start at porosity 0.08 (dark) to 0.17"), ("sans-serif", 13))
                .margin(8)
                .x_label_area_size(34)
                .y_label_area_size(46)
                .build_cartesian_2d(-0.05..0.05, 0.0..highest)?;
            chart.configure_mesh().x_desc("thermal strain").x_labels(5).y_labels(5).draw()?;
            for (k, porosity) in POROSITIES.into_iter().enumerate() {
                let shade = (45 * k) as u8;
                let style = RGBColor(shade, shade, 178).stroke_width(2);
                chart.draw_series(LineSeries::new(curve(porosity, &value), style))?;
            }
        }
        root.present()?;
    }
    Ok(svg)
}
