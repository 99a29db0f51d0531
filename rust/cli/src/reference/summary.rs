//! `msdd reference summary`: mean and scatter over packings of different seeds.

use crate::error::CliError;
use crate::output::write_json;
use clap::Args;
use msdd_dem_reference::results::{Results, Table};
use msdd_dem_reference::series::mean_and_deviation;
use serde_json::{Map, Value, json};
use std::collections::BTreeMap;
use std::path::PathBuf;

#[derive(Args)]
#[command(
    after_help = "Example: msdd reference summary results/reference/*_seed?.json --out results/reference/summary.json"
)]
pub struct Arguments {
    /// Result file of `msdd reference run`; may be given several times.
    #[arg(required = true, value_name = "FILE")]
    results: Vec<PathBuf>,
    /// JSON file to write the table to.
    #[arg(long, value_name = "FILE")]
    out: Option<PathBuf>,
}

/// Times of the table, as shares of the end time: 0, 1, 5, 10 and 20 s of a run of 20 s.
const MOMENTS: [f64; 5] = [0.0, 0.05, 0.25, 0.5, 1.0];
/// Columns that are left out of the table, by the start of their names: values of single contacts and single discs.
const LEFT_OUT: [&str; 2] = ["tangential_force", "mobilised"];

pub fn run(arguments: &Arguments) -> Result<(), CliError> {
    let results: Vec<Results> =
        arguments.results.iter().map(|path| Results::read(path)).collect::<Result<_, _>>()?;
    let mut cases: BTreeMap<&str, Vec<&Results>> = BTreeMap::new();
    for result in &results {
        cases.entry(&result.case).or_default().push(result);
    }
    let mut summary = Map::new();
    for (case, results) in cases {
        summary.insert(case.to_string(), table(case, &results)?);
    }
    match &arguments.out {
        Some(path) => write_json(path, &summary),
        None => Ok(()),
    }
}

/// Prints and returns mean and standard deviation over the seeds of the columns at several moments.
fn table(case: &str, results: &[&Results]) -> Result<Value, CliError> {
    let seeds: Vec<u64> = results.iter().map(|result| result.seed).collect();
    let times = column(results[0], "time")?;
    let end = times.last().copied().unwrap_or(0.0);
    let moments = MOMENTS.map(|part| part * end);
    outln!("{case}, seeds {seeds:?}: mean +- standard deviation over the seeds");
    outln!("{:<24}{}", "", moments.map(|t| format!("{:>24}", format!("{t} s"))).join(""));
    let mut columns = Map::new();
    let shown = |name: &&String| *name != "time" && !LEFT_OUT.iter().any(|part| name.starts_with(part));
    let names = results[0].series.columns.iter().chain(&results[0].network.columns);
    for name in names.filter(shown) {
        let mut line = Vec::new();
        for moment in moments {
            let at = results.iter().map(|result| value_at(result, name, moment));
            line.push(mean_and_deviation(&at.collect::<Result<Vec<f64>, _>>()?));
        }
        let cells = line.iter().map(|(mean, sd)| format!("{:>24}", shown_pair(*mean, *sd)));
        outln!("{name:<24}{}", cells.collect::<String>());
        columns.insert(name.clone(), json!(line.iter().map(|(m, s)| json!([m, s])).collect::<Vec<_>>()));
    }
    Ok(json!({"seeds": seeds, "times": moments, "mean_and_deviation": columns}))
}

/// The mean with five significant digits, and the deviation with as many decimals.
fn shown_pair(mean: f64, deviation: f64) -> String {
    let size = mean.abs().max(deviation).max(1e-9).log10().floor() as i32;
    let decimals = usize::try_from(4 - size).unwrap_or(0);
    format!("{mean:.decimals$} +- {deviation:.decimals$}")
}

/// A column of the series.
fn column(result: &Results, name: &str) -> Result<Vec<f64>, CliError> {
    column_of(result, &result.series, name)
}

fn column_of(result: &Results, table: &Table, name: &str) -> Result<Vec<f64>, CliError> {
    let missing = || CliError::Message(format!("{} seed {}: no column {name}", result.case, result.seed));
    table.column(name).filter(|values| !values.is_empty()).ok_or_else(missing)
}

/// Value of a column of the series or of the network's table at a time, linear between the lines.
fn value_at(result: &Results, name: &str, time: f64) -> Result<f64, CliError> {
    let in_series = result.series.columns.iter().any(|column| column == name);
    let table = if in_series { &result.series } else { &result.network };
    let (times, values) = (column_of(result, table, "time")?, column_of(result, table, name)?);
    let after = times.partition_point(|&t| t < time - 1e-9);
    Ok(match after {
        0 => values[0],
        k if k == times.len() => values[k - 1],
        k => {
            let share = (time - times[k - 1]) / (times[k] - times[k - 1]);
            values[k - 1] + share * (values[k] - values[k - 1])
        }
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn scatter_of_seeds() {
        assert_eq!(mean_and_deviation(&[3.0]), (3.0, 0.0));
        assert_eq!(mean_and_deviation(&[1.0, 2.0, 3.0]), (2.0, 1.0));
        assert_eq!(shown_pair(2491.8, 10.0), "2491.8 +- 10.0");
        assert_eq!(shown_pair(0.12345, 0.001), "0.12345 +- 0.00100");
        assert_eq!(shown_pair(-83.0, 0.5), "-83.000 +- 0.500");
    }
}
