//! Errors of the models when a strain is divided into many increments, by the number of increments.

use crate::jobs::job::Job;
use crate::plan;
use serde::Serialize;
use serde_json::Value;

/// Error of a model by the number of increments. If it grows, the model drifts: errors of increments add up.
#[derive(Clone, Debug, Serialize)]
pub struct Drift {
    pub model: String,
    pub strain: f64,
    /// Number of increments, rms error of the stress [%].
    pub stress: Vec<[f64; 2]>,
}

const STRAINS: [f64; 3] = [0.02, -0.02, -0.05];
/// Scores of the shipped models.
pub fn score() -> Job {
    let [first, second] = super::elements::MODELS;
    let database = "cases/database/full.csv.gz";
    let run = format!("score --model {first} --model {second} --database {database} --json WORK/score.json");
    let inputs = [first, second, database, "rust/surrogate/src", "rust/rve/src"];
    plan::command(&run, &inputs, Some("score.json"), 600)
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn scores_are_read() {
        let score =
            r#"[{"name": "increment", "composed": [{"strain": -0.02, "increments": 5, "stress": 0.02}]}]"#;
        assert_eq!(drift(score)[1].stress, [[5.0, 2.0]]);
    }
}
