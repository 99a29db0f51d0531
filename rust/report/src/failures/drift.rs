//! Errors of the neural networks when a strain is divided into many increments, by the number of increments and of neurons.

use crate::jobs::execute::{Outcome, THEN};
use crate::jobs::job::{Job, ToolJob};
use crate::jobs::pool::Records;
use crate::settings::Settings;
use serde::Serialize;
use serde_json::Value;

/// Error of a network by the number of increments. If it grows, the network drifts: errors of increments add up.
#[derive(Clone, Debug, Serialize)]
pub struct Drift {
    pub model: String,
    pub strain: f64,
    /// Number of increments, rms error of the stress [%].
    pub stress: Vec<[f64; 2]>,
}

/// Errors of state networks of one size, on packings that were not used in training.
#[derive(Clone, Debug, Serialize)]
pub struct Depth {
    /// Neurons in the hidden layers of the network for the rates, and of the readout.
    pub neurons: [usize; 2],
    pub strain: f64,
    /// Rms error of the stress [%] in one increment, and in the largest number of increments.
    pub once: f64,
    pub composed: f64,
}

const STRAINS: [f64; 3] = [0.02, -0.02, -0.05];
/// Sizes of the networks; the shipped model has the second one.
const SIZES: [[usize; 2]; 4] = [[2, 2], [4, 4], [8, 8], [16, 16]];

pub fn jobs() -> Vec<Job> {
    std::iter::once(score()).chain(SIZES.map(sized)).collect()
}

/// Runs `msdd` with these arguments; the result are the scores that it writes.
fn scored(arguments: &[&str], inputs: &[&str], limit: u64) -> Job {
    let sources = ["rust/surrogate/src", "rust/rve/src"];
    Job::Tool(ToolJob {
        arguments: arguments.iter().map(|text| (*text).to_string()).collect(),
        inputs: inputs.iter().chain(&sources).map(|text| (*text).to_string()).collect(),
        output: Some("score.json".to_string()),
        limit,
    })
}

pub fn score() -> Job {
    let models = ["rust/surrogate/models/increment.json", "rust/surrogate/models/paper.json"];
    let database = "cases/database/full.csv.gz";
    let arguments = ["score", "--model", models[0], "--model", models[1], "--database", database];
    scored(&[&arguments[..], &["--json", "WORK/score.json"]].concat(), &[models[0], models[1], database], 600)
}

/// Trains a network of this size, then scores it.
fn sized([hidden, readout]: [usize; 2]) -> Job {
    let database = "cases/database/periodic.csv.gz";
    let (hidden, readout) = (hidden.to_string(), readout.to_string());
    let train =
        ["train", "--model", "state", "--name", "state", "--database", database, "--out", "WORK/model.json"];
    let size = ["--hidden", &hidden, "--readout", &readout, THEN];
    let score = ["score", "--model", "WORK/model.json", "--database", database, "--json", "WORK/score.json"];
    scored(&[&train[..], &size, &score].concat(), &[database], 1200)
}

fn rows(model: &Value, strain: f64) -> Vec<[f64; 2]> {
    let number = |entry: &Value, key: &str| entry[key].as_f64().unwrap_or(f64::NAN);
    let composed = model["composed"].as_array().cloned().unwrap_or_default();
    let rows = composed.iter().filter(|entry| (number(entry, "strain") - strain).abs() < 1e-9);
    rows.map(|e| [number(e, "increments"), 100.0 * number(e, "stress")]).collect()
}

pub fn drift(text: &str) -> Vec<Drift> {
    let models: Vec<Value> = serde_json::from_str(text).unwrap_or_default();
    let name = |model: &Value| model["name"].as_str().unwrap_or("?").to_string();
    let of = |model: &Value| {
        STRAINS.map(|strain| Drift { model: name(model), strain, stress: rows(model, strain) })
    };
    models.iter().flat_map(of).collect()
}

pub fn depth(settings: &Settings, records: &Records) -> Vec<Depth> {
    let mut list = Vec::new();
    for neurons in SIZES {
        let record = settings.record(records, &sized(neurons)).filter(|r| r.outcome == Outcome::Done);
        let text = record.and_then(|record| record.file.as_deref()).unwrap_or("[]");
        for one in drift(text) {
            if let (Some(first), Some(last)) = (one.stress.first(), one.stress.last()) {
                list.push(Depth { neurons, strain: one.strain, once: first[1], composed: last[1] });
            }
        }
    }
    list
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn scores_are_read() {
        let score =
            r#"[{"name": "state", "composed": [{"strain": -0.02, "increments": 5, "stress": 0.02}]}]"#;
        assert_eq!(drift(score)[1].stress, [[5.0, 2.0]]);
    }
}
