//! The part of the paper's network that answers queries.

use crate::kernel::{LANES, Lanes};
use crate::network::{INPUTS, Network};
use crate::scaling::{OutputScales, TrainedRange};

/// The part of a model that answers queries: network, trained range and scales.
#[derive(Clone, Debug, PartialEq)]
pub struct Predictor {
    pub network: Network,
    pub range: TrainedRange,
    pub scales: OutputScales,
}

/// Answers for a block of cells; [`Prediction`] describes the fields.
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

impl Predictor {
    /// Evaluates a block of cells with the inputs porosity η^n [-], fabric index f^n [-], and thermal strain ε^n [-]
    /// (radial, relative to the current radii). Finite inputs give finite answers. The answer of a lane depends on that
    /// lane alone.
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

    /// Evaluates one cell with inputs as in [`Predictor::block`]; gives the same bits.
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
