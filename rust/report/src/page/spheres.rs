//! The page on beds of spheres: error against cost beside DEM, beds that were measured, limits.

use super::case::decades;
use super::html::Figure;
use crate::ReportError;
use crate::report::Made;
use crate::studies::spheres::{FAMILIES, MEASURED, SphereRun, ZehnerBed};
use msdd_draw::html::{fixed, head, numbered, table};
use msdd_draw::{Axis, Line, MARKERS, Series, Style, escape, from_data, plot, series};
use std::fmt::Write;

/// Cases beside DEM.
const CASES: [&str; 2] = ["column", "store"];
/// Zehner's materials.
const MATERIALS: [&str; 5] = ["steel", "copper", "steatite", "ceramic", "lead glass"];
/// 0 °C \[K\].
const ZERO_CELSIUS: f64 = 273.15;

/// What beds of spheres by this solver and these programs do not have.
const LIMITS: [&str; 8] = [
    "Spheres are equal. Contacts are elastic: where Hertz's peak stress passes 1.6 times the yield stress, a run says so.",
    "The law is fitted to periodic boxes of 1000 spheres with a friction of 0.3, p/E* from 1e-8 to 1e-3 and one cycle and a half of strain: a bed that is \
     cycled ten times goes on to settle and gets stiffer, which the law does not.",
    "Friction at walls is not part of the law: a case gives it for each wall, and a wall without it is smooth.",
    "Layers of spheres that are ordered along walls conduct less than the bed behind them; the solver has one law for both.",
    "Where spheres conduct less than 60 times as well as the gas, a closure takes the place of the law of pairs, with an error of 1 to 10 %.",
    "Spheres radiate where a case gives their emissivity, as opaque, grey and diffuse bodies. In beds of polished steel of 6 mm it is 1 % at 300 K.",
    "How rough surfaces are, what presses on a plate and how much spheres conduct is seldom reported, and moves what was measured by more than the laws err.",
    "Spheres have no bands of error, as discs have them: a state outside of what the law was fitted to is clamped or refused (policy).",
];

/// The page's text.
///
/// # Errors
/// [`ReportError::Draw`].
pub fn text(made: &Made) -> Result<String, ReportError> {
    let report = &made.report;
    let stamp = &report.made;
    let mut page = head("MSDD: beds of spheres");
    let _ = writeln!(
        page,
        "<h1>Beds of spheres</h1>\n<p>The solver with the law of spheres beside DEM and measurements; made {} on {}, commit {}.{}</p>",
        escape(&stamp.date),
        escape(&stamp.cpu),
        escape(&stamp.commit),
        if report.quick { " <b>Quick version: few configurations, no DEM.</b>" } else { "" }
    );
    page += "<h2>Error against cost</h2>\n<p><code>cases/column</code>, 20 000 steel spheres that are pressed while heat flows through them, and <code>cases/store</code>, 20 000 in a \
             cylinder that is heated and cooled ten times. Errors are root mean squares over all times against DEM of the same bed \
             (<code>dem.csv</code>), which took some 1000 core-s each. Cost is processor time of one process, start and output included. Mesh and steps are not what \
             limits these cases: the law is, and the spheres' own way to settle.</p>\n";
    for quantity in [("T", "T", "% of its range"), ("pressure", "p", "%"), ("conductivity", "K", "%")] {
        page += &against_cost(made, quantity)?;
    }
    page += &runs(made);
    page += "<h2>Beds that were measured</h2>\n";
    page += &measured(made)?;
    page += &zehner(made)?;
    page += "<h2>Limits</h2>\n<ul>\n";
    for limit in LIMITS {
        let _ = writeln!(page, "<li>{}</li>", escape(limit));
    }
    Ok(numbered(&(page + "</ul>\n</body>\n</html>\n")))
}

fn style(family: &str) -> Style {
    let number = FAMILIES.iter().position(|known| *known == family).unwrap_or(0);
    Style { size: 5, ..Style::marker(number, MARKERS[number]) }
}

fn points(runs: &[SphereRun], case: &str, quantity: &str) -> Vec<Series> {
    let place = |run: &SphereRun| Some((run.core_seconds?, run.errors.get(quantity)?[0]));
    let of_case = runs.iter().filter(|run| run.case == case);
    of_case.filter_map(|run| Some(series(vec![place(run)?], style(run.family)))).collect()
}

fn keys(runs: &[SphereRun], cases: &[&str]) -> Vec<(Style, String)> {
    let used = |family: &&&str| runs.iter().any(|run| run.family == **family && cases.contains(&run.case));
    FAMILIES.iter().filter(used).map(|family| (style(family), family.to_string())).collect()
}

/// Error against cost, both axes logarithmic.
fn chart(title: &str, label: &str, lines: &[Series]) -> Result<String, ReportError> {
    let values = |of: fn(&(f64, f64)) -> f64| lines.iter().flat_map(|line| &line.points).map(of);
    let (x, y) = (decades("cost [core-s]", values(|point| point.0)), decades(label, values(|point| point.1)));
    Ok(plot(title, &x, &y, lines)?)
}

fn against_cost(made: &Made, (name, quantity, unit): (&str, &str, &str)) -> Result<String, ReportError> {
    let runs = &made.report.spheres.runs;
    let label = format!("error of {quantity} [{unit}]");
    let mut panels = Vec::new();
    for case in CASES {
        let lines = points(runs, case, quantity);
        panels.push(chart(case, &label, &lines)?);
    }
    let caption =
        format!("Fig. #. Error of the {name} against cost, one point for each run, both axes logarithmic.");
    let id = format!("spheres-{quantity}");
    let keys = keys(runs, &CASES);
    Figure { id: &id, panels, keys, caption, source: "measured and cached" }.html(&made.report.made)
}

fn runs(made: &Made) -> String {
    let heads = [
        "'case",
        "'family",
        "'configuration",
        "core-s",
        "T",
        "worst",
        "p [%]",
        "worst",
        "K [%]",
        "worst",
        "\"outcome",
    ];
    let row = |run: &SphereRun| {
        let mut cells =
            vec![run.case.to_string(), run.family.to_string(), run.name.clone(), fixed(run.core_seconds, 2)];
        for quantity in ["T", "p", "K"] {
            let error = run.errors.get(quantity);
            cells.extend((0..2).map(|k| fixed(error.map(|error| error[k]), 2)));
        }
        cells.push(match (run.outcome, run.message.as_str()) {
            ("done", message) => message.to_string(),
            (outcome, message) => format!("{outcome}: {message}"),
        });
        cells
    };
    let note = format!(
        "<p>All runs. T in % of its range, in <code>{MEASURED}</code> in K against measurements. Root mean square, and the worst difference with its sign.</p>\n"
    );
    note + &table(&heads, &made.report.spheres.runs.iter().map(row).collect::<Vec<_>>())
}

/// Beaulieu's bed: T over time, and error against cost.
fn measured(made: &Made) -> Result<String, ReportError> {
    let spheres = &made.report.spheres;
    let mut text = format!(
        "<p><code>cases/{MEASURED}</code>: steel spheres of 6.4 mm in air, heated from above (C. Beaulieu, 2020), by the solver with the first layer at the temperature of the plate."
    );
    for (plate, rms) in &spheres.elements {
        let _ = write!(text, " DEM (<code>cases/beaulieu</code>), plate {}: {rms:.2} K.", escape(plate));
    }
    if let Some(cost) = spheres.elements_core_seconds {
        let _ = write!(text, " They take {cost:.0} core-s, from pouring on.");
    }
    text += "</p>\n";
    let mut lines = Vec::new();
    let mut keys = Vec::new();
    for (colour, record) in spheres.simulated.iter().enumerate() {
        let colour = colour + 1;
        let rows = record.rows.iter().map(|(time, t)| (*time, t - ZERO_CELSIUS)).collect();
        lines.push(series(rows, Style::line(colour, Line::Solid)));
        let at = spheres.measured.iter().filter(|one| (one.distance - record.distance).abs() < 1e-6);
        let dots = at.map(|one| (one.time, one.temperature - ZERO_CELSIUS)).collect();
        let marker = Style { size: 3, hollow: true, ..Style::marker(colour, MARKERS[colour]) };
        lines.push(series(dots, marker));
        keys.push((marker, format!("measured, {:.0} mm below the plate", 1e3 * record.distance)));
    }
    keys.push((Style::line(1, Line::Solid), "solver".to_string()));
    let panel = plot("steel", &from_data("t [s]", false), &from_data("T [°C]", false), &lines)?;
    let errors = points(&spheres.runs, MEASURED, "T");
    let cost = chart("steel", "error of T [K]", &errors)?;
    keys.extend(self::keys(&spheres.runs, &[MEASURED]));
    let caption = "Fig. #. Left: temperatures over time. Right: root mean square of the difference from the 216 measurements against cost; they \
                   scatter by 0.2 K."
        .to_string();
    let figure = Figure {
        id: "spheres-steel",
        panels: vec![panel, cost],
        keys,
        caption,
        source: "measured and cached",
    };
    Ok(text + &figure.html(&made.report.made)?)
}

/// Zehner's beds: predicted against measured.
fn zehner(made: &Made) -> Result<String, ReportError> {
    let beds = &made.report.spheres.zehner;
    let mut lines = vec![series(vec![(5.0, 5.0), (50.0, 50.0)], Style::line(4, Line::Solid))];
    let mut keys = vec![(Style::line(4, Line::Solid), "as measured".to_string())];
    for (number, material) in MATERIALS.iter().enumerate() {
        let style = Style::marker(number, MARKERS[number]);
        let of = beds.iter().filter(|bed| bed.material == *material);
        lines.push(series(of.map(|bed| (bed.measured, bed.prediction)).collect(), style));
        keys.push((style, material.to_string()));
    }
    let axis = |label| Axis { label, log: true, range: Some((4.0, 100.0)) };
    let panel = plot("Zehner's beds", &axis("k/k_gas measured"), &axis("predicted"), &lines)?;
    let caption = "Fig. #. Conductivity of beds with nitrogen at 317 to 1000 K (P. Zehner, 1972) over that of the gas, predicted from boxes of spheres with a \
                   roughness of 0.34 µm; no number is fitted to them. What rules copper is its surface, of which nothing is known."
        .to_string();
    let figure = Figure {
        id: "spheres-zehner",
        panels: vec![panel],
        keys,
        caption,
        source: "committed, cases/zehner/prediction.csv",
    };
    let heads = ["'beds", "number", "prediction, rms [%]", "correlation, rms [%]"];
    let rms = |beds: &[&ZehnerBed], of: fn(&ZehnerBed) -> f64| {
        let squares = beds.iter().map(|bed| (of(bed) / bed.measured - 1.0).powi(2)).sum::<f64>();
        fixed(Some(100.0 * (squares / beds.len() as f64).sqrt()), 1)
    };
    let row = |material: &&str| {
        let beds: Vec<&ZehnerBed> = beds.iter().filter(|bed| bed.material == *material).collect();
        let errors = [rms(&beds, |bed| bed.prediction), rms(&beds, |bed| bed.correlation)];
        [vec![material.to_string(), beds.len().to_string()], errors.to_vec()].concat()
    };
    let text = "<p>The correlation is that of Zehner, Bauer and Schlünder, without contacts. The book's page on measured beds leaves one series of steel out and has the table by temperature.</p>\n";
    Ok(figure.html(&made.report.made)?
        + text
        + &table(&heads, &MATERIALS.iter().map(row).collect::<Vec<_>>()))
}
