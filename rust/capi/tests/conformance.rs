//! Requirements that every model has to meet, whoever made it. The same tests run over the built-in network, a model from a
//! file, the worked example of a C plug-in, and the built-in network exported as a plug-in.
#![allow(unsafe_code)] // the C interface is what is tested

mod common;

use common::{Cells, MATERIAL, Model, NOT_GIVEN, OK, Tables, UNWANTED, exported, last_error, plugin, text};
use msdd::abi::{self, msdd_grains, msdd_input, msdd_model};
use msdd::exports::*;
use std::ptr::{null, null_mut};
use std::sync::LazyLock;

const INVALID: i32 = abi::MSDD_INVALID_ARGUMENT as i32;

/// Name and source of each subject.
static SUBJECTS: LazyLock<[(&str, String); 4]> = LazyLock::new(|| {
    [
        ("built-in", "builtin".to_string()),
        ("file", concat!(env!("CARGO_MANIFEST_DIR"), "/../surrogate/models/paper.json").to_string()),
        ("C plug-in", plugin("rust/capi/examples/effective_medium.c")),
        ("exported", exported()),
    ]
});

fn each(check: impl Fn(&str, &Model)) {
    for (name, source) in &*SUBJECTS {
        let model = Model::load(source).unwrap_or_else(|error| panic!("{name}: {error:?}"));
        check(name, &model);
    }
}

#[test]
fn a_model_describes_itself() {
    each(|name, model| {
        assert!(model.columns() >= 2, "{name}");
        // SAFETY: live.
        let column = |k| unsafe { msdd_model_state_name(model.0, k) };
        assert_eq!([text(column(0)), text(column(1))], ["porosity", "fabric_index"], "{name}");
        assert!(column(model.columns()).is_null(), "{name}");
        let hash = model.text(msdd_model_hash);
        assert!(hash.len() == 64 && hash.chars().all(|c| c.is_ascii_hexdigit()), "{name}");
        let description: serde_json::Value =
            serde_json::from_str(&model.text(msdd_model_describe)).expect("JSON");
        assert_eq!(description["hash"], hash.as_str(), "{name}");
        assert_eq!(description["state"].as_array().map(Vec::len), Some(model.columns()), "{name}");
        assert!(
            ["affine", "network"].contains(&description["conductivity"].as_str().expect("text")),
            "{name}"
        );
    });
}

#[test]
fn zero_strain_keeps_the_state_bit_for_bit() {
    each(|name, model| {
        let mut cells = Cells::new(model, 71);
        for zero in [0.0, -0.0] {
            cells.thermal_strain = vec![zero; 71];
            cells.strain = std::array::from_fn(|_| vec![zero; 71]);
            cells.advance(model);
            for (before, after) in cells.state.iter().zip(&cells.next) {
                let bits = |column: &[f64]| column.iter().map(|v| v.to_bits()).collect::<Vec<_>>();
                assert_eq!(bits(before), bits(after), "{name}");
            }
        }
    });
}

#[test]
fn answers_do_not_depend_on_the_batch() {
    each(|name, model| {
        let mut all = Cells::new(model, 41);
        all.advance(model);
        for count in [1, 7, 8, 9, 17] {
            for first in [0, 1, 8, 41 - count] {
                let mut part = all.part(first, count);
                part.advance(model);
                for cell in 0..count {
                    assert_eq!(part.bits(cell), all.bits(first + cell), "{name}, {count} from {first}");
                }
            }
        }
    });
}

#[test]
fn answers_are_those_of_grains() {
    each(|name, model| {
        let mut states = Cells::new(model, 70);
        let mut last = [vec![], vec![]];
        for strain in [-0.02, 0.0, 0.02] {
            states.thermal_strain = vec![strain; 70];
            states.strain = std::array::from_fn(|_| vec![0.0; 70]);
            states.total = vec![strain; 70];
            states.advance(model);
            assert!(states.outputs[..2].iter().flatten().all(|k| *k > 0.0 && *k < 100.0), "{name} {strain}");
            assert!(states.outputs[2..4].iter().flatten().all(|s| *s >= 0.0 && *s < 1e5), "{name} {strain}");
            let [kxx, kyy, sxx, syy, kxy, sxy, ..] = &states.outputs;
            for cell in 0..70 {
                assert!(kxy[cell] * kxy[cell] < kxx[cell] * kyy[cell], "{name}: K in every direction");
                assert!(sxy[cell] * sxy[cell] <= sxx[cell] * syy[cell], "{name}: no tension");
            }
            let now = [states.outputs[0].clone(), states.outputs[2].clone()];
            for (before, after) in last.iter().zip(&now) {
                assert!(before.iter().zip(after).all(|(b, a): (&f64, &f64)| a > b), "{name} {strain}");
            }
            last = now;
        }
        assert!(states.next[0].iter().zip(&states.state[0]).all(|(after, before)| after < before), "{name}");
        let (porosity, mut solid) = ([0.09, 0.125, 0.15], [0.0; 3]);
        // SAFETY: live handle, columns of three.
        let status = unsafe { msdd_model_solid_fraction(model.0, 3, porosity.as_ptr(), solid.as_mut_ptr()) };
        assert_eq!(status, OK, "{name}: {}", last_error());
        // Overlaps count twice.
        assert!(
            solid.iter().zip(porosity).all(|(s, e)| *s > 1.0 - e && *s < 1.05 - 0.7 * e),
            "{name} {solid:?}"
        );
    });
}

#[test]
fn far_outside_is_an_answer_too() {
    each(|name, model| {
        // Porosities of .126 to .134: well inside of every model's range.
        let mut cells = Cells::new(model, 45).part(36, 9);
        (cells.state[0][1], cells.state[0][2]) = (f64::MAX, f64::MIN);
        (cells.state[1][3], cells.thermal_strain[4]) = (f64::MAX, 1e6);
        (cells.state[0][5], cells.state[1][5], cells.thermal_strain[5]) = (1e200, -1e200, -0.999);
        cells.advance(model);
        assert_eq!(cells.outside, [0, 1, 1, 1, 1, 1, 0, 0, 0], "{name}");
        assert_eq!(cells.outside_cells, 5, "{name}");
        assert!(cells.distance[0][1] > 1e300 && cells.distance[0][2] < -1e300, "{name}");
        assert_eq!(cells.distance.iter().map(|column| column[8]).sum::<f64>(), 0.0, "{name}");
        assert!(cells.next.iter().flatten().all(|v| v.is_finite()), "{name}");
        assert!(cells.outputs[..2].iter().flatten().all(|k| *k > 0.0 && *k < 1e6), "{name}");
    });
}

#[test]
fn bad_numbers_are_refused_with_column_and_index_and_nothing_is_written() {
    let refused = |name: &str, model: &Model, change: &dyn Fn(&mut Cells), status: i32, expected: &str| {
        let mut cells = Cells::new(model, 13);
        change(&mut cells);
        let before = cells.clone();
        assert_eq!(cells.advance_with(model, |_| ()), status, "{name} {expected}");
        assert_eq!(last_error(), expected, "{name}");
        assert!(cells.next == before.next && cells.outputs == before.outputs, "{name}");
        assert!(cells.outside == before.outside && cells.outside_cells == 99, "{name}");
    };
    let non_finite = abi::MSDD_NON_FINITE as i32;
    each(|name, model| {
        let nan = |c: &mut Cells| c.state[0][12] = f64::NAN;
        refused(name, model, &nan, non_finite, "porosity[12] = NaN is not finite");
        let infinite = |c: &mut Cells| c.state[1][3] = f64::INFINITY;
        refused(name, model, &infinite, non_finite, "fabric_index[3] = inf is not finite");
        let strain = |c: &mut Cells| c.thermal_strain[8] = f64::NAN;
        refused(name, model, &strain, non_finite, "thermal_strain[8] = NaN is not finite");
        let total = |c: &mut Cells| c.total[0] = -1.5;
        refused(name, model, &total, INVALID, "total_thermal_strain[0] = -1.5, allowed: above -1, to 10");
        if model.has_tangent() {
            let strain = |c: &mut Cells| c.strain[1][6] = f64::NAN;
            refused(name, model, &strain, non_finite, "strain[yy][6] = NaN is not finite");
            let strain = |c: &mut Cells| c.strain[2][5] = f64::INFINITY;
            refused(name, model, &strain, non_finite, "strain[xy][5] = inf is not finite");
            for (k, column) in ["strain[xx]", "strain[yy]", "strain[xy]", "rotation[z]"].iter().enumerate() {
                for bad in ["0.25", "-0.2"] {
                    let large = |c: &mut Cells| c.strain[k][4] = bad.parse().expect("a number");
                    let expected = format!("{column}[4] = {bad}, allowed: above -0.2, to 0.2");
                    refused(name, model, &large, INVALID, &expected);
                }
            }
        }
    });
}

#[test]
fn sizes_and_null_pointers_are_refused() {
    each(|name, model| {
        let refused = |change: &dyn Fn(&mut Tables), expected: &str| {
            let status = Cells::new(model, 5).advance_with(model, change);
            assert_eq!(status, INVALID, "{name} {expected}");
            assert!(last_error().contains(expected), "{name}: {}", last_error());
        };
        refused(&|tables| tables.step.struct_size -= 8, "step.struct_size");
        refused(&|tables| tables.step.struct_size = 0, "step.struct_size = 0");
        refused(&|tables| tables.step.state = null(), "state is NULL");
        refused(&|tables| tables.step.components = 6, "components = 6, allowed: 3");
        refused(&|tables| tables.step.cells = usize::MAX, "cells");
        if !model.has_tangent() {
            let mut zero = [0.0; 5];
            let column = [msdd_input { values: zero.as_ptr(), stride: 1 }; 3];
            refused(&|tables| tables.step.strain = column.as_ptr(), "has no mechanical tangent");
            refused(&|tables| tables.step.rotation = column.as_ptr(), "has no mechanical tangent");
            let mut columns = [UNWANTED; 9];
            columns[8].values = zero.as_mut_ptr();
            refused(&|tables| tables.step.tangent = columns.as_ptr(), "has no mechanical tangent");
        }
        let mut batch_of_none = Cells::new(model, 0);
        let none = |tables: &mut Tables| {
            (tables.step.thermal_strain, tables.step.total_thermal_strain) = (NOT_GIVEN, NOT_GIVEN);
        };
        assert_eq!(batch_of_none.advance_with(model, none), OK, "{name}: {}", last_error());
        // SAFETY: null handles and structs are refused.
        unsafe {
            assert_eq!(msdd_model_advance(model.0, &MATERIAL, null_mut()), INVALID, "{name}");
            assert_eq!(msdd_model_solid_fraction(model.0, 1, null(), null_mut()), INVALID, "{name}");
            let half = msdd_grains { struct_size: 16, ..MATERIAL };
            let status = msdd_model_initial_state(model.0, &half, null(), null());
            assert!(status == INVALID && last_error().contains("material.struct_size = 16"), "{name}");
        }
    });
}

#[test]
fn only_wanted_columns_are_written_and_a_state_may_advance_in_place() {
    each(|name, model| {
        let (mut apart, mut shared) = (Cells::new(model, 19), Cells::new(model, 19));
        apart.advance(model);
        let in_place = |tables: &mut Tables| {
            tables.in_place();
            tables.stress[0] = UNWANTED;
            (tables.step.outside, tables.step.distance) = (null_mut(), null());
        };
        assert_eq!(shared.advance_with(model, in_place), OK, "{name}: {}", last_error());
        assert_eq!(shared.state, apart.next, "{name}");
        assert!(shared.outputs[2] == [-7.0; 19] && shared.outside == [9; 19], "{name}");
        assert_eq!(shared.outputs[0], apart.outputs[0], "{name}");
        // Even the total strain's column may take an answer.
        let mut over = apart.part(0, 19);
        let same = |tables: &mut Tables| {
            tables.conductivity[0].values = tables.step.total_thermal_strain.values.cast_mut();
        };
        assert_eq!(over.advance_with(model, same), OK, "{name}: {}", last_error());
        assert!(over.total == apart.outputs[0] && over.outputs[1..] == apart.outputs[1..], "{name}");
    });
}

/// Eight threads use one handle at the same time, for many steps.
#[test]
fn eight_threads_answer_as_one() {
    each(|name, model| {
        let chain = |start: usize| {
            let mut cells = Cells::new(model, 60);
            cells.thermal_strain.iter_mut().for_each(|strain| *strain *= 0.01 * (1 + start) as f64);
            (0..50)
                .map(|_| {
                    cells.advance(model);
                    cells.state.clone_from(&cells.next);
                    (0..60).map(|cell| cells.bits(cell)).collect::<Vec<_>>()
                })
                .collect::<Vec<_>>()
        };
        let serial: Vec<_> = (0..8).map(chain).collect();
        let parallel: Vec<_> = std::thread::scope(|scope| {
            let threads: Vec<_> = (0..8).map(|k| scope.spawn(move || chain(k))).collect();
            threads.into_iter().map(|thread| thread.join().expect("no panic")).collect()
        });
        assert!(serial == parallel, "{name}");
    });
}

#[test]
fn the_tangent_is_the_derivative_of_the_stress() {
    each(|name, model| {
        if !model.has_tangent() {
            return;
        }
        let mut start = Cells::new(model, 30);
        start.total = vec![0.0; 30];
        start.advance(model);
        let h = 1e-8;
        let mut checked = 0;
        for j in 0..3 {
            let moved = |by: f64| {
                let mut cells = start.part(0, 30);
                cells.strain[j].iter_mut().for_each(|strain| *strain += by);
                cells.advance(model);
                [2, 3, 5].map(|output| cells.outputs[output].clone())
            };
            let (low, high) = (moved(-h), moved(h));
            for i in 0..3 {
                for cell in 0..30 {
                    let slope = -(high[i][cell] - low[i][cell]) / (2.0 * h);
                    let found = start.outputs[6 + 3 * i + j][cell];
                    // Where grains begin to slide within h, the derivative jumps.
                    checked += u32::from((found - slope).abs() < 1.0 + 1e-4 * slope.abs());
                }
            }
        }
        assert!(checked >= 265, "{name}: {checked} of 270");
    });
    let has = |(_, source): &(&str, String)| Model::load(source).expect("good").has_tangent();
    assert_eq!(
        SUBJECTS.iter().filter(|subject| has(subject)).count(),
        2,
        "the built-in model and its export"
    );
}

/// Shear gives a shear stress, and a cell that turns takes its stress with it.
#[test]
fn shear_and_rotation() {
    each(|name, model| {
        if !model.has_tangent() {
            return;
        }
        let mut cells = Cells::new(model, 47);
        (cells.thermal_strain, cells.total) = (vec![0.0; 47], vec![0.0; 47]);
        cells.strain = std::array::from_fn(|_| vec![0.0; 47]);
        let mut turned = cells.clone();
        cells.advance(model);
        let at_rest = cells.outputs.clone();
        let angle: f64 = 0.1;
        turned.strain[3] = vec![angle; 47];
        turned.advance(model);
        let (sine, cosine) = (2.0 * angle).sin_cos();
        for cell in 0..47 {
            for [xx, yy, xy] in [[2, 3, 5], [0, 1, 4]] {
                let tensor = |outputs: &[Vec<f64>]| [xx, yy, xy].map(|output| outputs[output][cell]);
                let (a, b) = (tensor(&at_rest), tensor(&turned.outputs));
                let half = 0.5 * (a[0] - a[1]);
                let (along, across) = (cosine * half - sine * a[2], sine * half + cosine * a[2]);
                let near = |found: f64, expected: f64| (found - expected).abs() < 2e-4 * a[0];
                assert!(
                    near(b[0] + b[1], a[0] + a[1]) && near(0.5 * (b[0] - b[1]), along),
                    "{name} {a:?} {b:?}"
                );
                assert!(near(b[2], across), "{name} {a:?} {b:?}");
            }
        }
        cells.strain[2] = vec![1e-3; 47];
        cells.advance(model);
        assert!((0..47).all(|cell| cells.outputs[5][cell] < at_rest[5][cell] - 1.0), "{name}: shear stress");
    });
}

/// A model computes the kinds of conductivity that it was trained for, and refuses all others with a message.
#[test]
fn conductivity_is_affine_or_network_by_choice() {
    let with = |model: &Model, kind: &std::ffi::CStr| {
        let mut out = null_mut();
        // SAFETY: live handle, a C string, and a writable pointer.
        let status = unsafe { msdd_model_with_conductivity(model.0, kind.as_ptr(), &mut out) };
        if status == OK { Ok(Model(out)) } else { Err((status, last_error())) }
    };
    each(|name, model| {
        let description: serde_json::Value =
            serde_json::from_str(&model.text(msdd_model_describe)).expect("JSON");
        for kind in [c"affine", c"network"] {
            let text = kind.to_str().expect("UTF-8");
            let known = description["conductivities"].as_array().expect("kinds").iter().any(|k| k == text);
            match with(model, kind) {
                Ok(other) => {
                    assert!(known, "{name} {text}");
                    let (mut a, mut b) = (Cells::new(model, 40), Cells::new(&other, 40));
                    a.advance(model);
                    b.advance(&other);
                    // The same state and stress; the same K when it is the same kind, else another.
                    let stress = |cells: &Cells| [2, 3, 5].map(|output| cells.outputs[output].clone());
                    assert!(a.next == b.next && stress(&a) == stress(&b), "{name} {text}");
                    assert_eq!(
                        a.outputs[0] == b.outputs[0],
                        description["conductivity"] == text,
                        "{name} {text}"
                    );
                }
                Err((status, message)) => {
                    assert!(!known && status == INVALID, "{name} {text}: {message}");
                    assert!(message.contains(&format!("kind = {text}, allowed: ")), "{name}: {message}");
                }
            }
        }
        let (status, message) = with(model, c"exact").err().expect("no such kind");
        assert!(status == INVALID && message.contains("kind = exact, allowed: "), "{name}: {message}");
    });
    // The built-in model has both; a copy outlives its origin, and the affine estimate is an upper bound.
    let affine = with(&Model::load("builtin").expect("good"), c"affine").unwrap_or_else(|e| panic!("{e:?}"));
    let network = with(&affine, c"network").unwrap_or_else(|e| panic!("{e:?}"));
    let (mut upper, mut lower) = (Cells::new(&affine, 60), Cells::new(&network, 60));
    upper.advance(&affine);
    lower.advance(&network);
    let mean = |cells: &Cells, cell: usize| cells.outputs[0][cell] + cells.outputs[1][cell];
    for cell in 0..60 {
        let ratio = mean(&upper, cell) / mean(&lower, cell);
        assert!(ratio > 1.0 && ratio < 1.2, "{cell}: {ratio}");
    }
}

/// The built-in model gives the same bits when it is exported as a plug-in and loaded again.
#[test]
fn the_exported_model_is_the_built_in_one() {
    let (built_in, foreign) =
        (Model::load("builtin").expect("good"), Model::load(&exported()).expect("good"));
    let (mut a, mut b) = (Cells::new(&built_in, 501), Cells::new(&foreign, 501));
    for _ in 0..20 {
        a.advance(&built_in);
        b.advance(&foreign);
        assert!((0..501).all(|cell| a.bits(cell) == b.bits(cell)));
        assert!(a.state == b.state && a.outside_cells == b.outside_cells);
        a.state.clone_from(&a.next);
        b.state.clone_from(&b.next);
    }
    let friction = |model: &Model| {
        let (mut limit, mut slip) = (0.0, 0.0);
        // SAFETY: live handle, full struct, writable outputs.
        let status = unsafe { msdd_model_wall_friction(model.0, &MATERIAL, &mut limit, &mut slip) };
        (status, limit, slip)
    };
    assert_eq!(friction(&built_in), friction(&foreign));
}

/// The worked example gives the numbers that its comment states: those of the paper's box within a few percent.
#[test]
fn the_effective_medium_is_a_sensible_baseline() {
    let model = Model::load(&SUBJECTS[2].1).expect("good");
    let mut cells = Cells::new(&model, 1);
    (cells.state[0][0], cells.state[1][0]) = (0.125, 0.05);
    (cells.thermal_strain[0], cells.total[0]) = (0.0, 0.0);
    cells.advance(&model);
    let [kxx, kyy, sxx, syy] = [0, 1, 2, 3].map(|k| cells.outputs[k][0]);
    assert!((kxx - 34.0).abs() < 3.0 && (kyy - 28.0).abs() < 3.0, "{kxx} {kyy} W/(m K)");
    assert!((0.5 * (sxx + syy) - 2600.0).abs() < 400.0, "{sxx} {syy} Pa");
    (cells.thermal_strain[0], cells.total[0]) = (0.05, 0.05);
    cells.advance(&model);
    let rise = 0.5 * (cells.outputs[2][0] + cells.outputs[3][0] - sxx - syy);
    assert!((rise - 3100.0).abs() < 600.0, "{rise} Pa at 5 %");
    assert!((cells.outputs[0][0] - 53.0).abs() < 4.0, "{}", cells.outputs[0][0]);
    assert!((cells.next[0][0] - 0.077).abs() < 0.004, "{}", cells.next[0][0]);
    // A hundred small steps lead to the same state as one step of their sum.
    let once = cells.next[0][0];
    cells.thermal_strain[0] = 1.05f64.powf(0.01) - 1.0;
    for _ in 0..100 {
        cells.advance(&model);
        cells.state.clone_from(&cells.next);
    }
    assert!((cells.state[0][0] - once).abs() < 1e-5, "{} {once}", cells.state[0][0]);
}

/// A missing file, a file that is not a plug-in, and a plug-in that fails have different statuses.
#[test]
fn plugin_failures_have_their_own_statuses() {
    let plugin_status = abi::MSDD_PLUGIN as i32;
    let (status, message) = Model::load("plugin:/no/such.so").err().expect("missing");
    assert!(status == abi::MSDD_IO as i32 && message.contains("/no/such.so"), "{message}");
    let manifest = concat!("plugin:", env!("CARGO_MANIFEST_DIR"), "/Cargo.toml");
    let (status, message) = Model::load(manifest).err().expect("text");
    assert!(status == plugin_status && message.contains("is no shared library"), "{message}");
    let model = Model::load(&plugin("rust/capi/tests/failing_plugin.c")).expect("fit");
    let mut cells = Cells::new(&model, 12);
    let before = cells.clone();
    assert_eq!(cells.advance_with(&model, |_| ()), plugin_status);
    assert!(last_error().contains("conductivity_xx[5] = -0.3, allowed: finite, above 0"), "{}", last_error());
    cells.thermal_strain[0] = 0.5;
    assert_eq!(cells.advance_with(&model, |_| ()), plugin_status);
    assert!(last_error().contains("advance failed with status 4: hotter than the table"), "{}", last_error());
    assert!(cells.next == before.next && cells.outputs == before.outputs && cells.outside_cells == 99);
    let handle: *const msdd_model = model.0;
    // SAFETY: live handle, columns of one.
    let status = unsafe { msdd_model_solid_fraction(handle, 1, &0.1, &mut 0.0) };
    assert!(status == INVALID && last_error().contains("has solid fractions"), "{}", last_error());
}
