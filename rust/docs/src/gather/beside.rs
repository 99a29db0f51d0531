//! Solver and DEM of 20 000 spheres: what `compare-dem` printed for the cases `column` and `store`.

use crate::error::DocsError;
use crate::gather::json::INPUTS;
use crate::gather::print::decimals;
use crate::results::Section;
use std::path::Path;

/// Case; what its rows are called in print and in the book; the target.
type Row = (&'static str, &'static str, &'static str);
const CASES: [(&str, [Row; 7]); 2] = [
    (
        "column",
        [
            ("T at the probes", "T at five heights [% of the range]", "1"),
            ("stress 1", "stress along x [%]", "–"),
            ("stress 2", "stress along y [%]", "–"),
            ("stress 3", "stress along z [%]", "–"),
            ("p", "pressure [%]", "5"),
            ("K", "K along z [%]", "3"),
            ("stress on the wall", "stress on the lid [%]", "5"),
        ],
    ),
    (
        "store",
        [
            ("T at the probes", "T at three distances from the side [% of the range]", "1"),
            ("stress 1", "stress along the radius [%]", "–"),
            ("stress 2", "stress around the axis [%]", "–"),
            ("stress 3", "stress along the axis [%]", "–"),
            ("p", "pressure [%]", "5"),
            ("K", "K along the axis [%]", "3"),
            ("stress on the wall", "stress on the side [%]", "5"),
        ],
    ),
];
/// Characters of the names in print.
const NAME: usize = 22;

/// # Errors
/// A file that is missing or lacks a row.
pub fn tables(root: &Path, section: &mut Section) -> Result<(), DocsError> {
    for (case, rows) in CASES {
        let file = format!("{INPUTS}/{case}.txt");
        let text = msdd_files::read_text(&root.join(&file))?;
        let missing =
            |what: &str| DocsError::Json { file: file.clone().into(), text: format!("'{what}' is missing") };
        let mut table = Vec::new();
        for (name, words, wanted) in rows {
            let line = text.lines().find(|line| line.get(..NAME).is_some_and(|head| head.trim() == name));
            let numbers: Vec<f64> = line
                .and_then(|line| line.get(NAME..))
                .map(|rest| rest.split_whitespace().map_while(|word| word.parse().ok()).collect())
                .unwrap_or_default();
            let [_, rms, worst, packing] = numbers[..] else { return Err(missing(name)) };
            let mut row = vec![words.to_string()];
            row.extend([rms, worst, packing].map(|value| decimals(value, 1)));
            row.push(wanted.to_string());
            table.push(row);
        }
        let meaning = format!("case {case}: solver minus DEM");
        let columns = ["solver minus DEM", "rms", "worst", "one packing", "target"];
        section.add_table(
            &format!("beside-{case}"),
            &meaning,
            &format!("cases/{case}/Allrun"),
            &columns,
            table,
        );
    }
    Ok(())
}
