//! The solver compared with the beds of spheres: the tables that `cases/beds/make` wrote; and what plates give, as `msdd bed slack` found.

use crate::error::DocsError;
use crate::gather::beside;
use crate::gather::json::{INPUTS, Json};
use crate::gather::print::{decimals, or_none, with_scatter};
use crate::results::Section;
use std::path::Path;

const FOLDER: &str = "cases/beds";
const ORIGIN: &str = "cases/beds/make";
/// Quantities in `bands.csv`, and as the book names them.
const QUANTITIES: [(&str, &str); 3] = [("T", "T"), ("pressure", "p"), ("conductivity", "K")];
/// What scenes are for, in `plan.toml`, and as the book says it.
const USES: [(&str, &str); 3] =
    [("calibrate", "for calibration"), ("judge", "for validation"), ("outside", "of another friction")];

/// # Errors
/// Files that are missing or lack a column.
pub fn section(root: &Path) -> Result<Section, DocsError> {
    let mut section = Section::default();
    errors(&mut section, root, ("beds-errors", "the solver compared with beds of spheres, rms", FOLDER))?;

    let bands = Table::read(root, FOLDER, "bands.csv")?;
    let mut rows = Vec::new();
    for (name, words) in QUANTITIES {
        let mut row = vec![words.to_string()];
        for (purpose, _) in USES {
            let line = bands.find(&[("quantity", name), ("use", purpose)])?;
            row.push(decimals(100.0 * bands.number(line, "inside")?, 0));
            row.push(decimals(100.0 * bands.number(line, "inside_worst_scene")?, 0));
            row.push(decimals(bands.number(line, "width")?, 1));
        }
        rows.push(row);
    }
    let columns: Vec<String> = USES
        .iter()
        .flat_map(|(_, words)| {
            [format!("inside, beds {words} [%]"), "worst bed [%]".to_string(), "width".to_string()]
        })
        .collect();
    let columns: Vec<&str> = std::iter::once("").chain(columns.iter().map(String::as_str)).collect();
    section.add_table("beds-bands", "error bands of beds of spheres", ORIGIN, &columns, rows);
    beside::tables(root, &mut section)?;
    plates(&mut section, &Json::read(root, &format!("{INPUTS}/give.json"))?)?;
    Ok(section)
}

/// Hot beds that radiate, and beds of unequal spheres.
///
/// # Errors
/// As [`section`].
pub fn more(root: &Path) -> Result<Section, DocsError> {
    let mut section = Section::default();
    errors(
        &mut section,
        root,
        ("hot-errors", "the solver compared with hot beds of spheres, rms", "cases/hot"),
    )?;
    let unequal =
        ("unequal-errors", "the solver compared with beds of unequal spheres, rms", "cases/unequal");
    errors(&mut section, root, unequal)?;
    Ok(section)
}

/// The table of the beds in a folder.
fn errors(
    section: &mut Section,
    root: &Path,
    (name, meaning, folder): (&str, &str, &str),
) -> Result<(), DocsError> {
    let errors = Table::read(root, folder, "errors.csv")?;
    let mut rows = Vec::new();
    for line in 0..errors.rows.len() {
        let [scene, purpose, packings] =
            ["scene", "use", "packings"].map(|name| errors.text(line, name).map(str::to_string));
        let mut row = vec![format!("`{}`", scene?), purpose?, packings?];
        for quantity in ["T", "pressure", "conductivity"] {
            row.push(decimals(errors.number(line, &format!("{quantity}_error"))?, 2));
            row.push(decimals(errors.number(line, &format!("{quantity}_scatter"))?, 2));
        }
        rows.push(row);
    }
    let columns = [
        "bed",
        "use",
        "packings",
        "T [% of the range]",
        "one packing",
        "p [%]",
        "one packing",
        "K [%]",
        "one packing",
    ];
    section.add_table(name, meaning, ORIGIN, &columns, rows);
    Ok(())
}

/// Slack of the spheres at plates: beds whose load changes, and the mean of all.
fn plates(section: &mut Section, beds: &Json) -> Result<(), DocsError> {
    let (mut rows, mut sums) = (Vec::new(), [[0.0; 2]; 2]);
    for bed in beds.list("")? {
        if bed.maybe("/give/0").is_none() {
            continue;
        }
        let mut row = vec![format!("`{}`", bed.text("/name")?), decimals(bed.number("/packings")?, 0)];
        for (sum, name) in sums.iter_mut().zip(["give", "back"]) {
            let [mean, scatter] = [0, 1].map(|k| bed.maybe(&format!("/{name}/{k}")));
            let known = [mean.unwrap_or(0.0), f64::from(u8::from(mean.is_some()))];
            *sum = [sum[0] + known[0], sum[1] + known[1]];
            row.push(or_none(mean, |mean| {
                scatter.map_or_else(|| decimals(mean, 2), |scatter| with_scatter(mean, scatter, 2))
            }));
        }
        rows.push(row);
    }
    let mut row = vec!["mean".to_string(), String::new()];
    row.extend(sums.map(|[sum, count]| decimals(sum / count, 2)));
    rows.push(row);
    let columns = ["bed", "packings", "slack on loading [d]", "recovered on unloading [d]"];
    let meaning =
        "slack of the bed at each of two smooth plates, in diameters, and how much one packing differs";
    section.add_table("plates-give", meaning, "msdd bed slack", &columns, rows);
    Ok(())
}

/// A file of comma-separated values.
struct Table {
    file: String,
    columns: Vec<String>,
    rows: Vec<Vec<String>>,
}

impl Table {
    fn read(root: &Path, folder: &str, name: &str) -> Result<Self, DocsError> {
        let file = format!("{folder}/{name}");
        let text = msdd_files::read_text(&root.join(&file))?;
        let mut lines = text.lines().map(|line| line.split(',').map(str::to_string).collect::<Vec<_>>());
        let columns = lines.next().unwrap_or_default();
        Ok(Self { file, columns, rows: lines.collect() })
    }

    fn missing(&self, what: &str) -> DocsError {
        DocsError::Json { file: self.file.clone().into(), text: format!("'{what}' is missing") }
    }

    fn text(&self, row: usize, column: &str) -> Result<&str, DocsError> {
        let place = self.columns.iter().position(|name| name == column);
        let cell = place.and_then(|place| self.rows.get(row)?.get(place));
        cell.map(String::as_str).ok_or_else(|| self.missing(column))
    }

    fn number(&self, row: usize, column: &str) -> Result<f64, DocsError> {
        self.text(row, column)?.parse().map_err(|_| self.missing(column))
    }

    /// The first row with these values.
    fn find(&self, wanted: &[(&str, &str)]) -> Result<usize, DocsError> {
        let fits = |row: &usize| {
            wanted.iter().all(|(column, value)| self.text(*row, column).is_ok_and(|text| text == *value))
        };
        (0..self.rows.len()).find(fits).ok_or_else(|| self.missing(wanted[0].1))
    }
}
