//! Errors of the model of spheres along paths, beside the scatter between packings.

use super::fit::scales;
use super::model::SphereModel;
use super::tensor::{contraction, deviator, mean};
use super::tracks::{Point, Track, follow};
use serde::Serialize;
use std::collections::BTreeMap;

/// Root mean squares over the states of the paths of one kind.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct PathErrors {
    pub name: String,
    pub paths: usize,
    pub states: usize,
    /// Of the pressure and the deviator along the path from the packed state on, over [`scales`].
    pub pressure: f64,
    pub deviator: f64,
    /// The deviator itself over the same, for comparison.
    pub size: f64,
    /// Relative, of the mean conductivity by contacts along the path.
    pub contact: f64,
    /// The same where solid fraction and stress are those of the box.
    pub contact_of_state: f64,
    /// Deviator of the conductivity by contacts over its mean, of the state.
    pub direction: f64,
    /// Relative, of the conductivity by gas at ln(R/h) = 8.5, of the state.
    pub gas_of_state: f64,
    /// Scatter of pressure, length of the deviator, and conductivity by contacts between packings that were made and strained alike; absent
    /// when there are none.
    pub noise: Option<[f64; 3]>,
}

/// Least p/E* of states whose conductivity is judged.
const LEAST_PRESSURE: f64 = 1e-7;

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
    let mut found = PathErrors { name: name.to_string(), paths: tracks.len(), ..PathErrors::default() };
    let (mut sums, mut conducting) = ([0.0; 7], 0usize);
    for track in tracks {
        let states = follow(law, track);
        for ((step, state), scale) in track.steps.iter().zip(&states[1..]).zip(scales(track)) {
            let (stress, data) = (law.stress(state), step.to.stress);
            let wrong = deviator(std::array::from_fn(|k| (stress[k] - data[k]) / scale));
            let size = deviator(data.map(|part| part / scale));
            found.states += 1;
            sums[0] += ((mean(stress) - mean(data)) / scale).powi(2);
            sums[1] += contraction(&wrong, &wrong);
            sums[2] += contraction(&size, &size);
            if mean(data) < LEAST_PRESSURE || mean(step.to.contact) <= 0.0 {
                continue;
            }
            conducting += 1;
            let known = law.start(step.to.solid, data);
            let (along, of_state) = (readout.contact(state, &stress), readout.contact(&known, &data));
            let contact = mean(step.to.contact);
            sums[3] += (mean(along) / contact - 1.0).powi(2);
            sums[4] += (mean(of_state) / contact - 1.0).powi(2);
            let wrong = deviator(std::array::from_fn(|k| {
                of_state[k] / mean(of_state) - step.to.contact[k] / contact
            }));
            sums[5] += contraction(&wrong, &wrong);
            sums[6] += (readout.gases(&known)[2] / step.to.gas[2] - 1.0).powi(2);
        }
    }
    let root = |sum: f64, count: usize| (sum / count.max(1) as f64).sqrt();
    [found.pressure, found.deviator, found.size] = [0, 1, 2].map(|k| root(sums[k], found.states));
    [found.contact, found.contact_of_state, found.direction, found.gas_of_state] =
        [3, 4, 5, 6].map(|k| root(sums[k], conducting));
    found.noise = noise(tracks);
    found
}

/// Scatter between packings of the same recipe at the same strain: half of the mean square of the differences of all pairs.
fn noise(tracks: &[&Track]) -> Option<[f64; 3]> {
    let (mut sums, mut count) = ([0.0; 3], 0usize);
    for (k, one) in tracks.iter().enumerate() {
        for other in tracks[k + 1..].iter().filter(|other| are_alike(one, other)) {
            let scales = scales(one).into_iter().zip(scales(other));
            for ((a, b), (first, second)) in one.steps.iter().zip(&other.steps).zip(scales) {
                let scale = 0.5 * (first + second);
                let (p, q) = difference(&a.to, &b.to);
                let contact = mean(a.to.contact) / mean(b.to.contact) - 1.0;
                if !contact.is_finite() {
                    continue;
                }
                count += 1;
                sums[0] += 0.5 * (p / scale).powi(2);
                sums[1] += 0.5 * (q / scale).powi(2);
                sums[2] += 0.5 * contact.powi(2);
            }
        }
    }
    (count > 0).then(|| sums.map(|sum| (sum / count as f64).sqrt()))
}

fn difference(a: &Point, b: &Point) -> (f64, f64) {
    let length = |point: &Point| {
        let part = deviator(point.stress);
        contraction(&part, &part).sqrt()
    };
    (mean(a.stress) - mean(b.stress), length(a) - length(b))
}

/// Whether two packings have the same recipe and the same strains, but for the names of the axes where packings have none.
fn are_alike(a: &Track, b: &Track) -> bool {
    let sorted = |step: &super::tracks::Step| {
        let mut normal = [step.stretch[0], step.stretch[1], step.stretch[2]];
        let mut shear = [step.stretch[3], step.stretch[4], step.stretch[5]];
        normal.sort_by(f64::total_cmp);
        shear.sort_by(f64::total_cmp);
        [normal, shear].concat()
    };
    let near = |a: f64, b: f64| (a - b).abs() < 1e-6 * (a.abs() + b.abs()) + 1e-15;
    a.packing != b.packing
        && a.recipe == b.recipe
        && !a.steps.is_empty()
        && !b.steps.is_empty()
        && a.steps.iter().zip(&b.steps).all(|(a, b)| {
            let alike = match a.stretch == b.stretch {
                true => true,
                false => sorted(a).into_iter().zip(sorted(b)).all(|(a, b)| near(a, b)),
            };
            alike && near(a.thermal, b.thermal)
        })
        && (a.is_isotropic || a.steps.iter().zip(&b.steps).all(|(a, b)| a.stretch == b.stretch))
}
