//! Scores: all errors by which a model is judged, on packings that its training did not use.

use crate::SurrogateError;
use crate::composition::{self, Composed, Path, composed, state_of, states_of};
use crate::dataset::{self, Ramp, StateRow, strain_between};
use crate::kernel::LANES;
use crate::noise;
use crate::scores::r_squared;
use crate::surrogate::{Answer, Surrogate};
use crate::tracks::{PathErrors, ProbeErrors, Track};
use crate::training_data::TrainingData;
use serde::Serialize;

/// R² (Eq. 12) of single queries over pairs of jammed stops, mirror images included.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct OneStep {
    pub packings: usize,
    pub samples: usize,
    pub delta_porosity: f64,
    pub delta_fabric_index: f64,
    pub conductivity: f64,
    pub stress: f64,
}

/// Differences from the start after a strain and its return in as many increments each, relative to the start
/// (porosity: absolute).
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ThereAndBack {
    pub strain: f64,
    pub increments: u32,
    pub pressure: f64,
    pub conductivity: f64,
    pub porosity: f64,
}

/// Errors after the database's return from the end of a ramp to the radii of the packed state, in 500 increments.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct WayBack {
    /// "up_down" from +5 %, "down_up" from -5 %.
    pub ramp: String,
    pub errors: Composed,
}

/// Noise floor: the part of the end state that no function of the model's state at the start can predict, relative to
/// the root mean square of the data as in [`Composed`]. `None` when there are too few packings.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Floor {
    pub strain: f64,
    pub conductivity: Option<f64>,
    pub stress: Option<f64>,
    pub pressure: Option<f64>,
    pub porosity: Option<f64>,
    pub fabric_index: Option<f64>,
}

/// All scores of a model.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Score {
    pub kind: String,
    pub name: String,
    pub hash: String,
    /// Whether the packings were held out of the training. If not, the database is not that of the training, and all
    /// its packings are used.
    pub held_out: bool,
    pub training: Option<OneStep>,
    pub unseen: OneStep,
    pub composed: Vec<Composed>,
    pub there_and_back: Vec<ThereAndBack>,
    /// Empty when the database has no such ramps.
    pub way_back: Vec<WayBack>,
    pub noise_floor: Vec<Floor>,
    /// Empty for a model without tangent, or when the database has no periodic boxes.
    pub paths: Vec<PathErrors>,
    /// Errors of small strains; empty for a model without mechanics.
    pub probes: Vec<ProbeErrors>,
}

/// Strains after which composed errors are computed.
pub const STRAINS: [f64; 8] = [0.005, 0.01, 0.02, 0.05, -0.005, -0.01, -0.02, -0.05];
/// Numbers of increments in which the strains are applied.
pub const INCREMENTS: [u32; 5] = [1, 5, 50, 500, 5000];

/// Ramps that were used for training or validation, and those that were not.
pub struct Ramps {
    pub seen: Vec<Ramp>,
    pub unseen: Vec<Ramp>,
    /// Paths of strain that were not used.
    pub tracks: Vec<Track>,
}

/// Splits as the model's training did when it was trained on the database of this plan; for another database all ramps
/// are unseen.
///
/// # Errors
/// [`SurrogateError::Data`] for unusable rows.
pub fn ramps(model: &dyn Surrogate, data: &TrainingData, plan_hash: &str) -> Result<Ramps, SurrogateError> {
    let (all, tracks) = (dataset::ramps(&data.rows)?, data.tracks.clone());
    if model.training().database.plan_hash != plan_hash {
        return Ok(Ramps { seen: Vec::new(), unseen: all, tracks });
    }
    let seed = model.training().seed;
    if !model.has_tangent() {
        let split = dataset::split(all, seed)?;
        return Ok(Ramps { seen: split.training, unseen: split.test, tracks: Vec::new() });
    }
    let packings = data.split(seed)?;
    let split = packings.of(all);
    let tracks = tracks.into_iter().filter(|track| packings.test.contains(&track.packing)).collect();
    Ok(Ramps { seen: split.training, unseen: split.test, tracks })
}

/// Scores of a model.
pub fn score(model: &dyn Surrogate, ramps: &Ramps) -> Score {
    let all: Vec<Ramp> = ramps.seen.iter().chain(&ramps.unseen).cloned().collect(); // noise needs many
    let mut composed = Vec::new();
    for strain in STRAINS {
        let paths = composition::paths(&ramps.unseen, strain);
        if !paths.is_empty() {
            composed.extend(INCREMENTS.map(|n| composition::errors(model, &paths, strain, n)));
        }
    }
    Score {
        kind: model.kind().to_string(),
        name: model.name().to_string(),
        hash: model.hash().to_string(),
        held_out: !ramps.seen.is_empty(),
        training: (!ramps.seen.is_empty()).then(|| one_step(model, &ramps.seen)),
        unseen: one_step(model, &ramps.unseen),
        composed,
        there_and_back: [0.005, 0.02, -0.02].map(|e| there_and_back(model, &ramps.unseen, e, 500)).to_vec(),
        way_back: ["up_down", "down_up"]
            .iter()
            .filter_map(|name| way_back(model, &ramps.unseen, name))
            .collect(),
        paths: model.path_errors(&ramps.tracks),
        probes: model.probe_errors(&ramps.tracks),
        noise_floor: STRAINS.map(|strain| floor(model, &all, strain)).to_vec(),
    }
}

fn way_back(model: &dyn Surrogate, ramps: &[Ramp], name: &str) -> Option<WayBack> {
    let paths = composition::whole_paths(ramps, name);
    let strain = paths.first().map(|path| strain_between(path.from, path.to))?;
    Some(WayBack { ramp: name.to_string(), errors: composition::errors(model, &paths, strain, 500) })
}

/// Data and prediction of a single query for every pair of jammed stops, mirror images included: Δη, Δf, K, σ.
pub fn one_step_pairs(model: &dyn Surrogate, ramps: &[Ramp]) -> [Vec<[f64; 2]>; 4] {
    let mut pairs: [Vec<[f64; 2]>; 4] = Default::default();
    let mut all: Vec<Path> = Vec::new();
    for ramp in ramps {
        for (i, from) in ramp.states.iter().enumerate().filter(|(_, row)| row.load_bearing) {
            let later = ramp.states[i + 1..].iter().filter(|to| to.load_bearing);
            all.extend(later.map(|to| Path { from, to }));
        }
    }
    for chunk in all.chunks(LANES) {
        let from: Vec<&StateRow> = chunk.iter().map(|path| path.from).collect();
        let strain = std::array::from_fn(|lane| {
            chunk.get(lane).map_or(0.0, |path| strain_between(path.from, path.to))
        });
        let start = states_of(model, &from);
        let answer = model.block(&start, &strain);
        for (lane, path) in chunk.iter().enumerate() {
            let moved = |column: usize| answer.state[column][lane] - start[column][lane];
            pairs[0].push([path.to.porosity - path.from.porosity, moved(0)]);
            let fabric_index = path.to.fabric_index - path.from.fabric_index;
            pairs[1].extend([[fabric_index, moved(1)], [-fabric_index, -moved(1)]]);
            let data = composition::conductivity(model, path.to);
            pairs[2].extend([0, 1].map(|c| [data[c], answer.conductivity[c][lane]]));
            let data = [path.to.stress_xx, path.to.stress_yy];
            pairs[3].extend([0, 1].map(|c| [data[c], answer.stress[c][lane]]));
        }
    }
    pairs
}

/// R² on some ramps.
pub fn one_step(model: &dyn Surrogate, ramps: &[Ramp]) -> OneStep {
    let pairs = one_step_pairs(model, ramps);
    OneStep {
        packings: dataset::packings(ramps),
        samples: pairs[0].len(),
        delta_porosity: r_squared(&pairs[0]),
        delta_fabric_index: r_squared(&pairs[1]),
        conductivity: r_squared(&pairs[2]),
        stress: r_squared(&pairs[3]),
    }
}

fn there_and_back(model: &dyn Surrogate, ramps: &[Ramp], strain: f64, increments: u32) -> ThereAndBack {
    let packed: Vec<&StateRow> = ramps
        .iter()
        .filter(|ramp| ramp.name == "up")
        .filter_map(|ramp| ramp.states.first())
        .filter(|row| row.load_bearing)
        .collect();
    let mut sums = [[0.0; 2]; 3];
    for chunk in packed.chunks(LANES) {
        let start = states_of(model, chunk);
        let block = |state: &_, strain: &_| model.block(state, strain);
        let still = model.block(&start, &[0.0; LANES]);
        let there = composed(block, &start, &[strain; LANES], increments);
        let back = composed(block, &there.state, &[-strain / (1.0 + strain); LANES], increments);
        for (lane, porosity) in start[0].iter().enumerate().take(chunk.len()) {
            let pressure = |a: &Answer| a.stress[0][lane] + a.stress[1][lane];
            let mean = |a: &Answer| a.conductivity[0][lane] + a.conductivity[1][lane];
            let values = [
                [pressure(&back) - pressure(&still), pressure(&still)],
                [mean(&back) - mean(&still), mean(&still)],
                [back.state[0][lane] - porosity, 1.0],
            ];
            for (sum, value) in sums.iter_mut().zip(values) {
                sum[0] += value[0] * value[0];
                sum[1] += value[1] * value[1];
            }
        }
    }
    let [pressure, conductivity, porosity] = sums.map(|[error, value]| (error / value).sqrt());
    ThereAndBack { strain, increments, pressure, conductivity, porosity }
}

/// Number of increments of the paths from whose errors the noise floor is computed.
const FLOOR_INCREMENTS: u32 = 50;

/// Noise floor: the part of the model's errors that is not a smooth function of the start state, which no model of this
/// state can predict. The errors are used instead of the data itself, because the steep slopes of the data would hide
/// the noise. Each path counts twice, once turned by 90°.
fn floor(model: &dyn Surrogate, ramps: &[Ramp], strain: f64) -> Floor {
    let columns = model.state_names();
    let paths = composition::paths(ramps, strain);
    let ends = composition::ends(model, &paths, FLOOR_INCREMENTS);
    let (mut samples, mut squares): ([Vec<noise::Sample>; 5], [f64; 5]) = Default::default();
    for (path, [data, predicted]) in paths.iter().zip(&ends) {
        let state = state_of(model, path.from);
        for (sign, quantities) in [(1.0, [0, 2, 4, 5, 6]), (-1.0, [1, 3, 4, 5, 6])] {
            let coordinates = columns.iter().zip(state);
            let point: Vec<f64> = coordinates.map(|(name, v)| coordinate(name, v, sign)).collect();
            for (k, quantity) in quantities.into_iter().enumerate() {
                let turned = if quantity == 6 { sign } else { 1.0 };
                let error = turned * (predicted[quantity] - data[quantity]);
                samples[k].push((path.from.packing, point.clone(), error));
                squares[k] += data[quantity] * data[quantity];
            }
        }
    }
    let noise = |k: usize| noise::deviation(&scaled(&samples[k]));
    let relative = |k: usize| noise(k).map(|d| d / (squares[k] / samples[k].len() as f64).sqrt());
    Floor {
        strain,
        conductivity: relative(0),
        stress: relative(1),
        pressure: relative(2),
        porosity: noise(3),
        fabric_index: noise(4),
    }
}

/// A state variable, of the packing turned by 90° if `sign` is negative: what has a direction changes its sign.
fn coordinate(name: &str, value: f64, sign: f64) -> f64 {
    match name {
        "porosity" | "jamming_fraction" | "elastic_compression" | "strength" | "own_conductivity" => value,
        _ => sign * value,
    }
}

/// The coordinates divided by their standard deviation.
fn scaled(samples: &[noise::Sample]) -> Vec<noise::Sample> {
    let Some((_, first, _)) = samples.first() else { return Vec::new() };
    let count = samples.len() as f64;
    let scale: Vec<(f64, f64)> = (0..first.len())
        .map(|k| {
            let mean = samples.iter().map(|(_, x, _)| x[k]).sum::<f64>() / count;
            let square = samples.iter().map(|(_, x, _)| (x[k] - mean).powi(2)).sum::<f64>() / count;
            (mean, square.sqrt().max(1e-12))
        })
        .collect();
    let on = |x: &[f64]| x.iter().zip(&scale).map(|(x, (mean, scale))| (x - mean) / scale).collect();
    samples.iter().map(|(group, x, y)| (*group, on(x), *y)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::options::TrainingOptions;
    use crate::synthetic;
    use crate::tracks::Point;
    use crate::training::train;

    #[test]
    fn packings_without_thermal_ramps_do_not_change_what_was_held_out() {
        let mut data = TrainingData::from(synthetic::rows(20, 3));
        let options = TrainingOptions { max_epochs: 2, restarts: 1, ..TrainingOptions::default() };
        let (model, _) = train(&data, &options, |_| ()).expect("good rows");
        let held_out = |data: &TrainingData| -> Vec<i64> {
            let ramps = ramps(&model, data, &options.database.plan_hash).expect("good rows");
            ramps.unseen.iter().map(|ramp| ramp.packing).collect()
        };
        let before = held_out(&data);
        let packed = Point {
            porosity: 0.1,
            solid: 0.9,
            stress: [0.01, 0.01, 0.0],
            affine: [0.3, 0.3, 0.0],
            network: None,
            fabric_index: 0.0,
            fabric_shear: None,
            load_bearing: true,
        };
        data.tracks = (100..110)
            .map(|packing| Track { packing, name: "xx".to_string(), discs: 500, packed, steps: Vec::new() })
            .collect();
        assert_eq!(held_out(&data), before);
        assert!(data.split(options.seed).expect("enough").test.iter().any(|packing| *packing >= 100));
    }
}
