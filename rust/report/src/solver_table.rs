//! Writes the table that `msddFoam -cheapest` prints, as a C++ header.

use crate::report::Report;
use crate::studies::chart::Cheapest;
use std::fmt::Write;

/// The header: one raw string, built into the solver.
pub fn text(report: &Report) -> String {
    let mut table = format!(
        "Cheapest configuration for an error of T [% of the range of temperatures], largest over 20 s and three\n\
         points of the mean over three packings of 15 000 grains. Core-seconds of {}, {}.\n\
         Cases: H heats from all walls, C cools, HC has a hot and a cold end (cases/).\n\n",
        report.made.cpu, report.made.date
    );
    for row in &report.cheapest {
        let _ = writeln!(table, "{}", line(row));
    }
    table += "\nKeys: cases/common/granularProperties (mechanics equilibrium: grains move), timeScheme.H (second order, adaptive).\n\
              All configurations, and where they fail: scripts/report.\n";
    format!("// Written by msdd report --solver-table\nR\"table({table})table\"\n")
}

fn line(row: &Cheapest) -> String {
    let what = match (&row.configuration, row.core_seconds) {
        (Some(name), Some(seconds)) => format!("{seconds:>7.2} core-s  {name}"),
        _ => "none reaches it".to_string(),
    };
    format!("{:<3} {:>4} %  {what}", row.case, row.error)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rows_say_when_nothing_reaches_the_error() {
        let mut row = Cheapest {
            case: "HC".to_string(),
            error: 0.5,
            configuration: Some("law of the increments: adaptive".to_string()),
            core_seconds: Some(0.3),
        };
        assert_eq!(line(&row), "HC   0.5 %     0.30 core-s  law of the increments: adaptive");
        row.configuration = None;
        assert_eq!(line(&row), "HC   0.5 %  none reaches it");
    }
}
