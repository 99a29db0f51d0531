//! Errors of the model of spheres along paths, compared with the scatter between packings.

use super::errors::{Errors, MIN_PRESSURE, Sums};
use super::fit::scales;
use super::model::SphereModel;
use super::noise::{noise, pairs};
use super::state::{PackingData, State};
use super::tensor::{contraction, deviator, mean};
use super::tracks::{Track, follow, follow_from};
use serde::Serialize;
use std::collections::BTreeMap;

/// Root mean squares over the states of the paths of one kind.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct PathErrors {
    pub name: String,
    pub paths: usize,
    pub states: usize,
    /// Along the path from the packed state on, of which solid fraction, stress, number of contacts and fabric are known.
    pub along: Errors,
    /// The same where solid fraction, stress and the mobilised part of the friction alone are known.
    pub of_stress_alone: Errors,
    /// The deviator itself over the same as its error, for comparison.
    pub size: f64,
    /// Relative, of the mean conductivity by contacts where solid fraction, stress, number of contacts and fabric are those of the box.
    pub contact_of_state: f64,
    /// The same of the deviator of the conductivity by contacts over its mean; NaN where this is not known.
    pub direction: f64,
    /// The same of the conductivity by gas at ln(R/h) = 8.5, relative; NaN where this is not known.
    pub gas_of_state: f64,
    /// Scatter between packings that were made and strained equally; absent when there are none.
    pub noise: Option<Errors>,
    /// Errors along the paths of those packings, over the same states.
    pub beside_noise: Option<Errors>,
}

/// Errors by kind of path, in the order of the names.
pub fn score(model: &SphereModel, tracks: &[Track]) -> Vec<PathErrors> {
    let mut kinds: BTreeMap<&str, Vec<&Track>> = BTreeMap::new();
    for track in tracks {
        kinds.entry(&track.name).or_default().push(track);
    }
    kinds.into_iter().map(|(name, tracks)| errors(model, name, &tracks)).collect()
}

fn errors(model: &SphereModel, name: &str, tracks: &[&Track]) -> PathErrors {
    let (law, readout) = (&model.file.law, &model.file.readout);
    let (mut all, mut alone) = (Sums::default(), Sums::default());
    let (mut size, mut of_state) = (0.0, [0.0; 3]);
    for track in tracks {
        add(&mut all, model, track, &follow(law, track));
        let packed = law.start(
            track.packed.solid - track.aside,
            track.packed.stress,
            &PackingData { mobilised: Some(track.packed.mobilised), ..PackingData::default() },
        );
        add(&mut alone, model, track, &follow_from(law, track, packed));
        for (step, scale) in track.steps.iter().zip(scales(track)) {
            let part = deviator(step.to.stress.map(|part| part / scale));
            size += contraction(&part, &part);
            let (to, contact) = (&step.to, step.to.compared(&step.to.contact));
            if mean(to.stress) < MIN_PRESSURE || contact <= 0.0 {
                continue;
            }
            let known = to.state(law);
            let found = readout.contact(&law.contacts, &known, &to.stress);
            let wrong = deviator(std::array::from_fn(|k| found[k] / mean(found) - to.contact[k] / contact));
            let gas = to.gas_error(readout, &known);
            of_state[0] += (to.compared(&found) / contact - 1.0).powi(2);
            of_state[1] += contraction(&wrong, &wrong);
            of_state[2] += gas * gas;
        }
    }
    let mut beside = Sums::default();
    let pairs = pairs(tracks);
    for pair in &pairs {
        add(&mut beside, model, pair.one, &follow(law, pair.one)[..=pair.states()]);
    }
    let [contact_of_state, direction, gas_of_state] =
        of_state.map(|sum| (sum / all.conducting().max(1) as f64).sqrt());
    PathErrors {
        name: name.to_string(),
        paths: tracks.len(),
        states: all.states(),
        along: all.errors().unwrap_or_default(),
        of_stress_alone: alone.errors().unwrap_or_default(),
        size: (size / all.states().max(1) as f64).sqrt(),
        contact_of_state,
        direction,
        gas_of_state,
        noise: noise(&pairs),
        beside_noise: beside.errors(),
    }
}

/// Adds the errors of a model's states along a track.
fn add(sums: &mut Sums, model: &SphereModel, track: &Track, states: &[State]) {
    let (law, readout) = (&model.file.law, &model.file.readout);
    for ((step, state), scale) in track.steps.iter().zip(&states[1..]).zip(scales(track)) {
        let (stress, data) = (law.stress(state), step.to.stress);
        let wrong = deviator(std::array::from_fn(|k| (stress[k] - data[k]) / scale));
        let pressure = (mean(stress) - mean(data)) / scale;
        sums.add_stress([pressure * pressure, contraction(&wrong, &wrong)]);
        let known = step.to.compared(&step.to.contact);
        if mean(data) >= MIN_PRESSURE && known > 0.0 {
            let contact = step.to.compared(&readout.contact(&law.contacts, state, &stress)) / known - 1.0;
            let gas = step.to.gas_error(readout, &track.of_packing(state));
            sums.add_conductivity([contact * contact, gas * gas]);
        }
    }
}
