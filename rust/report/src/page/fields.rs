//! Section of the page with fields in sub-regions and along x, at the start and at the end.

use super::curves::{configurations, curves, keys};
use super::html::{Figure, case_name};
use crate::ReportError;
use crate::plan::FAMILIES;
use crate::report::Made;
use msdd_draw::{Axis, Cells, Map, Marker, Series, Sheet, Style, maps, plot};
use msdd_reference::compare::{reference_start, reference_sub_regions, sub_regions};
use msdd_reference::series::statistics;
use msdd_reference::series::{largest, root_mean_square, spread};
use msdd_reference::solver::{COLUMNS, Run};

const SOURCE: &str = "DEM committed; solver measured and cached";

pub fn section(made: &Made) -> Result<String, ReportError> {
    Ok(start_maps(made)? + &end_maps(made)? + &profiles(made)? + &displacement_map(made)?)
}

/// The initial state of the runs: the averages over windows, and the conductivity and stress of the models for them.
fn start_maps(made: &Made) -> Result<String, ReportError> {
    let Some(reference) = made.references.iter().find(|r| r.case == "H") else { return Ok(String::new()) };
    let names = configurations(made);
    let values = |runs: &[Run], quantity: &str| -> Vec<Vec<f64>> {
        runs.iter().map(|run| sub_regions(run, quantity)).collect()
    };
    let mut panels = Vec::new();
    for (quantity, label, scale, digits) in MAPPED {
        let dem = reference_start(reference, quantity, false);
        let mut named = vec![("DEM", averaged(&dem, scale))];
        if let Some(runs) = names.first().and_then(|name| made.details.start.get(name)) {
            named.push(("solver", averaged(&values(runs, quantity), scale)));
        }
        panels.push(in_sub_regions(&format!("start: {label}"), digits, &named));
    }
    let mut said = Vec::new();
    for (name, runs) in &made.details.start {
        let affine =
            made.report.validation.iter().any(|v| &v.configuration == name && v.family == FAMILIES[2]);
        let of = |(quantity, label, scale, digits): (&str, &str, f64, usize)| {
            let (solver, dem) = (values(runs, quantity), reference_start(reference, quantity, affine));
            let ((mean, deviation), (by_discs, of_discs)) = (spread(&solver), spread(&dem));
            let pairs = solver.iter().flatten().zip(dem.iter().flatten());
            let rms = root_mean_square(&pairs.map(|(s, d)| s - d).collect::<Vec<_>>());
            let quantity = label.split(" [").next().unwrap_or(label);
            format!(
                "{quantity} {:.digits$} ± {:.digits$} ({:.digits$} ± {:.digits$}), rms {:.1} %",
                scale * mean,
                scale * deviation,
                scale * by_discs,
                scale * of_discs,
                100.0 * rms / by_discs.abs()
            )
        };
        let shown: Vec<String> = MAPPED.into_iter().filter(|q| q.0 != "fabric_index").map(of).collect();
        said.push(format!("{name}: {}", shown.join("; ")));
    }
    let caption = format!(
        "Fig. #. The start, means over 10 × 3 sub-regions and over the packings (paper, Figs. 8 to 10). Porosity, fabric index and stress of the solver's cells \
         are averages over windows of 215 mm of the discs, which smooth them and leave out the layers at the walls; conductivity is that of the model for this state, and with the paper's \
         network so is the stress. Mean ± deviation over the sub-regions (DEM), rms of the difference over the mean: {}. The paper's network has the \
         affine conductivity, and is compared with that.",
        said.join(". ")
    );
    Figure { id: "start", panels, keys: Vec::new(), caption, source: SOURCE }.html(&made.report.made)
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

/// Quantity, label, factor, digits.
const MAPPED: [(&str, &str, f64, usize); 6] = [
    ("porosity", "porosity [%]", 100.0, 1),
    ("fabric_index", "fabric index [-]", 1.0, 3),
    ("conductivity_xx", "K_xx [W/(m K)]", 1.0, 1),
    ("conductivity_yy", "K_yy [W/(m K)]", 1.0, 1),
    ("stress_xx", "σ_xx [kPa]", 1e-3, 2),
    ("stress_yy", "σ_yy [kPa]", 1e-3, 2),
];

fn end_maps(made: &Made) -> Result<String, ReportError> {
    let mut panels = Vec::new();
    for reference in made.references.iter().filter(|r| !r.case.ends_with("star")) {
        for (quantity, label, scale, digits) in MAPPED {
            let dem = reference_sub_regions(reference, quantity, false);
            let mut named = vec![("DEM", averaged(&dem, scale))];
            let names = configurations(made);
            // The paper's network has the affine conductivity, which is larger, so it is left out of these maps.
            for name in names.iter().take(2) {
                if let Some(runs) = made.runs.get(&(reference.case.clone(), name.clone())) {
                    let values: Vec<Vec<f64>> = runs.iter().map(|run| sub_regions(run, quantity)).collect();
                    named.push((name.as_str(), averaged(&values, scale)));
                }
            }
            panels.push(in_sub_regions(
                &format!("case {}: {label}", case_name(&reference.case)),
                digits,
                &named,
            ));
        }
    }
    let caption = "Fig. #. Means over 10 × 3 sub-regions at the end, and over the packings (paper, Figs. 14, 16, 19): lighter means \
                   higher, and the maps of a panel have the same scale. K of DEM is that of the resistor network solved."
        .to_string();
    Figure { id: "maps", panels, keys: Vec::new(), caption, source: SOURCE }.html(&made.report.made)
}

fn profiles(made: &Made) -> Result<String, ReportError> {
    let Some(reference) = made.references.iter().find(|r| r.case == "HC") else { return Ok(String::new()) };
    let x = |k: usize| (k as f64 + 0.5) * 0.215;
    let along = Axis { label: "x [m]", log: false, range: Some((0.0, 2.15)) };
    let column = COLUMNS.iter().position(|c| *c == "stress_xx").unwrap_or(0);
    let stress =
        |run: &Run| run.columns.iter().enumerate().map(|(k, row)| (x(k), 1e-3 * row[column])).collect();
    let moved = |run: &Run| -> Vec<(f64, f64)> {
        run.displacement.iter().flatten().enumerate().map(|(k, u)| (x(k), 1e3 * u)).collect()
    };
    let dem = |name: &str, scale: f64| {
        let (points, bars) = statistics(&reference.slices(name))
            .into_iter()
            .enumerate()
            .map(|(k, (mean, deviation))| ((x(k), scale * mean), scale * deviation))
            .unzip();
        Series { points, bars, style: Style { size: 3, ..Style::marker(0, Marker::Circle) } }
    };
    let mut stresses = curves(made, "HC", stress);
    stresses.push(dem("stress_xx", 1e-3));
    let mut displacements = curves(made, "HC", moved);
    displacements.push(dem("displacement_x", 1e3));
    let axis = |label| Axis { label, log: false, range: None };
    let panels = vec![
        plot("case HC, stress along x", &along, &axis("σ_xx [kPa]"), &stresses)?,
        plot("case HC, displacement along x", &along, &axis("u_x [mm]"), &displacements)?,
    ];
    let caption = "Fig. #. Case HC at the end, ten slices along x (paper, Fig. 15): when grains stay, each slice keeps the stress of its own strain; \
                   when grains move, σ_xx becomes even along x, except for the friction of the long walls."
        .to_string();
    Figure { id: "profiles", panels, keys: keys(made), caption, source: SOURCE }.html(&made.report.made)
}

/// Displacement along x at the end of HC.
fn displacement_map(made: &Made) -> Result<String, ReportError> {
    let moving = made.report.validation.iter().find(|v| v.case == "HC" && v.family == FAMILIES[1]);
    let (Some(reference), Some(moving)) = (made.references.iter().find(|r| r.case == "HC"), moving) else {
        return Ok(String::new());
    };
    let dem = reference.displacement();
    let key = ("HC".to_string(), moving.configuration.clone());
    let runs = made.details.watched.get(&key).map_or(&[][..], Vec::as_slice);
    let solver: Vec<Vec<f64>> =
        runs.iter().filter_map(|run| Some(run.moved.as_ref()?.iter().map(|u| u[0]).collect())).collect();
    if dem.is_empty() || solver.is_empty() {
        return Ok(String::new());
    }
    let (discs, cells) = (averaged(&dem, 1e3), averaged(&solver, 1e3));
    let differences: Vec<f64> = cells.iter().zip(&discs).map(|(s, d)| s - d).collect();
    let scatter: Vec<f64> = statistics(&dem).iter().map(|(_, deviation)| 1e3 * deviation).collect();
    let caption = format!(
        "Fig. #. Case HC at the end: displacement along x of the grains that started in each of 10 × 3 sub-regions, means over the packings (paper, Fig. 15). Largest \
         {:.1} mm (DEM {:.1}); difference {:.1} mm rms, {:+.1} mm where it is largest; scatter of the packings {:.1} mm rms.",
        largest(&cells),
        largest(&discs),
        root_mean_square(&differences),
        largest(&differences),
        root_mean_square(&scatter)
    );
    let named = [("DEM", discs), ("solver, grains move", cells), ("solver minus DEM", differences)];
    let panels = vec![
        in_sub_regions("case HC: u_x [mm]", 1, &named[..2]),
        in_sub_regions("case HC: difference of u_x [mm]", 1, &named[2..]),
    ];
    Figure { id: "displacement", panels, keys: Vec::new(), caption, source: SOURCE }.html(&made.report.made)
}
