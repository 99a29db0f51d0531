//! The classical and the learned form of the law on what their fits did not see: errors along paths, energy of closed cycles of
//! strain, time of an increment.

use super::core::{
    COMPRESSION, Core, FABRIC_INDEX, FABRIC_SHEAR, JAMMING, OWN_INDEX, OWN_SHEAR, POROSITY, SHEAR, STRENGTH,
};
use super::errors::{errors_of, path_errors};
use super::fit::{looseness, parameters};
use super::learned::training::{self, motions};
use super::learned::{LearnedLaw, Motion, NUMBERS, State};
use super::number::Plain;
use super::paths::{States, packed, stresses};
use super::readout::Features;
use super::start::start_of_solid;
use crate::kernel::LANES;
use crate::kernel::vector::{Arithmetic, Portable};
use crate::network::symmetric_unit;
use crate::surrogate::{Answer, Increment, MAX_STATE};
use crate::tracks::{PathErrors, Point, Track};
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::SeedableRng;
use serde::Serialize;
use std::time::Instant;

/// What is known of a form of the law.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Form {
    pub name: &'static str,
    /// How many were fitted to the stress.
    pub numbers: usize,
    pub training_seconds: f64,
    /// Of an increment of one cell, on one thread.
    pub nanoseconds: f64,
    pub paths: Vec<PathErrors>,
    pub cycles: Vec<Cycles>,
}

/// Closed cycles of strain that are repeated `REPEATS` times.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Cycles {
    /// Largest strain.
    pub amplitude: f64,
    pub cycles: usize,
    /// Share of the cycles that give energy in the last repeat: more than a hundredth of the largest change of stress times the
    /// amplitude.
    pub creating: f64,
    /// Root mean square of the relative change of p after all repeats.
    pub drift: f64,
}

/// A law as far as its stress.
trait Stressed {
    type State: Copy;
    fn at(&self, packed: &Point) -> Self::State;
    /// After strains xx, yy and 2 xy, without a turn.
    fn strained(&self, state: &Self::State, strain: [f64; 3]) -> Self::State;
    /// p̃, q̃₁, q̃₂.
    fn stress(&self, state: &Self::State) -> [f64; 3];
}

impl Stressed for Core {
    type State = [f64; MAX_STATE];

    fn at(&self, point: &Point) -> Self::State {
        packed(self, point)
    }

    fn strained(&self, state: &Self::State, strain: [f64; 3]) -> Self::State {
        let [xx, yy, xy] = strain.map(|strain| [strain; LANES]);
        let increment = Increment { xx, yy, xy, ..Increment::default() };
        let mut answer = Answer::default();
        self.advance(&state.map(|value| [value; LANES]), &increment, &mut answer, None);
        answer.state.map(|column| column[0])
    }

    fn stress(&self, state: &Self::State) -> [f64; 3] {
        stresses(self, &vec![*state])[0]
    }
}

impl Stressed for LearnedLaw {
    type State = State;

    fn at(&self, point: &Point) -> State {
        self.start(point)
    }

    fn strained(&self, state: &State, [xx, yy, xy]: [f64; 3]) -> State {
        self.advanced(state, &Motion::turning([0.0, xx, yy, xy], 0.0))
    }

    fn stress(&self, state: &State) -> [f64; 3] {
        state.stress()
    }
}

/// The classical form.
pub fn classical(core: &Core, tracks: &[Track], training_seconds: f64) -> Form {
    Form {
        name: "classical",
        numbers: parameters(&core.law).len(),
        training_seconds,
        nanoseconds: time_of_classical(core, tracks),
        paths: path_errors(core, tracks),
        cycles: AMPLITUDES.map(|amplitude| cycles(core, tracks, amplitude)).to_vec(),
    }
}

/// The learned form, trained on `seen`. Porosity, fabric and conductivity are those of the classical form for its stress.
pub fn learned(
    core: &Core,
    seen: &[Track],
    tracks: &[Track],
    (seed, epochs, threads): (u64, u32, usize),
) -> Form {
    let begin = Instant::now();
    let law = training::train(seen, seed, epochs, threads);
    let training_seconds = begin.elapsed().as_secs_f64();
    let followed: Vec<Vec<State>> = tracks.iter().map(|track| follow(&law, track)).collect();
    let states: Vec<States> =
        tracks.iter().zip(&followed).map(|(track, states)| columns(core, track, states)).collect();
    let stress: Vec<Vec<[f64; 3]>> =
        followed.iter().map(|states| states.iter().map(State::stress).collect()).collect();
    Form {
        name: "learned",
        numbers: NUMBERS,
        training_seconds,
        nanoseconds: time_of_learned(&law, tracks),
        paths: errors_of(core, tracks, &states, &stress),
        cycles: AMPLITUDES.map(|amplitude| cycles(&law, tracks, amplitude)).to_vec(),
    }
}

fn follow(law: &LearnedLaw, track: &Track) -> Vec<State> {
    let mut states = vec![law.start(&track.packed)];
    for step in &track.steps {
        let from = states[step.from];
        states.push(motions(step.strain).iter().fold(from, |state, motion| law.advanced(&state, motion)));
    }
    states
}

/// States of the classical law with the stress and solid fraction of the learned one.
fn columns(core: &Core, track: &Track, states: &[State]) -> States {
    let start = packed(core, &track.packed);
    let first = stressed(core, &start, &states[0]);
    let features = |state: &[f64; MAX_STATE], learned: &State| {
        let stress = learned.stress().map(|value| Plain(Portable::all(value)));
        Features::of(&stress, Portable::all(looseness(state)))
    };
    let fabric = |features: &Features<Portable>, porosity: f64| {
        core.readout.fabric(features, Portable::all(porosity)).map(Portable::into_first)
    };
    let before = fabric(&features(&first, &states[0]), start[POROSITY]);
    let of_state = |learned: &State| {
        let mut state = stressed(core, &start, learned);
        let features = features(&state, learned);
        state[POROSITY] = 1.0 - learned.solid + core.readout.overlap(&features).into_first();
        let after = fabric(&features, state[POROSITY]);
        // What the stress does not bring turns with the cell.
        let (sine, cosine) = (2.0 * learned.angle).sin_cos();
        for (columns, follows, was) in
            [([FABRIC_INDEX, FABRIC_SHEAR], after, before), ([OWN_INDEX, OWN_SHEAR], [0.0; 2], [0.0; 2])]
        {
            let [along, across] = [0, 1].map(|c| start[columns[c]] - was[c]);
            state[columns[0]] = follows[0] + cosine * along - sine * across;
            state[columns[1]] = follows[1] + sine * along + cosine * across;
        }
        state
    };
    states.iter().map(of_state).collect()
}

fn stressed(core: &Core, start: &[f64; MAX_STATE], learned: &State) -> [f64; MAX_STATE] {
    let [p, q1, q2] = learned.stress();
    let found = start_of_solid(&core.law, learned.solid, p, [q1, q2]);
    let mut state = *start;
    (state[JAMMING], state[COMPRESSION]) = (found.jamming, found.compression);
    state[SHEAR..STRENGTH].copy_from_slice(found.shear.as_flattened());
    state[STRENGTH] = found.strength;
    state
}

/// Largest strains of the closed cycles.
const AMPLITUDES: [f64; 4] = [1e-5, 1e-4, 1e-3, 5e-3];
/// How often a cycle is repeated, number of cycles from each packing, parts of each of the four sides of a cycle.
const REPEATS: usize = 30;
const CYCLES: usize = 10;
const PARTS: usize = 25;
/// Share of the energy that goes to and fro from which a gain counts.
const GAIN: f64 = 0.01;
/// Least p̃ of a packing that is strained.
const LEAST_PRESSURE: f64 = 1e-3;

/// Closed cycles through three random strains, from all packings.
fn cycles<L: Stressed>(law: &L, tracks: &[Track], amplitude: f64) -> Cycles {
    let mut random = ChaCha8Rng::seed_from_u64(1);
    let (mut count, mut creating, mut drift) = (0usize, 0usize, 0.0);
    for (k, track) in tracks.iter().enumerate() {
        let known = tracks[..k].iter().any(|earlier| earlier.packing == track.packing);
        if known || !track.packed.load_bearing || track.packed.invariants()[0] < LEAST_PRESSURE {
            continue;
        }
        for _ in 0..CYCLES {
            let mut corners = [[0.0; 3]; 4];
            for corner in &mut corners[..3] {
                *corner = std::array::from_fn(|_| amplitude * symmetric_unit(&mut random));
            }
            let mut state = law.at(&track.packed);
            let before = law.stress(&state)[0];
            let mut energy = Energy::default();
            for _ in 0..REPEATS {
                (state, energy) = cycle(law, state, &corners);
            }
            count += 1;
            creating += usize::from(energy.work < -GAIN * energy.change * amplitude);
            drift += (law.stress(&state)[0] / before - 1.0).powi(2);
        }
    }
    let over = 1.0 / count.max(1) as f64;
    Cycles { amplitude, cycles: count, creating: creating as f64 * over, drift: (drift * over).sqrt() }
}

/// Work that is done on the grains of a cell, over the area of the cell before the cycle, and largest change of the stress.
#[derive(Clone, Copy, Default)]
struct Energy {
    work: f64,
    change: f64,
}

/// One cycle from corner to corner, the last of which is 0: logarithmic growth of the area, half the difference of xx and yy, and
/// 2 xy. These add up, so the cycle is closed.
fn cycle<L: Stressed>(law: &L, mut state: L::State, corners: &[[f64; 3]; 4]) -> (L::State, Energy) {
    let (mut at, mut energy) = ([0.0; 3], Energy::default());
    let start = law.stress(&state);
    let mut before = start;
    for corner in corners {
        let step = [0, 1, 2].map(|c| (corner[c] - at[c]) / PARTS as f64);
        let [growth, half, shear] = step;
        let mean = (growth.exp() + half * half + 0.25 * shear * shear).sqrt() - 1.0;
        for part in 0..PARTS {
            state = law.strained(&state, [mean + half, mean - half, shear]);
            let after = law.stress(&state);
            let [p, q1, q2] = [0, 1, 2].map(|c| 0.5 * (before[c] + after[c]));
            let area = (at[0] + growth * (part as f64 + 0.5)).exp();
            energy.work -= area * (p * growth + 2.0 * q1 * half + q2 * shear);
            energy.change = (0..3).fold(energy.change, |most, c| most.max((after[c] - start[c]).abs()));
            before = after;
        }
        at = *corner;
    }
    (state, energy)
}

/// Cells of a batch whose time is measured, and how often; the shortest time counts, since others interrupt.
const BATCH: usize = 3_000;
const ROUNDS: usize = 100;

fn nanoseconds(mut round: impl FnMut()) -> f64 {
    let time = |_| {
        let begin = Instant::now();
        round();
        begin.elapsed().as_secs_f64()
    };
    1e9 / BATCH as f64 * (0..ROUNDS).map(time).fold(f64::INFINITY, f64::min)
}

/// Strains of both signs, as small as in a step of the solver.
fn small_strain(cell: usize) -> f64 {
    1e-6 * (1.0 + (cell % 7) as f64) * if cell.is_multiple_of(2) { 1.0 } else { -1.0 }
}

fn time_of_classical(core: &Core, tracks: &[Track]) -> f64 {
    let cells: Vec<[f64; MAX_STATE]> =
        tracks.iter().cycle().take(BATCH).map(|track| packed(core, &track.packed)).collect();
    let block = |cells: &[[f64; MAX_STATE]]| {
        let cell = |lane: usize| &cells[lane.min(cells.len() - 1)];
        std::array::from_fn(|column| std::array::from_fn(|lane| cell(lane)[column]))
    };
    let mut blocks: Vec<_> = cells.chunks(LANES).map(block).collect();
    let strain = Increment { xy: std::array::from_fn(small_strain), ..Increment::default() };
    let mut answer = Answer::default();
    nanoseconds(|| {
        for block in &mut blocks {
            core.advance(block, &strain, &mut answer, None);
            *block = answer.state;
        }
    })
}

fn time_of_learned(law: &LearnedLaw, tracks: &[Track]) -> f64 {
    let mut cells: Vec<State> =
        tracks.iter().cycle().take(BATCH).map(|track| law.start(&track.packed)).collect();
    nanoseconds(|| {
        for (k, cell) in cells.iter_mut().enumerate() {
            *cell = law.advanced(cell, &Motion::of([0.0, 0.0, 0.0, small_strain(k)]));
        }
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::increment::synthetic;

    #[test]
    fn the_classical_form_creates_no_energy_and_hardly_drifts() {
        let (core, tracks) = (synthetic::core(), synthetic::tracks(10, 1));
        for amplitude in [1e-5, 1e-3] {
            let found = cycles(&core, &tracks, amplitude);
            assert!(found.cycles == 100 && found.creating == 0.0 && found.drift < 0.01, "{found:?}");
        }
    }

    #[test]
    fn both_forms_are_judged_alike() {
        let (core, tracks) = (synthetic::core(), synthetic::tracks(6, 4));
        let first = classical(&core, &tracks, 0.0);
        let second = learned(&core, &tracks, &tracks, (1, 300, 2));
        assert_eq!(first.paths.len(), second.paths.len());
        for (a, b) in first.paths.iter().zip(&second.paths) {
            assert!(a.name == b.name && a.states == b.states && a.pressure < 1e-3, "{a:?} {b:?}");
            assert!(b.pressure < 0.05 && b.conductivity < 0.1 && b.porosity < 0.01, "{b:?}");
        }
        assert!(second.cycles.iter().any(|cycles| cycles.creating > 0.0), "{:?}", second.cycles);
    }
}
