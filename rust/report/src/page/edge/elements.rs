//! Section of the page on the limits of DEM.

use crate::ReportError;
use crate::failures::elements::Limits;
use crate::page::html::Figure;
use crate::report::Made;
use msdd_draw::{Axis, Line, Marker, Series, Style, from_data, plot, series};

pub fn steps(made: &Made) -> Result<String, ReportError> {
    let steps = &made.report.failures.stable_steps;
    if steps.is_empty() {
        return Ok(String::new());
    }
    let predicted = Style::line(0, Line::Dashed);
    let measured = Style { size: 5, ..Style::marker(1, Marker::Circle) };
    let x = Axis { label: "porosity [-]", log: false, range: None };
    let of =
        |pick: &dyn Fn(usize) -> Vec<(f64, f64)>| vec![series(pick(0), predicted), series(pick(1), measured)];
    let mechanical = |k: usize| steps.iter().map(|s| (s.porosity, 1e3 * s.mechanical[k])).collect();
    let thermal = |k: usize| steps.iter().map(|s| (s.porosity, 1e3 * s.thermal[k])).collect();
    let from_zero = |label, high| Axis { label, log: false, range: Some((0.0, high)) };
    let panels = vec![
        plot("mechanical step", &x, &from_zero("largest stable step [ms]", 1.5), &of(&mechanical))?,
        plot("thermal step", &x, &from_zero("largest stable step [ms]", 1.5), &of(&thermal))?,
    ];
    let ratio = |of: &dyn Fn(&crate::failures::elements::StableStep) -> [f64; 2]| {
        let ratios: Vec<f64> = steps.iter().map(|s| of(s)[1] / of(s)[0]).collect();
        let low = ratios.iter().copied().fold(f64::INFINITY, f64::min);
        format!("{low:.2} to {:.2}", ratios.iter().copied().fold(0.0, f64::max))
    };
    let caption = format!(
        "Fig. #. Largest stable time steps of DEM; longer ones are unstable. Measured over predicted: mechanical {}, thermal {}. The program uses \
         0.4 and 0.7 of the bound, and refuses fixed steps beyond it.",
        ratio(&|s| s.mechanical),
        ratio(&|s| s.thermal)
    );
    let keys = vec![
        (predicted, "predicted bound".to_string()),
        (measured, "measured: largest step that stays bounded".to_string()),
    ];
    Figure {
        id: "stable-steps",
        panels,
        keys,
        caption,
        source: "msdd bench stability, 500 discs; measured and cached",
    }
    .html(&made.report.made)
}

/// Styles of the two strains, +2 and -2 %.
fn strained(strain: f64) -> (Style, &'static str) {
    if strain > 0.0 {
        (Style { line: Line::Solid, ..Style::marker(1, Marker::Circle) }, "expansion by 2 %")
    } else {
        (Style { line: Line::Dashed, ..Style::marker(2, Marker::Square) }, "contraction by 2 %")
    }
}

/// A vertical line at the value that the program uses, down to the lowest error drawn.
fn used(at: f64, range: (f64, f64)) -> Series {
    series(vec![(at, range.0), (at, range.1)], Style::line(4, Line::Dotted))
}

pub fn slowness(made: &Made) -> Result<String, ReportError> {
    let Some(limits) = &made.report.failures.limits else { return Ok(String::new()) };
    let error = "rms error of the pressure [%]";
    let (rates, balance) = ((1e-3, 10.0), (1e-7, 1.0));
    let mut panels = Vec::new();
    let mut drawn = vec![used(0.1, rates), used(0.02, rates)];
    for strain in [0.02, -0.02] {
        let rows = limits.ramp_rate.iter().filter(|r| r.strain == strain && r.pressure_rms > 0.0);
        drawn.push(series(rows.map(|r| (r.rate, r.pressure_rms)).collect(), strained(strain).0));
    }
    let y = |range| Axis { label: error, log: true, range: Some(range) };
    panels.push(plot("rate of a ramp", &from_data("rate [1/s]", true), &y(rates), &drawn)?);
    let mut drawn = vec![used(1e-4, balance)];
    for strain in [0.02, -0.02] {
        let rows = limits.balance.iter().filter(|r| r.strain == strain && r.pressure_rms > 0.0);
        drawn.push(series(rows.map(|r| (r.unbalanced, r.pressure_rms)).collect(), strained(strain).0));
    }
    panels.push(plot("balance of forces", &from_data("unbalanced force [-]", true), &y(balance), &drawn)?);
    let range = (0.0, 0.14);
    let speeds = limits.wall_speed.iter();
    let porosity = Series {
        points: speeds.clone().map(|r| (r.speed, r.porosity[0])).collect(),
        bars: speeds.map(|r| r.porosity[1]).collect(),
        style: Style { line: Line::Solid, ..Style::marker(3, Marker::Triangle) },
    };
    let y = Axis { label: "porosity at rest [-]", log: false, range: Some(range) };
    let drawn = [used(0.03, range), porosity];
    panels.push(plot("speed of packing", &from_data("speed of the walls [m/s]", true), &y, &drawn)?);
    let keys = [0.02, -0.02].map(strained).into_iter().map(|(style, text)| (style, text.to_string()));
    let keys = keys
        .chain([
            (
                Style { line: Line::Solid, ..Style::marker(3, Marker::Triangle) },
                "packings, bars: their scatter".into(),
            ),
            (Style::line(4, Line::Dotted), "what the program takes".to_string()),
        ])
        .collect();
    let source = "msdd bench limits, periodic boxes of 500 discs; measured and cached";
    Figure { id: "slowness", panels, keys, caption: said_of(limits), source }.html(&made.report.made)
}

fn said_of(limits: &Limits) -> String {
    let rate = |strain: f64, rate: f64| {
        let row = limits.ramp_rate.iter().find(|r| r.strain == strain && r.rate == rate);
        row.map_or(f64::NAN, |r| r.pressure_rms)
    };
    let balance = |limit: f64| {
        let rows = limits.balance.iter().filter(|r| r.unbalanced == limit);
        rows.map(|r| r.pressure_rms).fold(0.0, f64::max)
    };
    let porosity =
        |speed: f64| limits.wall_speed.iter().find(|r| r.speed == speed).map_or(f64::NAN, |r| r.porosity[0]);
    format!(
        "Fig. #. How slowly boxes have to be strained and packed, {} packings. Expected: the result of expansion hardly depends on the strain rate, that of contraction does, \
         and walls may move at 0.05 m/s at most. Error of the pressure by strain rate: at 2 1/s {:.1} % for expansion and {:.1} % for contraction, at the rates of the program (0.1 and 0.02 1/s) {:.2} and \
         {:.2} %. By the unbalanced force that is allowed: {:.4} % at 1e-4, {:.2} % at 0.01. Packing to a porosity of 0.13: with walls at 0.03 m/s the packing comes to rest at {:.3}, with walls at 1 m/s, which throw grains ahead \
         of them, at {:.3}.",
        limits.packings,
        rate(0.02, 2.0),
        rate(-0.02, 2.0),
        rate(0.02, 0.1),
        rate(-0.02, 0.02),
        balance(1e-4),
        balance(1e-2),
        porosity(0.03),
        porosity(1.0)
    )
}

pub fn unjamming(made: &Made) -> Result<String, ReportError> {
    let Some(limits) = &made.report.failures.limits else { return Ok(String::new()) };
    let styles = [
        ("DEM", Style { size: 4, ..Style::marker(0, Marker::Circle) }),
        ("increment", Style::line(1, Line::Solid)),
        ("paper", Style::line(2, Line::Dashed)),
    ];
    let x = from_data("thermal strain [%]", false);
    let of = |pick: &dyn Fn(&crate::failures::elements::Answer) -> f64| -> Vec<_> {
        let line = |(name, style): &(&str, Style)| {
            let rows = limits
                .unjamming
                .iter()
                .filter_map(|row| Some((100.0 * row.strain, pick(row.by.get(*name)?))));
            series(rows.collect(), *style)
        };
        styles.iter().map(line).collect()
    };
    let panels = vec![
        plot("conductivity", &x, &from_data("K/k [-]", false), &of(&|a| a.conductivity))?,
        plot("pressure", &x, &from_data("pressure [kPa]", false), &of(&|a| 1e-3 * a.pressure))?,
    ];
    let gone = |name: &str| {
        let rows = limits.unjamming.iter();
        let loose = rows.filter(|row| row.by.get(name).is_some_and(|a| a.pressure < 1.0));
        loose.map(|row| 100.0 * row.strain).fold(f64::NEG_INFINITY, f64::max)
    };
    let said = |name: &str| match gone(name) {
        strain if strain.is_finite() => format!("at {strain:.1} %"),
        _ => "never".to_string(),
    };
    let caption = format!(
        "Fig. #. Grains that shrink until they lose contact, mean of {} packings. The pressure falls below 1 Pa: DEM {}, the law of the increments {}, the paper's \
         network {}. The law starts from the stress of the packings; its K/k is kept above zero, at 1e-4 or more.",
        limits.packings,
        said("DEM"),
        said("increment"),
        said("paper")
    );
    let keys = styles.map(|(name, style)| (style, name.to_string())).to_vec();
    let source = "msdd bench limits, periodic boxes of 500 discs; measured and cached";
    Figure { id: "unjamming", panels, keys, caption, source }.html(&made.report.made)
}
