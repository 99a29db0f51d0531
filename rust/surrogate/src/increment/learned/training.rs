//! Training: the law follows whole paths, and Adam (Kingma and Ba 2015) lowers the error of its stress along them, which is that
//! of the fit of the classical law. The derivatives are found backwards along each path.
//!
//! A law without an elastic range drifts when a small strain goes there and back. Such strains, from states on the paths, are
//! part of the training: the second time there and back is to leave the stress as it was.

use super::{LearnedLaw, Motion, NUMBERS, State, Tape, WEIGHTS};
use crate::dataset::shuffle;
use crate::increment::fit::{MOST, PROBE_WEIGHT, USUAL_DISCS, over, robust};
use crate::increment::paths::parts;
use crate::network::symmetric_unit;
use crate::tracks::{Point, Track};
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::SeedableRng;

/// Number of epochs after which the error hardly falls.
pub const USUAL_EPOCHS: u32 = 800;
/// Paths whose errors make one step of the minimisation; of these, so many at a time go to a thread, however many there are, so
/// that the number of threads does not change the sum.
const BATCH: usize = 32;
const GROUP: usize = 4;
/// Largest rate, of the beginning; it falls to [`LEAST_RATE`] of this as a cosine.
const RATE: f64 = 0.005;
const LEAST_RATE: f64 = 0.003;
/// Steps in which the rate grows from zero.
const WARMING: f64 = 50.0;
/// Longest gradient.
const LONGEST: f64 = 0.005;
/// Of Adam.
const KEPT: [f64; 2] = [0.9, 0.999];

/// One strain there and back for about so many states of a path.
const STATES_PER_RETURN: usize = 6;
/// Weight of the change of stress over the strain that is taken back.
const RETURN_WEIGHT: f64 = 0.5;
/// Strains that are taken back: least, and the power of ten between least and largest.
const LEAST_RETURN: f64 = 1e-5;
const RETURN_DECADES: f64 = 2.7;
/// Least p̃ of a state from which a strain is taken back.
const LEAST_PRESSURE: f64 = 2e-3;

/// A strain from a state.
struct Node {
    from: usize,
    parts: Vec<Motion>,
}

/// The error of a stress, or of its difference from that of another state.
struct Residual {
    at: usize,
    base: Option<usize>,
    target: [f64; 3],
    weight: f64,
    /// Largest error that counts.
    most: f64,
}

/// A track as the training needs it. State 0 is the packing, k + 1 that after node k.
struct Course {
    packed: Point,
    nodes: Vec<Node>,
    residuals: Vec<Residual>,
}

/// The increments of a step, as for the classical law.
pub fn motions(strain: [f64; 4]) -> Vec<Motion> {
    let number = parts(strain);
    // Equal parts of the whole, so that they compose to it.
    let part = |k: u32| strain.map(|strain| strain / (number + strain * f64::from(k)));
    (0..number as u32).map(|k| Motion::of(part(k))).collect()
}

impl Course {
    fn of(track: &Track, random: &mut ChaCha8Rng) -> Self {
        let nodes =
            track.steps.iter().map(|step| Node { from: step.from, parts: motions(step.strain) }).collect();
        let mut course = Self { packed: track.packed, nodes, residuals: Vec::new() };
        let weight = (track.discs as f64 / USUAL_DISCS).sqrt();
        for (k, step) in track.steps.iter().enumerate().filter(|(_, step)| step.to.load_bearing) {
            let (mut target, at) = (step.to.invariants(), k + 1);
            let residual = if step.probe {
                let base = track.point(step.from).invariants();
                (0..3).for_each(|c| target[c] -= base[c]);
                let weight = weight * PROBE_WEIGHT / largest(step.strain);
                Residual { at, base: Some(step.from), target, weight, most: MOST }
            } else {
                Residual { at, base: None, target, weight: weight * over(target[0]), most: f64::INFINITY }
            };
            course.residuals.push(residual);
        }
        course.add_returns(track, weight, random);
        course
    }

    /// Small strains from random states of the path, twice there and back.
    fn add_returns(&mut self, track: &Track, weight: f64, random: &mut ChaCha8Rng) {
        let mut share = || 0.5 + 0.5 * symmetric_unit(random);
        let states = track.steps.len();
        for _ in 0..(states / STATES_PER_RETURN).max(1) {
            let mut at = ((states + 1) as f64 * share()) as usize;
            let size = LEAST_RETURN * 10f64.powf(RETURN_DECADES * share());
            let [xx, yy, xy] = [share(), share(), share()].map(|share| size * (2.0 * share - 1.0));
            let point = track.point(at);
            let probe = at > 0 && track.steps[at - 1].probe;
            if probe || !point.load_bearing || point.invariants()[0] < LEAST_PRESSURE {
                continue;
            }
            let strain = [0.0, xx, yy, xy];
            let back = [0.0, -xx / (1.0 + xx), -yy / (1.0 + yy), -xy / (1.0 + yy)];
            let mut once = at;
            for (k, strain) in [strain, back, strain, back].into_iter().enumerate() {
                self.nodes.push(Node { from: at, parts: motions(strain) });
                at = self.nodes.len();
                if k == 1 {
                    once = at;
                }
            }
            let weight = weight * RETURN_WEIGHT / largest(strain);
            let residual = Residual { at, base: Some(once), target: [0.0; 3], weight, most: f64::INFINITY };
            self.residuals.push(residual);
        }
    }

    /// Sum of the errors. Its derivatives are added to `gradient`.
    fn error(&self, law: &LearnedLaw, gradient: &mut [f64]) -> f64 {
        let mut states = vec![law.start(&self.packed)];
        let mut tapes: Vec<Vec<Tape>> = Vec::with_capacity(self.nodes.len());
        for node in &self.nodes {
            let mut state = states[node.from];
            let record = |motion: &Motion| {
                let (next, tape) = law.recorded(&state, motion);
                state = next;
                tape
            };
            tapes.push(node.parts.iter().map(record).collect());
            states.push(state);
        }
        let mut by = vec![State::default(); states.len()];
        let mut sum = 0.0;
        for residual in &self.residuals {
            let found = states[residual.at].stress();
            let base = residual.base.map_or([0.0; 3], |base| states[base].stress());
            let mut by_stress = [0.0; 3];
            for c in 0..3 {
                let error = residual.weight * (found[c] - base[c] - residual.target[c]);
                let [weight, square] = robust(error);
                sum += square;
                by_stress[c] =
                    if error.abs() > residual.most { 0.0 } else { 2.0 * weight * error * residual.weight };
            }
            add_stress_back(&states[residual.at], by_stress, &mut by[residual.at]);
            if let Some(base) = residual.base {
                add_stress_back(&states[base], by_stress.map(|by| -by), &mut by[base]);
            }
        }
        for (k, node) in self.nodes.iter().enumerate().rev() {
            let mut back = by[k + 1];
            for (motion, tape) in node.parts.iter().zip(&tapes[k]).rev() {
                back = law.backward(motion, tape, &back, gradient);
            }
            add(&mut by[node.from], &back);
        }
        let (packed, by) = (&states[0], &by[0]);
        gradient[WEIGHTS] += by.memory[0][0] * packed.ratio[0] + by.memory[0][1] * packed.ratio[1];
        sum
    }
}

/// Adds the derivatives by the state, from those by the stress. Where grains do not touch, a larger pressure counts as if it
/// helped, so that the law learns when they touch.
fn add_stress_back(state: &State, by: [f64; 3], into: &mut State) {
    into.pressure += by[0];
    if state.pressure > 0.0 {
        into.pressure += by[1] * state.ratio[0] + by[2] * state.ratio[1];
        into.ratio[0] += by[1] * state.pressure;
        into.ratio[1] += by[2] * state.pressure;
    }
}

fn add(into: &mut State, more: &State) {
    into.pressure += more.pressure;
    into.solid += more.solid;
    super::add(&mut into.ratio, 1.0, more.ratio);
    into.memory.iter_mut().zip(more.memory).for_each(|(into, more)| super::add(into, 1.0, more));
}

fn largest(strain: [f64; 4]) -> f64 {
    strain.iter().fold(1e-12, |largest: f64, strain| largest.max(strain.abs()))
}

/// Trains on tracks; the number of threads does not change the result.
pub fn train(tracks: &[Track], seed: u64, epochs: u32, threads: usize) -> LearnedLaw {
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    random.set_stream(2);
    let mut courses: Vec<Course> = tracks.iter().map(|track| Course::of(track, &mut random)).collect();
    let mut law = LearnedLaw::initial(seed);
    let mut moments = [[0.0; NUMBERS]; 2];
    let steps = f64::from(epochs) * courses.len().div_ceil(BATCH) as f64;
    let (mut step, mut powers) = (0.0, [1.0; 2]);
    for epoch in 0..epochs {
        shuffle(&mut courses, seed.wrapping_add(u64::from(epoch)));
        for batch in courses.chunks(BATCH) {
            let gradient = gradient(&law, batch, threads);
            step += 1.0;
            let cosine = (std::f64::consts::PI * step / steps).cos();
            let rate = RATE * (0.5 + 0.5 * cosine).max(LEAST_RATE) * (step / WARMING).min(1.0);
            let length = gradient.iter().map(|g| g * g).sum::<f64>().sqrt();
            let shortened = LONGEST / length.max(LONGEST);
            powers = [powers[0] * KEPT[0], powers[1] * KEPT[1]];
            for k in 0..NUMBERS {
                let by = shortened * gradient[k];
                for (order, kept) in KEPT.into_iter().enumerate() {
                    let value = if order == 0 { by } else { by * by };
                    moments[order][k] = kept * moments[order][k] + (1.0 - kept) * value;
                }
                let [first, second] = [0, 1].map(|order| moments[order][k] / (1.0 - powers[order]));
                law.numbers[k] -= rate * first / (second.sqrt() + 1e-10);
            }
        }
    }
    law
}

/// Derivatives of the mean error of some courses.
fn gradient(law: &LearnedLaw, courses: &[Course], threads: usize) -> Vec<f64> {
    let groups: Vec<&[Course]> = courses.chunks(GROUP).collect();
    let of_group = |group: &&[Course]| {
        let mut gradient = vec![0.0; NUMBERS];
        group.iter().for_each(|course| _ = course.error(law, &mut gradient));
        gradient
    };
    let of_groups = |groups: &[&[Course]]| groups.iter().map(of_group).collect::<Vec<_>>();
    let each = groups.len().div_ceil(threads.max(1));
    let all: Vec<Vec<f64>> = std::thread::scope(|scope| {
        let handles: Vec<_> =
            groups.chunks(each).map(|groups| scope.spawn(move || of_groups(groups))).collect();
        handles.into_iter().flat_map(|handle| handle.join().expect("no thread panics")).collect()
    });
    let residuals: usize = courses.iter().map(|course| 3 * course.residuals.len()).sum();
    let mut sum = vec![0.0; NUMBERS];
    for gradient in all {
        sum.iter_mut().zip(gradient).for_each(|(sum, g)| *sum += g / residuals.max(1) as f64);
    }
    sum
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn derivatives_along_paths_are_those_of_the_error() {
        let mut random = ChaCha8Rng::seed_from_u64(3);
        let courses: Vec<Course> = crate::increment::synthetic::tracks(2, 3)
            .iter()
            .map(|track| Course::of(track, &mut random))
            .collect();
        let law = LearnedLaw::initial(5);
        let error = |law: &LearnedLaw| {
            let mut gradient = vec![0.0; NUMBERS];
            (courses.iter().map(|course| course.error(law, &mut gradient)).sum::<f64>(), gradient)
        };
        let gradient = error(&law).1;
        for k in (0..NUMBERS).step_by(7).chain([WEIGHTS]) {
            let at = |step: f64| {
                let mut law = law.clone();
                law.numbers[k] += step;
                error(&law).0
            };
            let numerical = (at(1e-5) - at(-1e-5)) / 2e-5;
            let tolerance = 1e-5 * (numerical.abs() + 1e-3);
            assert!((gradient[k] - numerical).abs() < tolerance, "{k}: {} {numerical}", gradient[k]);
        }
    }

    #[test]
    fn a_seed_gives_one_law_with_any_number_of_threads() {
        let tracks = crate::increment::synthetic::tracks(4, 3);
        let law = train(&tracks, 1, 3, 1);
        assert_eq!(law, train(&tracks, 1, 3, 2));
        assert_ne!(law, train(&tracks, 2, 3, 2));
    }
}
