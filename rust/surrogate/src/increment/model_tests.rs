//! Tests of the model as a whole: wild inputs, floating-point exceptions, turns, instruction sets, blocks, files.

use super::*;
use crate::increment::synthetic;
use crate::increment::training::train;
use crate::kernel::{Lanes, with_every_set};
use crate::training_data::TrainingData;
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::{Rng, SeedableRng};

fn trained(packings: i64, epochs: u32, threads: usize) -> IncrementModel {
    let data = TrainingData { tracks: synthetic::tracks(packings, 5), ..TrainingData::default() };
    let options = TrainingOptions { max_epochs: epochs, threads, ..TrainingOptions::default() };
    train(&data, &options).expect("good paths")
}

fn shipped() -> IncrementModel {
    read(include_str!("../../models/increment.json")).expect("the shipped model is sound")
}

/// A law that was fitted to few packings: its bulk modulus falls at large compressions, and with looseness.
fn softening() -> IncrementModel {
    let mut model = shipped();
    model.core.law.bulk = [0.3575, 1.3086, -1.328];
    model.core.law.looseness = [1.816, -30.087, -6.617];
    model.file.law = model.core.law.clone();
    model
}

#[test]
fn a_law_that_softens_has_starts_with_the_stress_that_is_known() {
    let model = softening();
    for (porosity, p) in [(0.19, 0.001), (0.17, 0.015), (0.13, 0.04)] {
        let known = InitialData { porosity, reduced_stress: Some([p, p, 0.0]), ..InitialData::default() };
        let answer = model.evaluate(&model.initial_state(&known), 0.0);
        assert!((answer.stress[0][0] / p - 1.0).abs() < 1e-6, "{porosity} {p}: {answer:?}");
    }
}

/// Any states and strains: from those of grains to absurd ones.
fn wild(random: &mut ChaCha8Rng) -> (StateLanes, Increment) {
    let mut unit = || (random.next_u64() >> 11) as f64 / (1u64 << 53) as f64;
    let scale = [1.0, 1.0, 10.0, 1e3, 1e12][(5.0 * unit()) as usize];
    let mut signed = |size: f64| -> Lanes { std::array::from_fn(|_| size * (2.0 * unit() - 1.0)) };
    let mut state = [[0.0; LANES]; MAX_STATE];
    for column in &mut state {
        *column = signed(0.3 * scale);
    }
    if scale == 1.0 {
        // About the states of packings.
        state[JAMMING] = signed(0.05).map(|v| 0.83 + v);
        state[COMPRESSION] = signed(0.2);
        state[STRENGTH] = signed(0.5).map(|v| 1.0 + v);
    }
    let size = 0.1 * scale.min(90.0);
    let [thermal, xx, yy, xy, rotation] = std::array::from_fn(|_| signed(size));
    let mut strain = Increment { thermal, xx, yy, xy, rotation };
    state[COMPRESSION][0] = 0.0;
    state[COMPRESSION][1] = f64::MIN_POSITIVE;
    (state[COMPRESSION][3], state[SHEAR][3]) = (-1e196, f64::MAX);
    (state[COMPRESSION][4], state[JAMMING][4]) = (f64::MAX, f64::MIN);
    for column in [&mut strain.thermal, &mut strain.xx, &mut strain.yy, &mut strain.xy, &mut strain.rotation]
    {
        column[2] = 0.0;
    }
    strain.rotation[5] = f64::MAX;
    (strain.xx[6], strain.yy[6]) = (f64::MIN, f64::MIN);
    (state, strain)
}

#[test]
fn a_million_wild_queries_give_no_nan_no_tension_and_positive_conductivity() {
    let (models, mut random) = ([trained(8, 3, 1), shipped(), softening()], ChaCha8Rng::seed_from_u64(9));
    for query in 0..62_500 {
        let (mut state, strain) = wild(&mut random);
        let model = &models[query % 3];
        for _ in 0..2 {
            let (mut answer, mut tangent) = (Answer::default(), Tangent::default());
            model.advance(&state, &strain, &mut answer, Some(&mut tangent));
            let numbers = answer.state.iter().chain(&answer.conductivity).chain(&answer.stress);
            let finite = numbers.chain(tangent.iter().flatten()).flatten().all(|value| value.is_finite());
            assert!(finite, "{state:?} {strain:?} {answer:?} {tangent:?}");
            assert!(answer.outside.iter().flatten().all(|o| !o.is_nan()));
            for lane in 0..LANES {
                let [kxx, kyy, kxy] = answer.conductivity.map(|column| column[lane]);
                assert!(
                    kxx > 0.0 && kyy > 0.0 && kxy * kxy < kxx * kyy,
                    "{kxx} {kyy} {kxy} {state:?} {strain:?}"
                );
                let [xx, yy, xy] = answer.stress.map(|column| column[lane]);
                let pulls = xx < 0.0 || yy < 0.0 || xy * xy > xx * yy;
                assert!(!pulls, "{xx} {yy} {xy} {state:?} {strain:?}");
                let [porosity, jamming, compression] =
                    [POROSITY, JAMMING, COMPRESSION].map(|k| answer.state[k][lane]);
                let grains = (0.0..1.0).contains(&porosity) && jamming > 0.0 && compression > -1.0;
                assert!(grains || strain_is_zero(&strain, lane), "{porosity} {jamming} {compression}");
            }
            state = answer.state;
        }
    }
}

fn strain_is_zero(strain: &Increment, lane: usize) -> bool {
    let Increment { thermal, xx, yy, xy, rotation } = strain;
    [thermal, xx, yy, xy, rotation].iter().all(|column| column[lane] == 0.0)
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
    let (models, mut random) = ([trained(8, 3, 1), shipped(), softening()], ChaCha8Rng::seed_from_u64(13));
    let _ = raised();
    std::hint::black_box(std::hint::black_box(1.0) / std::hint::black_box(0.0f64));
    assert_ne!(raised(), 0, "the flags are seen");
    for query in 0..20_000 {
        let (state, strain) = wild(&mut random);
        let (mut answer, mut tangent) = (Answer::default(), Tangent::default());
        let mut ask = |with: bool| {
            let _ = raised();
            let core = &models[query % 3].core;
            core.advance(&state, &strain, &mut answer, with.then_some(&mut tangent));
            assert_eq!(raised(), 0, "{with} {state:?} {strain:?}");
        };
        ask(false);
        ask(true);
        if query % 20 == 0 {
            with_every_set(|_| ask(true));
        }
    }
    // Starts of which more is known than grains can have.
    for query in 0..20_000 {
        let mut unit = || (random.next_u64() >> 11) as f64 / (1u64 << 53) as f64;
        let scale = [1e-30, 1e-6, 0.1, 1.0, 1e25][(5.0 * unit()) as usize];
        let mut signed = |size: f64| size * (2.0 * unit() - 1.0);
        let known = InitialData {
            porosity: 0.5 + signed(0.5),
            fabric_index: signed(1.0),
            fabric_xy: signed(1.0),
            reduced_stress: (query % 3 > 0).then(|| [signed(scale), signed(scale), signed(scale)]),
            conductivity: (query % 2 > 0).then(|| [signed(scale).abs(), signed(scale).abs(), signed(scale)]),
        };
        let known =
            if query % 7 == 0 { InitialData { reduced_stress: Some([0.0; 3]), ..known } } else { known };
        let _ = raised();
        let state = models[query / 2 % 3].initial_state(&known);
        assert_eq!(raised(), 0, "start {known:?}");
        let answer = models[query / 2 % 3].evaluate(&state, 0.0);
        assert_eq!(raised(), 0, "{known:?}");
        let numbers = answer.state.iter().chain(&answer.conductivity).chain(&answer.stress).flatten();
        assert!(numbers.into_iter().all(|value| value.is_finite()), "{known:?} {answer:?}");
        let [[kxx, ..], [kyy, ..], [kxy, ..]] = answer.conductivity;
        assert!(kxx > 0.0 && kyy > 0.0 && kxy * kxy < kxx * kyy, "{known:?} {answer:?}");
    }
}

#[test]
fn a_turn_by_90_degrees_turns_the_answer_and_zero_strain_changes_nothing() {
    let (model, mut random) = (shipped(), ChaCha8Rng::seed_from_u64(3));
    let odd = [FABRIC_INDEX, FABRIC_SHEAR, SHEAR, SHEAR + 1, SHEAR + 2, SHEAR + 3, COLUMNS - 2, COLUMNS - 1];
    let turn = |state: &StateLanes| {
        let mut turned = *state;
        odd.iter().for_each(|&k| turned[k] = turned[k].map(|v| -v));
        turned
    };
    for _ in 0..2000 {
        let (state, strain) = wild(&mut random);
        let (mut answer, mut other) = (Answer::default(), Answer::default());
        model.advance(&state, &strain, &mut answer, None);
        let turned = Increment { xx: strain.yy, yy: strain.xx, xy: strain.xy.map(|v| -v), ..strain };
        model.advance(&turn(&state), &turned, &mut other, None);
        let near = |a: &Lanes, b: &Lanes, sign: f64, what: &str| {
            for (a, b) in a.iter().zip(b) {
                assert!(
                    (a - sign * b).abs() <= 1e-12 * (1.0 + a.abs()),
                    "{what}: {a} {b} {state:?} {strain:?}"
                );
            }
        };
        for ([a, b, c], [d, e, f]) in
            [(answer.stress, other.stress), (answer.conductivity, other.conductivity)]
        {
            near(&a, &e, 1.0, "xx");
            near(&b, &d, 1.0, "yy");
            near(&c, &f, -1.0, "xy");
        }
        let back = turn(&other.state);
        (0..MAX_STATE).for_each(|k| near(&answer.state[k], &back[k], 1.0, NAMES[k]));
        assert_eq!(model.block(&answer.state, &[0.0; LANES]).state, answer.state);
    }
}

#[test]
fn a_cell_that_only_turns_keeps_its_stress_along_the_grains() {
    let model = shipped();
    let stress = [0.07, 0.05, 0.004];
    let known = InitialData {
        porosity: 0.12,
        fabric_index: 0.02,
        reduced_stress: Some(stress),
        ..InitialData::default()
    };
    let known = InitialData { conductivity: Some([0.31, 0.27, 0.01]), ..known };
    let start = model.initial_state(&known);
    let angle: f64 = 1e-2;
    let strain = Increment { rotation: [angle; LANES], ..Increment::default() };
    let mut answer = Answer::default();
    model.advance(&start.map(|value| [value; LANES]), &strain, &mut answer, None);
    let turned = |[xx, yy, xy]: [f64; 3]| {
        let (mean, half, (s, c)) = (0.5 * (xx + yy), 0.5 * (xx - yy), (2.0 * angle).sin_cos());
        let (along, across) = (c * half - s * xy, s * half + c * xy);
        [mean + along, mean - along, across]
    };
    let found = answer.stress.map(|column| column[0]);
    let conductivity = answer.conductivity.map(|column| column[0]);
    for k in 0..3 {
        assert!((found[k] - turned(stress)[k]).abs() < 1e-6, "{found:?} {:?}", turned(stress));
        assert!((conductivity[k] - turned([0.31, 0.27, 0.01])[k]).abs() < 1e-6, "{conductivity:?}");
    }
    assert!((answer.state[POROSITY][0] - 0.12).abs() < 1e-6);
}

#[test]
fn every_instruction_set_and_every_place_in_a_block_gives_the_same_bits() {
    let (model, mut random) = (shipped(), ChaCha8Rng::seed_from_u64(5));
    for _ in 0..500 {
        let (state, strain) = wild(&mut random);
        let mut answers = Vec::new();
        with_every_set(|_| {
            let (mut answer, mut tangent) = (Answer::default(), Tangent::default());
            model.advance(&state, &strain, &mut answer, Some(&mut tangent));
            answers.push(format!("{answer:?} {tangent:?}"));
        });
        assert!(answers.windows(2).all(|pair| pair[0] == pair[1]), "{state:?} {strain:?}");
    }
    for first in 0..4 * LANES {
        let (state, strain) = wild(&mut random);
        // The cells of the block, each in another lane.
        let turned = |column: &Lanes| std::array::from_fn(|lane| column[(lane + first) % LANES]);
        let (mut block, mut tangent) = (Answer::default(), Tangent::default());
        let thermal = Increment::thermal(&turned(&strain.thermal));
        model.advance(&state.each_ref().map(turned), &thermal, &mut block, Some(&mut tangent));
        for lane in 0..LANES {
            let cell = (lane + first) % LANES;
            let (mut alone, mut slope) = (Answer::default(), Tangent::default());
            let thermal = Increment::thermal(&[strain.thermal[cell]; LANES]);
            model.advance(&state.map(|column| [column[cell]; LANES]), &thermal, &mut alone, Some(&mut slope));
            let same = |(a, b): (&Lanes, &Lanes)| a[lane].to_bits() == b[0].to_bits();
            assert!(block.state.iter().zip(&alone.state).all(same));
            assert!(tangent.as_flattened().iter().zip(slope.as_flattened()).all(same));
        }
    }
}

#[test]
fn contraction_ends_without_stress_and_expansion_brings_it_back() {
    let model = shipped();
    let start =
        model.initial_state(&InitialData { porosity: 0.16, fabric_index: 0.02, ..InitialData::default() });
    assert!(model.evaluate(&start, 0.0).stress[0][0] > 0.0);
    let run = |mut state: [f64; MAX_STATE], strain: f64, count: usize| {
        let mut answer = model.evaluate(&state, strain);
        for _ in 1..count {
            state = answer.state.map(|column| column[0]);
            answer = model.evaluate(&state, strain);
        }
        answer
    };
    let loose = run(start, -1e-4, 1000);
    assert_eq!(loose.stress.map(|column| column[0]), [0.0; 3]);
    assert!(loose.conductivity[0][0] > 0.0 && loose.conductivity[0][0] < 1e-3);
    let again = run(loose.state.map(|column| column[0]), 1e-4, 1200);
    assert!(again.stress[0][0] > 0.005 && again.conductivity[0][0] > 0.05, "{:?}", again.stress);
}

/// Cycles of ±2 % as in case `cycle`: the state that the first ones leave hardly changes in later ones.
#[test]
fn cycles_come_to_an_end() {
    let model = shipped();
    let known = InitialData { porosity: 0.1215, fabric_index: 0.0498, ..InitialData::default() };
    let mut state = model.initial_state(&known).map(|value| [value; LANES]);
    let mut ends = Vec::new();
    let count = 20;
    for _ in 0..10 {
        for (first, last) in [(0.0, 0.02), (0.02, 0.0), (0.0, -0.02), (-0.02, 0.0)] {
            let radius = |k: usize| 1.0 + first + (last - first) * k as f64 / count as f64;
            for k in 0..count {
                state = model.block(&state, &[radius(k + 1) / radius(k) - 1.0; LANES]).state;
            }
        }
        ends.push(state);
    }
    let moved = |column: usize, a: usize, b: usize| (ends[b][column][0] - ends[a][column][0]).abs();
    for column in [POROSITY, FABRIC_INDEX, JAMMING] {
        let name = NAMES[column];
        assert!(moved(column, 0, 9) < 0.01, "{name}: {}", moved(column, 0, 9));
        assert!(moved(column, 8, 9) <= moved(column, 0, 1) + 1e-12, "{name}");
    }
}

#[test]
fn what_is_known_of_the_start_is_kept_and_the_rest_is_the_mean() {
    let model = trained(10, 3, 1);
    let known = InitialData {
        porosity: 0.12,
        fabric_index: 0.01,
        fabric_xy: -0.004,
        reduced_stress: Some([0.0625, 0.0375, 0.003]),
        conductivity: Some([0.3, 0.25, -0.01]),
    };
    let state = model.initial_state(&known);
    assert_eq!(state[..3], [0.12, 0.01, -0.008]);
    let answer = model.evaluate(&state, 0.0);
    let near = |found: [Lanes; 3], known: Option<[f64; 3]>| {
        let pairs = found.iter().zip(known.expect("given"));
        pairs.for_each(|(found, known)| assert!((found[0] - known).abs() < 1e-6, "{found:?} {known}"));
    };
    near(answer.stress, known.reduced_stress);
    near(answer.conductivity, known.conductivity);
    let mean =
        model.initial_state(&InitialData { porosity: 0.12, fabric_index: 0.01, ..InitialData::default() });
    let [xx, yy, _] = model.evaluate(&mean, 0.0).stress.map(|column| column[0]);
    let law = 0.1 * 0.08 / 0.12; // of the synthetic packings
    assert!((0.5 * (xx + yy) - law).abs() < 0.05 * law, "{xx} {yy}");
    let uncertainty = model.uncertainty(&state).expect("the model reports its region");
    assert!(uncertainty.distance.is_finite() && uncertainty.conductivity_spread >= 0.0);
    let far_known =
        InitialData { porosity: 0.5, reduced_stress: Some([0.5, 0.5, 0.0]), ..InitialData::default() };
    let far = model.uncertainty(&model.initial_state(&far_known)).expect("the model reports its region");
    assert!(far.beyond_hull > 1.0 && far.distance > 3.0, "{far:?}");
}

#[test]
fn the_law_that_made_the_paths_is_found_again() {
    let model = trained(12, 40, 2);
    let held_out = synthetic::tracks(5, 6);
    for errors in model.path_errors(&held_out) {
        assert!(errors.pressure < 0.02 && errors.deviator < 0.02, "{errors:?}");
        assert!(errors.conductivity < 0.02 && errors.porosity < 1e-3, "{errors:?}");
    }
    let affine = model.answering_with(ConductivityKind::Affine).expect("both kinds are there");
    let state = model.initial_state(&InitialData { porosity: 0.12, ..InitialData::default() });
    let ratio =
        affine.evaluate(&state, 0.0).conductivity[0][0] / model.evaluate(&state, 0.0).conductivity[0][0];
    assert!((ratio - 1.1).abs() < 0.01, "{ratio}");
}

#[test]
fn same_seed_gives_the_same_bytes_whatever_the_thread_count() {
    assert_eq!(trained(8, 4, 1).to_json(), trained(8, 4, 2).to_json());
}

#[test]
fn too_few_paths_are_refused() {
    let data = TrainingData { tracks: synthetic::tracks(3, 2), ..TrainingData::default() };
    let message = train(&data, &TrainingOptions::default()).expect_err("too few").to_string();
    assert!(message.contains("fewer than 100 states"), "{message}");
}

#[test]
fn bad_files_are_refused_with_the_reason() {
    let good: serde_json::Value = serde_json::from_str(&shipped().to_json()).expect("JSON");
    let refused = |pointer: &str, value: serde_json::Value, expected: &str| {
        let mut changed = good.clone();
        *changed.pointer_mut(pointer).expect(pointer) = value;
        let message = read(&changed.to_string()).expect_err(pointer).to_string();
        assert!(message.contains(expected), "{pointer}: {message}");
    };
    refused("/schema", "msdd-increment-model-9".into(), "msdd-increment-model-9");
    refused("/law/bulk/0", (-1.0).into(), "law.bulk[0] = -1");
    refused("/law/bulk/2", (-1e5).into(), "law.bulk[2]");
    refused("/law/shear/1", 0.0.into(), "law.shear[1]");
    refused("/law/elements/0/share", 0.9.into(), "sum of shares");
    refused("/law/elements/1/strength", 0.0.into(), "law.elements[1]");
    refused("/readout/overlap/0", 1e300.into(), "readout.overlap = 1e300");
    refused("/conductivities", serde_json::json!([]), "conductivities (count)");
    refused("/conductivities/0/mean/0", 1e300.into(), "conductivities.mean");
    refused("/ranges/porosity/max", (-1.0).into(), "ranges.porosity");
    refused("/ranges/thermal_strain/min", (-3.0).into(), "ranges.thermal_strain");
    refused("/spread/conductivity/2", (-1.0).into(), "spread = -1");
    refused("/mean_stress/porosity/max", (-1.0).into(), "mean_stress.porosity");
    refused("/solid_fraction/coefficients/0", 1e300.into(), "solid_fraction.coefficients");
    let mut extra = good.clone();
    extra["surprise"] = 1.into();
    let message = read(&extra.to_string()).expect_err("unknown key").to_string();
    assert!(message.contains("surprise"), "{message}");
}
