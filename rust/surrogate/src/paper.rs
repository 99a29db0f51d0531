//! The paper's network as a [`Surrogate`]: its state is (η, f), and K and σ are outputs of each step.

use crate::increment::readout::CONDUCTIVITY_FLOOR;
use crate::kernel::LANES;
use crate::model::Model;
use crate::options::TrainingOptions;
use crate::surrogate::{Answer, Increment, MAX_STATE, StateLanes, Surrogate, Tangent};

impl Surrogate for Model {
    fn kind(&self) -> &'static str {
        "paper"
    }

    fn name(&self) -> &str {
        &self.name
    }

    fn hash(&self) -> &str {
        Model::hash(self)
    }

    fn training(&self) -> &TrainingOptions {
        &self.provenance.training
    }

    fn to_json(&self) -> String {
        Model::to_json(self)
    }

    fn advance(&self, state: &StateLanes, strain: &Increment, answer: &mut Answer, _: Option<&mut Tangent>) {
        let block = Model::block(self, &[state[0], state[1], strain.thermal]);
        let zero = [0.0; LANES];
        // The network's own lower limit is zero, but the heat equation needs a positive conductivity.
        let [kxx, kyy] = [block.conductivity_xx, block.conductivity_yy]
            .map(|lanes| lanes.map(|value| value.max(CONDUCTIVITY_FLOOR)));
        *answer = Answer {
            state: *state,
            conductivity: [kxx, kyy, zero],
            stress: [block.stress_xx, block.stress_yy, zero],
            outside: [zero; MAX_STATE + 1],
        };
        let increments = [block.delta_porosity, block.delta_fabric_index];
        for (column, increment) in answer.state.iter_mut().zip(increments) {
            for lane in 0..LANES {
                column[lane] += increment[lane];
            }
        }
        let inputs = [(0, state[0]), (1, state[1]), (MAX_STATE, strain.thermal)];
        for ((column, values), range) in inputs.into_iter().zip(self.predictor.range.inputs()) {
            answer.outside[column] = values.map(|value| value - range.clamp(value));
        }
    }

    fn solid_fraction(&self, porosity: f64) -> f64 {
        Model::solid_fraction(self, porosity)
    }

    fn packed_porosities(&self) -> [f64; 2] {
        let range = self.solid_fraction.porosity;
        [range.min, range.max]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::surrogate::InitialData;

    #[test]
    fn gives_the_networks_answers() {
        let model = Model::builtin().expect("the shipped model is sound");
        let direct = Model::evaluate(&model, 0.13, 0.02, 0.001);
        let state = |porosity, fabric_index| {
            Surrogate::initial_state(
                &model,
                &InitialData { porosity, fabric_index, ..InitialData::default() },
            )
        };
        let answer = Surrogate::evaluate(&model, &state(0.13, 0.02), 0.001);
        assert_eq!(answer.state[0][3], 0.13 + direct.delta_porosity);
        assert_eq!(
            (answer.conductivity[1][0], answer.stress[0][7]),
            (direct.conductivity_yy, direct.stress_xx)
        );
        assert!(answer.inside(0));
        let far = Surrogate::evaluate(&model, &state(0.5, 0.0), -0.2);
        assert!(far.outside[0][0] > 0.2 && far.outside[MAX_STATE][0] < -0.1 && !far.inside(0));
    }
}
