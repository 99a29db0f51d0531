//! What the opaque handles of the header are.

use crate::status::c_string;
use msdd_surrogate::Surrogate;
use serde_json::{Value, json};
use std::ffi::CString;

/// Behind `msdd_surrogate`.
pub(crate) struct SurrogateHandle {
    pub model: Box<dyn Surrogate>,
    pub hash: CString,
    pub description: CString,
    pub state_names: Vec<CString>,
}

impl SurrogateHandle {
    pub fn new(model: Box<dyn Surrogate>) -> Self {
        Self {
            hash: c_string(model.hash()),
            description: c_string(&description(&*model).to_string()),
            state_names: model.state_names().iter().map(|name| c_string(name)).collect(),
            model,
        }
    }
}

/// What a user would ask about a model; of its file, what is not weights.
fn description(model: &dyn Surrogate) -> Value {
    let file: Value = serde_json::from_str(&model.to_json()).unwrap_or_default();
    json!({
        "kind": model.kind(),
        "name": model.name(),
        "hash": model.hash(),
        "state": model.state_names(),
        "conductivity": model.conductivity_kind(),
        "mechanics": model.mechanics(),
        "wall_friction": model.wall_friction(),
        "schema": file["schema"],
        "provenance": file["provenance"],
    })
}

/// Behind `msdd_rve`.
#[derive(Clone)]
pub(crate) struct RveHandle {
    pub simulation: msdd_rve::Simulation,
}
