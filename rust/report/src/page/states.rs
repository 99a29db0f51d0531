//! States at which the solver evaluates the model, compared with the database, and the grains around P2.

use super::names::case_name;
use crate::plan::{CHARTED, FAMILIES};
use crate::report::Made;
use crate::studies::detail::REGIONS;
use crate::studies::known::KnownStates;
use msdd_dem_reference::results::Table;
use msdd_dem_reference::solver::{COLUMNS, Run};
use msdd_draw::{Cells, Map, Sheet, maps};
use serde_json::{Value, json};

pub fn all(made: &Made) -> Value {
    let (queries, inside) = queries(made).unwrap_or_default();
    let (grains, porosities) = around_the_middle(made);
    json!({
        "queries": queries, "inside": inside, "known": made.known.states, "grains": grains, "porosities": porosities,
    })
}

/// State of a sub-region: porosity, fabric index, p ℓ/(E r̄), strain since the start [-].
type State = [f64; 4];
/// Sub-regions drawn in colour, those of P1, P2 and P3, and their style.
const PROBED: [(usize, &str); 3] =
    [(11, "1 solid | sub-region of P1"), (14, "2 dashed | of P2"), (18, "3 dotted | of P3")];

fn column(name: &str) -> usize {
    COLUMNS.iter().position(|c| *c == name).unwrap_or(0)
}

/// States over time of the 30 sub-regions of a run, from the start on.
fn histories(made: &Made, run: &Run, start: &Run) -> Vec<Vec<State>> {
    let [modulus, radius, expansion] = made.details.grains;
    let state = |row: &[f64], first: f64| {
        let strain = expansion * (row[column("T")] - first);
        let reduced = row[column("pressure")] / (modulus * radius * (1.0 + strain));
        [row[column("porosity")], row[column("fabric_index")], reduced, strain]
    };
    let mean =
        made.references.first().and_then(|r| r.results.first()?.series.column("T_mean")?.first().copied());
    let first = mean.unwrap_or(f64::NAN);
    let mut histories: Vec<Vec<State>> = start
        .sub_regions
        .iter()
        // The strain is set to zero: the run for the initial state has one step, whose small heating must not count.
        .map(|row| {
            let mut row = row.clone();
            row[column("T")] = first;
            vec![state(&row, first)]
        })
        .collect();
    for row in run.watched.get(REGIONS).into_iter().flatten().filter(|row| row.len() == 3 + COLUMNS.len()) {
        let k = row[1] as usize + 10 * row[2] as usize;
        if let Some(history) = histories.get_mut(k) {
            history.push(state(&row[3..], first));
        }
    }
    histories
}

/// The states in three planes for each case, and the shares of those inside of the hulls in words.
fn queries(made: &Made) -> Option<(String, String)> {
    let planes = [
        ("fabric index [-]", 1, &made.known.porosity_fabric),
        ("pressure over E r̄/ℓ [-]", 2, &made.known.porosity_pressure),
        ("thermal strain [-]", 3, &made.known.porosity_strain),
    ];
    let named = |family: &str| {
        made.report.validation.iter().find(|v| v.family == family).map(|v| v.configuration.clone())
    };
    let (moving, staying) = (named(FAMILIES[1])?, named(FAMILIES[0])?);
    let start = made.details.start.get(&staying)?.first()?;
    let (mut text, mut said) = (String::new(), Vec::new());
    for case in CHARTED {
        let run = made.details.watched.get(&(case.to_string(), moving.clone())).and_then(|runs| runs.first());
        let Some(run) = run else { continue };
        let histories = histories(made, run, start);
        let mut shares = Vec::new();
        for (label, k, hull) in planes {
            let title = label.split(" [").next().unwrap_or(label);
            text.push_str(&format!("panel case {}: {title}\ny {label}\n", case_name(case)));
            let mut line = |look: &str, points: &mut dyn Iterator<Item = [f64; 2]>| {
                text.push_str(&format!("series {look}\n"));
                points.for_each(|[x, y]| text.push_str(&format!("{x} {y}\n")));
            };
            line("0 solid | hull of the database", &mut hull.iter().chain(hull.first()).copied());
            for history in &histories {
                line("4 solid | other sub-regions", &mut history.iter().map(|s| [s[0], s[k]]));
            }
            for (region, look) in PROBED {
                line(look, &mut histories.get(region).into_iter().flatten().map(|s| [s[0], s[k]]));
            }
            let all: Vec<[f64; 2]> = histories.iter().flatten().map(|s| [s[0], s[k]]).collect();
            let inside = all.iter().filter(|point| KnownStates::holds(hull, **point)).count();
            shares.push(format!("{:.0}", 100.0 * inside as f64 / all.len().max(1) as f64));
        }
        let clamped = 100.0 * run.clamped_queries as f64 / run.cell_queries.max(1) as f64;
        said.push(format!("{}: {} %, {clamped:.1} %", case_name(case), shares.join(", ")));
    }
    Some((text, said.join("; ")))
}

/// A grain: centre and radius \[m\], and its largest overlap over its radius [%].
struct Grain {
    at: [f64; 2],
    radius: f64,
    value: f64,
}

/// Grains of a table, with the largest overlap of each over its radius [%].
fn with_overlaps(table: &Table) -> Vec<Grain> {
    let all = |name: &str| table.column(name).unwrap_or_default();
    let (x, y, r) = (all("x"), all("y"), all("r"));
    let overlap = |i: usize| {
        let with = |j: usize| if i == j { 0.0 } else { r[i] + r[j] - (x[i] - x[j]).hypot(y[i] - y[j]) };
        (0..x.len()).map(with).fold(0.0, f64::max)
    };
    let grain = |i: usize| Grain { at: [x[i], y[i]], radius: r[i], value: 100.0 * overlap(i) / r[i] };
    (0..x.len()).map(grain).collect()
}

/// Share of the window that no grain covers, from the lengths of many parallel lines outside of grains.
fn porosity([low, high]: [[f64; 2]; 2], list: &[Grain]) -> f64 {
    const LINES: usize = 2000;
    let mut covered = 0.0;
    for line in 0..LINES {
        let y = low[1] + (high[1] - low[1]) * (line as f64 + 0.5) / LINES as f64;
        let mut spans: Vec<[f64; 2]> = list
            .iter()
            .filter(|g| (g.at[1] - y).abs() < g.radius)
            .map(|g| {
                let half = (g.radius * g.radius - (g.at[1] - y).powi(2)).sqrt();
                [(g.at[0] - half).max(low[0]), (g.at[0] + half).min(high[0])]
            })
            .collect();
        spans.sort_by(|a, b| a[0].total_cmp(&b[0]));
        let mut end = low[0];
        for [from, to] in spans {
            covered += (to - from.max(end)).max(0.0);
            end = end.max(to);
        }
    }
    1.0 - covered / LINES as f64 / (high[0] - low[0])
}

/// Maps of the grains, and the porosity of their window in words.
fn around_the_middle(made: &Made) -> (Vec<String>, String) {
    let mut shown = Vec::new();
    for case in CHARTED {
        let result = made.references.iter().find(|r| r.case == case).and_then(|r| r.results.first());
        let Some(found) = result.and_then(|r| r.grains.as_ref()) else { continue };
        if shown.is_empty() {
            shown.push(("start".to_string(), found.window, with_overlaps(&found.start)));
        }
        shown.push((format!("case {}, end", case_name(case)), found.window, with_overlaps(&found.end)));
    }
    let most = shown.iter().flat_map(|s| &s.2).map(|g| g.value).fold(0.0, f64::max).ceil();
    let (mut panels, mut said) = (Vec::new(), Vec::new());
    for (name, window, list) in &shown {
        let inside = 100.0 * porosity(*window, list);
        let title = format!("{name}: porosity {inside:.1} %");
        let sheet = Sheet {
            title: &title,
            label: "largest overlap / radius [%]",
            window: Some(*window),
            range: Some((0.0, most)),
            ..Sheet::default()
        };
        let cells = Cells::Circles(list.iter().map(|grain| (grain.at, grain.radius)).collect());
        let values: Vec<f64> = list.iter().map(|grain| grain.value).collect();
        panels.push(maps(&sheet, &[Map { name: "", cells: &cells, values: &values }]));
        said.push(format!("{name} {inside:.1} %"));
    }
    (panels, said.join("; "))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn overlaps_count_once() {
        let grain = |x: f64| Grain { at: [x, 0.5], radius: 0.1, value: 0.0 };
        let window = [[0.0; 2], [1.0; 2]];
        let one = std::f64::consts::PI * 0.01;
        assert!((porosity(window, &[grain(0.5)]) - (1.0 - one)).abs() < 1e-5);
        assert!((porosity(window, &[grain(0.5), grain(0.5)]) - (1.0 - one)).abs() < 1e-5);
        assert!((porosity(window, &[grain(0.0), grain(0.8)]) - (1.0 - 1.5 * one)).abs() < 1e-5);
    }

    #[test]
    fn the_largest_overlap_of_each() {
        let mut table = Table::new(["x", "y", "r"].map(str::to_string).to_vec());
        for x in [0.0, 0.9, 1.7] {
            table.push(vec![x, 0.0, 0.5]);
        }
        let found: Vec<f64> = with_overlaps(&table).iter().map(|g| g.value.round()).collect();
        assert_eq!(found, [20.0, 40.0, 40.0]);
    }
}
