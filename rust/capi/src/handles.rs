//! The Rust types behind the opaque handles of the header.

use crate::model::BatchModel;
use crate::status::c_string;
use msdd_surrogate::spheres::{self, model::SphereModel};
use std::ffi::CString;
use std::sync::Arc;

/// Behind `msdd_surrogate`.
pub(crate) struct SurrogateHandle {
    pub model: Arc<dyn BatchModel>,
    pub hash: CString,
    pub description: CString,
    pub names: Vec<String>,
    /// The same names as C strings.
    pub state_names: Vec<CString>,
}

impl SurrogateHandle {
    pub fn new(model: Arc<dyn BatchModel>) -> Self {
        let names = model.state_names();
        Self {
            hash: c_string(model.hash()),
            description: c_string(&model.description().to_string()),
            state_names: names.iter().map(|name| c_string(name)).collect(),
            names,
            model,
        }
    }
}

/// Behind `msdd_spheres`.
pub(crate) struct SpheresHandle {
    pub model: SphereModel,
    pub hash: CString,
    pub description: CString,
    pub state_names: Vec<CString>,
}

impl SpheresHandle {
    pub fn new(model: SphereModel) -> Self {
        Self {
            hash: c_string(model.hash()),
            description: c_string(&model.to_json()),
            state_names: spheres::model::NAMES.map(c_string).to_vec(),
            model,
        }
    }
}

/// Behind `msdd_rve`.
#[derive(Clone)]
pub(crate) struct RveHandle {
    pub simulation: msdd_rve::Simulation,
}
