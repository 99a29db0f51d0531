//! Speed of engine, surrogate and solver: what the example `bench` and `scripts/bench-solver` measured.

use crate::error::DocsError;
use crate::gather::json::{INPUTS, Json};
use crate::gather::print::{decimals, grouped, two};
use crate::results::Section;
use std::path::Path;

/// File of `bench dem`, key, words.
const ENGINE: [(&str, &str, &str); 4] = [
    ("dem_best.json", "engine", "widest vectors of the machine"),
    ("dem_avx2.json", "engine_avx2", "AVX2"),
    ("dem_scalar.json", "engine_scalar", "without vectors"),
    ("dem_heat.json", "engine_heat", "widest vectors, heat on"),
];

/// # Errors
/// Files that are missing or lack an entry.
pub fn section(root: &Path) -> Result<Section, DocsError> {
    let mut section = Section::default();
    engine(&mut section, root)?;
    inference(&mut section, root)?;
    Ok(section)
}

fn engine(section: &mut Section, root: &Path) -> Result<(), DocsError> {
    let mut rows = Vec::new();
    for (file, key, words) in ENGINE {
        let bench = Json::read(root, &format!("{INPUTS}/{file}"))?;
        let best = bench.number("/ns_per_particle_step_best")?;
        let meaning = format!("time of a disc and step, {words}, one thread, fastest block of 500 steps");
        section.number(key, two(best), "ns", &meaning, "bench dem");
        let discs = grouped(bench.number("/particles")?);
        rows.push(vec![words.to_string(), bench.text("/simd")?, discs, two(best), two(1e3 / best)]);
    }
    let columns = ["", "instructions", "discs", "ns a disc and step", "million disc-steps a second"];
    let meaning = "speed of the engine on one thread: dense discs that expand, fastest block of 500 steps";
    section.add_table("speed-engine", meaning, "bench dem", &columns, rows);
    Ok(())
}

fn inference(section: &mut Section, root: &Path) -> Result<(), DocsError> {
    let bench = Json::read(root, &format!("{INPUTS}/inference.json"))?;
    let models = bench.at("/models")?;
    let mut rows = Vec::new();
    let names: Vec<String> =
        models.value.as_object().map(|map| map.keys().cloned().collect()).unwrap_or_default();
    for name in names {
        let (mut row, mut with_tangent) = (vec![name.clone()], vec![format!("{name}, with the tangent")]);
        for batch in models.list(&format!("/{name}/batches"))? {
            let (cells, time) = (batch.number("/batch")?, two(batch.number("/ns_per_query")?));
            let meaning = format!("time of a query of model {name} in batches of {cells}");
            section.number(&format!("query.{name}.{cells}"), time.clone(), "ns", &meaning, "bench inference");
            row.push(time);
            // The paper's network has none.
            if let Ok(time) = batch.number("/ns_per_query_with_tangent") {
                with_tangent.push(two(time));
            }
        }
        rows.push(row);
        if with_tangent.len() > 1 {
            rows.push(with_tangent);
        }
    }
    let columns = ["model", "1 cell [ns a cell]", "64 cells", "3 000 cells", "1 000 000 cells"];
    let meaning = "time of a query by size of the batch, one thread";
    section.add_table("speed-inference", meaning, "bench inference", &columns, rows);
    Ok(())
}

/// The section of the solver alone: it takes longest, and wants a quiet machine most.
///
/// # Errors
/// A file that is missing or lacks an entry.
pub fn solver(root: &Path) -> Result<Section, DocsError> {
    let mut section = Section::default();
    let bench = Json::read(root, "results/bench_solver.json")?;
    let mut rows = Vec::new();
    for (key, entry, unit, words) in [
        ("laplacian_step", "/laplacianFoam_step_ms", "ms", "a step of laplacianFoam"),
        ("step", "/msddFoam_step_ms", "ms", "a step of msddFoam, every cell asked"),
        ("silent_step", "/msddFoam_step_without_queries_ms", "ms", "a step of msddFoam, no cell asked"),
        ("step_ratio", "/ratio", "1", "a step of msddFoam over one of laplacianFoam"),
        ("adaptive_seconds", "/adaptive/seconds", "s", "case H, adaptive steps, start and output included"),
        ("adaptive_steps", "/adaptive/steps", "1", "the same: steps"),
        (
            "adaptive_error",
            "/adaptive/temperature_error",
            "K",
            "the same: rms error of T against much shorter steps",
        ),
        (
            "paper_error",
            "/adaptive/paper_temperature_error",
            "K",
            "case H, the paper's scheme at 1 ms: rms error of T",
        ),
    ] {
        let number = bench.number(entry)?;
        let value = if number >= 100.0 { decimals(number, 0) } else { two(number) };
        section.number(key, value.clone(), unit, words, "scripts/bench-solver");
        rows.push(vec![words.to_string(), if unit == "1" { value } else { format!("{value} {unit}") }]);
    }
    let meaning = "speed of the solver, case H, 100 x 30 cells, one process";
    section.add_table("speed-solver", meaning, "scripts/bench-solver", &["", ""], rows);
    Ok(section)
}
