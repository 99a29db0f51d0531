//! What became of requests for an accuracy in the reference scenes, and how the error bands do there, from the tables of
//! `cases/scenes`.

use crate::{ReportError, read_text};
use std::path::Path;

/// One request.
#[derive(Clone, Debug, PartialEq)]
pub struct Request {
    pub scene: String,
    /// `calibrate`, `judge` or `outside`.
    pub purpose: String,
    /// Wanted accuracy [% of the range of T].
    pub asked: f64,
    /// What was offered instead, if it was refused [%].
    pub offered: Option<f64>,
    /// Error against the discs [%]; of a refused request the least of some runs.
    pub error: f64,
    /// Processor time over that of the cheapest run that would have done.
    pub cost: Option<f64>,
}

impl Request {
    /// Whether the error is within the request.
    pub fn met(&self) -> bool {
        self.error <= self.asked
    }
}

/// How the 90 % bands of a quantity do in the scenes of one kind.
#[derive(Clone, Debug, PartialEq)]
pub struct Band {
    pub quantity: String,
    pub purpose: String,
    /// Share of the discs' values inside, and that of the worst scene.
    pub inside: f64,
    pub worst: f64,
    /// Width over twice the standard deviation between packings.
    pub width: f64,
}

/// Both tables.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Judged {
    pub requests: Vec<Request>,
    pub bands: Vec<Band>,
}

impl Judged {
    /// Reads `requests.csv` and `bands.csv` in a folder.
    ///
    /// # Errors
    /// [`ReportError::File`], [`ReportError::Read`].
    pub fn read(folder: &Path) -> Result<Self, ReportError> {
        let request = |row: &Row| {
            let cost = row.number("processor_seconds").zip(row.number("cheapest_processor_seconds"));
            Some(Request {
                scene: row.text("scene")?,
                purpose: row.text("use")?,
                asked: row.number("asked")?,
                offered: row.number("best_offered"),
                error: row.number("error_discs")?,
                cost: cost.map(|(own, cheapest)| own / cheapest),
            })
        };
        let band = |row: &Row| {
            Some(Band {
                quantity: row.text("quantity")?,
                purpose: row.text("use")?,
                inside: row.number("inside")?,
                worst: row.number("inside_worst_scene")?,
                width: row.number("width")?,
            })
        };
        Ok(Self {
            requests: rows(&folder.join("requests.csv"), request)?,
            bands: rows(&folder.join("bands.csv"), band)?,
        })
    }
}

/// A line of a table with its head.
struct Row<'a> {
    head: Vec<&'a str>,
    cells: Vec<&'a str>,
}

impl Row<'_> {
    fn text(&self, column: &str) -> Option<String> {
        let k = self.head.iter().position(|name| *name == column)?;
        self.cells.get(k).map(ToString::to_string)
    }

    fn number(&self, column: &str) -> Option<f64> {
        self.text(column)?.parse().ok()
    }
}

fn rows<T>(file: &Path, read: impl Fn(&Row) -> Option<T>) -> Result<Vec<T>, ReportError> {
    let text = read_text(file)?;
    let mut lines = text.lines();
    let head: Vec<&str> = lines.next().unwrap_or_default().split(',').collect();
    let row = |line: &str| {
        read(&Row { head: head.clone(), cells: line.split(',').collect() })
            .ok_or_else(|| ReportError::Read { file: file.to_path_buf(), problem: format!("'{line}'") })
    };
    lines.map(row).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_shipped_tables_are_read() {
        let judged = Judged::read(&Path::new(env!("CARGO_MANIFEST_DIR")).join("../../cases/scenes")).unwrap();
        assert_eq!((judged.requests.len(), judged.bands.len()), (96, 12));
        assert!(judged.requests.iter().any(|request| request.offered.is_some()));
        assert!(
            judged
                .requests
                .iter()
                .all(|request| request.offered.is_none_or(|offered| offered > request.asked))
        );
        assert!(judged.bands.iter().all(|band| band.inside > 0.5 && band.inside <= 1.0));
    }
}
