//! The trained surrogate Φ.

use crate::document::hash;
use crate::kernel::Lanes;
use crate::network::INPUTS;
use crate::predictor::{Block, Prediction, Predictor};
use crate::report::Provenance;
use crate::solid_fraction::SolidFraction;

/// A trained surrogate Φ (the paper's network); immutable.
#[derive(Clone, Debug, PartialEq)]
pub struct Model {
    pub name: String,
    pub predictor: Predictor,
    pub solid_fraction: SolidFraction,
    pub provenance: Provenance,
    pub(crate) hash: String,
}

impl Model {
    /// A model fresh from training.
    pub(crate) fn new(
        name: String,
        predictor: Predictor,
        solid_fraction: SolidFraction,
        provenance: Provenance,
    ) -> Self {
        let mut model = Self { name, predictor, solid_fraction, provenance, hash: String::new() };
        model.hash = hash(&model.to_json());
        model
    }

    /// SHA-256 of the file that the model was read from, or of [`Model::to_json`] for a new one; 64 hexadecimal digits.
    pub fn hash(&self) -> &str {
        &self.hash
    }

    /// Evaluates a block of cells: [`Predictor::block`].
    pub fn block(&self, inputs: &[Lanes; INPUTS]) -> Block {
        self.predictor.block(inputs)
    }

    /// Evaluates one cell: [`Predictor::evaluate`].
    pub fn evaluate(&self, porosity: f64, fabric_index: f64, thermal_strain: f64) -> Prediction {
        self.predictor.evaluate(porosity, fabric_index, thermal_strain)
    }

    /// Solid fraction by the sum of disc areas [-] (overlaps count twice) of an initial state of this porosity.
    pub fn solid_fraction(&self, porosity: f64) -> f64 {
        self.solid_fraction.at(porosity)
    }
}
