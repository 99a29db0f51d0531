//! The trained surrogate Φ.

use crate::SurrogateError;
use crate::kernel::{LANES, Lanes};
use crate::model_file::{self, Provenance};
use crate::network::{INPUTS, Network};
use crate::scaling::{OutputScales, TrainedRange};
use crate::solid_fraction::SolidFraction;

/// A trained surrogate; immutable.
#[derive(Clone, Debug, PartialEq)]
pub struct Model {
    pub name: String,
    pub predictor: Predictor,
    pub solid_fraction: SolidFraction,
    pub provenance: Provenance,
    pub(crate) hash: String,
}

/// The part of a model that answers queries.
#[derive(Clone, Debug, PartialEq)]
pub struct Predictor {
    pub network: Network,
    pub range: TrainedRange,
    pub scales: OutputScales,
}

/// Answers for a block of cells; see [`Prediction`] for the fields.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Block {
    pub delta_porosity: Lanes,
    pub delta_fabric_index: Lanes,
    pub conductivity_xx: Lanes,
    pub conductivity_yy: Lanes,
    pub stress_xx: Lanes,
    pub stress_yy: Lanes,
    pub clamped: [bool; LANES],
}

/// Answer for one cell (Algorithm 1, step 1).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Prediction {
    /// η^{n+1} − η^n [-]; exactly 0 for zero strain.
    pub delta_porosity: f64,
    /// f^{n+1} − f^n [-]; exactly 0 for zero strain.
    pub delta_fabric_index: f64,
    /// K_xx^{n+1} / k [-].
    pub conductivity_xx: f64,
    /// K_yy^{n+1} / k [-].
    pub conductivity_yy: f64,
    /// σ_xx^{n+1} ℓ / (E r̄) [-], compression positive, never negative.
    pub stress_xx: f64,
    /// σ_yy^{n+1} ℓ / (E r̄) [-].
    pub stress_yy: f64,
    /// An input was outside the trained range and was clamped to it.
    pub clamped: bool,
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
        model.hash = model_file::hash(&model.to_json());
        model
    }

    /// The model compiled into the library.
    ///
    /// # Errors
    /// Those of [`Model::from_json`]; a test guards against them.
    pub fn builtin() -> Result<Self, SurrogateError> {
        Self::from_json(include_str!("../models/paper.json"))
    }

    /// Reads the text of a model file.
    ///
    /// # Errors
    /// [`SurrogateError::Damaged`], [`SurrogateError::Schema`] or [`SurrogateError::Field`].
    pub fn from_json(text: &str) -> Result<Self, SurrogateError> {
        model_file::read(text)
    }

    /// Text of the model file; [`Model::hash`] is its SHA-256. Reading it gives this model, bit for bit.
    pub fn to_json(&self) -> String {
        model_file::text(self)
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

    /// Solid fraction with overlaps counted twice [-] of an initial state of this porosity.
    pub fn solid_fraction(&self, porosity: f64) -> f64 {
        self.solid_fraction.at(porosity)
    }

    /// All about the model but its weights, as one JSON object.
    pub fn description(&self) -> String {
        model_file::description(self)
    }
}

impl Predictor {
    /// Evaluates a block of cells: porosity η^n [-], fabric index f^n [-], thermal strain ε^n [-] (radial, relative to the
    /// current radii). Finite inputs give finite answers. A lane's answer depends on that lane alone.
    pub fn block(&self, inputs: &[Lanes; INPUTS]) -> Block {
        let (inputs, clamped) = self.range.clamp(inputs);
        let outputs = self.network.activations(&self.range.scaled(&inputs)).outputs;
        let [delta_porosity, delta_fabric_index, conductivity_xx, conductivity_yy, stress_xx, stress_yy] =
            self.scales.physical(&inputs[2], &outputs);
        Block {
            delta_porosity,
            delta_fabric_index,
            conductivity_xx,
            conductivity_yy,
            stress_xx,
            stress_yy,
            clamped,
        }
    }

    /// Evaluates one cell; inputs as in [`Predictor::block`], the same bits.
    pub fn evaluate(&self, porosity: f64, fabric_index: f64, thermal_strain: f64) -> Prediction {
        let block = self.block(&[[porosity; LANES], [fabric_index; LANES], [thermal_strain; LANES]]);
        Prediction {
            delta_porosity: block.delta_porosity[0],
            delta_fabric_index: block.delta_fabric_index[0],
            conductivity_xx: block.conductivity_xx[0],
            conductivity_yy: block.conductivity_yy[0],
            stress_xx: block.stress_xx[0],
            stress_yy: block.stress_yy[0],
            clamped: block.clamped[0],
        }
    }
}
