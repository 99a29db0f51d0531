//! The file of a state model: JSON with a version; every number is kept to the last bit.

use super::core::Core;
use super::mean::MeanState;
use super::model::StateModel;
use super::provenance::Provenance;
use super::rates::{self, Rates};
use super::readout::Readout;
use super::variables::{FeatureRanges, Variables};
use crate::SurrogateError;
use crate::document::{field, hash, json, schema};
use crate::mechanics::Mechanics;
use crate::network::WEIGHT_LIMIT;
use crate::perceptron::{Perceptron, weight_count};
use crate::region::{Region, Spread};
use crate::scaling::Range;
use crate::solid_fraction::SolidFraction;
use crate::wall_friction::WallFriction;
use serde::{Deserialize, Serialize};

/// Name of the schema. Its number is increased when a reader of the old schema would misread the new one.
pub const SCHEMA: &str = "msdd-state-model-1";

#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct File {
    schema: String,
    name: String,
    variables: Variables,
    ranges: FeatureRanges,
    rates: Rates,
    /// The first is the one that answers.
    readouts: Vec<Readout>,
    mean_state: MeanState,
    region: Region,
    spread: Spread,
    solid_fraction: SolidFraction,
    mechanics: Option<Mechanics>,
    wall_friction: Option<WallFriction>,
    provenance: Provenance,
}

impl StateModel {
    /// Text of the model file.
    pub(crate) fn text(&self) -> String {
        let model = self.clone();
        json(&File {
            schema: SCHEMA.to_string(),
            name: model.name,
            variables: model.core.variables,
            ranges: model.core.ranges,
            rates: model.core.rates,
            readouts: model.core.readouts,
            mean_state: model.mean,
            region: model.region,
            spread: model.spread,
            solid_fraction: model.solid_fraction,
            mechanics: model.mechanics,
            wall_friction: model.wall_friction,
            provenance: model.provenance,
        }) + "\n"
    }
}

/// Reads the text of a state model's file.
///
/// # Errors
/// [`SurrogateError::Damaged`], [`SurrogateError::Schema`] or [`SurrogateError::Field`].
pub fn read(text: &str) -> Result<StateModel, SurrogateError> {
    let found = schema(text)?;
    if found != SCHEMA {
        return Err(SurrogateError::Schema { found, expected: SCHEMA });
    }
    let file: File =
        serde_json::from_str(text).map_err(|error| SurrogateError::Damaged(error.to_string()))?;
    file.check()?;
    let core = Core {
        variables: file.variables,
        ranges: file.ranges,
        rates: file.rates,
        readouts: file.readouts,
        active: 0,
    };
    Ok(StateModel {
        core,
        mean: file.mean_state,
        region: file.region,
        spread: file.spread,
        solid_fraction: file.solid_fraction,
        mechanics: file.mechanics,
        wall_friction: file.wall_friction,
        name: file.name,
        provenance: file.provenance,
        hash: hash(text),
    })
}

impl File {
    fn check(&self) -> Result<(), SurrogateError> {
        let hidden = |network: &Perceptron| {
            let sizes = &network.sizes;
            sizes.get(1..sizes.len().saturating_sub(1)).unwrap_or_default().to_vec()
        };
        let expected = rates::sizes(self.variables, &hidden(&self.rates.network));
        check_network("rates.network", &self.rates.network, &expected)?;
        if self.readouts.is_empty() {
            return field("readouts (count)", 0, "1 or more");
        }
        for (index, readout) in self.readouts.iter().enumerate() {
            let carried = readout.carried && self.variables.fabric_conductivity;
            if carried != readout.carried {
                return field(&format!("readouts[{index}].carried"), true, "false: the state has no f_K");
            }
            let expected = Readout::sizes(self.variables, carried, &hidden(&readout.network));
            check_network(&format!("readouts[{index}].network"), &readout.network, &expected)?;
            check_number(&format!("readouts[{index}].offset"), readout.offset)?;
            check_number(&format!("readouts[{index}].scale"), readout.scale)?;
        }
        for (k, value) in self.rates.offset.iter().chain(&self.rates.scale).enumerate() {
            check_number(&format!("rates.offset and scale, number {k}"), *value)?;
        }
        check_number("rates.unjamming_porosity", self.rates.unjamming_porosity)?;
        let FeatureRanges {
            porosity,
            fabric_index,
            pressure,
            fabric_conductivity,
            stress_ratio,
            thermal_strain,
        } = self.ranges;
        for (key, Range { min, max }, low, high) in [
            ("porosity", porosity, 0.0, 1.0),
            ("fabric_index", fabric_index, -1.0, 1.0),
            ("pressure", pressure, 0.0, 1e3),
            ("fabric_conductivity", fabric_conductivity, -1.0, 1.0),
            ("stress_ratio", stress_ratio, -1.0, 1.0),
            ("thermal_strain", thermal_strain, -0.9, 1.0),
        ] {
            if !(low <= min && min < max && max <= high) {
                return field(
                    &format!("ranges.{key}"),
                    format!("{min} to {max}"),
                    "min < max, within what grains can have",
                );
            }
        }
        let Region { dimensions, support, states, spacing } = &self.region;
        let sound = *dimensions == self.variables.names().len()
            && support.len() == Region::support_count(*dimensions)
            && !states.is_empty()
            && *spacing > 0.0;
        if !sound {
            return field("region", format!("{dimensions} dimensions"), "that of the variables, with states");
        }
        let Spread { conductivity, pressure_rate, .. } = &self.spread;
        if conductivity.len() != Spread::BINS || pressure_rate.len() != Spread::BINS {
            return field("spread (bins)", conductivity.len(), "6");
        }
        self.check_laws()
    }

    /// Checks the laws that are fitted beside the networks: their numbers must be such that the answers are valid.
    fn check_laws(&self) -> Result<(), SurrogateError> {
        let (mean, spread) = (&self.mean_state, &self.spread);
        for (key, Range { min, max }) in
            [("mean_state.porosity", mean.porosity), ("spread.pressure", spread.pressure)]
        {
            if !(0.0 <= min && min <= max && max <= 1e3) {
                return field(key, format!("{min} to {max}"), "0 <= min <= max <= 1e3");
            }
        }
        for (key, value) in [("conductivity", &spread.conductivity), ("pressure_rate", &spread.pressure_rate)]
        {
            if let Some(value) = value.iter().find(|value| !(0.0..=WEIGHT_LIMIT).contains(*value)) {
                return field(&format!("spread.{key}"), value, "0 to 1e9");
            }
        }
        let mean_laws = [
            &mean.pressure[..],
            &mean.stress_ratio_of_fabric,
            &mean.stress_ratio_of_both,
            &mean.fabric_conductivity_of_fabric,
            &mean.fabric_conductivity_of_both,
        ];
        check_coefficients("mean_state", &mean_laws)?;
        self.solid_fraction.check()?;
        if let Some(m) = &self.mechanics {
            let laws = [&m.c11[..], &m.c12, &m.porosity, &m.fabric_index, &m.fabric_conductivity];
            check_coefficients("mechanics", &laws)?;
        }
        match &self.wall_friction {
            Some(law) if !(law.limit.abs() <= 1e3 && law.slip > 0.0 && law.slip <= 1e6) => {
                let found = format!("limit {}, slip {}", law.limit, law.slip);
                field("wall_friction", found, "limit to 1e3, slip above 0, to 1e6")
            }
            _ => Ok(()),
        }
    }
}

fn check_coefficients(key: &str, laws: &[&[f64]]) -> Result<(), SurrogateError> {
    match laws.iter().copied().flatten().find(|value| value.is_nan() || value.abs() > WEIGHT_LIMIT) {
        Some(value) => field(&format!("{key} (a coefficient)"), value, "-1e9 to 1e9"),
        None => Ok(()),
    }
}

fn check_number(key: &str, value: f64) -> Result<(), SurrogateError> {
    if value.abs() <= 1e6 { Ok(()) } else { field(key, value, "-1e6 to 1e6") }
}

fn check_network(key: &str, network: &Perceptron, expected: &[usize]) -> Result<(), SurrogateError> {
    if network.sizes != expected || !crate::perceptron::shape_is_sound(expected) {
        return field(
            &format!("{key}.sizes"),
            format!("{:?}", network.sizes),
            "inputs and outputs of the variables, one or two hidden layers of 1 to 16",
        );
    }
    if network.weights.len() != weight_count(expected) {
        let allowed = "as many as the sizes ask for";
        return field(&format!("{key}.weights (count)"), network.weights.len(), allowed);
    }
    match network.weights.iter().position(|w| w.is_nan() || w.abs() > WEIGHT_LIMIT) {
        None => Ok(()),
        Some(index) => field(&format!("{key}.weights[{index}]"), network.weights[index], "-1e9 to 1e9"),
    }
}
