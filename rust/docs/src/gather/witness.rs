//! The engine compared with YADE: what `tests/engines/run` printed.

use crate::error::DocsError;
use crate::gather::json::INPUTS;
use crate::gather::print::{decimals, power};
use crate::results::Section;
use std::path::Path;

const FILE: &str = "witness.txt";
/// What begins the part of the output in which both engines strain at one rate, and the part after it.
const SAME_RATE: &str = "at 0.02 1/s in both engines";
const OWN_RATE: &str = "at msdd's own rates";

/// One line: strain, and what differs by name.
struct Line {
    strain: f64,
    pressure: f64,
    differences: Vec<(String, f64)>,
}

impl Line {
    fn difference(&self, name: &str) -> Option<f64> {
        self.differences.iter().find(|(key, _)| key == name).map(|(_, value)| *value)
    }
}

/// # Errors
/// Output that is missing or of another form.
pub fn section(root: &Path) -> Result<Section, DocsError> {
    let file = format!("{INPUTS}/{FILE}");
    let text = msdd_files::read_text(&root.join(&file))?;
    let missing =
        |what: &str| DocsError::Json { file: file.clone().into(), text: format!("'{what}' is missing") };
    let (_, rest) = text.split_once(SAME_RATE).ok_or_else(|| missing(SAME_RATE))?;
    let (same, own) = rest.split_once(OWN_RATE).ok_or_else(|| missing(OWN_RATE))?;
    let mut section = Section::default();
    let mut rows = Vec::new();
    for (key, words, part) in [("same", "the same rate", same), ("own", "each its own rate", own)] {
        let lines: Vec<Line> = part.lines().filter_map(line).collect();
        let stresses = ["pressure", "stress.xx", "stress.yy"];
        let worst = |names: &[&str]| {
            let all = lines.iter().flat_map(|line| names.iter().filter_map(|name| line.difference(name)));
            all.reduce(f64::max).ok_or_else(|| missing("differences:"))
        };
        let meaning =
            format!("largest relative difference of stresses from YADE, {words}, strains of -1 to 5 %");
        section.number(
            &format!("{key}.stress"),
            power(worst(&stresses)?),
            "1",
            &meaning,
            "tests/engines/run",
        );
        let meaning =
            format!("largest difference of the fabric index from YADE, {words}, strains of -1 to 5 %");
        section.number(
            &format!("{key}.fabric"),
            power(worst(&["fabric_index"])?),
            "1",
            &meaning,
            "tests/engines/run",
        );
        for line in &lines {
            let cell = |name: &str| line.difference(name).map(power).ok_or_else(|| missing(name));
            rows.push(vec![
                words.to_string(),
                format!("{:+.0} %", 100.0 * line.strain),
                decimals(1e-3 * line.pressure, 2),
                cell("pressure")?,
                cell("stress.xx")?,
                cell("stress.yy")?,
                cell("fabric_index")?,
            ]);
        }
    }
    let columns = [
        "rate",
        "strain",
        "pressure [kPa]",
        "difference of the pressure",
        "of σ_xx",
        "of σ_yy",
        "of the fabric index",
    ];
    let meaning = "500 discs from one packed state by msdd and by YADE; differences relative, of the fabric index absolute";
    section.add_table("witness", meaning, "tests/engines/run", &columns, rows);
    Ok(section)
}

/// "strain  0.01  p 3005.1 Pa  f 0.0380  differences:  pressure 1.2e-05  stress.xx 2.0e-05 …"
fn line(text: &str) -> Option<Line> {
    let (head, differences) = text.strip_prefix("strain")?.split_once("differences:")?;
    let mut words = head.split_whitespace();
    let strain = words.next()?.parse().ok()?;
    let pressure = words.nth(1)?.parse().ok()?;
    let words: Vec<&str> = differences.split_whitespace().collect();
    let pair = |pair: &[&str]| Some((pair[0].to_string(), pair.get(1)?.parse().ok()?));
    Some(Line { strain, pressure, differences: words.chunks(2).filter_map(pair).collect() })
}
