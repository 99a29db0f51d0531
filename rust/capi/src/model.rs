//! What the exported functions need of a model, whoever made it: discs, spheres, or a plug-in.

use crate::columns::{Input, Output};
use crate::grains::Grains;
use crate::start::Start;
use crate::status::Failure;
use crate::step::Step;
use serde_json::Value;
use std::sync::Arc;

/// A model behind a handle. Functions work on whole batches and may fail, because the model may be a plug-in.
pub(crate) trait BatchModel: Send + Sync {
    fn name(&self) -> &str;
    /// SHA-256 of its file.
    fn hash(&self) -> &str;
    /// Description of the model for users, as a JSON object.
    fn description(&self) -> Value;
    fn state_names(&self) -> Vec<String>;
    /// Components of stress and strain: 3 in the plane, 6 in space.
    fn components(&self) -> usize;
    /// Kind of conductivity that it computes: "affine" or "network".
    fn conductivity(&self) -> &'static str;
    /// The kinds that it was trained for.
    fn conductivities(&self) -> Vec<&'static str> {
        vec![self.conductivity()]
    }
    /// A copy of the model that computes another kind; `None` if it was not trained for this kind.
    fn with_conductivity(&self, _kind: &str) -> Option<Arc<dyn BatchModel>> {
        None
    }
    fn has_tangent(&self) -> bool;
    /// Limit [-] and slip [mean radii].
    fn wall_friction(&self) -> Option<[f64; 2]> {
        None
    }
    /// Writes the initial state of cells.
    fn initial_state(&self, start: &Start, grains: &Grains, state: &[Output<f64>]) -> Result<(), Failure>;
    /// Takes all cells through a step; returns the number with an input outside the trained range.
    fn advance(&self, step: &Step, grains: &Grains) -> Result<usize, Failure>;
    /// Writes solid fractions of initial states; inputs are from 0 to 1.
    fn solid_fraction(&self, porosity: &Input, result: &Output<f64>) -> Result<(), Failure>;
}
