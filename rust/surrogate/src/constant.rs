//! The trivial surrogate, in which nothing changes: what a simulation without a microscale would assume.

use crate::SurrogateError;
use crate::dataset::StateRow;
use crate::document::{field, hash, json, schema};
use crate::kernel::LANES;
use crate::options::TrainingOptions;
use crate::solid_fraction::SolidFraction;
use crate::surrogate::{Answer, Increment, MAX_STATE, StateLanes, Surrogate, Tangent};
use serde::{Deserialize, Serialize};

/// Name of the schema. Its number is increased when a reader of the old schema would misread the new one.
pub const SCHEMA: &str = "msdd-constant-model-1";

/// Mean conductivity and pressure of the packed states, without anisotropy.
#[derive(Clone, Debug, PartialEq)]
pub struct ConstantModel {
    file: File,
    hash: String,
}

#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct File {
    schema: String,
    name: String,
    /// K/k.
    conductivity: f64,
    /// p ℓ/(E r̄).
    pressure: f64,
    solid_fraction: SolidFraction,
    training: TrainingOptions,
}

/// Takes the means over the packed states (stop 0).
///
/// # Errors
/// [`SurrogateError::Data`] without packed states.
pub fn train(rows: &[StateRow], options: &TrainingOptions) -> Result<ConstantModel, SurrogateError> {
    options.check()?;
    let solid_fraction = SolidFraction::fit(rows)?;
    let packed: Vec<&StateRow> = rows.iter().filter(|row| row.stop == 0).collect();
    let mean = |value: fn(&StateRow) -> f64| {
        packed.iter().map(|row| value(row)).fold(0.0, |a, b| a + b) / packed.len() as f64
    };
    let file = File {
        schema: SCHEMA.to_string(),
        name: options.name.clone(),
        conductivity: mean(|row| 0.5 * (row.conductivity_xx + row.conductivity_yy)),
        pressure: mean(|row| 0.5 * (row.stress_xx + row.stress_yy)),
        solid_fraction,
        training: TrainingOptions { threads: 0, ..options.clone() },
    };
    file.check()?;
    let hash = hash(&(json(&file) + "\n"));
    Ok(ConstantModel { file, hash })
}

/// Reads the text of a constant model's file.
///
/// # Errors
/// [`SurrogateError::Damaged`], [`SurrogateError::Schema`] or [`SurrogateError::Field`].
pub fn read(text: &str) -> Result<ConstantModel, SurrogateError> {
    let found = schema(text)?;
    if found != SCHEMA {
        return Err(SurrogateError::Schema { found, expected: SCHEMA });
    }
    let file: File =
        serde_json::from_str(text).map_err(|error| SurrogateError::Damaged(error.to_string()))?;
    file.check()?;
    Ok(ConstantModel { file, hash: hash(text) })
}

impl File {
    fn check(&self) -> Result<(), SurrogateError> {
        for (key, value) in [("conductivity", self.conductivity), ("pressure", self.pressure)] {
            if !(value > 0.0 && value <= 1e3) {
                return field(key, value, "above 0, to 1e3");
            }
        }
        self.solid_fraction.check()
    }
}

impl Surrogate for ConstantModel {
    fn kind(&self) -> &'static str {
        "constant"
    }

    fn name(&self) -> &str {
        &self.file.name
    }

    fn hash(&self) -> &str {
        &self.hash
    }

    fn training(&self) -> &TrainingOptions {
        &self.file.training
    }

    fn to_json(&self) -> String {
        json(&self.file) + "\n"
    }

    fn advance(&self, state: &StateLanes, _: &Increment, answer: &mut Answer, _: Option<&mut Tangent>) {
        let [k, p, zero] = [self.file.conductivity, self.file.pressure, 0.0].map(|value| [value; LANES]);
        *answer = Answer {
            state: *state,
            conductivity: [k, k, zero],
            stress: [p, p, zero],
            outside: [zero; MAX_STATE + 1],
        };
    }

    fn solid_fraction(&self, porosity: f64) -> f64 {
        self.file.solid_fraction.at(porosity)
    }

    fn packed_porosities(&self) -> [f64; 2] {
        let range = self.file.solid_fraction.porosity;
        [range.min, range.max]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::synthetic;

    #[test]
    fn is_the_mean_and_survives_its_file() {
        let rows = synthetic::rows(5, 2);
        let model = train(&rows, &TrainingOptions::default()).expect("good rows");
        let mut state = [0.0; MAX_STATE];
        state[..2].copy_from_slice(&[0.11, 0.03]);
        let answer = model.evaluate(&state, 0.04);
        assert_eq!(answer.state.map(|lanes| lanes[2]), state);
        let packed: Vec<_> = rows.iter().filter(|row| row.stop == 0).collect();
        let mean =
            packed.iter().map(|r| 0.5 * (r.stress_xx + r.stress_yy)).sum::<f64>() / packed.len() as f64;
        assert!((answer.stress[0][0] - mean).abs() < 1e-15);
        assert_eq!(read(&model.to_json()).expect("own text"), model);
        let wrong = model.to_json().replace(SCHEMA, "msdd-constant-model-2");
        assert!(read(&wrong).expect_err("newer").to_string().contains("msdd-constant-model-2"));
    }
}
