//! Parity plots (the paper's Fig. 5) and response surfaces (Fig. 6), as SVG.

use crate::error::CliError;
use msdd_draw::text::significant;
use msdd_draw::{Axis, Line, Style, from_data, plot_named, series};
use msdd_surrogate::dataset::Ramp;
use msdd_surrogate::score::one_step_pairs;
use msdd_surrogate::scores::r_squared;
use msdd_surrogate::surrogate::{Answer, InitialData, Surrogate};

/// Largest number of points of a panel; more would hide each other.
const POINTS: usize = 1500;

/// Files of the plots: name and SVG text.
pub fn all(model: &dyn Surrogate, ramps: &[Ramp]) -> Result<Vec<(&'static str, String)>, CliError> {
    Ok(vec![("parity.svg", parity(model, ramps)?), ("response.svg", response(model)?)])
}

/// The model against DEM after one step between two states of a packing.
fn parity(model: &dyn Surrogate, ramps: &[Ramp]) -> Result<String, CliError> {
    let names = ["change of porosity", "change of fabric index", "K / k", "σ ℓ / (E r)"];
    let pairs = one_step_pairs(model, ramps);
    let panel = |(name, pairs): (&str, &Vec<[f64; 2]>)| {
        let all = || pairs.iter().flatten().copied();
        let range = (all().fold(f64::MAX, f64::min), all().fold(f64::MIN, f64::max));
        let [x, y] = ["DEM", "model"].map(|of| format!("{name} [-], {of}"));
        let axis = |label| Axis { label, log: false, range: Some(range) };
        let dots = pairs.iter().step_by(pairs.len().div_ceil(POINTS)).map(|[data, model]| (*data, *model));
        let list = vec![
            ("states of packings".to_string(), series(dots.collect(), Style::dots(2))),
            (
                "model = DEM".to_string(),
                series([range.0, range.1].map(|v| (v, v)).into(), Style::line(0, Line::Solid)),
            ),
        ];
        let title = format!("{name}: R² = {:.3} for {} values", r_squared(pairs), pairs.len());
        Ok(plot_named(&title, &axis(&x), &axis(&y), list)?)
    };
    let drawn = names.into_iter().zip(&pairs).filter(|(_, pairs)| !pairs.is_empty()).map(panel);
    Ok(msdd_draw::sheet(&drawn.collect::<Result<Vec<_>, CliError>>()?, 2))
}

/// What a panel of the response draws.
type Value = fn(&Answer) -> f64;

/// Porosity, K and p after strains from −5 to 5 %, from mean states of several porosities, in 100 increments.
fn response(model: &dyn Surrogate) -> Result<String, CliError> {
    const POROSITIES: [f64; 5] = [0.13, 0.08, 0.11, 0.15, 0.17];
    let panels: [(&str, Value); 3] = [
        ("porosity", |a| a.state[0][0]),
        ("mean K / k", |a| 0.5 * (a.conductivity[0][0] + a.conductivity[1][0])),
        ("p ℓ / (E r)", |a| 0.5 * (a.stress[0][0] + a.stress[1][0])),
    ];
    let panel = |(name, value): (&str, Value)| {
        let curves = POROSITIES.map(|porosity| curve(model, porosity, value));
        let ends =
            [curves[0].first(), curves[0].last()].map(|end| significant(end.map_or(0.0, |end| end.1), 2));
        let title = format!("{name} {} to {} from porosity {}", ends[0], ends[1], POROSITIES[0]);
        let named = |(k, points): (usize, Vec<(f64, f64)>)| {
            let from = if k == 0 { "from porosity " } else { "" };
            (format!("{from}{}", POROSITIES[k]), series(points, Style::line(k, Line::Solid)))
        };
        let list = curves.into_iter().enumerate().map(named).collect();
        let x = from_data("thermal strain [-]", false);
        Ok(plot_named(&title, &x, &from_data(&format!("{name} [-]"), false), list)?)
    };
    Ok(msdd_draw::sheet(&panels.into_iter().map(panel).collect::<Result<Vec<_>, CliError>>()?, 3))
}

/// A value over the thermal strain, which falls and rises from the mean state of a porosity.
fn curve(model: &dyn Surrogate, porosity: f64, value: Value) -> Vec<(f64, f64)> {
    let start = model.initial_state(&InitialData { porosity, ..InitialData::default() });
    let mut points = vec![(0.0, value(&model.evaluate(&start, 0.0)))];
    for sign in [-1.0, 1.0] {
        let mut state = start;
        for k in 1..=100 {
            let answer = model.evaluate(&state, sign * 5e-4 / (1.0 + sign * 5e-4 * f64::from(k - 1)));
            state = answer.state.map(|lanes| lanes[0]);
            points.push((sign * 5e-4 * f64::from(k), value(&answer)));
        }
    }
    points.sort_by(|a, b| a.0.total_cmp(&b.0));
    points
}
