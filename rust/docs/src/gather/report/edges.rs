//! What happens at the edges of the methods: stable steps, refusals, and where accuracy is lost.

use crate::error::DocsError;
use crate::gather::json::Json;
use crate::gather::print::{decimals, or_none, power, two};
use crate::results::Section;

/// Written by `scripts/report`.
pub const FILE: &str = "results/report.json";

/// Largest stable steps of the engine: predicted and measured.
///
/// # Errors
/// An entry that is missing.
pub fn stable_steps(section: &mut Section, report: &Json) -> Result<(), DocsError> {
    let mut rows = Vec::new();
    for entry in report.list("/failures/stable_steps")? {
        let pair = |name: &str| -> Result<String, DocsError> {
            let milliseconds =
                |which: usize| Ok(decimals(1e3 * entry.number(&format!("/{name}/{which}"))?, 3));
            let [predicted, measured]: [Result<String, DocsError>; 2] = [0, 1].map(milliseconds);
            Ok(format!("{}, {}", predicted?, measured?))
        };
        rows.push(vec![decimals(entry.number("/porosity")?, 2), pair("mechanical")?, pair("thermal")?]);
    }
    let columns = ["porosity", "mechanical: predicted, measured [ms]", "thermal: predicted, measured [ms]"];
    let meaning = "largest stable steps of 500 discs: by the bound, and found by trying";
    section.add_table("stable-steps", meaning, FILE, &columns, rows);
    Ok(())
}

/// What programs do at and beyond the edges of their methods.
///
/// # Errors
/// An entry that is missing.
pub fn edges(section: &mut Section, report: &Json) -> Result<(), DocsError> {
    let list = report.list("/failures/rows")?;
    let as_allowed = list.iter().filter(|row| row.value["as_allowed"] == true).count();
    section.number("edges", list.len().to_string(), "1", "configurations at an edge of a method", FILE);
    section.number("edges_as_allowed", as_allowed.to_string(), "1", "of these, behave as they should", FILE);
    let row = |row: &Json| -> Result<Vec<String>, DocsError> {
        ["/method", "/condition", "/behaviour"]
            .iter()
            .map(|entry| row.text(entry).map(|text| cell(&text)))
            .collect()
    };
    let rows = list.iter().map(row).collect::<Result<_, _>>()?;
    let meaning = "configurations at the edge of a method or beyond it, and what the programs do";
    section.add_table("edges", meaning, FILE, &["method", "what was asked for", "what happened"], rows);
    Ok(())
}

/// A text that can stand in a cell.
fn cell(text: &str) -> String {
    text.replace(['|', '\n', '\r'], " ").replace("<!--", "")
}

/// Where accuracy is lost: conductivities that jump, slanted cells, steps that are too long.
///
/// # Errors
/// An entry that is missing.
pub fn limits(section: &mut Section, report: &Json) -> Result<(), DocsError> {
    let mut rows = Vec::new();
    for entry in report.list("/failures/contrast")? {
        let error = |value: Option<f64>| or_none(value, |v| decimals(v.abs(), 1));
        rows.push(vec![
            power(entry.number("/contrast")?),
            decimals(entry.number("/cells")?, 0),
            error(entry.maybe("/predicted")),
            error(entry.maybe("/measured")),
        ]);
    }
    let columns = [
        "ratio of the conductivities",
        "cells along x",
        "error of the heat that flows, predicted [%]",
        "measured [%]",
    ];
    let meaning = "heat through two halves of different conductivity in series";
    section.add_table("contrast", meaning, FILE, &columns, rows);
    let mut rows = Vec::new();
    for entry in report.list("/failures/slant")? {
        rows.push(vec![
            decimals(entry.number("/angle")?, 0),
            entry.numbers("/cells")?.iter().map(|n| decimals(*n, 0)).collect::<Vec<_>>().join(" × "),
            decimals(entry.number("/correctors")?, 0),
            or_none(entry.maybe("/error"), |v| decimals(v.abs(), 1)),
        ]);
    }
    let columns = ["angle [degrees]", "cells", "corrections", "error of T [% of the range]"];
    section.add_table("slant", "case H* on cells that lean over", FILE, &columns, rows);
    let mut rows = Vec::new();
    for entry in report.list("/failures/coupling")? {
        let steps = two(1e3 * entry.number("/step")?);
        let error = or_none(entry.maybe("/error"), |v| format!("{} K", two(v)));
        rows.push(vec![entry.text("/scheme")?, steps, error, cell(&entry.text("/outcome")?)]);
    }
    let columns = ["scheme", "step [ms]", "largest error of T at the probes from 1 s on", "the run"];
    section.add_table("coupling", "case H, 25 x 8 cells: steps that are too long", FILE, &columns, rows);
    Ok(())
}
