//! Maps of sub-regions, at the start and at the end.

use super::curves::configurations;
use super::names::case_name;
use crate::plan::FAMILIES;
use crate::report::Made;
use msdd_dem_reference::compare::{reference_start, reference_sub_regions, sub_regions};
use msdd_dem_reference::series::{largest, root_mean_square, spread, statistics};
use msdd_dem_reference::solver::Run;
use msdd_draw::{Cells, Map, Sheet, maps};
use serde_json::{Value, json};

/// Quantity, label, factor, digits.
const MAPPED: [(&str, &str, f64, usize); 6] = [
    ("porosity", "porosity [%]", 100.0, 1),
    ("fabric_index", "fabric index [-]", 1.0, 3),
    ("conductivity_xx", "K_xx [W/(m K)]", 1.0, 1),
    ("conductivity_yy", "K_yy [W/(m K)]", 1.0, 1),
    ("stress_xx", "σ_xx [kPa]", 1e-3, 2),
    ("stress_yy", "σ_yy [kPa]", 1e-3, 2),
];

pub fn all(made: &Made) -> Value {
    let (start, start_differences) = start(made);
    let (displacement, displacement_differences) = displacement(made).unwrap_or_default();
    json!({
        "start": start, "start_differences": start_differences, "end": end(made),
        "displacement": displacement, "displacement_differences": displacement_differences,
    })
}

fn of_runs(runs: &[Run], quantity: &str) -> Vec<Vec<f64>> {
    runs.iter().map(|run| sub_regions(run, quantity)).collect()
}

/// The initial state of the runs: the averages over windows, and the conductivity and stress of the models for them. With the
/// differences in words.
fn start(made: &Made) -> (Vec<String>, String) {
    let Some(reference) = made.references.iter().find(|r| r.case == "H") else { return Default::default() };
    let first = configurations(made).first().and_then(|name| made.details.start.get(name));
    let panel = |(quantity, label, scale, digits): (&str, &str, f64, usize)| {
        let mut named = vec![("DEM", averaged(&reference_start(reference, quantity, false), scale))];
        named.extend(first.map(|runs| ("solver", averaged(&of_runs(runs, quantity), scale))));
        in_sub_regions(&format!("start: {label}"), digits, &named)
    };
    let mut said = Vec::new();
    for (name, runs) in &made.details.start {
        let affine =
            made.report.validation.iter().any(|v| &v.configuration == name && v.family == FAMILIES[2]);
        let of = |(quantity, label, scale, digits): (&str, &str, f64, usize)| {
            let (solver, dem) = (of_runs(runs, quantity), reference_start(reference, quantity, affine));
            let (own, discs) = (spread(&solver), spread(&dem));
            let pairs = solver.iter().flatten().zip(dem.iter().flatten());
            let rms = root_mean_square(&pairs.map(|(s, d)| s - d).collect::<Vec<_>>());
            let pair = |(mean, deviation): (f64, f64)| {
                format!("{:.digits$} ± {:.digits$}", scale * mean, scale * deviation)
            };
            let quantity = label.split(" [").next().unwrap_or(label);
            format!("{quantity} {} ({}), rms {:.1} %", pair(own), pair(discs), 100.0 * rms / discs.0.abs())
        };
        let shown: Vec<String> = MAPPED.into_iter().filter(|q| q.0 != "fabric_index").map(of).collect();
        said.push(format!("{name}: {}", shown.join("; ")));
    }
    (MAPPED.map(panel).to_vec(), said.join(". "))
}

/// Maps of 10 x 3 sub-regions, one below the other with the same colours, each value written into its sub-region.
fn in_sub_regions(title: &str, digits: usize, named: &[(&str, Vec<f64>)]) -> String {
    let points = (0..44).map(|k| [f64::from(k % 11) * 0.215, f64::from(k / 11) * 0.215]).collect();
    // From the lower left, x index fastest
    let cell = |k: usize| [0, 1, 12, 11].map(|corner| k % 10 + k / 10 * 11 + corner).to_vec();
    let cells = Cells::Polygons { points, cells: (0..30).map(cell).collect() };
    let list: Vec<Map> = named.iter().map(|(name, values)| Map { name, cells: &cells, values }).collect();
    maps(&Sheet { title, written: Some(digits), ..Sheet::default() }, &list)
}

/// Mean over the packings of values in sub-regions.
fn averaged(by_packing: &[Vec<f64>], scale: f64) -> Vec<f64> {
    statistics(by_packing).into_iter().map(|(mean, _)| scale * mean).collect()
}

fn end(made: &Made) -> Vec<String> {
    let mut panels = Vec::new();
    // The paper's network has the affine conductivity, which is larger, so it is left out of these maps.
    let names: Vec<String> = configurations(made).into_iter().take(2).collect();
    for reference in made.references.iter().filter(|r| !r.case.ends_with("star")) {
        for (quantity, label, scale, digits) in MAPPED {
            let mut named =
                vec![("DEM", averaged(&reference_sub_regions(reference, quantity, false), scale))];
            named.extend(names.iter().filter_map(|name| {
                let runs = made.runs.get(&(reference.case.clone(), name.clone()))?;
                Some((name.as_str(), averaged(&of_runs(runs, quantity), scale)))
            }));
            panels.push(in_sub_regions(
                &format!("case {}: {label}", case_name(&reference.case)),
                digits,
                &named,
            ));
        }
    }
    panels
}

/// Displacement along x at the end of HC, with the differences in words.
fn displacement(made: &Made) -> Option<(Vec<String>, String)> {
    let moving = made.report.validation.iter().find(|v| v.case == "HC" && v.family == FAMILIES[1])?;
    let dem = made.references.iter().find(|r| r.case == "HC")?.displacement();
    let runs = made.details.watched.get(&("HC".to_string(), moving.configuration.clone()))?;
    let solver: Vec<Vec<f64>> =
        runs.iter().filter_map(|run| Some(run.moved.as_ref()?.iter().map(|u| u[0]).collect())).collect();
    if dem.is_empty() || solver.is_empty() {
        return None;
    }
    let (discs, cells) = (averaged(&dem, 1e3), averaged(&solver, 1e3));
    let differences: Vec<f64> = cells.iter().zip(&discs).map(|(s, d)| s - d).collect();
    let scatter: Vec<f64> = statistics(&dem).iter().map(|(_, deviation)| 1e3 * deviation).collect();
    let said = format!(
        "Largest {:.1} mm (DEM {:.1}); difference {:.1} mm rms, {:+.1} mm where it is largest; scatter of the packings {:.1} mm rms.",
        largest(&cells),
        largest(&discs),
        root_mean_square(&differences),
        largest(&differences),
        root_mean_square(&scatter)
    );
    let named = [("DEM", discs), ("solver, equilibrium", cells), ("solver minus DEM", differences)];
    let panels = vec![
        in_sub_regions("case HC: u_x [mm]", 1, &named[..2]),
        in_sub_regions("case HC: difference of u_x [mm]", 1, &named[2..]),
    ];
    Some((panels, said))
}
