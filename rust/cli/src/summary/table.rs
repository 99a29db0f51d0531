//! The table on the terminal.

use super::read::{Named, PROBES};
use std::fmt::Write;

/// Times at which temperatures are shown [s].
const TIMES: [f64; 4] = [1.0, 5.0, 10.0, 20.0];

/// Value of a series at `time`, if it has one there.
fn at(series: &[(f64, f64)], time: f64) -> Option<f64> {
    series.iter().find(|(t, _)| (t - time).abs() < 1e-6).map(|&(_, value)| value)
}

/// Temperatures at the probes, then the state at the end and the cost.
pub fn text(cases: &[Named]) -> String {
    let mut out = String::new();
    let line = |out: &mut String, text: String| writeln!(out, "{}", text.trim_end()).unwrap_or_default();
    line(&mut out, "T [K] at P1, P2, P3".to_string());
    let times: Vec<String> = TIMES.iter().map(|t| format!("{:^24}", format!("t = {t} s"))).collect();
    line(&mut out, format!("case  {}", times.join("  ")));
    for case in cases {
        let mut row = format!("{:<6}", case.name);
        for time in TIMES {
            for probe in PROBES {
                let value = case.result.probes.get(probe).and_then(|series| at(series, time));
                row += &value.map_or(format!("{:>8}", "-"), |v| format!("{v:>8.2}"));
            }
            row += "  ";
        }
        line(&mut out, row);
    }
    line(&mut out, String::new());
    let head =
        "case  porosity   fabric   K_xx   K_yy [W/(m K)]   p [kPa]   wall [s]    steps  queries  clamped";
    line(&mut out, format!("means at the end\n{head}"));
    for case in cases {
        let (result, end) = (&case.result, &case.result.end);
        line(
            &mut out,
            format!(
                "{:<6}{:>8.4} {:>8.4} {:>6.1} {:>6.1} {:>19.3} {:>10.1} {:>8} {:>8} {:>8}",
                case.name,
                end.porosity,
                end.fabric,
                end.conductivity_xx,
                end.conductivity_yy,
                end.pressure / 1e3,
                result.wall_seconds,
                result.steps,
                result.queries,
                result.clamped_queries
            ),
        );
    }
    let moved = cases.iter().filter_map(|case| Some((case, case.result.mechanics.as_ref()?)));
    let moved: Vec<_> = moved.filter(|(_, mechanics)| mechanics.kind != "none").collect();
    if !moved.is_empty() {
        let head =
            "case  mechanics     solves iterations  linear  in parts  residual [Pa]  displacement [mm]";
        line(&mut out, format!("\n{head}"));
    }
    for (case, m) in moved {
        let counts =
            format!("{:>7} {:>10} {:>7} {:>9}", m.solves, m.iterations, m.linear_iterations, m.cut_steps);
        let row = format!(
            "{:<6}{:<12} {counts} {:>14.3} {:>18.2}",
            case.name,
            m.kind,
            m.residual,
            1e3 * m.displacement
        );
        line(&mut out, row);
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::summary::{fixture, read_all};

    #[test]
    fn rows_hold_temperatures_by_time_and_the_state_at_the_end() {
        let folder = fixture::Cases::new("table");
        let (cases, _) = read_all(folder.path()).unwrap();
        let table = text(&cases);
        let rows: Vec<Vec<&str>> = table
            .lines()
            .filter(|line| line.starts_with("HC* "))
            .map(|line| line.split_whitespace().collect())
            .collect();
        // The fixture has no row at 10 s.
        let temperatures = "HC* 50.00 51.00 52.00 79.00 80.00 81.00 - - - 119.00 120.00 121.00";
        assert_eq!(rows[0].join(" "), temperatures);
        assert_eq!(rows[1].join(" "), "HC* 0.0800 0.0200 52.0 46.0 5.000 30.5 20000 20000 7");
    }

    #[test]
    fn mechanics_has_rows_where_there_was_any() {
        let folder = fixture::Cases::new("mechanics");
        let with = |kind: &str| {
            let mechanics = format!(
                r#""mechanics": {{"kind": "{kind}", "solves": 40, "iterations": 90, "linear_iterations": 300,
                "cut_steps": 2, "unconverged_steps": 1, "residual": 4.5, "displacement": 0.019}}, "model""#
            );
            fixture::SOLVER.replace("\"model\"", &mechanics)
        };
        folder.write_summary("H", &with("none"));
        folder.write_summary("HC", &with("equilibrium"));
        let (cases, _) = read_all(folder.path()).unwrap();
        let table = text(&cases);
        let rows: Vec<&str> = table.lines().skip_while(|line| !line.contains("in parts")).skip(1).collect();
        let row: Vec<&str> = rows[0].split_whitespace().collect();
        assert_eq!((rows.len(), row.join(" ").as_str()), (1, "HC equilibrium 40 90 300 2 4.500 19.00"));
        let json = serde_json::to_value(&cases[0].result).unwrap();
        assert_eq!(json["mechanics"]["solves"], 40);
        assert!(serde_json::to_value(&cases[1].result).unwrap().get("mechanics").is_none());
    }
}
