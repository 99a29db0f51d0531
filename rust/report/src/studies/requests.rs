//! What became of requests for an accuracy in the reference scenes, and how the error bands do there, from the tables of
//! `cases/scenes`.

use crate::{ReportError, rows};
use serde::{Deserialize, Serialize};
use std::path::Path;

/// One request.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Request {
    pub scene: String,
    /// `calibrate`, `judge` or `outside`.
    #[serde(alias = "use")]
    pub purpose: String,
    /// Wanted accuracy [% of the range of T].
    pub asked: f64,
    /// What was offered instead, if it was refused [%].
    #[serde(alias = "best_offered")]
    pub offered: Option<f64>,
    /// Error against the discs [%]; of a refused request the least of some runs.
    #[serde(alias = "error_discs")]
    pub error: f64,
    /// Processor time, and that of the cheapest run that would have done \[s\].
    processor_seconds: Option<f64>,
    cheapest_processor_seconds: Option<f64>,
}

impl Request {
    /// Processor time over that of the cheapest run that would have done.
    pub fn cost(&self) -> Option<f64> {
        Some(self.processor_seconds? / self.cheapest_processor_seconds?)
    }

    /// Whether the error is within the request.
    pub fn met(&self) -> bool {
        self.error <= self.asked
    }
}

/// What became of the requests for one accuracy in the scenes of one kind.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Tally {
    pub purpose: String,
    /// Wanted accuracy [% of the range of T].
    pub asked: f64,
    /// Number of requests that were not refused, and of those among them that were met.
    pub kept: usize,
    pub met: usize,
    /// Number of requests that were refused, and of those among them that could have been met.
    pub refused: usize,
    pub possible: usize,
    /// Processor time over that of the cheapest run that would have done, in the median and at most.
    pub cost: Option<f64>,
    pub highest_cost: Option<f64>,
}

/// What became of requests: by kinds of scenes in the order of the table, the loosest accuracy first.
pub fn tallies(requests: &[Request]) -> Vec<Tally> {
    let mut purposes: Vec<&str> = Vec::new();
    for request in requests {
        if !purposes.contains(&request.purpose.as_str()) {
            purposes.push(&request.purpose);
        }
    }
    let mut accuracies: Vec<f64> = requests.iter().map(|request| request.asked).collect();
    accuracies.sort_by(|a, b| b.total_cmp(a));
    accuracies.dedup();
    let of = |purpose: &str, asked: f64| {
        let own = requests.iter().filter(|request| request.purpose == purpose && request.asked == asked);
        let (refused, kept): (Vec<_>, Vec<_>) = own.partition(|request| request.offered.is_some());
        let met = |list: &[&Request]| list.iter().filter(|request| request.met()).count();
        let mut costs: Vec<f64> = kept.iter().filter_map(|request| request.cost()).collect();
        costs.sort_by(f64::total_cmp);
        Tally {
            purpose: purpose.to_string(),
            asked,
            kept: kept.len(),
            met: met(&kept),
            refused: refused.len(),
            possible: met(&refused),
            cost: costs.get(costs.len() / 2).copied(),
            highest_cost: costs.last().copied(),
        }
    };
    purposes.iter().flat_map(|purpose| accuracies.iter().map(|&asked| of(purpose, asked))).collect()
}

/// How the 90 % bands of a quantity do in the scenes of one kind.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Band {
    pub quantity: String,
    #[serde(alias = "use")]
    pub purpose: String,
    /// Share of the discs' values inside, and that of the worst scene.
    pub inside: f64,
    #[serde(alias = "inside_worst_scene")]
    pub worst: f64,
    /// Width over twice the standard deviation between packings.
    pub width: f64,
}

/// Both tables.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
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
        Ok(Self { requests: rows(&folder.join("requests.csv"))?, bands: rows(&folder.join("bands.csv"))? })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn requests_are_counted_by_kind_and_accuracy() {
        let request = |purpose: &str, asked, offered, error, cost| Request {
            scene: String::new(),
            purpose: purpose.to_string(),
            asked,
            offered,
            error,
            processor_seconds: cost,
            cheapest_processor_seconds: Some(1.0),
        };
        let requests = [
            request("judge", 1.0, None, 0.5, Some(1.0)),
            request("judge", 1.0, None, 1.5, Some(3.0)),
            request("judge", 1.0, Some(2.0), 0.5, None),
            request("judge", 1.0, Some(2.0), 1.5, None),
            request("outside", 5.0, None, 1.0, None),
        ];
        let all = tallies(&requests);
        let expected = Tally {
            purpose: "judge".to_string(),
            asked: 1.0,
            kept: 2,
            met: 1,
            refused: 2,
            possible: 1,
            cost: Some(3.0),
            highest_cost: Some(3.0),
        };
        let order: Vec<(&str, f64)> = all.iter().map(|tally| (tally.purpose.as_str(), tally.asked)).collect();
        assert_eq!(order, [("judge", 5.0), ("judge", 1.0), ("outside", 5.0), ("outside", 1.0)]);
        assert_eq!(all[1], expected);
        assert_eq!((all[2].kept, all[2].met, all[2].cost), (1, 1, None));
    }

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
