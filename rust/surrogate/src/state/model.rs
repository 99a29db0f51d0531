//! The trained state model as a [`Surrogate`].

use super::core::Core;
use super::mean::MeanState;
use super::provenance::Provenance;
use super::variables::{FABRIC_INDEX, POROSITY, PRESSURE};
use crate::dataset::ConductivityKind;
use crate::kernel::{LANES, Lanes};
use crate::mechanics::{Mechanics, Tangent};
use crate::options::TrainingOptions;
use crate::region::{Region, Spread};
use crate::solid_fraction::SolidFraction;
use crate::surrogate::{Answer, Doubt, Known, MAX_STATE, StateLanes, Surrogate};
use crate::wall_friction::WallFriction;

/// A trained state model; the module [`super`] explains it.
#[derive(Clone, Debug, PartialEq)]
pub struct StateModel {
    pub core: Core,
    pub mean: MeanState,
    pub region: Region,
    pub spread: Spread,
    pub solid_fraction: SolidFraction,
    pub mechanics: Option<Mechanics>,
    pub wall_friction: Option<WallFriction>,
    pub name: String,
    pub provenance: Provenance,
    pub(crate) hash: String,
}

impl StateModel {
    /// The same model, answering with another kind of conductivity; `None` when it was not trained for that.
    pub fn with_conductivity(mut self, kind: ConductivityKind) -> Option<Self> {
        self.core.active = self.core.readouts.iter().position(|readout| readout.kind == kind)?;
        Some(self)
    }
}

impl Surrogate for StateModel {
    fn kind(&self) -> &'static str {
        "state"
    }

    fn name(&self) -> &str {
        &self.name
    }

    fn hash(&self) -> &str {
        &self.hash
    }

    fn training(&self) -> &TrainingOptions {
        &self.provenance.training.common
    }

    fn conductivity_kind(&self) -> ConductivityKind {
        self.core.readouts[self.core.active].kind
    }

    fn conductivity_kinds(&self) -> Vec<ConductivityKind> {
        self.core.readouts.iter().map(|readout| readout.kind).collect()
    }

    fn fabric_conductivity_kind(&self) -> ConductivityKind {
        let carried = self.core.readouts.iter().find(|readout| readout.carried);
        carried.unwrap_or(&self.core.readouts[0]).kind
    }

    fn answering_with(&self, kind: ConductivityKind) -> Option<Box<dyn Surrogate>> {
        Some(Box::new(self.clone().with_conductivity(kind)?))
    }

    fn mechanics(&self) -> Option<&Mechanics> {
        self.mechanics.as_ref()
    }

    fn wall_friction(&self) -> Option<&WallFriction> {
        self.wall_friction.as_ref()
    }

    fn to_json(&self) -> String {
        self.text()
    }

    fn state_names(&self) -> &[&'static str] {
        self.core.variables.names()
    }

    fn initial_state(&self, known: &Known) -> [f64; MAX_STATE] {
        let variables = self.core.variables;
        let stress = known.reduced_stress.map(|[xx, yy]| {
            let pressure = (0.5 * (xx + yy)).max(0.0);
            [pressure, (0.5 * (xx - yy)).clamp(-pressure, pressure)]
        });
        let filled = self.mean.filled(known.porosity, known.fabric_index, known.fabric_conductivity, stress);
        let mut state = [0.0; MAX_STATE];
        state[POROSITY] = known.porosity;
        state[FABRIC_INDEX] = known.fabric_index;
        state[PRESSURE] = filled.pressure;
        if let Some(column) = variables.fabric_conductivity() {
            state[column] = filled.fabric_conductivity;
        }
        if let Some(column) = variables.deviator() {
            state[column] = filled.deviator;
        }
        state
    }

    fn block(&self, state: &StateLanes, strain: &Lanes) -> Answer {
        self.core.block(state, strain)
    }

    fn block_into(&self, state: &StateLanes, strain: &Lanes, virgin: &Lanes, answer: &mut Answer) {
        self.core.answer(state, strain, virgin, answer);
    }

    fn tangent(&self, state: &[f64; MAX_STATE]) -> Option<Tangent> {
        let pressure = state[PRESSURE];
        let deviator = self.core.variables.deviator().map_or(0.0, |column| state[column]);
        let ratio = if pressure > 0.0 { deviator / pressure } else { 0.0 };
        self.mechanics.as_ref().map(|law| law.tangent(pressure, ratio, state[POROSITY]))
    }

    fn deformed(&self, state: &StateLanes, strain: &[Lanes; 2]) -> StateLanes {
        let variables = self.core.variables;
        let mut next = *state;
        for lane in 0..LANES {
            let Some(t) = self.tangent(&state.map(|column| column[lane])) else { return next };
            let [xx, yy] = strain.map(|column| column[lane]);
            let [sxx, syy] = [t.c11 * xx + t.c12 * yy, t.c12 * xx + t.c22 * yy];
            let pressure = (state[PRESSURE][lane] - 0.5 * (sxx + syy)).max(0.0);
            next[PRESSURE][lane] = pressure;
            next[POROSITY][lane] += t.porosity * (xx + yy);
            next[FABRIC_INDEX][lane] += t.fabric_index * (xx - yy);
            if let Some(column) = variables.fabric_conductivity() {
                next[column][lane] += t.fabric_conductivity * (xx - yy);
            }
            if let Some(column) = variables.deviator() {
                next[column][lane] = (state[column][lane] - 0.5 * (sxx - syy)).clamp(-pressure, pressure);
            }
        }
        next
    }

    fn doubt(&self, state: &[f64; MAX_STATE]) -> Option<Doubt> {
        let point = self.core.ranges.coordinates(self.core.variables, state);
        let [conductivity_spread, pressure_rate_spread] = self.spread.at(state[PRESSURE]);
        Some(Doubt {
            beyond_hull: self.region.beyond_hull(&point),
            distance: self.region.distance(&point),
            conductivity_spread,
            pressure_rate_spread,
        })
    }

    fn solid_fraction(&self, porosity: f64) -> f64 {
        self.solid_fraction.at(porosity)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::kernel::vector::Portable;
    use crate::state::training::{Mechanical, StateOptions, train};
    use crate::surrogate::{Batch, VIRGIN, evaluate_batch};
    use crate::synthetic;
    use rand_chacha::ChaCha8Rng;
    use rand_chacha::rand_core::{Rng, SeedableRng};

    fn model() -> StateModel {
        let mut options = StateOptions::default();
        (options.common.max_epochs, options.common.restarts) = (15, 2);
        train(&synthetic::rows(12, 4), &Mechanical::default(), &options).expect("good rows")
    }

    /// A block of states: inside the trained range, at its edges, and far outside of what grains can have.
    fn wild(random: &mut ChaCha8Rng) -> (StateLanes, Lanes) {
        let mut unit = || (random.next_u64() >> 11) as f64 / (1u64 << 53) as f64;
        let scale = [1.0, 10.0, 1e3, 1e12][(4.0 * unit()) as usize];
        let mut signed = |size: f64| -> Lanes { std::array::from_fn(|_| size * (2.0 * unit() - 1.0)) };
        let mut state = [[0.0; LANES]; MAX_STATE];
        for (column, size) in state.iter_mut().zip([0.3, 0.3, 0.3, 0.3, 0.2]) {
            *column = signed(size * scale);
        }
        let mut strain = signed(0.1 * scale.min(9.0));
        state[PRESSURE][0] = 0.0;
        state[PRESSURE][1] = f64::MIN_POSITIVE;
        // Column 4 of the state is the deviator.
        (state[PRESSURE][3], state[4][3]) = (-1e196, f64::MAX);
        strain[2] = 0.0;
        (state, strain)
    }

    #[test]
    fn a_million_wild_queries_give_no_nan_no_tension_and_positive_conductivity() {
        let (model, mut random) = (model(), ChaCha8Rng::seed_from_u64(9));
        for _ in 0..125_000 {
            let (mut state, strain) = wild(&mut random);
            for _ in 0..2 {
                let answer = model.block(&state, &strain);
                let numbers = answer.state.iter().chain(&answer.conductivity).chain(&answer.stress);
                assert!(numbers.flatten().all(|value| value.is_finite()), "{state:?} {strain:?}");
                assert!(answer.conductivity.iter().flatten().all(|k| *k > 0.0), "{state:?} {strain:?}");
                assert!(answer.stress.iter().flatten().all(|s| *s >= 0.0), "{state:?} {strain:?}");
                assert!(answer.outside.iter().flatten().all(|o| !o.is_nan()));
                state = answer.state;
            }
        }
    }

    /// The floating-point flags invalid, divide-by-zero and overflow that were raised since the last call.
    #[cfg(target_arch = "x86_64")]
    #[allow(unsafe_code)]
    fn raised() -> u32 {
        let (mut flags, mut cleared) = (0u32, 0u32);
        // SAFETY: stores and loads the thread's control register; only its status flags change.
        unsafe {
            std::arch::asm!("stmxcsr [{}]", in(reg) &mut flags);
            cleared |= flags & !0b11_1111;
            std::arch::asm!("ldmxcsr [{}]", in(reg) &cleared);
        }
        flags & 0b1101
    }

    #[cfg(target_arch = "x86_64")]
    #[test]
    fn no_query_raises_invalid_division_by_zero_or_overflow() {
        let (model, mut random) = (model(), ChaCha8Rng::seed_from_u64(13));
        let _ = raised();
        std::hint::black_box(std::hint::black_box(1.0) / std::hint::black_box(0.0f64));
        assert_ne!(raised(), 0, "the flags are seen");
        for _ in 0..20_000 {
            let (state, strain) = wild(&mut random);
            let _ = raised();
            let mut answer = model.block(&state, &strain);
            assert_eq!(raised(), 0, "{state:?} {strain:?}");
            model.core.block_into::<Portable>(&state, &strain, &VIRGIN, &mut answer);
            assert_eq!(raised(), 0, "{state:?} {strain:?}");
        }
    }

    #[test]
    fn a_turn_by_90_degrees_turns_the_answer_to_the_bit_and_zero_strain_changes_nothing() {
        let (model, mut random) = (model(), ChaCha8Rng::seed_from_u64(3));
        for _ in 0..2000 {
            let (state, strain) = wild(&mut random);
            let answer = model.block(&state, &strain);
            let mut turned = state;
            model.core.variables.odd().for_each(|k| turned[k] = turned[k].map(|v| -v));
            let other = model.block(&turned, &strain);
            assert_eq!(other.conductivity, [answer.conductivity[1], answer.conductivity[0]]);
            assert_eq!(other.stress, [answer.stress[1], answer.stress[0]]);
            let mut back = other.state;
            model.core.variables.odd().for_each(|k| back[k] = back[k].map(|v| -v));
            assert_eq!(back, answer.state);
            // A state that the model allows is not changed by zero strain.
            assert_eq!(model.block(&answer.state, &[0.0; LANES]).state, answer.state);
        }
    }

    #[test]
    fn every_instruction_set_and_every_place_in_any_batch_gives_the_same_bits() {
        let (model, mut random) = (model(), ChaCha8Rng::seed_from_u64(5));
        for _ in 0..500 {
            let (state, strain) = wild(&mut random);
            let answer = model.block(&state, &strain);
            let mut portable = Answer::default();
            model.core.block_into::<Portable>(&state, &strain, &VIRGIN, &mut portable);
            assert_eq!(format!("{answer:?}"), format!("{portable:?}"));
        }
        let cells = 19;
        let blocks: Vec<_> = (0..3).map(|_| wild(&mut random)).collect();
        let cell = |i: usize, k: usize| blocks[i / LANES].0[k][i % LANES];
        let strain: Vec<f64> = (0..cells).map(|i| blocks[i / LANES].1[i % LANES]).collect();
        let columns: Vec<Vec<f64>> = (0..5).map(|k| (0..cells).map(|i| cell(i, k)).collect()).collect();
        for first in 0..cells {
            for last in first + 1..=cells {
                let from: Vec<&[f64]> = columns.iter().map(|column| &column[first..last]).collect();
                let mut to = vec![vec![0.0; last - first]; 5];
                let mut next: Vec<&mut [f64]> = to.iter_mut().map(Vec::as_mut_slice).collect();
                let mut batch = Batch {
                    strain: &strain[first..last],
                    state: &from,
                    next_state: &mut next,
                    conductivity: None,
                    stress: None,
                    outside: None,
                };
                evaluate_batch(&model, &mut batch);
                for i in first..last {
                    let state = std::array::from_fn(|k| if k < 5 { cell(i, k) } else { 0.0 });
                    let alone = model.evaluate(&state, strain[i]);
                    assert!((0..5).all(|k| to[k][i - first].to_bits() == alone.state[k][0].to_bits()));
                }
            }
        }
    }

    #[test]
    fn contraction_ends_without_stress_and_expansion_brings_it_back() {
        let model = model();
        let start = model.initial_state(&Known { porosity: 0.16, fabric_index: 0.05, ..Known::default() });
        assert!(start[PRESSURE] > 0.0);
        let run = |mut state: [f64; MAX_STATE], strain: f64, count: usize| {
            let mut answer = model.evaluate(&state, strain);
            for _ in 1..count {
                state = answer.state.map(|column| column[0]);
                answer = model.evaluate(&state, strain);
            }
            answer
        };
        let loose = run(start, -1e-4, 2000);
        assert_eq!((loose.stress[0][0], loose.stress[1][0]), (0.0, 0.0));
        assert!(loose.conductivity[0][0] > 0.0 && loose.conductivity[0][0] < 1e-3);
        let again = run(loose.state.map(|column| column[0]), 1e-4, 4000);
        assert!(again.stress[0][0] > 0.01 && again.conductivity[0][0] > 0.05, "{:?}", again.stress);
    }

    /// Ten cycles of ±2 % as in case `cycle`: changes that only virgin strains cause happen in the first cycle alone.
    #[test]
    fn cycles_leave_the_fabric_as_the_first_one_did() {
        let model = crate::models::builtin(crate::models::BUILTIN).expect("sound");
        let known = Known {
            porosity: 0.1215,
            fabric_index: 0.0498,
            fabric_conductivity: Some(0.137),
            reduced_stress: None,
        };
        let count = 20;
        let after_cycles = |remembers: bool| {
            let mut state = model.initial_state(&known).map(|value| [value; LANES]);
            let mut ratio = Vec::new();
            for cycle in 0..10 {
                for (first, last) in [(0.0, 0.02), (0.02, 0.0), (0.0, -0.02), (-0.02, 0.0)] {
                    let new = cycle == 0 && last != 0.0 || !remembers;
                    let radius = |k: usize| 1.0 + first + (last - first) * k as f64 / count as f64;
                    for k in 0..count {
                        let (strain, mut answer) = (radius(k + 1) / radius(k) - 1.0, Answer::default());
                        let share = [f64::from(u8::from(new)); LANES];
                        model.block_into(&state, &[strain; LANES], &share, &mut answer);
                        state = answer.state;
                    }
                }
                ratio.push([FABRIC_INDEX, 3].map(|column| state[column][0]));
            }
            let moved = |column: usize| (ratio[9][column] - ratio[0][column]).abs();
            [moved(0), moved(1)]
        };
        let [fabric_index, fabric_conductivity] = after_cycles(true);
        assert!(fabric_index < 0.01 && fabric_conductivity < 0.02, "{fabric_index} {fabric_conductivity}");
        let [fabric_index, _] = after_cycles(false);
        assert!(fabric_index > 0.05, "{fabric_index}: without memory it drifts");
    }

    #[test]
    fn what_is_known_of_the_start_is_kept_and_the_rest_is_the_mean() {
        let model = model();
        let known = Known {
            porosity: 0.12,
            fabric_index: 0.01,
            fabric_conductivity: Some(0.03),
            reduced_stress: Some([0.0625, 0.0375]),
        };
        let state = model.initial_state(&known);
        assert_eq!(state[..4], [0.12, 0.01, 0.05, 0.03]);
        assert_eq!(state[4], 0.0125);
        let mean = model.initial_state(&Known { porosity: 0.12, fabric_index: 0.01, ..Known::default() });
        let law = 0.4 * 0.08 + 4.0 * 0.08 * 0.08; // of the synthetic states
        assert!((mean[PRESSURE] - law).abs() < 0.05 * law, "{mean:?}");
        let doubt = model.doubt(&state).expect("the model knows its region");
        assert!(doubt.distance.is_finite() && doubt.conductivity_spread >= 0.0);
        let far =
            model.doubt(&[0.5, 0.0, 0.4, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0]).expect("the model knows its region");
        assert!(far.beyond_hull > 1.0 && far.distance > 3.0, "{far:?}");
    }

    #[test]
    fn same_seed_gives_the_same_bytes_whatever_the_thread_count() {
        let text = |threads: usize| {
            let mut options = StateOptions::default();
            (options.common.max_epochs, options.common.restarts) = (6, 3);
            options.common.threads = threads;
            train(&synthetic::rows(8, 3), &Mechanical::default(), &options).expect("good rows").to_json()
        };
        assert_eq!(text(1), text(2));
    }

    #[test]
    fn bad_files_are_refused_with_the_reason() {
        let good: serde_json::Value = serde_json::from_str(&model().to_json()).expect("JSON");
        let refused = |pointer: &str, value: serde_json::Value, expected: &str| {
            let mut changed = good.clone();
            *changed.pointer_mut(pointer).expect("key") = value;
            let message = crate::state::file::read(&changed.to_string()).expect_err(pointer).to_string();
            assert!(message.contains(expected), "{pointer}: {message}");
        };
        refused("/schema", "msdd-state-model-9".into(), "msdd-state-model-9");
        refused("/rates/network/weights/3", 1e300.into(), "rates.network.weights[3]");
        refused("/rates/network/sizes/0", 7.into(), "rates.network.sizes");
        refused("/readouts", serde_json::json!([]), "readouts");
        refused("/ranges/porosity/max", (-1.0).into(), "ranges.porosity");
        refused("/variables/stress_deviator", false.into(), "rates.network.sizes");
        refused("/spread/conductivity/2", (-1.0).into(), "spread.conductivity = -1");
        refused("/mean_state/porosity/max", (-1.0).into(), "mean_state.porosity");
        refused("/solid_fraction/coefficients/0", 1e300.into(), "solid_fraction.coefficients");
        let mut extra = good.clone();
        extra["surprise"] = 1.into();
        let message = crate::state::file::read(&extra.to_string()).expect_err("unknown key").to_string();
        assert!(message.contains("surprise"), "{message}");
    }
}
