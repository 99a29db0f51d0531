//! Work of random closed cycles of strain with the law of the increments.
//!
//!     cargo run --release -p msdd-surrogate --example closed_cycles -- CYCLES [MODEL.json]
//!
//! Each cycle leads through three random strains of the cell and of the grains back to the beginning and is repeated, so that
//! grains that slide in it have found their place. The work of the last repeat is that on the grains, −∫ σ̃ : (dε − dε_T I) with
//! areas over that of the grains, by Simpson's rule. Printed are the least work, over the largest change of the stress times the
//! amplitude, and how many cycles are below zero by more than what the integration errs.

use msdd_surrogate::kernel::{LANES, Lanes};
use msdd_surrogate::models;
use msdd_surrogate::surrogate::{Answer, Increment, InitialData, StateLanes, Surrogate};
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::{Rng, SeedableRng};

const AMPLITUDES: [f64; 4] = [1e-5, 1e-4, 1e-3, 5e-3];
const REPEATS: usize = 10;
/// Parts of each of the four sides of a cycle.
const PARTS: usize = 16;
/// Change of the stress in the last repeat, over the largest change, up to which the state counts as the same again. Grains
/// that have not yet found their place may give away energy that they stored before.
const CLOSED: f64 = 1e-4;
/// Error of the integration, over the energy that goes to and fro.
const ERROR: f64 = 1e-3;

/// Thermal strain, growth of the area, half of xx − yy, and 2 xy; the first two as logarithms. These add up.
type Strain = [Lanes; 4];

struct Cells {
    state: StateLanes,
    answer: Answer,
    /// Logarithm of the area of the cells over that of their grains, since the start.
    spread: Lanes,
}

impl Cells {
    fn strain(&mut self, model: &dyn Surrogate, step: &Strain, share: f64, keep: bool) {
        let lanes = |of: &dyn Fn([f64; 4]) -> f64| {
            std::array::from_fn(|lane| of([0, 1, 2, 3].map(|c: usize| share * step[c][lane])))
        };
        let mean =
            |area: f64, half: f64, shear: f64| (area.exp() + half * half + 0.25 * shear * shear).sqrt();
        let strain = Increment {
            thermal: lanes(&|[thermal, ..]| thermal.exp() - 1.0),
            xx: lanes(&|[_, area, half, shear]| mean(area, half, shear) - 1.0 + half),
            yy: lanes(&|[_, area, half, shear]| mean(area, half, shear) - 1.0 - half),
            xy: lanes(&|[_, _, _, shear]| shear),
            rotation: [0.0; LANES],
        };
        model.advance(&self.state, &strain, &mut self.answer, None);
        if keep {
            self.state = self.answer.state;
            (0..LANES).for_each(|lane| self.spread[lane] += share * (step[1][lane] - 2.0 * step[0][lane]));
        }
    }

    /// −σ̃ : dε over the area of the grains, for the stress of the last answer; `ahead`: share of the step since `spread`.
    fn power(&self, step: &Strain, ahead: f64, lane: usize) -> f64 {
        let [xx, yy, xy] = self.answer.stress.map(|column| column[lane]);
        let growth = step[1][lane] - 2.0 * step[0][lane];
        let area = (self.spread[lane] + ahead * growth).exp();
        -area * (0.5 * (xx + yy) * growth + (xx - yy) * step[2][lane] + xy * step[3][lane])
    }
}

/// Uniform between −1 and 1.
fn symmetric_unit(random: &mut ChaCha8Rng) -> f64 {
    (random.next_u64() >> 11) as f64 / (1u64 << 52) as f64 - 1.0
}

/// Work of the last repeat of cycles of a block of cells, over the largest change of stress times the amplitude.
fn cycles(model: &dyn Surrogate, random: &mut ChaCha8Rng, amplitude: f64) -> [(f64, f64); LANES] {
    let mut cells = Cells { state: start(model, random), answer: Answer::default(), spread: [0.0; LANES] };
    let mut corners = [[[0.0; LANES]; 4]; 4];
    for value in corners[..3].iter_mut().flatten().flatten() {
        *value = amplitude * symmetric_unit(random);
    }
    let (mut work, mut change, mut moved) = ([0.0; LANES], [f64::MIN_POSITIVE; LANES], [0.0; LANES]);
    for _ in 0..REPEATS {
        work = [0.0; LANES];
        change = [f64::MIN_POSITIVE; LANES];
        cells.strain(model, &[[0.0; LANES]; 4], 1.0, true);
        let first = cells.answer.stress;
        for k in 0..4 {
            let from = corners[(k + 3) % 4];
            let step: Strain = std::array::from_fn(|c| {
                std::array::from_fn(|lane| (corners[k][c][lane] - from[c][lane]) / PARTS as f64)
            });
            for _ in 0..PARTS {
                let mut power = [0.0; LANES];
                for (share, ahead, weight) in [(0.0, 0.0, 1.0), (0.5, 0.5, 4.0), (1.0, 0.0, 1.0)] {
                    cells.strain(model, &step, share, share == 1.0);
                    for (lane, power) in power.iter_mut().enumerate() {
                        *power += weight / 6.0 * cells.power(&step, ahead, lane);
                    }
                }
                for lane in 0..LANES {
                    work[lane] += power[lane];
                    for (now, first) in cells.answer.stress.iter().zip(&first) {
                        change[lane] = f64::max(change[lane], (now[lane] - first[lane]).abs());
                    }
                }
            }
        }
        moved = std::array::from_fn(|lane| {
            let parts = [0, 1, 2].map(|c: usize| (cells.answer.stress[c][lane] - first[c][lane]).abs());
            parts.into_iter().fold(0.0, f64::max) / change[lane]
        });
    }
    std::array::from_fn(|lane| (work[lane] / (change[lane] * amplitude), moved[lane]))
}

/// Packings of porosities from 0.06 to 0.19 with the pressures that go with them, give or take a tenth.
fn start(model: &dyn Surrogate, random: &mut ChaCha8Rng) -> StateLanes {
    let mut state = StateLanes::default();
    for lane in 0..LANES {
        let porosity = 0.125 + 0.065 * symmetric_unit(random);
        let pressure = (0.86 * (0.2 - porosity)) * (1.0 + 0.1 * symmetric_unit(random));
        let [along, across] = [0.25, 0.1].map(|ratio| ratio * pressure * symmetric_unit(random));
        let known = InitialData {
            porosity,
            reduced_stress: Some([pressure + along, pressure - along, across]),
            ..InitialData::default()
        };
        model
            .initial_state(&known)
            .into_iter()
            .zip(&mut state)
            .for_each(|(value, column)| column[lane] = value);
    }
    state
}

fn main() {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let count: usize = arguments.first().and_then(|n| n.parse().ok()).expect("a number of cycles");
    let model = match arguments.get(1) {
        None => models::builtin(models::BUILTIN),
        Some(file) => models::read(&std::fs::read_to_string(file).expect("readable")),
    };
    let (model, mut random) = (model.expect("a model"), ChaCha8Rng::seed_from_u64(1));
    println!("amplitude | cycles | not closed | below zero | least | mean");
    for amplitude in AMPLITUDES {
        let blocks = count.div_ceil(AMPLITUDES.len() * LANES);
        let (mut least, mut sum, mut below, mut open) = (f64::INFINITY, 0.0, 0, 0);
        for _ in 0..blocks {
            for (work, moved) in cycles(&*model, &mut random, amplitude) {
                if moved > CLOSED {
                    open += 1;
                    continue;
                }
                (least, sum) = (least.min(work), sum + work);
                below += usize::from(work < -ERROR);
            }
        }
        let cycles = blocks * LANES;
        println!(
            "{amplitude:e} | {cycles} | {open} | {below} | {least:.2e} | {:.2e}",
            sum / (cycles - open) as f64
        );
    }
}
