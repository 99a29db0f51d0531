//! The law along paths of strain.

use super::core::{COMPRESSION, Core, FABRIC_INDEX, FABRIC_SHEAR, JAMMING, POROSITY, SHEAR, STRENGTH};
use super::start::start_of_solid;
use crate::kernel::{LANES, Lanes};
use crate::surrogate::{Answer, Increment, MAX_STATE, StateLanes};
use crate::tracks::{Point, Track};

/// Largest strain that is applied in one part.
const SUBSTEP: f64 = 1e-3;
/// Largest number of substeps of a step.
const MAX_SUBSTEPS: f64 = 20.0;

/// Number of substeps in which the largest of these strains is applied.
pub(super) fn substeps(strains: impl IntoIterator<Item = f64>) -> f64 {
    let largest = strains.into_iter().fold(0.0f64, |a, b| a.max(b.abs()));
    (largest / SUBSTEP).ceil().clamp(1.0, MAX_SUBSTEPS)
}

/// The law's states of one track: number k as `Step::from`.
pub type States = Vec<[f64; MAX_STATE]>;

/// The state of a packing whose porosity, fabric, solid fraction and stress are known.
pub fn packed(core: &Core, point: &Point) -> [f64; MAX_STATE] {
    let [p, q1, q2] = point.invariants();
    let found = start_of_solid(&core.law, point.solid, p.max(0.0), [q1, q2]);
    let mut state = [0.0; MAX_STATE];
    state[POROSITY] = point.porosity;
    state[FABRIC_INDEX] = point.fabric_index;
    state[FABRIC_SHEAR] = point.fabric_shear.unwrap_or(0.0);
    state[JAMMING] = found.jamming;
    state[COMPRESSION] = found.compression;
    state[SHEAR..STRENGTH].copy_from_slice(found.shear.as_flattened());
    state[STRENGTH] = found.strength;
    if let Some(known) = point.conductivity(core.conductivity.kind) {
        core.give(&mut state, known);
    }
    state
}

/// Follows tracks, [`LANES`] at a time.
pub fn follow(core: &Core, tracks: &[Track]) -> Vec<States> {
    tracks.chunks(LANES).flat_map(|some| follow_block(core, some)).collect()
}

fn follow_block(core: &Core, tracks: &[Track]) -> Vec<States> {
    let mut states: Vec<States> = tracks.iter().map(|track| vec![packed(core, &track.packed)]).collect();
    let longest = tracks.iter().map(|track| track.steps.len()).max().unwrap_or(0);
    for k in 0..longest {
        let step = |lane: usize| tracks.get(lane).and_then(|track| track.steps.get(k));
        let substeps = substeps((0..LANES).filter_map(step).flat_map(|step| step.strain));
        let mut block: StateLanes = [[0.0; LANES]; MAX_STATE];
        for lane in 0..LANES {
            let from = step(lane).map_or(0, |step| step.from);
            let state = states.get(lane).unwrap_or(&states[0])[from];
            block.iter_mut().zip(state).for_each(|(column, value)| column[lane] = value);
        }
        let mut after = Answer::default();
        for part in 0..substeps as u32 {
            let lanes = |k: usize| {
                // Equal substeps of the whole, so that they compose to it.
                let of = |strain: f64| strain / (substeps + strain * f64::from(part));
                std::array::from_fn(|lane| step(lane).map_or(0.0, |step| of(step.strain[k])))
            };
            let xy: [f64; LANES] = lanes(3);
            let strain = Increment {
                thermal: lanes(0),
                xx: lanes(1),
                yy: lanes(2),
                xy,
                // The upper border moves along x: that turns the box clockwise by half of the shear.
                rotation: xy.map(|xy| -0.5 * xy),
            };
            core.advance(&block, &strain, &mut after, None);
            block = after.state;
        }
        for (lane, states) in states.iter_mut().enumerate() {
            if k < tracks[lane].steps.len() {
                states.push(std::array::from_fn(|column| block[column][lane]));
            }
        }
    }
    states
}

/// σ̃ of states of the law: p̃, q̃₁, q̃₂.
pub fn stresses(core: &Core, states: &States) -> Vec<[f64; 3]> {
    answers(core, states, |answer| answer.stress)
        .into_iter()
        .map(|[xx, yy, xy]| [0.5 * (xx + yy), 0.5 * (xx - yy), xy])
        .collect()
}

/// K_xx/k, K_yy/k, K_xy/k of states of the law.
pub fn conductivities(core: &Core, states: &States) -> Vec<[f64; 3]> {
    answers(core, states, |answer| answer.conductivity)
}

fn answers(core: &Core, states: &States, take: fn(&Answer) -> [Lanes; 3]) -> Vec<[f64; 3]> {
    let (mut all, mut answer) = (Vec::with_capacity(states.len()), Answer::default());
    for some in states.chunks(LANES) {
        let block =
            std::array::from_fn(|column| std::array::from_fn(|lane| some[lane.min(some.len() - 1)][column]));
        core.advance(&block, &Increment::default(), &mut answer, None);
        let columns = take(&answer);
        all.extend((0..some.len()).map(|lane| columns.map(|column| column[lane])));
    }
    all
}
