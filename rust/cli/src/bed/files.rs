//! The files that `msdd bed run` writes.

use super::results::Results;
use super::{plot, table};
use crate::error::CliError;
use serde_json::{Value, json};
use std::fmt::Write;

/// Names of the files, in the order of [`texts`].
pub const NAMES: [&str; 5] =
    ["temperature.csv", "comparison.csv", "bed.json", "grains.vtp", "temperature.svg"];
/// Columns of `temperature.csv` and of `comparison.csv`.
const TEMPERATURE: [&str; 4] = ["plate", "distance", "time", "T"];
const COMPARISON: [&str; 8] = ["plate", "key", "value", "distance", "points", "rms", "worst", "bias"];

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
    let mut text = TEMPERATURE.join(",") + "\n";
    for run in &results.compared {
        for record in &run.heated.records {
            for (time, t) in &record.rows {
                let _ = writeln!(text, "{},{},{time},{t:.6}", run.heated.kind.as_str(), record.distance);
            }
        }
    }
    text
}

pub fn comparison(results: &Results) -> String {
    let mut text = COMPARISON.join(",") + "\n";
    if results.measured.is_empty() {
        return text;
    }
    let mut line = |kind: &str, key: &str, value: &str, misfit: &msdd_beds::experiment::Misfit| {
        let place = misfit.distance.map_or("all".to_string(), |d| d.to_string());
        let (rms, worst, bias) = (misfit.rms, misfit.worst, misfit.bias);
        let value = value.replace(',', ";");
        let cell = |x: f64| if x.is_finite() { format!("{x:.4}") } else { String::new() };
        let numbers = [rms, worst, bias].map(cell).join(",");
        let _ = writeln!(text, "{kind},{key},{value},{place},{},{numbers}", misfit.points);
    };
    for run in &results.compared {
        run.misfits.iter().for_each(|misfit| line(run.heated.kind.as_str(), "", "", misfit));
    }
    for varied in &results.varied {
        line(varied.kind.as_str(), &varied.key, &varied.value, &varied.misfit);
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
            })
        })
        .collect();
    let heat: Vec<Value> = (results.compared.iter())
        .map(|run| {
            let heated = &run.heated;
            json!({
                "plate": heated.kind.as_str(), "stored": heated.stored, "balance_residual": heated.residual,
                "steps": heated.steps,
            })
        })
        .collect();
    let stress = bed.peak_stress(case).map(|stress| {
        json!({
            "largest": stress.largest, "yield_stress": stress.yield_stress, "beyond": stress.beyond,
            "contacts": stress.contacts,
        })
    });
    let walls: Vec<Value> = (case.wall_names().iter().zip(&bed.simulation.wall_force))
        .map(|(name, force)| json!({"name": name, "force": force}))
        .collect();
    let value = json!({
        "grains": bed.simulation.spheres.len(),
        "seed": case.seed,
        "stages": stages,
        "slabs": slabs,
        "plate_pressure": bed.plate_force() / bed.area(case),
        "walls": walls,
        "peak_stress": stress,
        "heat": heat,
        "warnings": table::warnings(results),
    });
    format!("{value:#}\n")
}

fn grains(results: &Results) -> String {
    let further: Vec<(String, &[f64])> = (results.compared.iter())
        .map(|run| (format!("T_{}", run.heated.kind.as_str()), run.heated.temperatures.as_slice()))
        .collect();
    msdd_beds::vtk::grains(&results.bed.simulation, &further)
}
