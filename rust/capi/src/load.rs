//! Which model a caller names.

use crate::discs::Discs;
use crate::model::BatchModel;
use crate::spheres::Spheres;
use crate::status::Failure;
use msdd_plugin::Plugin;
use msdd_surrogate::models;
use msdd_surrogate::spheres::model::SphereModel;
use std::path::Path;
use std::sync::Arc;

/// Start of a `source` that names a plug-in, a shared library.
const PLUGIN: &str = "plugin:";
/// The model of spheres in the library.
const SPHERES: &str = "builtin:spheres";

/// The model that a caller names.
pub(crate) fn load(source: &str) -> Result<Arc<dyn BatchModel>, Failure> {
    #[cfg(feature = "inject-panic")]
    assert_ne!(source, "panic", "injected");
    if let Some(path) = source.strip_prefix(PLUGIN) {
        return Ok(Arc::new(Plugin::load(Path::new(path))?));
    }
    let failed = |error| Failure::Model { path: source.to_string(), error };
    if source == SPHERES {
        return Ok(Arc::new(Spheres(SphereModel::builtin().map_err(failed)?)));
    }
    if source == models::BUILTIN || source.starts_with("builtin:") {
        return Ok(Arc::new(Discs(models::builtin(source).map_err(failed)?)));
    }
    let text =
        std::fs::read_to_string(source).map_err(|error| Failure::File { path: source.to_string(), error })?;
    match SphereModel::has_sphere_schema(&text) {
        true => Ok(Arc::new(Spheres(SphereModel::read(&text).map_err(failed)?))),
        false => Ok(Arc::new(Discs(models::read(&text).map_err(failed)?))),
    }
}
