//! The Rust types behind the opaque handles of the header.

use crate::model::BatchModel;
use crate::status::c_string;
use std::ffi::CString;
use std::sync::Arc;

/// Behind `msdd_model`.
pub(crate) struct ModelHandle {
    pub model: Arc<dyn BatchModel>,
    pub hash: CString,
    pub description: CString,
    pub names: Vec<String>,
    /// The same names as C strings.
    pub state_names: Vec<CString>,
}

impl ModelHandle {
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

/// Behind `msdd_rve`.
#[derive(Clone)]
pub(crate) struct RveHandle {
    pub simulation: msdd_rve::Simulation,
}
