//! The six cases: the solver by the paper's scheme and with grains that move, compared with the committed DEM. All of it
//! is in what `msdd summary` writes; errors are computed there.

use crate::error::DocsError;
use crate::gather::json::Json;
use crate::gather::print::{NONE, decimals, two, with_scatter};
use crate::results::Section;
use std::path::Path;

/// Written by `msdd summary`, which scripts/run calls.
const FILE: &str = "results/summary.json";
/// Folder, name.
const CASES: [(&str, &str); 6] =
    [("H", "H"), ("C", "C"), ("HC", "HC"), ("Hstar", "H*"), ("Cstar", "C*"), ("HCstar", "HC*")];
/// Ways of running the solver: key, words, entry of the runs, entry of their errors.
const WAYS: [(&str, &str, &str, &str); 2] = [
    ("paper", "solver, grains stay (the paper's scheme)", "cases", "grains_stay"),
    ("moving", "solver, grains move", "moving", "grains_move"),
];
/// When temperatures are set side by side [s], and how far a value may lie from it.
const TIME: f64 = 5.0;
const NEAR: f64 = 0.11;
/// Conductivity of the grains [W/(m K)], by which the discs' K/k is multiplied.
const GRAIN: f64 = 100.0;
/// Rangel et al., section 3.3: largest error of T of their solver against their DEM [%], at the centre in H and C and
/// at P3, the worst of three points, in HC; section 3.4: 40 s for a run.
const PAPER_ERRORS: [Option<f64>; 6] = [Some(5.3), Some(2.8), Some(6.5), None, None, None];
const PAPER_SECONDS: f64 = 40.0;

/// One case by DEM.
struct Discs {
    /// Mean and standard deviation over the packings at [`TIME`] [K], by probe.
    at_time: [[f64; 2]; 3],
    /// Largest standard deviation of T over time and probes [% of the range].
    scatter: f64,
    /// Processor time of a packing [s], if it was measured.
    seconds: Option<f64>,
    /// Means over the box.
    summary: Json,
}

/// One run of the solver, first packing.
struct Run {
    /// By probe: T at [`TIME`] [K].
    at_time: [f64; 3],
    /// Largest difference of T from the discs' mean over time and probes [% of the range].
    error: f64,
    seconds: f64,
    end: Json,
}

/// # Errors
/// Files that are missing or lack an entry.
pub fn section(root: &Path) -> Result<Section, DocsError> {
    let summary = Json::read(root, FILE)?;
    let means = Json::read(root, "cases/reference/summary.json")?;
    let discs: Vec<Discs> =
        CASES.iter().map(|(case, _)| read_discs(&summary, &means, case)).collect::<Result<_, _>>()?;
    let mut runs: Vec<Vec<Run>> = Vec::new();
    for way in WAYS {
        runs.push(CASES.iter().map(|(case, _)| read_run(&summary, way, case)).collect::<Result<_, _>>()?);
    }
    let mut section = Section::default();
    errors(&mut section, &runs, &discs);
    temperatures(&mut section, &runs, &discs);
    ends(&mut section, &runs, &discs)?;
    Ok(section)
}

/// The row of a series, time first, that is nearest to [`TIME`].
fn at_time(series: &Json) -> Result<Vec<f64>, DocsError> {
    let rows: Vec<Vec<f64>> = series.list("")?.iter().map(|row| row.numbers("")).collect::<Result<_, _>>()?;
    let nearest = rows.into_iter().min_by(|a, b| (a[0] - TIME).abs().total_cmp(&(b[0] - TIME).abs()));
    let near = nearest.filter(|row| (row[0] - TIME).abs() < NEAR);
    near.ok_or_else(|| series.wrong("", &format!("has no value near {TIME} s")))
}

fn read_discs(summary: &Json, means: &Json, case: &str) -> Result<Discs, DocsError> {
    let discs = summary.at(&format!("/comparison/{case}/discs"))?;
    let mut values = [[0.0; 2]; 3];
    for (probe, value) in values.iter_mut().enumerate() {
        let row = at_time(&discs.at(&format!("/temperature/P{}", probe + 1))?)?;
        *value = [row[1], row[2]];
    }
    Ok(Discs {
        at_time: values,
        scatter: discs.number("/scatter")?,
        seconds: discs.maybe("/core_seconds"),
        summary: means.at(&format!("/{case}/mean_and_deviation"))?,
    })
}

fn read_run(
    summary: &Json,
    (_, _, runs, errors): (&str, &str, &str, &str),
    case: &str,
) -> Result<Run, DocsError> {
    let run = summary.at(&format!("/{runs}/{case}"))?;
    let mut values = [0.0; 3];
    for (probe, value) in values.iter_mut().enumerate() {
        *value = at_time(&run.at(&format!("/probes/P{}", probe + 1))?)?[1];
    }
    let errors = summary.numbers(&format!("/comparison/{case}/{errors}/temperature"))?;
    Ok(Run {
        at_time: values,
        error: errors.iter().fold(0.0, |worst, error| f64::max(worst, error.abs())),
        seconds: run.number("/cpu_seconds")?,
        end: run.at("/final")?,
    })
}

/// Error of T and processor time.
fn errors(section: &mut Section, runs: &[Vec<Run>], discs: &[Discs]) {
    let mut rows = Vec::new();
    for ((way, words, _, _), runs) in WAYS.iter().zip(runs) {
        let mut row = vec![(*words).to_string()];
        for ((case, name), run) in CASES.iter().zip(runs) {
            let [error, seconds] = [decimals(run.error, 1), two(run.seconds)];
            row.push(format!("{error} % in {seconds} s"));
            let meaning =
                format!("{name}, {words}: largest error of T at three points over 20 s, of the range of T");
            section.number(&format!("{case}.{way}.error"), error, "%", &meaning, FILE);
            let meaning = format!("{name}, {words}: processor time of a run, 100 x 30 cells");
            section.number(&format!("{case}.{way}.seconds"), seconds, "s", &meaning, FILE);
        }
        rows.push(row);
    }
    let mut row = vec!["15 000 discs, scatter of three packings".to_string()];
    for ((case, name), discs) in CASES.iter().zip(discs) {
        let scatter = decimals(discs.scatter, 1);
        let seconds = discs.seconds.map_or(String::new(), |seconds| format!(" in {} s", two(seconds)));
        row.push(format!("± {scatter} %{seconds}"));
        let meaning =
            format!("{name}, discs: largest standard deviation of T over three packings, of the range of T");
        section.number(&format!("{case}.discs.scatter"), scatter, "%", &meaning, FILE);
    }
    rows.push(row);
    let paper = |error: Option<f64>| {
        error.map_or(NONE.to_string(), |e| format!("{} % in {PAPER_SECONDS} s", decimals(e, 1)))
    };
    let words = vec!["the paper's solver, against its own discs".to_string()];
    rows.push([words, PAPER_ERRORS.map(paper).to_vec()].concat());
    let columns: Vec<&str> = [""].into_iter().chain(CASES.map(|case| case.1)).collect();
    let meaning = "largest error of T at three points over 20 s, of the range of T, and processor time of a run; 100 x 30 cells";
    let source = format!("{FILE}; Rangel et al., sections 3.3 and 3.4");
    section.add_table("errors", meaning, &source, &columns, rows);
}

fn temperatures(section: &mut Section, runs: &[Vec<Run>], discs: &[Discs]) {
    let mut rows = Vec::new();
    for (k, (case, name)) in CASES.iter().enumerate() {
        let mut row = vec![(*name).to_string()];
        let mut cell = |way: &str, words: &str, values: [String; 3]| {
            for (probe, value) in (1..).zip(&values) {
                let meaning = format!("{name}, {words}: T at P{probe} after {TIME} s");
                section.number(&format!("{case}.{way}.T_P{probe}"), value.clone(), "K", &meaning, FILE);
            }
            row.push(values.join(", "));
        };
        for ((way, words, _, _), runs) in WAYS.iter().zip(runs) {
            cell(way, words, runs[k].at_time.map(|value| decimals(value, 1)));
        }
        cell(
            "discs",
            "discs, three packings",
            discs[k].at_time.map(|[mean, deviation]| with_scatter(mean, deviation, 1)),
        );
        rows.push(row);
    }
    let columns = ["case", WAYS[0].1, WAYS[1].1, "discs, mean ± standard deviation of three packings"];
    let meaning = format!("T at P1, P2, P3 after {TIME} s [K]; the solver starts from the first packing");
    section.add_table("temperatures", &meaning, FILE, &columns, rows);
}

/// A mean over the box: entry of the solver's summary, of the discs', factor on both, on the discs' alone, digits, words, unit.
struct Mean(&'static str, &'static str, f64, f64, usize, &'static str, &'static str);

const MEANS: [Mean; 4] = [
    Mean("porosity", "porosity", 1.0, 1.0, 3, "porosity", "1"),
    Mean("conductivity_xx", "conductivity_network_xx", 1.0, GRAIN, 1, "K_xx [W/(m K)]", "W/(m K)"),
    Mean("conductivity_yy", "conductivity_network_yy", 1.0, GRAIN, 1, "K_yy [W/(m K)]", "W/(m K)"),
    Mean("pressure", "pressure", 1e-3, 1.0, 2, "pressure [kPa]", "kPa"),
];

/// Means over the box at the end.
fn ends(section: &mut Section, runs: &[Vec<Run>], discs: &[Discs]) -> Result<(), DocsError> {
    let mut rows = Vec::new();
    for (k, (case, name)) in CASES.iter().enumerate() {
        let mut row = vec![(*name).to_string()];
        for Mean(entry, column, factor, of_discs, digits, words, unit) in MEANS {
            let last = discs[k].summary.list(&format!("/{column}"))?.len() - 1;
            let mean = of_discs * discs[k].summary.number(&format!("/{column}/{last}/0"))?;
            let found = [
                (WAYS[0].0, WAYS[0].1, runs[0][k].end.number(&format!("/{entry}"))?),
                (WAYS[1].0, WAYS[1].1, runs[1][k].end.number(&format!("/{entry}"))?),
                ("discs", "discs, three packings", mean),
            ];
            let found = found.map(|(way, who, value)| {
                let value = decimals(factor * value, digits);
                let meaning = format!("{name}, {who}: {words}, mean over the box after 20 s");
                section.number(&format!("{case}.{way}.{entry}"), value.clone(), unit, &meaning, FILE);
                value
            });
            row.push(found.join("; "));
        }
        rows.push(row);
    }
    let columns: Vec<&str> = ["case"].into_iter().chain(MEANS.map(|mean| mean.5)).collect();
    let meaning = "means over the whole box after 20 s: the paper's scheme; grains that move; discs";
    section.add_table("ends", meaning, &format!("{FILE}; cases/reference/summary.json"), &columns, rows);
    Ok(())
}
