//! The tables of `msdd summary` on the terminal.

use super::discs::{Errors, Named};
use super::read::{CaseResult, PROBES};
use std::fmt::Write;

/// Time at which temperatures are shown [s], in the middle of the heating, where the cases differ most.
const TIME: f64 = 5.0;
const WAYS: [&str; 2] = ["grains stay", "grains move"];

/// Value of a series at `time`, or at the next time within 0.1 s, because adaptive steps may not end exactly at `time`.
fn at(series: &[(f64, f64)], time: f64) -> Option<f64> {
    let near = series.iter().min_by(|a, b| (a.0 - time).abs().total_cmp(&(b.0 - time).abs()))?;
    ((near.0 - time).abs() < 0.11).then_some(near.1)
}

fn line(out: &mut String, text: &str) {
    writeln!(out, "{}", text.trim_end()).unwrap_or_default();
}

/// The runs of a case, and what they are called in the tables.
fn runs(case: &Named) -> Vec<(&'static str, &CaseResult)> {
    let moving = case.moving.as_ref().map(|run| (WAYS[1], run));
    [Some((WAYS[0], &case.stay)), moving].into_iter().flatten().collect()
}

/// Tables of temperatures, of errors and cost compared with the discs, and of the state at the end, and sentences that sum them up.
pub fn text(cases: &[Named]) -> String {
    let mut out = String::new();
    temperatures(&mut out, cases);
    errors(&mut out, cases);
    ends(&mut out, cases);
    sentences(&mut out, cases);
    out
}

fn temperatures(out: &mut String, cases: &[Named]) {
    line(out, &format!("T [K] after {TIME} s at P1, P2, P3 (left, middle, right)"));
    let ways = WAYS.map(|way| format!("{way:<24}")).concat();
    line(out, &format!("case    {ways}15 000 discs, mean and scatter of 3 packings"));
    for case in cases {
        let mut row = format!("{:<5}", case.name);
        for run in [Some(&case.stay), case.moving.as_ref()] {
            for probe in PROBES {
                let value = run.and_then(|run| at(run.probes.get(probe)?, TIME));
                row += &value.map_or(format!("{:>7}", "-"), |v| format!("{v:>7.1}"));
            }
            row += "   ";
        }
        for probe in PROBES {
            let found = case.discs.temperature[probe].iter().find(|row| (row.0 - TIME).abs() < 1e-6);
            row += &found.map_or(String::new(), |(_, mean, scatter)| format!("{mean:>7.1} ± {scatter:<4.1}"));
        }
        line(out, &row);
    }
}

fn errors(out: &mut String, cases: &[Named]) {
    line(out, "\nLargest difference of T from the discs' mean over the whole run [% of the range], and cost");
    line(
        out,
        "case  way             P1     P2     P3   packings scatter by   cost [s of a core]   discs [s of a core]",
    );
    for case in cases {
        for (way, run) in runs(case) {
            let mut row = format!("{:<5} {way:<12}", case.name);
            match case.errors(run) {
                Some(Errors { temperature, .. }) => {
                    temperature.iter().for_each(|error| row += &format!("{error:>7.1}"));
                }
                None => row += "  (ended before the discs)",
            }
            let discs = case.discs.core_seconds.map_or("-".to_string(), |s| format!("{s:.0}"));
            row += &format!(
                "{:>22.1} {:>20.1} {discs:>21}",
                case.discs.scatter,
                run.cpu_seconds.unwrap_or(run.wall_seconds)
            );
            line(out, &row);
        }
    }
}

fn ends(out: &mut String, cases: &[Named]) {
    line(out, "\nMeans over the bed at the end");
    line(
        out,
        "case  way          porosity   K_xx   K_yy [W/(m K)]   pressure [kPa]   discs [kPa]   steps   out of range",
    );
    for case in cases {
        let pressure = case.discs.pressure.last().map_or(f64::NAN, |row| row.1);
        for (way, run) in runs(case) {
            let end = &run.end;
            let row = format!(
                "{:<5} {way:<12} {:>8.4} {:>6.1} {:>6.1} {:>25.3} {:>13.3} {:>7} {:>14}",
                case.name,
                end.porosity,
                end.conductivity_xx,
                end.conductivity_yy,
                end.pressure / 1e3,
                pressure / 1e3,
                run.steps,
                run.clamped_queries
            );
            line(out, &row);
        }
    }
}

/// Sums up the errors of the cases with expansion in sentences.
fn sentences(out: &mut String, cases: &[Named]) {
    let expanding: Vec<&Named> = cases.iter().filter(|case| !case.name.ends_with('*')).collect();
    let worst = |run: fn(&Named) -> Option<&CaseResult>| {
        let errors = expanding.iter().filter_map(|case| case.errors(run(case)?));
        errors.map(|errors| errors.largest()).reduce(f64::max)
    };
    let scatter = expanding.iter().map(|case| case.discs.scatter).fold(0.0, f64::max);
    line(out, "");
    if let Some(stay) = worst(|case| Some(&case.stay)) {
        let text = "With the paper's scheme, in which grains stay in their cells, T of H, C and HC is within";
        line(out, &format!("{text} {stay:.1} % of the discs'."));
    }
    if let Some(moving) = worst(|case| case.moving.as_ref()) {
        let packings =
            format!("Packings themselves scatter by up to {scatter:.1} % (one standard deviation).");
        line(out, &format!("With grains that move it is within {moving:.1} %. {packings}"));
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::summary::{fixture, read_all};

    fn table(name: &str, moving: bool) -> String {
        let folder = fixture::Cases::new(name);
        let cases = folder.path();
        text(&read_all(cases, moving.then_some(cases), &fixture::reference()).unwrap().0)
    }

    fn row(table: &str, start: &str, nth: usize) -> String {
        let mut rows = table.lines().filter(|line| line.starts_with(start));
        rows.nth(nth).unwrap().split_whitespace().collect::<Vec<_>>().join(" ")
    }

    #[test]
    fn rows_hold_both_ways_beside_the_discs() {
        let table = table("table", true);
        let temperatures = "HC* 79.0 80.0 81.0 79.0 80.0 81.0 68.4 ± 0.2 50.0 ± 0.0 31.8 ± 0.5";
        assert_eq!(row(&table, "HC* ", 0), temperatures);
        let errors = row(&table, "H  ", 2);
        assert!(errors.starts_with("H grains move"), "{errors}");
        assert!(row(&table, "HC* ", 3).starts_with("HC* grains stay 0.0800 52.0 46.0 5.000 2.48"), "{table}");
        assert!(table.contains("With grains that move it is within"));
    }

    #[test]
    fn without_runs_of_grains_that_move_there_are_none_in_the_table() {
        let table = table("stay", false);
        assert!(!table.contains("H     grains move") && !table.contains("With grains that move"), "{table}");
        assert!(row(&table, "H  ", 0).starts_with("H 79.0 80.0 81.0 - - -"), "{table}");
    }
}
