//! The kinds of models by name. To add a kind, write a file next to this one and a line in [`MODELS`].

use crate::document::{field, schema};
use crate::options::TrainingOptions;
use crate::surrogate::{InitialData, Surrogate};
use crate::training_data::TrainingData;
use crate::{Model, SurrogateError, constant, increment, training};

/// A kind of model.
pub struct Kind {
    pub name: &'static str,
    pub about: &'static str,
    /// Largest number of epochs when none is given.
    pub epochs: u32,
    /// Schema of its files, without the version.
    schema: &'static str,
    pub train: fn(&TrainingData, &TrainingOptions) -> Trained,
    read: fn(&str) -> Trained,
}

/// A trained model, or the error.
pub type Trained = Result<Box<dyn Surrogate>, SurrogateError>;

/// Kind of model that is trained when none is named.
pub const DEFAULT: &str = "increment";

pub const MODELS: [Kind; 3] = [
    Kind {
        name: "constant",
        about: "nothing changes: mean conductivity and pressure of the packed states",
        epochs: 1,
        schema: "msdd-constant-model-",
        train: |data, options| Ok(Box::new(constant::train(&data.rows, options)?)),
        read: |text| Ok(Box::new(constant::read(text)?)),
    },
    Kind {
        name: "paper",
        about: "the paper's network, 3-16-16-6: increments of porosity and fabric; conductivity and stress as outputs",
        epochs: 200,
        schema: "msdd-model-",
        train: |data, options| Ok(Box::new(training::train(data, options, |_| ())?.0)),
        read: |text| Ok(Box::new(Model::from_json(text)?)),
    },
    Kind {
        name: "increment",
        about: "one law for thermal and mechanical strain: elastic energy, and sliding that remembers; 16 numbers of stress, 9 of porosity and fabric, 14 of each conductivity",
        epochs: increment::training::DEFAULT_EPOCHS,
        schema: "msdd-increment-model-",
        train: |data, options| Ok(Box::new(increment::training::train(data, options)?)),
        read: |text| Ok(Box::new(increment::model::read(text)?)),
    },
];

/// The kind of this name.
///
/// # Errors
/// [`SurrogateError::Option`], which lists the existing names.
pub fn kind(name: &str) -> Result<&'static Kind, SurrogateError> {
    MODELS.iter().find(|kind| kind.name == name).ok_or_else(|| SurrogateError::Option {
        key: "model",
        value: name.to_string(),
        allowed: "constant, paper, increment, spheres".into(),
    })
}

/// Name of the default model compiled into the library; the names of others are appended after a colon.
pub const BUILTIN: &str = "builtin";

/// Models compiled into the library: name and text of the file, the default first.
const SHIPPED: [(&str, &str); 2] = [
    ("increment", include_str!("../models/increment.json")),
    ("paper", include_str!("../models/paper.json")),
];

/// A model compiled into the library: `builtin`, `builtin:increment` or `builtin:paper`.
///
/// # Errors
/// [`SurrogateError::Option`], which lists the existing names.
pub fn builtin(name: &str) -> Trained {
    let wanted = name.strip_prefix(BUILTIN).map(|rest| rest.strip_prefix(':').unwrap_or(rest));
    let shipped = match wanted {
        Some("") => SHIPPED.first(),
        wanted => SHIPPED.iter().find(|(shipped, _)| wanted == Some(shipped)),
    };
    match shipped {
        Some((_, text)) => read(text),
        None => Err(SurrogateError::Option {
            key: "model",
            value: name.to_string(),
            allowed: "builtin, builtin:increment, builtin:paper, builtin:spheres".into(),
        }),
    }
}

/// Reads the text of a model file of any kind; the schema says which kind it is.
///
/// # Errors
/// [`SurrogateError::Damaged`], [`SurrogateError::Schema`] or [`SurrogateError::Field`].
pub fn read(text: &str) -> Trained {
    let found = schema(text)?;
    match MODELS.iter().find(|kind| found.starts_with(kind.schema)) {
        Some(kind) => {
            let model = (kind.read)(text)?;
            check_answers(model.as_ref())?;
            Ok(model)
        }
        None => Err(SurrogateError::Schema { found, expected: "msdd-{constant-,,increment-}model-1" }),
    }
}

/// Refuses a model whose answers are far from those of any packing of discs, as of a file with a digit changed.
fn check_answers(model: &dyn Surrogate) -> Result<(), SurrogateError> {
    for (porosity, [conductivity, stress]) in TESTS {
        for thermal in TEST_STRAINS {
            let known = InitialData { porosity, ..InitialData::default() };
            let answer = model.evaluate(&model.initial_state(&known), thermal);
            let along = |columns: &[crate::kernel::Lanes; 3]| [columns[0][0], columns[1][0]];
            for (key, values, ([least, most], allowed)) in [
                ("K/k of a test packing", along(&answer.conductivity), conductivity),
                ("reduced stress of a test packing", along(&answer.stress), stress),
            ] {
                if let Some(value) = values.into_iter().find(|value| !(least..=most).contains(value)) {
                    return field(key, value, allowed);
                }
            }
        }
    }
    Ok(())
}

/// Least and largest answer, and both as text.
type Range = ([f64; 2], &'static str);

/// Porosities of test packings, and between what their conductivities and stresses lie: those of the shipped models, 0.19 to 0.59 and
/// 0.02 to 0.14, by a factor of about 3 on either side. Slippery discs may carry no load at the larger porosities.
const TESTS: [(f64, [Range; 2]); 3] = [
    (0.08, [([0.15, 1.8], "0.15 to 1.8"), ([0.02, 0.4], "0.02 to 0.4")]),
    (0.12, [([0.01, 1.5], "0.01 to 1.5"), ([0.0, 0.3], "0 to 0.3")]),
    (0.16, [([0.01, 1.0], "0.01 to 1"), ([0.0, 0.2], "0 to 0.2")]),
];
const TEST_STRAINS: [f64; 4] = [0.0, 1e-3, 1e-2, 3e-2];

#[cfg(test)]
mod tests {
    use super::*;
    use crate::synthetic;

    fn trained(name: &str) -> Box<dyn Surrogate> {
        let tracks = increment::synthetic::tracks(10, 4);
        let data = TrainingData { rows: synthetic::rows(10, 4), tracks, ..TrainingData::default() };
        let options = TrainingOptions { max_epochs: 12, restarts: 2, ..TrainingOptions::default() };
        (kind(name).expect("listed").train)(&data, &options).expect("good rows")
    }

    #[test]
    fn every_kind_is_trained_and_read_back_by_its_name() {
        for listed in &MODELS {
            let model = trained(listed.name);
            assert_eq!(model.kind(), listed.name);
            let again = read(&model.to_json()).expect("own text");
            assert_eq!((again.kind(), again.hash()), (listed.name, model.hash()));
            assert_eq!(again.to_json(), model.to_json());
            let known = InitialData { porosity: 0.12, fabric_index: 0.02, ..InitialData::default() };
            let (a, b) = (model.initial_state(&known), again.initial_state(&known));
            assert_eq!(model.evaluate(&a, 0.003), again.evaluate(&b, 0.003));
            assert_eq!(model.state_names()[..2], ["porosity", "fabric_index"]);
            assert_eq!(a[..2], [0.12, 0.02]);
        }
    }

    #[test]
    fn absurd_answers_are_refused() {
        let mut constant: serde_json::Value =
            serde_json::from_str(&trained("constant").to_json()).expect("JSON");
        constant["conductivity"] = 60.0.into();
        let error = read(&constant.to_string()).err().expect("absurd").to_string();
        assert!(error.contains("K/k of a test packing = 60") && error.contains("0.15 to 1.8"), "{error}");
        SHIPPED.iter().for_each(|(name, text)| assert!(read(text).is_ok(), "{name}"));
    }

    #[test]
    fn unknown_names_and_files_are_refused() {
        assert!(kind("best").err().expect("unknown").to_string().contains("model = best"));
        let text = trained("increment").to_json();
        let newer = text.replace("msdd-increment-model-1", "msdd-increment-model-2");
        let message = |text: &str| read(text).err().expect("unsound").to_string();
        assert!(message(&newer).contains("msdd-increment-model-2"), "{}", message(&newer));
        assert!(message(&text.replace("msdd-increment-model-1", "other")).contains("\"other\""));
        assert!(message(&text[..text.len() / 2]).contains("damaged"));
    }
}
