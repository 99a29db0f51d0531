//! `msdd reference summary`: mean and scatter over packings of different seeds, or the differences of two runs, for example
//! with different time steps.

use crate::error::CliError;
use clap::Args;
use msdd_dem_reference::results::{Results, Table};
use msdd_dem_reference::series::mean_and_deviation;
use msdd_files::write;
use serde_json::{Map, Value, json};
use std::collections::BTreeMap;
use std::path::PathBuf;

#[derive(Args)]
#[command(after_help = "Examples:
  msdd reference summary results/reference/*_seed?.json --out results/reference/summary.json
  msdd reference summary results/fine/H_seed1.json results/reference/H_seed1.json --differences")]
pub struct Arguments {
    /// Result file of `msdd reference run`; may be given several times.
    #[arg(required = true, value_name = "FILE")]
    results: Vec<PathBuf>,
    /// Print the largest difference of each column of the time series of two results, at the times of the first.
    #[arg(long)]
    differences: bool,
    /// JSON file to write the table to.
    #[arg(long, value_name = "FILE", conflicts_with = "differences")]
    out: Option<PathBuf>,
}

/// Times of the table, as shares of the end time: 0, 1, 5, 10 and 20 s of a run of 20 s.
const MOMENTS: [f64; 5] = [0.0, 0.05, 0.25, 0.5, 1.0];
/// Columns of the profiles whose scatter at the end of the run is printed.
const PROFILES: [&str; 6] = ["T", "displacement_x", "porosity", "stress_xx", "stress_yy", "stress_xy"];
/// Columns that are left out of the table, by the start of their names: values of single contacts and single discs.
const LEFT_OUT: [&str; 2] = ["tangential_force", "mobilised"];

pub fn run(arguments: &Arguments) -> Result<(), CliError> {
    let results: Vec<Results> =
        arguments.results.iter().map(|path| Results::read(path)).collect::<Result<_, _>>()?;
    if arguments.differences {
        return match results.as_slice() {
            [first, second] => differences(first, second),
            _ => Err(CliError::Message("--differences: give two results".to_string())),
        };
    }
    let mut cases: BTreeMap<&str, Vec<&Results>> = BTreeMap::new();
    for result in &results {
        cases.entry(&result.case).or_default().push(result);
    }
    let mut summary = Map::new();
    for (case, results) in cases {
        summary.insert(case.to_string(), table(case, &results)?);
    }
    match &arguments.out {
        Some(path) => {
            let text =
                serde_json::to_string_pretty(&summary).map_err(|e| CliError::Message(e.to_string()))?;
            Ok(write(path, text.as_bytes())?)
        }
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
    let profiles = profile_scatter(results)?;
    Ok(json!({"seeds": seeds, "times": moments, "mean_and_deviation": columns, "profiles_at_end": profiles}))
}

/// The mean with five significant digits, and the deviation with as many decimals.
fn shown_pair(mean: f64, deviation: f64) -> String {
    let size = mean.abs().max(deviation).max(1e-9).log10().floor() as i32;
    let decimals = usize::try_from(4 - size).unwrap_or(0);
    format!("{mean:.decimals$} +- {deviation:.decimals$}")
}

/// Prints and returns mean along x and root mean square along x of the deviation over the seeds, of the last profiles.
fn profile_scatter(results: &[&Results]) -> Result<Value, CliError> {
    let mut scatter = Map::new();
    for name in PROFILES {
        let mut last = Vec::new();
        for result in results {
            let times = column_of(result, &result.profiles, "time")?;
            let values = column_of(result, &result.profiles, name)?;
            let end = times.last().copied().unwrap_or(0.0);
            let at_end: Vec<f64> =
                times.iter().zip(values).filter(|(t, _)| **t == end).map(|(_, v)| v).collect();
            last.push(at_end);
        }
        let bins = last[0].len();
        let (mut mean, mut square) = (0.0, 0.0);
        for bin in 0..bins {
            let values: Vec<f64> = last.iter().filter_map(|values| values.get(bin).copied()).collect();
            let (m, deviation) = mean_and_deviation(&values);
            mean += m / bins as f64;
            square += deviation * deviation / bins as f64;
        }
        outln!("{:<24}{:>24}", format!("profile {name}, end"), shown_pair(mean, square.sqrt()));
        scatter.insert(name.to_string(), json!([mean, square.sqrt()]));
    }
    Ok(Value::Object(scatter))
}

/// Prints the differences of the second result from the first.
fn differences(first: &Results, second: &Results) -> Result<(), CliError> {
    let times = column(first, "time")?;
    let step = |result: &Results| match result.time_step {
        Some(step) => format!("steps of {step} s"),
        None => "steps from the bound".to_string(),
    };
    outln!("{} with {} against {} with {}", second.case, step(second), first.case, step(first));
    outln!("{:<22} {:>14} {:>14} {:>14}", "", "largest", "at time [s]", "range of first");
    for name in first.series.columns.iter().filter(|name| *name != "time") {
        let (mut largest, mut when) = (0.0f64, 0.0);
        let values = column(first, name)?;
        for (&time, value) in times.iter().zip(&values) {
            let difference = (value_at(second, name, time)? - value).abs();
            if difference > largest {
                (largest, when) = (difference, time);
            }
        }
        let range = values.iter().copied().fold(f64::NEG_INFINITY, f64::max)
            - values.iter().copied().fold(f64::INFINITY, f64::min);
        outln!("{name:<22} {largest:>14.6} {when:>14} {range:>14.6}");
    }
    Ok(())
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
