//! The trained state model as a [`Surrogate`].

use super::mean::MeanState;
use super::rates::Rates;
use super::readout::Readout;
use super::variables::{ConductivityKind, FABRIC_INDEX, FeatureRanges, POROSITY, PRESSURE, Variables};
use crate::kernel::Lanes;
use crate::perceptron::Neurons;
use crate::region::{Region, Spread};
use crate::solid_fraction::SolidFraction;
use crate::surrogate::{Answer, Doubt, Known, MAX_STATE, StateLanes, Surrogate};
use crate::training::TrainingOptions;

/// State model; see [`super`].
#[derive(Clone, Debug, PartialEq)]
pub struct StateModel {
    pub core: Core,
    pub mean: MeanState,
    pub region: Region,
    pub spread: Spread,
    pub solid_fraction: SolidFraction,
    pub mechanics: Option<crate::mechanics::Mechanics>,
    pub wall_friction: Option<crate::wall_friction::WallFriction>,
    pub name: String,
    pub provenance: super::file::Provenance,
    pub(crate) hash: String,
}

/// The part that answers queries.
#[derive(Clone, Debug, PartialEq)]
pub struct Core {
    pub variables: Variables,
    pub ranges: FeatureRanges,
    pub rates: Rates,
    /// One for each kind of conductivity in the database; the first is the default.
    pub readouts: Vec<Readout>,
    /// Which of them answers.
    pub active: usize,
}

impl Core {
    /// As [`Surrogate::block`].
    pub fn block(&self, state: &StateLanes, strain: &Lanes) -> Answer {
        let mut neurons = Neurons::new();
        let (variables, ranges) = (self.variables, &self.ranges);
        let features = ranges.features(variables, state, strain);
        let next = self.rates.advanced(variables, state, strain, &features, &mut neurons);
        let features = ranges.features(variables, &next, strain);
        let (conductivity, stress) =
            self.readouts[self.active].answer(variables, &next, &features, &mut neurons);
        Answer { state: next, conductivity, stress, outside: ranges.outside(variables, state, strain) }
    }
}

impl StateModel {
    /// The same model that answers with another kind of conductivity; `None` when it was not trained.
    pub fn with_conductivity(mut self, kind: ConductivityKind) -> Option<Self> {
        self.core.active = self.core.readouts.iter().position(|readout| readout.kind == kind)?;
        Some(self)
    }
}

impl Surrogate for StateModel {
    fn kind(&self) -> &'static str {
        "state"
    }

    fn name(&self) -> &str {
        &self.name
    }

    fn hash(&self) -> &str {
        &self.hash
    }

    fn training(&self) -> &TrainingOptions {
        &self.provenance.training.common
    }

    fn conductivity_kind(&self) -> ConductivityKind {
        self.core.readouts[self.core.active].kind
    }

    fn mechanics(&self) -> Option<&crate::mechanics::Mechanics> {
        self.mechanics.as_ref()
    }

    fn wall_friction(&self) -> Option<&crate::wall_friction::WallFriction> {
        self.wall_friction.as_ref()
    }

    fn to_json(&self) -> String {
        super::file::text(self)
    }

    fn state_names(&self) -> &[&'static str] {
        self.core.variables.names()
    }

    fn initial_state(&self, known: &Known) -> [f64; MAX_STATE] {
        let variables = self.core.variables;
        let stress = known.reduced_stress.map(|[xx, yy]| {
            let pressure = (0.5 * (xx + yy)).max(0.0);
            [pressure, (0.5 * (xx - yy)).clamp(-pressure, pressure)]
        });
        let filled = self.mean.filled(known.porosity, known.fabric_index, known.fabric_conductivity, stress);
        let mut state = [0.0; MAX_STATE];
        state[POROSITY] = known.porosity;
        state[FABRIC_INDEX] = known.fabric_index;
        state[PRESSURE] = filled.pressure;
        if let Some(column) = variables.fabric_conductivity() {
            state[column] = filled.fabric_conductivity;
        }
        if let Some(column) = variables.deviator() {
            state[column] = filled.deviator;
        }
        state
    }

    fn block(&self, state: &StateLanes, strain: &Lanes) -> Answer {
        self.core.block(state, strain)
    }

    fn doubt(&self, state: &[f64; MAX_STATE]) -> Option<Doubt> {
        let point = self.core.ranges.coordinates(self.core.variables, state);
        let [conductivity_spread, pressure_rate_spread] = self.spread.at(state[PRESSURE]);
        Some(Doubt {
            beyond_hull: self.region.beyond_hull(&point),
            distance: self.region.distance(&point),
            conductivity_spread,
            pressure_rate_spread,
        })
    }

    fn solid_fraction(&self, porosity: f64) -> f64 {
        self.solid_fraction.at(porosity)
    }
}
