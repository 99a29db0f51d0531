//! The trait that all surrogate models implement. A model is immutable once it is made, and several threads may query
//! it at the same time.

use crate::dataset::ConductivityKind;
use crate::kernel::{LANES, Lanes};
use crate::options::TrainingOptions;
use crate::tracks::{PathErrors, ProbeErrors, Track};
use crate::wall_friction::WallFriction;

/// Largest number of state variables of any model.
pub const MAX_STATE: usize = 13;

/// State columns of a block of cells; those beyond the model's [`Surrogate::state_names`] are zero.
pub type StateLanes = [Lanes; MAX_STATE];

/// Strain of a block of cells: relative growth of the radii, above −1, and strain of the cell, extension positive; xy is
/// 2 e_xy. `rotation` is the angle by which the cell turns, counter-clockwise positive \[rad\].
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Increment {
    pub thermal: Lanes,
    pub xx: Lanes,
    pub yy: Lanes,
    pub xy: Lanes,
    pub rotation: Lanes,
}

impl Increment {
    /// Grains that grow in cells that keep their shape.
    pub fn thermal(strain: &Lanes) -> Self {
        Self { thermal: *strain, ..Self::default() }
    }
}

/// −dσ̃/de for σ̃_xx, σ̃_yy, σ̃_xy (first index) and e_xx, e_yy, 2 e_xy (second), at the end of a strain.
pub type Tangent = [[Lanes; 3]; 3];

/// What is known of a cell at the start. The stress is reduced: σ ℓ/(E r̄), ℓ = 1 m, compression positive.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct InitialData {
    /// η [-], overlaps counted once.
    pub porosity: f64,
    /// f = F_xx − F_yy [-].
    pub fabric_index: f64,
    /// F_xy [-].
    pub fabric_xy: f64,
    /// σ_xx, σ_yy, σ_xy [-].
    pub reduced_stress: Option<[f64; 3]>,
    /// K_xx/k, K_yy/k, K_xy/k.
    pub conductivity: Option<[f64; 3]>,
}

/// Answer for a block of cells.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Answer {
    /// State after the strain. For zero strain and a state that the model allows, it equals the state before, bit for
    /// bit.
    pub state: StateLanes,
    /// K_xx/k, K_yy/k, K_xy/k [-] of the state after; positive in every direction.
    pub conductivity: [Lanes; 3],
    /// σ ℓ/(E r̄) [-] of the state after: xx, yy, xy, compression positive, without tension in any direction.
    pub stress: [Lanes; 3],
    /// For each state column, then for the thermal strain: distance outside of the trained range, in the unit of the
    /// column, negative below and positive above; 0 inside.
    pub outside: [Lanes; MAX_STATE + 1],
}

impl Answer {
    /// Whether all inputs of a lane were in the trained range.
    pub fn inside(&self, lane: usize) -> bool {
        self.outside.iter().all(|column| column[lane] == 0.0)
    }

    /// Which lanes had an input outside the trained range.
    pub fn lanes_outside(&self) -> [bool; LANES] {
        let mut all = [0.0; LANES];
        for column in &self.outside {
            for (sum, beyond) in all.iter_mut().zip(column) {
                *sum += beyond.abs();
            }
        }
        all.map(|sum| sum != 0.0)
    }
}

/// Measures of how reliable the answer for a cell is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Uncertainty {
    /// Distance outside of the convex region of the training states, in half widths of the trained range; 0 inside.
    pub beyond_hull: f64,
    /// Distance to the nearest training state, over the spacing of the training states; above 1 there was none near the
    /// cell.
    pub distance: f64,
    /// Relative standard deviation of K between packings of equal state [-].
    pub conductivity_spread: f64,
    /// Standard deviation between packings of equal state of dp̃/dε [-], the growth of the reduced pressure.
    pub pressure_rate_spread: f64,
}

/// A surrogate of granular RVEs: state and thermal strain in, state, conductivity and stress out.
pub trait Surrogate: Send + Sync {
    /// Name of the kind of model in [`crate::models::MODELS`].
    fn kind(&self) -> &'static str;
    /// Name given at the training.
    fn name(&self) -> &str;
    /// Options of the training: the seed determines which packings were held out, the provenance names the database.
    fn training(&self) -> &TrainingOptions;
    /// The kind of conductivity that the answers contain.
    fn conductivity_kind(&self) -> ConductivityKind {
        ConductivityKind::Affine
    }
    /// The kinds of conductivity that the model can answer with.
    fn conductivity_kinds(&self) -> Vec<ConductivityKind> {
        vec![self.conductivity_kind()]
    }
    /// The same model, answering with another kind of conductivity; `None` when it was not trained for that.
    fn answering_with(&self, _kind: ConductivityKind) -> Option<Box<dyn Surrogate>> {
        None
    }
    /// Whether cells may be strained mechanically, with a tangent.
    fn has_tangent(&self) -> bool {
        false
    }
    /// Errors along paths of strain; none for a model without [`Surrogate::has_tangent`].
    fn path_errors(&self, _tracks: &[Track]) -> Vec<PathErrors> {
        Vec::new()
    }
    /// Errors of small strains; none for a model without [`Surrogate::has_tangent`].
    fn probe_errors(&self, _tracks: &[Track]) -> Vec<ProbeErrors> {
        Vec::new()
    }
    /// Wall friction; none when the database had no wall-shear runs.
    fn wall_friction(&self) -> Option<&WallFriction> {
        None
    }
    /// SHA-256 of the model's file, 64 hexadecimal digits.
    fn hash(&self) -> &str;
    /// Text of the model file; reading it gives this model, bit for bit.
    fn to_json(&self) -> String;
    /// Names of the state columns, in order; at most [`MAX_STATE`]. The first two are porosity and fabric_index.
    fn state_names(&self) -> &[&'static str] {
        &["porosity", "fabric_index"]
    }
    /// The state of a cell at the start. Of its quantities, at least η and f are known; those that are not known are
    /// set to the mean of packed states.
    fn initial_state(&self, known: &InitialData) -> [f64; MAX_STATE] {
        let mut state = [0.0; MAX_STATE];
        state[..2].copy_from_slice(&[known.porosity, known.fabric_index]);
        state
    }
    /// Strains a block of cells. Finite inputs give finite answers; the answer of a lane depends on that lane alone. A model
    /// without [`Surrogate::has_tangent`] uses the thermal strain alone and leaves `tangent` as it is; others write it.
    fn advance(
        &self,
        state: &StateLanes,
        strain: &Increment,
        answer: &mut Answer,
        tangent: Option<&mut Tangent>,
    );
    /// Reliability of the answer for one cell; `None` when the model contains no data for it. Slower than an
    /// evaluation.
    fn uncertainty(&self, _state: &[f64; MAX_STATE]) -> Option<Uncertainty> {
        None
    }
    /// Sum-of-areas solid fraction [-] of a packed state of this porosity.
    fn solid_fraction(&self, porosity: f64) -> f64;
    /// Least and largest porosity [-] of the packed states of the training.
    fn packed_porosities(&self) -> [f64; 2];

    /// The answer after a thermal strain of the cells.
    fn block(&self, state: &StateLanes, strain: &Lanes) -> Answer {
        let mut answer = Answer::default();
        self.advance(state, &Increment::thermal(strain), &mut answer, None);
        answer
    }

    /// Evaluates one cell; gives the same bits as in any block.
    fn evaluate(&self, state: &[f64; MAX_STATE], strain: f64) -> Answer {
        self.block(&state.map(|value| [value; LANES]), &[strain; LANES])
    }
}
