//! A learned law of the increments, for comparison with the classical one; no model file holds it.
//!
//! A perceptron gives the rates of pressure p, ratio r = q/p and two memory vectors h₁, h₂ per length |de| of the strain, from
//! invariants of state and direction of strain; it is a hypoplastic law. With n = (dv, e)/|de|, where dv is the relative growth
//! of the solid fraction and e = (e_yy − e_xx, −2 e_xy), and outputs y,
//!
//! dp = |de| (k n_v + y₀), dr = |de| (y₁ n_e + y₂ r + y₃ h₁ + y₄ h₂), dh_i = |de| c_i (y n_e + y h_i + y r),
//!
//! where the outputs are given about those of a simple hypoplastic law, with which the training begins. So zero strain changes
//! nothing, a turned cell has turned answers, and a thermal strain is an isotropic compression: exactly. Nothing else is built
//! in: there is no elastic energy, and no limit at which sliding begins.
//!
//! Neural networks in laws of increments: Ellis, Yao, Zhao and Penumadu (1995). Hypoplasticity: Kolymbas (1991). Memory of the
//! strain: Niemunis and Herle (1997).

mod perceptron;
pub mod training;

use crate::network::symmetric_unit;
use crate::tracks::Point;
use perceptron::{Activations, INPUTS, OUTPUTS, WEIGHTS};
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::SeedableRng;

/// Number of memory vectors.
pub const MEMORIES: usize = 2;
/// Number of numbers that are fitted: the perceptron, and the share of q/p in the first memory of a packing.
pub const NUMBERS: usize = WEIGHTS + 1;

/// dp over the growth of the solid fraction, where the training begins: that of the grains of the paper, to one digit.
const BULK: f64 = 0.5;
/// dr over e, and the rate at which r is lost by shear.
const SHEAR: f64 = 8.0;
const LOSS: f64 = 20.0;
/// By this the perceptron's outputs for r are multiplied.
const RATIO_SIZE: f64 = 10.0;
/// Inverse of the strains after which the memories have forgotten.
const MEMORY_RATES: [f64; MEMORIES] = [100.0, 400.0];
/// Added to p before its root is taken.
const PRESSURE_FLOOR: f64 = 1e-4;
/// Least pressure of a packing.
const LEAST_PRESSURE: f64 = 1e-6;

type Plane = [f64; 2];

/// State of a cell; stress as in [`super::law`].
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct State {
    /// p̃; negative where the grains do not touch.
    pub pressure: f64,
    /// (q̃₁, q̃₂)/p̃.
    pub ratio: Plane,
    /// φ_s.
    pub solid: f64,
    pub memory: [Plane; MEMORIES],
    /// By how much the cell has turned.
    pub angle: f64,
}

impl State {
    /// p̃, q̃₁, q̃₂.
    pub fn stress(&self) -> [f64; 3] {
        let p = self.pressure.max(0.0);
        [p, p * self.ratio[0], p * self.ratio[1]]
    }

    fn turned(mut self, turn: Plane) -> Self {
        self.ratio = turned(self.ratio, turn);
        self.memory = self.memory.map(|memory| turned(memory, turn));
        self
    }
}

/// Strain of an increment.
#[derive(Clone, Copy, Debug)]
pub struct Motion {
    /// Relative growth of φ_s.
    denser: f64,
    /// Length of the strain, and its direction: compression and shear.
    size: f64,
    compression: f64,
    shear: Plane,
    shear_size: f64,
    angle: f64,
    /// Cosine and sine of `angle`.
    turn: Plane,
}

impl Motion {
    /// Growth of the radii, xx, yy and 2 xy of a box whose upper border moves along x.
    pub fn of([thermal, xx, yy, xy]: [f64; 4]) -> Self {
        Self::turning([thermal, xx, yy, xy], -0.5 * xy)
    }

    /// As [`Motion::of`], with the angle by which the cell turns.
    pub fn turning([thermal, xx, yy, xy]: [f64; 4], angle: f64) -> Self {
        let half = 0.5 * xy;
        let (grains, cell) = (2.0 * thermal + thermal * thermal, xx + yy + (xx * yy - half * half));
        let denser = (grains - cell) / (1.0 + cell);
        let shear = [yy - xx, -xy];
        let size = (denser * denser + dot(shear, shear)).sqrt();
        let over = 1.0 / size.max(f64::MIN_POSITIVE);
        let shear = shear.map(|e| e * over);
        let shear_size = dot(shear, shear).sqrt();
        let turn = [angle.cos(), angle.sin()];
        Self { denser, size, compression: denser * over, shear, shear_size, angle, turn }
    }
}

/// What the derivatives of an increment need.
pub(crate) struct Tape {
    /// The state, turned by half of the cell's turn.
    state: State,
    answered: Activations,
}

#[derive(Clone, Debug, PartialEq)]
pub struct LearnedLaw {
    pub numbers: Vec<f64>,
}

impl LearnedLaw {
    /// Where a training begins.
    pub fn initial(seed: u64) -> Self {
        let mut random = ChaCha8Rng::seed_from_u64(seed);
        random.set_stream(1); // stream 0 belongs to the split
        let mut numbers = perceptron::initial(&mut random);
        numbers.push(1.0 + 0.1 * symmetric_unit(&mut random));
        Self { numbers }
    }

    /// The state of a packing.
    pub fn start(&self, point: &Point) -> State {
        let [p, q1, q2] = point.invariants();
        let ratio = [q1, q2].map(|q| q / p.max(LEAST_PRESSURE));
        let mut memory = [[0.0; 2]; MEMORIES];
        memory[0] = ratio.map(|r| r * self.numbers[WEIGHTS]);
        State { pressure: p, ratio, solid: point.solid, memory, angle: 0.0 }
    }

    /// The state after a strain.
    pub fn advanced(&self, state: &State, motion: &Motion) -> State {
        self.recorded(state, motion).0
    }

    pub(crate) fn recorded(&self, state: &State, motion: &Motion) -> (State, Tape) {
        // As in the classical law, half of the turn comes before the strain and half after it.
        let state = state.turned(motion.turn);
        let answered = perceptron::forward(&self.numbers, inputs(&state, motion));
        let y = &answered.outputs;
        let Motion { size, compression, shear, shear_size, .. } = *motion;
        let mut next = state;
        next.pressure += size * (BULK * compression + y[0]);
        next.solid += state.solid * motion.denser;
        next.angle += motion.angle;
        add(&mut next.ratio, size * (SHEAR + RATIO_SIZE * y[1]), shear);
        add(&mut next.ratio, size * (RATIO_SIZE * y[2] - LOSS * shear_size), state.ratio);
        for (i, memory) in state.memory.iter().enumerate() {
            add(&mut next.ratio, size * RATIO_SIZE * y[3 + i], *memory);
            let ([along, own, ratio], rate) = (of_memory(y, i), size * MEMORY_RATES[i]);
            add(&mut next.memory[i], rate * (1.0 + along), shear);
            add(&mut next.memory[i], rate * (own - shear_size), *memory);
            add(&mut next.memory[i], rate * ratio, state.ratio);
        }
        (next.turned(motion.turn), Tape { state, answered })
    }

    /// Derivatives of an error by the state before an increment, from those by the state after it. Those by the numbers are
    /// added to `gradient`.
    fn backward(&self, motion: &Motion, tape: &Tape, after: &State, gradient: &mut [f64]) -> State {
        let back = [motion.turn[0], -motion.turn[1]];
        let (state, y, after) = (&tape.state, &tape.answered.outputs, after.turned(back));
        let Motion { size, shear, shear_size, .. } = *motion;
        let (mut before, mut by_y) = (after, [0.0; OUTPUTS]);
        before.solid += after.solid * motion.denser;
        by_y[0] = size * after.pressure;
        let by = after.ratio.map(|by| size * by);
        by_y[1] = RATIO_SIZE * dot(shear, by);
        by_y[2] = RATIO_SIZE * dot(state.ratio, by);
        add(&mut before.ratio, RATIO_SIZE * y[2] - LOSS * shear_size, by);
        for (i, memory) in state.memory.iter().enumerate() {
            by_y[3 + i] = RATIO_SIZE * dot(*memory, by);
            add(&mut before.memory[i], RATIO_SIZE * y[3 + i], by);
            let by = after.memory[i].map(|by| size * MEMORY_RATES[i] * by);
            let ([_, own, ratio], k) = (of_memory(y, i), FIRST_OF_MEMORY + 3 * i);
            by_y[k..k + 3].copy_from_slice(&[dot(shear, by), dot(*memory, by), dot(state.ratio, by)]);
            add(&mut before.memory[i], own - shear_size, by);
            add(&mut before.ratio, ratio, by);
        }
        let by_inputs = perceptron::backward(&self.numbers, &tape.answered, &by_y, gradient);
        add_inputs_back(state, motion, &by_inputs, &mut before);
        before.turned(back)
    }
}

/// First output of the memories, three for each.
const FIRST_OF_MEMORY: usize = 3 + MEMORIES;
const _: () = assert!(OUTPUTS == FIRST_OF_MEMORY + 3 * MEMORIES && INPUTS == 5 + 3 * MEMORIES);

fn of_memory(y: &[f64; OUTPUTS], i: usize) -> [f64; 3] {
    std::array::from_fn(|k| y[FIRST_OF_MEMORY + 3 * i + k])
}

/// Invariants of state and strain, scaled to about −1 to 1.
fn inputs(state: &State, motion: &Motion) -> [f64; INPUTS] {
    let (r, e) = (state.ratio, motion.shear);
    let mut all = [0.0; INPUTS];
    all[0] = 5.0 * (state.pressure.max(0.0) + PRESSURE_FLOOR).sqrt() - 1.0;
    all[1] = 15.0 * (state.solid - 0.87);
    all[2] = 10.0 * dot(r, r);
    all[3] = 1.5 * motion.compression;
    all[4] = 4.0 * dot(r, e);
    for (some, h) in all[5..].chunks_exact_mut(3).zip(state.memory) {
        some.copy_from_slice(&[dot(h, h), 4.0 * dot(h, r), 1.5 * dot(h, e)]);
    }
    all
}

/// Adds the derivatives by the state, from those by the inputs.
fn add_inputs_back(state: &State, motion: &Motion, by: &[f64; INPUTS], into: &mut State) {
    let (r, e) = (state.ratio, motion.shear);
    if state.pressure > 0.0 {
        into.pressure += 2.5 * by[0] / (state.pressure + PRESSURE_FLOOR).sqrt();
    }
    into.solid += 15.0 * by[1];
    add(&mut into.ratio, 20.0 * by[2], r);
    add(&mut into.ratio, 4.0 * by[4], e);
    for (i, by) in by[5..].chunks_exact(3).enumerate() {
        let h = state.memory[i];
        add(&mut into.memory[i], 2.0 * by[0], h);
        add(&mut into.memory[i], 4.0 * by[1], r);
        add(&mut into.memory[i], 1.5 * by[2], e);
        add(&mut into.ratio, 4.0 * by[1], h);
    }
}

fn add(into: &mut Plane, factor: f64, vector: Plane) {
    into.iter_mut().zip(vector).for_each(|(into, component)| *into += factor * component);
}

fn dot(a: Plane, b: Plane) -> f64 {
    a[0] * b[0] + a[1] * b[1]
}

fn turned([along, across]: Plane, [cosine, sine]: Plane) -> Plane {
    [cosine * along - sine * across, sine * along + cosine * across]
}

#[cfg(test)]
mod tests;
