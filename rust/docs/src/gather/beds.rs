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
    [("calibrate", "calibration"), ("judge", "validation"), ("outside", "other friction")];

/// A table of the errors of the beds in a folder.
struct Errors {
    name: &'static str,
    meaning: &'static str,
    folder: &'static str,
    source: &'static str,
    /// Whether the beds differ in what they are for.
    with_use: bool,
    /// Quantities in `errors.csv`, as the book names them, and the unit.
    quantities: &'static [[&'static str; 3]],
}

const T: [&str; 3] = ["T", "T", "% of the range"];
const P: [&str; 3] = ["pressure", "p", "%"];
const K: [&str; 3] = ["conductivity", "K", "%"];
const OTHERS: &str = "cases/common/compare-beds";

/// # Errors
/// Files that are missing or lack a column.
pub fn section(root: &Path) -> Result<Section, DocsError> {
    let mut section = Section::default();
    let beds = Errors {
        name: "beds-errors",
        meaning: "the solver compared with beds of spheres, rms",
        folder: FOLDER,
        source: ORIGIN,
        with_use: true,
        quantities: &[T, P, K],
    };
    errors(&mut section, root, &beds)?;

    let errors = Table::read(root, FOLDER, "errors-proposed.csv")?;
    let rows = (0..errors.rows.len()).map(|line| {
        let mut row = vec![format!("`{}`", errors.text(line, "scene")?)];
        for [quantity, ..] in [T, P, K] {
            row.push(decimals(errors.number(line, &format!("{quantity}_error"))?, 1));
        }
        Ok(row)
    });
    let rows = rows.collect::<Result<_, DocsError>>()?;
    let meaning = "the same from the start that msdd case new proposes";
    let columns = ["bed", "T [% of the range]", "p [%]", "K [%]"];
    section.add_table("beds-proposed", meaning, ORIGIN, &columns, rows);

    let bands = Table::read(root, FOLDER, "bands.csv")?;
    let mut rows = Vec::new();
    for (purpose, words) in USES {
        for (name, symbol) in QUANTITIES {
            let line = bands.find(&[("quantity", name), ("use", purpose)])?;
            rows.push(vec![
                words.to_string(),
                symbol.to_string(),
                decimals(100.0 * bands.number(line, "inside")?, 0),
                decimals(100.0 * bands.number(line, "inside_worst_scene")?, 0),
                decimals(bands.number(line, "width")?, 1),
            ]);
        }
    }
    let columns = ["beds", "quantity", "inside [%]", "inside, worst bed [%]", "width"];
    section.add_table("beds-bands", "error bands of beds of spheres", ORIGIN, &columns, rows);
    beside::tables(root, &mut section)?;
    plates(&mut section, &Json::read(root, &format!("{INPUTS}/give.json"))?)?;
    Ok(section)
}

/// Hot beds that radiate, whose spheres do not expand, and beds of unequal spheres.
///
/// # Errors
/// As [`section`].
pub fn more(root: &Path) -> Result<Section, DocsError> {
    let mut section = Section::default();
    let hot = Errors {
        name: "hot-errors",
        meaning: "the solver compared with hot beds of spheres, rms",
        folder: "cases/hot",
        source: OTHERS,
        with_use: false,
        quantities: &[T, K],
    };
    let unequal = Errors {
        name: "unequal-errors",
        meaning: "the solver compared with beds of unequal spheres, rms",
        folder: "cases/unequal",
        quantities: &[T, P, K],
        ..hot
    };
    errors(&mut section, root, &hot)?;
    errors(&mut section, root, &unequal)?;
    Ok(section)
}

/// The table of the beds in a folder: what its README says of each bed, and errors and scatter.
fn errors(section: &mut Section, root: &Path, of: &Errors) -> Result<(), DocsError> {
    let errors = Table::read(root, of.folder, "errors.csv")?;
    let about = Table::described(root, of.folder)?;
    let mut columns = about.columns.clone();
    if of.with_use {
        columns.push("use".to_string());
    }
    for [_, symbol, unit] in of.quantities {
        columns.extend([format!("{symbol} [{unit}]"), format!("scatter of {symbol}")]);
    }
    let mut rows = Vec::new();
    for line in 0..errors.rows.len() {
        let bed = format!("`{}`", errors.text(line, "scene")?);
        let mut row = about.rows[about.find(&[("bed", bed.as_str())])?].clone();
        if of.with_use {
            let purpose = errors.text(line, "use")?;
            let words = USES.iter().find(|(name, _)| *name == purpose);
            row.push(words.ok_or_else(|| errors.missing(purpose))?.1.to_string());
        }
        for [quantity, ..] in of.quantities {
            row.push(decimals(errors.number(line, &format!("{quantity}_error"))?, 2));
            row.push(decimals(errors.number(line, &format!("{quantity}_scatter"))?, 2));
        }
        rows.push(row);
    }
    let columns: Vec<&str> = columns.iter().map(String::as_str).collect();
    section.add_table(of.name, of.meaning, of.source, &columns, rows);
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

/// A file of comma-separated values, or a table of a README.
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

    /// The table in the README of a folder whose first column is `bed`.
    fn described(root: &Path, folder: &str) -> Result<Self, DocsError> {
        let file = format!("{folder}/README.md");
        let text = msdd_files::read_text(&root.join(&file))?;
        let cells = |line: &str| -> Vec<String> {
            line.trim_matches('|').split('|').map(|cell| cell.trim().to_string()).collect()
        };
        let mut lines = text.lines().skip_while(|line| !line.starts_with("| bed |"));
        let columns = lines.next().map(cells).unwrap_or_default();
        let rows = lines.skip(1).take_while(|line| line.starts_with('|')).map(cells).collect();
        Ok(Self { file, columns, rows })
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
