//! Solver and DEM of 20 000 spheres: what `compare-dem` printed for the cases `column` and `store`, and `vary-inputs` for other inputs.

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
/// Before the name of a variant in print.
const VARIANT: &str = "with ";
/// Rows of [`CASES`] whose rms are columns of the table of variants: T, p, K and the stress on the wall, the last with its worst.
const VARIED: [usize; 4] = [0, 4, 5, 6];

/// # Errors
/// A file that is missing or lacks a row.
pub fn tables(root: &Path, section: &mut Section) -> Result<(), DocsError> {
    for (case, rows) in CASES {
        let file = format!("{INPUTS}/{case}.txt");
        let text = msdd_files::read_text(&root.join(&file))?;
        let mut table = Vec::new();
        for (name, words, wanted) in rows {
            let mut row = vec![words.to_string()];
            row.extend(differences(&text, name, &file)?.map(|value| decimals(value, 1)));
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
        variants(root, section, case, &rows, &text)?;
    }
    Ok(())
}

/// The errors with other inputs, below those of the case itself.
fn variants(
    root: &Path,
    section: &mut Section,
    case: &str,
    rows: &[Row; 7],
    itself: &str,
) -> Result<(), DocsError> {
    let file = format!("{INPUTS}/{case}-inputs.txt");
    let text = msdd_files::read_text(&root.join(&file))?;
    let mut printed = vec![("as in the case", itself)];
    printed.extend(
        text.split(&format!("\n{VARIANT}"))
            .filter_map(|part| part.strip_prefix(VARIANT).unwrap_or(part).split_once('\n')),
    );
    let mut table = Vec::new();
    for (what, text) in printed {
        let mut row = vec![what.to_string()];
        for place in VARIED {
            let [rms, worst, _] = differences(text, rows[place].0, &file)?;
            row.push(decimals(rms, 1));
            if place == 6 {
                row.push(decimals(worst, 1));
            }
        }
        table.push(row);
    }
    let mut columns = vec!["input"];
    columns.extend(VARIED.map(|place| rows[place].1));
    columns.push("worst");
    let meaning = format!("case {case}: rms of solver minus DEM with other inputs");
    let source = format!("cases/common/vary-inputs in cases/{case}");
    section.add_table(&format!("inputs-{case}"), &meaning, &source, &columns, table);
    Ok(())
}

/// Rms, worst and scatter of a quantity, as `compare-dem` printed them.
fn differences(text: &str, name: &str, file: &str) -> Result<[f64; 3], DocsError> {
    let line = text.lines().find(|line| line.get(..NAME).is_some_and(|head| head.trim() == name));
    let numbers: Vec<f64> = line
        .and_then(|line| line.get(NAME..))
        .map(|rest| rest.split_whitespace().map_while(|word| word.parse().ok()).collect())
        .unwrap_or_default();
    let [_, rms, worst, packing] = numbers[..] else {
        return Err(DocsError::Json { file: file.into(), text: format!("'{name}' is missing") });
    };
    Ok([rms, worst, packing])
}
