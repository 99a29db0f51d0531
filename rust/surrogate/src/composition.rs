//! Composition: a strain applied in many increments, as a solver does, and the errors at its end.

use crate::dataset::{Ramp, StateRow, strain_between};
use crate::kernel::{LANES, Lanes};
use crate::surrogate::{Answer, InitialData, MAX_STATE, StateLanes, Surrogate};
use serde::{Deserialize, Serialize};

/// Strain of increment `k` of `count`, relative to the radii before it. The radii grow by equal amounts, so that the
/// increments compose exactly to `total`.
#[inline]
pub fn increment(total: f64, k: u32, count: u32) -> f64 {
    total / (f64::from(count) + total * f64::from(k))
}

/// The model's answer after the strain `total`, applied in `count` equal increments of the radii.
pub fn composed(
    block: impl Fn(&StateLanes, &Lanes) -> Answer,
    start: &StateLanes,
    total: &Lanes,
    count: u32,
) -> Answer {
    let mut answer = block(start, &total.map(|total| increment(total, 0, count)));
    for k in 1..count {
        answer = block(&answer.state, &total.map(|total| increment(total, k, count)));
    }
    answer
}

/// K_xx/k, K_yy/k of a row, of the kind that the model answers with; zero when the row lacks it.
pub fn conductivity(model: &dyn Surrogate, row: &StateRow) -> [f64; 2] {
    model.conductivity_kind().of(row).unwrap_or_default()
}

/// The model's state for a row of the database, in which all quantities are known.
pub fn state_of(model: &dyn Surrogate, row: &StateRow) -> [f64; MAX_STATE] {
    model.initial_state(&InitialData {
        porosity: row.porosity,
        fabric_index: row.fabric_index,
        fabric_xy: 0.0,
        reduced_stress: Some([row.stress_xx, row.stress_yy, 0.0]),
        conductivity: model.conductivity_kind().of(row).map(|[xx, yy]| [xx, yy, 0.0]),
    })
}

/// The states of up to [`LANES`] rows as one block; the last row fills the remaining lanes.
pub fn states_of(model: &dyn Surrogate, rows: &[&StateRow]) -> StateLanes {
    let states: Vec<_> = rows.iter().map(|row| state_of(model, row)).collect();
    std::array::from_fn(|k| std::array::from_fn(|lane| states[lane.min(states.len() - 1)][k]))
}

/// Errors after one strain, from the packed states of ramps, applied in a given number of increments. Relative errors
/// are root mean squares over the root mean square of the data, for xx and yy together.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Composed {
    pub strain: f64,
    pub increments: u32,
    pub ramps: usize,
    pub conductivity: f64,
    pub stress: f64,
    pub pressure: f64,
    /// Absolute error.
    pub porosity: f64,
    /// Absolute error.
    pub fabric_index: f64,
    /// Relative error of the mean over groups of [`GROUP`] packings, which is what matters for an average over a field.
    /// The largest of the groups.
    pub mean_conductivity: f64,
    pub mean_pressure: f64,
}

/// Packings in a group.
pub const GROUP: usize = 30;

/// Two stops of a ramp, start and end, both load bearing.
pub struct Path<'a> {
    pub from: &'a StateRow,
    pub to: &'a StateRow,
}

/// Paths of this strain from the packed states (stop 0).
pub fn paths(ramps: &[Ramp], strain: f64) -> Vec<Path<'_>> {
    let path = |ramp: &'_ Ramp| -> Option<(usize, usize)> {
        if ramp.name != "up" && ramp.name != "down" {
            return None;
        }
        let from = ramp.states.iter().position(|s| s.strain == 0.0 && s.load_bearing)?;
        let to = ramp.states.iter().position(|s| (s.strain - strain).abs() < 1e-9 && s.load_bearing)?;
        Some((from, to))
    };
    let found = ramps.iter().filter_map(|ramp| Some((ramp, path(ramp)?)));
    found.map(|(ramp, (from, to))| Path { from: &ramp.states[from], to: &ramp.states[to] }).collect()
}

/// Paths along the whole length of the ramps with this name.
pub fn whole_paths<'a>(ramps: &'a [Ramp], name: &str) -> Vec<Path<'a>> {
    let ends = |ramp: &'a Ramp| Some((ramp.states.first()?, ramp.states.last()?));
    let found = ramps.iter().filter(|ramp| ramp.name == name).filter_map(ends);
    let loaded = found.filter(|(from, to)| from.load_bearing && to.load_bearing);
    loaded.map(|(from, to)| Path { from, to }).collect()
}

/// K_xx, K_yy, σ_xx, σ_yy, p, η, f at the end of a path, either from the data or from the model.
pub type Quantities = [f64; 7];

fn quantities(answer: &Answer, lane: usize) -> Quantities {
    let ([kxx, kyy, _], [sxx, syy, _]) = (answer.conductivity, answer.stress);
    let (sxx, syy) = (sxx[lane], syy[lane]);
    [kxx[lane], kyy[lane], sxx, syy, 0.5 * (sxx + syy), answer.state[0][lane], answer.state[1][lane]]
}

/// Quantities of data and model at the ends of paths that are composed of increments.
pub fn ends(model: &dyn Surrogate, paths: &[Path], increments: u32) -> Vec<[Quantities; 2]> {
    let mut pairs = Vec::with_capacity(paths.len());
    for chunk in paths.chunks(LANES) {
        let from: Vec<&StateRow> = chunk.iter().map(|path| path.from).collect();
        let total = std::array::from_fn(|lane| {
            chunk.get(lane).map_or(0.0, |path| strain_between(path.from, path.to))
        });
        let start = states_of(model, &from);
        let answer = composed(|state, strain| model.block(state, strain), &start, &total, increments);
        for (lane, path) in chunk.iter().enumerate() {
            let ([kxx, kyy], row) = (conductivity(model, path.to), path.to);
            let (sxx, syy) = (row.stress_xx, row.stress_yy);
            let data = [kxx, kyy, sxx, syy, 0.5 * (sxx + syy), row.porosity, row.fabric_index];
            pairs.push([data, quantities(&answer, lane)]);
        }
    }
    pairs
}

/// Errors of composed increments over paths of about the same strain.
pub fn errors(model: &dyn Surrogate, paths: &[Path], strain: f64, increments: u32) -> Composed {
    let pairs = ends(model, paths, increments);
    let square = |k: usize| pairs.iter().map(|[d, p]| (p[k] - d[k]).powi(2)).fold(0.0, |a, b| a + b);
    let value = |k: usize| pairs.iter().map(|[d, _]| d[k].powi(2)).fold(0.0, |a, b| a + b);
    let relative = |ks: &[usize]| {
        let sum = |of: &dyn Fn(usize) -> f64| ks.iter().map(|k| of(*k)).fold(0.0, |a, b| a + b);
        if pairs.is_empty() { 0.0 } else { (sum(&square) / sum(&value)).sqrt() }
    };
    let absolute = |k: usize| (square(k) / pairs.len().max(1) as f64).sqrt();
    let mean = |ks: &[usize]| {
        let group = |group: &[[Quantities; 2]]| {
            let sum = |side: usize| {
                group.iter().flat_map(|pair| ks.iter().map(move |k| pair[side][*k])).fold(0.0, |a, b| a + b)
            };
            (sum(1) / sum(0) - 1.0).abs()
        };
        let full = pairs.chunks(GROUP).filter(|g| g.len() == GROUP || pairs.len() < GROUP);
        full.map(group).fold(0.0, f64::max)
    };
    Composed {
        strain,
        increments,
        ramps: paths.len(),
        conductivity: relative(&[0, 1]),
        stress: relative(&[2, 3]),
        pressure: relative(&[4]),
        porosity: absolute(5),
        fabric_index: absolute(6),
        mean_conductivity: mean(&[0, 1]),
        mean_pressure: mean(&[4]),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn increments_compose_to_the_whole() {
        for (total, count) in [(0.05, 1), (0.05, 500), (-0.05, 5000), (1.0, 3)] {
            let product = (0..count).fold(1.0, |p, k| p * (1.0 + increment(total, k, count)));
            assert!((product - 1.0 - total).abs() < 1e-12, "{total} in {count}: {product}");
        }
    }
}
