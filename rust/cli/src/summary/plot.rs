//! T at the three probes over time in all cases, compared with the discs, as SVG.

use super::discs::Named;
use super::read::{CaseResult, PROBES};
use crate::error::CliError;
use msdd_draw::{Axis, Line, Marker, Series, Style, plot_named, series};

/// Colours of P1, P2 and P3.
const COLOURS: [usize; 3] = [1, 0, 2];
/// Only every so-manieth time of DEM (0.1 s apart) is drawn as a point.
const SPARSE: usize = 10;

/// The plot as SVG text: a panel for each case.
pub fn temperature(cases: &[Named]) -> Result<String, CliError> {
    // H next to H*, C next to C*, HC next to HC*
    let rows = cases.len().div_ceil(2);
    let panels = (0..cases.len()).map(|k| k % 2 * rows + k / 2).filter_map(|k| cases.get(k));
    let panels = panels.map(|case| panel(case, range(cases))).collect::<Result<Vec<_>, _>>()?;
    Ok(msdd_draw::sheet(&panels, 2))
}

/// Range of T of all curves, rounded outwards to tens of kelvin, and at least 0 to 100 K, the range of the shipped cases.
fn range(cases: &[Named]) -> (f64, f64) {
    let runs = cases.iter().flat_map(|case| [Some(&case.stay), case.moving.as_ref()]).flatten();
    let values: Vec<f64> =
        runs.flat_map(|run| run.probes.values().flatten()).map(|row| row.1 / 10.0).collect();
    let low = values.iter().copied().fold(0.0, f64::min).floor();
    let high = values.iter().copied().fold(10.0, f64::max).ceil();
    (10.0 * low, 10.0 * high)
}

fn panel(case: &Named, range: (f64, f64)) -> Result<String, CliError> {
    let end = case.discs.pressure.last().map_or(case.stay.end.time, |row| row.0.max(case.stay.end.time));
    let mut list: Vec<(String, Series)> = Vec::new();
    for (k, (probe, colour)) in PROBES.into_iter().zip(COLOURS).enumerate() {
        let named = |name: &str| if k == 0 { name.to_string() } else { String::new() };
        let stay = if case.moving.is_some() { named("grains stay") } else { probe.to_string() };
        let dashed = Style::line(colour, Line::Dashed);
        list.push((stay, series(case.stay.probes[probe].clone(), dashed)));
        if let Some(run) = &case.moving {
            list.push((probe.into(), series(run.probes[probe].clone(), Style::line(colour, Line::Solid))));
        }
        let points: Vec<_> = case.discs.temperature[probe].iter().step_by(SPARSE).collect();
        list.push((
            named("discs, three packings"),
            Series {
                points: points.iter().map(|&&(t, mean, _)| (t, mean)).collect(),
                bars: points.iter().map(|point| point.2).collect(),
                style: Style { size: 3, ..Style::marker(colour, Marker::Circle) },
            },
        ));
    }
    let error = |run: &CaseResult| case.errors(run).map(|errors| format!("{:.1} %", errors.largest()));
    let title = match (error(&case.stay), case.moving.as_ref().and_then(error)) {
        (Some(stay), Some(moving)) => {
            format!("{}: error {moving} where grains move, {stay} where they stay", case.name)
        }
        (Some(stay), None) => format!("{}: error {stay}", case.name),
        _ => case.name.to_string(),
    };
    let x = Axis { label: "time [s]", log: false, range: Some((0.0, end)) };
    let y = Axis { label: "T [K]", log: false, range: Some(range) };
    Ok(plot_named(&title, &x, &y, list)?)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::summary::{fixture, read_all};

    #[test]
    fn all_cases_are_drawn_and_named_inside_the_range() {
        let folder = fixture::Cases::new("plot");
        let (cases, _) = read_all(folder.path(), Some(folder.path()), &fixture::reference()).unwrap();
        assert_eq!(range(&cases), (0.0, 130.0));
        let svg = temperature(&cases).unwrap();
        for text in ["H", "C", "HC", "H*", "C*", "HC*", "T [K]"] {
            assert!(svg.contains(&format!("\n{text}")), "no {text} in {svg}");
        }
        assert_eq!(svg.matches("grains stay\n").count(), cases.len());
    }
}
