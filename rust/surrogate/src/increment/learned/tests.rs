use super::training::{motions, train};
use super::*;
use crate::increment::synthetic::tracks;

/// A law of random numbers, a state and a strain.
fn example() -> (LearnedLaw, State, [f64; 4]) {
    let mut law = LearnedLaw::initial(7);
    let mut random = ChaCha8Rng::seed_from_u64(9);
    law.numbers.iter_mut().for_each(|number| *number += 0.2 * symmetric_unit(&mut random));
    let state = State {
        pressure: 0.04,
        ratio: [0.2, -0.1],
        solid: 0.86,
        memory: [[0.5, 0.3], [-0.2, 0.6]],
        angle: 0.0,
    };
    (law, state, [2e-4, 1e-3, -5e-4, 8e-4])
}

fn near(a: f64, b: f64) -> bool {
    (a - b).abs() < 1e-14
}

#[test]
fn without_strain_nothing_changes() {
    let (law, state, _) = example();
    assert_eq!(law.advanced(&state, &Motion::of([0.0; 4])), state);
}

#[test]
fn turned_axes_give_turned_answers() {
    let (law, state, [thermal, xx, yy, xy]) = example();
    let after = law.advanced(&state, &Motion::of([thermal, xx, yy, xy]));
    for angle in [0.3f64, 1.1, -2.0] {
        // Tensors turn by the angle, the vectors of their deviators by twice the angle.
        let (c, s) = ((2.0 * angle).cos(), (2.0 * angle).sin());
        let (mean, [along, across]) = (0.5 * (xx + yy), turned([0.5 * (xx - yy), 0.5 * xy], [c, s]));
        let strain = [thermal, mean + along, mean - along, 2.0 * across];
        let there = law.advanced(&state.turned([c, s]), &Motion::turning(strain, -0.5 * xy));
        let expected = after.turned([c, s]);
        assert!(near(there.pressure, expected.pressure) && near(there.solid, expected.solid));
        for k in 0..2 {
            assert!(near(there.ratio[k], expected.ratio[k]), "{there:?} {expected:?}");
            assert!((0..MEMORIES).all(|i| near(there.memory[i][k], expected.memory[i][k])));
        }
    }
}

#[test]
fn a_thermal_strain_is_an_isotropic_compression() {
    let (law, state, _) = example();
    let compression = 1.0 / 1.001 - 1.0;
    let warm = law.advanced(&state, &Motion::of([0.001, 0.0, 0.0, 0.0]));
    let pressed = law.advanced(&state, &Motion::of([0.0, compression, compression, 0.0]));
    assert!(near(warm.pressure, pressed.pressure) && near(warm.solid, pressed.solid));
    assert!(near(warm.ratio[0], pressed.ratio[0]) && near(warm.memory[0][0], pressed.memory[0][0]));
}

#[test]
fn it_learns_paths_of_the_classical_law() {
    let tracks = tracks(10, 6);
    let error = |law: &LearnedLaw| {
        let (mut sum, mut count) = (0.0, 0.0);
        for track in &tracks {
            let mut state = law.start(&track.packed);
            for step in &track.steps {
                state = motions(step.strain).iter().fold(state, |state, motion| law.advanced(&state, motion));
                let (found, known) = (state.stress(), step.to.invariants());
                sum += (0..3).map(|c| ((found[c] - known[c]) / track.pressure()).powi(2)).sum::<f64>();
                count += 1.0;
            }
        }
        (sum / count).sqrt()
    };
    let (before, after) = (error(&LearnedLaw::initial(1)), error(&train(&tracks, 1, 500, 2)));
    assert!(after < 0.012 && after < 0.3 * before, "{before} {after}");
}
