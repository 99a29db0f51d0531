//! The six cases: the solver by the paper's scheme and with grains that move, beside the committed discrete elements.

use super::json::Json;
use super::print::{NONE, decimals, two, with_scatter};
use super::{INPUTS, Section};
use crate::DocsError;
use std::path::Path;

/// Folder, name, range of T [K] by which errors are divided.
const CASES: [(&str, &str, f64); 6] = [
    ("H", "H", 50.0),
    ("C", "C", 50.0),
    ("HC", "HC", 100.0),
    ("Hstar", "H*", 50.0),
    ("Cstar", "C*", 50.0),
    ("HCstar", "HC*", 100.0),
];
/// Ways of running the solver: file and words.
const WAYS: [(&str, &str); 2] =
    [("paper", "solver, the paper's scheme"), ("moving", "solver, grains that move")];
const SEEDS: [u32; 3] = [1, 2, 3];
/// When temperatures are set side by side [s].
const TIME: f64 = 5.0;
/// Conductivity of the grains [W/(m K)], by which the discs' K/k is multiplied.
const GRAIN: f64 = 100.0;
/// Rangel et al., section 3.3: largest error of T of their solver against their discrete elements [%], at the centre in H and C and
/// at P3, the worst of three points, in HC; section 3.4: 40 s for a run.
const PAPER_ERRORS: [Option<f64>; 6] = [Some(5.3), Some(2.8), Some(6.5), None, None, None];
const PAPER_SECONDS: f64 = 40.0;

/// One case by discrete elements.
struct Discs {
    times: Vec<f64>,
    /// By packing, probe, time [K].
    temperature: Vec<[Vec<f64>; 3]>,
    /// Mean and standard deviation over the packings at [`TIME`] [K], by probe.
    at_time: [[f64; 2]; 3],
    /// Largest standard deviation of T over time and probes [K].
    scatter: f64,
    summary: Json,
}

/// One run of the solver, first packing.
struct Run {
    /// By probe: T at [`TIME`] [K].
    at_time: [f64; 3],
    /// Largest difference of T from the discs over time and probes [K].
    error: f64,
    seconds: f64,
    end: Json,
}

/// # Errors
/// Files that are missing or lack an entry.
pub fn section(root: &Path) -> Result<Section, DocsError> {
    let mut section = Section::default();
    let mut discs = Vec::new();
    for (case, _, _) in CASES {
        discs.push(read_discs(root, case)?);
    }
    let mut runs: Vec<Vec<Run>> = Vec::new();
    for (way, _) in WAYS {
        let summary = Json::read(root, &format!("{INPUTS}/{way}.json"))?;
        let seconds = Json::read(root, &format!("{INPUTS}/seconds.json"))?;
        let of = |((case, _, _), discs): (&(&str, &str, f64), &Discs)| {
            read_run(&summary, &seconds, way, case, discs)
        };
        runs.push(CASES.iter().zip(&discs).map(of).collect::<Result<_, _>>()?);
    }
    first(&mut section, &runs, &discs);
    temperatures(&mut section, &runs, &discs);
    ends(&mut section, &runs, &discs)?;
    Ok(section)
}

fn read_discs(root: &Path, case: &str) -> Result<Discs, DocsError> {
    let (mut times, mut temperature) = (Vec::new(), Vec::new());
    for seed in SEEDS {
        let file = Json::read(root, &format!("cases/reference/results/{case}_seed{seed}.json"))?;
        let names = file.list("/series/columns")?;
        let rows = file.list("/series/rows")?;
        let column = |name: &str| -> Result<Vec<f64>, DocsError> {
            let k = names.iter().position(|entry| entry.says("", name));
            let k = k.ok_or_else(|| file.wrong("/series/columns", &format!("has no column '{name}'")))?;
            rows.iter().map(|row| row.number(&format!("/{k}"))).collect()
        };
        times = column("time")?;
        temperature.push([column("T_P1_window")?, column("T_P2_window")?, column("T_P3_window")?]);
    }
    let statistics = |probe: usize, k: usize| {
        let values: Vec<f64> = temperature.iter().map(|packing: &[Vec<f64>; 3]| packing[probe][k]).collect();
        mean_and_deviation(&values)
    };
    let now = times.iter().position(|t| (t - TIME).abs() < 1e-6).unwrap_or(0);
    let all = (0..3).flat_map(|probe| (0..times.len()).map(move |k| (probe, k)));
    let scatter = all.map(|(probe, k)| statistics(probe, k)[1]).fold(0.0, f64::max);
    let at_time = [0, 1, 2].map(|probe| statistics(probe, now));
    let summary =
        Json::read(root, "cases/reference/summary.json")?.at(&format!("/{case}/mean_and_deviation"))?;
    Ok(Discs { times, temperature, at_time, scatter, summary })
}

/// Of a sample (n - 1).
fn mean_and_deviation(values: &[f64]) -> [f64; 2] {
    let n = values.len() as f64;
    let mean = values.iter().sum::<f64>() / n;
    [mean, (values.iter().map(|v| (v - mean).powi(2)).sum::<f64>() / (n - 1.0)).sqrt()]
}

fn read_run(summary: &Json, seconds: &Json, way: &str, case: &str, discs: &Discs) -> Result<Run, DocsError> {
    let (mut at_time, mut error) = ([f64::NAN; 3], 0.0);
    for probe in 0..3 {
        let series = summary.at(&format!("/cases/{case}/probes/P{}", probe + 1))?;
        let rows: Vec<Vec<f64>> =
            series.list("")?.iter().map(|row| row.numbers("")).collect::<Result<_, _>>()?;
        for (time, reference) in discs.times.iter().zip(&discs.temperature[0][probe]).skip(1) {
            let row = rows.iter().find(|row| (row[0] - time).abs() < 1e-6);
            let value = row.ok_or_else(|| series.wrong("", &format!("has no value at {time} s")))?[1];
            error = f64::max(error, (value - reference).abs());
            if (time - TIME).abs() < 1e-6 {
                at_time[probe] = value;
            }
        }
    }
    let end = summary.at(&format!("/cases/{case}/final"))?;
    Ok(Run { at_time, error, seconds: seconds.number(&format!("/{way}/{case}"))?, end })
}

/// The table that the README shows: error of T and processor time.
fn first(section: &mut Section, runs: &[Vec<Run>], discs: &[Discs]) {
    let mut rows = Vec::new();
    let source = "msdd summary; cases/reference/results";
    for ((way, words), runs) in WAYS.iter().zip(runs) {
        let mut row = vec![(*words).to_string()];
        for ((case, name, range), run) in CASES.iter().zip(runs) {
            let error = decimals(100.0 * run.error / range, 1);
            row.push(format!("{error} % in {} s", two(run.seconds)));
            let meaning = format!(
                "{name}, {words}: largest error of T over 20 s at P1, P2, P3, first packing, of the range of T"
            );
            section.number(&format!("{case}.{way}.error"), error, "%", &meaning, source);
            let meaning = format!("{name}, {words}: processor time of a run, 100 x 30 cells");
            section.number(
                &format!("{case}.{way}.seconds"),
                two(run.seconds),
                "s",
                &meaning,
                "time of msddFoam",
            );
        }
        rows.push(row);
    }
    let mut row = vec!["15 000 discs, scatter of three packings".to_string()];
    for ((case, name, range), discs) in CASES.iter().zip(discs) {
        let scatter = decimals(100.0 * discs.scatter / range, 1);
        row.push(format!("± {scatter} %"));
        let meaning =
            format!("{name}, discs: largest standard deviation of T over three packings, of the range of T");
        section.number(&format!("{case}.discs.scatter"), scatter, "%", &meaning, "cases/reference/results");
    }
    rows.push(row);
    let mut row = vec!["the paper's solver against its own discs".to_string()];
    row.extend(PAPER_ERRORS.map(|error| {
        error.map_or(NONE.to_string(), |e| format!("{} % in {PAPER_SECONDS} s", decimals(e, 1)))
    }));
    rows.push(row);
    let columns: Vec<&str> = [""].into_iter().chain(CASES.map(|case| case.1)).collect();
    let meaning = "largest error of T over 20 s at three points, of the range of T, and processor time of a run; 100 x 30 cells";
    section.add_table(
        "first",
        meaning,
        &format!("{source}; Rangel et al., sections 3.3 and 3.4"),
        &columns,
        rows,
    );
}

fn temperatures(section: &mut Section, runs: &[Vec<Run>], discs: &[Discs]) {
    let mut rows = Vec::new();
    for (k, (case, name, _)) in CASES.iter().enumerate() {
        let mut row = vec![(*name).to_string()];
        for ((way, words), runs) in WAYS.iter().zip(runs) {
            let values = runs[k].at_time.map(|value| decimals(value, 1));
            for (probe, value) in values.iter().enumerate() {
                let meaning = format!("{name}, {words}: T at P{} after {TIME} s", probe + 1);
                section.number(
                    &format!("{case}.{way}.T_P{}", probe + 1),
                    value.clone(),
                    "K",
                    &meaning,
                    "msdd summary",
                );
            }
            row.push(values.join(", "));
        }
        let values = discs[k].at_time.map(|[mean, deviation]| with_scatter(mean, deviation, 1));
        for (probe, value) in values.iter().enumerate() {
            let meaning = format!("{name}, discs: T at P{} after {TIME} s, three packings", probe + 1);
            section.number(
                &format!("{case}.discs.T_P{}", probe + 1),
                value.clone(),
                "K",
                &meaning,
                "cases/reference/results",
            );
        }
        row.push(values.join(", "));
        rows.push(row);
    }
    let columns = ["case", WAYS[0].1, WAYS[1].1, "discs, mean ± standard deviation of three packings"];
    let meaning = format!("T at P1, P2, P3 after {TIME} s [K]; the solver starts from the first packing");
    section.add_table("temperatures", &meaning, "msdd summary; cases/reference/results", &columns, rows);
}

/// Entry of the solver's summary, of the discs', factor on both and on the discs' alone, digits, words.
const ENDS: [(&str, &str, f64, f64, usize, &str); 4] = [
    ("porosity", "porosity", 1.0, 1.0, 3, "porosity"),
    ("conductivity_xx", "conductivity_network_xx", 1.0, GRAIN, 1, "K_xx [W/(m K)]"),
    ("conductivity_yy", "conductivity_network_yy", 1.0, GRAIN, 1, "K_yy [W/(m K)]"),
    ("pressure", "pressure", 1e-3, 1.0, 2, "pressure [kPa]"),
];

/// Means over the box at the end.
fn ends(section: &mut Section, runs: &[Vec<Run>], discs: &[Discs]) -> Result<(), DocsError> {
    let mut rows = Vec::new();
    for (k, (case, name, _)) in CASES.iter().enumerate() {
        let mut row = vec![(*name).to_string()];
        for (entry, column, factor, of_discs, digits, words) in ENDS {
            let mut cell = Vec::new();
            for ((way, way_words), runs) in WAYS.iter().zip(runs) {
                let value = decimals(factor * runs[k].end.number(&format!("/{entry}"))?, digits);
                let meaning = format!("{name}, {way_words}: mean {words} after 20 s");
                section.number(
                    &format!("{case}.{way}.{entry}"),
                    value.clone(),
                    unit(words),
                    &meaning,
                    "msdd summary",
                );
                cell.push(value);
            }
            let last = discs[k].summary.list(&format!("/{column}"))?.len() - 1;
            let value = decimals(
                factor * of_discs * discs[k].summary.number(&format!("/{column}/{last}/0"))?,
                digits,
            );
            let meaning = format!("{name}, discs: mean {words} after 20 s, three packings, whole box");
            section.number(
                &format!("{case}.discs.{entry}"),
                value.clone(),
                unit(words),
                &meaning,
                "cases/reference/summary.json",
            );
            cell.push(value);
            row.push(cell.join("; "));
        }
        rows.push(row);
    }
    let columns: Vec<&str> = ["case"].into_iter().chain(ENDS.map(|end| end.5)).collect();
    let meaning = "means over the whole box after 20 s: the paper's scheme; grains that move; discs";
    section.add_table("ends", meaning, "msdd summary; cases/reference/summary.json", &columns, rows);
    Ok(())
}

/// The unit in brackets behind a name.
fn unit(words: &str) -> &str {
    words.split_once('[').map_or("1", |(_, rest)| rest.trim_end_matches(']'))
}
