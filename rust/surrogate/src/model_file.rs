//! The file of the paper's network: JSON with a version; every number is kept to the last bit.

use crate::document::{field, hash, json, schema};
use crate::network::{Network, WEIGHT_LIMIT, WEIGHTS};
use crate::predictor::Predictor;
use crate::report::Provenance;
use crate::scaling::{OutputScales, Range, TrainedRange};
use crate::solid_fraction::SolidFraction;
use crate::{Model, SurrogateError};
use serde::{Deserialize, Serialize};

/// Name of the schema. Its number is increased when a reader of the old schema would misread the new one.
pub const SCHEMA: &str = "msdd-model-1";

#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct ModelFile {
    /// `msdd-model-1`.
    schema: String,
    /// Name of the model.
    name: String,
    /// Smallest and largest value of each input.
    trained_range: TrainedRange,
    /// Ranges by which the outputs are scaled.
    output_scales: OutputScales,
    /// Sum of the areas of grains over area, for a porosity that counts overlaps once.
    solid_fraction: SolidFraction,
    /// `library_version`, options and report of the training.
    provenance: Provenance,
    /// Weights of the network.
    weights: Vec<f64>,
}

#[derive(Serialize)]
struct Description<'a> {
    schema: &'a str,
    name: &'a str,
    hash: &'a str,
    trained_range: &'a TrainedRange,
    solid_fraction: &'a SolidFraction,
    provenance: &'a Provenance,
}

impl Model {
    /// The model compiled into the library.
    ///
    /// # Errors
    /// Those of [`Model::from_json`]; a test checks that there are none.
    pub fn builtin() -> Result<Self, SurrogateError> {
        Self::from_json(include_str!("../models/paper.json"))
    }

    /// Reads the text of a model file.
    ///
    /// # Errors
    /// [`SurrogateError::Damaged`], [`SurrogateError::Schema`] or [`SurrogateError::Field`].
    pub fn from_json(text: &str) -> Result<Self, SurrogateError> {
        read(text)
    }

    /// Text of the model file; [`Model::hash`] is its SHA-256. Reading it gives this model, bit for bit.
    pub fn to_json(&self) -> String {
        text(self)
    }

    /// Everything about the model except its weights, as one JSON object.
    pub fn description(&self) -> String {
        description(self)
    }
}

fn text(model: &Model) -> String {
    let file = ModelFile {
        schema: SCHEMA.to_string(),
        name: model.name.clone(),
        trained_range: model.predictor.range,
        output_scales: model.predictor.scales,
        solid_fraction: model.solid_fraction.clone(),
        provenance: model.provenance.clone(),
        weights: model.predictor.network.weights.to_vec(),
    };
    json(&file) + "\n"
}

fn description(model: &Model) -> String {
    json(&Description {
        schema: SCHEMA,
        name: &model.name,
        hash: &model.hash,
        trained_range: &model.predictor.range,
        solid_fraction: &model.solid_fraction,
        provenance: &model.provenance,
    })
}

fn read(text: &str) -> Result<Model, SurrogateError> {
    let damaged = |error: serde_json::Error| SurrogateError::Damaged(error.to_string());
    let found = schema(text)?;
    if found != SCHEMA {
        return Err(SurrogateError::Schema { found, expected: SCHEMA });
    }
    let file: ModelFile = serde_json::from_str(text).map_err(damaged)?;
    file.check()?;
    Ok(Model {
        name: file.name,
        predictor: Predictor {
            network: Network::from_slice(&file.weights),
            range: file.trained_range,
            scales: file.output_scales,
        },
        solid_fraction: file.solid_fraction,
        provenance: file.provenance,
        hash: hash(text),
    })
}

impl ModelFile {
    fn check(&self) -> Result<(), SurrogateError> {
        if self.weights.len() != WEIGHTS {
            return field("weights (count)", self.weights.len(), "438");
        }
        for (index, weight) in self.weights.iter().enumerate() {
            if weight.is_nan() || weight.abs() > WEIGHT_LIMIT {
                return field(&format!("weights[{index}]"), weight, "-1e9 to 1e9");
            }
        }
        let TrainedRange { porosity, fabric_index, thermal_strain } = self.trained_range;
        let OutputScales { delta_porosity_per_strain, delta_fabric_index_per_strain, conductivity, stress } =
            self.output_scales;
        check_range("trained_range.porosity", porosity, 0.0, 1.0, "0 <= min < max <= 1")?;
        check_range("trained_range.fabric_index", fabric_index, -1.0, 1.0, "-1 <= min < max <= 1")?;
        check_range("trained_range.thermal_strain", thermal_strain, -0.9, 1.0, "-0.9 <= min < max <= 1")?;
        check_range("output_scales.conductivity", conductivity, 0.0, 1e3, "0 <= min < max <= 1e3")?;
        check_range("output_scales.stress", stress, 0.0, 1e3, "0 <= min < max <= 1e3")?;
        check_range(
            "solid_fraction.porosity",
            self.solid_fraction.porosity,
            0.0,
            1.0,
            "0 <= min < max <= 1",
        )?;
        for (key, scale) in [
            ("output_scales.delta_porosity_per_strain", delta_porosity_per_strain),
            ("output_scales.delta_fabric_index_per_strain", delta_fabric_index_per_strain),
        ] {
            if !(scale > 0.0 && scale <= 1e3) {
                return field(key, scale, "above 0, to 1e3");
            }
        }
        let coefficients = &self.solid_fraction.coefficients;
        if coefficients.is_empty() || coefficients.iter().any(|c| c.is_nan() || c.abs() > WEIGHT_LIMIT) {
            return field(
                "solid_fraction.coefficients",
                format!("{coefficients:?}"),
                "numbers from -1e9 to 1e9",
            );
        }
        Ok(())
    }
}

fn check_range(
    key: &str,
    range: Range,
    low: f64,
    high: f64,
    allowed: &'static str,
) -> Result<(), SurrogateError> {
    let Range { min, max } = range;
    if low <= min && min < max && max <= high {
        Ok(())
    } else {
        field(key, format!("{min} to {max}"), allowed)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn builtin() -> Model {
        Model::builtin().expect("the shipped model is sound")
    }

    #[test]
    fn round_trip_is_exact() {
        let model = builtin();
        let again = Model::from_json(&model.to_json()).expect("own text");
        assert_eq!(again, Model { hash: again.hash.clone(), ..model });
        assert_eq!(again.hash, hash(&again.to_json()));
        assert_eq!(again.hash.len(), 64);
    }

    #[test]
    fn bad_files_are_refused_with_the_reason() {
        let good: serde_json::Value = serde_json::from_str(&builtin().to_json()).expect("JSON");
        let with = |pointer: &str, value: serde_json::Value| {
            let mut changed = good.clone();
            *changed.pointer_mut(pointer).expect("key") = value;
            read(&changed.to_string()).expect_err(pointer).to_string()
        };
        let refused = |pointer: &str, value: serde_json::Value, expected: &str| {
            let message = with(pointer, value);
            assert!(message.contains(expected), "{pointer}: {message}");
        };
        refused("/schema", "msdd-model-2".into(), "\"msdd-model-2\", this library reads \"msdd-model-1\"");
        refused("/weights/7", 1e300.into(), "weights[7]");
        refused("/weights", vec![0.5; 437].into(), "437");
        refused("/trained_range/porosity/max", (-1.0).into(), "trained_range.porosity");
        refused("/output_scales/delta_porosity_per_strain", 0.into(), "delta_porosity_per_strain = 0");
        refused("/solid_fraction/coefficients", Vec::<f64>::new().into(), "coefficients");
        let mut extra = good.clone();
        extra["surprise"] = 1.into();
        assert!(read(&extra.to_string()).expect_err("unknown key").to_string().contains("surprise"));
        let text = good.to_string();
        let cut = read(&text[..text.len() / 2]).expect_err("cut short").to_string();
        assert!(cut.contains("damaged") && cut.contains("EOF"), "{cut}");
    }
}
