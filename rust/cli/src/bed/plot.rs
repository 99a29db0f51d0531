//! T at the probes over time, compared with measurements, as SVG.

use super::results::Results;
use crate::error::CliError;
use msdd_beds::bed::PlateKind;
use msdd_draw::{Line, Marker, Series, Style, from_data, plot_named, series};

/// Lines: the plate held; dashes: the plate resisting; points: measured.
pub fn temperature(results: &Results) -> Result<String, CliError> {
    let colour = |number: usize| [0, 1, 2, 3][number % 4];
    let mut list: Vec<(String, Series)> = Vec::new();
    for run in &results.compared {
        for (number, record) in run.heated.records.iter().enumerate() {
            let (line, name) = match run.heated.kind {
                PlateKind::Held => (Line::Solid, format!("{:.0} mm from the plate", 1e3 * record.distance)),
                PlateKind::Resisting => (Line::Dashed, String::new()),
            };
            list.push((name, series(record.rows.clone(), Style::line(colour(number), line))));
        }
    }
    for (number, &distance) in results.case.record.distances.iter().enumerate() {
        let here = results.measured.iter().filter(|m| (m.distance - distance).abs() < 1e-6);
        let points = here.map(|m| (m.time, m.temperature)).collect();
        let style = Style { hollow: true, size: 3, ..Style::marker(colour(number), Marker::Circle) };
        list.push((String::new(), series(points, style)));
    }
    let black = |line| Series { points: Vec::new(), bars: Vec::new(), style: Style::line(4, line) };
    list.push(("first layer at the plate's T".into(), black(Line::Solid)));
    list.push(("plate with its resistance".into(), black(Line::Dashed)));
    let mut title = "Temperatures of the bed".to_string();
    if !results.measured.is_empty() {
        let style = Style { hollow: true, size: 3, ..Style::marker(4, Marker::Circle) };
        list.push(("measured".into(), series(Vec::new(), style)));
        let rms = |kind: PlateKind| {
            let run = results.compared.iter().find(|run| run.heated.kind == kind);
            run.and_then(|run| run.misfits.last()).map_or(f64::NAN, |misfit| misfit.rms)
        };
        let [held, resisting] = [PlateKind::Held, PlateKind::Resisting].map(rms);
        title = format!("Error {held:.1} K (rms); with the plate's resistance {resisting:.1} K");
    }
    let [x, y] = ["time [s]", "T [K]"].map(|label| from_data(label, false));
    Ok(plot_named(&title, &x, &y, list)?)
}
