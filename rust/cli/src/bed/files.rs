//! The files that `msdd bed run` writes.

use super::results::Results;
use super::{plot, table};
use crate::error::CliError;
use msdd_beds::bed::PlateKind;
use msdd_files::{Column, names};
use serde_json::{Value, json};
use std::fmt::Write;

/// Names of the files, in the order of [`texts`].
pub const NAMES: [&str; 5] =
    ["temperature.csv", "comparison.csv", "bed.json", "grains.vtp", "temperature.svg"];
/// Columns of `temperature.csv` and of `comparison.csv`.
const TEMPERATURE: [Column; 4] = [
    (
        "plate",
        "-",
        "`held`: all grains with their centre within a diameter of the plate have its temperature, the most that a plate can do; `resisting`: heat passes through contacts and gas between plate and grains",
    ),
    ("distance", "m", "from the plate"),
    ("time", "s", "time"),
    ("T", "K", "temperature"),
];
const COMPARISON: [Column; 8] = [
    ("plate", "-", "as in `temperature.csv`"),
    ("key", "-", "what was changed by `vary`; empty: nothing"),
    ("value", "-", "its value"),
    ("distance", "m", "from the plate, or `all`"),
    ("points", "-", "number of measurements within the time of the run"),
    ("rms", "K", "root mean square of simulated less measured temperature; empty without points"),
    ("worst", "K", "largest difference"),
    ("bias", "K", "mean difference"),
];

/// Entries of `bed.json`.
const SUMMARY: [Column; 9] = [
    ("grains", "-", "number of grains"),
    ("seed", "-", "seed of the packing"),
    (
        "stages",
        "s for `time`, else -",
        "for each stage `name`, `at_rest`, simulated `time`, `steps`, and `agitation`: the kinetic energy at its end over the energy of falling by a radius",
    ),
    (
        "slabs",
        "m; -; -; Pa; W/(m K)",
        "averages over a part of the bed, `from` to `to` from the plate: `porosity`; `coordination`, contacts per grain; `pressure`, a third of the trace of the stress; `conductivity_contacts` and `conductivity_gas` across it at the initial temperature",
    ),
    ("plate_pressure", "Pa", "force of the grains across the plate over the area of the bed"),
    ("walls", "N", "for each wall its `name` and the `force` of the grains on it, friction included"),
    (
        "peak_stress",
        "Pa; Pa; -; -",
        "`largest` of Hertz's peak stresses, `yield_stress`, number of contacts `beyond` 1.6 times that, number of `contacts`; `null` without a yield stress",
    ),
    (
        "heat",
        "J; J; -",
        "for each way to take the `plate`: heat `stored` in the grains, `balance_residual` between that and what the plate gave, `steps`",
    ),
    ("warnings", "-", "what is printed as a note"),
];

pub fn texts(results: &Results) -> Result<[String; 5], CliError> {
    Ok([
        temperature(results),
        comparison(results),
        summary(results),
        grains(results),
        plot::temperature(results)?,
    ])
}

fn temperature(results: &Results) -> String {
    let mut text = names(&TEMPERATURE).join(",") + "\n";
    for run in &results.compared {
        for record in &run.heated.records {
            for (time, t) in &record.rows {
                let _ = writeln!(text, "{},{},{time},{t:.6}", run.heated.kind, record.distance);
            }
        }
    }
    text
}

pub fn comparison(results: &Results) -> String {
    let mut text = names(&COMPARISON).join(",") + "\n";
    if results.measured.is_empty() {
        return text;
    }
    let mut line = |kind: PlateKind, key: &str, value: &str, misfit: &msdd_beds::experiment::Misfit| {
        let place = misfit.distance.map_or("all".to_string(), |d| d.to_string());
        let (rms, worst, bias) = (misfit.rms, misfit.worst, misfit.bias);
        let value = value.replace(',', ";");
        let cell = |x: f64| if x.is_finite() { format!("{x:.4}") } else { String::new() };
        let numbers = [rms, worst, bias].map(cell).join(",");
        let _ = writeln!(text, "{kind},{key},{value},{place},{},{numbers}", misfit.points);
    };
    for run in &results.compared {
        run.misfits.iter().for_each(|misfit| line(run.heated.kind, "", "", misfit));
    }
    for varied in &results.varied {
        line(varied.kind, &varied.key, &varied.value, &varied.misfit);
    }
    text
}

fn summary(results: &Results) -> String {
    let (bed, case) = (&results.bed, &results.case);
    let stages: Vec<Value> = (bed.stages.iter())
        .map(|(name, rest)| {
            json!({"name": name, "at_rest": rest.at_rest, "agitation": rest.kinetic, "time": rest.time, "steps": rest.steps})
        })
        .collect();
    let slabs: Vec<Value> = (results.slabs.iter())
        .map(|(between, slab)| {
            json!({
                "from": between[0], "to": between[1],
                "porosity": 1.0 - slab.solid_fraction, "coordination": slab.coordination, "pressure": slab.pressure,
                "conductivity_contacts": slab.contact_conductivity, "conductivity_gas": slab.gas_conductivity,
                "conductivity_radiation": slab.radiation_conductivity,
            })
        })
        .collect();
    let heat: Vec<Value> = (results.compared.iter())
        .map(|run| {
            let heated = &run.heated;
            json!({
                "plate": heated.kind, "stored": heated.stored, "balance_residual": heated.residual,
                "steps": heated.steps,
            })
        })
        .collect();
    let stress = case.grains.peak_stress(&bed.simulation).map(|stress| {
        json!({
            "largest": stress.largest, "yield_stress": stress.yield_stress, "beyond": stress.beyond,
            "contacts": stress.contacts,
        })
    });
    let walls: Vec<Value> = (case.wall_names().iter().zip(&bed.simulation.wall_force))
        .map(|(name, force)| json!({"name": name, "force": force}))
        .collect();
    let values = [
        json!(bed.simulation.spheres.len()),
        json!(case.seed),
        json!(stages),
        json!(slabs),
        json!(bed.plate_force() / bed.area(case)),
        json!(walls),
        json!(stress),
        json!(heat),
        json!(table::warnings(results)),
    ];
    let value: Value = names(&SUMMARY).map(str::to_string).into_iter().zip(values).collect();
    format!("{value:#}\n")
}

fn grains(results: &Results) -> String {
    let further: Vec<(String, &[f64])> = (results.compared.iter())
        .map(|run| (format!("T_{}", run.heated.kind), run.heated.temperatures.as_slice()))
        .collect();
    msdd_beds::vtk::grains(&results.bed.simulation, &further)
}
