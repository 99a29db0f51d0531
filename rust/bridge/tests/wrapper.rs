//! Tests of `msdd.hpp` from Rust: the same bits as a call of the Rust function, exceptions, moves, threads, floating-point
//! traps.

use msdd_bridge::ffi::{self, Cells};
use msdd_surrogate::surrogate::{InitialData, MAX_STATE};
use msdd_surrogate::{Surrogate, models};

const COUNT: usize = 37;

/// Cells in the initial state, with a different strain in each.
fn start(model: &ffi::Model) -> Cells {
    let column = |from: f64, step: f64| (0..COUNT).map(|i| from + step * i as f64).collect::<Vec<f64>>();
    let empty = vec![-7.0; COUNT];
    Cells {
        state: model.initial_state(&column(0.1, 1e-3), &column(0.04, -2e-3)).expect("good"),
        thermal_strain: column(2e-3, -1e-4),
        conductivity_xx: empty.clone(),
        conductivity_yy: empty.clone(),
        stress_xx: empty.clone(),
        stress_yy: empty,
        clamped_cells: 99,
    }
}

/// The same step by the Rust function, for grains of k = E = r = 1, for which dimensionless results equal those in SI units.
fn in_rust(model: &dyn Surrogate, cells: &Cells) -> Cells {
    let mut after = cells.clone();
    after.clamped_cells = 0;
    for cell in 0..COUNT {
        let mut state = [0.0; MAX_STATE];
        state.iter_mut().zip(cells.state.chunks(COUNT)).for_each(|(value, column)| *value = column[cell]);
        let answer = model.evaluate(&state, cells.thermal_strain[cell]);
        after.state.chunks_mut(COUNT).zip(&answer.state).for_each(|(column, lanes)| column[cell] = lanes[0]);
        after.conductivity_xx[cell] = answer.conductivity[0][0];
        after.conductivity_yy[cell] = answer.conductivity[1][0];
        after.stress_xx[cell] = answer.stress[0][0];
        after.stress_yy[cell] = answer.stress[1][0];
        after.clamped_cells += usize::from(!answer.inside(0));
    }
    after
}

fn bits(cells: &Cells) -> Vec<u64> {
    let columns = [&cells.conductivity_xx, &cells.conductivity_yy, &cells.stress_xx, &cells.stress_yy];
    columns.into_iter().chain([&cells.state]).flatten().map(|value| value.to_bits()).collect()
}

#[test]
fn the_wrapper_gives_the_bits_of_the_rust_call() {
    for name in ["builtin", "builtin:paper"] {
        let (wrapped, model) = (ffi::load(name).expect("good"), models::builtin(name).expect("good"));
        assert_eq!(
            (wrapped.hash().as_str(), wrapped.state_size()),
            (model.hash(), model.state_names().len())
        );
        let mut cells = start(&wrapped);
        for (i, [porosity, fabric_index]) in
            (0..COUNT).map(|i| (i, [0, 1].map(|k| cells.state[k * COUNT + i])))
        {
            let known = InitialData { porosity, fabric_index, ..InitialData::default() };
            let state = model.initial_state(&known);
            assert!((0..wrapped.state_size()).all(|k| cells.state[k * COUNT + i] == state[k]));
        }
        for _ in 0..30 {
            let expected = in_rust(&*model, &cells);
            wrapped.advance(&mut cells).expect("good");
            assert_eq!(bits(&cells), bits(&expected), "{name}");
            assert_eq!(cells.clamped_cells, expected.clamped_cells);
        }
    }
}

/// The slip is given in mean radii in the model file and in metres here; the paper's network has no wall friction.
#[test]
fn wall_friction_is_the_models_in_metres() {
    let model = models::builtin("builtin").expect("good");
    let friction = model.wall_friction().expect("shipped with it");
    let found = ffi::load("builtin").expect("good").wall_friction(5e-3).expect("asked");
    assert_eq!(found, [friction.limit, 5e-3 * friction.slip]);
    assert!(found[0] > 0.1 && found[0] < 1.0 && found[1] > 0.0, "{found:?}");
    assert!(ffi::load("builtin:paper").expect("good").wall_friction(5e-3).expect("asked").is_empty());
}

#[test]
fn exceptions_arrive_with_the_librarys_text() {
    let failed = |source: &str| ffi::load(source).err().expect("no model").what().to_string();
    assert!(failed("/no/such/model.json").contains("cannot read model file \"/no/such/model.json\""));
    assert!(failed("plugin:/no/such.so").contains("cannot read plug-in \"/no/such.so\""));
    assert!(failed("builtin:best").contains("builtin:paper"));
    let model = ffi::load("builtin").expect("good");
    let mut cells = start(&model);
    cells.thermal_strain[7] = f64::NAN;
    let before = bits(&cells);
    let error = model.advance(&mut cells).expect_err("not finite");
    assert_eq!(error.what(), "thermal_strain[7] = NaN is not finite");
    assert_eq!(bits(&cells), before);
    let error = model.advance_with_wrong_size(&mut start(&model)).expect_err("wrong size");
    assert!(error.what().contains("step.struct_size"), "{}", error.what());
}

/// An object that was moved from has no model, throws when it is used, and frees nothing; the new one frees the model once.
#[test]
fn handles_move_and_are_freed_once() {
    let mut first = ffi::load("builtin").expect("good");
    let hash = first.hash();
    let mut second = ffi::moved(first.pin_mut());
    assert!(second.hash() == hash && first.hash().is_empty() && first.state_size() == 0);
    let error = first.advance(&mut start(&second)).expect_err("moved from");
    assert_eq!(error.what(), "model is NULL");
    ffi::move_into_itself(second.pin_mut());
    assert_eq!(second.hash(), hash);
    let third = ffi::moved(second.pin_mut());
    drop((first, second));
    // Memory that was freed twice or too early would be overwritten by these models.
    let others: Vec<_> = (0..20).map(|_| ffi::load("builtin:paper").expect("good")).collect();
    let mut cells = start(&third);
    third.advance(&mut cells).expect("alive");
    assert!(third.hash() == hash && others.iter().all(|other| other.hash() != hash));
}

#[test]
fn two_threads_share_a_model() {
    let model = ffi::load("builtin").expect("good");
    let chain = || {
        let mut cells = start(&model);
        (0..200).for_each(|_| model.advance(&mut cells).expect("good"));
        bits(&cells)
    };
    let alone = chain();
    std::thread::scope(|scope| {
        let both = [scope.spawn(chain), scope.spawn(chain)];
        both.into_iter().for_each(|thread| assert_eq!(thread.join().expect("no panic"), alone));
    });
    // An error on one thread must not appear on another.
    let message = std::thread::scope(|scope| {
        scope
            .spawn(|| ffi::load("builtin:best").err().map(|e| e.what().to_string()))
            .join()
            .expect("no panic")
    });
    assert!(message.is_some() && model.advance(&mut start(&model)).is_ok());
}

/// With floating-point traps on, as in OpenFOAM, no call of the library ends the process, and no exception flag is left set.
#[test]
fn traps_stay_on_and_do_not_fire() {
    ffi::trap();
    for name in ["builtin", "builtin:paper"] {
        let model = ffi::load(name).expect("good");
        let mut cells = start(&model);
        assert!(ffi::trapped_and_clear());
        cells.state[..4].copy_from_slice(&[f64::MAX, -f64::MAX, 1e300, -1e300]);
        cells.thermal_strain[..8].copy_from_slice(&[
            0.0,
            1e300,
            -0.99,
            1e6,
            -1e300,
            f64::MAX,
            f64::MIN,
            5e-324,
        ]);
        model.advance(&mut cells).expect("clamped");
        assert!(ffi::trapped_and_clear() && cells.clamped_cells >= 7);
        cells.thermal_strain[3] = f64::INFINITY;
        let refused = model.advance(&mut cells).is_err();
        assert!(refused && ffi::trapped_and_clear());
    }
    let pressures = ffi::strained_rves(0.01).expect("packs");
    assert!(pressures[0] > 0.0 && pressures[0].to_bits() == pressures[1].to_bits());
}
