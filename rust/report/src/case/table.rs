//! The results as a table for spreadsheets: one line a configuration.

use super::errors::Error;
use super::{CaseReport, Row};
use std::fmt::Write;

/// Columns: names and units.
pub const COLUMNS: [&str; 15] = [
    "family",
    "configuration",
    "cells",
    "cpu_seconds",
    "wall_seconds",
    "T_error_percent",
    "T_mean_error_percent",
    "pressure_error_percent",
    "pressure_mean_error_percent",
    "displacement_error_percent",
    "displacement_mean_error_percent",
    "T_front",
    "pressure_front",
    "outcome",
    "message",
];

/// The table as CSV.
pub fn csv(report: &CaseReport) -> String {
    report.rows.iter().fold(COLUMNS.join(",") + "\n", |mut text, row| {
        let _ = writeln!(text, "{}", line(row).join(","));
        text
    })
}

fn line(row: &Row) -> [String; 15] {
    let point = &row.point;
    let number = |value: Option<f64>| value.map_or(String::new(), |value| format!("{value:.6}"));
    let pair = |error: Option<Error>| [number(error.map(|e| e.worst)), number(error.map(|e| e.mean))];
    let [temperature, temperature_mean] = pair(row.errors.temperature);
    let [pressure, pressure_mean] = pair(row.errors.pressure);
    let [displacement, displacement_mean] = pair(row.errors.displacement);
    [
        quoted(&point.family),
        quoted(&point.name),
        row.cells.map_or(String::new(), |cells| cells.to_string()),
        number(point.core_seconds),
        number(row.wall_seconds),
        temperature,
        temperature_mean,
        pressure,
        pressure_mean,
        displacement,
        displacement_mean,
        point.front[0].to_string(),
        point.front[1].to_string(),
        point.outcome.clone(),
        quoted(&point.message),
    ]
}

fn quoted(text: &str) -> String {
    format!("\"{}\"", text.replace('"', "\"\""))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn text_cannot_break_a_line() {
        assert_eq!(quoted("a \"b\", c"), "\"a \"\"b\"\", c\"");
    }
}
